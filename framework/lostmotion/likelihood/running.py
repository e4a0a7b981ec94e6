"""A machine as a posterior runs it: a system with its active terms, filtered, smoothed and simulated at many points."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from lostmotion.contracts import Array
from lostmotion.kernels.smooth import smooth
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.innovations import Innovations, Smoothed
from lostmotion.likelihood.kernel_calls import count_lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points
from lostmotion.likelihood.system import System

Random = Literal["white", "held", "latent"]
"""How the random force acts: white; held over each sample, where a sensor sees it at once; or with a memory."""
Kept = tuple[Array, Array, Array, Array, Array]
"""The input of a smoother: states and covariances after and before each sample, and the transition matrices between."""
TOGETHER = 16
"""Points that are computed at once where there are enough for all cores; more are limited by memory."""


@dataclass(frozen=True)
class RunningSystem(ABC):
    """A system with its active terms, integrated in at most `nsub` steps to a sample, each point independently.

    A random force acts on each body; one with a memory (`latent`) on the first body alone. With `held` and `latent`
    each force is a state of its own, after those of model and terms. The methods are thread-safe. A point that diverges
    raises no error: `Innovations.of` marks it, with the status of the filter.
    """

    system: System
    active: frozenset[str] = frozenset()
    nsub: int = 3
    random: Random = "white"

    @cached_property
    def states(self) -> int:
        """The number of states of model and terms."""
        return self.system.states(self.active)

    @cached_property
    def forces(self) -> int:
        """The number of random forces that are states."""
        return {"white": 0, "latent": 1, "held": self.system.bodies}[self.random]

    def pack(self, fulls: Array, seen: Observation | Drive) -> Array:
        """Return full vectors (points, parameters) as kernels take them, at the samples of a recording or a drive."""
        return self.system.pack(fulls, seen.dt / self.nsub, seen.harmonic)

    def count_together(self, points: int, jobs: int) -> int:
        """Return how many of some points are filtered in one call, where `jobs` cores share them."""
        return min(count_lanes(-(-points // jobs)), TOGETHER)

    def compute_start(self, points: Points) -> tuple[Array, Array]:
        """Return mean (points, n) and covariance (points, n, n) of all states at the first sample.

        They include random forces: one with a memory starts with its stationary variance, held ones start at zero.
        """
        m, n = self.states, self.states + self.forces
        mean, covariance = np.zeros((len(points), n)), np.zeros((len(points), n, n))
        mean[:, :m], covariance[:, :m, :m] = points.mean, points.covariance
        if self.random == "latent":
            covariance[:, m, m] = 0.5 * points.process * points.pace
        return mean, covariance

    @abstractmethod
    def filter_and_keep(self, observation: Observation, points: Points, kept: Kept | None) -> Innovations:
        """Return the same as `filter`, and write what a smoother needs of the first point into `kept` (`make_kept`).

        The other points are near the first one then: where steps are adapted, they take those of the first one.
        """

    @abstractmethod
    def simulate(self, points: Points, start: Array, steps: int, kicks: Array | None = None) -> Array:
        """Return states (points, steps, n) of free runs from `start` (points, n), NaN after the last finite one.

        A run begins at sample `points.first` of its drive; `kicks` (points, steps, n) are added after the first state.
        """

    def filter(self, observation: Observation, points: Points) -> Innovations:
        """Return one-step errors and their variances, each (points, samples, sensors), in SI units and their squares.

        A missing reading (NaN) has the error 0 and the variance 1 / (2 pi), so that it adds nothing.
        """
        return self.filter_and_keep(observation, points, None)

    def smooth(self, observation: Observation, points: Points) -> Smoothed:
        """Return filtered and smoothed states (samples, n) of the first point, with covariances (samples, n, n)."""
        kept = self.make_kept(observation.samples)
        innovations = self.filter_and_keep(observation, points.select(slice(0, 1)), kept)
        states, covariance = smooth(*kept)
        return Smoothed(kept[0], kept[1], states, covariance, innovations)

    def make_kept(self, samples: int) -> Kept:
        """Return the arrays in which a filter keeps what a smoother needs of one point."""
        n = self.states + self.forces
        square = (samples, n, n)
        return np.zeros((samples, n)), np.zeros(square), np.zeros((samples, n)), np.zeros(square), np.zeros(square)
