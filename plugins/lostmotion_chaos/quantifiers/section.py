"""The correlation dimension of a model from its stroboscopic section, in its true states, without an embedding."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Flow, Quantifier
from lostmotion.results import Estimate
from lostmotion_chaos.quantifiers._kernels_section import CODES, compute_edges, count_pairs

_LEAST_PERIODS = 100
"""No dimension is read from fewer periods. Chosen by experience; no measurement recorded."""
_BLOCKS = 10
"""Parts of the orbit that are left out in turn to find the error of the slope."""
_LARGEST_RADIUS = 0.125
"""The largest radius, as a share of the range of the section: beyond it the ends of the section have an effect. Chosen
by experience; no measurement recorded."""
_LEAST_PAIRS = 300
"""At least so many pairs are within the smallest radius. Chosen by experience; no measurement recorded."""
_LEAST_RADII = 8
"""A line has at least so many radii, which are an eighth of an octave apart. Chosen by experience; no measurement
recorded."""
_MOST_PERIODS, _REPEAT_TOLERANCE = 32, 1e-5
"""A motion is periodic if it repeats within so many periods, to this share of its size."""
_MOST_BEND = 0.35
"""The largest difference of the slopes of the two halves, as a share of the slope, or of 0.5 if that is larger. Chosen
by experience; no measurement recorded."""


@dataclass(frozen=True)
class SectionDimension(Quantifier[Flow]):
    """Correlation dimension of the flow of a model: that of its stroboscopic section, plus one for the drive phase.

    All pairs of points of the section are counted in the space of the states, by the largest difference of a state
    over its range. The interval is that of leaving tenths of the orbit out in turn, and of the difference of the two
    halves of the line. A periodic motion has the dimension one. Without a drive the points are samples of the flow
    itself, and nothing is added. Curve: `radius`, `correlation_sum`.
    """

    periods: int = 2000
    transient: int = 200
    name: ClassVar[str] = "section_dimension"
    paper: ClassVar[str] = "Grassberger, Procaccia, Physica D 9 (1983) 189-208; on the section of Moon, Holmes (1985)"
    unit: ClassVar[str] = "1"
    reads = "flow"

    def estimate(self, data: Flow, *, rng: np.random.Generator) -> Estimate:
        begin = max(self.transient, 0)
        if self.periods < _LEAST_PERIODS:
            return Estimate.refused("too_short", f"{self.periods} periods are too few: follow {_LEAST_PERIODS} or more")
        orbit = data.strobe(data.start, periods=begin + self.periods, tangents=0)
        points = orbit.states[begin + 1 :]
        if not np.isfinite(points).all():
            status = orbit.status if orbit.status not in ("ok", "jumps") else "failed"
            return Estimate.refused(status, "The motion diverges, so it has no dimension.")
        more = 1.0 if data.driven else 0.0
        if data.driven and _is_periodic(points):
            says = "The motion repeats itself: it is a closed line."
            return Estimate(1.0, 1.0, 1.0, "ok", "1", {}, says, {"stderr": 0.0, "section": 0.0})
        return _read_dimension(_count_pairs(points), more)


def _is_periodic(points: Array) -> bool:
    """Return whether the last points (n, states) are those of some periods before."""
    tail = points[-3 * _MOST_PERIODS :]
    scale = _REPEAT_TOLERANCE * np.maximum(np.abs(tail).max(axis=0), 1e-300)
    off = np.abs(tail[-1] - tail[-1 - _MOST_PERIODS : -1][::-1]) <= scale
    return any(bool((np.abs(tail[k:] - tail[:-k]) <= scale).all()) for k in np.flatnonzero(off.all(axis=1)) + 1)


def _count_pairs(points: Array) -> NDArray[np.int64]:
    """Return the pairs of points (n, states) by block of either and code of distance, (blocks, blocks, CODES)."""
    span = np.ptp(points, axis=0)
    scaled = (points - points.min(axis=0)) / np.where(span > 0.0, span, 1.0)
    counts = np.zeros((_BLOCKS, _BLOCKS, CODES), np.int64)
    block = (np.arange(len(points)) * _BLOCKS) // len(points)
    count_pairs(np.ascontiguousarray(scaled, dtype=np.float32), 1, block, counts)
    return counts


def _read_dimension(counts: NDArray[np.int64], more: float) -> Estimate:
    """Return the estimate from the counted pairs."""
    radius, total = compute_edges()[1:], np.cumsum(counts.sum(axis=(0, 1)))[:-1]
    curve = {"radius": radius, "correlation_sum": total / max(int(counts.sum()), 1)}
    window = np.flatnonzero((radius <= _LARGEST_RADIUS) & (total >= _LEAST_PAIRS))
    if len(window) < _LEAST_RADII:
        says = "Too few points of the section are close to one another: follow more periods."
        return Estimate.refused("too_few_neighbours", says, curve=curve)
    x = np.log(radius[window])
    value, bend = _fit_slopes(x, total[window])
    spread = _jackknife_slope(x, counts, window)
    stderr = math.hypot(spread, 0.25 * bend)
    bent = abs(bend) > _MOST_BEND * max(value, 0.5)
    says = "The slope changes with the radius: there is no clear scaling region." if bent else ""
    details = {"stderr": stderr, "section": value, "bend": bend, "r_low": math.exp(x[0]), "r_high": math.exp(x[-1])}
    dimension, half = value + more, 1.96 * stderr
    status = "uncertain" if bent else "ok"
    return Estimate(dimension, dimension - half, dimension + half, status, "1", curve, says, details)


def _fit_slopes(x: Array, sums: NDArray[np.int64]) -> tuple[float, float]:
    """Return the slope of log sums (k,) over log radius (k,), and by how much its lower half is steeper."""
    y, half = np.log(sums), len(x) // 2
    return _fit_slope(x, y), _fit_slope(x[:half], y[:half]) - _fit_slope(x[half:], y[half:])


def _fit_slope(x: Array, y: Array) -> float:
    away = x - x.mean()
    return float(away @ y / (away @ away))


def _jackknife_slope(x: Array, counts: NDArray[np.int64], window: NDArray[np.intp]) -> float:
    """Return the standard error of the slope from leaving each block of the orbit out in turn (jackknife)."""
    rows, columns = counts.sum(axis=1), counts.sum(axis=0)
    own = counts[np.arange(_BLOCKS), np.arange(_BLOCKS)]
    kept = np.cumsum(counts.sum(axis=(0, 1)) - rows - columns + own, axis=1)[:, window]
    slopes = np.array([_fit_slope(x, np.log(np.maximum(row, 1))) for row in kept])
    return float(np.sqrt((_BLOCKS - 1) * np.mean((slopes - slopes.mean()) ** 2)))
