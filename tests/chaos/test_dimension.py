"""Correlation sums against their slow twin, and what dimension, entropy and noise level say of awkward series."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from lostmotion.contracts import Series
from lostmotion.errors import DataError
from lostmotion.results import STATUSES, Embedding
from lostmotion_chaos.quantifiers.correlation import (
    Effort,
    choose_lags,
    compute_correlation_sums,
    compute_edges,
    jackknife,
)
from lostmotion_chaos.quantifiers.correlation_curves import estimate_takens
from lostmotion_chaos.quantifiers.dimension import CorrelationDimension, CorrelationEntropy
from lostmotion_chaos.quantifiers.noise import (
    EXCESS,
    HIGH,
    LOW,
    RADIUS,
    NoiseLevel,
    estimate_noise_level,
    find_quantisation,
)


def henon(n, start=0.1):
    x = np.empty(n + 1000)
    x[:2] = start
    for i in range(2, len(x)):
        x[i] = 1.0 - 1.4 * x[i - 1] ** 2 + 0.3 * x[i - 2]
    return x[1000:] - x[1000:].mean()


def series(x, *, lag=1, dim=2, theiler=10, dt=1.0, period=None):
    return Series(np.asarray(x) - np.mean(x), dt, Embedding(lag, dim, theiler), period)


def estimate(quantifier, x, **how):
    return quantifier.estimate(series(x, **how), rng=np.random.default_rng(0))


def slow_twin(x, lag, dims, theiler, ends):
    """Return pairs closer than each radius (blocks, blocks, dims, radii) from the table of all distances."""
    n, radii = len(x) - (dims - 1) * lag, compute_edges() * np.ptp(x)
    block = np.searchsorted(ends[1:], np.arange(n), side="right")
    counts = np.zeros((len(ends) - 1, len(ends) - 1, dims, len(radii)), dtype=np.int64)
    i, j = np.triu_indices(n, theiler + 1)
    far = np.zeros(len(i))
    for m in range(dims):
        far = np.maximum(far, np.abs(x[i + m * lag] - x[j + m * lag]))
        for a, b in zip(*np.triu_indices(len(ends) - 1), strict=True):
            inside = np.sort(far[(block[i] == a) & (block[j] == b)])
            counts[a, b, m] = np.searchsorted(inside, radii * (1.0 - 1e-7))
    return counts


def test_all_dimensions_radii_and_blocks_agree_with_the_slow_twin():
    """Exact but for pairs within 1e-7 of a radius, which single precision may put on its other side."""
    x = henon(500)
    ours = compute_correlation_sums(x, 2, 4, theiler=7, effort=Effort(blocks=3))
    ends = np.array([494 * k // 3 for k in range(4)])
    twin = slow_twin(x, 2, 4, 7, ends)
    np.testing.assert_allclose(np.cumsum(ours.counts, axis=-1), twin, atol=1)
    assert ours.pairs.sum() == (494 - 7) * (494 - 8) // 2


@pytest.mark.parametrize("jobs", [1, 3])
def test_counts_do_not_depend_on_the_number_of_threads(jobs):
    x = henon(3000)
    one = compute_correlation_sums(x, 1, 5, theiler=5, effort=Effort(pairs=1_000_000, jobs=jobs))
    two = compute_correlation_sums(x, 1, 5, theiler=5, effort=Effort(pairs=1_000_000, jobs=2))
    np.testing.assert_array_equal(one.counts, two.counts)


def test_a_point_is_not_its_own_neighbour_and_nor_is_its_past():
    """nolds 0.6.3 counts self-matches and has no Theiler window: its sum at radius 0 is 1/n. Ours is zero."""
    x = np.sin(0.001 * np.arange(3000))
    sums = compute_correlation_sums(x, 1, 2, theiler=100)
    assert sums.total[:, 0].sum() == 0
    near = compute_correlation_sums(x, 1, 2, theiler=0)
    assert near.total[1, 100] > sums.total[1, 100]


def test_counters_go_beyond_single_precision():
    """TISEAN's c2naive stops counting at 2^24 = 16,777,216 a bin. Two levels put some 50 million pairs into one."""
    x = np.where(np.random.default_rng(0).random(15_000) < 0.5, 0.0, 1.0)
    sums = compute_correlation_sums(x, 1, 1, theiler=0)
    ones = int(x.sum())
    assert sums.counts.dtype == np.int64
    assert sums.total[0, 0] == ones * (ones - 1) // 2 + (15_000 - ones) * (14_999 - ones) // 2
    assert sums.total[0, 0] > 2**24


def test_close_pairs_of_a_long_series_are_counted_in_full():
    """With one pair in eight sampled, the small radii come from cells and agree with the sum over all lags."""
    x = henon(6000)
    full = compute_correlation_sums(x, 1, 4, theiler=5)
    part = compute_correlation_sums(x, 1, 4, theiler=5, effort=Effort(pairs=2_000_000, near=200_000))
    close = full.total[1] < 150_000
    assert close.sum() > 100
    np.testing.assert_allclose(part.total[1:, close], full.total[1:, close], atol=1)
    far = ~close & (full.total[1] > 0)
    np.testing.assert_allclose(part.total[1, far] / part.pairs.sum(), full.total[1, far] / full.pairs.sum(), rtol=0.1)


