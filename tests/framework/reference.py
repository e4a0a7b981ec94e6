"""One point after the other in plain NumPy: the slow twin, against which lanes are tested."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.kernels.crossing import BEND_LIMIT, PACED_LIMIT, PACED_SHARE, STEP_LIMIT, TINY
from lostmotion.kernels.filter import INNER_POINT, INNER_WEIGHT, OUTER_POINT, OUTER_WEIGHT, UNREAD_VARIANCE
from lostmotion.kernels.smooth import SURE
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.innovations import Innovations, Smoothed
from lostmotion.likelihood.lanes import count_fine_steps, find_input_variance
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points
from lostmotion.likelihood.running import Kept, RunningSystem
from lostmotion.likelihood.system import System

GAUSS = (0.5 - math.sqrt(1.0 / 12.0), 0.5 + math.sqrt(1.0 / 12.0))


@dataclass(frozen=True)
class Reference(RunningSystem):
    """The same filter as `lanes`, written with matrices and the Python functions of model and terms."""

    def filter_and_keep(self, observation: Observation, points: Points, kept: Kept | None) -> Innovations:
        """Return one-step errors and variances; write what a smoother needs of the first point into `kept`."""
        runs = [_Run.of(self, observation, points.select(slice(i, i + 1))) for i in range(len(points))]
        reached = np.array([run.filter() for run in runs], dtype=np.int64)
        if kept is not None:
            runs[0].keep(kept)
        return Innovations.of(np.array([r.errors for r in runs]), np.array([r.variances for r in runs]), reached)

    def smooth(self, observation: Observation, points: Points) -> Smoothed:
        """Return filtered and smoothed states of one point, and their covariances (Rauch, Tung, Striebel 1965)."""
        kept = self.make_kept(observation.samples)
        innovations = self.filter_and_keep(observation, points, kept)
        filtered, covariance, ahead, before, across = kept
        states, covs = filtered.copy(), covariance.copy()
        sure = np.diag((SURE * np.max(np.abs(filtered), axis=0)) ** 2 + 1e-300)
        for k in range(observation.samples - 2, -1, -1):
            gain = np.linalg.solve(before[k + 1] + sure, across[k] @ covariance[k]).T
            covs[k] += gain @ (covs[k + 1] - before[k + 1]) @ gain.T
            states[k] += gain @ (states[k + 1] - ahead[k + 1])
        return Smoothed(filtered, covariance, states, covs, innovations)

    def simulate(self, points: Points, start: Array, steps: int, kicks: Array | None = None) -> Array:
        """Return the states (points, steps, n) of free runs by RK4, NaN after a divergence."""
        states = np.full((len(points), steps, self.states), np.nan)
        for i in range(len(points)):
            machine = _Machine.of(self, points.select(slice(i, i + 1)), self.nsub)
            y, h = start[i].astype(float), machine.drive.dt / self.nsub
            for k in range(steps):
                if kicks is not None and k:
                    y = y + kicks[i, k]
                states[i, k] = y
                if k == steps - 1 or not np.isfinite(y).all():
                    break
                for j in range(self.nsub):
                    y = machine.take_step(y, (int(points.first[i]) + k, j / self.nsub, 1.0 / self.nsub), h)
        states[~np.isfinite(states).all(axis=2)] = np.nan
        return states


@dataclass(frozen=True)
class _Machine:
    """A system at one point as functions of the state; forces that are states come last."""

    system: System
    running: RunningSystem
    packed: Array
    drive: Drive
    pace: float

    @classmethod
    def of(cls, running: RunningSystem, points: Points, nsub: int) -> _Machine:
        """Return the machine of a single point, with the parameters of its laws for this number of steps."""
        drive = points.drives[points.which[0]].pad_inputs(len(running.system.model.inputs))
        packed = running.system.pack(points.params, drive.dt / nsub, drive.harmonic)[0]
        return cls(running.system, running, packed, drive, float(points.pace[0]))

    def input(self, k: int, share: float) -> Array:
        """Return the inputs at a share of the way through sample `k`."""
        return np.asarray(share ** np.arange(4) @ self.drive.cubics[k], dtype=float)

    def set_step(self, step: float) -> None:
        """Set the length of the step in the parameters of the laws."""
        plan = self.system.blueprint
        rows = plan.rows
        for law, start in zip(plan.laws, plan.starts, strict=True):
            self.packed[[start - rows.params + i for i in law.steps]] = step
        self.packed[rows.step - rows.params] = step

    @cached_property
    def paced(self) -> NDArray[np.bool_]:
        """The states of laws that limit their own rate by the step."""
        paced = np.zeros(self.running.states + self.running.forces, dtype=np.bool_)
        for law, begin in zip(self.system.blueprint.laws, self.system.wiring(self.running.active)[1], strict=True):
            if begin and law.steps:
                paced[begin : begin + law.states] = True
        return paced

    def compute_slope(self, y: Array, u: Array, t: float) -> Array:
        """Return the derivatives of all states."""
        system, plan = self.system, self.system.blueprint
        dydt = np.zeros(len(y))
        system.equations.rhs(t, y, u, self.packed, dydt)
        on, at = system.wiring(self.running.active)
        onsets = self.packed[plan.rows.onset - plan.rows.params :]
        step, sensing = self.packed[plan.rows.step - plan.rows.params], []
        for i, (law, (_, term)) in enumerate(zip(plan.laws, system.forces, strict=True)):
            first = plan.starts[i] - plan.rows.params
            numbers = self.packed[first : first + law.width].copy()
            if on[i]:
                place = plan.places[law.place]
                numbers[list(law.felt)] = dydt[place.row]
                own = tuple(numbers.tolist())
                if law.channel is not None:
                    sensing.append((law, term, own, slice(at[i], at[i] + law.states)))
                    continue
                lever = () if place.lever is None else (self.packed[place.lever],)
                x, v = place.motion(y, u, *lever)
                states = slice(at[i], at[i] + law.states)
                push = term.force(t, x, v, u, own, tuple(y[states]))
                push *= min(max(0.5 + 0.5 * (t - onsets[i]) / step, 0.0), 1.0)
                dydt[place.row] += push / self.packed[place.inertia]
                if place.against:
                    dydt[place.against[0]] -= push * math.prod(lever) / self.packed[place.against[1]]
                if law.states:
                    term.rate(t, x, v, u, own, tuple(y[states]), dydt[states])
        for i, body in enumerate(plan.bodies[: self.running.forces]):
            force = self.running.states + i
            dydt[body.row] += y[force] / self.packed[body.inertia]
            dydt[force] = -self.pace * y[force]
        for law, term, own, states in sensing:
            shown = np.zeros(len(system.model.channels))
            system.equations.observe(t, y, dydt, u, self.packed, shown)
            term.rate(t, float(shown[law.channel]), 0.0, u, own, tuple(y[states]), dydt[states])
        return dydt

    def observe(self, y: Array, u: Array, t: float, channel: int) -> float:
        """Return the value of a channel."""
        shown = np.zeros(len(self.system.model.channels))
        self.system.equations.observe(t, y, self.compute_slope(y, u, t), u, self.packed, shown)
        return float(shown[channel])

    def observe_late(self, y: Array, k: int, lag: float, channel: int) -> float:
        """Return the value of a channel a time `lag` (s) before sample `k`, where the states are `y`."""
        dt, begin = self.drive.dt, self.drive.begin + k * self.drive.dt
        if lag:
            half = y - 0.5 * lag * self.compute_slope(y, self.input(k, 0.0), begin)
            y = y - lag * self.compute_slope(half, self.input(k, -0.5 * lag / dt), begin - 0.5 * lag)
        return self.observe(y, self.input(k, -lag / dt), begin - lag, channel)

    def take_step(self, y: Array, where: tuple[int, float, float], h: float) -> Array:
        """Return the state after a step of RK4; `where` is the sample, the start of the step in it, and its length."""
        k, share, width = where
        begin = self.drive.begin + (k + share) * self.drive.dt
        early, middle, late = (self.input(k, share + part * width) for part in (0.0, 0.5, 1.0))
        k1 = self.compute_slope(y, early, begin)
        k2 = self.compute_slope(y + 0.5 * h * k1, middle, begin + 0.5 * h)
        k3 = self.compute_slope(y + 0.5 * h * k2, middle, begin + 0.5 * h)
        k4 = self.compute_slope(y + h * k3, late, begin + h)
        return np.asarray(y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4))


@dataclass
class _Run:
    """The filter over one recording at one point: state and covariance, noise states of sensors, and the results."""

    machine: _Machine
    observation: Observation
    points: Points
    nsub: int
    y: Array
    cov: Array
    noise: Array
    shared: Array
    errors: Array
    variances: Array
    wish: int = 0
    near: Array | float = 0.0
    seen: list[tuple[Array, Array]] = field(default_factory=list)
    ahead: list[tuple[Array, Array]] = field(default_factory=list)
    steps: list[Array] = field(default_factory=list)

    @classmethod
    def of(cls, running: RunningSystem, observation: Observation, points: Points) -> _Run:
        """Return the filter at the first sample; noise states have the mean `noise` and the covariances `shared`."""
        if points.readings is not None:
            observation = replace(observation, readings=points.readings[0])
        nsub = count_fine_steps(running.nsub)
        machine = _Machine.of(running, points, nsub)
        y, cov = (start[0] for start in running.compute_start(points))
        first = points.noise.first[0]
        shared = np.concatenate([np.zeros((len(first), len(y))), first], axis=1)
        shape = (observation.samples, len(observation.sensors))
        errors, variances = np.zeros(shape), np.full(shape, UNREAD_VARIANCE)
        return cls(machine, observation, points, nsub, y, cov, np.zeros(len(first)), shared, errors, variances, nsub)

    def filter(self) -> int:
        """Filter all samples; return the number of those that were computed."""
        for k in range(self.observation.samples):
            self._redraw_forces()
            self.ahead.append((self.y.copy(), self.cov.copy()))
            for sensor in range(len(self.observation.sensors)):
                if np.isfinite(self.observation.readings[k, sensor]):
                    self._update(k, sensor)
            told = self.variances[k] > 0.0
            if not (np.isfinite(self.y[0]) and np.isfinite(self.cov[1, 1]) and told.all()):
                return k
            self.seen.append((self.y.copy(), self.cov.copy()))
            if k < self.observation.samples - 1:
                self._add_input_variance(k)
                self._cross_sample(k)
        return self.observation.samples

    def keep(self, kept: Kept) -> None:
        """Write what a smoother needs into arrays, as far as the filter came."""
        for array, values in zip(
            kept, (*zip(*self.seen, strict=True), *zip(*self.ahead, strict=True), self.steps), strict=True
        ):
            array[: len(values)] = values

    def _redraw_forces(self) -> None:
        """Reset the forces that are held over a sample to their prior."""
        running, dt = self.machine.running, self.observation.dt
        if running.random == "held":
            for force in range(running.states, len(self.y)):
                self.y[force], self.cov[force], self.cov[:, force] = 0.0, 0.0, 0.0
                self.cov[force, force] = self.points.process[0] / dt

    def _add_input_variance(self, k: int) -> None:
        """Add the uncertainty of the measured input to the variance of the first held force."""
        running = self.machine.running
        if running.random == "held":
            self.cov[running.states, running.states] += find_input_variance(running, self.observation)[k]

    def _predict_reading(self, k: int, sensor: int) -> tuple[float, Array, float]:
        """Return the expected value of a sensor's channel, its slopes over the states, and the variance of bends."""
        shown = self.observation.sensors[sensor]
        channel, direct = self.machine.system.shown(shown, self.machine.running.active)
        lag = float(self.points.lag[0, sensor])
        if direct >= 0 and not lag:
            return float(self.y[direct]), np.eye(len(self.y))[direct], 0.0
        self.machine.set_step(self._fine_step)
        centre = self.machine.observe_late(self.y, k, lag, channel)
        sd = np.sqrt(np.diag(self.cov))
        slopes, mean, square = np.zeros(len(sd)), np.zeros(len(sd)), np.zeros(len(sd))
        for far, weight in ((INNER_POINT, INNER_WEIGHT), (OUTER_POINT, OUTER_WEIGHT)):
            reach = far * sd + TINY * (1.0 + np.abs(self.y))
            up, down = (
                np.array([self.machine.observe_late(self.y + s * row, k, lag, channel) for row in np.diag(reach)])
                - centre
                for s in (1.0, -1.0)
            )
            slopes += weight * far**2 * (up - down) / reach
            mean += weight * (up + down)
            square += weight * (up**2 + down**2)
        left = np.maximum(square - mean**2 - (slopes * sd) ** 2, 0.0)
        return centre + float(mean.sum()), slopes, float(left.sum())

    def _update(self, k: int, sensor: int) -> None:
        """Update all states by one reading, with the observation vector `look`."""
        p, n = self.points, len(self.y)
        before = sum(s.noise_states for s in self.observation.sensors[:sensor])
        own = slice(before, before + self.observation.sensors[sensor].noise_states)
        expected, slopes, loose = self._predict_reading(k, sensor)
        look = np.concatenate([p.gain[0, sensor] * slopes, np.zeros(len(self.noise))])
        look[n:][own] = p.noise.shown[0, own]
        if p.noise.clock[0, sensor]:
            u, t = self.machine.input(k, 0.0), self.machine.drive.begin + k * self.machine.drive.dt
            loose += p.noise.clock[0, sensor] * float(slopes @ self.machine.compute_slope(self.y, u, t)) ** 2
        whole = np.block([[self.cov, self.shared[:, :n].T], [self.shared]])
        gain = whole @ look
        variance = float(look @ gain) + p.noise.white[0, sensor] + p.gain[0, sensor] ** 2 * loose
        shown = p.gain[0, sensor] * expected + p.offset[0, sensor] + float(look[n:] @ self.noise)
        error = float(self.observation.readings[k, sensor]) - shown
        whole -= np.outer(gain, gain) / variance
        self.y = self.y + gain[:n] / variance * error
        self.noise = self.noise + gain[n:] / variance * error
        self.cov, self.shared = whole[:n, :n], whole[n:]
        self.cov[np.diag_indices(n)] = np.maximum(np.diag(self.cov), 0.0)
        self.errors[k, sensor], self.variances[k, sensor] = error, variance

    def _cross_sample(self, k: int) -> None:
        """Propagate over one sample, in steps as long as the force is close to linear."""
        place, across = 0, np.eye(len(self.y))
        while place < self.nsub:
            wide = min(place & -place if place else self.nsub, self.wish)
            reach = np.sqrt(3.0 * np.diag(self.cov))
            while wide > 1 and np.any(wide * self._fine_step * self.near > self._compute_tolerance(reach)):
                wide //= 2
            while not self._try_step(k, place, wide, reach):
                wide //= 2
            across = self._step @ across
            place += wide
        if self.machine.running.random == "held":
            across[self.machine.running.states :] = 0.0
        self.steps.append(across)
        transition = self.points.noise.transition[0]
        self.noise, self.shared = transition @ self.noise, transition @ self.shared
        self.shared[:, len(self.y) :] = self.shared[:, len(self.y) :] @ transition.T + self.points.noise.driving[0]

    @property
    def _fine_step(self) -> float:
        return self.observation.dt / self.nsub

    def _compute_tolerance(self, reach: Array) -> Array:
        """Return the error that each state may have."""
        return np.asarray(BEND_LIMIT * (reach + PACED_SHARE * np.where(self.machine.paced, np.abs(self.y), 0.0)))

    def _try_step(self, k: int, place: int, wide: int, reach: Array) -> bool:
        """Try a step; take it and return true where the force is close to linear along it, or where it is fine."""
        machine, y = self.machine, self.y
        share, width = place / self.nsub, wide / self.nsub
        h = width * self.observation.dt
        begin = machine.drive.begin + (k + share) * machine.drive.dt
        early, middle, late = (machine.input(k, share + part * width) for part in (0.0, 0.5, 1.0))
        machine.set_step(h)
        k1 = machine.compute_slope(y, early, begin)
        centre = y + 0.5 * h * k1
        k2 = machine.compute_slope(centre, middle, begin + 0.5 * h)
        end = y + 0.5 * h * k2
        k3 = machine.compute_slope(end, middle, begin + 0.5 * h)
        end = y + h * k3
        k4 = machine.compute_slope(end, late, begin + h)
        d = reach + TINY * (1.0 + np.abs(centre))
        up, down = (
            np.array([machine.compute_slope(centre + s * r, middle, begin + 0.5 * h) for r in np.diag(d)]).T
            for s in (1, -1)
        )
        slopes = (up - down) / (2.0 * d)
        bend = ((up + down - 2.0 * k2[:, None]) * np.diag(self.cov) / (2.0 * d**2)).sum(axis=1)
        square, far = slopes @ slopes, np.zeros(len(y))
        if wide > 1:
            sides = [machine.compute_slope(end + s * reach, late, begin + h) for s in (1.0, -1.0)]
            far = np.abs(0.5 * (sides[0] + sides[1]) - k4)
            both = machine.compute_slope(centre, early + late - middle, begin + h)
            kink = k1 + k4 - k2 - both - slopes @ (y + end - 2.0 * centre)
            bent = np.abs(kink) + self.near + far + 3.0 * np.abs(bend)
            limits = np.where(machine.paced, PACED_LIMIT, STEP_LIMIT)
            if np.any(h * bent > self._compute_tolerance(reach)) or np.any(h * h * np.abs(np.diag(square)) > limits):
                return False
        self.near, self.wish = far, 2 * wide
        if np.any(4.0 * h * h * np.abs(np.diag(square))[~machine.paced] > STEP_LIMIT):
            self.wish = wide
        third, fourth = square @ slopes, square @ square
        self._step = np.eye(len(y)) + h * (slopes + h / 2.0 * (square + h / 3.0 * (third + h / 4.0 * fourth)))
        mean = (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
        self.y = y + h * (mean + h * h / 30.0 * square @ (k3 - k2) + bend)
        self.cov = self._step @ self.cov @ self._step.T + self._compute_noise(h, slopes, square)
        self.shared[:, : len(y)] = self.shared[:, : len(y)] @ self._step.T
        return True

    def _compute_noise(self, h: float, slopes: Array, square: Array) -> Array:
        """Return the covariance that the random force adds over a step, by two Gauss points."""
        added = np.zeros_like(self.cov)
        for row, intensity in self._list_sources():
            for part in GAUSS:
                way = part * h * (slopes[:, row] + 0.5 * part * h * square[:, row])
                way[row] += 1.0
                added += 0.5 * h * intensity * np.outer(way, way)
        return added

    def _list_sources(self) -> Sequence[tuple[int, float]]:
        """Return the states that process noise enters, with its intensities."""
        running, process = self.machine.running, float(self.points.process[0])
        if running.random == "held":
            return ()
        if running.random == "latent":
            return ((running.states, process * self.machine.pace**2),)
        bodies = running.system.blueprint.bodies
        return [(body.row, process / self.points.params[0, body.inertia] ** 2) for body in bodies]
