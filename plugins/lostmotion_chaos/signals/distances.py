"""The energy distance between two sets of points, with a permutation test of blocks in time.

Szekely, Rizzo, J. Statistical Planning and Inference 143 (2013) 1249-1272: 2 E|X - Y| - E|X - X'| - E|Y - Y'| is zero
only where both sets have the same distribution. It is a quadratic form in the distances, so sets of points at several
phases of a drive are compared by the mean of their distances.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BLOCKS = 40
"""The number of blocks of each set that are permuted as a whole: neighbours in time are not independent."""


def distances(points: Array) -> Array:
    """Return the mean distances (n, n) between points (looks, n, dims), in their unit, averaged over the looks."""
    total = np.zeros((points.shape[1], points.shape[1]))
    for cloud in points:
        square = np.einsum("ij,ij->i", cloud, cloud)
        total += np.sqrt(np.maximum(square[:, None] + square[None, :] - 2.0 * cloud @ cloud.T, 0.0))
    return np.asarray(total / len(points), dtype=float)


def energy_distance(table: Array, first: NDArray[np.intp], second: NDArray[np.intp]) -> float:
    """Return the energy distance between two groups of points, from all their distances `table` (n, n)."""
    within = table[np.ix_(first, first)].mean() + table[np.ix_(second, second)].mean()
    return max(float(2.0 * table[np.ix_(first, second)].mean() - within), 0.0)


def same_chance(table: Array, first: int, rng: np.random.Generator, *, draws: int = 199) -> float:
    """Return the p-value for equal distributions of the first `first` points and the others.

    Blocks of consecutive points are permuted between both sets.
    """
    n = len(table)
    sizes = (first, n - first)
    block = np.concatenate([np.arange(size) * min(BLOCKS, size) // size + BLOCKS * k for k, size in enumerate(sizes)])
    names = np.unique(block)
    mine = np.zeros((draws + 1, n), dtype=bool)
    mine[0] = block < BLOCKS
    for row in range(1, draws + 1):
        picked = rng.permutation(names)[: int((names < BLOCKS).sum())]
        mine[row] = np.isin(block, picked)
    counts = mine.sum(axis=1, keepdims=True)
    weights = np.where(mine, 1.0 / counts, -1.0 / (n - counts))
    apart = -np.einsum("ij,ij->i", weights @ table, weights)
    return float(np.mean(apart >= apart[0] * (1.0 - 1e-9)))
