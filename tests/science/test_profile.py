"""Play so wide that the spring hardly acts: it is far from the nominal model, and its interval is not a normal one."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from truths import fit_oscillator

from lostmotion.evidence.effects import list_bare_promises, propose_start
from lostmotion.inference import profile
from lostmotion.inference.candidates import fit_term
from lostmotion.inference.profile import END, WIDTH, _fall_at, measure_stretches, stretch_draws
from lostmotion.likelihood.observation import Observation

M, C, K, GAP, DT, SAMPLES, FINE = 3.27, 5.06, 1898.0, 0.00079, 0.0086, 1500, 40
AMPLITUDE, OMEGA = 1.2, 18.0


@cache
def nominal(gap=GAP):
    """Return the fit of a linear oscillator to the velocity of one whose spring has play, by leapfrog."""
    rng, h = np.random.default_rng(17), DT / FINE
    x, v, seen = 0.0, 0.0, np.zeros(SAMPLES)
    for k in range(SAMPLES * FINE):
        if k % FINE == 0:
            seen[k // FINE] = v
        push = AMPLITUDE * np.cos(OMEGA * h * (k + 0.5))
        v += h * (push - C * v - K * (x - min(max(x, -gap), gap))) / M
        x += h * v
    drive = AMPLITUDE * np.cos(OMEGA * DT * np.arange(SAMPLES))
    z = seen + 0.01 * seen.std() * rng.standard_normal(SAMPLES)
    observation = Observation.of("seen", z, drive[:, None], DT, "velocity")
    return fit_oscillator(observation, rng, m=M, c=(0.4, 27.0), k=(738.0, 5380.0), terms=("backlash",))


def test_play_is_found_though_the_nominal_spring_is_far_too_soft():
    """A score test at the nominal fit predicts almost nothing: the secants there are those of a wrong stiffness."""
    fit = nominal()
    assert fit.values["k"] < 0.8 * K
    found = fit_term(fit, "backlash", propose_start(fit, "backlash"))
    assert found.log_likelihood > fit.log_likelihood + 100.0
    assert found.values["backlash.gap"] == pytest.approx(GAP, rel=0.02)
    assert found.values["k"] == pytest.approx(K, rel=0.02)


def test_a_spring_without_play_promises_none():
    assert all(promise.gain < 5.0 for promise in list_bare_promises(nominal(0.0), ["backlash"], {}))


def widened(fit, key, factor):
    """Return a fit whose curvature claims an interval of one parameter narrower by a factor than it is."""
    at = fit.posterior.space.keys.index(key)
    scale = np.eye(len(fit.theta))
    scale[at, at] = factor
    information = scale @ fit.local.information @ scale
    return replace(fit, local=replace(fit.local, information=information)), at


def test_a_profile_that_takes_too_much_work_is_left_out(monkeypatch):
    narrow, _ = widened(nominal(0.0), "k", 4.0)
    monkeypatch.setattr(profile, "MOST_WORK", 0.0)
    assert np.all(measure_stretches(narrow) == 1.0)


def test_an_interval_is_as_wide_as_the_profile():
    """The ends found for a curvature that is sixteen times too large are those of the true profile."""
    fit = nominal(0.0)
    true = math.sqrt(fit.local.covariance[fit.posterior.space.keys.index("k")][fit.posterior.space.keys.index("k")])
    narrow, at = widened(fit, "k", 4.0)
    stretches = measure_stretches(narrow)
    for side, sign in ((0, -1.0), (1, 1.0)):
        end = sign * stretches[at, side] * WIDTH * math.sqrt(narrow.local.covariance[at, at])
        assert abs(end) == pytest.approx(WIDTH * true, rel=0.15)
        assert _fall_at(narrow, at, end, narrow.theta)[0] == pytest.approx(END, rel=0.25)
    other = [i for i in range(len(fit.theta)) if i != at]
    assert np.all(stretches[other] < 1.3)


def test_a_normal_posterior_is_not_widened():
    assert np.all(measure_stretches(nominal(0.0)) == 1.0)


def test_draws_are_stretched_to_either_side():
    fit = nominal(0.0)
    at = fit.posterior.space.keys.index("c")
    stretches = np.ones((len(fit.theta), 2))
    stretches[at] = 2.0, 3.0
    draws = np.tile(fit.theta, (2, 1))
    draws[:, at] += [-0.01, 0.01]
    assert stretch_draws(fit, draws, stretches)[:, at] - fit.theta[at] == pytest.approx([-0.02, 0.03])
