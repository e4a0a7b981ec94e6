"""Several maxima of one posterior: all are found, and one rough hill is not taken for two."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from made_fits import make_fit
from scipy.linalg import expm

from lostmotion.case import CaseFile, Prior, SensorSpec
from lostmotion.inference.modes import StartingPoints, is_same_mode, select_modes
from lostmotion.inference.setup import find_modes, make_posterior, polish_modes, search_maximum
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.space import FreeParameter, ParameterSpace
from lostmotion.likelihood.system import System
from lostmotion.registry import default
from lostmotion.settings import DEFAULT, Settings

DT, TRUE, FOLDED = 0.05, 7.0, 13.0
"""A ring of 7 Hz that is sampled at 20 Hz looks like one of 13 Hz: all but the faint push that is recorded with it."""


def ring(*, push: float, seed: int, samples: int) -> Observation:
    """Return a decaying oscillation, solved by the matrix exponential, with 10 % noise and a faint held push."""
    rng = np.random.default_rng(seed)
    omega = 2.0 * math.pi * TRUE
    a = np.array([[0.0, 1.0, 0.0], [-(omega**2), -0.02 * omega, 1.0], [0.0, 0.0, 0.0]])
    step, u, y = expm(a * DT), push * rng.standard_normal(samples), np.array([0.01, 0.0])
    seen = np.zeros(samples)
    for i in range(samples):
        seen[i] = y[0]
        y = (step @ np.append(y, u[i]))[:2]
    seen += 0.1 * seen.std() * rng.standard_normal(samples)
    return Observation.of("ring", seen, u[:, None], DT, "position", held=True)


def posterior_for(*observations: Observation):
    priors = {"c": Prior(0.1, 10.0, "log"), "k": Prior(500.0, 1e4, "log")}
    case = CaseFile("ring", Path(), (), "linear_oscillator", {"m": 1.0}, priors, {}, (), "")
    return make_posterior(System(default().make("model", "linear_oscillator"), ()), case, observations)


def hertz(fit) -> float:
    return math.sqrt(fit.values["k"]) / (2.0 * math.pi)


@pytest.mark.parametrize("seed", [0, 1])
def test_both_modes_of_a_folded_ring_are_found(seed: int) -> None:
    """A single search settles for the wrong one; their evidences differ by less than 1, as the push is faint."""
    posterior = posterior_for(ring(push=0.02, seed=seed, samples=60))
    assert hertz(search_maximum(posterior, np.random.default_rng(0))) == pytest.approx(FOLDED, rel=0.01)
    both = find_modes(posterior, np.random.default_rng(0))
    assert sorted(hertz(f) for f in both) == pytest.approx([TRUE, FOLDED], rel=0.01)
    assert both[0].log_evidence >= both[1].log_evidence > both[0].log_evidence - 1.0
    assert both[0].posterior is both[1].posterior
    finer = polish_modes(both)
    assert sorted(hertz(f) for f in finer) == pytest.approx([TRUE, FOLDED], rel=0.01)
    assert finer[0].posterior is finer[1].posterior


def test_a_push_that_is_felt_leaves_one_mode() -> None:
    only = find_modes(posterior_for(ring(push=1.0, seed=0, samples=200)), np.random.default_rng(0))
    assert [hertz(f) for f in only] == pytest.approx([TRUE], rel=0.01)


@dataclass(frozen=True)
class Hills:
    """A log posterior over one coordinate: normal hills of unit width, with ripples on them."""

    centres: tuple[float, ...]
    ripple: float = 0.0
    settings: Settings = DEFAULT
    space = ParameterSpace((FreeParameter("x", "1", 0.0, -100.0, 100.0),))
    dynamics = SimpleNamespace(nsub=1)

    def log_likelihood(self, points):
        x = np.asarray(points)[:, 0]
        smooth = np.logaddexp.reduce([-0.5 * (x - c) ** 2 for c in self.centres], axis=0)
        return smooth + self.ripple * np.cos(2.0 * math.pi * x)

    def log_density(self, points):
        return self.log_likelihood(points)

    def fit(self, at: float, sd: float = 1.0, lower: float = 0.0):
        """Return a fit that stopped at a place, or claims a log posterior that is lower."""
        height = float(self.log_likelihood(np.array([[at]]))[0])
        return make_fit(self, [at], height - lower, sd=sd)


@pytest.mark.parametrize(
    ("hills", "ends", "one"),
    [
        (Hills((0.0, 8.0)), (0.0, 8.0), False),
        (Hills((0.0, 5.6)), (0.0, 5.6), False),
        (Hills((0.0, 2.5)), (0.0, 2.5), True),
        (Hills((0.0, 4.0)), (0.0, 4.0), True),
        (Hills((0.0, 1.5, 3.0, 4.5, 6.0), ripple=1.0), (0.0, 6.0), True),
        (Hills((0.0,), ripple=1.0), (0.0, -1.0), True),
    ],
)
def test_a_dip_makes_two_hills_and_roughness_does_not(hills: Hills, ends: tuple[float, float], one: bool) -> None:
    a, b = (hills.fit(x, sd=0.5) for x in ends)
    assert is_same_mode(a, b) == is_same_mode(b, a) == one
    assert len(select_modes([a, b], 20.0)) == 2 - one


def test_low_hills_and_fits_that_came_to_nothing_are_left_out() -> None:
    hills = Hills((0.0, 8.0))
    low, lost = hills.fit(8.0, lower=25.0), hills.fit(4.0, lower=math.inf)
    best = hills.fit(0.0)
    assert select_modes([low, lost, best], 20.0) == [best]
    assert select_modes([low, lost, best], 30.0) == [best, low]


def test_a_low_narrow_hill_is_started_from_too() -> None:
    """Eight starts on a wide hill are better than all those on another one, which is tried all the same."""
    x = np.linspace(0.0, 1.0, 41)
    scores = np.maximum(-((x - 0.3) ** 2), -100.0 * (x - 0.9) ** 2 - 0.2)
    scores[5] = -np.inf
    tried = StartingPoints(x[:, None], x[:, None], scores)
    assert all(abs(x[i] - 0.3) < 0.2 for i in tried.best(8))
    assert {round(x[i], 3) for i in tried.peaks(2)} == {0.3, 0.9}
    assert len(tried.peaks(50)) == 40


@pytest.mark.slow
def test_a_rough_hill_is_one_mode() -> None:
    """The kink of a backlash makes the posterior rough; two seeds find the same single maximum. No chance."""
    priors = {"c": Prior(0.8, 80.0, "log"), "x0": Prior(5e-4, 5e-2, "log")}
    case = CaseFile("clatter", Path(), (), "lin_backlash", {"m": 1.0, "k0": 4e4, "k1": 0.0}, priors, {}, (), "")
    posterior = make_posterior(System(default().make("model", "lin_backlash"), ()), case, (clatter(),))
    found = [find_modes(posterior, np.random.default_rng(seed)) for seed in range(2)]
    assert [len(f) for f in found] == [1, 1]
    assert all(f[0].values["c"] == pytest.approx(8.0, rel=0.05) for f in found)


def clatter() -> Observation:
    """Return a chaotic recording of a mass in a gap, integrated by velocity Verlet in twenty steps a sample."""
    rng = np.random.default_rng(0)
    dt, fine, samples = math.pi / 4000.0, 20, 2400
    h, x, v, seen = dt / fine, 0.0, 0.0, np.zeros(samples)
    u = 100.0 * np.cos(40.0 * np.arange(samples * fine + 1) * h)
    for i in range(samples):
        seen[i] = x
        for j in range(i * fine, (i + 1) * fine):
            x, v = x + 0.5 * h * v, v
            pull = 4e4 * (max(x - 5e-3, 0.0) + min(x + 5e-3, 0.0))
            v += h * (0.5 * (u[j] + u[j + 1]) - 8.0 * v - pull)
            x += 0.5 * h * v
    seen += 0.01 * seen.std() * rng.standard_normal(samples)
    return Observation.of("clatter", seen, u[:-1:fine][:, None], dt, "position")


def test_the_walk_to_a_mode_stays_within_its_bounds() -> None:
    posterior = posterior_for(ring(push=0.02, seed=0, samples=60))
    narrow = posterior.over(replace(f, high=7.7) if f.key == "k" else f for f in posterior.space.free)
    only = find_modes(narrow, np.random.default_rng(0))
    assert [hertz(f) for f in only] == pytest.approx([TRUE], rel=0.01)
    assert isinstance(only[0].posterior.space.free[0], FreeParameter)


def test_hills_are_compared_with_the_noise_of_each_recording() -> None:
    """Both modes of a faint and of a loud ring, with levels of their own in one posterior for both of them."""
    observations = tuple(replace(ring(push=0.02, seed=s, samples=60), name=n) for s, n in ((0, "faint"), (1, "loud")))
    loud = replace(observations[1], readings=30.0 * observations[1].readings, inputs=30.0 * observations[1].inputs)
    both = find_modes(
        posterior_for(observations[0], loud),
        np.random.default_rng(0),
        sensor=SensorSpec(offset=Prior(mean=0.0, sd=0.01)),
    )
    assert sorted(hertz(f) for f in both) == pytest.approx([TRUE, FOLDED], rel=0.01)
    assert both[0].posterior is both[1].posterior
    assert {"offset[loud]", "log_noise[faint]", "log_random_force[loud]"} < set(both[0].posterior.space.keys)
