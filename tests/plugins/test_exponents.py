"""Exponents from recordings: kernels against slow twins, and what is said of input that holds no exponent."""

import math

import numpy as np
import pytest

from lostmotion.contracts import Series
from lostmotion.results import STATUSES, Embedding
from lostmotion_plugins.quantifiers._kernels_divergence import follow, same_phase, square, visits, walk
from lostmotion_plugins.quantifiers.divergence import components, states
from lostmotion_plugins.quantifiers.kantz import Kantz
from lostmotion_plugins.quantifiers.rosenstein import Rosenstein
from lostmotion_plugins.quantifiers.wolf import Wolf

RNG = np.random.default_rng(20260)
METHODS = (Rosenstein(), Kantz(), Wolf())
REFINED = (Rosenstein(), Kantz())
N = 6000
T = np.arange(N)


def series(x, *, lag=12, dim=4, theiler=50, dt=0.01, period=None):
    x = np.asarray(x, dtype=float)
    return Series(x - x.mean(), dt, Embedding(lag, dim, theiler), period)


def estimate(method, data):
    return method.estimate(data, rng=np.random.default_rng(1))


def henon(n):
    x, y, out = 0.1, 0.1, np.empty(n)
    for k in range(n):
        x, y = 1.0 - 1.4 * x * x + y, 0.3 * x
        out[k] = x
    return out[100:]


def autoregressive(n, memory):
    out = np.zeros(n)
    for k, kick in enumerate(RNG.standard_normal(n)):
        out[k] = memory * out[k - 1] + kick
    return out


def tone(period):
    return np.sin(2 * np.pi * T / period) + 0.3 * np.cos(4 * np.pi * T / period + 1.0)


def noisy(x, share):
    return x + share * x.std() * RNG.standard_normal(len(x))


# Kernels and their slow twins


def slow_square(points, i, j, flow):
    d = points[i] - points[j]
    if not flow:
        return d @ d
    f = points[i + 1] - points[i - 1] + points[j + 1] - points[j - 1]
    across = d - f * (d @ f) / (f @ f)
    return across @ across


@pytest.mark.parametrize("flow", [False, True])
def test_distance_across_the_flow(flow):
    points = RNG.standard_normal((40, 3))
    for i, j in ((1, 20), (5, 30), (38, 2)):
        assert square(points, i, j, flow) == pytest.approx(slow_square(points, i, j, flow), rel=1e-10)


@pytest.mark.parametrize("before", [False, True])
def test_pairs_are_followed_as_the_slow_twin_does(before):
    points = RNG.standard_normal((200, 3))
    wanted = np.arange(1, 100, 7)
    groups = RNG.integers(101, 150, (len(wanted), 2, 3))
    groups[RNG.random(groups.shape) < 0.3] = -1
    noise, steps = 1.0, 20
    sums, slow = np.zeros((2, steps, 4)), np.zeros((2, steps, 4))
    follow(points, wanted, groups, (True, before, 0.0, noise), sums)
    for a, i in enumerate(wanted):
        for g in range(2):
            for t in range(steps):
                d = np.array([slow_square(points, i + t, j + t, True) for j in groups[a, g] if j >= 0])
                if len(d):
                    log = np.log(np.sqrt(d).mean()) if before else 0.5 * np.log(d).mean()
                    slow[g, t] += log, np.sqrt(d).mean(), (d < noise).mean(), 1.0
    np.testing.assert_allclose(sums, slow, rtol=1e-9)


@pytest.mark.parametrize("period", [25.0, 25.4])
def test_neighbours_at_the_same_phase(period):
    points = RNG.standard_normal((500, 3))
    wanted = np.arange(1, 400, 13)
    found, skipped = np.full((len(wanted), 3), -1), np.zeros(len(wanted), bool)
    same_phase(points, wanted, (period, 30, 0.0, 450), found, skipped)
    for a, i in enumerate(wanted):
        turns = np.arange(-30, 31)
        all_of_them = np.array([round(i + k * period) for k in turns])
        good = (all_of_them >= 1) & (all_of_them < 450) & (np.abs(all_of_them - i) > 30)
        candidates = all_of_them[good]
        order = np.argsort(((points[candidates] - points[i]) ** 2).sum(axis=1))
        assert list(found[a]) == list(candidates[order[:3]])
    assert not skipped.any()


def test_neighbours_of_one_visit_count_once():
    found = np.full((1, 3), -1)
    visits(np.array([[50, 51, 49, 120, 52, 300, 20]]), 10, 200, found)
    assert found.tolist() == [[50, 120, 20]]


def test_components_are_those_of_a_singular_value_decomposition():
    x = np.cumsum(RNG.standard_normal(400))
    frames = np.stack([x[k : k + 390] for k in range(11)], axis=1)
    own = np.linalg.svd(frames - frames.mean(axis=0), full_matrices=False)[2][:3].T
    np.testing.assert_allclose(np.abs(components(x, 11, 3)), np.abs(frames @ own) / np.sqrt(11), rtol=1e-6, atol=1e-8)


