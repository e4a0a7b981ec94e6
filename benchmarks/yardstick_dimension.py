"""Correlation dimension, entropy and noise level on Lorenz x, against the plain sum over diagonals in NumPy."""

from __future__ import annotations

from itertools import count

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Series
from lostmotion.results import Embedding
from lostmotion_chaos.quantifiers.correlation import compute_correlation_sums
from lostmotion_chaos.quantifiers.dimension import CorrelationDimension, CorrelationEntropy
from lostmotion_chaos.quantifiers.noise import estimate_noise_level
from yardstick import Case, lorenz

Array = NDArray[np.float64]
LAG, THEILER = 8, 100
EMBEDDING = Embedding(LAG, 4, THEILER)


def plain_sums(dims: int, radii: int = 64) -> Array:
    """Return the pairs closer than each radius (dims, radii): one histogram for each diagonal and dimension."""
    x = lorenz()
    n = len(x) - (dims - 1) * LAG
    ends = np.ptp(x) * np.geomspace(1e-4, 1.0, radii)
    counts = np.zeros((dims, radii + 1), np.int64)
    for k in range(THEILER + 1, n):
        apart = np.abs(x[k:] - x[:-k])
        far = apart[: n - k]
        for m in range(dims):
            far = np.maximum(far, apart[m * LAG : m * LAG + n - k])
            counts[m] += np.bincount(np.searchsorted(ends, far), minlength=radii + 1)
    return np.asarray(np.cumsum(counts[:, :radii], axis=1))


def series() -> Series:
    x = lorenz()
    return Series(x - x.mean(), 0.02, EMBEDDING)


def measured(quantifier: CorrelationDimension | CorrelationEntropy) -> object:
    return quantifier.estimate(series(), rng=np.random.default_rng(0))


def noisy() -> Array:
    x = lorenz()
    return np.asarray(x + 0.02 * np.std(x) * np.random.default_rng(0).normal(size=len(x)))


def level(x: Array) -> object:
    """Return the noise level, measured afresh: the last two series are remembered."""
    return estimate_noise_level(x * (1.0 + 1e-12 * next(RUNS)), EMBEDDING)


RUNS = count()
CASES = [
    Case(
        "correlation sums, m = 1..6, Takens",
        lambda: compute_correlation_sums(lorenz(), LAG, 6, theiler=THEILER),
        lambda: plain_sums(6),
        0.5,
    ),
    Case("D2 with interval, m = 1..6", lambda: measured(CorrelationDimension(dims=6)), None, 1.0),
    Case("D2, fast statistic", lambda: measured(CorrelationDimension(fast=True)), None, 0.15),
    Case("K2 with interval", lambda: measured(CorrelationEntropy()), None, None),
    Case("noise level, 2 % noise", lambda: level(noisy()), None, 0.3),
    Case("noise level, clean", lambda: level(lorenz()), None, 0.3),
]
