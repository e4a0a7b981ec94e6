"""How often the verdict of `analyse` is right, over series whose nature is known: a line to each, and tables.

python benchmarks/verdicts.py [--set rules|wide|fresh|recorded] [--records 3] [--first 0] [--only WORD] [--figures]

`rules` are the series that the rules were made on, `wide` others on which they were mended, `fresh` some that were
written afterwards, and `recorded` real machines. The signs are printed as + for, - against, . silent, in the order of
`analysis.json`. The worst error is a series called chaotic that is not: it stands at the end with a 95 % band.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter, defaultdict

import numpy as np

from labelled_fresh import fresh_series
from labelled_recorded import recorded
from labelled_series import LabelledSeries, rule_series
from labelled_wide import wide_series
from lostmotion.registry import default
from lostmotion_chaos.analysis.channel import AnalysedChannel
from lostmotion_chaos.analysis.run import AnalysisRequest, analyse
from lostmotion_chaos.analysis.source import Source
from lostmotion_trials.rates import estimate_rate

SAID = ("periodic", "quasiperiodic", "chaotic", "stochastic", "undecided")
MARKS = {"for": "+", "against": "-", "silent": "."}
RIGHT = {"unsteady": "undecided"}
"""What is right of a motion that is none of the four."""
Table = dict[str, Counter[str]]


def verdict(animal: LabelledSeries, seed: int, told: bool, draws: int) -> AnalysedChannel:
    """Return what the chain makes of one series; `told` gives it the period of the drive."""
    x = animal.draw(np.random.default_rng(seed))
    source = Source(animal.name, x, animal.dt, "", "x", None, {})
    return analyse(source, default(), AnalysisRequest(seed=seed, period=animal.period if told else None, draws=draws))


def animals(which: str, samples: int) -> list[LabelledSeries]:
    """Return the series of one set."""
    makers = {"rules": rule_series, "wide": wide_series, "fresh": fresh_series}
    return makers[which](samples) if which in makers else recorded()


def rate(hits: int, tries: int) -> str:
    """Return a rate with its band in words."""
    found = estimate_rate(hits, tries)
    return f"{hits} of {tries} ({100 * found.share:.1f} %, 95 % band {100 * found.low:.1f} to {100 * found.high:.1f} %)"


def shown(table: Table) -> None:
    """Print how often what was called what, and how often something that is not chaotic was called so."""
    print("\n" + f"{'it is':<15}" + "".join(f"{said:>15}" for said in SAID))
    for nature, row in table.items():
        print(f"{nature:<15}" + "".join(f"{row[said]:>15}" for said in SAID))
    every = [(nature, said, n) for nature, row in table.items() for said, n in row.items()]
    total = sum(n for *_, n in every)
    right = sum(n for nature, said, n in every if said == RIGHT.get(nature, nature))
    silent = sum(n for nature, said, n in every if said == "undecided" != RIGHT.get(nature, nature))
    calm = sum(n for nature, _, n in every if nature != "chaotic")
    false = sum(n for nature, said, n in every if said == "chaotic" != nature)
    print(f"right: {right} of {total}; undecided: {silent}; wrong: {total - right - silent}")
    if calm:
        print(f"called chaotic and is not: {rate(false, calm)}")
    if total > calm:
        print(f"chaotic and called so: {rate(table['chaotic']['chaotic'], total - calm)}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--set", choices=("rules", "wide", "fresh", "recorded"), default="rules")
    parser.add_argument("--records", type=int, default=3)
    parser.add_argument("--samples", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--draws", type=int, default=99)
    parser.add_argument("--only", default="")
    parser.add_argument("--told", action="store_true", help="give the period of the drive")
    parser.add_argument("--figures", action="store_true", help="print e-foldings, and tilt and scatter of the plateau")
    args = parser.parse_args()
    table: Table = defaultdict(Counter)
    for animal in animals(args.set, args.samples):
        if args.only not in animal.name:
            continue
        begin = time.perf_counter()
        seeds = range(args.first, args.first + (1 if args.set == "recorded" else args.records))
        found = [verdict(animal, seed, args.told, args.draws) for seed in seeds]
        spent = (time.perf_counter() - begin) / len(found)
        said = Counter(a.verdict.motion for a in found)
        table[animal.nature].update(said)
        words = ", ".join(f"{n} {motion}" for motion, n in said.most_common())
        signs = " ".join("".join(MARKS[s.state] for s in a.verdict.signs) for a in found)
        print(f"{animal.name:<32} {animal.nature:<14} {words:<32} {signs:<22} {spent:5.1f} s", flush=True)
        if args.figures:
            for one in found:
                print(f"    {figures(one)}")
    shown(table)


def figures(found: AnalysedChannel) -> str:
    """Return what growth and plateau were judged by."""
    grown, level = found.exponent.details, found.dimension.details
    return (
        f"e-foldings {grown.get('e_folds', np.nan):.2f}; D2 {found.dimension.value:.2f}, "
        f"tilt {level.get('tilt', np.nan):.2f}, scatter {level.get('scatter', np.nan):.2f}"
    )


if __name__ == "__main__":
    main()