def test_wolf_skips_what_is_no_distance():
    points = np.zeros((100, 2))
    gained = np.zeros((20, 3))
    assert walk(points, np.full((100, 1), 50), (5, 0.0), gained) == 0
    assert not gained.any()


# Refusals


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.name)
@pytest.mark.parametrize(
    ("data", "statuses"),
    [
        (series(RNG.standard_normal(N), lag=1, dim=5, theiler=10), {"no_scaling_region"}),
        (series(RNG.standard_normal(N), lag=8, period=0.5), {"no_scaling_region"}),
        (series(autoregressive(N, 0.95), lag=20, dim=4), {"no_scaling_region"}),
        (series(autoregressive(N, 0.95), lag=20, dim=4, period=0.5), {"no_scaling_region"}),
        (series(tone(50), period=0.5), {"below_noise"}),
        (series(tone(50)), {"below_noise", "no_scaling_region"}),
        (series(noisy(tone(50), 0.02), period=0.5), {"below_noise"}),
        (series(noisy(tone(50), 0.02)), {"below_noise", "no_scaling_region"}),
        (series(noisy(tone(50.37), 0.02), period=0.5037), {"below_noise"}),
        (series(RNG.standard_normal(20), lag=1, dim=2, theiler=1), {"too_short"}),
    ],
    ids=["white", "white-driven", "ar", "ar-driven", "exact", "exact-free", "noisy", "noisy-free", "odd", "short"],
)
def test_no_exponent_is_made_up(method, data, statuses):
    got = estimate(method, data)
    assert got.status in statuses
    assert math.isnan(got.value)
    assert len(got.says) > 20


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.name)
def test_two_tones_do_not_part(method):
    got = estimate(method, series(tone(50) + 0.6 * np.sin(2 * np.pi * T / 35.355), dim=5))
    assert got.status in STATUSES
    assert math.isnan(got.value) or got.low <= 0.0 <= got.high


def test_ten_percent_noise_is_said():
    got = estimate(Rosenstein(), series(noisy(tone(50), 0.1), period=0.5))
    assert got.status == "below_noise"


def test_a_refusal_keeps_its_curve():
    got = estimate(Rosenstein(), series(RNG.standard_normal(N), lag=1, dim=5, theiler=10))
    assert got.curve["time"].shape == got.curve["divergence"].shape == got.curve["slope"].shape
    assert got.curve["members"].shape[1] == len(got.curve["time"])


# What the estimate is


@pytest.mark.parametrize("method", REFINED, ids=lambda m: m.name)
def test_henon(method):
    # 0.41922 per iteration: Sprott, Chaos and Time-Series Analysis (2003), p. 421
    got = estimate(method, series(henon(N), lag=1, dim=2, theiler=5, dt=1.0))
    assert got.ok
    assert got.low <= 0.41922 <= got.high
    assert got.value == pytest.approx(0.41922, rel=0.05)


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.name)
@pytest.mark.parametrize("bits", [8, 12])
def test_an_encoder_that_repeats_itself_gives_a_number(method, bits):
    # nolitsa returns NaN and TSDynamics 4.30 on 8-bit Lorenz data, as ln 0 gets into the mean.
    x = henon(N)
    step = np.ptp(x) / 2**bits
    got = estimate(method, series(np.round(x / step) * step, lag=1, dim=2, theiler=5, dt=1.0))
    assert 0.3 < got.value < 0.6
    if bits == 8 and method.name != "lyapunov_wolf":
        assert got.details["repeats"] > 0.0


@pytest.mark.parametrize("method", REFINED, ids=lambda m: m.name)
def test_unit_scale_and_offset(method):
    x = henon(N)
    plain = estimate(method, series(x, lag=1, dim=2, theiler=5, dt=1.0))
    fast = estimate(method, series(1e-6 * x, lag=1, dim=2, theiler=5, dt=0.001))
    assert fast.value == pytest.approx(1000.0 * plain.value, rel=1e-6)
    assert fast.unit == "1/s"


def test_a_run_can_be_repeated():
    data = series(henon(N), lag=1, dim=2, theiler=5, dt=1.0)
    assert estimate(Rosenstein(), data).value == estimate(Rosenstein(), data).value


def test_details_say_where_the_line_was_laid():
    got = estimate(Rosenstein(), series(henon(N), lag=1, dim=2, theiler=5, dt=1.0))
    assert 0.0 <= got.details["fit_begin"] < got.details["fit_end"]
    assert got.details["e_folds"] > 1.0
    assert got.details["pairs"] > 5000


def test_flow_is_told_from_map_by_the_delay():
    assert states(series(tone(50), lag=12)).flow
    assert not states(series(henon(N), lag=1, dim=2)).flow
    assert not states(series(tone(50), lag=12, dim=1)).flow
