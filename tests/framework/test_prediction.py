"""Inputs outside of a recording: linear prediction, its slow twin, and the drive of a machine that is late."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from lostmotion.likelihood.input_curve import REACH, InputCurve
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM, FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import System
from lostmotion.noises import NOISE
from lostmotion.signals.linear_prediction import ORDER, find_prediction, predict_before
from lostmotion_plugins.models.basic import LinearOscillator
from lostmotion_plugins.terms.drive import ExcitationDelay

DT, SAMPLES = 0.01, 1200


def lengthen(filters, reflection):
    """Return the error filter of the next order."""
    return [a + reflection * b for a, b in zip([*filters, 0.0], [0.0, *filters[::-1]], strict=True)]


def compute_error(filters, x):
    """Return the sum of squared errors of the prediction of each sample, forwards and backwards."""
    order = len(filters) - 1
    ahead = [sum(filters[i] * x[n - i] for i in range(order + 1)) for n in range(order, len(x))]
    behind = [sum(filters[i] * x[n - order + i] for i in range(order + 1)) for n in range(order, len(x))]
    return sum(e * e for e in ahead) + sum(e * e for e in behind)


def predicted_slowly(x, order):
    """Return the coefficients of the prediction, by the reflection with the least error at each order."""
    filters = [1.0]
    for _ in range(order):
        error = partial(lambda known, k: compute_error(lengthen(known, k), x), filters)
        best = minimize_scalar(error, bounds=(-1.0, 1.0), method="bounded", options={"xatol": 1e-10})
        filters = lengthen(filters, float(best.x))
    return -np.array(filters[1:])


def test_the_prediction_is_that_of_its_slow_twin():
    """Each reflection of Burg's method is the one of least forward and backward error."""
    x = np.cos(0.4 * np.arange(60)) + 0.3 * np.random.default_rng(1).standard_normal(60)
    assert find_prediction(x, 4) == pytest.approx(predicted_slowly(x, 4), abs=1e-6)


def test_a_sine_is_continued_and_noise_decays_to_its_mean():
    """The error of a sine stays below five times its noise over 200 samples; held, it is wrong by twice its size."""
    rng, t = np.random.default_rng(0), np.arange(-200, SAMPLES)
    sine = 3.0 + np.cos(2.0 * math.pi * t / 47.3 + 0.4)
    noisy = sine + 1e-3 * rng.standard_normal(len(t))
    assert np.abs(predict_before(noisy[200:], 200) - sine[:200]).max() < 5e-3
    noise = 2.0 + rng.standard_normal(SAMPLES)
    assert np.abs(predict_before(noise, 300)[:50] - noise[:1000].mean()).max() < 0.1


@pytest.mark.parametrize("values", [np.zeros(50), np.full(50, 2.5), np.arange(3.0), np.ones(1)])
def test_what_does_not_move_stays(values):
    """A constant input, or one of very few samples, is continued by its mean."""
    assert predict_before(values, 7) == pytest.approx(np.full(7, values.mean()), abs=1e-12)
    assert len(find_prediction(values - values.mean())) <= ORDER


def test_an_input_is_continued_beyond_both_ends():
    """Inside it is the spline through the samples; outside the true sine within a thousandth; far outside constant."""
    t = np.arange(SAMPLES) * DT
    curve = InputCurve(np.stack([np.sin(3.0 * t), 3.0 * np.cos(3.0 * t)], axis=1), DT, held=False)
    beyond = np.array([-0.5, -0.0123, -1e-9, 0.0, 0.005, t[-1] + 1e-9, t[-1] + 0.31])
    assert curve.evaluate(0, beyond) == pytest.approx(np.sin(3.0 * beyond), abs=1e-3)
    assert curve.evaluate(1, beyond.reshape(7, 1)) == pytest.approx(3.0 * np.cos(3.0 * beyond)[:, None], abs=3e-3)
    reach = min(REACH, SAMPLES // 4) * DT
    assert curve.evaluate(0, np.array([-50.0])) == curve.evaluate(0, np.array([-reach]))


def test_an_input_that_is_held_keeps_its_ends():
    """Commands that jump cannot be predicted."""
    curve = InputCurve(np.array([[1.0], [2.0], [4.0]]), DT, held=True)
    assert curve.evaluate(0, np.array([-1.0, 0.5 * DT, 1.5 * DT, 1.0])) == pytest.approx([1.0, 1.0, 2.0, 4.0])


def test_a_late_drive_is_known_at_the_first_samples():
    """The log-likelihood at the truth is that of white noise, within four standard deviations of its distribution.

    The recording is the exact steady acceleration of a linear oscillator, whose drive is 0.7 samples late, with noise
    of a thousandth. With the drive held before the first sample, it is lower by hundreds.
    """
    rng, t, late, omega = np.random.default_rng(2), np.arange(SAMPLES) * DT, 0.007, 9.0
    motion = 1.0 / complex(25.0 - omega**2, 0.4 * omega) * np.exp(1j * (omega * (t - late) + 0.9))
    noise = 1e-3 * omega**2 * abs(motion[0])
    shown = (-(omega**2) * motion).real + noise * rng.standard_normal(SAMPLES)
    system = System(LinearOscillator(), (ExcitationDelay(),))
    known = system.vector({"m": 1.0, "c": 0.4, "k": 25.0, "excitation_delay.delay": late})
    begun = np.array([motion[0].real, (1j * omega * motion[0]).real]), np.diag([1e-8, 1e-8])
    force = np.cos(omega * t + 0.9)[:, None]
    observation = replace(Observation.of("run", shown, force, DT, "acceleration"), begun=begun)
    frees = (FreeParameter(RANDOM, "1", -40.0, -60.0, 5.0), FreeParameter(NOISE, "1", math.log(noise), -20.0, 3.0))
    posterior = Posterior(
        ParameterSpace(frees),
        (observation,),
        Lanes(system, frozenset({"excitation_delay"})),
        Scales(1.0, 0.02, 0.1),
        known,
    )
    mean = -SAMPLES * (math.log(noise) + 0.5 * math.log(2.0 * math.pi) + 0.5)
    found = float(posterior.log_likelihood(posterior.space.start[None])[0])
    assert abs(found - mean) < 4.0 * math.sqrt(0.5 * SAMPLES)