def test_sampled_lags_keep_step_with_nothing():
    lags = choose_lags(20_000, 50, 10_000_000)
    assert len(np.unique(lags)) == len(lags)
    phases = np.bincount(lags % 50, minlength=50)
    assert phases.min() > 0.7 * phases.mean()


def test_a_block_left_out_leaves_the_pairs_of_the_others():
    sums = compute_correlation_sums(henon(2000), 1, 3, theiler=5, effort=Effort(blocks=4))
    others = np.array([0, 1, 3])
    expected = np.cumsum(sums.counts[np.ix_(others, others)].sum(axis=(0, 1)), axis=-1)
    np.testing.assert_array_equal(sums.without_one()[2], expected)


def test_the_jackknife_error_of_a_mean_is_the_usual_one():
    x = np.random.default_rng(0).normal(size=25)
    left = (x.sum() - x) / 24
    assert jackknife(left) == pytest.approx(np.std(x, ddof=1) / 5.0)


def test_takens_estimate_is_the_mean_logarithm():
    """Against 1 / mean ln(r0/r) over the pairs themselves, to the width of the codes."""
    x = henon(1500)
    i, j = np.triu_indices(1499, 6)
    far = np.maximum(np.abs(x[i] - x[j]), np.abs(x[i + 1] - x[j + 1]))
    sums = compute_correlation_sums(x, 1, 2, theiler=5)
    radius = sums.radii[np.searchsorted(sums.radii, 0.05 * np.ptp(x))]
    plain = 1.0 / np.mean(np.log(radius / far[far < radius]))
    assert estimate_takens(sums.total[1], sums.radii, 0.0, radius) == pytest.approx(plain, rel=2e-3)


def test_too_short_and_constant_series_are_told():
    with pytest.raises(DataError, match="record longer"):
        compute_correlation_sums(np.arange(20.0), 5, 5, theiler=2)
    with pytest.raises(DataError, match="constant"):
        compute_correlation_sums(np.zeros(1000), 1, 2, theiler=2)


AWKWARD = {
    "twenty samples": np.sin(np.arange(20.0)),
    "constant": np.zeros(2000),
    "one step": np.repeat([0.0, 1.0], 1000),
    "two levels": np.where(np.random.default_rng(1).random(2000) < 0.5, 0.0, 1.0),
    "exact repeats": np.tile(np.sin(2 * np.pi * np.arange(25) / 25), 80),
    "coarse encoder": np.round(6.0 * np.sin(0.05 * np.arange(3000))),
    "stuck now and then": np.where(np.arange(3000) % 600 < 200, 0.5, np.sin(0.11 * np.arange(3000))),
    "a spike": np.concatenate([1e-6 * np.random.default_rng(2).normal(size=1500), [1e6], np.zeros(500)]),
    "white noise": np.random.default_rng(3).normal(size=2000),
    "random walk": np.cumsum(np.random.default_rng(4).normal(size=2000)),
    "far from zero": 1e9 + np.round(1e3 * henon(2000)),
    "a ramp": np.arange(2000.0),
}


@pytest.mark.parametrize(
    "quantifier", [CorrelationDimension(), CorrelationDimension(fast=True), CorrelationEntropy(), NoiseLevel()]
)
@pytest.mark.parametrize("name", AWKWARD)
def test_awkward_series_get_an_answer_or_a_sentence(quantifier, name):
    found = estimate(quantifier, AWKWARD[name], lag=3, dim=3, theiler=20)
    assert found.status in STATUSES
    assert not found.says[:1].islower()
    assert found.ok or found.says.endswith(".")
    if found.ok:
        assert np.isfinite(found.value)
        assert found.low <= found.value <= found.high


def test_noise_has_no_dimension():
    """White noise, and noise with a memory: the slope rises with every dimension."""
    white = np.random.default_rng(5).normal(size=6000)
    for x, lag in ((white, 1), (lfilter([1.0], [1.0, -0.9], white), 10)):
        found = estimate(CorrelationDimension(), x, lag=lag, dim=4, theiler=50)
        assert found.status == "rising"
        assert np.nanmax(found.curve["slope"]) > 3.0


def test_a_noisy_cycle_is_below_noise_and_a_clean_one_has_dimension_one():
    t = np.arange(8000)
    clean = np.sin(0.1 * t)
    found = estimate(CorrelationDimension(), clean, lag=15, dim=3, theiler=60)
    assert found.ok
    assert found.low < 1.0 < found.high
    noisy = clean + 0.1 * np.random.default_rng(6).normal(size=8000)
    assert estimate(CorrelationDimension(), noisy, lag=15, dim=3, theiler=60).status == "below_noise"


