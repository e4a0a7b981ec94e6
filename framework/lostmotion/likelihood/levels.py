"""The noise levels of recordings: what is usual, where a fit starts, and within which bounds it looks."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.problem import USUAL, Problem, Scales
from lostmotion.likelihood.space import AR1_LEVEL, AR1_MEMORY, NOISE, RANDOM, FreeParameter, keys_of

SHORTEST, LONGEST = 0.7, 0.5
"""A memory of noise lasts at least so many samples, and at most this share of the natural time of the motion: what is
slower is a motion of the machine, or a zero that drifts."""
LASTING = 3.0
"""However coarsely it is sampled, a memory of so many samples is allowed."""
LEVELS_TRIED = (0.3, 0.05, 0.008)
"""Random forces, as shares of the drive, with which starting points are compared: a large one lets the filter follow
whatever the parameters, a small one tells good parameters from bad ones."""

LEAST = 2.0 * math.log(0.3)
"""The random force is never less than 0.3 of the usual: with less, a filter trusts its linearisation too far, and
intervals from long recordings become too narrow (over 24 recordings, z rms 1.4 with 0.1 and 1.05 with 0.3)."""


def usual_of(problem: Problem, rate: float) -> float:
    """Return the log intensity (N^2 s) of the random force that the usual noise of a measured excitation makes.

    The noise of a base motion enters through the stiffness of the joint, of which `rate` (1/s) is the fastest motion.
    """
    system, observation = problem.system, problem.observations[0]
    size = USUAL * _common(problem)
    if system.model.inputs[observation.lead] == "base_position":
        inertia = problem.known[system.index[system.model.interfaces[0].inertia]]
        size = USUAL * math.sqrt(2.0) * float(np.std(observation.excitation)) * inertia * rate**2
    return math.log(max(size, 1e-300) ** 2 * observation.dt)


def own_drive(problem: Problem, index: int) -> float:
    """Return the log intensity of the drive of one recording over that on which what is usual for all rests."""
    observation, first = problem.observations[index], problem.observations[0]
    own, common = _loudness(observation), _common(problem)
    if problem.system.model.inputs[first.lead] != "force":
        own, common = observation.travel, first.travel
    return math.log(((own / common) ** 2 or 1.0) * observation.dt / first.dt) if common else 0.0


def _common(problem: Problem) -> float:
    """Return the amplitude of the drive that its noise goes with, for all recordings together."""
    return max([problem.scales.force, *(t.struck for t in problem.observations)])


def _loudness(observation: Observation) -> float:
    """Return the amplitude of the first input that its noise goes with: of hits their peak."""
    steady = float(np.abs(observation.excitation).max())
    return observation.struck or observation.travel or steady


def random_level(observations: Sequence[Observation], scales: Scales, share: float) -> float:
    """Return the log intensity of a random force that is the given share of the drive, white from sample to sample."""
    return math.log((share * scales.force) ** 2 * observations[0].dt)


def noise_frees(observations: Sequence[Observation], scales: Scales) -> tuple[FreeParameter, ...]:
    """Return the noise levels: the intensity of a random force, and the noise of each sensor, as logarithms.

    The random force has a broad normal prior about the usual noise of a measured excitation. A sensor that is said to
    have noise with a memory has its size and length beside the white one.
    """
    usual = scales.usual
    start = max(random_level(observations, scales, LEVELS_TRIED[0]), usual + 2.0)
    random = FreeParameter(RANDOM, "1", start, usual + LEAST, start + 6.0, mean=usual, sd=4.0)
    first, frees = observations[0], [random]
    for i, sensor in enumerate(first.sensors):
        size = float(np.median([t.noises[i] for t in observations]))
        frees.append(_noise(first.level(NOISE, i), size))
        if sensor.noise.kind == "ar1":
            frees += memory_frees(first, i, math.log(size), scales)
    return tuple(frees)


def memory_frees(
    observation: Observation, sensor: int, noise: float, scales: Scales
) -> tuple[FreeParameter, FreeParameter]:
    """Return log size and log length (s) of noise with a memory of a sensor; `noise` is log size of the white one."""
    dt = observation.dt
    low, high = math.log(SHORTEST * dt), math.log(max(LONGEST * scales.time, LASTING * dt))
    middle = min(math.log(3.0 * dt), high)
    return (
        FreeParameter(observation.level(AR1_LEVEL, sensor), "1", noise - 0.5, noise - 5.0, noise + 3.0),
        FreeParameter(observation.level(AR1_MEMORY, sensor), "1", middle, low, high, mean=middle, sd=1.0),
    )


def own_levels(problem: Problem, random: float) -> tuple[FreeParameter, ...]:
    """Return random force and measurement noise of each recording, where a fit found one `random` for all.

    The noise of a measured excitation is in proportion to its amplitude, so that what is usual, where to start and
    the bounds are those of the drive of each recording. But for the start they do not depend on the fit.
    """
    observations, scales = problem.observations, problem.scales
    names = [observation.name for observation in observations]
    most = max(random_level(observations, scales, LEVELS_TRIED[0]), scales.usual + 2.0) + 6.0
    frees: list[FreeParameter] = []
    for i, forced in enumerate(keys_of(RANDOM, names)):
        more = own_drive(problem, i)
        usual, high = scales.usual + more, most + more
        start = min(max(random + more, usual + LEAST), high)
        frees.append(FreeParameter(forced, "1", start, usual + LEAST, high, mean=usual, sd=4.0))
        for sensor, size in enumerate(observations[i].noises):
            frees.append(_noise(keys_of(observations[i].level(NOISE, sensor), names)[i], size))
    return tuple(frees)


def _noise(key: str, size: float) -> FreeParameter:
    return FreeParameter(key, "1", math.log(size), math.log(size) - 7.0, math.log(size) + 3.0)
