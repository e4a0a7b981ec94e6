"""The compiled neighbour search against sorting all distances, on points that make searches go wrong."""

from __future__ import annotations

import time

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.kernels import threads
from lostmotion_chaos.kernels import neighbours
from lostmotion_chaos.signals.series import delay_vectors


def distances(points, norm):
    """All distances, summed in the order in which the kernel sums them."""
    far = np.zeros((len(points), len(points)))
    for k in range(points.shape[1]):
        step = np.abs(points[:, None, k] - points[None, :, k])
        far = np.maximum(far, step) if norm == "max" else far + step**2
    return far if norm == "max" else np.sqrt(far)


def slow_several(points, k, *, theiler, norm, least):
    far, n = distances(points, norm), len(points)
    away = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    far[(away <= theiler) | (far <= least)] = np.inf
    index = np.argsort(far, axis=1, kind="stable")[:, :k]
    far = np.take_along_axis(far, index, axis=1)
    pad = ((0, 0), (0, k - far.shape[1]))
    index, far = np.pad(index, pad), np.pad(far, pad, constant_values=np.inf)
    return np.where(np.isfinite(far), index, -1), far


def slow_within(points, radius, *, theiler, norm, least):
    far, n = distances(points, norm), len(points)
    away = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    good = (away > theiler) & (far > least) & (far <= radius)
    return np.concatenate([[0], np.cumsum(good.sum(axis=1))]), np.nonzero(good)[1]


def series(kind, n=420):
    rng = np.random.default_rng(7)
    t = np.arange(n)
    return {
        "noise": rng.normal(size=n),
        "quantised": np.round(3 * np.sin(0.1 * t) + 0.4 * rng.normal(size=n)),
        "two levels": rng.integers(0, 2, size=n).astype(float),
        "repeats": np.tile(rng.normal(size=20), n // 20),
        "slow": np.sin(2 * np.pi * t / 150.7),
        "steps": np.repeat(rng.normal(size=n // 20), 20),
        "offset": 1e9 + np.round(rng.normal(size=n), 1),
    }[kind]


KINDS = ["noise", "quantised", "two levels", "repeats", "slow", "steps", "offset"]


@pytest.mark.parametrize("norm", ["max", "euclidean"])
@pytest.mark.parametrize("kind", KINDS)
def test_neighbours_are_those_of_all_distances_sorted(kind, norm):
    for dim, theiler, least in [(1, 0, 0.0), (2, 25, 0.0), (3, 3, -1.0), (5, 60, 0.5), (12, 1, 0.0)]:
        points = delay_vectors(series(kind), 3, dim)
        law = {"theiler": theiler, "norm": norm, "least": least}
        index, far = slow_several(points, 6, **law)
        found, apart = neighbours.several(points, 6, **law)
        np.testing.assert_array_equal(found, index)
        np.testing.assert_allclose(apart, far, rtol=1e-15)
        first, near = neighbours.nearest(points, **law)
        np.testing.assert_array_equal(first, index[:, 0])
        np.testing.assert_allclose(near, far[:, 0], rtol=1e-15)


@pytest.mark.slow
@pytest.mark.parametrize("norm", ["max", "euclidean"])
@pytest.mark.parametrize("kind", KINDS)
def test_balls_hold_what_all_distances_say(kind, norm):
    for dim, theiler, least, radius in [(1, 0, -1.0, 0.3), (2, 25, 0.0, 1.0), (3, 3, -1.0, 5.0), (5, 60, 0.4, 1.6)]:
        points = delay_vectors(series(kind), 3, dim)
        law = {"theiler": theiler, "norm": norm, "least": least}
        for found, wanted in zip(
            neighbours.within(points, radius, **law), slow_within(points, radius, **law), strict=True
        ):
            np.testing.assert_array_equal(found, wanted)


@pytest.mark.slow
def test_a_guess_and_a_choice_of_queries_change_nothing():
    points = delay_vectors(series("slow"), 3, 3)
    index, far = neighbours.nearest(points, theiler=10)
    rng = np.random.default_rng(0)
    queries = rng.permutation(len(points))[:50]
    for guess in (rng.integers(-1, len(points), size=50), queries, np.full(50, len(points) + 5), index[queries]):
        found = neighbours.nearest(points, theiler=10, queries=queries, guess=guess)
        np.testing.assert_array_equal(found[0], index[queries])
        np.testing.assert_array_equal(found[1], far[queries])
    tree = neighbours.grow(points)
    np.testing.assert_array_equal(neighbours.nearest(points, theiler=10, tree=tree)[0], index)
    offsets, balls = neighbours.within(points, 0.1, theiler=10, tree=tree)
    some, chosen = neighbours.within(points, 0.1, theiler=10, queries=queries)
    np.testing.assert_array_equal(chosen, np.concatenate([balls[offsets[i] : offsets[i + 1]] for i in queries]))
    assert some[-1] == len(chosen)


def test_the_number_of_threads_changes_nothing(monkeypatch):
    points = delay_vectors(series("quantised"), 2, 3)
    two = neighbours.several(points, 4, theiler=5), neighbours.within(points, 2.0, theiler=5)
    for many in (1, 3, 7):
        monkeypatch.setattr(threads, "cores", lambda many=many: many)
        other = neighbours.several(points, 4, theiler=5), neighbours.within(points, 2.0, theiler=5)
        for ours, theirs in zip(two, other, strict=True):
            np.testing.assert_array_equal(ours[0], theirs[0])
            np.testing.assert_array_equal(ours[1], theirs[1])


def test_nothing_to_find_is_said_and_does_not_crash():
    points = np.ones((30, 2))
    index, far = neighbours.nearest(points, theiler=1)
    assert (index == -1).all()
    assert np.isinf(far).all()
    index, _ = neighbours.several(points, 3, theiler=40, least=-1.0)
    assert (index == -1).all()
    assert neighbours.several(points, 0, theiler=1)[0].shape == (30, 0)
    assert neighbours.several(points, 50, theiler=1, least=-1.0)[0].shape == (30, 50)
    offsets, found = neighbours.within(points, -1.0, theiler=1)
    assert offsets.shape == (31,)
    assert len(found) == 0
    assert len(neighbours.within(points, 0.0, theiler=0)[1]) == 30 * 29
    assert neighbours.nearest(points[:1], theiler=0)[0].tolist() == [-1]


@pytest.mark.parametrize("bad", [np.zeros((0, 2)), np.zeros(5), np.array([[1.0], [np.nan], [2.0]])])
def test_points_that_cannot_be_searched_are_refused(bad):
    with pytest.raises(DataError, match="neighbours are sought"):
        neighbours.nearest(bad, theiler=1)


@pytest.mark.parametrize(
    "x",
    [
        np.tile(np.random.default_rng(0).normal(size=50), 400),
        np.random.default_rng(1).integers(0, 4, size=20_000).astype(float),
        np.sin(np.arange(20_000) / 2000.0),
        np.zeros(20_000),
    ],
    ids=["repeats", "four levels", "slow", "constant"],
)
def test_repeats_and_slow_sampling_cost_no_more_than_other_points(x):
    """A search that lists every repeat, or every point of the query's own strand, takes minutes here."""
    noise = delay_vectors(np.random.default_rng(2).normal(size=20_000), 8, 8)
    neighbours.nearest(noise[:100], theiler=1)

    def cost(points, theiler):
        begin = time.perf_counter()
        neighbours.nearest(points, theiler=theiler)
        neighbours.several(points, 5, theiler=theiler)
        return time.perf_counter() - begin

    assert cost(delay_vectors(x, 8, 3), 2000) < 10.0 * cost(noise, 1)
