"""Machines that can only be stepped: many points at once, in plain NumPy.

Each sample costs one call of `step` (two if terms act) for all points and all directions of the state together. Random
forces are held over each sample. Source: Norgaard, Poulsen, Ravn, Automatica 36 (2000) 1627-1638, with differences
along the axes of the state, as in `lanes`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.errors import ContractError
from lostmotion.kernels.crossing import TINY
from lostmotion.kernels.filter import UNREAD_VARIANCE
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points
from lostmotion.likelihood.running import Kept, RunningSystem
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.stepped import MachineRows, SteppedSystem, cross_inputs
from lostmotion.likelihood.system import System
from lostmotion.likelihood.work import add_work

TOGETHER = 64
"""The largest number of points in one call."""
REACH = 3.0**0.5
"""Differences are taken over this many standard deviations of a state."""


@dataclass(frozen=True)
class Steps(RunningSystem):
    """Filters many points at once by steps of a `Dynamics`."""

    def count_together(self, points: int, jobs: int) -> int:
        """Return how many points are filtered in one call: more of them cost little more, and no second core helps."""
        return min(points, TOGETHER)

    def filter_and_keep(self, observation: Observation, points: Points, kept: Kept | None) -> Innovations:
        """Return one-step errors and variances; write what a smoother needs of the first point into `kept`."""
        run = _Filter.of(self, observation, points)
        with np.errstate(all="ignore"):  # a point that diverges is marked
            run.run(kept)
        add_work(len(points) * observation.samples * self.nsub * run.size)
        return Innovations.of(run.errors, run.variances, run.reached)

    def simulate(self, points: Points, start: Array, steps: int, kicks: Array | None = None) -> Array:
        """Return the states (points, steps, n) of free runs from `start` (points, n), NaN after a divergence."""
        system, states = _require_steps(self), np.empty((len(points), steps, self.states))
        for number, drive in enumerate(points.drives):
            rows = np.flatnonzero(points.which == number)
            if len(rows):
                packed = self.pack(points.params[rows], drive)
                pushed = None if kicks is None else kicks[rows]
                states[rows], _ = system.run_freely(
                    self.active, packed, start[rows], drive, self.nsub, points.first[rows], steps, kicks=pushed
                )
        return states


def run_system(system: System) -> RunningSystem:
    """Return a system without active terms, ready to run: in compiled lanes if it has equations, else by steps."""
    return Steps(system) if isinstance(system, SteppedSystem) else Lanes(system)


def _require_steps(running: RunningSystem) -> SteppedSystem:
    if not isinstance(running.system, SteppedSystem):
        raise ContractError(f"{running.system.model.name} has no step: use `Lanes`")
    return running.system


@dataclass(eq=False)
class _Filter:
    """The filter over one recording at some points: `state` (points, N) and `cov` (points, N, N), and the results.

    The states are those of machine and terms, then `size - states` random forces, then the noise of sensors.
    """

    running: RunningSystem
    observation: Observation
    points: Points
    size: int
    state: Array
    cov: Array
    errors: Array
    variances: Array
    reached: NDArray[np.int64]
    alive: NDArray[np.bool_] = field(init=False)

    def __post_init__(self) -> None:
        self.alive = np.ones(len(self.points), dtype=np.bool_)

    @classmethod
    def of(cls, running: RunningSystem, observation: Observation, points: Points) -> _Filter:
        """Return the filter before the first sample."""
        noise, size, count = points.noise, running.states + running.forces, len(points)
        whole = size + noise.shown.shape[1]
        state, cov = np.zeros((count, whole)), np.zeros((count, whole, whole))
        state[:, :size], cov[:, :size, :size] = running.compute_start(points)
        cov[:, size:, size:] = noise.first
        shape = (count, observation.samples, len(observation.sensors))
        unread, reached = np.full(shape, UNREAD_VARIANCE), np.zeros(count, dtype=np.int64)
        return cls(running, observation, points, size, state, cov, np.zeros(shape), unread, reached)

    @cached_property
    def system(self) -> SteppedSystem:
        """The machine with its terms."""
        return _require_steps(self.running)

    @cached_property
    def wide(self) -> MachineRows:
        """The machine at each point, in the middle and on both sides along each state."""
        return self._make_rows(2 * self.size + 1)

    @cached_property
    def single(self) -> MachineRows:
        """The machine at each point."""
        return self._make_rows(1)

    def _make_rows(self, repeat: int) -> MachineRows:
        drive, points = self.points.drives[0], self.points
        packed = self.system.pack(points.params, self.observation.dt / self.running.nsub, drive.harmonic)
        near = points.mean[:, : len(self.system.model.states), None]
        return self.system.make_rows(packed, self.running.active, near, repeat=repeat)

    @cached_property
    def crossed(self) -> list[list[Array]]:
        """The inputs at the beginning of each step, on average and at its end, each (samples, drives, inputs)."""
        count, nsub, drives = len(self.system.model.inputs), self.running.nsub, self.points.drives
        cubics = [drive.pad_inputs(count).cubics for drive in drives]
        each = [[cross_inputs(c, j / nsub, 1.0 / nsub) for c in cubics] for j in range(nsub)]
        return [[np.stack([one[i] for one in step], axis=1) for i in range(3)] for step in each]

    @cached_property
    def readings(self) -> Array:
        """The readings (points, samples, sensors)."""
        same = np.broadcast_to(self.observation.readings, self.errors.shape)
        return same if self.points.readings is None else self.points.readings

    def run(self, kept: Kept | None) -> None:
        """Filter all samples."""
        for k in range(self.observation.samples):
            self._redraw_forces()
            self._keep(kept, 2, k)
            for s, sensor in enumerate(self.observation.sensors):
                self._update(k, s, sensor)
            good = np.isfinite(self.state).all(axis=1) & (self.variances[:, k] > 0.0).all(axis=1)
            self.alive &= good & np.isfinite(self.cov).all(axis=(1, 2))
            self.reached[self.alive] = k + 1
            self.state[~self.alive], self.cov[~self.alive] = 0.0, 0.0
            self._keep(kept, 0, k)
            if k == self.observation.samples - 1 or not self.alive.any():
                break
            across = self._cross(k)
            if kept is not None:
                kept[4][k] = across[0]

    def _keep(self, kept: Kept | None, at: int, k: int) -> None:
        if kept is not None:
            kept[at][k], kept[at + 1][k] = self.state[0, : self.size], self.cov[0, : self.size, : self.size]

    @property
    def _forces(self) -> slice:
        return slice(self.running.states, self.size)

    def _redraw_forces(self) -> None:
        """Reset the forces that are held over a sample to their prior."""
        if self.running.random == "held":
            own = self._forces
            self.state[:, own], self.cov[:, own], self.cov[:, :, own] = 0.0, 0.0, 0.0
            self.cov[:, own, own] = (
                np.eye(self.running.forces) * (self.points.process / self.observation.dt)[:, None, None]
            )

    def _spread(self) -> tuple[Array, Array]:
        """Return states in the middle and on both sides (points, 2 size + 1, size), and the steps (points, size)."""
        middle = self.state[:, : self.size]
        sd = np.sqrt(np.maximum(np.diagonal(self.cov, axis1=1, axis2=2)[:, : self.size], 0.0))
        reach = REACH * sd + TINY * (1.0 + np.abs(middle))
        ways = reach[:, None, :] * np.eye(self.size)
        return np.concatenate([middle[:, None], middle[:, None] + ways, middle[:, None] - ways], axis=1), reach

    def _split(self, states: Array) -> tuple[Array, Array, Array]:
        """Return machine states, term states and forces at each place, each (rows, any), of states (rows, size)."""
        n, m = len(self.system.model.states), self.running.states
        return states[:, :n], states[:, n:m], self.system.spread_forces(states[:, m : self.size])

    def _find_inputs(self, k: int, j: int, repeat: int) -> list[Array]:
        """Return the inputs at the beginning of a step, on average and at its end, each (points * repeat, inputs)."""
        rows, crossed = len(self.points) * repeat, [ends[k] for ends in self.crossed[j]]
        if len(self.points.drives) == 1:
            return [np.broadcast_to(u[0], (rows, u.shape[1])) for u in crossed]
        which = np.repeat(self.points.which, repeat)
        return [u[which] for u in crossed]

    def _time(self, k: float) -> float:
        return float(self.points.drives[0].begin + k * self.observation.dt)

    def _cross(self, k: int) -> Array:
        """Propagate over one sample; return the transition matrices (points, size, size)."""
        across = self._step(k, 0)
        for j in range(1, self.running.nsub):
            across = self._step(k, j) @ across
        if self.running.random == "held":
            across[:, self._forces] = 0.0
        noise, own = self.points.noise, slice(self.size, None)
        if self.state.shape[1] == self.size:
            return across
        self.state[:, own] = np.einsum("pab,pb->pa", noise.transition, self.state[:, own])
        self.cov[:, own] = noise.transition @ self.cov[:, own]
        self.cov[:, :, own] = self.cov[:, :, own] @ noise.transition.transpose(0, 2, 1)
        self.cov[:, own, own] += noise.driving
        return across

    def _step(self, k: int, j: int) -> Array:
        """Propagate over one step of a sample; return the slopes (points, size, size) of the new states."""
        nsub, size = self.running.nsub, self.size
        states, reach = self._spread()
        flat = states.reshape(-1, size)
        inputs, h = self._find_inputs(k, j, 2 * size + 1), self.observation.dt / nsub
        moved = self.wide.advance(self._time(k + j / nsub), self._split(flat), inputs, h)
        ends = np.concatenate([*moved, self._decay(flat[:, self._forces], 2 * size + 1)], axis=1).reshape(states.shape)
        middle, up, down = ends[:, 0], ends[:, 1 : size + 1], ends[:, size + 1 :]
        slopes = ((up - down) / (2.0 * reach[:, :, None])).transpose(0, 2, 1)
        variances = np.diagonal(self.cov, axis1=1, axis2=2)[:, :size]
        bend = np.einsum("pia,pi->pa", up + down - 2.0 * middle[:, None], variances / (2.0 * reach**2))
        self.state[:, :size] = middle + bend
        self.cov[:, :size] = slopes @ self.cov[:, :size]
        self.cov[:, :, :size] = self.cov[:, :, :size] @ slopes.transpose(0, 2, 1)
        if self.running.random == "latent":
            left = 1.0 - np.exp(-2.0 * self.points.pace * self.observation.dt / nsub)
            self.cov[:, size - 1, size - 1] += 0.5 * self.points.process * self.points.pace * left
        return np.asarray(slopes)

    def _decay(self, forces: Array, repeat: int) -> Array:
        """Return random forces (rows, forces) after a step: held ones stay, one with a memory decays."""
        if self.running.random != "latent":
            return forces
        pace = np.repeat(self.points.pace, repeat)[:, None]
        return np.asarray(forces * np.exp(-pace * self.observation.dt / self.running.nsub))

    def _observe(self, k: int, s: int, states: Array, rows: MachineRows, repeat: int) -> Array:
        """Return the channel of a sensor (rows,) at sample `k`, or before it where the sensor is late."""
        channel, _ = self.system.shown(self.observation.sensors[s], self.running.active)
        (x, own, free), u, times = self._split(states), self._find_inputs(k, 0, repeat), self._time(k)
        lag = np.repeat(self.points.lag[:, s], repeat)[:, None]
        if lag.any():
            h = self.observation.dt / self.running.nsub
            later, further = rows.advance(times, (x, own, free), (u[0], u[0], u[0]), h)
            x, own = x - lag / h * (later - x), own - lag / h * (further - own)
        force, _ = rows.push(times, x, own, u[0], free)
        return rows.observe(x, u[0], force + free)[:, channel]

    def _predict(self, k: int, s: int, sensor: Sensor) -> tuple[Array, Array, Array]:
        """Return the expected values of a channel (points,), slopes (points, size), and the variance of bends."""
        direct = self.system.shown(sensor, self.running.active)[1]
        if direct >= 0 and not self.points.lag[:, s].any():
            slopes = np.zeros((len(self.points), self.size))
            slopes[:, direct] = 1.0
            return self.state[:, direct].copy(), slopes, np.zeros(len(self.points))
        states, reach = self._spread()
        seen = self._observe(k, s, states.reshape(-1, self.size), self.wide, 2 * self.size + 1)
        ends = seen.reshape(states.shape[:2])
        middle, up, down = ends[:, 0], ends[:, 1 : self.size + 1], ends[:, self.size + 1 :]
        weights = np.diagonal(self.cov, axis1=1, axis2=2)[:, : self.size] / (2.0 * reach**2)
        bends = (up + down - 2.0 * middle[:, None]) * weights
        return middle + bends.sum(axis=1), (up - down) / (2.0 * reach), 2.0 * np.sum(bends**2, axis=1)

    def _compute_rates(self, k: int) -> Array:
        """Return the derivatives (points, size) of the states at sample `k`, as differences over a step."""
        states, h = self.state[:, : self.size], self.observation.dt / self.running.nsub
        x, own, free = self._split(states)
        u = self._find_inputs(k, 0, 1)[0]
        later, further = self.single.advance(self._time(k), (x, own, free), (u, u, u), h)
        return np.concatenate([(later - x) / h, (further - own) / h, 0.0 * states[:, self._forces]], axis=1)

    def _update(self, k: int, s: int, sensor: Sensor) -> None:
        """Correct all states by the readings of one sensor."""
        read = np.isfinite(self.readings[:, k, s]) & self.alive
        if not read.any():
            return
        noise, gain = self.points.noise, self.points.gain[:, s]
        first = self.size + sum(one.noise_states for one in self.observation.sensors[:s])
        expected, slopes, loose = self._predict(k, s, sensor)
        if noise.clock[:, s].any():
            loose = loose + noise.clock[:, s] * np.sum(slopes * self._compute_rates(k), axis=1) ** 2
        look = np.zeros_like(self.state)
        look[:, : self.size] = gain[:, None] * slopes
        own = slice(first, first + sensor.noise_states)
        look[:, own] = noise.shown[:, first - self.size : first - self.size + sensor.noise_states]
        pull = (self.cov @ look[:, :, None])[:, :, 0]
        variance = np.sum(look * pull, axis=1) + noise.white[:, s] + gain**2 * loose
        shown = gain * expected + self.points.offset[:, s]
        if sensor.noise_states:
            shown = shown + np.sum((look * self.state)[:, own], axis=1)
        error = np.where(read, self.readings[:, k, s] - shown, 0.0)
        share = np.where(read, 1.0 / variance, 0.0)
        self.state += pull * (share * error)[:, None]
        self.cov -= pull[:, :, None] * pull[:, None, :] * share[:, None, None]
        diagonal = np.einsum("pii->pi", self.cov)  # a view: the rest is not copied
        np.maximum(diagonal, 0.0, out=diagonal)
        self.errors[read, k, s], self.variances[read, k, s] = error[read], variance[read]
