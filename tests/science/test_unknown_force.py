"""Forces that no term of the library has, hidden by an integrator of its own: learned as curves, and only if there."""

from __future__ import annotations

import math
import re

import numba
import numpy as np
import pytest
from truths import case_of

from lostmotion.inference import sensitivity
from lostmotion.inference.curves import (
    add_all_curves,
    compute_band,
    difference_curve,
    fit_curve,
    join_curve,
    run_curve_test,
)
from lostmotion.inference.fit import choose_first_steps, maximise, restart
from lostmotion.inference.proposal import Axis, propose_formula
from lostmotion.inference.sensitivity import compute_sensitivity
from lostmotion.inference.setup import make_posterior, search_maximum
from lostmotion.inference.unexplained import CurveSearch
from lostmotion.likelihood.drive import DriveHarmonic
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System
from lostmotion.quantities import FORCE, LENGTH
from lostmotion.registry import default

CLEAN, RIPPLE, ROUGH = range(3)
PERIOD, OMEGA, SAMPLES, SETTLING, FINE = 200, 40.0, 4000, 4000, 50
LIBRARY = 27
"""So many candidates are paid for, as in a diagnosis with all terms."""


@numba.njit(cache=True)
def moved(kind: int, samples: int) -> np.ndarray:
    """Return position and velocity (samples, 2) of Case 1 with a hidden force, by leapfrog in 50 steps to a sample."""
    step = 2.0 * math.pi / OMEGA / PERIOD / FINE
    x, v, seen = 0.006, 0.0, np.zeros((samples, 2))
    for k in range((samples + SETTLING) * FINE):
        if k % FINE == 0 and k >= SETTLING * FINE:
            seen[k // FINE - SETTLING] = x, v
        middle = x + 0.5 * step * v
        push = 100.0 * math.cos(OMEGA * (k + 0.5) * step)
        push -= 4e4 * (middle - min(max(middle, -0.005), 0.005))
        bound = 0.0
        if kind == RIPPLE:
            push += math.sin(2.0 * math.pi * middle / 0.002)
        elif kind == ROUGH:
            bound = step * 3.0 * (middle / 0.008) ** 2
        free = (v * (1.0 - 4.0 * step) + step * push) / (1.0 + 4.0 * step)
        v = free - min(max(free, -bound), bound)
        x = middle + 0.5 * step * v
    return seen


def fitted(kind, *, seed=0):
    """Return the fit of the nominal model to a recording with 1 % noise, and 0.1 % on the force."""
    rng = np.random.default_rng(seed)
    seen = moved(kind, SAMPLES)
    dt = 2.0 * math.pi / OMEGA / PERIOD
    force = 100.0 * np.cos(OMEGA * dt * np.arange(SAMPLES)) + 0.1 * rng.standard_normal(SAMPLES)
    z = seen[:, 0] + 0.01 * np.std(seen[:, 0]) * rng.standard_normal(SAMPLES)
    observation = Observation.of("seen", z, force[:, None], dt, "position", harmonic=DriveHarmonic(OMEGA, 100.0))
    posterior = make_posterior(System(default().make("model", "lin_backlash")), case_of(("c", "x0")), (observation,))
    return search_maximum(posterior, rng, points=24, finalists=2)


@pytest.mark.slow
def test_a_ripple_over_position_is_learned_and_its_period_proposed():
    """1 N with 13 periods over the travel: the curve is that of the truth where the mass spends its time."""
    fit = fitted(RIPPLE)
    found = CurveSearch(LIBRARY).unknown(fit, fit)
    assert found.keys == ("unknown_over_position",)
    assert found.probability > 0.99
    band = compute_band(found.fit, found.keys[0])
    truth = np.sin(2.0 * np.pi * band.at / 0.002)
    inside = np.abs(truth - band.mean) < 1.96 * band.sd
    assert inside.mean() > 0.8
    middle = np.abs(band.at) < 0.004
    assert np.sqrt(np.mean((truth - band.mean)[middle] ** 2)) < 0.4
    formula = propose_formula(band.at, band.mean, band.covariance, Axis("x", LENGTH, FORCE, "translation"))
    period = re.search(r"sin\(2 pi x / (\S+) m", formula.text)
    assert period is not None, formula.text
    assert float(period[1]) == pytest.approx(0.002, rel=0.02)


@pytest.mark.slow
def test_friction_that_depends_on_position_is_told_from_a_force_that_does():
    found = CurveSearch(LIBRARY).unknown(*[fitted(ROUGH)] * 2)
    assert found.keys[0] == "unknown_friction_over_position"
    assert found.fit.values["c"] == pytest.approx(8.0, abs=1.0)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_nothing_is_learned_where_nothing_is_missing(seed):
    fit = fitted(CLEAN, seed=seed)
    assert CurveSearch(LIBRARY).unknown(fit, fit) is None


@pytest.mark.slow
def test_the_gain_of_a_curve_is_that_over_the_better_of_two_nominal_fits():
    """A selection may improve the nominal fit after the search for curves has stored it; the odds count the better."""
    fit = fitted(ROUGH)
    worse = maximise(fit.posterior, fit.theta + 1.0, rounds=1)
    assert worse.log_evidence < fit.log_evidence - 100.0
    ahead, behind = (CurveSearch(LIBRARY).unknown(nominal, fit) for nominal in (fit, worse))
    assert behind.keys == ahead.keys
    assert behind.gain == pytest.approx(ahead.gain, abs=3.0)


@pytest.mark.parametrize("key", ["unknown_over_position", "unknown_over_velocity", "unknown_over_time"])
def test_slopes_of_a_curve_are_those_of_runs_of_the_filter(key):
    """The linearised filter beside its slow twin, differences of one run for each coefficient."""
    wide = add_all_curves(fitted(CLEAN))
    joint = join_curve(wide, wide.slopes, key)
    here, errors, variances = difference_curve(wide.posterior, wide.theta, key)
    found = joint.errors[len(wide.theta) :]
    assert np.allclose(joint.here.errors, here.errors, rtol=1e-9)
    assert np.sqrt(np.mean((found - errors) ** 2) / np.mean(errors**2)) < 0.03
    of_errors, of_variances = errors**2 / here.variances, 0.5 * (variances / here.variances) ** 2
    assert np.sum(of_variances) < 0.01 * np.sum(of_errors)


def test_slopes_over_an_active_curve_are_those_of_runs_of_the_filter(monkeypatch):
    """With many parameters, those over its coefficients come from the linearised filter; differences are the twin."""
    ripple = add_all_curves(fitted(RIPPLE))
    test = run_curve_test(ripple, ripple.slopes, "unknown_over_position")
    posterior = restart(fit_curve(ripple, test))
    theta, steps = posterior.space.start, choose_first_steps(posterior)
    fast = compute_sensitivity(posterior, theta, steps)
    monkeypatch.setattr(sensitivity, "linearise_recordings", lambda *_: [])
    slow = compute_sensitivity(posterior, theta, steps)
    curve = np.array([f.linear for f in posterior.space.free])
    assert curve.sum() > 10
    assert np.array_equal(fast.errors[~curve], slow.errors[~curve])
    told = slow.errors[curve]
    assert np.sqrt(np.mean((fast.errors[curve] - told) ** 2) / np.mean(told**2)) < 0.03
    assert np.allclose(fast.gradient(), slow.gradient(), rtol=0.0, atol=0.1 * np.sqrt(np.diag(slow.information())))
