"""Neighbours in delay space that are not neighbours in time.

All functions take points (n, dim), leave out pairs closer in time than `theiler` samples (|i - j| <= theiler) and
pairs no farther apart than `least` (exact repeats, which quantised recordings are full of), and say distances in the
maximum norm or the Euclidean one.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Norm = Literal["max", "euclidean"]
_P = {"max": np.inf, "euclidean": 2.0}


def nearest(
    points: Array, *, theiler: int, norm: Norm = "max", least: float = 0.0, queries: Indices | None = None
) -> tuple[Indices, Array]:
    """Return index (q,) and distance (q,) of each query's nearest neighbour; -1 and inf where there is none."""
    wanted = np.arange(len(points)) if queries is None else np.asarray(queries)
    index = np.full(len(wanted), -1)
    distance = np.full(len(wanted), np.inf)
    tree = cKDTree(points)
    left, k = np.arange(len(wanted)), 4
    while len(left):
        k = min(k, len(points))
        d, j = tree.query(points[wanted[left]], k=k, p=_P[norm])
        good = (np.abs(j - wanted[left][:, None]) > theiler) & (d > least) & np.isfinite(d)
        has, at = good.any(axis=1), good.argmax(axis=1)
        index[left[has]] = j[has, at[has]]
        distance[left[has]] = d[has, at[has]]
        if k == len(points):
            break
        left, k = left[~has], 2 * k
    return index, distance


def several(
    points: Array, k: int, *, theiler: int, norm: Norm = "max", least: float = 0.0, queries: Indices | None = None
) -> tuple[Indices, Array]:
    """Return indices (q, k) and distances (q, k) of the k nearest neighbours, the nearest first; -1 and inf pad."""
    wanted = np.arange(len(points)) if queries is None else np.asarray(queries)
    index = np.full((len(wanted), k), -1)
    distance = np.full((len(wanted), k), np.inf)
    tree = cKDTree(points)
    for row, i in enumerate(wanted):
        asked = k
        while True:
            asked = min(2 * asked, len(points))
            d, j = tree.query(points[i], k=asked, p=_P[norm])
            good = (np.abs(j - i) > theiler) & (d > least)
            if good.sum() >= k or asked == len(points):
                found = j[good][:k]
                index[row, : len(found)] = found
                distance[row, : len(found)] = d[good][:k]
                break
    return index, distance


def within(
    points: Array,
    radius: float,
    *,
    theiler: int,
    norm: Norm = "max",
    least: float = -1.0,
    queries: Indices | None = None,
) -> tuple[Indices, Indices]:
    """Return offsets (q + 1,) and indices (total,): those of query a are indices[offsets[a]:offsets[a + 1]]."""
    wanted = np.arange(len(points)) if queries is None else np.asarray(queries)
    tree = cKDTree(points)
    lists = []
    for i in wanted:
        j = np.array(sorted(tree.query_ball_point(points[i], radius, p=_P[norm])), dtype=np.int64)
        d = np.abs(points[j] - points[i])
        far = d.max(axis=1) if norm == "max" else np.sqrt((d**2).sum(axis=1))
        lists.append(j[(np.abs(j - i) > theiler) & (far > least)])
    offsets = np.concatenate([[0], np.cumsum([len(found) for found in lists])]).astype(np.int64)
    return offsets, np.concatenate(lists).astype(np.int64) if lists else np.zeros(0, dtype=np.int64)
