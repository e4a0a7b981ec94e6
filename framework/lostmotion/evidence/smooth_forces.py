"""The smooth forces of a model discrepancy: Gaussian processes of reduced rank, of one of several sizes and lengths.

Forces of the usual size have no constant and no straight line (`LearnedTerm.plain`): a constant force, a stiffness and
a damping have names, and a smooth force that contains them would share them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.learned import LearnedTerm, OverPhase, OverPosition, OverTime, OverVelocity, compute_spread
from lostmotion.likelihood.system import key_of

SMOOTH = (OverPosition, OverVelocity, OverTime, OverPhase)
SIZES = (0.005, 0.015, 0.05, 0.15)
"""Standard deviations of a smooth force, in units of the drive, as real machines have."""
LARGE = (*SIZES, 0.5, 1.5)
"""Those of an unknown force, which is larger than the usual discrepancy. One over the phase of the drive has the usual
sizes: a larger one beside a strong damping prescribes the motion, and seems to predict what the drive does not tell."""
LENGTHS = (0.15, 0.3, 0.6, 1.2)
"""Correlation lengths of a smooth force, in half widths of the range."""
MOST_WAVES = 20
"""The largest number of waves of a smooth force: shorter waves have no weight at these correlation lengths."""


@dataclass(frozen=True)
class SmoothForce:
    """The coefficients of one smooth force: its key, its coordinates, and the prior widths (options, count).

    `straight` (options,) is the number of constants and straight lines that the force may have.
    """

    key: str
    columns: slice
    options: Array
    straight: Array


def make_smooth_force(term: LearnedTerm, first: int, size: float, sizes: Sequence[float]) -> SmoothForce:
    """Return the force of a curve whose coefficients begin at coordinate `first`; `size` is a coefficient of the drive.

    It has an option for each of the `sizes` and `LENGTHS` without a line, then for the larger ones with one.
    """
    count = min(term.count, MOST_WAVES + term.plain)
    shares = SIZES if isinstance(term, OverPhase) else sizes
    whole = np.array([s * size * compute_spread(term, length)[:count] for s in shares for length in LENGTHS])
    larger, bent = whole[len(SIZES) * len(LENGTHS) :], whole.copy()
    bent[:, : term.plain] = 0.0
    straight = np.repeat([0.0, float(term.plain)], [len(bent), len(larger)])
    return SmoothForce(key_of(term), slice(first, first + count), np.concatenate([bent, larger]), straight)
