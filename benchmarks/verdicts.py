"""How often the verdict of `analyse` is right, over series whose nature is known: a table, one line to each series.

python benchmarks/verdicts.py [--records 3] [--samples 10000] [--first 0] [--only WORD]
"""

from __future__ import annotations

import argparse
import time
from collections import Counter

import numpy as np

from lostmotion.registry import default
from lostmotion.workflow.analyse import Analysis, Request, analyse
from lostmotion.workflow.source import Source
from zoo import Animal, zoo


def verdict(animal: Animal, seed: int, told: bool) -> Analysis:
    """Return what the chain makes of one series; `told` gives it the period of the drive."""
    x = animal.draw(np.random.default_rng(seed))
    source = Source(animal.name, x, animal.dt, "", "x", None, {})
    return analyse(source, default(), Request(seed=seed, period=animal.period if told else None))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--records", type=int, default=3)
    parser.add_argument("--samples", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--only", default="")
    parser.add_argument("--told", action="store_true", help="give the period of the drive")
    args = parser.parse_args()
    right = total = 0
    for animal in zoo(args.samples):
        if args.only not in animal.name:
            continue
        begin = time.perf_counter()
        found = [verdict(animal, args.first + k, args.told) for k in range(args.records)]
        spent = (time.perf_counter() - begin) / args.records
        said = Counter(a.verdict.motion for a in found)
        right, total = right + said[animal.nature], total + args.records
        words = ", ".join(f"{n} {motion}" for motion, n in said.most_common())
        print(f"{animal.name:<26} {animal.nature:<14} {words:<40} {spent:5.1f} s", flush=True)
    print(f"right: {right} of {total}")


if __name__ == "__main__":
    main()
