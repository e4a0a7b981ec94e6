"""Surrogates of a motion with cycles: they keep the cycles and remove any dependence between successive cycles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Series, Surrogate
from lostmotion.errors import DataError
from lostmotion_chaos.kernels import neighbours
from lostmotion_chaos.signals.series import delay_vectors
from lostmotion_chaos.surrogates._kernels import walk

MOST_PROBES = 500
"""Points at which the noise radius is evaluated, at most about so many."""
RADIUS_GRID = 2.0 ** np.arange(-12.0, 12.0, 0.25)
"""Noise radii that are tried, in median distances of a nearest neighbour."""
REACH = 12
"""Samples on either side that an interpolation uses."""
PARTS = 1024
"""Steps between two samples at which the weights of the interpolation are tabulated."""


@dataclass(frozen=True)
class PseudoPeriodic(Surrogate):
    """Series with the cycles of the recording, and without dependence between successive cycles.

    Where the `period` of the drive is known, whole periods are put into a new order (Theiler 1995); groups of
    `together` periods are kept, 2 for a motion that repeats every second period. For other motions the series follows
    the recording and at random moves to one of the `neighbours` nearest points (Small et al. 2001). This uses the
    noise radius `radius`, or by default the one for which stretches of exactly two recorded samples are most frequent.
    `shuffle` selects one of the two methods explicitly.

    Small's walk is itself noisier than the recording, so prediction error and correlation dimension reject a noisy
    periodic orbit, too. Shuffled periods do not have that fault.
    """

    shuffle: bool | None = None
    together: int = 1
    radius: float | None = None
    neighbours: int = 48
    name: ClassVar[str] = "pseudo_periodic"
    paper: ClassVar[str] = (
        "Theiler, Physics Letters A 196 (1995) 335-341; Small, Yu, Harrison, Physical Review Letters 87 (2001) 188101"
    )
    null: ClassVar[str] = "a periodic orbit with noise that is independent from one cycle to the next"
    preserves: ClassVar[frozenset[str]] = frozenset({"cycles"})

    def piece(self, series: Series) -> slice:
        """Return the piece of the series that the surrogates are drawn of."""
        if not self._is_shuffled(series):
            return slice(0, series.n)
        begin, length, cycles = _find_periods(series, self.together)
        return slice(begin, begin + int(length * cycles))

    def draw(self, series: Series, *, draws: int, rng: np.random.Generator) -> Array:
        streams = rng.spawn(draws)
        if not self._is_shuffled(series):
            return self._draw_walks(series, streams)
        begin, length, cycles = _find_periods(series, self.together)
        times = np.arange(int(length * cycles))
        place = np.minimum((times / length).astype(np.int64), cycles - 1)
        shifted = [(stream.permutation(cycles)[place] - place) * length for stream in streams]
        return np.array([_interpolate(series.x, begin + times + shift) for shift in shifted])

    def _is_shuffled(self, series: Series) -> bool:
        return self.shuffle if self.shuffle is not None else series.period is not None

    def _draw_walks(self, series: Series, streams: list[np.random.Generator]) -> Array:
        index, distance = _find_neighbours(series, self.neighbours)
        radius = self.radius or choose_noise_radius(distance[:-1])
        shares = np.exp((distance.min(axis=1, keepdims=True) - distance) / radius)
        weights = np.cumsum(shares, axis=1) / shares.sum(axis=1, keepdims=True)
        out = np.empty((len(streams), series.n))
        visited = np.empty(series.n, dtype=np.int64)
        for row, stream in zip(out, streams, strict=True):
            walk(stream.integers(len(index)), stream.random(series.n), index, weights, visited)
            row[:] = series.x[visited]
        return out


def _find_neighbours(series: Series, k: int) -> tuple[Array, Array]:
    """Return indices (q, k + 1) and distances (q, k + 1) of each delay vector itself and its neighbours.

    Only vectors with a successor are used. The last of them gets an infinite distance, since the walk could not
    continue from it.
    """
    rows = delay_vectors(series.x, series.embedding.lag, series.embedding.dim)
    points = np.ascontiguousarray(rows[:-1])
    near, far = neighbours.several(points, min(k, len(points) - 1), theiler=0, norm="euclidean", least=-1.0)
    own = np.arange(len(points))[:, None]
    index = np.hstack([own, near])
    distance = np.hstack([np.zeros(own.shape), far])
    distance[index == len(points) - 1] = np.inf
    return index, distance


def choose_noise_radius(distance: Array) -> float:
    """Return the radius at which the expected number of stretches of exactly two recorded samples is largest.

    `distance` (q, k) are those of a point to itself (0) and to its neighbours. With p the probability of following
    the recording, such a stretch has the probability p (1 - p)^2, so no surrogate has to be drawn to count them.
    """
    some = distance[:: max(len(distance) // MOST_PROBES, 1)]
    apart = some[np.isfinite(some) & (some > 0.0)]
    unit = float(np.median(some[:, 1])) or (float(np.median(apart)) if apart.size else 1.0)
    unit = unit if np.isfinite(unit) else 1.0
    stay = 1.0 / np.exp(-some[None] / (unit * RADIUS_GRID[:, None, None])).sum(axis=2)
    return float(unit * RADIUS_GRID[np.argmax((stay * (1.0 - stay) ** 2).mean(axis=1))])


def _find_periods(series: Series, together: int) -> tuple[int, float, int]:
    """Return begin (samples), length (samples, not an integer) and number of the pieces that are put in a new order.

    They begin at the phase of the drive at which value and slope differ least from piece to piece.
    """
    if series.period is None:
        raise DataError(
            "whole periods cannot be shuffled: the period of the drive is not known; give it, or set shuffle=False"
        )
    length = together * series.period / series.dt
    cycles = int((series.n - 2 * REACH) / length) - 1
    if cycles < 4:
        piece = "one period" if together == 1 else f"{together} periods"
        raise DataError(
            f"the series contains {max(cycles, 0)} pieces of {piece} of the drive that can be exchanged, and 4 are"
            " needed: record longer"
        )
    starts = REACH + np.arange(max(int(length), 1))
    cuts = starts[:, None] + np.rint(length * np.arange(cycles + 1)).astype(np.int64)
    differ = np.var(series.x[cuts], axis=1) + np.var(np.diff(series.x)[cuts - 1], axis=1)
    return int(starts[np.argmin(differ)]), length, cycles


def _compute_weights() -> Array:
    """Return the sinc under a Kaiser window (PARTS + 1, 2 REACH): row p for a time p / PARTS after a sample."""
    away = np.arange(PARTS + 1)[:, None] / PARTS - np.arange(1 - REACH, REACH + 1)
    weights = np.sinc(away) * np.i0(6.0 * np.sqrt(np.maximum(1.0 - (away / REACH) ** 2, 0.0)))
    scaled: Array = weights / weights.sum(axis=1, keepdims=True)
    return scaled


def _interpolate(x: Array, times: Array) -> Array:
    """Return `x` (n,) at `times` (m,) between its samples.

    Linear interpolation would reduce the noise halfway between two samples, and surrogates would have less noise.
    """
    fine = np.rint(times * PARTS).astype(np.int64)
    whole, part = fine // PARTS, fine % PARTS
    seen = x[np.clip(whole[:, None] + np.arange(1 - REACH, REACH + 1), 0, len(x) - 1)]
    between: Array = np.einsum("ij,ij->i", seen, _compute_weights()[part])
    return between
