"""The surrogate test: ranks, sides, ties, refusals, streams and sentences."""

from __future__ import annotations

import threading

import numpy as np
import pytest

from lostmotion.contracts import Quantifier, Series, Surrogate
from lostmotion.errors import ContractError, DataError
from lostmotion.results import Embedding, Estimate
from lostmotion_chaos.analysis.surrogates import surrogate_test

DATA = Series(np.sin(0.1 * np.arange(400)), 0.1, Embedding(3, 2, 5))


class Shuffle(Surrogate):
    """Values in random order: white noise."""

    name, paper, null, preserves = "shuffle", "", "white noise", frozenset({"amplitudes"})

    def draw(self, series, *, draws, rng):
        return np.array([stream.permutation(series.x) for stream in rng.spawn(draws)])


class Cut(Shuffle):
    """The same, of a piece in the middle."""

    def piece(self, series):
        return slice(100, 350)

    def draw(self, series, *, draws, rng):
        return np.array([stream.permutation(series.x[100:350]) for stream in rng.spawn(draws)])


class Numbered(Surrogate):
    """Draw k is the number k everywhere."""

    name, paper, null, preserves = "numbered", "", "nothing", frozenset()

    def draw(self, series, *, draws, rng):
        return np.tile(np.arange(float(draws))[:, None], series.n)


class Noisy(Quantifier[Series]):
    """A statistic that draws random numbers of its own."""

    name, paper, unit = "noisy", "", "1"

    def estimate(self, data, *, rng):
        value = float(rng.normal())
        return Estimate(value, value, value, "ok")


class Picky(Quantifier[Series]):
    """Refuses where the first value is odd, or everything."""

    name, paper, unit = "picky_number", "", "1"

    def __init__(self, everything=False):
        self.everything = everything

    def estimate(self, data, *, rng):
        if self.everything or data.x[0] % 2 == 1:
            return Estimate.refused("rising", "The number keeps rising.")
        value = float(data.x[0]) - 0.5
        return Estimate(value, value, value, "ok")


def ranked(statistic, surrogate=None, seed=0, **options):
    options = {"draws": 99, "sided": "two", **options}
    return surrogate_test(DATA, surrogate or Numbered(), statistic, rng=np.random.default_rng(seed), **options)


def statistic_of(original):
    """Return a statistic that is `original` for the recording, and k for draw k."""
    return lambda x: original if np.array_equal(x, DATA.x) else x[0]


@pytest.mark.parametrize(
    ("original", "low", "high"),
    [(-1.0, 0.01, 1.0), (99.0, 1.0, 0.01), (49.5, 0.51, 0.5), (0.0, 0.02, 1.0), (98.0, 1.0, 0.02), (4.0, 0.06, 0.96)],
)
def test_ranks(original, low, high):
    """p = (1 + k) / (1 + n) on either side: never zero, and a tie counts against rejection on both."""
    for sided, p in (("low", low), ("high", high), ("two", min(1.0, 2 * min(low, high)))):
        found = ranked(statistic_of(original), sided=sided)
        assert (found.p_low, found.p_high) == pytest.approx((low, high))
        assert found.p == pytest.approx(p)
        assert found.rejects() == (p <= 0.05)


def test_all_ties_are_no_rejection():
    found = ranked(lambda x: 1.0)
    assert (found.p_low, found.p_high, found.p) == (1.0, 1.0, 1.0)


def test_two_sided_never_exceeds_one():
    """Another library doubles a tail and says 1.2."""
    assert ranked(statistic_of(49.0)).p == 1.0


def test_sentence_says_what_was_found():
    found = ranked(statistic_of(-1.0), sided="low")
    assert found.says.startswith("None of 99 surrogates (numbered) has a ")
    assert "as low as the recording's (p = 0.01)" in found.says
    assert found.says.endswith(": it is not nothing.")
    one, more = ranked(statistic_of(0.0), sided="low"), ranked(statistic_of(6.0), sided="low")
    assert one.says.startswith("1 of 99 surrogates (numbered) has ")
    assert more.says.startswith("7 of 99 surrogates (numbered) have ")
    assert more.says.endswith(": it may be nothing.")
    assert "two-sided" in ranked(statistic_of(-1.0)).says


def test_the_recording_is_cut_as_the_surrogates_are():
    seen = []
    found = surrogate_test(DATA, Cut(), lambda x: seen.append(len(x)) or x[0], rng=np.random.default_rng(0), jobs=1)
    assert set(seen) == {250}
    assert found.piece == slice(100, 350)
    assert found.original == DATA.x[100]


@pytest.mark.parametrize("jobs", [1, 2, 5])
def test_outcome_does_not_depend_on_workers(jobs):
    """Neither does it on how many draws there are: the first ones stay."""
    reference = ranked(Noisy(), Shuffle(), jobs=1)
    found = ranked(Noisy(), Shuffle(), jobs=jobs)
    assert np.array_equal(found.values, reference.values)
    assert found.original == reference.original
    assert len(np.unique(found.values)) == 99


def test_workers_are_used():
    names = set()
    barrier = threading.Barrier(2, timeout=20)

    def statistic(x):
        if x[0] in (0.0, 1.0) and not np.array_equal(x, DATA.x):
            barrier.wait()
        names.add(threading.current_thread().name)
        return float(x[0])

    ranked(statistic, jobs=2)
    assert len(names) >= 2


def test_refusals_count_against_rejection_and_are_said():
    """49 of 99 surrogates are refused, all others are higher: the recording may be one of 50, not of 100."""
    found = ranked(Picky(), sided="low")
    assert found.refused == 49
    assert np.isnan(found.values).sum() == 49
    assert found.p == pytest.approx(0.5 + 0.01 * (found.values <= found.original).sum())
    assert "For 49 surrogates it was refused: they count against a rejection." in found.says


def test_refused_for_the_recording():
    found = ranked(Picky(everything=True))
    assert np.isnan(found.p)
    assert not found.rejects()
    assert found.says == "No test: the picky number of the recording was refused (The number keeps rising)."


@pytest.mark.parametrize(("sided", "draws"), [("two", 38), ("low", 18), ("high", 0)])
def test_too_few_draws_are_refused(sided, draws):
    with pytest.raises(DataError, match="cannot reject at 5 %"):
        ranked(np.mean, sided=sided, draws=draws)


def test_unknown_side():
    with pytest.raises(DataError, match="give two, low"):
        ranked(np.mean, sided="left")


@pytest.mark.parametrize("bad", [np.zeros((3, 400)), np.zeros((99, 500)), np.full((99, 400), np.nan), np.zeros(99)])
def test_bad_surrogates_are_named(bad):
    class Bad(Shuffle):
        def draw(self, series, *, draws, rng):
            return bad

    with pytest.raises(ContractError, match="shuffle returned an array"):
        ranked(np.mean, Bad())


def test_a_piece_that_does_not_fit_is_named():
    class Bad(Cut):
        def piece(self, series):
            return slice(0, 10)

    with pytest.raises(ContractError, match="drew 250 samples"):
        ranked(np.mean, Bad())


def test_p_is_uniform_under_the_null():
    """400 seeded tests of white noise against shuffles: p <= 0.05 within binomial limits at 1e-3 (8 to 34)."""
    rejected = 0
    for seed in range(400):
        rng = np.random.default_rng(seed)
        data = Series(rng.normal(size=60), 1.0, Embedding(1, 2, 0))
        found = surrogate_test(data, Shuffle(), lambda x: float(np.mean(x[1:] * x[:-1])), draws=39, rng=rng, jobs=1)
        rejected += found.rejects()
    assert 8 <= rejected <= 34
