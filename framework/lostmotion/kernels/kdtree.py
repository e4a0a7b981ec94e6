"""A bucket k-d tree over delay vectors: built once, searched by kernels that allocate nothing.

Friedman, Bentley, Finkel, ACM Trans. Math. Software 3 (1977) 209-226, with tight boxes, and with what recordings ask
for: each node knows the first and last time in it, so that the strand around the query itself is passed over at once
(Theiler window), and points that repeat exactly share one bucket, however many they are.

The searches are in `seek.py`.
"""

from __future__ import annotations

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
BUCKET = 16


class Tree(NamedTuple):
    """Points in buckets. Node `a` holds `order[span[a, 0]:span[a, 1]]`, children `link[a]` and `link[a] + 1`.

    A leaf has a negative link: -1 - bucket, or `SAME` when all its points are equal; then `order` is sorted in it.
    `ages` (nodes, 2) are the least and greatest index in a node, `box` (nodes, 2, dim) its tight bounds.
    """

    points: Array
    order: Indices
    span: Indices
    link: Indices
    ages: Indices
    box: Array
    buckets: Array


SAME = -(2**62)


@numba.njit(cache=True, nogil=True)
def _select(keys, order, begin, end, middle):  # type: ignore[no-untyped-def]
    """Reorder keys and order between begin and end so that none before `middle` is larger than any behind it."""
    low, high = begin, end - 1
    while low < high:
        pivot = keys[(low + high) // 2]
        i, j = low, high
        while i <= j:
            while keys[i] < pivot:
                i += 1
            while keys[j] > pivot:
                j -= 1
            if i <= j:
                keys[i], keys[j] = keys[j], keys[i]
                order[i], order[j] = order[j], order[i]
                i += 1
                j -= 1
        if middle <= j:
            high = j
        elif middle >= i:
            low = i
        else:
            return


@numba.njit(cache=True, nogil=True)
def _bound(points, order, begin, end, box):  # type: ignore[no-untyped-def]
    """Write the tight bounds of some points into `box` (2, dim), and return the widest dimension and its width."""
    dim = points.shape[1]
    for k in range(dim):
        box[0, k] = box[1, k] = points[order[begin], k]
    for p in range(begin + 1, end):
        row = order[p]
        for k in range(dim):
            value = points[row, k]
            box[0, k] = min(box[0, k], value)
            box[1, k] = max(box[1, k], value)
    widest = 0
    for k in range(1, dim):
        if box[1, k] - box[0, k] > box[1, widest] - box[0, widest]:
            widest = k
    return widest, box[1, widest] - box[0, widest]


@numba.njit(cache=True, nogil=True)
def _divide(points, order, span, link, box):  # type: ignore[no-untyped-def]
    """Fill order, span, link and box, and return the number of nodes and of buckets."""
    keys = np.empty(len(points))
    nodes, buckets = 1, 0
    span[0, 0], span[0, 1] = 0, len(points)
    a = 0
    while a < nodes:
        begin, end = span[a]
        widest, width = _bound(points, order, begin, end, box[a])
        if width == 0.0:
            link[a] = SAME
            order[begin:end].sort()
        elif end - begin <= BUCKET:
            link[a] = -1 - buckets
            buckets += 1
        else:
            for p in range(begin, end):
                keys[p] = points[order[p], widest]
            middle = (begin + end) // 2
            _select(keys, order, begin, end, middle)
            link[a] = nodes
            span[nodes, 0], span[nodes, 1] = begin, middle
            span[nodes + 1, 0], span[nodes + 1, 1] = middle, end
            nodes += 2
        a += 1
    return nodes, buckets


@numba.njit(cache=True, nogil=True)
def _settle(points, order, span, link, ages, buckets):  # type: ignore[no-untyped-def]
    """Fill `ages` from the leaves up, and `buckets` (buckets, dim, BUCKET), padded with infinity."""
    for a in range(len(span) - 1, -1, -1):
        begin, end = span[a]
        if link[a] >= 0:
            ages[a, 0] = min(ages[link[a], 0], ages[link[a] + 1, 0])
            ages[a, 1] = max(ages[link[a], 1], ages[link[a] + 1, 1])
            continue
        ages[a, 0] = order[begin:end].min()
        ages[a, 1] = order[begin:end].max()
        if link[a] != SAME:
            for p in range(begin, end):
                for k in range(points.shape[1]):
                    buckets[-1 - link[a], k, p - begin] = points[order[p], k]


@numba.njit(cache=True, nogil=True)
def plant(points):  # type: ignore[no-untyped-def]
    """Return the arrays of the tree of `points` (n, dim), n >= 1: order, span, link, ages, box, buckets."""
    n, dim = points.shape
    most = 4 * (n // BUCKET) + 3
    order = np.arange(n)
    span = np.empty((most, 2), np.int64)
    link = np.empty(most, np.int64)
    box = np.empty((most, 2, dim))
    nodes, full = _divide(points, order, span, link, box)
    ages = np.empty((nodes, 2), np.int64)
    buckets = np.full((full, dim, BUCKET), np.inf)
    _settle(points, order, span[:nodes], link, ages, buckets)
    return order, span[:nodes].copy(), link[:nodes].copy(), ages, box[:nodes].copy(), buckets


def grow(points: Array) -> Tree:
    """Return the tree of `points` (n, dim), at least one, all finite."""
    held = np.ascontiguousarray(points, dtype=np.float64)
    return Tree(held, *plant(held))