def test_exact_repeats_are_a_cycle_once_they_are_out_of_step():
    found = estimate(CorrelationDimension(), np.tile(np.sin(2 * np.pi * np.arange(50) / 50), 160), lag=12, theiler=50)
    assert found.ok
    assert found.low < 1.0 < found.high
    assert "50 samples a period" in found.says


def test_the_curve_holds_what_is_promised():
    found = estimate(CorrelationDimension(), henon(5000))
    dims, radii = found.curve["slope"].shape
    assert found.curve["radius"].shape == (radii,)
    assert found.curve["log_correlation"].shape == (dims, radii)
    for key in ("dim", "dimension_by_dim", "low_by_dim", "high_by_dim"):
        assert found.curve[key].shape == (dims,)
    assert {"r_low", "r_high", "pairs", "ties", "takens"} <= set(found.details)
    assert found.details["r_low"] < found.details["r_high"]


def test_the_same_seed_gives_the_same_numbers():
    one, two = (estimate(CorrelationDimension(), henon(3000)) for _ in range(2))
    assert (one.value, one.low, one.high) == (two.value, two.low, two.high)


def test_takens_and_given_dimensions_are_options():
    plain, other = (estimate(CorrelationDimension(takens=on, dims=5), henon(5000)) for on in (False, True))
    assert len(plain.curve["dim"]) == 5
    assert other.value == plain.details["takens"]
    assert plain.low < other.value < plain.high


def test_the_fast_slope_is_a_number_for_noise_too_and_tells_chaos_from_it():
    chaos = estimate(CorrelationDimension(fast=True), henon(4000)).value
    noise = estimate(CorrelationDimension(fast=True), np.random.default_rng(7).normal(size=4000)).value
    assert 0.9 < chaos < 1.5
    assert noise > 3.0


def test_quantised_series_do_not_make_the_slope_wrong():
    """TSDynamics and nolitsa break down on 8 bits. Ties are spread by a dither, and smaller radii are left out."""
    x = henon(8000)
    step = np.ptp(x) / 256
    found = estimate(CorrelationDimension(), step * np.round(x / step))
    assert found.ok
    assert found.low < 1.22 < found.high
    assert found.details["r_low"] > 2.0 * step


def test_the_step_of_a_sensor_is_found_only_where_there_is_one():
    x = henon(2000)
    assert find_quantisation(x) == 0.0
    assert find_quantisation(0.01 * np.round(x / 0.01)) == pytest.approx(0.01, rel=1e-6)
    assert find_quantisation(np.tile(np.sin(np.arange(50.0)), 40)) == 0.0


def test_the_noise_scale_is_the_integral_it_is_said_to_be():
    """A flat piece of attractor with two dimensions, all coordinates moving alike: density of separations d.

    The chance of all m coordinates within r is the integral of d (P(|d + noise| < r))^m over d.
    """
    from scipy.special import erf

    d = np.linspace(0.0, 60.0, 30_001)
    radius = np.exp(np.linspace(np.log(1.0), np.log(7.0), 120))

    def slope(m):
        inside = [np.trapezoid(d * (0.5 * (erf((r - d) / 2) + erf((r + d) / 2))) ** m, d) for r in radius]
        return np.gradient(np.log(inside), np.log(radius))

    excess = (slope(HIGH) - slope(LOW)) / (HIGH - LOW)
    expected = np.exp(np.interp(-EXCESS, -excess, np.log(radius)))
    np.testing.assert_allclose(RADIUS / 1.05, expected, rtol=0.01)


@pytest.mark.parametrize("share", [0.01, 0.05, 0.2])
def test_the_noise_level_is_good_to_a_fifth(share):
    """One seed each; the spread over seeds is below 10 %, so that 20 % fails in less than one of a hundred."""
    t = 0.05 * np.arange(12_000)
    clean = np.sin(t) + 0.7 * np.sin(np.sqrt(2.0) * t)
    x = clean + share * np.std(clean) * np.random.default_rng(8).normal(size=len(t))
    found = estimate_noise_level(x - x.mean(), Embedding(20, 4, 120))
    assert found.value == pytest.approx(share / np.sqrt(1 + share**2), rel=0.2)
    assert found.low < share < found.high


def test_clean_data_are_not_said_to_be_noisy_and_noise_is_all_noise():
    clean = estimate_noise_level(henon(8000), Embedding(1, 2, 5))
    assert clean.high < 0.02
    white = estimate_noise_level(np.random.default_rng(9).normal(size=5000), Embedding(1, 2, 5))
    assert 0.75 < white.value < 1.2
    assert estimate_noise_level(np.arange(30.0), Embedding(1, 2, 5)).status == "too_short"


def test_the_noise_level_does_not_depend_on_the_unit_or_the_offset():
    x = henon(3000) + 0.05 * np.random.default_rng(10).normal(size=3000)
    one, two = (estimate_noise_level(y, Embedding(1, 2, 5)) for y in (x, 1e-7 * x))
    assert one.value == pytest.approx(two.value, rel=1e-6)
