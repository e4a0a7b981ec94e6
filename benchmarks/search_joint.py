"""Where the stand-in for the experiment gets its parameters from: which joints are chaotic at the right levels?

Tjahjowidodo, Al-Bender and Van Brussel (2007), Table 2: a robot joint with about 1.5 degrees of backlash, moved at
1.54 Hz, is periodic at 1.34 and 2.07 degrees, chaotic from 2.68 to 3.78 (1.3 to 1.8 bit/s) and periodic at 4.87 and
5.73. Inertia, damping and stiffness were not published. A link without weight, normalised by its inertia, leaves two
numbers: the ratio r of the drive's frequency to omega_0 = sqrt(k0 / m), and 2 zeta = c / sqrt(k0 m). Both are searched
on a grid, at all eight levels and from several starts, with the exact flow; the best few are searched again close by.
Chaos must be visible: see `SEEN`.

    python benchmarks/search_joint.py             some minutes; `--quick` for a look
"""

from __future__ import annotations

import argparse
import math
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array
from lostmotion.kernels.threads import spread
from lostmotion.registry import default
from lostmotion_chaos.flows.flow import flow_of

OMEGA = 2.0 * math.pi * 1.54
LEVELS = np.array([1.34, 2.07, 2.68, 3.41, 3.65, 3.78, 4.87, 5.73])
PAPER = np.array([0.0, 0.0, 1.423, 1.322, 1.533, 1.802, 0.0, 0.0])
CHAOTIC = PAPER > 0.0
LEAST = 0.1
"""Exponents (bit/s) below which a motion counts as periodic."""
SEEN = 0.05
"""What of the output, as a share of the input, shall at least not repeat itself where there is chaos: an encoder with
one per cent of noise must be able to see it, as theirs did."""


class Tried(NamedTuple):
    """A joint: r, 2 zeta, half backlash (degrees); exponents (levels, starts) in bit/s.

    `scatter` (levels, starts) is the standard deviation of the angle at phase 0 over the amplitude of the input.
    """

    ratio: float
    damping: float
    half: float
    exponents: Array
    scatter: Array

    @property
    def seen(self) -> float:
        """The least scatter at the chaotic levels."""
        return float(self.scatter[CHAOTIC].mean(axis=1).min())

    @property
    def right(self) -> float:
        """The number of levels that agree with Table 2, each counted by the share of its starts."""
        return float(np.mean((self.exponents > LEAST) == CHAOTIC[:, None], axis=1).sum())

    @property
    def off(self) -> float:
        """The rms distance (bit/s) of the exponents at the chaotic levels from those of Table 2."""
        return float(np.sqrt(np.mean((self.exponents[CHAOTIC].mean(axis=1) - PAPER[CHAOTIC]) ** 2)))


def try_place(ratio: float, damping: float, half: float, *, starts: int, periods: int, transient: int) -> Tried:
    """Return the exponents of a joint at all levels from some starts."""
    model, natural = default().make("model", "robot_joint"), OMEGA / ratio
    values = {"m": 1.0, "c": damping * natural, "k0": natural**2, "x0": math.radians(half), "mgl": 0.0}
    rng = np.random.default_rng(1)
    found, scatter = np.full((2, len(LEVELS), starts), np.nan)
    for row, level in enumerate(np.radians(LEVELS)):
        flow = flow_of(model, values, drive=(float(level), OMEGA))
        for column in range(starts):
            place = np.array([level, 0.0]) + level * np.array([1.0, OMEGA]) * rng.uniform(-1.0, 1.0, 2)
            orbit = flow.strobe(place, periods=transient + periods, tangents=1)
            found[row, column] = orbit.growth[transient:, 0].mean() / flow.period / math.log(2.0)
            scatter[row, column] = orbit.states[transient:, 0].std() / level
    return Tried(ratio, damping, half, found, scatter)


def search_places(places: list[tuple[float, float, float]], **effort: int) -> list[Tried]:
    """Return all places tried, the best first."""
    found: list[Tried | None] = [None] * len(places)

    def work(begin: int, end: int) -> None:
        for k in range(begin, end):
            found[k] = try_place(*places[k], **effort)

    spread(work, len(places), slices=len(places))
    return sorted((one for one in found if one), key=lambda one: (-round(one.right, 1), one.seen < SEEN, one.off))


def draw_near(one: Tried, rng: np.random.Generator, many: int, reach: float) -> list[tuple[float, float, float]]:
    """Return places close to one; the backlash is only known as about 1.5 degrees."""
    scale = np.exp(reach * rng.standard_normal((many, 2)))
    half = rng.uniform(0.7, 0.8, many)
    return [(one.ratio * a, one.damping * b, h) for (a, b), h in zip(scale, half, strict=True)]


def print_places(found: list[Tried], many: int) -> None:
    for one in found[:many]:
        levels = " ".join(f"{x:6.2f}" for x in one.exponents.mean(axis=1))
        print(
            f"r {one.ratio:.4f} 2zeta {one.damping:.4f} x0 {one.half:.4f}: {one.right:.2f} of 8, "
            f"off {one.off:.2f} bit/s, seen {one.seen:.3f} | {levels}", flush=True,
        )  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="a coarse grid, and no second look")
    quick = parser.parse_args().quick
    ratios = np.geomspace(0.05, 1.2, 24 if quick else 96)
    dampings = np.geomspace(0.01, 0.6, 12 if quick else 40)
    grid = [(float(r), float(d), 0.75) for r in ratios for d in dampings]
    found = search_places(grid, starts=2, periods=150, transient=100)
    print_places(found, 30)
    rng = np.random.default_rng(2)
    for reach, starts, periods in ((0.03, 4, 300), (0.01, 8, 1000), (0.004, 12, 2000)):
        if quick:
            break
        print(f"within {reach:g} of the best, {starts} starts, {periods} periods")
        places = [p for one in found[:8] for p in [(one.ratio, one.damping, one.half), *draw_near(one, rng, 24, reach)]]
        found = search_places(places, starts=starts, periods=periods, transient=200)
        print_places(found, 8)


if __name__ == "__main__":
    main()
