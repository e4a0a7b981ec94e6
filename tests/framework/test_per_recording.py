"""Parameters that each recording has for itself: noise, random force, zero of the sensor, and what has each = true."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import stats
from scipy.linalg import expm

from lostmotion.case import CaseFile, Prior, SensorSpec
from lostmotion.contracts import Param
from lostmotion.inference.setup import (
    cut_beginnings,
    make_free_parameter,
    make_posterior,
    search_maximum,
    separate_levels,
)
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.noise_levels import LEAST, make_own_levels
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.predict import observe_states, predict_freely
from lostmotion.likelihood.space import (
    OFFSET,
    RANDOM,
    FreeParameter,
    ParameterSpace,
    RecordingCoordinates,
    Scales,
    list_keys,
    split_key,
)
from lostmotion.likelihood.system import Slot, System
from lostmotion.noises import NOISE
from lostmotion.quantities import DAMPING
from lostmotion.registry import default

M, C, K, DT = 2.0, 3.0, 800.0, 0.01
"""A linear oscillator whose drive is held between the samples, so that the matrix exponential solves it exactly."""
PRIORS = {"c": Prior(0.3, 30.0, "log"), "k": Prior(200.0, 3000.0, "log")}
QUIET = {"drive": 1.0, "noise": 2e-5, "zero": 0.0}
LOUD = {"drive": 10.0, "noise": 1e-3, "zero": 5e-3}
SLIP = 0.02
"""The noise of the measured force, as a share of the drive."""


def recorded(name: str, seed: int, *, samples: int = 3000, c: float = C, **how: float) -> Observation:
    """Return a recording of the oscillator under a broad-band drive of which the measured force is noisy."""
    rng = np.random.default_rng(seed)
    how = {**QUIET, **how}
    a = np.array([[0.0, 1.0, 0.0], [-K / M, -c / M, 1.0 / M], [0.0, 0.0, 0.0]])
    step = expm(a * DT)
    push = how["drive"] * np.repeat(rng.choice([-1.0, 1.0], samples // 5 + 1), 5)[:samples]
    y, seen = np.zeros(2), np.zeros(samples)
    for i, u in enumerate(push):
        seen[i] = y[0]
        y = (step @ np.append(y, u))[:2]
    seen += how["zero"] + how["noise"] * rng.standard_normal(samples)
    felt = push + SLIP * how["drive"] * rng.standard_normal(samples)
    return Observation.of(name, seen, felt[:, None], DT, "position", held=True)


def case_of(estimate: dict[str, Prior]) -> CaseFile:
    known = {k: v for k, v in {"m": M, "c": C, "k": K}.items() if k not in estimate}
    return CaseFile("study", Path(), (), "linear_oscillator", known, estimate, {}, (), "")


def posterior_for(*observations: Observation, **estimate: Prior) -> Posterior:
    system = System(default().make("model", "linear_oscillator"), ())
    return make_posterior(system, case_of(estimate or PRIORS), observations)


TWO = (recorded("low", 1, **QUIET), recorded("run 2.5 [high]", 2, **LOUD))
LOW, HIGH = (t.name for t in TWO)


@pytest.fixture(scope="module")
def apart():
    """The fit of two levels with all of the sensor's parameters their own."""
    fit = search_maximum(posterior_for(*TWO), np.random.default_rng(0))
    return separate_levels(fit, SensorSpec(offset=Prior(mean=0.0, sd=0.1)))


def test_keys_say_the_recording() -> None:
    assert list_keys("c", (LOW, HIGH)) == ("c[low]", "c[run 2.5 [high]]")
    assert list_keys("c", (LOW,)) == ("c",)
    assert [split_key(k) for k in ("c", "friction.force", *list_keys("c", (LOW, HIGH)))] == [
        ("c", None), ("friction.force", None), ("c", LOW), ("c", HIGH)]  # fmt: skip


