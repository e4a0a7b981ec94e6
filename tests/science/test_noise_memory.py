"""Measurement noise with a memory: the filter against the exact one of a larger linear system; who gets the blame."""

import math

import numpy as np
import pytest

from lostmotion.inference.fit import maximise
from lostmotion.inference.memory import fit_noise_memory, is_memory_supported
from lostmotion.inference.setup import make_noise_levels
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM, FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import System
from lostmotion.noises import AR1_LEVEL, AR1_MEMORY, NOISE
from lostmotion_plugins.models.basic import LinearOscillator

M, C, K, DT, OMEGA = 1.0, 0.4, 25.0, 0.02, 3.0
SPREAD = 0.02
"""The measurement noise in m: about a hundredth of the motion."""


def recorded(samples, memory, seed):
    """Return a recording, moved by the exact solution; half of the noise variance lasts for `memory` s (0: none)."""
    rng = np.random.default_rng(seed)
    t = np.arange(samples) * DT
    force = 20.0 * np.cos(OMEGA * t)
    response = 20.0 / complex(K - M * OMEGA**2, C * OMEGA)
    z = (response * np.exp(1j * OMEGA * t)).real
    ar1_share, ar1 = (math.exp(-DT / memory) if memory else 0.0), np.zeros(samples)
    ar1[0] = rng.standard_normal()
    for k in range(1, samples):
        ar1[k] = ar1_share * ar1[k - 1] + math.sqrt(1.0 - ar1_share * ar1_share) * rng.standard_normal()
    noise = SPREAD * (math.sqrt(0.5) * rng.standard_normal(samples) + math.sqrt(0.5) * ar1)
    recorded_force = force + 0.02 * rng.standard_normal(samples)
    return Observation.of("run", z + noise, recorded_force[:, None], DT, "position")


def posterior_of(observation):
    system = System(LinearOscillator())
    scales = Scales(20.0, 1.2, 1.0 / OMEGA, usual=math.log((1e-3 * 20.0) ** 2 * DT), span=observation.samples * DT)
    known = system.vector({"m": M, "c": C, "k": K})
    free = FreeParameter("c", "N s/m", math.log(C), math.log(0.05), math.log(4.0), log=True)
    space = ParameterSpace((free, *make_noise_levels((observation,), scales)))
    return Posterior(space, (observation,), Lanes(system, nsub=2), scales, known)


FINE = 40


def slow_twin(posterior, theta):
    """Return the innovations of a Kalman filter whose state holds the slow noise as well, in fine steps."""
    observation, p = posterior.observations[0], dict(zip(posterior.space.keys, theta, strict=True))
    ar1, ar1_share = math.exp(2.0 * p[AR1_LEVEL]), math.exp(-DT / math.exp(p[AR1_MEMORY]))
    mean, cov = np.zeros(3), np.zeros((3, 3))
    begun = posterior.recordings[0].points(theta[None])
    mean[:2], cov[:2, :2] = begun.mean[0], begun.covariance[0]
    cov[2, 2] = ar1
    h, push = np.array([1.0, 0.0, 1.0]), pushes(observation.drive.cubics[:, :, 0], posterior.dynamics.nsub)
    errors, variances = np.zeros(observation.samples), np.zeros(observation.samples)
    for k in range(observation.samples):
        errors[k], variances[k] = observation.response[k] - h @ mean, h @ cov @ h + math.exp(2.0 * p[NOISE])
        gain = cov @ h / variances[k]
        mean, cov = mean + gain * errors[k], cov - np.outer(gain, gain) * variances[k]
        mean, cov = across(mean, cov, push[k], p)
        keep = np.diag([1.0, 1.0, ar1_share])
        mean, cov = keep @ mean, keep @ cov @ keep
        cov[2, 2] += (1.0 - ar1_share**2) * ar1
    return errors, variances


def pushes(cubics, nsub):
    """Return the force (samples, nsub * FINE) in the middle of each fine step, by the cubic of each sample."""
    share = (np.arange(nsub * FINE) + 0.5) / (nsub * FINE)
    return cubics @ share ** np.arange(4)[:, None]


def across(mean, cov, push, p):
    """Return mean and covariance a sample later; the slow noise rests."""
    half = DT / len(push)
    a = np.array([[0.0, 1.0], [-K / M, -math.exp(p["c"]) / M]])
    one = np.eye(3)
    one[:2, :2] += half * a + half**2 / 2.0 * a @ a + half**3 / 6.0 * a @ a @ a
    for force in push:
        kick = half * np.array([0.0, force / M])
        mean = one @ mean
        mean[:2] += kick + 0.5 * half * (a @ kick)
        cov = one @ cov @ one.T
        cov[1, 1] += half * math.exp(p[RANDOM]) / M**2
    return mean, cov


def test_filter_is_that_of_the_larger_state():
    """A slow noise as a third state of an exact filter gives the same innovations; no chance."""
    observation = recorded(300, 0.1, seed=0)
    plain = posterior_of(observation)
    frees = (
        FreeParameter(AR1_LEVEL, "1", math.log(0.014), -9.0, 0.0),
        FreeParameter(AR1_MEMORY, "1", math.log(0.1), -9.0, 0.0),
    )
    posterior = plain.over((*plain.space.free, *frees))
    theta = np.array([math.log(C), plain.scales.usual, math.log(0.014), math.log(0.014), math.log(0.1)])
    ours, (errors, variances) = posterior.innovations(theta), slow_twin(posterior, theta)
    np.testing.assert_allclose(ours.variances, variances, rtol=2e-3)
    np.testing.assert_allclose(ours.errors, errors, atol=2e-3 * SPREAD)


@pytest.mark.parametrize("seed", range(3))
def test_noise_with_a_memory_is_told_from_white_noise(seed):
    """Half of the variance lasting five samples is found in each of three seeded recordings, and never in white noise.

    Over forty more recordings with white noise none was called slow; with slow noise the gain was 127 or more in ten.
    """
    for memory, wanted in ((0.1, True), (0.0, False)):
        fit = maximise(posterior_of(recorded(3000, memory, seed)))
        coloured = fit_noise_memory(fit)
        assert is_memory_supported(fit, coloured) == wanted
        if wanted:
            assert math.exp(coloured.values[AR1_MEMORY]) == pytest.approx(memory, rel=0.5)
