"""Real recordings through `diagnose`: `python benchmarks/gallery.py NAME --out DIR`, or `all`.

Prints what was found, held-out errors before and after, and the time; the reports lie in DIR. For the Silverbox also
the error of a free run over the arrow, which no fit has seen, in mV. What an expert reads off the recording without a
model of ours (`tests/science/by_hand.py`) is printed first. `--write` puts the tables into the pages of the gallery,
behind the lines `<!-- figures of benchmarks/gallery.py NAME -->` and `<!-- by hand: NAME -->`.

The recordings are cut so that a diagnosis takes a minute: six seconds of each of EMPS (`emps_whole` takes all), 6,000
samples of the Silverbox.
"""

from __future__ import annotations

import argparse
import math
import re
import sys
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from lostmotion.contracts import Assembly
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.system import System
from lostmotion.registry import Registry, default
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Candidate, Diagnosis, Mechanism

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "science"))

import by_hand  # noqa: E402 - these lie beside the tests
from rig_cases import CASES, RATE  # noqa: E402

ARROW = slice(100, 40575)
SETTLING = 50
WHEN = ("before", "after")
SHOWN = 0.01
"""Candidates of a lower probability are not printed."""


def measure_arrow(found: Diagnosis, data: Path, registry: Registry) -> dict[str, float]:
    """Return the rms errors (V) of free runs over the arrow with the parameters before and after.

    A learned curve is no law beyond what it was learned on: with one there is no free run after.
    """
    table = np.load(data / "silverbox" / "SNLS80mV.npz")
    u, y = (table[k].ravel()[ARROW] for k in ("V1", "V2"))
    grid = np.arange(len(u)) / RATE
    drive = Drive.smooth([CubicSpline(grid, u)], 1.0 / RATE, len(u))
    errors, laws = {}, tuple(f for f in found.found if f.at == "ground")
    learned = any(f.mechanism == "unknown" for f in found.found)
    for when, terms in (("before", ()),) if learned else (("before", ()), ("after", laws)):
        model = registry.make("model", "linear_oscillator")
        system = System.of(Assembly(model, tuple(registry.make("term", f.mechanism) for f in terms)))
        known = {s.key for s in system.slots}
        values = {k: v.median for k, v in getattr(found.parameters, when).items() if k in known}
        run = system.simulate(system.vector(values), system.everything, np.array([y[0], 0.0]), drive, 8)
        errors[when] = float(np.sqrt(np.mean((run.states[SETTLING:, 0] - y[SETTLING:]) ** 2)))
    return errors


def main() -> None:
    """Print a paragraph for each recording that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("which", nargs="?", default="all", choices=(*CASES, "all"))
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="where the recordings lie")
    parser.add_argument("--jobs", type=int, default=1, help="how many cores")
    parser.add_argument("--propose", action="store_true", help="ask for the next experiment too, which takes longer")
    parser.add_argument("--write", action="store_true", help="put the tables into the pages of the gallery")
    args = parser.parse_args()
    data, registry = args.shared / "data", default()
    for name in CASES if args.which == "all" else (args.which,):
        folder = args.out / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "case.toml").write_text(CASES[name](data, folder))
        begin = time.perf_counter()
        found = run_diagnosis(folder / "case.toml", folder / "result", registry, jobs=args.jobs, propose=args.propose)
        print_result(name, found, time.perf_counter() - begin)
        further = measure_arrow(found, data, registry) if name == "silverbox" else {}
        tables = {f"figures of benchmarks/gallery.py {name}": format_table(found, further)}
        if name in by_hand.READ:
            tables[f"by hand: {name}"] = format_numbers(by_hand.READ[name](data))
        print("\n\n".join(tables.values()), flush=True)
        if args.write:
            write_into_pages(tables)


def format_numbers(numbers: by_hand.Numbers) -> str:
    """Return what is read off by hand as a table."""
    rows = [f"| {key} | {value:.4g} {unit} |" for key, (value, unit) in numbers.items()]
    return "\n".join(["| value obtained without a model | |", "|---|---|", *rows])


def format_table(found: Diagnosis, further: Mapping[str, float]) -> str:
    """Return what a diagnosis says as a table: parameters, names with their probabilities, held-out predictions."""
    both = {"before": found.parameters.before, "after": found.parameters.after}
    scores = {"before": found.fit.before, "after": found.fit.after}
    units = {key: value.unit for when in WHEN for key, value in both[when].items()}
    rows = [
        (f"`{key}` ({unit})" if unit else f"`{key}`", *(format_interval(both[w].get(key)) for w in WHEN))
        for key, unit in units.items()
    ]
    rows += [
        (f"{entry.state}: {entry.mechanism} {describe_place(entry)}".rstrip(), "", f"{entry.probability:.3f}")
        for entry in found.found
    ]
    left = (found.unexplained_before, found.unexplained)
    rows.append((f"force left unexplained, rms ({found.unexplained.unit})", *(f"{one.rms:.2g}" for one in left)))
    over = f"over {found.fit.horizon_unit_time * found.fit.before.horizon:.3g} s"
    rows.append((f"held-out error {over}", *(f"{scores[w].nrmse:.2%}" for w in WHEN)))
    rows.append(("held-out log score", *(f"{scores[w].log_score:.3f}" for w in WHEN)))
    if further:
        rows.append(
            (
                "free run over the arrow, rms (mV)",
                *(f"{1e3 * further[w]:.2f}" if w in further else "no law" for w in WHEN),
            )
        )
    return "\n".join(["| | before | after |", "|---|---|---|", *(f"| {' | '.join(row)} |" for row in rows)])


def format_interval(value: Interval | None) -> str:
    """Return an estimate with its 95 % interval, or nothing."""
    if not value:
        return ""
    if math.isnan(value.low):
        return f"{value.median:.4g} (interval withheld)"
    return f"{value.median:.4g} [{value.low:.4g}, {value.high:.4g}]"


def describe_place(entry: Mechanism | Candidate) -> str:
    """Return where a term acts, if it acts at a place."""
    return f"at {entry.at}" if entry.at else ""


def write_into_pages(tables: Mapping[str, str]) -> None:
    """Put tables into the pages of the gallery in place of those that stand behind the same marks."""
    for page in (ROOT / "docs" / "gallery").glob("*.md"):
        text = page.read_text()
        for mark, lines in tables.items():
            text = re.sub(rf"(<!-- {re.escape(mark)} -->\n\n)(\|[^\n]*\n)*", lambda m: f"{m[1]}{lines}\n", text)  # noqa: B023
        if text != page.read_text():
            page.write_text(text)


def print_result(name: str, found: Diagnosis, taken: float) -> None:
    """Print what a diagnosis says."""
    fit = found.fit
    print(f"{name}, {taken:.0f} s")
    for line in (*found.says, *found.notes):
        print(f"  {line}")
    print(f"  held-out error {fit.before.nrmse:.3g} -> {fit.after.nrmse:.3g}")
    print(f"  held-out log score {fit.before.log_score:.3g} -> {fit.after.log_score:.3g}")
    print(f"  noise {fit.noise_floor_nrmse:.3g}")
    for entry in found.ranking:
        if entry.probability > SHOWN:
            print(f"  {entry.mechanism} {describe_place(entry)}: probability {entry.probability:.3f}")


if __name__ == "__main__":
    main()
