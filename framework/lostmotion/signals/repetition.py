"""The number of independent cycles in a recording, and the repetition of one part by another.

A cycle that is recorded a hundred times is one cycle with less noise, and the prediction of the same cycle is no new
test. Two parts count as the same motion where they agree to within the noise and `SAME` of the variance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar
from scipy.signal import fftconvolve

Array = NDArray[np.float64]
SAME = 0.99
"""Parts that agree in this share of their variance, without noise, are one motion: they differ by a tenth (rms)."""
LOUD = 0.1
"""With noise above this share of the variance there is no result: similarity cannot be determined."""
SHORTEST = 6.0
"""The least number of samples per cycle: with fewer, interpolation is not accurate."""
MULTIPLES = 8
"""The greatest number of periods of the drive after which a motion may repeat."""
MOST_CYCLES, POINTS = 300, 100
"""The greatest number of cycles that are compared, evenly spread over the recording, and of points in each."""
TRIED = 8
"""The number of best integer offsets that are refined between the samples."""
ERRORS = 2.0
"""A difference may exceed the mean square of the noise by this many of its standard errors."""


@dataclass(frozen=True)
class Repetition:
    """The cycles of a recording: `period` in samples, the number of `cycles`, and their similarity.

    `share` is the share of the variance, without noise, of the mean cycle (0 to 1). `distinct` is the effective
    number of distinct cycles: 1 where all agree to within the noise, `cycles` where all differ.
    """

    period: float
    cycles: int
    share: float
    distinct: float


def repetition_of(x: Array, noise: float, period: float | None = None) -> Repetition | None:
    """Return how the cycles of a series `x` (n,) differ; `noise` is the standard deviation of white noise in it.

    `period` (samples) is that of the drive; where it is None, the period of the motion is searched.
    `distinct` is the diversity of order 2 that allows for similarity (Leinster, Cobbold 2012, Ecology 93, 477-489).
    None where there are fewer than two cycles, too much noise, or no period.
    """
    if not _has_motion(x, noise):
        return None
    cycle = period_found(x, noise) if period is None else period
    if cycle is None or cycle < SHORTEST or len(x) - 1 < 2.0 * cycle:
        return None
    table = cycles_of(x, cycle)
    differs = float(np.mean(np.var(table, axis=0, ddof=1))) - noise**2
    whole = max(float(np.var(x)) - noise**2, 1e-300)
    count = int((len(x) - 1) // cycle)
    share = float(np.clip(1.0 - differs / whole, 0.0, 1.0))
    return Repetition(float(cycle), count, share, _count_distinct(table, noise, whole, count))


def cycles_of(x: Array, period: float) -> Array:
    """Return whole cycles (cycles, points) of a series (n,), at the same phases; a regular selection of many cycles."""
    count = int((len(x) - 1) // period)
    points = int(np.clip(round(period), SHORTEST, POINTS))
    chosen = np.unique(np.linspace(0, count - 1, min(count, MOST_CYCLES)).round())
    at = (chosen[:, None] + np.arange(points)[None, :] / points) * period
    return np.asarray(CubicSpline(np.arange(len(x)), x)(at), dtype=float)


def _count_distinct(table: Array, noise: float, whole: float, count: int) -> float:
    """Return the effective number of distinct cycles among `count`, of which `table` (cycles, points) is a selection.

    The similarity of two cycles is exp(-d), with d their mean squared difference beyond the noise over the tolerance.
    """
    squares = np.sum(table**2, axis=1)
    apart = (squares[:, None] + squares[None, :] - 2.0 * table @ table.T) / (2.0 * table.shape[1])
    excess = np.maximum(apart - noise**2 * (1.0 + ERRORS * math.sqrt(2.0 / table.shape[1])), 0.0)
    alike = np.exp(-excess / ((1.0 - SAME) * whole))
    pairs = len(table) * (len(table) - 1)
    mean = (float(alike.sum()) - float(np.trace(alike))) / pairs
    return count / (1.0 + (count - 1) * mean)


def period_found(x: Array, noise: float, drive: float | None = None) -> float | None:
    """Return the number of samples after which a motion `x` (n,) repeats; None where it does not within half of it.

    With the period of the `drive` (samples) only its first multiples are tried; otherwise each lag at which the squared
    difference has a minimum (de Cheveigne, Kawahara 2002, J. Acoust. Soc. Am. 111, 1917-1930).
    """
    if not _has_motion(x, noise):
        return None
    spline = CubicSpline(np.arange(len(x)), x)
    tried = [k * drive for k in range(1, MULTIPLES + 1)] if drive else _find_dips(x, noise)
    for lag in tried:
        if lag > 0.5 * (len(x) - 1):
            return None
        near = lag if drive else _refine_lag(spline, lag)
        if _is_same(x, spline, near, noise):
            return near if drive else _refine_period(x, spline, near)
    return None


def _find_dips(x: Array, noise: float) -> list[float]:
    """Return the lags (samples) at which a series may repeat, the shortest first."""
    half = len(x) // 2
    gap = _squared_differences(x[:half], x)[: half + 1] / half
    whole = float(np.var(x))
    dips = np.flatnonzero((gap[1:-1] <= gap[:-2]) & (gap[1:-1] < gap[2:])) + 1
    left = np.flatnonzero(gap > whole)
    first = max(int(left[0]) if len(left) else half, math.ceil(SHORTEST))
    deep = [int(lag) for lag in dips if lag >= first and gap[lag] < 2.0 * noise**2 + 0.3 * whole]
    return [float(lag) for lag in deep[: 4 * TRIED]]


def _squared_differences(piece: Array, x: Array) -> Array:
    """Return the sum of squared differences (n - m + 1,) between `piece` (m,) and each part of `x` (n,) as long."""
    middle = float(np.mean(x))
    a, b = piece - middle, x - middle
    sums = np.concatenate([[0.0], np.cumsum(b**2)])
    both = fftconvolve(b, a[::-1], mode="valid")
    gaps = float(a @ a) + sums[len(a) :] - sums[: len(sums) - len(a)] - 2.0 * both
    return np.asarray(np.maximum(gaps, 0.0), dtype=float)


def _half_difference(spline: CubicSpline, lag: float) -> float:
    """Return half the mean squared difference between a series and itself `lag` samples later."""
    t = np.arange(spline.x[-1] - lag)
    return 0.5 * float(np.mean((spline(t + lag) - spline(t)) ** 2))


def _refine_lag(spline: CubicSpline, lag: float, reach: float = 1.0) -> float:
    found = minimize_scalar(
        lambda at: _half_difference(spline, at), bounds=(lag - reach, lag + reach), method="bounded"
    )
    return float(found.x)


def _is_same(x: Array, spline: CubicSpline, lag: float, noise: float) -> bool:
    spread = noise**2 * (1.0 + ERRORS * math.sqrt(2.0 / len(x)))
    return _half_difference(spline, lag) < spread + (1.0 - SAME) * float(np.var(x))


def _refine_period(x: Array, spline: CubicSpline, period: float) -> float:
    """Return a period with an accuracy of a small share of a sample.

    The number of cycles is doubled up to half the series; then the scatter of all cycles about their mean is minimised
    (Stellingwerf 1978, Astrophys. J. 224, 953-960), since a lag between samples smooths the noise of a pair.
    """
    count, last = 2, float(spline.x[-1])
    while count * period < 0.5 * last:
        period = _refine_lag(spline, count * period, 0.5) / count
        count *= 2
    reach = 2.0 * period / last
    spread = minimize_scalar(
        lambda at: float(np.mean(np.var(cycles_of(x, at), axis=0))),
        bounds=(period - reach, period + reach),
        method="bounded",
    )
    return float(spread.x)


def repeated_share(known: Array, new: Array, noise: float) -> float | None:
    """Return the share of the variance of `new` (m,) that is repeated from some part of `known` (n,), 0 to 1.

    `noise` is the standard deviation of white noise in both, whose effect is removed. The best part may begin between
    two samples. Where `new` is longer than half of `known`, its first part is compared. None where there is too much
    noise, or no motion.
    """
    piece = new[: max(len(known) // 2, 1)] if len(new) > len(known) // 2 else new
    if len(piece) < 2.0 * SHORTEST or not (_has_motion(known, noise) and _has_motion(piece, noise)):
        return None
    gaps = _squared_differences(piece, known)
    spline, t = CubicSpline(np.arange(len(known)), known), np.arange(len(piece))

    def gap(at: float) -> float:
        return float(np.mean((spline(np.clip(t + at, 0.0, len(known) - 1.0)) - piece) ** 2))

    best = float(gaps.min()) / len(piece)
    for start in _find_minima(gaps):
        best = min(best, float(minimize_scalar(gap, bounds=(start - 1.0, start + 1.0), method="bounded").fun))
    differs = max(best - 2.0 * noise**2, 0.0)
    return float(np.clip(1.0 - differs / max(float(np.var(piece)) - noise**2, 1e-300), 0.0, 1.0))


def _find_minima(gaps: Array) -> list[int]:
    """Return the indices of the deepest minima."""
    inner = np.flatnonzero((gaps[1:-1] <= gaps[:-2]) & (gaps[1:-1] < gaps[2:])) + 1
    places = np.concatenate([[0, len(gaps) - 1], inner])
    return [int(k) for k in places[np.argsort(gaps[places], kind="stable")][:TRIED]]


def _has_motion(x: Array, noise: float) -> bool:
    """Return whether a series has a motion above the noise, and no gaps."""
    whole = float(np.var(x)) if len(x) else 0.0
    return math.isfinite(whole) and whole > 0.0 and noise**2 < LOUD * whole
