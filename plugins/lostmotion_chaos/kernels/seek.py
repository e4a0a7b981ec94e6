"""Searches in a tree of `kdtree.py`: compiled functions that allocate nothing and may be called from any kernel.

The result does not depend on the order of the search: neighbours are ordered by distance, then by index. `rules` are
(theiler, least, euclidean): pairs with |i - j| <= theiler or no farther apart than `least` are excluded; if
`euclidean`, all distances, including `least` and bounds, are squared, else they are in the maximum norm.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lostmotion.kernels.stored import stored
from lostmotion_chaos.kernels.kdtree import BUCKET, SAME, Array, Indices

DEPTH = 128
"""Size of the stack of a search: twice the depth of any tree that fits in memory."""
LEAN: dict[str, Any] = {
    "nogil": True,
    "_nrt": False,
    "fastmath": {"nnan", "nsz"},
    "error_model": "numpy",
}
"""Without reference counts, which threads would contend for. No input may be NaN."""


def bench() -> tuple[Indices, Array, Array]:
    """Return work arrays for one thread: a stack of nodes, of their gaps, and the distances of a bucket."""
    return np.empty(DEPTH, np.int64), np.empty(DEPTH), np.empty(BUCKET)


@stored(**LEAN)
def apart(points, i, j, euclidean):  # type: ignore[no-untyped-def]
    """Return the distance of two points; squared if `euclidean`."""
    far = 0.0
    for k in range(points.shape[1]):
        step = abs(points[i, k] - points[j, k])
        far = far + step * step if euclidean else max(far, step)
    return far


@stored(**LEAN)
def _compute_gap(box, a, points, i, euclidean):  # type: ignore[no-untyped-def]
    """Return the distance of point i from the nearest point of box a, squared if `euclidean`."""
    far = 0.0
    for k in range(points.shape[1]):
        step = max(max(box[a, 0, k] - points[i, k], points[i, k] - box[a, 1, k]), 0.0)
        far = far + step * step if euclidean else max(far, step)
    return far


@stored(**LEAN)
def _refine_gap(tree, a, i, euclidean, gap, bound):  # type: ignore[no-untyped-def]
    """Return the distance of point i from node a, at least `gap`; 0 is returned unchanged, unless it must be exact."""
    if gap > bound or (gap == 0.0 and tree.link[a] != SAME):
        return gap
    return _compute_gap(tree.box, a, tree.points, i, euclidean)


@stored(**LEAN)
def _compute_reach(box, a, points, i, euclidean):  # type: ignore[no-untyped-def]
    """Return the distance of point i from the farthest point of box a, squared if `euclidean`."""
    far = 0.0
    for k in range(points.shape[1]):
        step = max(box[a, 1, k] - points[i, k], points[i, k] - box[a, 0, k])
        far = far + step * step if euclidean else max(far, step)
    return far


@stored(**LEAN)
def _scan_bucket(buckets, b, points, i, euclidean, far):  # type: ignore[no-untyped-def]
    """Write the distances of bucket b from point i into `far` (BUCKET,), and return the smallest."""
    for p in range(BUCKET):
        far[p] = 0.0
    for k in range(points.shape[1]):
        here = points[i, k]
        if euclidean:
            for p in range(BUCKET):
                step = buckets[b, k, p] - here
                far[p] += step * step
        else:
            for p in range(BUCKET):
                far[p] = max(far[p], abs(buckets[b, k, p] - here))
    least = np.inf
    for p in range(BUCKET):
        least = min(least, far[p])
    return least


@stored(**LEAN)
def _is_beaten(d, j, index, distance, found):  # type: ignore[no-untyped-def]
    """Return whether a candidate at distance d, with index j or more, is not among the best."""
    k = len(index)
    return found == k and (d > distance[k - 1] or (d == distance[k - 1] and j > index[k - 1]))


@stored(**LEAN)
def _insert(d, j, index, distance, found):  # type: ignore[no-untyped-def]
    """Insert a candidate among the `found` best so far, and return how many there are now."""
    if _is_beaten(d, j, index, distance, found):
        return found
    at = min(found, len(index) - 1)
    while at > 0 and (distance[at - 1] > d or (distance[at - 1] == d and index[at - 1] > j)):
        distance[at] = distance[at - 1]
        index[at] = index[at - 1]
        at -= 1
    distance[at] = d
    index[at] = j
    return min(found + 1, len(index))


@stored(**LEAN)
def _insert_repeats(tree, a, i, rules, d, best):  # type: ignore[no-untyped-def]
    """Insert the equal points of node a, which lie at distance d, as far as they are admissible."""
    index, distance, found = best
    theiler, least, _ = rules
    p, end = tree.span[a]
    while d > least and p < end and not _is_beaten(d, tree.order[p], index, distance, found):
        j = tree.order[p]
        if i - theiler <= j <= i + theiler:
            p += np.searchsorted(tree.order[p:end], i + theiler, side="right")
        else:
            found = _insert(d, j, index, distance, found)
            p += 1
    return found


@stored(**LEAN)
def _insert_bucket(tree, a, i, rules, bound, best, far):  # type: ignore[no-untyped-def]
    """Insert the admissible points of leaf a, and return how many have been found."""
    index, distance, found = best
    theiler, least, euclidean = rules
    if _scan_bucket(tree.buckets, -1 - tree.link[a], tree.points, i, euclidean, far) > bound:
        return found
    begin, end = tree.span[a]
    for p in range(end - begin):
        if least < far[p] <= bound:
            j = tree.order[begin + p]
            if j < i - theiler or j > i + theiler:
                found = _insert(far[p], j, index, distance, found)
    return found


@stored(**LEAN)
def _push_children(tree, a, i, euclidean, bound, stack):  # type: ignore[no-untyped-def]
    """Push the children of node a that are within the bound on the stack, the nearer on top; return its height.

    Their gaps are computed along the axis of the cut only: a lower bound that costs one subtraction each.
    """
    nodes, gaps, top = stack
    near, wide, axis, gap = tree.link[a], tree.link[a] + 1, tree.axis[a], gaps[top]
    here = tree.points[i, axis]
    low = max(here - tree.box[near, 1, axis], tree.box[near, 0, axis] - here)
    high = max(here - tree.box[wide, 1, axis], tree.box[wide, 0, axis] - here)
    if high < low:
        near, wide, low, high = wide, near, high, low
    low, high = max(low, 0.0), max(high, 0.0)
    if euclidean:
        low, high = low * low, high * high
    if high <= bound:
        nodes[top], gaps[top] = wide, max(gap, high)
        top += 1
    if low <= bound:
        nodes[top], gaps[top] = near, max(gap, low)
        top += 1
    return top


@stored(**LEAN)
def _is_excluded(tree, a, i, rules, gap):  # type: ignore[no-untyped-def]
    """Return whether the rules exclude all points of node a, which is `gap` away."""
    theiler, least, euclidean = rules
    if tree.ages[a, 0] >= i - theiler and tree.ages[a, 1] <= i + theiler:
        return True
    return least > 0.0 and gap <= least and _compute_reach(tree.box, a, tree.points, i, euclidean) <= least


@stored(**LEAN)
def seek(tree, i, rules, bound, index, distance, work):  # type: ignore[no-untyped-def]
    """Write the k nearest neighbours of point i into `index` and `distance` (k,), and return how many were found.

    Points farther than `bound` are excluded (one at that distance is not). `work` comes from `bench`.
    """
    nodes, gaps, far = work
    k = len(index)
    found, top = 0, 1
    nodes[0], gaps[0] = 0, 0.0
    while top > 0:
        top -= 1
        a = nodes[top]
        gap = _refine_gap(tree, a, i, rules[2], gaps[top], bound)
        if (
            gap > bound
            or _is_excluded(tree, a, i, rules, gap)
            or _is_beaten(gap, tree.ages[a, 0], index, distance, found)
        ):
            continue
        if tree.link[a] >= 0:
            gaps[top] = gap
            top = _push_children(tree, a, i, rules[2], bound, (nodes, gaps, top))
            continue
        if tree.link[a] == SAME:
            found = _insert_repeats(tree, a, i, rules, gap, (index, distance, found))
        else:
            found = _insert_bucket(tree, a, i, rules, bound, (index, distance, found), far)
        if found == k:
            bound = min(bound, distance[k - 1])
    return found


@stored(**LEAN)
def _is_all_wanted(tree, a, i, rules, radius, gap):  # type: ignore[no-untyped-def]
    """Return whether every point of node a is within the radius and the rules exclude none."""
    theiler, least, euclidean = rules
    apart_in_time = tree.ages[a, 0] > i + theiler or tree.ages[a, 1] < i - theiler
    return apart_in_time and gap > least and _compute_reach(tree.box, a, tree.points, i, euclidean) <= radius


@stored(**LEAN)
def _pick_points(tree, a, i, rules, radius, found, many):  # type: ignore[no-untyped-def]
    """Append the admissible points of leaf a to `found`, and return how many there are now."""
    theiler, least, euclidean = rules
    for p in range(tree.span[a, 0], tree.span[a, 1]):
        j = tree.order[p]
        if (j < i - theiler or j > i + theiler) and least < apart(tree.points, i, j, euclidean) <= radius:
            found[many] = j
            many += 1
    return many


@stored(**LEAN)
def collect(tree, i, rules, radius, found, work):  # type: ignore[no-untyped-def]
    """Write all points no farther than `radius` from point i into `found` (n,), unsorted, and return how many."""
    nodes, gaps, _ = work
    many, top = 0, 1
    nodes[0], gaps[0] = 0, 0.0
    while top > 0:
        top -= 1
        a = nodes[top]
        gap = _refine_gap(tree, a, i, rules[2], gaps[top], radius)
        if gap > radius or _is_excluded(tree, a, i, rules, gap):
            continue
        if _is_all_wanted(tree, a, i, rules, radius, gap):
            for p in range(tree.span[a, 0], tree.span[a, 1]):
                found[many] = tree.order[p]
                many += 1
        elif tree.link[a] >= 0:
            gaps[top] = gap
            top = _push_children(tree, a, i, rules[2], radius, (nodes, gaps, top))
        else:
            many = _pick_points(tree, a, i, rules, radius, found, many)
    return many