def test_each_recording_is_filtered_with_its_own_values(apart) -> None:
    """The joint likelihood is, bit by bit, that of two posteriors which know of one recording only. No chance."""
    posterior, values = apart.posterior, dict(zip(apart.posterior.space.keys, apart.theta, strict=True))
    joint = posterior.innovations(apart.theta)
    for i, observation in enumerate(posterior.observations):
        own = [f for f in posterior.space.free if f.recording in (None, observation.name)]
        single = replace(posterior, observations=(observation,)).over(replace(f, key=f.parameter) for f in own)
        theta = np.array([values[f.key] for f in own])
        seen = single.innovations(theta)
        part = slice(0, observation.samples) if i == 0 else slice(-observation.samples, None)
        assert np.array_equal(joint.errors[part], seen.errors)
        assert np.array_equal(joint.variances[part], seen.variances)
        assert posterior.recordings[i].noise(apart.theta).white == single.recordings[0].noise(theta).white
        assert np.array_equal(posterior.recordings[i].full(apart.theta), single.recordings[0].full(theta))


def test_differences_filter_only_what_has_moved(apart, monkeypatch) -> None:
    posterior, theta = replace(apart.posterior, jobs=1), apart.theta
    points = np.vstack([theta, theta + 1e-3 * np.eye(len(theta))])
    runs = []
    plain = Lanes.filter
    monkeypatch.setattr(Lanes, "filter", lambda run, o, at: (runs.append(len(at)), plain(run, o, at))[1])
    together = posterior.innovations(points)
    shared = sum(f.recording is None for f in posterior.space.free)
    assert shared == 2
    assert sum(runs) == 2 + 2 * shared + (len(theta) - shared)
    for i, point in enumerate(points):
        alone = posterior.innovations(point)
        assert np.array_equal(together[i].errors, alone.errors)
        assert np.array_equal(together[i].variances, alone.variances)


def test_levels_of_each_recording_are_found(apart) -> None:
    """Within four of their standard deviations (one seeded pair; false alarm below 1e-3), where shared ones are not."""
    sd, values = apart.sd, apart.values
    assert apart.status == "converged"
    truths = {
        "c": math.log(C), "k": math.log(K),
        f"log_noise[{LOW}]": math.log(QUIET["noise"]), f"log_noise[{HIGH}]": math.log(LOUD["noise"]),
        f"log_random_force[{LOW}]": math.log((SLIP * QUIET["drive"]) ** 2 * DT),
        f"log_random_force[{HIGH}]": math.log((SLIP * LOUD["drive"]) ** 2 * DT),
        f"offset[{LOW}]": 0.0, f"offset[{HIGH}]": LOUD["zero"],
    }  # fmt: skip
    assert list(values) == list(apart.posterior.space.keys)
    assert set(values) == set(truths)
    misses = {k: (c - truths[k]) / sd[k] for k, c in zip(apart.posterior.space.keys, apart.theta, strict=True)}
    assert all(abs(miss) < 4.0 for miss in misses.values()), misses
    assert values[f"offset[{HIGH}]"] > 10.0 * sd[f"offset[{HIGH}]"]
    assert apart.log_likelihood > search_maximum(posterior_for(*TWO), np.random.default_rng(0)).log_likelihood + 1000.0


def test_usual_random_force_is_in_proportion_to_each_drive(apart) -> None:
    low, high = (f for f in apart.posterior.space.free if f.parameter == RANDOM)
    assert high.mean - low.mean == pytest.approx(2.0 * math.log(LOUD["drive"] / QUIET["drive"]), abs=0.05)
    assert high.high - low.high == pytest.approx(high.mean - low.mean)
    assert (low.low, high.low) == pytest.approx((low.mean + LEAST, high.mean + LEAST))


def test_a_shift_of_the_response_is_a_shift_of_its_zero() -> None:
    observation = TWO[0]
    posterior = separate_levels(
        search_maximum(posterior_for(observation), np.random.default_rng(0)), SensorSpec(offset=Prior(-1.0, 1.0))
    ).posterior
    assert posterior.space.keys == ("c", "k", OFFSET, RANDOM, NOISE)
    theta = posterior.space.start
    moved = theta + 0.125 * (np.array(posterior.space.keys) == OFFSET)
    other = posterior.on((replace(observation, readings=observation.readings + 0.125),))
    assert other.innovations(moved).log_likelihood == pytest.approx(
        posterior.innovations(theta).log_likelihood, abs=1e-3
    )
    assert other.innovations(theta).log_likelihood < posterior.innovations(theta).log_likelihood - 100.0


