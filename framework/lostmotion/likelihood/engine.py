"""What an engine does, its arguments and its results: plain arrays for many parameter points at once."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.kernels.smooth import smooth
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.kernel_calls import count_lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.system import System
from lostmotion.noises import NoiseBlock

Random = Literal["white", "held", "latent"]
"""How the random force acts: white; held over each sample, where a sensor sees it at once; or with a memory."""
Kept = tuple[Array, Array, Array, Array, Array]
"""The input of a smoother: states and covariances after and before each sample, and the transition matrices between."""
TOGETHER = 16
"""Points that are computed at once where there are enough for all cores; more are limited by memory."""
RUNAWAY = 1e12
"""A filter has diverged where the rms of its standardised innovations exceeds this. Its errors and their differences
are then meaningless, and the squares of their derivatives overflow."""


@dataclass(frozen=True)
class RunningSystem:
    """A system with its active terms, integrated in at most `nsub` steps to a sample.

    A random force acts on each body; one with a memory (`latent`) on the first body alone. With `held` and `latent`
    each force is a state of its own, after those of model and terms.
    """

    system: System
    active: frozenset[str] = frozenset()
    nsub: int = 1
    random: Random = "white"

    @cached_property
    def states(self) -> int:
        """The number of states of model and terms."""
        return self.system.states(self.active)

    @cached_property
    def forces(self) -> int:
        """The number of random forces that are states."""
        return {"white": 0, "latent": 1, "held": self.system.bodies}[self.random]


@dataclass(frozen=True)
class SensorNoises:
    """Noise of all sensors at some points: variances of white noise and of stamps (s^2), each (points, sensors).

    The m states of all noises follow each other in the order of the sensors: `shown` (points, m) is what each adds to
    the reading of its sensor; `transition`, `driving` and `first` are (points, m, m), blocks of zeros between sensors.
    """

    white: Array
    clock: Array
    shown: Array
    transition: Array
    driving: Array
    first: Array

    @classmethod
    def of(cls, blocks: Sequence[Sequence[NoiseBlock]]) -> SensorNoises:
        """Return the noise from the blocks of each point, one for each sensor."""
        whole = [NoiseBlock.join(row) for row in blocks]
        white, clock = (np.array([[getattr(b, name) for b in row] for row in blocks]) for name in ("white", "clock"))
        more = [np.stack([getattr(b, name) for b in whole]) for name in ("shown", "transition", "driving", "first")]
        return cls(white, clock, *more)

    def variances(self, sensors: Sequence[Sensor]) -> Array:
        """Return the variance (points, sensors) at the first sample, without that of the stamps."""
        found, end = self.white.copy(), 0
        for s, sensor in enumerate(sensors):
            own, end = slice(end, end + sensor.noise_states), end + sensor.noise_states
            found[:, s] += np.einsum("pa,pab,pb->p", self.shown[:, own], self.first[:, own, own], self.shown[:, own])
        return found

    @classmethod
    def join(cls, parts: Sequence[SensorNoises]) -> SensorNoises:
        """Return the noise at the points of all parts."""
        return cls(*(np.concatenate([getattr(p, f.name) for p in parts]) for f in fields(cls)))

    def select(self, rows: Any) -> SensorNoises:
        """Return some of the points."""
        return SensorNoises(*(getattr(self, f.name)[rows] for f in fields(self)))


@dataclass(frozen=True)
class Points:
    """Parameter points for one observation; the first axis of each array runs over them.

    `params` (points, parameters) are in the order of `System.slots`. `process` is the intensity (N^2 s, N^2 m^2 s)
    of the random force and `pace` (1/s) the decay rate of a latent one. `noise` is that of the sensors. For each
    sensor, (points, sensors): `gain` and `offset` relate the reading to the channel, and `lag` (s) is its delay
    within half a sample either way. The states of model and terms begin at `mean` (points, n) with `covariance`
    (points, n, n). `drives` are the inputs, `which` (points,) the one of each point, and `first` (points,) the
    sample of its drive at which a simulation begins. `readings` (points, samples, sensors) take the place of those
    of the observation, where each point corrects them.
    """

    params: Array
    process: Array
    pace: Array
    noise: SensorNoises
    gain: Array
    offset: Array
    lag: Array
    mean: Array
    covariance: Array
    drives: tuple[Drive, ...]
    which: NDArray[np.int64]
    first: NDArray[np.int64]
    readings: Array | None = None

    def __len__(self) -> int:
        return len(self.params)

    def select(self, rows: Any) -> Points:
        """Return some of the points: a slice, or an array of their numbers."""
        arrays = {f.name: getattr(self, f.name) for f in fields(self) if f.name not in ("drives", "noise")}
        kept = {name: array[rows] for name, array in arrays.items() if array is not None}
        return replace(self, noise=self.noise.select(rows), **kept)


def join_points(parts: Sequence[Points], views: Sequence[Observation]) -> Points:
    """Return the points of recordings that differ in inputs or readings only; `views` has that of each part."""
    if len(parts) == 1:
        return parts[0]
    names = [f.name for f in fields(Points) if f.name not in ("drives", "which", "noise", "readings")]
    arrays = {name: np.concatenate([getattr(p, name) for p in parts]) for name in names}
    before = np.cumsum([0, *(len(p.drives) for p in parts)])
    return Points(
        **arrays,
        noise=SensorNoises.join([p.noise for p in parts]),
        drives=tuple(drive for p in parts for drive in p.drives),
        which=np.concatenate([p.which + first for p, first in zip(parts, before, strict=False)]),
        readings=np.stack([view.readings for p, view in zip(parts, views, strict=True) for _ in range(len(p))]),
    )


@dataclass(frozen=True)
class Innovations:
    """One-step errors and their variances, and which points were filtered over all samples without divergence.

    From an engine both are (points, samples, sensors) and `finite` is (points,); where nothing was read the error is 0
    and the variance 1 / (2 pi), which adds nothing. `reached` counts the samples that were computed.
    """

    errors: Array
    variances: Array
    finite: NDArray[np.bool_]
    reached: NDArray[np.int64] | None = None

    @classmethod
    def of(cls, errors: Array, variances: Array, reached: NDArray[np.int64]) -> Innovations:
        """Return the innovations of an engine that computed `reached` samples at each point."""
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            kept = np.sum(errors * errors / variances, axis=(1, 2)) <= RUNAWAY**2 * errors.shape[1]
        return cls(errors, variances, (reached == errors.shape[1]) & kept, reached)

    @property
    def log_likelihood(self) -> Any:
        """The log-likelihood from the innovations, (points,) or one number; minus infinity after a divergence."""
        axes = tuple(range(np.ndim(self.finite), self.errors.ndim))
        with np.errstate(all="ignore"):
            told = -0.5 * np.sum(self.errors**2 / self.variances + np.log(2.0 * np.pi * self.variances), axis=axes)
        found = np.where(self.finite & np.isfinite(told), told, -math.inf)
        return found if found.ndim else float(found)

    def __getitem__(self, point: Any) -> Innovations:
        return Innovations(self.errors[point], self.variances[point], self.finite[point])

    def __len__(self) -> int:
        return len(self.errors)


@dataclass(frozen=True)
class Smoothed:
    """The filtered and smoothed states (samples, n) of one point, with their covariances (samples, n, n).

    The random forces that are states come after the states of model and terms.
    """

    filtered: Array
    filtered_covariance: Array
    states: Array
    covariance: Array
    innovations: Innovations


class Engine(ABC):
    """Filters, smooths and simulates a model with its terms at many points, thread-safe, each point independently.

    A point that diverges raises no error: `Innovations.of` marks it, as in `likelihood.reference`.
    """

    def count_together(self, points: int, jobs: int) -> int:
        """Return how many of some points are filtered in one call, where `jobs` cores share them."""
        return min(count_lanes(-(-points // jobs)), TOGETHER)

    @abstractmethod
    def filter(self, running: RunningSystem, observation: Observation, points: Points) -> Innovations:
        """Return one-step errors and their variances, each (points, samples, sensors), in SI units and their squares.

        A missing reading (NaN) has the error 0 and the variance 1 / (2 pi), so that it adds nothing.
        """

    @abstractmethod
    def smooth(self, running: RunningSystem, observation: Observation, points: Points) -> Smoothed:
        """Return filtered and smoothed states (samples, n) of a single point, with covariances (samples, n, n)."""

    @abstractmethod
    def simulate(
        self, running: RunningSystem, points: Points, start: Array, steps: int, kicks: Array | None = None
    ) -> Array:
        """Return states (points, steps, n) of free runs from `start` (points, n), NaN after the last finite one.

        A run begins at sample `points.first` of its drive; `kicks` (points, steps, n) are added after the first state.
        """


class KeepingEngine(Engine):
    """An engine whose filter can keep, for one point, what a smoother and a linearisation need."""

    @abstractmethod
    def filter_and_keep(
        self, running: RunningSystem, observation: Observation, points: Points, kept: Kept | None
    ) -> Innovations:
        """Return the same as `filter`, and write what a smoother needs of the first point into `kept` (`make_kept`).

        The other points are near the first one then: an engine that adapts its steps takes those of the first one.
        """

    def filter(self, running: RunningSystem, observation: Observation, points: Points) -> Innovations:
        """Return one-step errors and their variances, (points, samples, sensors)."""
        return self.filter_and_keep(running, observation, points, None)

    def run_for_smoother(
        self, running: RunningSystem, observation: Observation, points: Points
    ) -> tuple[Kept, Innovations]:
        """Return the input of a smoother at one point, and its innovations."""
        kept = make_kept(running, observation.samples)
        return kept, self.filter_and_keep(running, observation, points.select(slice(0, 1)), kept)

    def smooth(self, running: RunningSystem, observation: Observation, points: Points) -> Smoothed:
        """Return filtered and smoothed states of one point, and their covariances."""
        kept, innovations = self.run_for_smoother(running, observation, points)
        states, covariance = smooth(*kept)
        return Smoothed(kept[0], kept[1], states, covariance, innovations)


def make_kept(running: RunningSystem, samples: int) -> Kept:
    """Return the arrays in which a filter keeps what a smoother needs of one point."""
    n = running.states + running.forces
    square = (samples, n, n)
    return np.zeros((samples, n)), np.zeros(square), np.zeros((samples, n)), np.zeros(square), np.zeros(square)
