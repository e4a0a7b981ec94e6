"""The cheap statistics: known values, honest intervals, refusals."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from lostmotion.contracts import Series
from lostmotion.results import STATUSES, Embedding
from lostmotion_chaos.quantifiers.cheap import MutualInformation, PredictionError, TimeReversal

ALL = [MutualInformation(), TimeReversal(), PredictionError()]


def series(x, lag=1, dim=3, theiler=10):
    return Series(x - np.mean(x), 1.0, Embedding(lag, dim, theiler))


def measured(quantifier, data, seed=0):
    return quantifier.estimate(data, rng=np.random.default_rng(seed))


def coloured(n, seed, memory=0.8):
    return lfilter([1.0], [1.0, -memory], np.random.default_rng(seed).normal(size=n + 300))[300:]


def gaussian_information(memory, lag):
    """-ln(1 - r^2) / 2 with r the correlation: Cover, Thomas, Elements of Information Theory (2006), eq. (8.56)."""
    return -0.5 * np.log(1.0 - memory ** (2 * lag))


def test_information_of_a_gaussian_process_is_covered():
    """AR(1), n = 4000: the interval holds the exact value, or lies below it by less than the width of the bins costs.

    60 seeded records; the stated 95 % is met in at least 51 of 60 (binomial limit at 1e-3 for 0.95), after the
    information that 28 bins a side lose, measured on a million samples, is added to each.
    """
    lost = gaussian_information(0.8, 1) - measured(MutualInformation(bins=28), series(coloured(1_000_000, 99))).value
    assert 0.0 <= lost < 0.06
    covered = 0
    for seed in range(60):
        found = measured(MutualInformation(bins=28), series(coloured(4000, seed)), seed)
        covered += found.low + lost <= gaussian_information(0.8, 1) <= found.high + lost
    assert covered >= 51


def test_information_of_white_noise_is_zero_and_not_the_bias_of_its_bins():
    """Without the correction 28 bins a side make 0.09 nat of nothing."""
    values = [measured(MutualInformation(), series(np.random.default_rng(s).normal(size=4000))) for s in range(20)]
    assert np.mean([v.details["plain"] for v in values]) > 0.05
    assert abs(np.mean([v.value for v in values])) < 0.02


@pytest.mark.real
def test_information_of_the_reference_recording(shared):
    """0.933105 nat at lag 8 with 64 bins, on which TISEAN 3.0.1, TSDynamics 6.1.1 and nolitsa agree."""
    path = shared / "reference" / "lorenz_100k.npz"
    if not path.is_file():
        pytest.skip("no reference arrays: lorenz_100k.npz is absent")
    data = series(np.load(path)["x"][:20000], lag=8, theiler=100)
    assert measured(MutualInformation(bins=64), data).details["plain"] == pytest.approx(0.933105, abs=2e-5)


def test_time_reversal_of_a_sawtooth_and_of_its_mirror():
    """Slow rise and fast fall: negative; read backwards it is as positive. Its exact value follows from two slopes."""
    x = np.tile(np.concatenate([np.arange(9.0), [4.5]]), 100)
    forward, backward = measured(TimeReversal(), series(x)), measured(TimeReversal(), series(x[::-1]))
    exact = (8 * 1.0 - 3.5**3 - 4.5**3) / 10 / ((8 * 1.0 + 3.5**2 + 4.5**2) / 10) ** 1.5
    assert forward.value == pytest.approx(exact, rel=0.01)
    assert backward.value == pytest.approx(-forward.value, rel=0.01)


@pytest.mark.parametrize("quantifier", [TimeReversal(), PredictionError()], ids=lambda q: q.name)
def test_intervals_cover_the_value_of_long_records(quantifier):
    """Henon map with n = 2000: the stated 95 % covers what 20 records have on average in 85 % or more of 40."""

    def henon(seed, n=2000):
        x, y, out = 0.1 * np.random.default_rng(seed).random(), 0.0, np.empty(n + 100)
        for k in range(n + 100):
            x, y = 1.0 - 1.4 * x * x + y, 0.3 * x
            out[k] = x
        return out[100:]

    found = [measured(quantifier, series(henon(s), dim=2), s) for s in range(60)]
    truth = np.mean([f.value for f in found[:20]])
    assert sum(f.low <= truth <= f.high for f in found[20:]) >= 34


def test_prediction_error_of_noise_is_that_of_the_mean_and_of_order_is_small():
    """White noise: sqrt(1 + 1/5) with five neighbours. A sine: next to nothing."""
    noise = measured(PredictionError(), series(np.random.default_rng(0).normal(size=4000)))
    assert noise.value == pytest.approx(np.sqrt(1.2), rel=0.03)
    order = measured(PredictionError(), series(np.sin(0.1 * np.arange(4000)), lag=15))
    assert order.value < 0.02


def test_prediction_error_is_its_plain_twin():
    """Against all pairs of distances, in the maximum norm."""
    x, k, theiler, lag, dim = coloured(600, 3), 5, 10, 2, 3
    x = x - x.mean()
    rows = len(x) - dim * lag
    points = np.array([[x[i], x[i + lag], x[i + 2 * lag]] for i in range(rows)])
    future = x[dim * lag :]
    square = []
    for i in range(rows):
        far = np.abs(points - points[i]).max(axis=1)
        far[max(i - theiler, 0) : i + theiler + 1] = np.inf
        square.append((future[np.argsort(far)[:k]].mean() - future[i]) ** 2)
    found = measured(PredictionError(), series(x, lag, dim, theiler))
    assert found.value == pytest.approx(np.sqrt(np.mean(square)) / x.std())


@pytest.mark.parametrize("quantifier", ALL, ids=lambda q: q.name)
@pytest.mark.parametrize(
    "x",
    [
        np.tile(np.arange(10.0), 60),
        np.tile([0.0, 1.0], 300),
        np.round(4 * np.sin(0.3 * np.arange(600))),
        np.concatenate([np.zeros(400), np.sin(np.arange(200))]),
        np.eye(1, 600, 300)[0],
        1e9 + np.sin(0.1 * np.arange(600)),
        np.sin(np.arange(20.0)),
    ],
    ids=["repeats", "two values", "quantised", "constant stretch", "spike", "offset", "20 samples"],
)
@pytest.mark.parametrize("lag", [1, 10])
def test_awkward_series(quantifier, x, lag):
    with np.errstate(divide="raise", invalid="raise"):
        found = measured(quantifier, series(x, lag))
    assert found.status in STATUSES
    assert found.status == "ok" or found.says
    assert found.unit == quantifier.unit
    assert not found.ok or found.low <= found.value <= found.high


@pytest.mark.parametrize("quantifier", ALL, ids=lambda q: q.name)
def test_what_is_too_short_is_said(quantifier):
    found = measured(quantifier, series(np.sin(np.arange(20.0))))
    assert found.status == "too_short"
    assert np.isnan(found.value)
    assert "at least 100 are needed" in found.says
