"""Sampling tasks made of fits, and the conversion of their coordinates to values in SI units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.identification.moves import TargetDensity
from lostmotion.identification.t_mixture import TMixture
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import PACE, RANDOM, FreeParameter
from lostmotion.noises import NOISE
from lostmotion.quantities import unit_of

OFFSET = "offset"
NOISES = {RANDOM: "random_force", PACE: "random_pace", NOISE: "measurement_noise"}
"""The names of the noise levels as values; the coordinates are their logarithms."""
LEAST_WEIGHT = 0.05
"""Smallest weight of a mode in the first proposal: Laplace's method is inaccurate where a mode is not normal."""


@dataclass(frozen=True)
class ShownCoordinate:
    """How a coordinate is shown: `exp(power * coordinate) * factor` in `unit`, or unchanged where `power` is 0."""

    name: str
    unit: str
    power: float
    factor: float = 1.0

    def value(self, coordinate: Array) -> Array:
        """Return the values in SI units of coordinates of any shape."""
        return np.asarray(self.factor * np.exp(self.power * coordinate) if self.power else coordinate)

    def coordinate(self, value: Array) -> Array:
        """Return the coordinates of values in SI units of any shape."""
        return np.asarray(np.log(value / self.factor) / self.power if self.power else value)


@dataclass(frozen=True)
class Task:
    """A sampling task: a posterior, a first proposal mixture, how its coordinates are shown, and its maximum.

    `digest` is a text that changes with the case and its recordings: a stored chain is continued only if it is equal.
    """

    posterior: TargetDensity
    mixture: TMixture
    shown: tuple[ShownCoordinate, ...]
    maximum: Array
    digest: str = ""

    def values(self, coordinates: Array) -> Array:
        """Return the values in SI units of coordinates (..., parameters)."""
        return np.stack([one.value(coordinates[..., i]) for i, one in enumerate(self.shown)], axis=-1)

    def coordinates(self, values: Array) -> Array:
        """Return the coordinates of values in SI units (..., parameters)."""
        return np.stack([one.coordinate(values[..., i]) for i, one in enumerate(self.shown)], axis=-1)


def make_task(fits: Sequence[Fit], digest: str = "") -> Task:
    """Return the task of sampling the posterior of the first fit; the distinct maxima `fits` give the first proposal.

    The modes are weighted by their evidence, and each has a smallest weight.
    """
    found = [f for f in fits if np.isfinite(f.local.log_posterior)]
    if not found:
        raise DataError("the model cannot follow this recording from any start: check units, known values and priors")
    posterior = fits[0].posterior
    highest = max(found, key=lambda f: f.local.log_posterior)
    mixture = TMixture.of_modes(
        np.array([f.theta for f in found]),
        [limit_covariance(f.local.covariance, posterior.space.free) for f in found],
        compute_mode_weights(np.array([f.log_evidence for f in found])),
        posterior.space.free,
    )
    return Task(
        posterior,
        mixture,
        tuple(_make_shown_coordinate(f, posterior) for f in posterior.space.free),
        highest.theta,
        digest,
    )


def limit_covariance(covariance: Array, free: tuple[FreeParameter, ...]) -> Array:
    """Return the covariance with standard deviations no wider than those of uniform densities between the bounds.

    The data may contain no information about a parameter, for example about a measurement noise far below the random
    force. Its variance would be almost infinite, and no draw would lie between the bounds.
    """
    widest = np.array([f.high - f.low for f in free]) / math.sqrt(12.0)
    shrink = np.minimum(1.0, widest / np.sqrt(np.maximum(np.diag(covariance), 1e-300)))
    return np.asarray(covariance * np.outer(shrink, shrink))


def compute_mode_weights(log_evidence: Array) -> Array:
    """Return the weights (modes,) of modes with a log evidence, each at least `LEAST_WEIGHT` before normalisation.

    A mode with NaN as evidence (singular information) gets the smallest weight.
    """
    known = np.where(np.isfinite(log_evidence), log_evidence, -np.inf)
    if not np.isfinite(known).any():
        return np.full(len(known), 1.0 / len(known))
    weights = np.exp(known - np.max(known))
    weights = np.maximum(weights / weights.sum(), LEAST_WEIGHT)
    return np.asarray(weights / weights.sum())


def _make_shown_coordinate(free: FreeParameter, posterior: Posterior) -> ShownCoordinate:
    """Return how a parameter is shown; a random force as the rms (N, N m) of a force held from sample to sample."""
    observation = _find_observation(posterior, free.recording or "")
    motion = posterior.system.model.motion
    if free.level not in (OFFSET, *NOISES):
        return ShownCoordinate(free.key, free.unit, 1.0 if free.log else 0.0)
    if free.level == RANDOM:
        return ShownCoordinate(
            NOISES[RANDOM] + free.key[len(RANDOM) :], unit_of("force", motion), 0.5, observation.dt**-0.5
        )
    if free.level == PACE:
        return ShownCoordinate(NOISES[PACE] + free.key[len(PACE) :], "1/s", 1.0)
    labels = [sensor.label for sensor in observation.sensors]
    channel = observation.sensors[labels.index(free.sensor) if free.sensor else 0].channel
    if free.level == OFFSET:
        return ShownCoordinate(free.key, unit_of(channel, motion), 0.0)
    return ShownCoordinate(NOISES[NOISE] + free.key[len(NOISE) :], unit_of(channel, motion), 1.0)


def _find_observation(posterior: Posterior, name: str) -> Observation:
    """Return the recording that a key names, or the first."""
    return next((t for t in posterior.observations if t.name == name), posterior.observations[0])
