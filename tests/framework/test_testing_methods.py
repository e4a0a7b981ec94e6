"""Bad embedders, quantifiers, surrogates and denoisers each break the rule that was written for them."""

from dataclasses import dataclass

import numpy as np
import pytest

from lostmotion.contracts import Denoiser, Embedder, Flow, Quantifier, Series, Surrogate
from lostmotion.results import Embedding, Estimate
from lostmotion.testing import check

PAPER = "Somebody, Journal 1 (2000) 1"


@dataclass(frozen=True)
class Shuffle(Surrogate):
    """Keeps the values and nothing else."""

    name = "shuffle"
    paper = PAPER
    null = "the samples are independent"
    preserves = frozenset({"mean", "variance", "amplitudes"})

    def draw(self, series, *, draws, rng):
        return np.array([rng.permutation(series.x) for _ in range(draws)])


@dataclass(frozen=True)
class Pair(Embedder):
    """Two coordinates, ten samples apart."""

    name = "pair"
    paper = PAPER

    def choose(self, x, *, dt):
        return Embedding(10, 2, 10)


@dataclass(frozen=True)
class Spread(Quantifier[Series]):
    """The standard deviation."""

    name = "spread"
    paper = PAPER
    unit = "1"

    def estimate(self, data, *, rng):
        value = float(np.std(data.x))
        return Estimate(value, 0.9 * value, 1.1 * value, "ok")


@dataclass(frozen=True)
class Rate(Quantifier[Flow]):
    """The mean growth."""

    name = "rate"
    paper = PAPER
    unit = "1/s"
    reads = "flow"

    def estimate(self, data, *, rng):
        value = float(np.mean(data.strobe(data.start, periods=10, tangents=1).growth)) / data.period
        return Estimate(value, value, value, "ok", "1/s")


@dataclass(frozen=True)
class Mean3(Denoiser):
    """A moving average."""

    name = "mean_3"
    paper = PAPER

    def clean(self, series, *, noise, rng):
        return np.convolve(np.pad(series.x, 1, mode="edge"), np.ones(3) / 3, "valid")


@pytest.mark.parametrize("good", [Shuffle, Pair, Spread, Rate, Mean3])
def test_a_good_one_breaks_no_rule(good):
    assert [str(f) for f in check(good) if not f.ok] == []


def raising(self, *args, **kwargs):
    raise ZeroDivisionError("all is lost")


def changing(method):
    def changed(self, x, *args, **kwargs):
        getattr(x, "x", x)[0] = 0.0
        return method(self, x, *args, **kwargs)

    return changed


def forgetting(self, series, *, draws, rng):
    return np.array([np.random.permutation(series.x) for _ in range(draws)])  # noqa: NPY002


BAD = [
    (Pair, "choose", lambda self, x, *, dt: raising(self), "answers_every_series"),
    (Pair, "choose", lambda self, x, *, dt: Embedding(1.5, 2), "embedding_is_whole"),
    (Pair, "choose", lambda self, x, *, dt: changing(Pair.choose)(self, x, dt=dt), "leaves_its_input_alone"),
    (Spread, "estimate", lambda self, data, *, rng: Estimate(1.0, 2.0, 3.0, "ok"), "estimate_is_sound"),
    (Spread, "estimate", lambda self, data, *, rng: Estimate(1.0, 1.0, 1.0, "ok", "m"), "estimate_is_sound"),
    (Spread, "estimate", lambda self, data, *, rng: Estimate(1.0, 1.0, 1.0, "odd"), "estimate_is_sound"),
    (Shuffle, "draw", forgetting, "same_seed_same_answer"),
    (Shuffle, "draw", lambda self, series, *, draws, rng: np.tile(series.x, (draws, 1)), "surrogates_are_surrogates"),
    (Shuffle, "draw", lambda self, series, *, draws, rng: rng.normal(size=(draws, 9)), "surrogates_are_surrogates"),
    (Mean3, "clean", lambda self, series, *, noise, rng: series.x[:-1], "cleaned_series_is_whole"),
    (Mean3, "clean", lambda self, series, *, noise, rng: 0.0 * series.x, "cleaned_series_is_whole"),
]


@pytest.mark.parametrize(("base", "method", "wrong", "broken"), BAD)
def test_a_bad_one_breaks_its_rule_by_name(base, method, wrong, broken):
    bad = dataclass(frozen=True)(type("Bad", (base,), {method: wrong, "__doc__": "Bad."}))
    assert broken in {f.rule for f in check(bad()) if not f.ok}


@pytest.mark.parametrize(
    ("claims", "broken"),
    [(frozenset({"beauty"}), "preserved_things_are_known"), (frozenset({"spectrum"}), "keeps_what_it_preserves")],
)
def test_a_claim_that_does_not_hold_is_found(claims, broken):
    bad = dataclass(frozen=True)(type("Bad", (Shuffle,), {"preserves": claims, "__doc__": "Bad."}))
    assert broken in {f.rule for f in check(bad()) if not f.ok}
