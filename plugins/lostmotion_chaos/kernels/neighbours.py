"""Nearest neighbours in delay space that are not neighbours in time.

All functions take points (n, dim). They exclude pairs closer in time than `theiler` samples (|i - j| <= theiler) and
pairs no farther apart than `least` (exact repeats, which are frequent in quantised recordings), and give distances in
the maximum norm or the Euclidean norm. Neighbours at the same distance are ordered by their time. `tree`, from `grow`,
avoids building the search tree again for further searches among the same points.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.kernels.stored import stored
from lostmotion.kernels.threads import spread
from lostmotion_chaos.kernels.kdtree import Tree, build_tree
from lostmotion_chaos.kernels.seek import LEAN, apart, bench, collect, seek

__all__ = ["Norm", "Tree", "apart", "bench", "collect", "grow", "nearest", "rules", "seek", "several", "within"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Norm = Literal["max", "euclidean"]


def grow(points: Array) -> Tree:
    """Return the search tree of `points` (n, dim), at least one of them."""
    held = np.ascontiguousarray(points, dtype=np.float64)
    if held.ndim != 2 or 0 in held.shape:
        raise DataError(f"neighbours are sought among points (n, dim), found the shape {held.shape}: give one at least")
    if not np.isfinite(held).all():
        raise DataError("neighbours are sought among points of which some are NaN or infinite: cut these out first")
    return Tree(held, *build_tree(held))


def rules(theiler: int, least: float, norm: Norm) -> tuple[int, float, bool]:
    """Return `rules` in the form that `seek` and `collect` take; with the Euclidean norm distances are squared."""
    far = norm == "euclidean"
    return int(theiler), float(least * least if far and least > 0.0 else least), far


def nearest(
    points: Array,
    *,
    theiler: int,
    norm: Norm = "max",
    least: float = 0.0,
    queries: Indices | None = None,
    guess: Indices | None = None,
    tree: Tree | None = None,
) -> tuple[Indices, Array]:
    """Return index (q,) and distance (q,) of each query's nearest neighbour; -1 and inf where there is none.

    `guess` (q,) are points that may be near, -1 for none: they speed up the search and do not change its result.
    """
    tree = tree or grow(points)
    wanted = _select_queries(tree, queries)
    hints = np.full(len(wanted), -1) if guess is None else np.asarray(guess, dtype=np.int64)
    index = np.full(len(wanted), -1)
    distance = np.full(len(wanted), np.inf)
    law = rules(theiler, least, norm)

    def work(begin: int, end: int) -> None:
        part = slice(begin, end)
        _search_nearest(tree, wanted[part], hints[part], law, index[part], distance[part], bench())

    spread(work, len(wanted))
    return index, np.sqrt(distance) if law[2] else distance


def several(
    points: Array,
    k: int,
    *,
    theiler: int,
    norm: Norm = "max",
    least: float = 0.0,
    queries: Indices | None = None,
    tree: Tree | None = None,
) -> tuple[Indices, Array]:
    """Return indices (q, k) and distances (q, k) of the k nearest neighbours, the nearest first; -1 and inf pad."""
    tree = tree or grow(points)
    wanted = _select_queries(tree, queries)
    index = np.full((len(wanted), k), -1)
    distance = np.full((len(wanted), k), np.inf)
    law = rules(theiler, least, norm)

    def work(begin: int, end: int) -> None:
        _search_several(tree, wanted[begin:end], law, index[begin:end], distance[begin:end], bench())

    spread(work, len(wanted) if k > 0 else 0)
    return index, np.sqrt(distance) if law[2] else distance


def within(
    points: Array,
    radius: float,
    *,
    theiler: int,
    norm: Norm = "max",
    least: float = -1.0,
    queries: Indices | None = None,
    tree: Tree | None = None,
) -> tuple[Indices, Indices]:
    """Return offsets (q + 1,) and indices (total,): those of query a are indices[offsets[a]:offsets[a + 1]], sorted."""
    tree = tree or grow(points)
    wanted = _select_queries(tree, queries)
    counts = np.zeros(len(wanted), dtype=np.int64)
    law = rules(theiler, least, norm)
    ball = float(radius * radius if law[2] else radius)
    found: dict[int, Indices] = {}

    def work(begin: int, end: int) -> None:
        found[begin] = _search_within(tree, wanted[begin:end], law, ball, counts[begin:end], bench())

    spread(work, len(wanted) if radius >= 0.0 else 0)
    offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    parts = [found[begin] for begin in sorted(found)]
    return offsets, np.concatenate(parts) if parts else np.zeros(0, dtype=np.int64)


def _select_queries(tree: Tree, queries: Indices | None) -> Indices:
    return np.arange(len(tree.points)) if queries is None else np.ascontiguousarray(queries, dtype=np.int64)


@stored(**LEAN)
def _bound_distance(points, i, j, law):  # type: ignore[no-untyped-def]
    """Return the distance of j from i if j is admissible as its neighbour, else infinity."""
    theiler, least, euclidean = law
    if j < 0 or j >= len(points) or abs(i - j) <= theiler:
        return np.inf
    far = apart(points, i, j, euclidean)
    return far if far > least else np.inf


@stored(**LEAN)
def _search_nearest(tree, wanted, hints, law, index, distance, work):  # type: ignore[no-untyped-def]
    """Fill index and distance (q,); in a continuous flow the successor of the last neighbour gives a bound."""
    last, before = -1, -2
    for a in range(len(wanted)):
        i = wanted[a]
        bound = _bound_distance(tree.points, i, hints[a], law)
        if i == before + 1 and last >= 0:
            bound = min(bound, _bound_distance(tree.points, i, last + 1, law))
        seek(tree, i, law, bound, index[a : a + 1], distance[a : a + 1], work)
        last, before = index[a], i


@stored(**LEAN)
def _search_several(tree, wanted, law, index, distance, work):  # type: ignore[no-untyped-def]
    """Fill index and distance (q, k)."""
    for a in range(len(wanted)):
        seek(tree, wanted[a], law, np.inf, index[a], distance[a], work)


@stored(**LEAN)
def _sort_by_marks(room, many, marks):  # type: ignore[no-untyped-def]
    """Sort the first `many` of `room`, all different, by marking and sweeping: fast where they are most points."""
    for p in range(many):
        marks[room[p]] = True
    at = 0
    for j in range(len(marks)):
        if marks[j]:
            room[at] = j
            at += 1
            marks[j] = False


@stored(nogil=True)
def _search_within(tree, wanted, law, radius, counts, work):  # type: ignore[no-untyped-def]
    """Fill counts (q,) and return the neighbours of all queries, one after the other, sorted for each query."""
    room = np.empty(len(tree.points), np.int64)
    marks = np.zeros(len(tree.points), np.bool_)
    found = np.empty(16 * len(wanted) + 16, np.int64)
    total = 0
    for a in range(len(wanted)):
        many = collect(tree, wanted[a], law, radius, room, work)
        if total + many > len(found):
            grown = np.empty(2 * (total + many), np.int64)
            grown[:total] = found[:total]
            found = grown
        if many > len(room) // 16:
            _sort_by_marks(room, many, marks)
        found[total : total + many] = room[:many] if many > len(room) // 16 else np.sort(room[:many])
        counts[a] = many
        total += many
    return found[:total].copy()
