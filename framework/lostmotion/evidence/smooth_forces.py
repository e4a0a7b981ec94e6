"""The smooth forces of a model discrepancy: Gaussian processes of reduced rank, of one of several sizes and lengths.

A constant force, a stiffness and a damping have names. So a smooth force has no constant and no straight line
(`LearnedTerm.plain`), or it has both at the log odds against the terms of these forms. Its size is its standard
deviation along the recorded motion.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.inference.learned import LearnedTerm, OverPhase, OverPosition, OverTime, OverVelocity, compute_spread
from lostmotion.likelihood.system import key_of

SMOOTH = (OverPosition, OverVelocity, OverTime, OverPhase)
SIZES = (0.005, 0.015, 0.05, 0.15)
"""Standard deviations of a smooth force, in units of the drive, as real machines have."""
LARGE = (*SIZES, 0.5, 1.5)
"""Those of an unknown force, which is larger than the usual discrepancy. One over the phase of the drive has the usual
sizes: a larger one beside a strong damping prescribes the motion, and seems to predict what the drive does not tell."""
LINED = SIZES[-1]
"""The smallest size of a force that may have a constant and a line: small ones tell no law, and share one."""
LENGTHS = (0.15, 0.3, 0.6, 1.2)
"""Correlation lengths of a smooth force, in half widths of the range."""
MOST_WAVES = 20
"""The largest number of waves of a smooth force: shorter waves have no weight at these correlation lengths."""


@dataclass(frozen=True)
class SmoothForce:
    """The coefficients of one smooth force: its key, its coordinates, and the prior widths (options, count).

    `sizes` (options,) are the standard deviations of the force (N or N m). `straight` (options,) is the number of
    constants and straight lines that it may have, `bent` (options, sizes) the options of the same length and each of
    `SIZES` without any, or itself where it has none. `lines` are the coordinates of its constant and its straight line.
    """

    key: str
    columns: slice
    options: Array
    sizes: Array
    straight: Array
    bent: NDArray[np.intp]
    lines: slice


def make_smooth_force(term: LearnedTerm, first: int, size: float, sizes: Sequence[float]) -> SmoothForce:
    """Return the force of a curve whose coefficients begin at coordinate `first`; `size` is a coefficient of the drive.

    It has `USUAL_OPTIONS`, and then those of larger ones among the `sizes`.
    """
    count = min(term.count, MOST_WAVES + term.plain)
    larger = [] if isinstance(term, OverPhase) else sizes[len(SIZES) :]
    made = [option for part in (SIZES, larger) for option in _list_options(part)]
    spreads = [
        compute_spread(term, length)[:count] if lined else term.bent_spread(length, count) for _, length, lined in made
    ]
    options = size * np.array([share * spread for (share, _, _), spread in zip(made, spreads, strict=True)])
    straight = np.array([term.plain * lined for _, _, lined in made], dtype=float)
    bent = np.array(
        [[made.index((other if lined else share, length, False)) for other in SIZES] for share, length, lined in made]
    )
    sizes_of, lines = size * np.array([share for share, _, _ in made]), slice(first, first + term.plain)
    return SmoothForce(key_of(term), slice(first, first + count), options, sizes_of, straight, bent, lines)


def _list_options(sizes: Sequence[float]) -> list[tuple[float, float, bool]]:
    """Return the size and the length of each option, and whether it has a constant and a line."""
    bent = [(share, length, False) for share in sizes for length in LENGTHS]
    return bent + [(share, length, True) for share in sizes if share >= LINED for length in LENGTHS]


USUAL_OPTIONS = len(_list_options(SIZES))
"""The number of options of a force of the usual sizes; those of larger forces come after them."""
