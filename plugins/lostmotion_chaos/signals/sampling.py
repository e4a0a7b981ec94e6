"""Detection of sampling that is commensurate with the drive, and resampling to an incommensurate grid.

With an integer number of samples per period, a recording of a driven machine is a set of Poincare sections. Neighbours
at small distances then have the same phase, and the slope there is the dimension of the section, not of the flow.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from lostmotion.errors import DataError

Array = NDArray[np.float64]
GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
"""The golden ratio, the number that is farthest from all fractions with small denominators."""
MOST = 8
"""Sections up to this many periods apart count as the same phase."""
TOLERANCE = 1e-3
"""A period this close (samples) to a fraction is commensurate, for any length of the recording."""
FEWEST = 4.0
"""The least number of samples per period for interpolation."""
DEGREE = 5


class Locked(NamedTuple):
    """A commensurate sampling: `samples` in every `periods` of the drive, with an error of `off` samples per period."""

    samples: int
    periods: int
    off: float

    def __str__(self) -> str:
        every = "a period" if self.periods == 1 else f"in {self.periods} periods"
        return f"{self.samples} samples {every} of the drive"


def commensurate(period: float, dt: float, n: int, *, most: int = MOST) -> Locked | None:
    """Return how `n` samples every `dt` s are commensurate with a drive of `period` s, or None where they are not.

    They are when the sampled phases of the drive repeat after at most `most` periods: the drift over the recording is
    smaller than the distance of two of these phases, or the period is within 1e-3 samples of a fraction.
    """
    if not (math.isfinite(period) and math.isfinite(dt) and period > 0.0 and dt > 0.0):
        raise DataError(f"the period is {period:g} s and the sampling step {dt:g} s: both must be positive")
    each = period / dt
    for periods in range(1, most + 1):
        samples = round(each * periods)
        off = each - samples / periods
        if samples < 1 or 3 * samples > n:
            return None
        if abs(off) < max(TOLERANCE / periods, each / (2.0 * periods * n)):
            return Locked(samples, periods, off)
    return None


def golden_step(period: float, dt: float) -> float:
    """Return a step (s) a little longer than `dt` so that no multiple of the drive period is on the grid."""
    each = period / dt
    if each < FEWEST:
        raise DataError(
            f"{each:.3g} samples per period are too few for interpolation, and {FEWEST:g} are needed: sample faster"
        )
    return period / (math.floor(each - GOLDEN) + GOLDEN if each % 1.0 != GOLDEN else each)


def resampled(x: Array, dt: float, step: float) -> Array:
    """Return the series `x` (n,), sampled every `dt` s, at multiples of `step` s, by a spline of degree 5."""
    if not step > 0.0:
        raise DataError(f"the step is {step:g} s: give a positive one")
    if len(x) <= DEGREE:
        raise DataError(f"{len(x)} samples are too few for a spline of degree {DEGREE}: record longer")
    reach = (len(x) - 1) * dt
    times = step * np.arange(int(reach / step + 1e-9) + 1)
    spline = make_interp_spline(np.arange(len(x)), x, k=DEGREE)
    return np.asarray(spline(np.minimum(times / dt, len(x) - 1.0)), dtype=np.float64)


def unlocked(x: Array, dt: float, period: float) -> tuple[Array, float, Locked | None]:
    """Return series, step (s) and the finding; the series is resampled where the sampling is commensurate."""
    found = commensurate(period, dt, len(x))
    if found is None or period / dt < FEWEST:
        return x, dt, found
    step = golden_step(period, dt)
    return resampled(x, dt, step), step, found
