"""Mutual information between a series and its delayed copy, from counts in bins and from nearest neighbours."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.special import digamma, xlogy

from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.kernels.threads import spread
from lostmotion_chaos.embedders import _kernels
from lostmotion_chaos.kernels.neighbours import bench, grow

Codes = NDArray[np.int32]
MOST_BINS = 64
"""At most so many bins on each side. Chosen by experience; no measurement recorded."""


def choose_bin_count(n: int) -> int:
    """Return the number of bins on each side for n samples: four pairs in a cell on average, at most 64 bins."""
    return max(4, min(MOST_BINS, math.isqrt(n // 4)))


def assign_bins(x: Array, bins: int, *, equal_counts: bool = False) -> Codes:
    """Return the bin (n,) of each sample, of equal width from the least to the greatest value, or of equal counts."""
    if equal_counts:
        _, place, counts = np.unique(x, return_inverse=True, return_counts=True)
        middle = np.cumsum(counts) - 0.5 * counts
        scaled = bins * middle[place] / len(x)
    else:
        scaled = bins * ((x - x.min()) / (float(np.ptp(x)) or 1.0))
    codes: Codes = np.minimum(scaled, bins - 1).astype(np.int32)
    return codes


def compute_mutual_information(
    x: Array, lags: int, *, bins: int = 0, corrected: bool = False, equal_counts: bool = False
) -> Array:
    """Return the mutual information (lags + 1,) in nats between x (n,) and itself 0, 1, ... lags samples later.

    Fraser, Swinney, Physical Review A 33 (1986) 1134-1140, on a fixed grid of `bins` by `bins` cells (0: as many as
    the samples fill). `corrected` subtracts the bias of empty cells (Roulston, Physica D 125 (1999) 285-294).
    """
    if not 0 <= lags < len(x):
        raise DataError(f"{lags} lags do not fit into {len(x)} samples: ask for fewer, or record longer")
    bins = bins or choose_bin_count(len(x))
    ami, bias = compute_binned(assign_bins(x, bins, equal_counts=equal_counts), bins, lags)
    return ami - bias if corrected else ami


def compute_binned(codes: Codes, bins: int, lags: int) -> tuple[Array, Array]:
    """Return mutual information and its bias (lags + 1,) in nats, from the bins of all samples."""
    counts = np.arange(len(codes) + 1, dtype=np.float64)
    table = xlogy(counts, counts)
    ami, bias = np.empty(lags + 1), np.empty(lags + 1)

    def work(begin: int, end: int) -> None:
        _kernels.fill_binned(codes, bins, begin, end, table, ami, bias)

    spread(work, lags + 1)
    return ami, bias


def bound_by_chance(codes: Codes, bins: int, *, corrected: bool = True) -> float:
    """Return the mutual information (nats) that independent samples in the same bins exceed with probability 1/40.

    The mean is exact up to the Poisson approximation of each cell; the standard deviation is that of a chi-squared
    variable over 2 n.
    """
    margin = np.bincount(codes, minlength=bins)
    full = int((margin > 0).sum())
    return float(_kernels.expect_by_chance(margin, corrected)) + 2.0 * (full - 1) / math.sqrt(2.0) / len(codes)


def compute_mutual_information_knn(
    x: Array, lags: int, *, rng: np.random.Generator, k: int = 4, most: int = 4000
) -> tuple[Array, Array]:
    """Return mutual information and its standard error (lags + 1,) in nats, by k nearest neighbours.

    Kraskov, Stoegbauer, Grassberger, Physical Review E 69 (2004) 066138, algorithm 1, averaged over at most `most`
    samples. At lag 0 it is infinite. Ties, as in quantised recordings, are broken by dither from `rng`. The standard
    error assumes independent samples.
    """
    if not 0 <= lags < len(x) - k:
        raise DataError(f"{lags} lags and {k} neighbours do not fit into {len(x)} samples: ask for fewer")
    values = add_dither(x, rng)
    psi = digamma(np.arange(len(x) + 1, dtype=np.float64))
    ami, error = np.full(lags + 1, np.inf), np.zeros(lags + 1)

    def work(begin: int, end: int) -> None:
        for lag in range(begin + 1, end + 1):
            gained = _compute_gains(values, lag, k, psi, most)
            ami[lag], error[lag] = gained.mean(), gained.std() / math.sqrt(len(gained))

    spread(work, lags)
    return ami, error


def _compute_gains(x: Array, lag: int, k: int, psi: Array, most: int) -> Array:
    """Return the terms (q,) whose mean is the mutual information at one lag."""
    tree = grow(np.stack([x[: len(x) - lag], x[lag:]], axis=1))
    pairs = len(tree.points)
    queries = np.unique(np.linspace(0, pairs - 1, min(most, pairs)).astype(np.int64))
    gained = np.empty(len(queries))
    axes = (np.sort(tree.points[:, 0]), np.sort(tree.points[:, 1]))
    _kernels.fill_gains(tree, axes, queries, k, psi, bench(), gained)
    return gained


def add_dither(x: Array, rng: np.random.Generator) -> Array:
    """Return x with ties broken: where values repeat, uniform noise of one step of the values is added.

    A step is the smallest difference of two values, but at least the rounding error of a computed sine.
    """
    values = np.unique(x)
    if len(values) == len(x) or len(values) < 2:
        return x
    step = max(float(np.diff(values).min()), 1e-11 * float(np.ptp(x)))
    return x + rng.uniform(-0.5 * step, 0.5 * step, size=len(x))