def test_nothing_is_split_where_nothing_is_its_own() -> None:
    one = search_maximum(posterior_for(TWO[0]), np.random.default_rng(0))
    assert separate_levels(one, SensorSpec()) is one
    two = search_maximum(posterior_for(*TWO), np.random.default_rng(0))
    assert separate_levels(two, SensorSpec("shared")) is two
    zeros = separate_levels(two, SensorSpec("shared", Prior(mean=0.0, sd=1.0))).posterior.space.keys
    assert zeros == ("c", "k", f"offset[{LOW}]", f"offset[{HIGH}]", RANDOM, NOISE)


def test_what_is_split_stays_split(apart) -> None:
    assert separate_levels(apart, SensorSpec(offset=Prior(mean=0.0, sd=0.1))) is apart


def test_a_base_motion_sets_what_is_usual_by_its_own_amplitude() -> None:
    """Twice the motion of the base, and half the sampling interval: ln(4/2) more, whatever the parameters."""
    rng = np.random.default_rng(0)
    base = np.stack([rng.standard_normal(400), np.zeros(400)], axis=1)
    observations = (
        Observation.of("a", base[:, 0], base, DT, "position"),
        Observation.of("b", base[:, 0], 2.0 * base, DT / 2.0, "position"),
    )
    system = System(default().make("model", "robot_joint"), ())
    posterior = Posterior(
        ParameterSpace(()), observations, Lanes(system), Scales(1.0, 1.0, 1.0, usual=-3.0), system.vector({})
    )
    low, high = (f for f in make_own_levels(posterior, -2.0) if f.parameter == RANDOM)
    assert (low.mean, low.start) == pytest.approx((-3.0, -2.0))
    assert (high.mean, high.start) == pytest.approx((-3.0 + math.log(2.0), -2.0 + math.log(2.0)))


def test_a_prior_with_each_gives_every_recording_its_own_value() -> None:
    """Two dampings, 3 and 6 N s/m, each found within four standard deviations (one seeded pair; chance below 1e-3)."""
    observations = (recorded("a", 3), recorded("b", 4, c=2.0 * C))
    posterior = posterior_for(*observations, c=replace(PRIORS["c"], each=True), k=PRIORS["k"])
    assert posterior.space.keys == ("c[a]", "c[b]", "k", RANDOM, NOISE)
    fit = search_maximum(posterior, np.random.default_rng(0))
    for i, (key, truth) in enumerate({"c[a]": C, "c[b]": 2.0 * C}.items()):
        assert abs(math.log(fit.values[key] / truth)) < 4.0 * fit.sd[key]
        assert posterior.recordings[i].full(fit.theta)[posterior.system.index["c"]] == fit.values[key]
    assert fit.sd["c[a]"] < 0.05
    other = posterior.on((recorded("c", 5, samples=200),))
    middle = math.sqrt(fit.values["c[a]"] * fit.values["c[b]"])
    assert other.recordings[0].full(fit.theta)[posterior.system.index["c"]] == pytest.approx(middle)
    assert posterior_for(observations[0], c=replace(PRIORS["c"], each=True)).space.keys == ("c", RANDOM, NOISE)


def test_a_route_that_is_nowhere_is_refused() -> None:
    route = RecordingCoordinates.of(("c[a]", "k"), "b")
    assert route.at(np.array([3.0, 4.0]), "c") == 3.0
    assert list(route.used) == [True, True]
    with pytest.raises(KeyError):
        route.at(np.zeros(2), NOISE)


def test_predictions_use_what_the_recording_has_for_itself(apart) -> None:
    posterior, theta = apart.posterior, apart.theta
    states = np.zeros((3, 2))
    zero = apart.values[f"offset[{HIGH}]"]
    assert observe_states(posterior, theta, states, (0, 1)) == pytest.approx(np.full(3, zero))
    (runs,) = predict_freely(posterior, theta, np.zeros((1, 2)), np.array([0]), 20, index=1)
    assert np.abs(runs.error).max() < 6.0 * LOUD["noise"]


def test_the_beginnings_of_all_recordings_are_searched() -> None:
    assert [t.samples for t in cut_beginnings(posterior_for(TWO[0])).observations] == [3000]
    many = [recorded(str(i), i, samples=n) for i, n in enumerate((3000, 500, 3000, 3000))]
    assert [t.samples for t in cut_beginnings(posterior_for(*many)).observations] == [1500, 500, 1500, 1500]


