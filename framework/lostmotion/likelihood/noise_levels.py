"""The noise levels of recordings: usual values, starting values, and bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.sensor_noise import make_levels, make_sensor_scales
from lostmotion.likelihood.space import RANDOM, FreeParameter, Scales, list_keys
from lostmotion.noises import White

USUAL = 1e-3
"""The usual noise of a measured excitation as a share of the drive, which is no missing mechanism."""
LEVELS_TRIED = (0.3, 0.05, 0.008)
"""Random forces, as shares of the drive, at which starting points are compared: with a large one the filter follows the
readings at any parameters, a small one separates good parameters from bad ones."""

LEAST = 2.0 * math.log(0.3)
"""The lower bound of the random force, relative to the usual: 0.3. With less, the filter is overconfident in its
linearisation, and intervals from long recordings become too narrow (over 24 recordings, z rms 1.4 with 0.1 and 1.05
with 0.3)."""


def compute_usual_level(posterior: Posterior, rate: float) -> float:
    """Return the log intensity (N^2 s) of the random force that the usual noise of a measured excitation makes.

    The noise of a base motion enters through the stiffness of the joint, with `rate` (1/s) the fastest rate of the
    motion.
    """
    system, observation = posterior.system, posterior.observations[0]
    size = USUAL * _find_common_drive(posterior)
    if system.model.inputs[observation.lead] == "base_position":
        inertia = system.own_inertia(posterior.known, system.model.first_place)
        size = USUAL * math.sqrt(2.0) * float(np.std(observation.excitation)) * inertia * rate**2
    return math.log(max(size, 1e-300) ** 2 * observation.dt)


def compare_drive(posterior: Posterior, index: int) -> float:
    """Return the log intensity of the drive of one recording over the common one, to which the usual level refers."""
    observation, first = posterior.observations[index], posterior.observations[0]
    own, common = _find_drive(observation), _find_common_drive(posterior)
    if posterior.system.model.inputs[first.lead] != "force":
        own, common = observation.travel, first.travel
    return math.log(((own / common) ** 2 or 1.0) * observation.dt / first.dt) if common else 0.0


def _find_common_drive(posterior: Posterior) -> float:
    """Return the amplitude of the drive to which the noise is proportional, for all recordings together."""
    return max([posterior.scales.force, *(t.hit_peak for t in posterior.observations)])


def _find_drive(observation: Observation) -> float:
    """Return the amplitude of the first input to which its noise is proportional: for hits their peak."""
    steady = float(np.abs(observation.excitation).max())
    return observation.hit_peak or observation.travel or steady


def compute_random_level(observations: Sequence[Observation], scales: Scales, share: float) -> float:
    """Return the log intensity of a random force that is the given share of the drive, white from sample to sample."""
    return math.log((share * scales.force) ** 2 * observations[0].dt)


def make_noise_levels(observations: Sequence[Observation], scales: Scales) -> tuple[FreeParameter, ...]:
    """Return the noise levels: the intensity of the random force, and the noise of each sensor, as logarithms.

    The random force has a broad normal prior about the usual noise of a measured excitation. Each noise of a sensor has
    parameters of its own.
    """
    usual = scales.usual
    start = max(compute_random_level(observations, scales, LEVELS_TRIED[0]), usual + 2.0)
    random = FreeParameter(RANDOM, "1", start, usual + LEAST, start + 6.0, mean=usual, sd=4.0)
    first, frees = observations[0], [random]
    for i, sensor in enumerate(first.sensors):
        size = math.log(float(np.median([t.noises[i] for t in observations])))
        own = make_sensor_scales(first, i, size, scales)
        frees += [free for noise in sensor.noises for free in make_levels(first, i, noise, own)]
    return tuple(frees)


def make_own_levels(posterior: Posterior, random: float) -> tuple[FreeParameter, ...]:
    """Return random force and measurement noise of each recording, from a fit with one `random` for all.

    The noise of a measured excitation is proportional to its amplitude, so the usual value, the start and the bounds
    follow the drive of each recording. Only the start depends on the fit.
    """
    observations, scales = posterior.observations, posterior.scales
    names = [observation.name for observation in observations]
    most = max(compute_random_level(observations, scales, LEVELS_TRIED[0]), scales.usual + 2.0) + 6.0
    frees: list[FreeParameter] = []
    for i, forced in enumerate(list_keys(RANDOM, names)):
        more = compare_drive(posterior, i)
        usual, high = scales.usual + more, most + more
        start = min(max(random + more, usual + LEAST), high)
        frees.append(FreeParameter(forced, "1", start, usual + LEAST, high, mean=usual, sd=4.0))
        for sensor, size in enumerate(observations[i].noises):
            own = make_sensor_scales(observations[i], sensor, math.log(size), scales)
            levels = make_levels(observations[i], sensor, White(), own)
            frees += [replace(free, key=list_keys(free.key, names)[i]) for free in levels]
    return tuple(frees)
