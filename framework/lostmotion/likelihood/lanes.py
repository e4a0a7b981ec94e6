"""Machines written as equations: many points in lock-step, in the vector registers of one core."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.kernels.inputs import DRAWN, DRIVES, SOURCES
from lostmotion.kernels.vector import STRIDE
from lostmotion.likelihood.innovations import Innovations, join_innovations
from lostmotion.likelihood.kernel_calls import (
    count_lanes,
    make_block,
    make_model_block,
    make_model_wires,
    require_no_failure,
    run_freely,
    spread_points,
)
from lostmotion.likelihood.kernels import build_filter
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points
from lostmotion.likelihood.running import Kept, RunningSystem
from lostmotion.likelihood.work import add_work

_NONE = (np.zeros((1, 1)), np.zeros((1, 1, 1)), np.zeros((1, 1)), np.zeros((1, 1, 1)), np.zeros((1, 1, 1)))


@dataclass(frozen=True)
class Lanes(RunningSystem):
    """Filters up to 32 points at once in vector lanes; `compiled=False` runs the same source as plain Python.

    Norgaard, Poulsen, Ravn, Automatica 36 (2000) 1627-1638, with steps halved where a force bends.
    """

    compiled: bool = True

    def filter_and_keep(self, observation: Observation, points: Points, kept: Kept | None) -> Innovations:
        """Return one-step errors and their variances; write what a smoother needs of the first point into `kept`.

        Points whose first is kept take the steps of that one, for differences between them.
        """
        if kept is None:
            return self._filter(observation, points, _NONE)
        most, parts = STRIDE - 1, []
        for begin in range(1, max(len(points), 2), most):
            rows = np.r_[0, begin : min(begin + most, len(points))]
            found = self._filter(observation, points.select(rows), kept if begin == 1 else _NONE, led=True)
            parts.append(found if begin == 1 else found[1:])
        return parts[0] if len(parts) == 1 else join_innovations(parts)

    def _filter(self, observation: Observation, points: Points, kept: Kept, *, led: bool = False) -> Innovations:
        shape = (len(points), observation.samples, len(observation.sensors))
        errors, variances, reached = np.zeros(shape), np.ones(shape), np.zeros(len(points), dtype=np.int64)
        for number, rows in enumerate(_group_points(points)):
            written = (errors[rows], variances[rows], reached[rows])
            wanted = kept if number == 0 else _NONE
            self._run_filter(observation, points.select(rows), written, wanted, led=led)
            if not isinstance(rows, slice):
                errors[rows], variances[rows], reached[rows] = written
        return Innovations.of(errors, variances, reached)

    def simulate(self, points: Points, start: Array, steps: int, kicks: Array | None = None) -> Array:
        """Return the states (points, steps, n) of free runs from `start` (points, n), NaN after a divergence."""
        states = np.empty((len(points), steps, self.states))
        for number, drive in enumerate(points.drives):
            rows = np.flatnonzero(points.which == number)
            if len(rows):
                packed = self.pack(points.params[rows], drive)
                found = run_freely(
                    self.system, self.active, packed, start[rows], drive, self.nsub, points.first[rows],
                    steps, kicks=None if kicks is None else kicks[rows], compiled=self.compiled,
                )  # fmt: skip
                states[rows] = found[0]
        return states

    def _run_filter(
        self,
        observation: Observation,
        points: Points,
        written: tuple[Array, Array, NDArray[np.int64]],
        kept: Kept,
        *,
        led: bool,
    ) -> None:
        """Run the filter at up to `STRIDE` points, and write into the given arrays."""
        system, n = self.system, self.states + self.forces
        drives = [drive.pad_inputs(len(system.model.inputs)) for drive in points.drives]
        harmonic, dt, nsub = drives[0].harmonic, observation.dt, count_fine_steps(self.nsub)
        numbers = _list_sensor_numbers(observation, self, points)
        forces = tuple(self.states + i for i in range(self.forces))
        packed = system.pack(points.params, dt / nsub, harmonic)
        packed[:, system.blueprint.rows.pace - system.blueprint.rows.params] = points.pace
        wires = make_model_wires(system, self.active, forces, compiled=self.compiled)
        noise, wires[SOURCES], wires[DRAWN] = _list_noise(self, points, dt)
        used = np.unique(points.which)
        inputs = drives[used[0]].cubics if len(used) == 1 else np.concatenate([drives[i].cubics for i in used])
        wires[DRIVES] = len(used)
        each = np.searchsorted(used, points.which) * observation.samples
        which = each[np.minimum(np.arange(STRIDE), len(points) - 1)].astype(np.int64)
        sensing = points.noise
        levels = np.stack([sensing.white, sensing.clock, points.gain, points.offset, points.lag], axis=2)
        kinds = np.concatenate([sensing.shown[..., None], sensing.transition, sensing.driving, sensing.first], axis=2)
        mean, covariance = self.compute_start(points)
        kernels = build_filter(n, self.compiled)
        many = sensing.shown.shape[1]
        blocks = (
            make_model_block(system, packed),
            make_block(kernels["NOISE"] + (2 + 2 * n) * wires[SOURCES]),
            make_block(many * (2 + n + many) + 1),
            spread_points(np.full((1, 1), drives[0].begin)),
            spread_points(levels.reshape(len(points), -1)),
            spread_points(noise),
            spread_points(np.concatenate([mean, covariance.reshape(len(points), -1)], axis=1)),
            spread_points(kinds.reshape(len(points), -1)),
        )
        made = system.functions(self.compiled)
        lanes = count_lanes(len(points))
        readings = observation.readings[None] if points.readings is None else points.readings
        padded = _pad_arrays(written, lanes)
        failed = kernels["run_filter"](
            (made.derive, made.observe), blocks, wires, inputs, which, np.ascontiguousarray(readings),
            numbers, find_input_variance(self, observation), dt, nsub, padded, kept, led, lanes,
        )  # fmt: skip
        add_work(int(blocks[1][kernels["TAKEN"], 0]) * n)
        require_no_failure(failed, system, blocks[0], wires)
        for mine, theirs in zip(written, padded, strict=True):
            if mine is not theirs:
                mine[:] = theirs[: len(mine)]


def find_input_variance(running: RunningSystem, observation: Observation) -> Array:
    """Return the variance (samples,) that interpolation of the measured force between samples adds to a held force."""
    forced = running.random == "held" and running.system.model.inputs[observation.lead] == "force"
    return observation.input_variance if forced else np.zeros(observation.samples)


def _pad_arrays(written: tuple[Any, ...], lanes: int) -> tuple[Any, ...]:
    """Return arrays with a row for each lane: the given ones where they have as many."""
    if len(written[0]) == lanes:
        return written
    return tuple(np.zeros((lanes, *array.shape[1:]), dtype=array.dtype) for array in written)


def count_fine_steps(steps: int) -> int:
    """Return the number of fine steps of a sample: the smallest power of two that is at least `steps`."""
    return int(1 << (max(steps, 1) - 1).bit_length())


def _group_points(points: Points) -> Iterator[slice | NDArray[np.intp]]:
    """Yield the points that are computed together: up to `STRIDE` with the same late sensors."""
    late = points.lag != 0.0
    if not late.any():
        yield from (slice(begin, begin + STRIDE) for begin in range(0, len(points), STRIDE))
        return
    for pattern in np.unique(late, axis=0):
        rows = np.flatnonzero(np.all(late == pattern, axis=1))
        yield from (rows[begin : begin + STRIDE] for begin in range(0, len(rows), STRIDE))


def _list_sensor_numbers(observation: Observation, running: RunningSystem, points: Points) -> NDArray[np.int64]:
    """Return for each sensor its channel, directly shown state, the first of its noise states and that behind the last.

    Then whether the sensor is late, and whether its stamps jitter: the shape is (sensors, 6).
    """
    rows, end = [], 0
    for number, sensor in enumerate(observation.sensors):
        begin, end = end, end + sensor.noise_states
        late, jitters = bool(points.lag[0, number]), bool(np.any(points.noise.clock[:, number]))
        rows.append((*running.system.shown(sensor, running.active), begin, end, late, jitters))
    return np.array(rows, dtype=np.int64)


def _list_noise(running: RunningSystem, points: Points, dt: float) -> tuple[Array, int, int]:
    """Return the states that the random force enters with its intensities, (points, rows), and how many of each."""
    plan, n = running.system.blueprint, running.states
    if running.random == "latent":
        return np.column_stack([np.full(len(points), float(n)), points.process * points.pace**2]), 1, 0
    if running.random == "held":
        rows = [(np.full(len(points), float(n + i)), points.process / dt) for i in range(len(plan.bodies))]
        return np.column_stack([column for row in rows for column in row]), 0, len(rows)
    rows = [
        (np.full(len(points), float(b.row)), points.process / points.params[:, b.inertia] ** 2) for b in plan.bodies
    ]
    return np.column_stack([column for row in rows for column in row]), len(rows), 0
