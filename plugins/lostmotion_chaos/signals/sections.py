"""Sections of a motion at a phase of its drive or at a level, and the deviation of its return after k periods."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from lostmotion.errors import DataError

Array = NDArray[np.float64]
HYSTERESIS = 0.1
"""A series must fall below a level by this share of its standard deviation before it can cross it again."""


class Section(NamedTuple):
    """Points of a section: their times (s) and two delay coordinates in the unit of the series, all (hits,)."""

    time: Array
    first: Array
    second: Array

    @property
    def points(self) -> Array:
        """The two coordinates as (hits, 2)."""
        return np.column_stack([self.first, self.second])


def stroboscopic(x: Array, dt: float, period: float, *, phase: float = 0.0, lag: int = 1) -> Section:
    """Return x(t) and x(t + lag) once per period, at a `phase` in [0, 1) from the first sample of `x`.

    Where a period is not an integer number of samples, values are interpolated by a cubic spline.
    """
    _require_period(x, dt, period)
    last = (len(x) - 1 - lag) * dt
    if lag < 0 or last < phase * period:
        raise DataError(f"a lag of {lag} samples leaves nothing of {len(x)} samples: choose a shorter one")
    # Without this margin, rounding could lose the last point.
    count = math.floor((last / period - phase % 1.0) * (1.0 + 1e-12) + 1e-9) + 1
    time = (phase % 1.0 + np.arange(max(count, 0), dtype=np.float64)) * period
    return Section(time, _interpolate(x, time / dt), _interpolate(x, time / dt + lag))


def poincare(x: Array, *, dt: float, lag: int, level: float | None = None) -> Section:
    """Return x(t + lag) and x(t + 2 lag) at the times when `x` crosses a level upwards: a section of delay space.

    The default level is the mean. A series must fall a tenth of its standard deviation below the level before it can
    cross it again, so that noise causes no additional crossings.
    """
    if lag < 1 or len(x) <= 2 * lag + 1:
        raise DataError(f"a lag of {lag} samples leaves nothing of {len(x)} samples: give one from 1 to {len(x) // 3}")
    plane = float(np.mean(x)) if level is None else level
    where = _find_crossings(x[: len(x) - 2 * lag] - plane, HYSTERESIS * float(np.std(x)))
    return Section(where * dt, _interpolate(x, where + lag), _interpolate(x, where + 2 * lag))


def return_spread(x: Array, dt: float, period: float, *, most: int = 16, noise: float = 0.0) -> Array:
    """Return the rms of x(t + k period) - x(t) over that of x, for k = 1 ... `most`: (most,), NaN where x is too short.

    A motion that repeats every k periods has a spread near 0 at k and its multiples; uncorrelated parts have a spread
    of sqrt 2. Measurement noise of standard deviation `noise` is subtracted in the squares.
    """
    _require_period(x, dt, period)
    centred = x - np.mean(x)
    white = noise * noise
    power = max(float(centred @ centred) / len(x) - white, 0.0)
    shifts = period / dt * np.arange(1, most + 1)
    spline = CubicSpline(np.arange(len(x)), centred)
    squares = np.array([_mean_square(centred, spline, shift, white) for shift in shifts])
    if power <= 0.0:
        return np.full(most, np.nan)
    spread: Array = np.sqrt(np.maximum(squares, 0.0) / power)
    return spread


def _mean_square(x: Array, spline: CubicSpline, shift: float, white: float) -> float:
    """Return the mean square of x(t + shift) - x(t), minus the contribution of white noise of variance `white`."""
    rows = len(x) - math.ceil(shift - 1e-9)
    if rows < shift or rows < 2:
        return math.nan
    split = shift - math.floor(shift)
    difference = spline(np.minimum(np.arange(rows) + shift, len(x) - 1)) - x[:rows]
    return float(difference @ difference) / rows - white * (1.0 + _noise_share(split))


def _noise_share(split: float) -> float:
    """Return the share of the variance of white noise after cubic spline interpolation between two samples."""
    impulse = np.zeros(41)
    impulse[20] = 1.0
    weights = CubicSpline(np.arange(41), impulse)(np.arange(1, 40) + split)
    return float(weights @ weights)


def _find_crossings(height: Array, drop: float) -> Array:
    """Return where (fractional samples) a series rises through zero after it was below -`drop`."""
    rising = np.flatnonzero((height[:-1] < 0.0) & (height[1:] >= 0.0))
    below = np.concatenate([[0], np.cumsum(height < -drop)])
    # Of several rises without a fall between them, the first one counts.
    fresh = np.diff(below[rising + 1], prepend=0) > 0
    kept = rising[fresh]
    return kept + height[kept] / (height[kept] - height[kept + 1])


def _interpolate(x: Array, where: Array) -> Array:
    """Return the series at fractional samples by a cubic spline; at integer ones the samples themselves."""
    nearest = np.rint(where)
    if where.size == 0 or float(np.max(np.abs(where - nearest))) < 1e-9:
        return x[nearest.astype(np.intp)]
    values: Array = CubicSpline(np.arange(len(x)), x)(np.clip(where, 0, len(x) - 1))
    return values


def _require_period(x: Array, dt: float, period: float) -> None:
    if not (math.isfinite(period) and dt < period <= len(x) * dt):
        raise DataError(
            f"the period is {period:g} s: one between the sampling step ({dt:g} s) and the length of the series "
            f"({len(x) * dt:g} s) is needed"
        )
