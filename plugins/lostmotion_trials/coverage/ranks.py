"""Tests of the calibration of posteriors, from the ranks of known truths among their draws.

Talts, Betancourt, Simpson, Vehtari, Gelman, arXiv:1804.06788 (2018): when each truth is drawn from the prior, its rank
among independent draws of its posterior is uniform. Ranks run from 0 to `draws`, both included.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaln
from scipy.stats import binom, chi2

from lostmotion.contracts import Array

Ranks = NDArray[np.int64]
DRAWS = 99
"""Thinned draws of each posterior, so that a rank takes one of 100 values."""
MOST_BINS = 20
"""At most so many bins of a histogram."""
LEAST_EXPECTED = 5.0
"""The least expected number of ranks in a bin of a histogram."""
HALVINGS = 40
"""Halvings in the search for a band."""


@dataclass(frozen=True)
class RankBand:
    """Counts from `low` to `high`, both included, at the places `at`; `middle` is what is expected there."""

    at: Array
    middle: Array
    low: Array
    high: Array


def compute_rank(truth: float, chain: Array, draws: int = DRAWS) -> int:
    """Return the rank of a truth among `draws` evenly spaced ones of a chain (walkers, steps)."""
    flat = np.asarray(chain).ravel()
    picked = flat[((np.arange(draws) + 0.5) * flat.size / draws).astype(np.int64)]
    return int(np.sum(picked < truth))


def count_ranks(ranks: Ranks, bins: int, draws: int = DRAWS) -> NDArray[np.int64]:
    """Return how many ranks fall into each of `bins` equal bins, (bins,)."""
    return np.bincount(np.asarray(ranks) * bins // (draws + 1), minlength=bins)


def choose_bin_count(machines: int, draws: int = DRAWS) -> int:
    """Return the number of equal bins, 20 at the most, that hold five ranks each or more on average; one if none do."""
    most = min(MOST_BINS, int(machines / LEAST_EXPECTED))
    return max(b for b in range(1, max(most, 1) + 1) if (draws + 1) % b == 0)


def compute_chi_square_p(ranks: Ranks, draws: int = DRAWS) -> float:
    """Return the p-value of Pearson's test that the ranks are uniform; NaN when there are fewer than ten."""
    bins = choose_bin_count(len(ranks), draws)
    if bins < 2:
        return float("nan")
    expected = len(ranks) / bins
    return float(chi2.sf(np.sum((count_ranks(ranks, bins, draws) - expected) ** 2) / expected, bins - 1))


def compute_histogram_band(machines: int, bins: int, level: float = 0.01) -> tuple[int, int]:
    """Return the fewest and the most ranks that one bin holds, except with the probability `level`."""
    low, high = binom.ppf([0.5 * level, 1.0 - 0.5 * level], machines, 1.0 / bins)
    return int(low), int(high)


def compute_coverage_limits(machines: int, share: float, level: float = 0.01) -> tuple[int, int]:
    """Return the fewest and the most truths inside of intervals of this share, except with the probability `level`."""
    low, high = binom.ppf([0.5 * level, 1.0 - 0.5 * level], machines, share)
    return int(low), int(high)


def count_below(ranks: Ranks, draws: int = DRAWS) -> Array:
    """Return how many ranks lie below 1, 2, ... `draws`, (draws,)."""
    return np.asarray(np.cumsum(count_ranks(ranks, draws + 1, draws))[:-1], dtype=float)


def compute_ecdf_p(ranks: Ranks, draws: int = DRAWS) -> float:
    """Return the p-value of the test by simultaneous bands that the ranks are uniform; NaN when there are none.

    The statistic is the smallest pointwise tail probability of the empirical distribution function. Its own
    distribution is computed exactly, for ranks that are discrete: Sailynoja, Burkner, Vehtari, Statistics and
    Computing 32, 32 (2022).
    """
    if not len(ranks):
        return float("nan")
    tails = _compute_tails(len(ranks), draws)
    found = float(np.min(tails[np.arange(draws), count_below(ranks, draws).astype(int)]))
    return float(np.clip(_compute_exit_probability(tails, found), 0.0, 1.0))


def compute_ecdf_band(machines: int, level: float = 0.01, draws: int = DRAWS) -> RankBand:
    """Return the band that the counts of `ecdf` leave anywhere with a probability of `level` at the most."""
    tails = _compute_tails(machines, draws)
    low, high = level / (10.0 * draws), 1.0
    for _ in range(HALVINGS):
        middle = (low * high) ** 0.5
        low, high = (middle, high) if _compute_exit_probability(tails, middle) <= level else (low, middle)
    first, last = _find_allowed(tails, low)
    at = np.arange(1, draws + 1) / (draws + 1)
    return RankBand(at, machines * at, first.astype(float), last.astype(float))


def _compute_tails(machines: int, draws: int) -> Array:
    """Return the two-sided tail probability of each count (draws, machines + 1) at each place of the `ecdf`."""
    at = np.arange(1, draws + 1)[:, None] / (draws + 1)
    counts = np.arange(machines + 1)[None]
    both = np.minimum(binom.cdf(counts, machines, at), binom.sf(counts - 1, machines, at))
    return np.asarray(np.minimum(2.0 * both, 1.0))


def _find_allowed(tails: Array, bound: float) -> tuple[Ranks, Ranks]:
    """Return the smallest and the largest count at each place whose tail probability exceeds `bound`."""
    inside = tails > bound * (1.0 + 1e-9)
    last = tails.shape[1] - 1 - np.argmax(inside[:, ::-1], axis=1)
    return np.argmax(inside, axis=1), np.where(inside.any(axis=1), last, -1)


def _compute_exit_probability(tails: Array, bound: float) -> float:
    """Return the probability that uniform ranks have a tail probability of `bound` or less somewhere.

    From place to place the count is a Markov chain: of those above, a binomial number lies below the next place.
    """
    draws, machines = tails.shape[0], tails.shape[1] - 1
    factorial = gammaln(np.arange(machines + 2.0) + 1.0)
    weights, floor = np.ones(1), 0
    for place, (first, last) in enumerate(zip(*_find_allowed(tails, bound), strict=True)):
        if last < first:
            return 1.0
        new = np.arange(first, last + 1)[None] - np.arange(floor, floor + len(weights))[:, None]
        left = (machines - np.arange(floor, floor + len(weights)))[:, None]
        share = 1.0 / (draws + 1 - place)
        possible = (new >= 0) & (new <= left)
        new = np.where(possible, new, 0)
        logs = factorial[left] - factorial[new] - factorial[left - new]
        logs = logs + new * np.log(share) + (left - new) * np.log1p(-share)
        weights = weights @ np.where(possible, np.exp(logs), 0.0)
        floor = int(first)
    return 1.0 - float(weights.sum())
