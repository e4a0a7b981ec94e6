"""The front doors of the chaos laboratory hold data and plugins to what was agreed."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from lostmotion.contracts import Denoiser, Embedder, Quantifier, Series
from lostmotion.errors import CaseError, ContractError, DataError
from lostmotion.results import Embedding, Estimate
from lostmotion_chaos.analysis.denoise import denoise
from lostmotion_chaos.analysis.embed import embed
from lostmotion_chaos.analysis.quantify import quantify
from lostmotion_chaos.signals.series import checked, delay_vectors


@dataclass(frozen=True)
class Plain(Embedder):
    lag: int = 2
    dim: int = 3
    theiler: int = 1
    status: str = "ok"
    name = "plain"
    paper = "none at all"

    def choose(self, x, *, dt):
        return Embedding(self.lag, self.dim, self.theiler, status=self.status)


@dataclass(frozen=True)
class Says(Quantifier[Series]):
    answer: object = None
    name = "says"
    paper = "none at all"
    unit = "1"

    def estimate(self, data, *, rng):
        return self.answer


@dataclass(frozen=True)
class Halves(Denoiser):
    keep: int = 400
    name = "halves"
    paper = "none at all"

    def clean(self, series, *, noise, rng):
        return 0.5 * series.x[: self.keep]


def wave(n=400):
    return np.sin(0.1 * np.arange(n)) + 0.1 * np.cos(0.33 * np.arange(n))


@pytest.mark.parametrize(
    ("values", "says"),
    [
        (np.arange(20.0), "20 samples"),
        (np.ones(500), "constant"),
        (np.full(500, 1e9), "constant"),
        (np.r_[np.arange(300.0), np.nan], "number 300"),
        (np.r_[np.inf, np.arange(300.0)], "number 0"),
        (np.ones((300, 2)), "dimensions"),
        (np.exp(1j * np.arange(300)), "complex"),
        (["a"] * 300, "not a number"),
        ([10**400] * 300, "not a number"),
        (np.r_[1e308, -1e308, np.arange(300.0)], r"reaches 1e\+308"),
    ],
)
def test_values_that_cannot_be_analysed_are_refused(values, says):
    with pytest.raises(DataError, match=says):
        embed(values, Plain(), dt=0.1)


@pytest.mark.parametrize("kind", [np.int16, np.float32, np.int64])
def test_any_kind_of_number_is_taken_in_double_precision(kind):
    values = (100 * wave()).astype(kind)
    series = embed(values, Plain(), dt=0.1)
    assert series.x.dtype == np.float64
    assert np.mean(series.x) == pytest.approx(0.0, abs=1e-12)


def test_a_huge_offset_costs_no_more_digits_than_the_recording_has_lost():
    recorded = wave() + 1e9
    assert checked(recorded) == pytest.approx(checked(wave()), abs=2 * np.spacing(1e9))


@pytest.mark.parametrize("dt", [0.0, -1.0, np.nan, np.inf])
def test_a_step_that_is_no_time_is_refused(dt):
    with pytest.raises(CaseError, match=r"dt is .*: expected a number above 0"):
        embed(wave(), Plain(), dt=dt)


def test_a_period_that_is_no_time_is_refused():
    with pytest.raises(CaseError, match=r"period is -1\.0"):
        embed(wave(), Plain(), dt=0.1, period=-1.0)


def test_an_embedding_that_leaves_no_room_is_refused():
    with pytest.raises(DataError, match="too short for dim 9 and lag 45"):
        embed(wave(), Plain(45, 9), dt=0.1)


@pytest.mark.parametrize("chosen", [Plain(0, 2), Plain(1, 0), Plain(1, 2, -1), Plain(1, 2, 1, "?")])
def test_an_embedder_that_breaks_its_contract_is_named(chosen):
    with pytest.raises(ContractError, match="plain chose"):
        embed(wave(), chosen, dt=0.1)


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        (1.0, "returned float"),
        (Estimate(1.0, 2.0, 3.0, "ok"), "outside of its interval"),
        (Estimate(np.nan, np.nan, np.nan, "ok"), "the status 'ok' with the value nan"),
        (Estimate(1.0, 0.0, 3.0, "fine"), "status 'fine'"),
        (Estimate(1.0, 0.0, 3.0, "uncertain"), "without a sentence"),
    ],
)
def test_a_quantifier_that_breaks_its_contract_is_named(answer, says):
    series = embed(wave(), Plain(), dt=0.1)
    with pytest.raises(ContractError, match=says):
        quantify(series, Says(answer), rng=np.random.default_rng(0))


def test_a_refusal_is_an_answer():
    refused = Estimate.refused("rising", "it keeps rising")
    series = embed(wave(), Plain(), dt=0.1)
    assert quantify(series, Says(refused), rng=np.random.default_rng(0)) is refused


def test_noise_is_measured_before_and_after():
    series = embed(wave(4000), Plain(), dt=0.1)
    meter = Says(Estimate(0.1, 0.09, 0.11, "ok"))
    done = denoise(series, Halves(4000), meter, rng=np.random.default_rng(0))
    assert done.series.x == pytest.approx(0.5 * series.x)
    assert done.before is meter.answer
    # What halves the whole signal leaves half of it as error: sd 0.25, and half of the noise that was put on.
    assert done.after.value == pytest.approx(np.hypot(0.25, 0.05), rel=0.02)
    assert done.after.low / done.after.value == pytest.approx(0.9)


def test_a_series_without_noise_is_left_alone():
    series = embed(wave(), Plain(), dt=0.1)
    done = denoise(series, Halves(), Says(Estimate(0.0, 0.0, 0.01, "ok")), rng=np.random.default_rng(0))
    assert done.series is series


def test_a_denoiser_that_breaks_its_contract_is_named():
    series = embed(wave(), Plain(), dt=0.1)
    with pytest.raises(ContractError, match="halves returned an array"):
        denoise(series, Halves(9), Says(Estimate(0.1, 0.09, 0.11, "ok")), rng=np.random.default_rng(0))


def test_delay_vectors_are_columns_shifted_by_the_lag():
    x = np.arange(10.0)
    assert delay_vectors(x, 3, 3).tolist() == [[0, 3, 6], [1, 4, 7], [2, 5, 8], [3, 6, 9]]
    with pytest.raises(DataError, match="no delay vector"):
        delay_vectors(x, 5, 3)


def test_a_series_is_not_changed_by_its_stages():
    values = wave()
    kept = values.copy()
    series = embed(values, Plain(), dt=0.1)
    replace(series, period=1.0)
    assert np.array_equal(values, kept)
