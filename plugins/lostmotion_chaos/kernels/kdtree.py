"""A bucket k-d tree over delay vectors: built once, searched by kernels that allocate nothing.

Friedman, Bentley, Finkel, ACM Trans. Math. Software 3 (1977) 209-226, with tight boxes, and with two additions for
recordings: each node stores its first and last time, so that the points within the Theiler window of a query are
skipped at once, and points that repeat exactly share one bucket, however many they are.

The searches are in `seek.py`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lostmotion.kernels.stored import stored

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
BUCKET = 16


class Tree(NamedTuple):
    """Points in buckets. Node `a` holds `order[span[a, 0]:span[a, 1]]`, children `link[a]` and `link[a] + 1`.

    The cut between the children is across `axis[a]`.
    A leaf has a negative link: -1 - bucket, or `SAME` when all its points are equal; then `order` is sorted in it.
    `ages` (nodes, 2) are the least and greatest index in a node, `box` (nodes, 2, dim) its tight bounds.
    """

    points: Array
    order: Indices
    span: Indices
    link: Indices
    axis: Indices
    ages: Indices
    box: Array
    buckets: Array


SAME = -(2**62)


@stored(nogil=True)
def _select(keys, order, begin, end, middle):  # type: ignore[no-untyped-def]
    """Sort keys and order between begin and end in part: none before `middle` is larger than any after it."""
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


@stored(nogil=True)
def _compute_bounds(points, order, begin, end, box):  # type: ignore[no-untyped-def]
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


@stored(nogil=True)
def _choose_cut(keys, order, begin, end):  # type: ignore[no-untyped-def]
    """Reorder between begin and end and return where to cut, near the middle, with equal keys on one side of it.

    With equal keys on both sides, repeated points would be spread over many small leaves.
    """
    middle = (begin + end) // 2
    _select(keys, order, begin, end, middle)
    value = keys[middle]
    low = begin
    for p in range(begin, middle):
        if keys[p] < value:
            keys[p], keys[low] = keys[low], keys[p]
            order[p], order[low] = order[low], order[p]
            low += 1
    high = middle
    for p in range(middle, end):
        if keys[p] == value:
            keys[p], keys[high] = keys[high], keys[p]
            order[p], order[high] = order[high], order[p]
            high += 1
    return low if low > begin and (middle - low <= high - middle or high == end) else high


@stored(nogil=True)
def _enlarge(array, rows):  # type: ignore[no-untyped-def]
    """Return an array of twice as many rows that begins with the old ones (a loop: slices compile slowly)."""
    grown = np.empty((2 * rows, *array.shape[1:]), array.dtype)
    old, new = array.reshape(-1), grown.reshape(-1)
    for i in range(len(old)):
        new[i] = old[i]
    return grown


@stored(nogil=True)
def _divide_nodes(points, order):  # type: ignore[no-untyped-def]
    """Return span, link, axis and box of all nodes and the number of buckets; `order` is sorted by node."""
    n, dim = points.shape
    keys = np.empty(n)
    room = 4 * (n // BUCKET) + 3
    span, link, box = np.empty((room, 2), np.int64), np.empty((room, 2), np.int64), np.empty((room, 2, dim))
    span[0, 0], span[0, 1] = 0, n
    nodes, buckets, a = 1, 0, 0
    while a < nodes:
        if nodes + 2 > room:
            span, link, box = _enlarge(span, room), _enlarge(link, room), _enlarge(box, room)
            room *= 2
        begin, end = span[a]
        widest, width = _compute_bounds(points, order, begin, end, box[a])
        if width == 0.0:
            link[a, 0] = SAME
            order[begin:end].sort()
        elif end - begin <= BUCKET:
            link[a, 0] = -1 - buckets
            buckets += 1
        else:
            for p in range(begin, end):
                keys[p] = points[order[p], widest]
            middle = _choose_cut(keys, order, begin, end)
            link[a, 0], link[a, 1] = nodes, widest
            span[nodes, 0], span[nodes, 1] = begin, middle
            span[nodes + 1, 0], span[nodes + 1, 1] = middle, end
            nodes += 2
        a += 1
    return span[:nodes].copy(), link[:nodes, 0].copy(), link[:nodes, 1].copy(), box[:nodes].copy(), buckets


@stored(nogil=True)
def _fill_leaves(points, order, span, link, ages, buckets):  # type: ignore[no-untyped-def]
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


@stored(nogil=True)
def build_tree(points):  # type: ignore[no-untyped-def]
    """Return the arrays of the tree of `points` (n, dim), n >= 1: order, span, link, axis, ages, box, buckets."""
    n, dim = points.shape
    order = np.arange(n)
    span, link, axis, box, full = _divide_nodes(points, order)
    ages = np.empty((len(span), 2), np.int64)
    buckets = np.full((full, dim, BUCKET), np.inf)
    _fill_leaves(points, order, span, link, ages, buckets)
    return order, span, link, axis, ages, box, buckets
