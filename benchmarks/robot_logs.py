"""Logs of real robots through `diagnose`: `python benchmarks/robot_logs.py NAME --out FOLDER`, or `all`.

Writes the case of each log with its simulation into FOLDER (`tests/robots/real_logs.py`) and diagnoses it; the report
lies beside the case. A log that is refused prints the reason; `--check` ends before the first fit. `--write` puts the
tables into the pages of the gallery, behind the lines `<!-- figures of benchmarks/robot_logs.py NAME ... -->`.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Mapping
from pathlib import Path

from arm_page import format_joints
from gallery import format_interval, write_into_pages
from lostmotion.errors import LostMotionError
from lostmotion.registry import Registry
from lostmotion.results.robots import RobotDiagnosis
from lostmotion.robots.arm_run import check_robot, run_robot

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "robots"))

from real_logs import LOGS  # noqa: E402 - it lies beside the tests

MARK = "figures of benchmarks/robot_logs.py"


def format_found(found: RobotDiagnosis) -> str:
    """Return what was found, with its parameters, as a table."""
    rows = [
        (
            f"{one.state}: {one.mechanism} at {one.at}",
            "; ".join(f"{name} {format_interval(x)} {x.unit}" for name, x in one.parameters.items()),
            f"{one.probability:.3f}",
        )
        for one in found.found
    ]
    rows += [(f"`{key}`", f"{format_interval(x)} {x.unit}", "") for key, x in found.parameters.after.items()]
    return "\n".join(["| | value with its 95 % interval | probability |", "|---|---|---|", *map(format_row, rows)])


def format_row(cells: tuple[str, ...]) -> str:
    """Return a row of a table."""
    return f"| {' | '.join(cells)} |"


def make_tables(name: str, found: RobotDiagnosis) -> Mapping[str, str]:
    """Return the tables of a page by their marks."""
    sentences = [*found.says, *(check.says for check in found.checks), *found.notes]
    return {
        f"{MARK} {name} found": format_found(found),
        f"{MARK} {name} joints": format_joints(found),
        f"{MARK} {name} says": "\n".join(["| the answer |", "|---|", *(f"| {says} |" for says in sentences)]),
    }


def diagnose(name: str, case: Path, registry: Registry, options: argparse.Namespace) -> Mapping[str, str]:
    """Return the tables of a log by their marks; raise `LostMotionError` where it is refused."""
    if options.check:
        lines = ["| before any fit |", "|---|", *(f"| {says} |" for says in check_robot(case, registry))]
        return {f"{MARK} {name} check": "\n".join(lines)}
    found = run_robot(
        case, case.parent / "result", registry, budget=options.budget, jobs=options.jobs,
        say=lambda text: print(f"  {text}", flush=True),
    )  # fmt: skip
    return make_tables(name, found)


def main() -> None:
    """Print the tables of each log that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("which", nargs="?", default="all", choices=(*LOGS, "all"))
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="where the recordings lie")
    parser.add_argument("--jobs", type=int, default=1, help="how many cores")
    parser.add_argument("--budget", type=float, help="the processor time of a search (s)")
    parser.add_argument("--check", action="store_true", help="print what is looked at before any fit, and end")
    parser.add_argument("--write", action="store_true", help="put the tables into the pages of the gallery")
    options = parser.parse_args()
    registry = Registry.discover()
    for name in LOGS if options.which == "all" else (options.which,):
        folder, begun = options.out / name, time.perf_counter()
        folder.mkdir(parents=True, exist_ok=True)
        case = folder / "case.toml"
        case.write_text(LOGS[name](options.shared / "data", folder))
        try:
            tables = diagnose(name, case, registry, options)
        except LostMotionError as err:
            tables = {f"{MARK} {name} says": f"| refused before any fit |\n|---|\n| {err} |"}
        print("\n\n".join(tables.values()), f"\n{name}: {time.perf_counter() - begun:.0f} s", flush=True)
        if options.write:
            write_into_pages(tables)


if __name__ == "__main__":
    main()
