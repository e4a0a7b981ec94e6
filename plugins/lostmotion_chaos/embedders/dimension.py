"""The dimension of an embedding from nearest neighbours: Cao's method, and the share of false neighbours."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.kernels.threads import spread
from lostmotion_chaos.kernels.neighbours import Indices, Norm, Tree, grow, nearest
from lostmotion_chaos.signals.series import delay_vectors

ROUNDING = 1e-11
"""Distances below this share of the range are rounding errors, as between exact repeats of a computed sine."""
LEAST_PAIRS = 40
"""No dimension is read from fewer pairs of neighbours than this. Chosen by experience; no measurement recorded."""


@dataclass(frozen=True, eq=False)
class Unfolding:
    """Curves (dims,) of how nearest neighbours in 1 ... dims dimensions separate in the next dimension.

    `e1`, `e2` are Cao's; `fnn` is the share of neighbours that are false by either of Kennel's criteria,
    `fnn_distance` by the first, `fnn_loneliness` by the second; `pairs` is the number of neighbours, and `distinct`
    the number of different delay vectors in the last dimension.
    """

    dim: Array
    e1: Array
    e2: Array
    fnn: Array
    fnn_distance: Array
    fnn_loneliness: Array
    pairs: Array
    distinct: int


@dataclass(frozen=True)
class EmbeddingDimension:
    """A dimension and the `method` that chose it; `says` is empty where the status is "ok"."""

    dim: int
    method: str
    status: str = "ok"
    says: str = ""


def limit_dimension(n: int, lag: int, dims: int, theiler: int) -> int:
    """Return the largest dimension, at most `dims`, in which the delay vectors of n samples have enough neighbours."""
    return max(0, min(dims, (n - 2 * theiler - LEAST_PAIRS) // lag - 1))


def unfold(
    x: Array,
    lag: int,
    *,
    dims: int = 8,
    theiler: int,
    norm: Norm = "max",
    ratio: float = 10.0,
    loneliness: float = 2.0,
) -> Unfolding:
    """Return Cao's curves and the shares of false neighbours of x (n,) in 1 ... dims dimensions, from one search.

    `ratio` and `loneliness` are Kennel's R_tol and A_tol; neighbours that fail the second are counted as false, not
    left out. Exact repeats are not used as neighbours, since their distance is a rounding error.
    """
    if limit_dimension(len(x), lag, dims, theiler) < dims:
        raise DataError(
            f"{len(x)} samples leave too few neighbours in {dims} dimensions at lag {lag} and Theiler window "
            f"{theiler}: record longer, or lower one of them"
        )
    x = np.ldexp(x, -math.frexp(float(np.ptp(x)))[1])
    size = float(x.std())
    rows = []
    for near, step in _pair_neighbours(x, lag, dims + 1, theiler, norm):
        next_far = np.maximum(near, step) if norm == "max" else np.hypot(near, step)
        jumps, lonely = step > ratio * near, next_far > loneliness * size
        many = max(len(near), 1)
        grows = float(np.mean(next_far / near)) if len(near) else math.nan
        moves = float(np.mean(step)) if len(near) else math.nan
        rows.append((grows, moves, (jumps | lonely).sum() / many, jumps.sum() / many, lonely.sum() / many, len(near)))
    table = np.array(rows, dtype=np.float64).T
    e1, e2 = table[0, 1:] / table[0, :-1], _divide_successive(table[1])
    fnn, distance, lonely, pairs = table[2:, :dims]
    return Unfolding(np.arange(1.0, dims + 1.0), e1, e2, fnn, distance, lonely, pairs, _count_distinct(x, lag, dims))


def _count_distinct(x: Array, lag: int, dims: int) -> int:
    """Return the number of different delay vectors, which is small if the motion repeats exactly."""
    mixed = sum(math.cos(1.0 + k) * x[k * lag : len(x) - (dims - 1 - k) * lag] for k in range(dims))
    return len(np.unique(mixed))


def _divide_successive(moves: Array) -> Array:
    """Return the ratio of each entry to the one before it, without the first; 1 where the one before is zero."""
    return np.where(moves[:-1] > 0.0, moves[1:] / np.where(moves[:-1] > 0.0, moves[:-1], 1.0), 1.0)


def _pair_neighbours(x: Array, lag: int, dims: int, theiler: int, norm: Norm) -> list[tuple[Array, Array]]:
    """Return for each dimension the distances of nearest neighbours, and their differences in the next coordinate."""
    trees: dict[int, Tree] = {}

    def plant(begin: int, end: int) -> None:
        for d in range(begin, end):
            trees[d] = grow(delay_vectors(x[: len(x) - lag], lag, d + 1))

    spread(plant, dims, slices=dims)
    found, least = [], ROUNDING * float(np.ptp(x))
    guess: Indices | None = None
    for d in range(dims):
        points, ahead = trees[d].points, (d + 1) * lag
        hints = _keep_valid(guess, len(points))
        guess, far = nearest(points, theiler=theiler, norm=norm, least=least, guess=hints, tree=trees[d])
        i = np.flatnonzero(guess >= 0)
        found.append((far[i], np.abs(x[i + ahead] - x[guess[i] + ahead])))
    return found


def _keep_valid(guess: Indices | None, n: int) -> Indices | None:
    """Return the neighbours found one dimension below, with -1 for those that are not among the n vectors."""
    return None if guess is None else np.where(guess[:n] < n, guess[:n], -1)


def compute_cao_curves(x: Array, lag: int, *, dims: int = 8, theiler: int, norm: Norm = "max") -> tuple[Array, Array]:
    """Return E1 and E2, each (dims,), of x (n,): Cao, Physica D 110 (1997) 43-50, in the maximum norm as there.

    E1 levels off at 1 where the dimension suffices; E2 is 1 in all dimensions if the next value cannot be predicted.
    """
    both = unfold(x, lag, dims=dims, theiler=theiler, norm=norm)
    return both.e1, both.e2


def compute_false_neighbours(
    x: Array,
    lag: int,
    *,
    dims: int = 8,
    theiler: int,
    norm: Norm = "euclidean",
    ratio: float = 10.0,
    loneliness: float = 2.0,
) -> Array:
    """Return the share (dims,) of nearest neighbours of x (n,) that are false, by either of two criteria.

    Kennel, Brown, Abarbanel, Physical Review A 45 (1992) 3403-3411, in the Euclidean norm as there.
    """
    return unfold(x, lag, dims=dims, theiler=theiler, norm=norm, ratio=ratio, loneliness=loneliness).fnn


def _refuse_too_few(found: Unfolding, method: str, fewest: int) -> EmbeddingDimension | None:
    """Return a default dimension where there are too few neighbours, else None."""
    least = int(found.pairs.min())
    if least >= LEAST_PAIRS // 2:
        return None
    says = (
        f"only {least} points have a neighbour that is no exact repeat, in {int(found.dim[np.argmin(found.pairs)])} "
        f"dimensions: dimension {fewest} is assumed"
    )
    return EmbeddingDimension(fewest, method, "too_few_neighbours", says)


def choose_by_cao(found: Unfolding, *, change: float = 0.05, level: float = 0.9, fewest: int = 2) -> EmbeddingDimension:
    """Return the first dimension from which E1 is above `level` and rises by less than `change` to the next.

    With noise, E1 approaches 1 slowly and may not level off within the dimensions that are examined, and E2 is 1 in
    all of them. The sentence of the result then warns, since noise has no embedding dimension.
    """
    if few := _refuse_too_few(found, "cao", fewest):
        return few
    slack = change + 2.0 / np.sqrt(np.clip(found.pairs, 1.0, found.distinct))
    flat = found.e1 >= level
    flat[:-1] &= np.diff(found.e1) < slack[:-1]
    flat[: fewest - 1] = False
    noise = _describe_noise(found)
    if flat[: max(len(flat) - 1, fewest)].any():
        return EmbeddingDimension(int(np.argmax(flat)) + 1, "cao", "uncertain" if noise else "ok", noise)
    says = f"Cao's E1 does not level off within {len(flat)} dimensions, as that of noise does not"
    return EmbeddingDimension(max(len(flat), fewest), "cao", "not_saturating", f"{says}. {noise}".strip(". "))


def _describe_noise(found: Unfolding) -> str:
    """Return a sentence if E2 is 1 in all dimensions within its sampling error, else an empty string.

    A periodic motion with few levels has E2 = 1 as well, but its E1 is 1 from the first dimension on.
    """
    off = float(np.abs(found.e2 - 1.0).max())
    most = 0.05 + 5.0 / math.sqrt(max(float(found.pairs.min()), 1.0))
    if off > most or found.e1[0] > 0.5:
        return ""
    return (
        f"Cao's E2 is 1 in all dimensions (within {off:.2f}): the next value does not depend on the values before, so "
        "the series looks stochastic"
    )


def choose_by_false_neighbours(found: Unfolding, *, share: float = 0.01, fewest: int = 2) -> EmbeddingDimension:
    """Return the first dimension with at most `share` of false neighbours, else the one with the fewest."""
    if few := _refuse_too_few(found, "fnn", fewest):
        return few
    fnn = found.fnn.copy()
    fnn[: fewest - 1] = np.inf
    if (fnn <= share).any():
        return EmbeddingDimension(int(np.argmax(fnn <= share)) + 1, "fnn")
    dim = int(np.argmax(fnn <= fnn.min() + share)) + 1
    return EmbeddingDimension(
        dim,
        "fnn",
        "not_saturating",
        f"{100 * found.fnn[dim - 1]:.2g} % of the nearest neighbours stay false in {dim} dimensions and more "
        f"({100 * share:g} % are allowed), as with noise or with few levels",
    )
