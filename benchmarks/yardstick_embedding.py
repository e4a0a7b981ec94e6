"""Delay and dimension of Lorenz' x, N = 20,000: ours against plain NumPy and SciPy."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from lostmotion_chaos.embedders.dimension import unfold
from lostmotion_chaos.embedders.information import compute_mutual_information, compute_mutual_information_knn
from lostmotion_chaos.kernels import neighbours
from lostmotion_chaos.signals.series import delay_vectors
from yardstick import Array, Case, lorenz

LAG, THEILER, BINS, DIMS = 8, 100, 64, 8


def plain_information() -> Array:
    """Return the mutual information (101,) by histogram2d."""
    x = lorenz()
    edges = np.linspace(x.min(), x.max(), BINS + 1)
    found = np.empty(101)
    for lag in range(101):
        joint = np.histogram2d(x[: len(x) - lag], x[lag:], bins=[edges, edges])[0] / (len(x) - lag)
        apart = joint.sum(axis=1, keepdims=True) * joint.sum(axis=0, keepdims=True)
        full = joint > 0
        found[lag] = (joint[full] * np.log(joint[full] / apart[full])).sum()
    return found


def plain_nearest(points: Array, theiler: int) -> tuple[Array, Array]:
    """Return index and distance (n,) of the nearest neighbours: asks for 4, 8, ... until one is far enough in time."""
    index, distance = np.zeros(len(points), dtype=int), np.zeros(len(points))
    tree, left, k = cKDTree(points), np.arange(len(points)), 4
    while len(left):
        k = min(k, len(points))
        far, j = tree.query(points[left], k=k, p=np.inf)
        good = (np.abs(j - left[:, None]) > theiler) & (far > 0)
        has, at = good.any(axis=1), good.argmax(axis=1)
        index[left[has]], distance[left[has]] = j[has, at[has]], far[has, at[has]]
        left, k = left[~has], 2 * k
    return index, distance


def plain_unfolding() -> Array:
    """Return E and E* of Cao and the share of false neighbours, (3, 9)."""
    x, rows = lorenz(), []
    for d in range(1, DIMS + 2):
        j, near = plain_nearest(delay_vectors(x[: len(x) - LAG], LAG, d), THEILER)
        i = np.arange(len(j))
        step = np.abs(x[i + d * LAG] - x[j + d * LAG])
        after = np.maximum(near, step)
        false = (step > 10 * near) | (after > 2 * x.std())
        rows.append((np.mean(after / near), step.mean(), false.mean()))
    return np.array(rows).T


def _points() -> Array:
    return delay_vectors(lorenz(), LAG, 5)


CASES = [
    Case(
        "mutual information, lags 0-100, 64 bins",
        lambda: compute_mutual_information(lorenz(), 100, bins=BINS),
        plain_information,
        goal=0.003,
    ),
    Case(
        "Cao and false neighbours, dimensions 1-8",
        lambda: unfold(lorenz(), LAG, dims=DIMS, theiler=THEILER),
        plain_unfolding,
        goal=0.1,
    ),
    Case(
        "nearest neighbours in 5 dimensions",
        lambda: neighbours.nearest(_points(), theiler=THEILER),
        lambda: plain_nearest(_points(), THEILER),
    ),
    Case(
        "mutual information by neighbours, lags 1-20",
        lambda: compute_mutual_information_knn(lorenz(), 20, rng=np.random.default_rng(0)),
        None,
    ),
]

if __name__ == "__main__":
    from yardstick import clocked

    for case in CASES:
        ours = clocked(case.ours, 9)
        plain = clocked(case.plain, 3) if case.plain else float("nan")
        print(f"{case.name:50s} ours {1e3 * ours:8.2f} ms  plain {1e3 * plain:8.2f} ms  ratio {ours / plain:.3f}")
