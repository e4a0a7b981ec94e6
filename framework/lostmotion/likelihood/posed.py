"""One recording of a posterior: what coordinates mean there, laid out as the points that a filter takes."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.initial import compute_initial
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points, SensorNoises
from lostmotion.likelihood.running import RunningSystem
from lostmotion.likelihood.sensor_noise import compute_blocks, compute_variance, read_values
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.space import OFFSET, PACE, RANDOM, ParameterSpace, RecordingCoordinates, Scales
from lostmotion.likelihood.system import System
from lostmotion.noises import AR1, AR1_LEVEL, NoiseBlock

LATEST = 0.5
"""One of several sensors may be late by at most this many natural times of the motion (half a radian)."""


@dataclass(frozen=True)
class PosedRecording:
    """One recording with the system that made it: coordinates become values of parameters, and points of a filter.

    `known` is the full vector of the system, in which the free parameters of `space` are set. Coordinates are `theta`
    (n,), or `thetas` (points, n).
    """

    observation: Observation
    space: ParameterSpace
    dynamics: RunningSystem
    scales: Scales
    known: Array

    @property
    def system(self) -> System:
        """The model with its terms."""
        return self.dynamics.system

    @cached_property
    def coordinates(self) -> RecordingCoordinates:
        """The coordinates of each parameter in this recording."""
        return RecordingCoordinates.of(self.space.keys, self.observation.name)

    @cached_property
    def sensors(self) -> tuple[Sensor, ...]:
        """The sensors with all noises that are fitted: with AR(1) noise where that was added."""
        return tuple(
            replace(sensor, noises=(*sensor.noises, AR1()))
            if self.observation.level(AR1_LEVEL, i) in self.coordinates.columns and AR1() not in sensor.noises
            else sensor
            for i, sensor in enumerate(self.observation.sensors)
        )

    @cached_property
    def latest(self) -> int:
        """By how many samples a sensor can be late: where there are several, and terms that make one late."""
        observation = self.observation
        if len(observation.sensors) == 1 or not self.system.has_delay_terms:
            return 0
        return min(math.ceil(LATEST * self.scales.time / observation.dt), observation.samples // 20)

    @cached_property
    def _slots(self) -> tuple[tuple[int, Any], ...]:
        """The index of each free parameter of the system in the full vector."""
        frees = {f.parameter: f for f in self.space.free}
        return tuple((self.system.index[name], f) for name, f in frees.items() if f.physical)

    def full(self, theta: Array) -> Array:
        """Return the full parameter vector of the system at coordinates (n,), or (points, n)."""
        full = np.tile(self.known, (*theta.shape[:-1], 1))
        for slot, f in self._slots:
            full[..., slot] = f.value(self.coordinates.at(theta, f.parameter))
        return full

    def points(self, thetas: Array) -> Points:
        """Return coordinates (points, n) as a filter takes them."""
        observation, fulls, at, count = self.observation, self.full(thetas), self.coordinates.at, len(thetas)
        pace = np.exp(at(thetas, PACE)) if self.dynamics.random == "latent" else np.zeros(count)
        columns = [self._list_noise(thetas, s) for s in range(len(self.sensors))]
        noise = SensorNoises.of(list(zip(*columns, strict=True)))
        gain, offset, lag = self._compute_gauges(thetas, fulls)
        drives, which = self._make_drives(fulls)
        begun = compute_initial(self.dynamics, observation, self.scales, fulls, gain=gain, offset=offset)
        process, first = np.exp(at(thetas, RANDOM)), np.zeros(count, dtype=np.int64)
        lag = lag - np.rint(lag / observation.dt) * observation.dt
        return Points(fulls, process, pace, noise, gain, offset, lag, *begun, drives, which, first)

    def random_force(self, theta: Array) -> float:
        """Return the intensity of the random force (N^2 s)."""
        return math.exp(self.coordinates.at(theta, RANDOM))

    def noise(self, theta: Array, sensor: int = 0) -> NoiseBlock:
        """Return the noise of a sensor."""
        return self._list_noise(theta[None], sensor)[0]

    def noise_values(self, thetas: Array, sensor: int = 0) -> list[Array]:
        """Return for each noise of a sensor the values of its parameters, (points, parameters)."""
        level = self.observation.level
        return read_values(self.sensors[sensor], lambda name: self.coordinates.at(thetas, level(name, sensor)))

    def measurement(self, theta: Array, sensor: int = 0) -> float:
        """Return the variance of all noise of a sensor, in the middle of the recording."""
        return compute_variance(self.noise(theta, sensor), self.observation, sensor)

    def _list_noise(self, thetas: Array, sensor: int) -> list[NoiseBlock]:
        """Return the noise of a sensor at each of some coordinates (points, n)."""
        values = self.noise_values(thetas, sensor)
        return compute_blocks(self.sensors[sensor], values, self.observation.dt, len(thetas))

    def gauge(self, theta: Array, sensor: int = 0) -> tuple[float, float, float]:
        """Return the gain of a sensor, its reading at zero (unit of the channel), and its delay (s)."""
        gain, offset, lag = (array[0, sensor] for array in self._compute_gauges(theta[None], self.full(theta[None])))
        return float(gain), float(offset), float(lag)

    def count_delays(self, thetas: Array) -> list[tuple[int, ...]]:
        """Return for each of some coordinates (points, n) the delay of each sensor in whole samples."""
        if not self.latest or not self.system.has_sensor_terms(self.dynamics.active):
            return [(0,) * len(self.sensors)] * len(thetas)
        late = self._compute_gauges(thetas, self.full(thetas))[2] / self.observation.dt
        return [tuple(row) for row in np.rint(late).astype(int).tolist()]

    def _compute_gauges(self, thetas: Array, fulls: Array) -> tuple[Array, Array, Array]:
        """Return gain, reading at zero, and delay (s) of each sensor, (points, sensors) each.

        A sensor that is alone is never late: its delay term delays the drive.
        """
        shape, active = (len(fulls), len(self.sensors)), self.dynamics.active
        gain, offset, lag = np.ones(shape), np.zeros(shape), np.zeros(shape)
        gain *= self.observation.gains or 1.0
        for s, sensor in enumerate(self.sensors):
            if (key := self.observation.level(OFFSET, s)) in self.coordinates.columns:
                offset[:, s] = self.coordinates.at(thetas, key)
            for i, full in enumerate(fulls if self.system.has_sensor_terms(active) else ()):
                terms = self.system.at_sensor(full, active, sensor.place)
                gain[i, s] *= math.prod(term.gain(p) for term, p in terms)
                offset[i, s] += sum(term.offset(p) for term, p in terms)
                lag[i, s] = sum(term.delay(p) for term, p in terms)
        return gain, offset, np.clip(lag, 0.0, self.latest * self.observation.dt)

    def drive(self, full: Array) -> Drive:
        """Return the input that acts with the full parameter vector `full` of the system."""
        return self._make_drives(full[None])[0][0]

    def _make_drives(self, fulls: Array) -> tuple[tuple[Drive, ...], NDArray[np.int64]]:
        """Return the distinct inputs that act, and the number of that of each point."""
        observation, system = self.observation, self.system
        keys = system.list_input_terms(self.dynamics.active, alone=len(observation.sensors) == 1)
        if not keys:
            return (observation.drive,), np.zeros(len(fulls), dtype=np.int64)
        numbers: dict[Any, int] = {}
        drives: list[Drive] = []
        which = []
        for full in fulls:
            acts = [key for key in keys if not system.is_idle(full, key)]
            values = tuple(
                (key, system.onset(full, key), system.values(full, key, observation.harmonic)) for key in acts
            )
            if values not in numbers:
                numbers[values] = len(drives)
                columns = system.acting(observation.columns, full, acts, observation.harmonic, lead=observation.lead)
                drives.append(Drive.acting(columns, observation.drive, observation.held) if acts else observation.drive)
            which.append(numbers[values])
        return tuple(drives), np.array(which, dtype=np.int64)
