"""The noise levels of recordings: what is usual, where a fit starts, and within which bounds it looks."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.problem import USUAL, Problem, Scales
from lostmotion.likelihood.space import NOISE, RANDOM, Free, keys_of

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
    if "force" not in system.model.inputs:
        inertia = problem.known[system.index[system.model.interfaces[0].inertia]]
        size = USUAL * math.sqrt(2.0) * float(np.std(observation.inputs[:, 0])) * inertia * rate**2
    return math.log(max(size, 1e-300) ** 2 * observation.dt)


def own_drive(problem: Problem, index: int) -> float:
    """Return the log intensity of the drive of one recording over that on which what is usual for all rests."""
    observation, first = problem.observations[index], problem.observations[0]
    own, common = _loudness(observation), _common(problem)
    if "force" not in problem.system.model.inputs:
        own, common = observation.travel, first.travel
    return math.log(((own / common) ** 2 or 1.0) * observation.dt / first.dt) if common else 0.0


def _common(problem: Problem) -> float:
    """Return the amplitude of the drive that its noise goes with, for all recordings together."""
    return max([problem.scales.force, *(t.struck for t in problem.observations)])


def _loudness(observation: Observation) -> float:
    """Return the amplitude of the first input that its noise goes with: of hits their peak."""
    steady = float(np.abs(observation.inputs[:, 0]).max())
    return observation.struck or observation.travel or steady


def random_level(observations: Sequence[Observation], scales: Scales, share: float) -> float:
    """Return the log intensity of a random force that is the given share of the drive, white from sample to sample."""
    return math.log((share * scales.force) ** 2 * observations[0].dt)


def noise_frees(observations: Sequence[Observation], scales: Scales) -> tuple[Free, Free]:
    """Return the two noise levels: the intensity of a random force, and the measurement noise, as logarithms.

    The random force has a broad normal prior about the usual noise of a measured excitation.
    """
    usual = scales.usual
    start = max(random_level(observations, scales, LEVELS_TRIED[0]), usual + 2.0)
    random = Free(RANDOM, "1", start, usual + LEAST, start + 6.0, mean=usual, sd=4.0)
    return random, _noise(NOISE, float(np.median([t.noise for t in observations])))


def own_levels(problem: Problem, random: float) -> tuple[Free, ...]:
    """Return random force and measurement noise of each recording, where a fit found one `random` for all.

    The noise of a measured excitation is in proportion to its amplitude, so that what is usual, where to start and
    the bounds are those of the drive of each recording. But for the start they do not depend on the fit.
    """
    observations, scales = problem.observations, problem.scales
    names = [observation.name for observation in observations]
    most = max(random_level(observations, scales, LEVELS_TRIED[0]), scales.usual + 2.0) + 6.0
    frees: list[Free] = []
    for i, (forced, noisy) in enumerate(zip(keys_of(RANDOM, names), keys_of(NOISE, names), strict=True)):
        more = own_drive(problem, i)
        usual, high = scales.usual + more, most + more
        start = min(max(random + more, usual + LEAST), high)
        frees += [
            Free(forced, "1", start, usual + LEAST, high, mean=usual, sd=4.0),
            _noise(noisy, observations[i].noise),
        ]
    return tuple(frees)


def _noise(key: str, size: float) -> Free:
    return Free(key, "1", math.log(size), math.log(size) - 7.0, math.log(size) + 3.0)
