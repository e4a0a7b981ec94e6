"""Faults of what was recorded: drives that are late, wrong in gain or hide a harmonic, sensors that round.

The recordings are the exact steady response of a linear oscillator, written down here and not simulated.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from explained import explain
from reference import Reference

from lostmotion.inference.fit import maximise
from lostmotion.inference.setup import make_noise_levels
from lostmotion.likelihood.bends import correct_readings, correct_twice, list_corrections
from lostmotion.likelihood.drive import DriveHarmonic
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import System
from lostmotion_plugins.models.basic import LinearOscillator
from lostmotion_plugins.terms.drive import ExcitationDelay, ExcitationGain, ExcitationHarmonic
from lostmotion_plugins.terms.elastic import CubicStiffness, OffsetForce
from lostmotion_plugins.terms.friction import CoulombFriction
from lostmotion_plugins.terms.sensor import PositionRipple, SensorQuantisation

M, C, K, DT, OMEGA, AMPLITUDE = 1.0, 0.4, 25.0, 0.02, 3.0, 20.0
SAMPLES, SURE = 3000, 0.95
TONES = ((AMPLITUDE, OMEGA), (6.0, 7.1))
"""Two tones: with one, a delay could not be told from damping."""


def steady(force, omega):
    """Return the response (samples,) to the real part of force * exp(i omega t)."""
    t = np.arange(SAMPLES) * DT
    return (force / complex(K - M * omega**2, C * omega) * np.exp(1j * omega * t)).real


def moved(delay=0.0, gain=1.0):
    """Return the response to the two tones when they act late and larger than they were recorded."""
    return sum(steady(gain * a * np.exp(-1j * w * delay), w) for a, w in TONES)


def explained(response, seed):
    """Return the explanations by faults and forces of a recording with 1 % noise, damping to be estimated."""
    rng = np.random.default_rng(seed)
    t = np.arange(SAMPLES) * DT
    force = sum(a * np.cos(w * t) for a, w in TONES) + 1e-3 * AMPLITUDE * rng.standard_normal(SAMPLES)
    observation = Observation.of(
        "run", response + 0.01 * response.std() * rng.standard_normal(SAMPLES), force[:, None], DT, "position"
    )
    observation = replace(observation, harmonic=DriveHarmonic(2.0 * math.pi / (observation.period * DT), AMPLITUDE))
    faults = (ExcitationDelay(), ExcitationGain(), ExcitationHarmonic())
    system = System(LinearOscillator(), (*faults, CoulombFriction(), CubicStiffness(), OffsetForce()))
    scales = Scales(AMPLITUDE, 1.2, 1.0 / OMEGA, usual=math.log((1e-3 * AMPLITUDE) ** 2 * DT), span=SAMPLES * DT)
    free = FreeParameter("c", "N s/m", math.log(C), math.log(0.05), math.log(4.0), log=True)
    known = system.vector({"m": M, "c": C, "k": K})
    space = ParameterSpace((free, *make_noise_levels((observation,), scales)))
    posterior = Posterior(space, (observation,), Lanes(system, nsub=2), scales, known)
    fits = [
        maximise(posterior, np.array([math.log(C), level, posterior.space.start[-1]])) for level in (scales.usual, 0.0)
    ]
    nominal = max(fits, key=lambda f: f.local.log_posterior)
    return explain(nominal, system.keys)


FAULTS = {
    "delay": ("excitation_delay", "delay", 0.015, moved(delay=0.015)),
    "gain": ("excitation_gain", "error", 0.1, moved(gain=1.1)),
}


@pytest.mark.parametrize("fault", ["delay", pytest.param("gain", marks=pytest.mark.slow)])
def test_a_fault_of_the_drive_is_named_and_measured(fault):
    """Each is named alone; the size lies within four standard deviations of the truth. Seeded.

    The delay is 0.75 samples. Acquisition systems are late by some tenths of a sample, so half a sample has 0.947.
    """
    key, parameter, truth, response = FAULTS[fault]
    found = explained(response, seed=3)
    assert found.terms == {key}
    assert found.inclusion(key) > SURE
    assert abs(found.chosen.values[f"{key}.{parameter}"] - truth) < 4.0 * found.chosen.sd[f"{key}.{parameter}"]


@pytest.mark.slow
def test_a_gain_of_one_per_cent_gets_no_name():
    """Mass and stiffness are known within 1 %, and both of them wrong by as much do the same."""
    found = explained(moved(gain=1.01), seed=3)
    assert found.terms == frozenset()


@pytest.mark.slow
def test_under_one_tone_a_long_delay_and_a_small_harmonic_get_no_name():
    """A force over the phase of the drive imitates both."""
    hidden = 0.3 * np.exp(0.7j)
    for response, seed in ((moved(delay=0.9), 3), (moved() + steady(hidden, 3.0 * OMEGA), 4)):
        found = explained(response, seed=seed)
        assert [key for key in found.terms if found.inclusion(key) > SURE] == []


def test_nothing_is_named_where_nothing_is_wrong():
    """Five seeded recordings; the odds that are asked for are twenty to one, so a false name is rare."""
    assert [s for s in range(5) if explained(moved(), seed=s).terms] == []


@pytest.mark.parametrize("step", [1e-3, 0.02])
def test_the_step_of_a_sensor_is_read_off_its_values(step):
    """From a tenth of the noise to twice the noise; what was never rounded betrays no step. No chance but the noise."""
    z = moved() + 0.01 * np.random.default_rng(0).standard_normal(SAMPLES)
    (found,), (error,) = SensorQuantisation.quantisation(SensorQuantisation.rounded(z, (step,)))
    assert found == pytest.approx(step, rel=1e-9)
    assert error < 1e-6 * step
    assert SensorQuantisation.quantisation(z) == ((), ())
    assert SensorQuantisation.quantisation(np.array([0.1, 0.1, np.nan, 0.1])) == ((), ())


RIPPLE, PITCH = 0.02, 0.3


def rippled(seed):
    """Return a posterior with a wave of a sensor as large as its noise, which is added after the wave."""
    rng, (cosine, sine, pitch), t = np.random.default_rng(seed), (0.0, RIPPLE, PITCH), np.arange(SAMPLES) * DT
    readings = PositionRipple.bent(moved(), (cosine, sine, pitch)) + RIPPLE * rng.standard_normal(SAMPLES)
    force = sum(a * np.cos(w * t) for a, w in TONES)
    seen = Observation.of("run", readings, force[:, None], DT, "position")
    scales = Scales(AMPLITUDE, 1.2, 1.0 / OMEGA, usual=math.log((1e-3 * AMPLITUDE) ** 2 * DT), span=SAMPLES * DT)
    system = System(LinearOscillator(), (PositionRipple(),))
    known = system.vector({"m": M, "c": C, "k": K, "position_ripple.pitch": PITCH})
    free = FreeParameter("position_ripple.sine", "m", 0.5 * RIPPLE, -1.0, 1.0, mean=0.0, sd=0.1)
    levels = make_noise_levels((seen,), scales)
    running = Lanes(system, frozenset({"position_ripple"}), nsub=2)
    return Posterior(ParameterSpace((free, *levels)), (seen,), running, scales, known)


def test_a_wave_of_a_sensor_is_measured_beside_noise_of_its_own_size():
    """Five seeded recordings: the mean error of the size is below two standard deviations of that mean.

    With the error computed at the noisy reading instead, the mean error is more than twenty of them.
    """
    fits = [maximise(posterior, posterior.space.start) for posterior in map(rippled, range(5))]
    errors = [(f.values["position_ripple.sine"] - RIPPLE) / f.sd["position_ripple.sine"] for f in fits]
    assert abs(np.mean(errors)) < 2.0 / math.sqrt(len(errors))


def test_the_correction_at_predictions_is_that_of_the_true_error():
    """Where the filter knows the position better than the sensor, readings lose the wave but not their noise."""
    posterior = rippled(0)
    view, theta = posterior.observations[0], maximise(posterior, posterior.space.start).theta
    full = posterior.recordings[0].full(theta)
    corrections = list_corrections(posterior.system, posterior.active, full, view.sensors)
    points = posterior.recordings[0].points(theta[None])
    true = view.readings[:, 0] - (PositionRipple.bent(moved(), (0.0, RIPPLE, PITCH)) - moved())
    twice = correct_twice(posterior.dynamics.filter, view, [corrections], points)[0][0, :, 0]
    once = correct_readings(view, corrections)[0][:, 0]
    settled = slice(100, None)
    assert np.std((twice - true)[settled]) < 0.3 * np.std((once - true)[settled])


def test_points_with_corrections_of_their_own_are_filtered_together():
    """Seven sizes of the wave in one call give what each gives alone, and what the plain filter gives."""
    posterior = rippled(1)
    part = posterior.observations[0].part(0, 120)
    posterior = posterior.on((part,))
    thetas = np.tile(maximise(posterior, posterior.space.start).theta, (7, 1))
    thetas[:, 0] = np.linspace(-RIPPLE, 2.0 * RIPPLE, 7)
    together = posterior.innovations(thetas)
    plain = Reference(posterior.system, posterior.active, posterior.dynamics.nsub)
    for dynamics, near in ((posterior.dynamics, 1e-12), (plain, 1e-7)):
        alone = [replace(posterior, dynamics=dynamics).innovations(theta) for theta in thetas]
        np.testing.assert_allclose(together.errors, [one.errors for one in alone], rtol=near, atol=near * RIPPLE)
        np.testing.assert_allclose(together.variances, [one.variances for one in alone], rtol=near)
