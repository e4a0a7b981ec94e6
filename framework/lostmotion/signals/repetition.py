"""How many independent looks a recording has: whether its cycles are distinct, and whether a stretch repeats another.

A cycle that is recorded a hundred times is one cycle with less noise, and a prediction of the same cycle again tests
nothing new. Two stretches count as the same motion where they agree to within the noise and `SAME` of the variance.
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
"""Stretches that agree in this share of their variance, noise apart, are one motion: they differ by a tenth (rms)."""
LOUD = 0.1
"""With noise of more than this share of the variance nothing is said: neither likeness nor difference can be seen."""
SHORTEST = 6.0
"""Samples in a cycle at the least: with fewer, interpolation between them is not to be trusted."""
MULTIPLES = 8
"""A motion may repeat after up to so many periods of the drive."""
MOST_CYCLES, POINTS = 300, 100
"""Cycles that are compared with one another, evenly spread over the recording, and points of each."""
TRIED = 8
"""Offsets of the best match to a whole sample that are tried between the samples."""
ERRORS = 2.0
"""Standard errors of the mean square of the noise that a difference may exceed it by."""


@dataclass(frozen=True)
class Repetition:
    """The cycles of a recording: `period` in samples, how many `cycles` there are, and how alike they are.

    `share` is the share of the variance, noise apart, that is the mean cycle (0 to 1). `distinct` is the effective
    number of distinct cycles: 1 where all agree to within the noise, `cycles` where all differ.
    """

    period: float
    cycles: int
    share: float
    distinct: float


def repetition_of(x: Array, noise: float, period: float | None = None) -> Repetition | None:
    """Return how the cycles of a series `x` (n,) differ; `noise` is the standard deviation of white noise in it.

    `period` (samples) is that of the drive, or None where it has none: then the period of the motion is looked for.
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
    return Repetition(float(cycle), count, share, _distinct(table, noise, whole, count))


