"""Has anything become slower since the last release? `pytest benchmarks && python benchmarks/compare.py`.

What is compared are ratios: the processor time of ours over that of a plain version, or of another yardstick, measured
in turn in the same run. A machine that is slower, or busy, slows both; a kernel that is slower raises its ratio. Exit
status 1 when a ratio has risen by more than the tolerance, or was not measured.

    python benchmarks/compare.py                     the last run against the last release (baseline.json)
    python benchmarks/compare.py --against FILE      against another run that was kept in .benchmarks
    python benchmarks/compare.py --update            make the last run the baseline: for a release
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Mapping
from pathlib import Path

BASELINE = Path(__file__).parent / "baseline.json"
RUNS = Path(__file__).parents[1] / ".benchmarks"
TOLERANCE = 0.6
"""A busy machine moves a ratio by up to a third either way; a kernel that takes twice as long is found."""


def last_run(runs: Path = RUNS) -> Path:
    """Return the newest file that `pytest benchmarks` has kept."""
    kept = sorted(runs.rglob("*.json"), key=lambda path: path.stat().st_mtime)
    if not kept:
        raise SystemExit(f"{runs.name} holds no run: call `pytest benchmarks` first")
    return kept[-1]


def ratios_in(path: Path) -> dict[str, float]:
    """Return the ratios of a kept run, or of a baseline, by the name of the benchmark."""
    content = json.loads(path.read_text(encoding="utf-8"))
    if "ratios" in content:
        return {name: float(ratio) for name, ratio in content["ratios"].items()}
    rows = ((row["name"], row["extra_info"].get("ratio")) for row in content["benchmarks"])
    return {name: float(ratio) for name, ratio in rows if ratio is not None}


def slower(before: Mapping[str, float], now: Mapping[str, float], tolerance: float) -> list[str]:
    """Return the names of those whose ratio has risen by more than the tolerance, or is not there any more."""
    return [name for name, ratio in before.items() if not now.get(name, float("inf")) <= ratio * (1.0 + tolerance)]


def table(before: Mapping[str, float], now: Mapping[str, float], bad: list[str]) -> Iterator[str]:
    """Yield one line for each benchmark: the ratio before and now, and what became of it."""
    for name in dict.fromkeys((*before, *now)):
        was, is_ = before.get(name), now.get(name)
        change = f"{100.0 * (is_ / was - 1.0):+6.0f} %" if was and is_ else "   new" if is_ else "   not measured"
        figures = "  ".join("       -" if ratio is None else f"{ratio:8.2g}" for ratio in (was, is_))
        state = "ok" if name not in bad else "SLOWER" if is_ else "ABSENT"
        yield f"{state:<6}  {figures}  {change}  {name}"


def saved(path: Path, ratios: Mapping[str, float], release: str) -> None:
    """Write a baseline: ratios to two figures, nothing of the machine."""
    rounded = {name: float(f"{ratio:.2g}") for name, ratio in sorted(ratios.items())}
    path.write_text(json.dumps({"release": release, "ratios": rounded}, indent=1) + "\n", encoding="utf-8")


def main() -> int:
    """Return 0 when nothing has become slower, else 1."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--against", type=Path, default=BASELINE, metavar="FILE")
    parser.add_argument("--tolerance", type=float, default=TOLERANCE, metavar="SHARE")
    parser.add_argument("--update", action="store_true", help="make the last run the baseline")
    asked = parser.parse_args()
    now = ratios_in(last_run())
    if asked.update:
        from lostmotion import __version__

        saved(BASELINE, now, __version__)
        print(f"{BASELINE.name}: {len(now)} ratios of {__version__}")
        return 0
    before = ratios_in(asked.against)
    bad = slower(before, now, asked.tolerance)
    print("\n".join(table(before, now, bad)))
    print(f"{len(bad)} of {len(before)} slower by more than {100 * asked.tolerance:.0f} %, or absent")
    return 1 if bad else 0


if __name__ == "__main__":
    raise SystemExit(main())
