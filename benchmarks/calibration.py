"""The calibrations of the project: a table in Markdown, one line to each parameter of each campaign.

python benchmarks/calibration.py --out FOLDER [--only standard|ignored|found|quantifiers] [--machines N] [--jobs 2]
                                 [--seed 0]

standard     200 machines, nothing hidden: do the intervals of the trajectory route hold the truth?
ignored      100 machines that hide 1 N of dry friction, fitted without it: the lie of a wrong model
found        the same machines, fitted with the term
quantifiers  100 machines, known by the exponents and dimensions of four levels alone

A campaign that is stopped goes on where it was. The time is that of this run, on `jobs` processes.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from tqdm import tqdm

from lostmotion.case import dump_case
from lostmotion.identification.sampling import SamplingPlan
from lostmotion_trials.coverage.design import Design
from lostmotion_trials.coverage.machines import Stand
from lostmotion_trials.coverage.results import CalibrationSummary
from lostmotion_trials.coverage.run import run_calibration

KNOWN = {"m": 1.0, "k1": 0.0, "k0": 4e4}
PRIORS = {
    "c": {"low": 2.0, "high": 32.0, "scale": "log"},
    "x0": {"low": 2e-3, "high": 1.25e-2, "scale": "log"},
}
OMEGA = 40.0
PERIOD = 0.15707963267948966
HIDDEN = ("coulomb_friction:force=1",)
LEVELS = (50, 75, 100, 150)


def drive(amplitude: float) -> str:
    return f"harmonic:amplitude={amplitude:g},omega={OMEGA:g}"


SHORT = Stand((drive(100),), 30 * PERIOD, 100 / PERIOD, 0.01)
LONG = Stand(tuple(map(drive, LEVELS)), 150 * PERIOD, 80 / PERIOD, 0.005)


@dataclass(frozen=True)
class Campaign:
    machines: int
    bench: Stand = SHORT
    hide: tuple[str, ...] = ()
    terms: tuple[str, ...] = ()
    route: str = "trajectory"
    ess: float = 300.0


CAMPAIGNS: Mapping[str, Campaign] = {
    "standard": Campaign(200),
    "ignored": Campaign(100, hide=HIDDEN),
    "found": Campaign(100, hide=HIDDEN, terms=("coulomb_friction",)),
    "quantifiers": Campaign(100, LONG, route="quantifiers"),
}
HEAD = ("campaign", "parameter", "in 50 %", "in 90 %", "in 95 %", "chi2 p", "ECDF p", "z rms", "median rel. sd", "lost")


def run(name: str, out: Path, machines: int, jobs: int, seed: int = 0) -> CalibrationSummary:
    campaign = CAMPAIGNS[name]
    folder = out / name
    folder.mkdir(parents=True, exist_ok=True)
    case = out / f"{name}.toml"
    model = {"name": "lin_backlash", "known": KNOWN, "estimate": PRIORS}
    dump_case({"title": f"Oscillator with backlash: {name}", "model": model}, case)
    plan = SamplingPlan(ess=campaign.ess)
    design = Design(case.absolute(), campaign.bench, campaign.hide, campaign.terms, campaign.route, plan, seed)
    with tqdm(desc=name, unit=" machines", leave=False, file=sys.stderr) as bar:

        def say(done: int, of: int) -> None:
            bar.total, bar.n = of, done
            bar.refresh()

        return run_calibration(design, folder, machines=machines or campaign.machines, jobs=jobs, say=say).summary


def lines(name: str, summary: CalibrationSummary) -> list[str]:
    lost = len(summary.unconverged) + len(summary.failed)
    told = []
    for parameter, row in summary.parameters.items():
        covered = [f"{c.inside} of {c.of} ({c.low}-{c.high})" for c in row.coverage.values()]
        tests = ["-" if math.isnan(p) else f"{p:.2g}" for p in (row.chi2_p, row.ecdf_p)]
        cells = [
            name,
            parameter,
            *covered,
            *tests,
            f"{row.rms_z:.2f}",
            f"{row.median_relative_sd:.2g}",
            str(lost),
        ]
        told.append(f"| {' | '.join(cells)} |")
    return told


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--only", action="append", choices=list(CAMPAIGNS))
    parser.add_argument("--machines", type=int, default=0, help="instead of the number of each campaign")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument(
        "--seed", type=int, default=0, help="other machines: drawn by another seed, in a folder of its own"
    )
    args = parser.parse_args()
    begin = time.perf_counter()
    table, said = [], []
    for name in args.only or CAMPAIGNS:
        content = run(name, args.out, args.machines, args.jobs, args.seed)
        table += lines(name, content)
        said += [f"- {name}: {sentence}" for sentence in content.says]
    print(f"| {' | '.join(HEAD)} |", f"|{'---|' * len(HEAD)}", *table, "", *said, sep="\n")
    print(f"\n{time.perf_counter() - begin:.0f} s")


if __name__ == "__main__":
    main()