def cycles_of(x: Array, period: float) -> Array:
    """Return whole cycles (cycles, points) of a series (n,), at the same phases each; of many an even choice."""
    count = int((len(x) - 1) // period)
    points = int(np.clip(round(period), SHORTEST, POINTS))
    chosen = np.unique(np.linspace(0, count - 1, min(count, MOST_CYCLES)).round())
    at = (chosen[:, None] + np.arange(points)[None, :] / points) * period
    return np.asarray(CubicSpline(np.arange(len(x)), x)(at), dtype=float)


def _distinct(table: Array, noise: float, whole: float, count: int) -> float:
    """Return the effective number of distinct cycles among `count`, of which `table` (cycles, points) is a choice.

    Likeness of two cycles falls from 1 by the square of what they differ beyond the noise, over what passes as alike.
    """
    squares = np.sum(table**2, axis=1)
    apart = (squares[:, None] + squares[None, :] - 2.0 * table @ table.T) / (2.0 * table.shape[1])
    excess = np.maximum(apart - noise**2 * (1.0 + ERRORS * math.sqrt(2.0 / table.shape[1])), 0.0)
    alike = np.exp(-excess / ((1.0 - SAME) * whole))
    pairs = len(table) * (len(table) - 1)
    mean = (float(alike.sum()) - float(np.trace(alike))) / pairs
    return count / (1.0 + (count - 1) * mean)


def period_found(x: Array, noise: float, drive: float | None = None) -> float | None:
    """Return after how many samples a motion `x` (n,) repeats itself, None where it does not within half of it.

    With the period of the `drive` (samples) only its first multiples are tried. Otherwise each lag at which the
    squared difference has a minimum (de Cheveigne, Kawahara 2002, J. Acoust. Soc. Am. 111, 1917-1930) is.
    """
    if not _has_motion(x, noise):
        return None
    spline = CubicSpline(np.arange(len(x)), x)
    tried = [k * drive for k in range(1, MULTIPLES + 1)] if drive else _dips(x, noise)
    for lag in tried:
        if lag > 0.5 * (len(x) - 1):
            return None
        near = lag if drive else _nearest(spline, lag)
        if _agrees(x, spline, near, noise):
            return near if drive else _sharpened(x, spline, near)
    return None


def _dips(x: Array, noise: float) -> list[float]:
    """Return the lags (samples) at which a series may repeat itself, the shortest first."""
    half = len(x) // 2
    gap = _gaps(x[:half], x)[: half + 1] / half
    whole = float(np.var(x))
    dips = np.flatnonzero((gap[1:-1] <= gap[:-2]) & (gap[1:-1] < gap[2:])) + 1
    left = np.flatnonzero(gap > whole)
    first = max(int(left[0]) if len(left) else half, math.ceil(SHORTEST))
    deep = [int(lag) for lag in dips if lag >= first and gap[lag] < 2.0 * noise**2 + 0.3 * whole]
    return [float(lag) for lag in deep[: 4 * TRIED]]


def _gaps(piece: Array, x: Array) -> Array:
    """Return the sum of squared differences (n - m + 1,) between `piece` (m,) and each stretch of `x` (n,)."""
    middle = float(np.mean(x))
    a, b = piece - middle, x - middle
    sums = np.concatenate([[0.0], np.cumsum(b**2)])
    both = fftconvolve(b, a[::-1], mode="valid")
    gaps = float(a @ a) + sums[len(a) :] - sums[: len(sums) - len(a)] - 2.0 * both
    return np.asarray(np.maximum(gaps, 0.0), dtype=float)


def _unlike(spline: CubicSpline, lag: float) -> float:
    """Return half the mean squared difference between a series and itself `lag` samples later."""
    t = np.arange(spline.x[-1] - lag)
    return 0.5 * float(np.mean((spline(t + lag) - spline(t)) ** 2))


def _nearest(spline: CubicSpline, lag: float, reach: float = 1.0) -> float:
    found = minimize_scalar(lambda at: _unlike(spline, at), bounds=(lag - reach, lag + reach), method="bounded")
    return float(found.x)


def _agrees(x: Array, spline: CubicSpline, lag: float, noise: float) -> bool:
    spread = noise**2 * (1.0 + ERRORS * math.sqrt(2.0 / len(x)))
    return _unlike(spline, lag) < spread + (1.0 - SAME) * float(np.var(x))


def _sharpened(x: Array, spline: CubicSpline, period: float) -> float:
    """Return a period to a small share of a sample.

    First over twice as many cycles at a time, up to half the series; then where all cycles scatter least about their
    mean (Stellingwerf 1978, Astrophys. J. 224, 953-960), for a lag between samples smooths the noise of a pair.
    """
    count, last = 2, float(spline.x[-1])
    while count * period < 0.5 * last:
        period = _nearest(spline, count * period, 0.5) / count
        count *= 2
    reach = 2.0 * period / last
    spread = minimize_scalar(
        lambda at: float(np.mean(np.var(cycles_of(x, at), axis=0))),
        bounds=(period - reach, period + reach),
        method="bounded",
    )
    return float(spread.x)


def repeated_share(known: Array, new: Array, noise: float) -> float | None:
    """Return the share of the variance of `new` (m,) that some stretch of `known` (n,) shows as well, 0 to 1.

    `noise` is the standard deviation of white noise in both; what it makes differ does not count. The best stretch may
    begin between two samples. Where `new` is longer than half of `known` its first part is compared. None where there
    is too much noise, or no motion.
    """
    piece = new[: max(len(known) // 2, 1)] if len(new) > len(known) // 2 else new
    if len(piece) < 2.0 * SHORTEST or not (_has_motion(known, noise) and _has_motion(piece, noise)):
        return None
    gaps = _gaps(piece, known)
    spline, t = CubicSpline(np.arange(len(known)), known), np.arange(len(piece))

    def gap(at: float) -> float:
        return float(np.mean((spline(np.clip(t + at, 0.0, len(known) - 1.0)) - piece) ** 2))

    best = float(gaps.min()) / len(piece)
    for start in _lowest(gaps):
        best = min(best, float(minimize_scalar(gap, bounds=(start - 1.0, start + 1.0), method="bounded").fun))
    differs = max(best - 2.0 * noise**2, 0.0)
    return float(np.clip(1.0 - differs / max(float(np.var(piece)) - noise**2, 1e-300), 0.0, 1.0))


def _lowest(gaps: Array) -> list[int]:
    """Return the places of the deepest minima."""
    inner = np.flatnonzero((gaps[1:-1] <= gaps[:-2]) & (gaps[1:-1] < gaps[2:])) + 1
    places = np.concatenate([[0, len(gaps) - 1], inner])
    return [int(k) for k in places[np.argsort(gaps[places], kind="stable")][:TRIED]]


def _has_motion(x: Array, noise: float) -> bool:
    """Return whether a series has a motion that stands out of the noise, and no gaps."""
    whole = float(np.var(x)) if len(x) else 0.0
    return math.isfinite(whole) and whole > 0.0 and noise**2 < LOUD * whole
