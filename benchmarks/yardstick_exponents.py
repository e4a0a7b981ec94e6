"""Exponents of Lorenz x, N = 20 000, against the plain NumPy/SciPy way: a tree, growing queries, arrays of pairs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from lostmotion.contracts import Series
from lostmotion.results import Embedding
from lostmotion_chaos.quantifiers.kantz import Kantz
from lostmotion_chaos.quantifiers.rosenstein import Rosenstein
from lostmotion_chaos.quantifiers.wolf import Wolf
from yardstick import Case, lorenz

Array = NDArray[np.float64]
LAG, DIM, THEILER, STEPS, DT = 8, 5, 100, 300, 0.02


def series() -> Series:
    x = lorenz()
    return Series(x - x.mean(), DT, Embedding(LAG, DIM, THEILER))


def points() -> Array:
    x = lorenz()
    return np.stack([x[k * LAG : len(x) - (DIM - 1 - k) * LAG] for k in range(DIM)], axis=1)


def plain_rosenstein() -> float:
    """Return the classical slope, without an interval."""
    y = points()
    n = len(y) - STEPS
    tree, index, left, k = cKDTree(y[:n]), np.full(n, -1), np.arange(n), 4
    while len(left):
        _, j = tree.query(y[left], k=k)
        good = np.abs(j - left[:, None]) > THEILER
        has = good.any(axis=1)
        index[left[has]] = j[has, good[has].argmax(axis=1)]
        left, k = left[~has], 2 * k
    i = np.arange(n)
    curve = [np.log(np.linalg.norm(y[i + t] - y[index + t], axis=1)).mean() for t in range(STEPS)]
    return float(np.polyfit(DT * np.arange(50, 150), curve[50:150], 1)[0])


def plain_kantz(radius: float = 1.1) -> Array:
    """Return the curve for one radius, 3 % of the range, of every fifth reference."""
    y = points()
    n = len(y) - STEPS
    tree, total, many = cKDTree(y[:n]), np.zeros(STEPS), 0
    times = np.arange(STEPS)
    for i in range(0, n, 5):
        j = np.array(tree.query_ball_point(y[i], radius), dtype=int)
        j = j[np.abs(j - i) > THEILER]
        if len(j) >= 5:
            far = np.abs(y[i + times, -1] - y[j[:, None] + times, -1]).mean(axis=0)
            total += np.log(np.maximum(far, 1e-300))
            many += 1
    return total / max(many, 1)


def _run(method: Rosenstein | Kantz | Wolf) -> float:
    return method.estimate(series(), rng=np.random.default_rng(0)).value


CASES = [
    Case("Rosenstein, refined, with interval", lambda: _run(Rosenstein()), plain_rosenstein, 0.05),
    Case("Rosenstein, classical", lambda: _run(Rosenstein("classical", begin=1.0, end=3.0)), plain_rosenstein, 0.05),
    Case("Kantz, three shells, with interval", lambda: _run(Kantz()), plain_kantz, 0.2),
    Case("Wolf", lambda: _run(Wolf()), None),
]
