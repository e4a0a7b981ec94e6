"""The posterior density that every fit and every sampler uses: recordings, a system, and its free parameters."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.kernels.threads import each
from lostmotion.likelihood.bends import SensorCorrections, correct_twice, filter_corrected, list_corrections
from lostmotion.likelihood.drive import Drive, pad_inputs
from lostmotion.likelihood.engine import Engine, Innovations, Points, Random, RunningSystem, SensorNoises, Smoothed
from lostmotion.likelihood.initial import compute_initial
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation, shift_sensors
from lostmotion.likelihood.point_groups import find_distinct, group_rows, join_innovations, realign
from lostmotion.likelihood.sensor_noise import compute_blocks, compute_variance, read_values
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.space import (
    OFFSET,
    PACE,
    RANDOM,
    FreeParameter,
    ParameterSpace,
    RecordingCoordinates,
    Scales,
)  # fmt: skip
from lostmotion.likelihood.system import System
from lostmotion.noises import AR1, AR1_LEVEL, NOISE, NoiseBlock
from lostmotion.settings import DEFAULT, Settings

__all__ = ["NOISE", "OFFSET", "PACE", "RANDOM", "USUAL", "FreeParameter", "Innovations", "Problem", "Scales"]

USUAL = 1e-3
"""The usual noise of a measured excitation as a share of the drive, which is no missing mechanism."""
LATEST = 0.5
"""One of several sensors may be late by at most this many natural times of the motion (half a radian)."""


@dataclass(frozen=True)
class Problem:
    """Recordings, a system, its known parameters (`known`, full vector) and its free ones.

    A key such as `c[run 1]` is the parameter `c` of the recording "run 1" alone; without brackets all share it.

    The random force (process noise) is white, or, when `PACE` is among the free parameters, an Ornstein-Uhlenbeck force
    of the same intensity at low frequency. It represents what no term explains; with a memory it also absorbs slow
    residuals, which would otherwise count as evidence.
    """

    system: System
    observations: tuple[Observation, ...]
    scales: Scales
    known: Array
    free: tuple[FreeParameter, ...]
    active: frozenset[str] = frozenset()
    nsub: int = 3
    jobs: int = 2
    engine: Engine = field(default_factory=Lanes)
    settings: Settings = DEFAULT

    def __post_init__(self) -> None:
        """Pad the inputs that a recording lacks with zeros."""
        count, given = len(self.system.model.inputs), self.observations
        whole = (o if o.inputs.shape[1] >= count else replace(o, inputs=pad_inputs(o.inputs, count)) for o in given)
        object.__setattr__(self, "observations", tuple(whole))

    @cached_property
    def space(self) -> ParameterSpace:
        """The free parameters as coordinates."""
        return ParameterSpace(self.free)

    @property
    def samples(self) -> int:
        """The number of samples of all recordings."""
        return sum(observation.samples for observation in self.observations)

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys of the free parameters."""
        return self.space.keys

    @property
    def start(self) -> Array:
        """The coordinates to start from."""
        return self.space.start

    @cached_property
    def coloured(self) -> bool:
        """Whether the random force has a memory."""
        return any(f.parameter == PACE for f in self.free)

    @cached_property
    def coordinates(self) -> tuple[RecordingCoordinates, ...]:
        """The coordinates of each parameter in each recording."""
        return tuple(RecordingCoordinates.of(self.keys, observation.name) for observation in self.observations)

    def _make_view(self, index: int, late: tuple[int, ...] = ()) -> Observation:
        """Return a recording as an engine sees it: with the noise kinds of its sensors, moved by whole samples.

        `late` says by how many samples each sensor is late. Where sensors may be late, the same first readings are left
        out for any `late`, so that likelihoods can be compared.
        """
        if (index, late) not in self._views:
            sensors = tuple(self.find_sensor(index, i) for i in range(len(self.observations[index].sensors)))
            view, most = replace(self.observations[index], sensors=sensors), self._count_latest(index)
            self._views[index, late] = shift_sensors(view, late or (0,) * len(sensors), most) if most else view
        return self._views[index, late]

    def find_sensor(self, index: int, sensor: int) -> Sensor:
        """Return a sensor of a recording with all noises that are fitted: with AR(1) noise where that was added."""
        observation = self.observations[index]
        found, added = observation.sensors[sensor], observation.level(AR1_LEVEL, sensor)
        if added not in self.coordinates[index].columns or AR1() in found.noises:
            return found
        return replace(found, noises=(*found.noises, AR1()))

    def view(self, index: int = 0) -> Observation:
        """Return a recording as an engine sees it, where no sensor is late."""
        return self._make_view(index, self.count_delays(self.start[None], index)[0])

    @cached_property
    def _views(self) -> dict[tuple[int, tuple[int, ...]], Observation]:
        """The recordings as an engine has seen them, so that their cached properties are computed once."""
        return {}

    def _count_latest(self, index: int) -> int:
        """Return by how many samples a sensor can be late: where there are several, and terms that make one late."""
        observation = self.observations[index]
        if len(observation.sensors) == 1 or not self.system.has_delay_terms:
            return 0
        return min(math.ceil(LATEST * self.scales.time / observation.dt), observation.samples // 20)

    @cached_property
    def running(self) -> RunningSystem:
        """The system with its active terms, as an engine sees it."""
        random: Random = "white"
        if self.coloured:
            random = "latent"
        elif self.system.holds_forces(s.channel for o in self.observations for s in o.sensors):
            random = "held"
        return RunningSystem(self.system, self.active, self.nsub, random)

    @cached_property
    def _slots(self) -> tuple[tuple[int, FreeParameter], ...]:
        """The index of each free parameter of the system in the full vector."""
        frees = {f.parameter: f for f in self.free}
        return tuple((self.system.index[name], f) for name, f in frees.items() if f.physical)

    def full(self, theta: Array, index: int = 0) -> Array:
        """Return the full parameter vector of the system in a recording at coordinates (n,), or (points, n)."""
        coordinates = self.coordinates[index]
        full = np.tile(self.known, (*theta.shape[:-1], 1))
        for slot, f in self._slots:
            full[..., slot] = f.value(coordinates.at(theta, f.parameter))
        return full

    def values(self, theta: Array) -> dict[str, float]:
        """Return the free parameters by key at the coordinates `theta`."""
        return {key: float(value) for key, value in self.space.values(theta).items()}

    def log_prior(self, theta: Array) -> Any:
        """Return the log prior density at coordinates, one point or many."""
        return self.space.log_prior(theta)

    def clip(self, theta: Array) -> Array:
        """Return the coordinates moved into their bounds."""
        return self.space.clip(theta)

    def innovations(self, theta: Array) -> Innovations:
        """Return the one-step prediction errors of the filter at the coordinates `theta`, all readings in a row."""
        return self.filter_many(theta[None])[0]

    def log_posterior(self, theta: Array) -> float:
        """Return log-likelihood plus log prior at the coordinates `theta`."""
        return float(self.log_posteriors(theta[None])[0])

    def log_posteriors(self, thetas: Array) -> Array:
        """Return log-likelihood plus log prior (points,) at coordinates (points, n); -inf outside of the prior."""
        found = np.array(self.log_prior(thetas))
        inside = np.isfinite(found)
        if inside.any():
            found[inside] += self.log_likelihoods(thetas[inside])
        return found

    def log_likelihoods(self, thetas: Array) -> Array:
        """Return the log-likelihood (points,) at coordinates (points, n); minus infinity where it diverges."""
        return np.asarray(sum(part.log_likelihood for part in self._filter_all(np.asarray(thetas))))

    def filter_many(self, thetas: Array) -> Innovations:
        """Return the innovations (points, readings) at coordinates (points, n), all recordings in a row."""
        parts = self._filter_all(np.asarray(thetas))
        flat = [(p.errors.reshape(len(p), -1), p.variances.reshape(len(p), -1)) for p in parts]
        errors, variances = (
            np.concatenate([f[k] for f in flat], axis=1) if len(flat) > 1 else flat[0][k] for k in (0, 1)
        )
        return Innovations(errors, variances, np.all([p.finite for p in parts], axis=0))

    def _filter_all(self, thetas: Array) -> list[Innovations]:
        """Return the innovations of each recording; points that are equal in all that matters are filtered once."""
        tasks, places = [], []
        for index, coordinates in enumerate(self.coordinates):
            rows, inverse = find_distinct(thetas[:, coordinates.used])
            places.append(inverse)
            share = self.engine.count_together(len(rows), self.jobs)
            alike = group_rows(rows, self._list_views(thetas[rows], index))
            tasks += [(index, some[k : k + share]) for some in alike for k in range(0, len(some), share)]
            if len(alike) > 1:  # the order of the tasks is another than that of the rows
                place = np.empty(len(thetas), dtype=np.intp)
                place[np.concatenate(alike)] = np.arange(len(rows))
                places[-1] = place[rows if inverse is None else rows[inverse]]
        done = self._filter_tasks(tasks, thetas)
        found = []
        for index, inverse in enumerate(places):
            parts = [part for (i, _), part in zip(tasks, done, strict=True) if i == index]
            whole = parts[0] if len(parts) == 1 else join_innovations(parts)
            found.append(whole if inverse is None else whole[inverse])
        return found

    def count_delays(self, thetas: Array, index: int = 0) -> list[tuple[int, ...]]:
        """Return for each of some coordinates (points, n) the delay of each sensor in whole samples."""
        observation = self.observations[index]
        if not self._count_latest(index) or not self.system.has_sensor_terms(self.active):
            return [(0,) * len(observation.sensors)] * len(thetas)
        late = self._compute_gauges(self.full(thetas, index), index)[2] / observation.dt
        return [tuple(row) for row in np.rint(late).astype(int).tolist()]

    def _filter_tasks(self, tasks: Sequence[tuple[int, NDArray[np.intp]]], thetas: Array) -> list[Innovations]:
        def work(task: tuple[int, NDArray[np.intp]]) -> Innovations:
            index, rows = task
            late = self.count_delays(thetas[rows[:1]], index)[0]
            changing = self.active & {*self.system.bending_terms, *self.system.rescaling}
            corrections = [self._list_corrections(theta, index) for theta in thetas[rows]] if changing else []
            awake = self._drop_idle_lags(thetas[rows[0]], index)
            run = partial(self.engine.filter, awake.running)
            found = filter_corrected(run, self._make_view(index, late), corrections, awake.points(thetas[rows], index))
            return realign(found, late) if any(late) else found

        return each(work, tasks, self.jobs)

    def _list_views(self, thetas: Array, index: int) -> list[tuple[Any, ...]]:
        """Return for each of some coordinates (points, n) what changes the view of readings: delay, idle lags."""
        late = self.count_delays(thetas, index)
        if not self.active & set(self.system.lagging_terms):
            return list(late)
        awake = [self._drop_idle_lags(theta, index).active for theta in thetas]
        return list(zip(late, awake, strict=True))

    def _drop_idle_lags(self, theta: Array, index: int) -> Problem:
        """Return the problem without sensors that have no lag at some coordinates: a lag of zero has no rate."""
        lagging = self.active & set(self.system.lagging_terms)
        idle = {key for key in lagging if self.system.is_idle(self.full(theta, index), key)}
        return replace(self, active=self.active - idle) if idle else self

    def _list_corrections(self, theta: Array, index: int) -> SensorCorrections:
        """Return the corrections of the readings of a recording at some coordinates."""
        return list_corrections(self.system, self.active, self.full(theta, index), self.observations[index].sensors)

    def points(self, thetas: Array, index: int = 0) -> Points:
        """Return coordinates (points, n) as an engine takes them, for one recording."""
        observation, fulls = self.observations[index], self.full(thetas, index)
        coordinates, shape = self.coordinates[index], (len(thetas), len(observation.sensors))
        pace = np.exp(coordinates.at(thetas, PACE)) if self.coloured else np.zeros(len(thetas))
        columns = [self._list_noise(thetas, index, s) for s in range(shape[1])]
        noise = SensorNoises.of(list(zip(*columns, strict=True)))
        offset = np.stack([self._compute_offset(thetas, index, s) for s in range(shape[1])], axis=1)
        gain, more, lag = self._compute_gauges(fulls, index)
        offset, lag = offset + more, lag - np.rint(lag / observation.dt) * observation.dt
        drives, which = self._make_drives(fulls, index)
        begun = compute_initial(self.running, observation, self.scales, fulls, gain=gain, offset=offset)
        process = np.exp(coordinates.at(thetas, RANDOM))
        first = np.zeros(len(thetas), dtype=np.int64)
        return Points(fulls, process, pace, noise, gain, offset, lag, *begun, drives, which, first)

    def _list_noise(self, thetas: Array, index: int, sensor: int) -> list[NoiseBlock]:
        """Return the noise of a sensor at each of some coordinates (points, n)."""
        values = self.noise_values(thetas, index, sensor)
        return compute_blocks(self.find_sensor(index, sensor), values, self.observations[index].dt, len(thetas))

    def noise_values(self, thetas: Array, index: int = 0, sensor: int = 0) -> list[Array]:
        """Return for each noise of a sensor the values of its parameters, (points, parameters)."""
        observation, coordinates = self.observations[index], self.coordinates[index]
        own = self.find_sensor(index, sensor)
        return read_values(own, lambda name: coordinates.at(thetas, observation.level(name, sensor)))

    def _compute_offset(self, thetas: Array, index: int, sensor: int) -> Array:
        """Return the reading (points,) of a sensor at zero, without the terms that act on it."""
        key, coordinates = self.observations[index].level(OFFSET, sensor), self.coordinates[index]
        return np.zeros(len(thetas)) + (coordinates.at(thetas, key) if key in coordinates.columns else 0.0)

    def _compute_gauges(self, fulls: Array, index: int) -> tuple[Array, Array, Array]:
        """Return gain, offset, and delay (s) of each sensor, (points, sensors) each.

        A sensor that is alone is never late: its delay term delays the drive.
        """
        observation = self.observations[index]
        shape = (len(fulls), len(observation.sensors))
        gain, offset, lag = np.ones(shape), np.zeros(shape), np.zeros(shape)
        if self.system.has_sensor_terms(self.active):
            for s, sensor in enumerate(observation.sensors):
                for i, full in enumerate(fulls):
                    terms = self.system.at_sensor(full, self.active, sensor.place)
                    gain[i, s] = math.prod(term.gain(p) for term, p in terms)
                    offset[i, s] = sum(term.offset(p) for term, p in terms)
                    lag[i, s] = sum(term.delay(p) for term, p in terms)
        return gain, offset, np.clip(lag, 0.0, self._count_latest(index) * observation.dt)

    def _make_drives(self, fulls: Array, index: int) -> tuple[tuple[Drive, ...], NDArray[np.int64]]:
        """Return the distinct inputs that act in a recording, and the number of that of each point."""
        observation = self.observations[index]
        keys = self.system.list_input_terms(self.active, alone=len(observation.sensors) == 1)
        if not keys:
            return (observation.drive,), np.zeros(len(fulls), dtype=np.int64)
        numbers: dict[Any, int] = {}
        drives: list[Drive] = []
        which = []
        for full in fulls:
            acts = [key for key in keys if not self.system.is_idle(full, key)]
            values = tuple(
                (key, self.system.onset(full, key), self.system.values(full, key, observation.harmonic)) for key in acts
            )
            if values not in numbers:
                numbers[values] = len(drives)
                columns = self.system.acting(
                    observation.columns, full, acts, observation.harmonic, lead=observation.lead
                )
                drives.append(Drive.acting(columns, observation.drive, observation.held) if acts else observation.drive)
            which.append(numbers[values])
        return tuple(drives), np.array(which, dtype=np.int64)

    def drive(self, index: int, theta: Array) -> Drive:
        """Return the input that acts in a recording at the coordinates `theta`."""
        return self.drive_at(self.full(theta, index), index)

    def drive_at(self, full: Array, index: int) -> Drive:
        """Return the input that acts in a recording with the full parameter vector `full` of the system."""
        return self._make_drives(full[None], index)[0][0]

    def random_force(self, theta: Array, index: int = 0) -> float:
        """Return the intensity of the random force (N^2 s)."""
        return math.exp(self.coordinates[index].at(theta, RANDOM))

    def noise(self, theta: Array, index: int = 0, sensor: int = 0) -> NoiseBlock:
        """Return the noise of a sensor."""
        return self._list_noise(theta[None], index, sensor)[0]

    def measurement(self, theta: Array, index: int = 0, sensor: int = 0) -> float:
        """Return the variance of all noise of a sensor, in the middle of the recording."""
        return compute_variance(self.noise(theta, index, sensor), self.observations[index], sensor)

    def compute_gauge(self, theta: Array, index: int = 0, sensor: int = 0) -> tuple[float, float, float]:
        """Return the gain of a sensor, its reading at zero (unit of the channel), and its delay (s)."""
        fulls = self.full(theta, index)[None]
        gain, more, lag = self._compute_gauges(fulls, index)
        zero = float(self._compute_offset(theta[None], index, sensor)[0])
        return float(gain[0, sensor]), zero + float(more[0, sensor]), float(lag[0, sensor])

    def begun(self, theta: Array, index: int = 0) -> Array:
        """Return the mean state (n,) of model and terms at the first sample of a recording."""
        return np.asarray(self.points(theta[None], index).mean[0])

    def smooth(self, theta: Array, index: int = 0) -> Smoothed:
        """Return the filtered and the smoothed states of a recording at the coordinates `theta`."""
        view = self._make_view(index, self.count_delays(theta[None], index)[0])
        points = self.points(theta[None], index)
        run = partial(self.engine.filter, self.running)
        readings, _ = correct_twice(run, view, [self._list_corrections(theta, index)], points)
        return self.engine.smooth(self.running, view, replace(points, readings=readings))

    def extend(self, more: Iterable[FreeParameter], active: Iterable[str]) -> Problem:
        """Return the problem with further free parameters and terms."""
        return replace(self, free=(*self.free, *more), active=self.active | frozenset(active))

    def hold_values(self, values: Mapping[str, float]) -> Problem:
        """Return the problem with further parameters held at `values`."""
        known = self.known.copy()
        known[[self.system.index[key] for key in values]] = list(values.values())
        return replace(self, known=known)

    def remove_term(self, key: str, values: Mapping[str, float]) -> Problem:
        """Return the problem without the term `key`; `values` become the new starting points."""
        kept = tuple(
            replace(f, start=f.coordinate(values.get(f.key, f.value(f.start))))
            for f in self.free
            if not f.key.startswith(key + ".")
        )
        return replace(self, free=kept, active=self.active - {key})

    def on(self, observations: tuple[Observation, ...]) -> Problem:
        """Return the same problem on other recordings, or on parts of them."""
        return replace(self, observations=observations)
