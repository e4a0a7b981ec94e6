"""Compiled loops of the embedders: counts of pairs of bins, and of neighbours in the plane and on its axes."""

from __future__ import annotations

import math

import numpy as np

from lostmotion.kernels.stored import stored
from lostmotion_chaos.kernels.seek import seek


@stored(nogil=True)
def _count_pairs(codes, bins, lag, counts):  # type: ignore[no-untyped-def]
    """Fill counts (2, bins * bins) with the pairs (x(t), x(t + lag)).

    Successive samples fall into the same cell, and each write to a cell must wait for the one before. So one half of
    the recording is counted in the first table, the other half in the second.
    """
    counts[:] = 0
    half = (len(codes) - lag) // 2
    first, second = counts[0], counts[1]
    for i in range(half):
        j = i + half
        first[codes[i] * bins + codes[i + lag]] += 1
        second[codes[j] * bins + codes[j + lag]] += 1
    for i in range(2 * half, len(codes) - lag):
        first[codes[i] * bins + codes[i + lag]] += 1


@stored(nogil=True)
def _sum_entropies(counts, bins, table, rows, columns):  # type: ignore[no-untyped-def]
    """Return the sums of c ln c over all cells and over the margins, and how many more cells than margins are filled.

    `table` holds c ln c; `rows` and `columns` (bins,) are work space.
    """
    rows[:] = 0
    columns[:] = 0
    total, extra = 0.0, 1
    for a in range(bins):
        for b in range(bins):
            c = counts[0, a * bins + b] + counts[1, a * bins + b]
            if c > 0:
                rows[a] += c
                columns[b] += c
                total += table[c]
                extra += 1
    margins = 0.0
    for a in range(bins):
        margins += table[rows[a]] + table[columns[a]]
        extra -= (rows[a] > 0) + (columns[a] > 0)
    return total, margins, extra


@stored(nogil=True)
def fill_binned(codes, bins, begin, end, table, ami, bias):  # type: ignore[no-untyped-def]
    """Fill `ami` and `bias` (nats) at the lags begin..end; `table` holds c ln c for all counts c."""
    counts = np.empty((2, bins * bins), np.int32)
    rows, columns = np.empty(bins, np.int64), np.empty(bins, np.int64)
    for lag in range(begin, end):
        _count_pairs(codes, bins, lag, counts)
        total, margins, extra = _sum_entropies(counts, bins, table, rows, columns)
        pairs = len(codes) - lag
        ami[lag] = math.log(pairs) + (total - margins) / pairs
        bias[lag] = extra / (2.0 * pairs)


@stored(nogil=True)
def compute_scatter(codes, bins, lag):  # type: ignore[no-untyped-def]
    """Return the standard error (nats) of the mutual information at a lag, as if the pairs were independent."""
    counts = np.empty((2, bins * bins), np.int32)
    _count_pairs(codes, bins, lag, counts)
    joint, rows, columns = np.zeros((bins, bins)), np.zeros(bins), np.zeros(bins)
    for a in range(bins):
        for b in range(bins):
            joint[a, b] = (counts[0, a * bins + b] + counts[1, a * bins + b]) / (len(codes) - lag)
            rows[a] += joint[a, b]
            columns[b] += joint[a, b]
    first, second = 0.0, 0.0
    for a in range(bins):
        for b in range(bins):
            if joint[a, b] > 0.0:
                gain = math.log(joint[a, b] / (rows[a] * columns[b]))
                first += joint[a, b] * gain
                second += joint[a, b] * gain * gain
    return math.sqrt(max(second - first * first, 0.0) / (len(codes) - lag))


@stored(nogil=True)
def _expect_poisson(rate):  # type: ignore[no-untyped-def]
    """Return the expectation of c ln c, and of c > 0, for a Poisson count c with this rate."""
    if rate > 50.0:
        return rate * math.log(rate) + 0.5 + 1.0 / (12.0 * rate), 1.0
    chance, mean = math.exp(-rate), 0.0
    empty = chance
    for c in range(1, int(rate + 12.0 * math.sqrt(rate) + 12.0)):
        chance *= rate / c
        mean += chance * c * math.log(c)
    return mean, 1.0 - empty


@stored(nogil=True)
def expect_by_chance(margin, corrected):  # type: ignore[no-untyped-def]
    """Return the mutual information (nats) expected of independent pairs with counts `margin` (bins,) on both axes.

    The counts of the cells are taken as Poisson; since the margins are fixed, 1/2 is subtracted for each of them.
    """
    pairs = margin.sum()
    total, margins, extra = 0.5, 0.0, 1.0
    for a in range(len(margin)):
        if margin[a] > 0:
            margins += 2.0 * margin[a] * math.log(margin[a])
            extra -= 2.0
            total -= 1.0
        for b in range(len(margin)):
            if margin[a] > 0 and margin[b] > 0:
                mean, full = _expect_poisson(margin[a] * margin[b] / pairs)
                total += mean
                extra += full
    found = math.log(pairs) + (total - margins) / pairs
    return found - extra / (2.0 * pairs) if corrected else found


@stored(nogil=True)
def _count_closer(ordered, here, reach):  # type: ignore[no-untyped-def]
    """Return how many of the sorted values differ from `here` by less than `reach`."""
    low = np.searchsorted(ordered, here - reach, side="left")
    high = np.searchsorted(ordered, here + reach, side="right")
    while low < high and here - ordered[low] >= reach:
        low += 1
    while low > 0 and here - ordered[low - 1] < reach:
        low -= 1
    while high > low and ordered[high - 1] - here >= reach:
        high -= 1
    while high < len(ordered) and ordered[high] - here < reach:
        high += 1
    return high - low


@stored(nogil=True)
def fill_gains(tree, axes, queries, k, psi, work, gained):  # type: ignore[no-untyped-def]
    """Fill gained (q,) with psi(k) + psi(n) - psi(n_x + 1) - psi(n_y + 1) at each query; `psi[c]` is that of c."""
    first, second = axes
    index, far = np.empty(k, np.int64), np.empty(k)
    for a in range(len(queries)):
        i = queries[a]
        seek(tree, i, (0, -1.0, False), np.inf, index, far, work)
        x, y, reach = tree.points[i, 0], tree.points[i, 1], far[k - 1]
        along = _count_closer(first, x, reach)
        across = _count_closer(second, y, reach)
        gained[a] = psi[k] + psi[len(first)] - psi[max(along, 1)] - psi[max(across, 1)]