def test_log_likelihoods_are_those_of_single_points() -> None:
    posterior = posterior_for(TWO[0])
    points = np.stack([posterior.space.start, posterior.space.start + 0.1, posterior.space.start])
    points[2, posterior.space.keys.index("k")] = 60.0
    expected = [posterior.innovations(p).log_likelihood for p in points[:2]]
    assert list(posterior.log_likelihood(points)) == [*expected, -math.inf]
    assert list(replace(posterior, jobs=1).log_likelihood(points)) == [*expected, -math.inf]


FREES = [
    Prior(0.8, 80.0, "log"), Prior(0.1, 3.0), Prior(mean=2.0, sd=0.1), Prior(mean=0.1, sd=0.5), Prior(half_sd=3.0),
    Prior(median=2.0, sd_log=0.5), Prior(mean=-4.0, sd=0.5),
]  # fmt: skip


@pytest.mark.parametrize("prior", FREES, ids=lambda p: p.kind)
def test_the_prior_of_a_coordinate_is_a_density_and_its_quantile_inverts_it(prior: Prior) -> None:
    """Cut where the parameter has its bounds, here at zero and at 90; -4 +- 0.5 leaves the far tail of a bell only."""
    free = make_free_parameter(Slot("c", Param("c", "damping", DAMPING, low=0.0, high=90.0), "N s/m", None), prior)
    ends = free.quantile(0.0), free.quantile(1.0)
    assert ends == pytest.approx((free.low, free.high))
    for share in (0.1, 0.5, 0.99, 1.0):
        grid = np.linspace(free.low, free.quantile(share), 40001)
        assert np.trapezoid(np.exp([free.log_prior(x) for x in grid]), grid) == pytest.approx(share, abs=2e-4)
    assert free.log_prior(free.low - 1e-9) == free.log_prior(free.high + 1e-9) == -math.inf
    assert free.low >= 0.0 or free.log
    assert free.value(free.high) <= 90.0 * (1.0 + 1e-12)
    assert free.low <= free.start <= free.high


@pytest.mark.parametrize("ends", [(-3.0, 3.0), (0.0, 1.0), (-np.inf, np.inf)])
def test_a_prior_with_a_tail_is_student_s_t(ends: tuple[float, float]) -> None:
    """Between its bounds; as `scipy.stats.t` has it. The pull of a fit is the slope of the log density."""
    law, (low, high) = stats.t(4.0, loc=0.2, scale=0.7), ends
    free = FreeParameter("c", "1", 0.5, low, high, mean=0.2, sd=0.7, tail=4.0)
    whole = law.cdf(high) - law.cdf(low)
    for x in (0.0, 0.3, 0.99):
        assert free.log_prior(x) == pytest.approx(law.logpdf(x) - np.log(whole), abs=1e-12)
        slope = (free.log_prior(x + 1e-6) - free.log_prior(x - 1e-6)) / 2e-6 if x else 0.0
        assert not x or -free.prior_information(x) * (x - 0.2) == pytest.approx(slope, rel=1e-6)
    for share in (0.01, 0.5, 0.9):
        assert free.quantile(share) == pytest.approx(law.ppf(law.cdf(low) + share * whole), rel=1e-9)
    both = (free, FreeParameter("d", "1", 0.5, -2.0, 2.0, mean=0.1, sd=1.0))
    points = np.array([[0.3, 0.4], [0.9, -1.0]])
    alone = [sum(f.log_prior(x) for f, x in zip(both, row, strict=True)) for row in points]
    assert ParameterSpace(both).log_prior(points) == pytest.approx(alone, abs=1e-12)


def test_the_coordinate_of_a_log_normal_prior_is_the_logarithm() -> None:
    free = make_free_parameter(
        Slot("c", Param("c", "damping", DAMPING, low=0.0), "1", None), Prior(median=2.0, sd_log=0.5)
    )
    assert free == FreeParameter(
        "c", "1", math.log(2.0), math.log(2.0) - 6.0, math.log(2.0) + 6.0, True, math.log(2.0), 0.5
    )
