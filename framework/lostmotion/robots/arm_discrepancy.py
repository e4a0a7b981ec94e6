"""What every hypothesis contains besides its effects, because no model of a real arm is exact.

All of it is a force on the chain, linear in its coefficients:

- smooth forces at each joint over its position, its velocity and time: Gaussian processes of reduced rank (Solin,
  Sarkka, Statistics and Computing 30 (2020) 419-446), each of one of `SIZES` and `LENGTHS`, or absent;
- values of the model that are known within its tolerance: damping, dry friction, armature, springs, and of each body
  its mass, its first moments and its moments of inertia in all directions;
- the torque of each joint: its scale, its zero and its delay; and the zero of each encoder.

Smooth forces over position and velocity have no linear part: an unknown stiffness or damping has a name.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from lostmotion.evidence.expansion import compute_log_evidence
from lostmotion.parts import Array
from lostmotion.robots.arm import Column, TapedArm
from lostmotion.robots.arm_effects import JointScales
from lostmotion.robots.tape import Part

SIZES, LENGTHS = (0.003, 0.01, 0.03), (0.3, 0.6, 1.2)
"""Standard deviations of a smooth force in units of the drive, and its correlation lengths in half widths."""
LARGE = (*SIZES, 0.1, 0.3, 1.0)
"""The sizes of an unknown force."""
WAVES = 10
"""The number of waves of a smooth force."""
SCALE, ZERO, LATE, ANGLE = 0.01, 0.005, 0.25, 1e-3
"""Errors of a torque: its scale, its zero (in units of the drive), its delay (samples); zero of an encoder (rad)."""
NOTHING = 1e-5
"""A force that is a smaller share of the drive at each joint is left out."""
SWEEPS = 2


@dataclass(frozen=True, eq=False)
class SmoothTorque:
    """A smooth force: its joint, what it depends on, its columns, and the prior widths (options, waves)."""

    joint: int
    over: str
    columns: slice
    options: Array

    @property
    def key(self) -> str:
        """Its name."""
        return f"{self.over}@{self.joint}"


Choice = tuple[int, ...]
"""The option of each smooth force, -1 where it is absent; then that of `LOOSER`."""
LOOSER = (1.0, 3.0)
"""Values of the model are known within its tolerance, or all of them less well by this factor."""
WORSE = math.log(20.0)
"""The log prior odds against values that are known less well than the tolerance says."""


@dataclass(frozen=True, eq=False)
class Discrepancy:
    """The columns of forces, and the prior standard deviation of each coefficient.

    `fixed` (columns,) are the widths of those that are no smooth force, zero elsewhere; `known` (columns,) marks the
    values of the model among them. `shape` is that of a force, (samples, n). `inertias` are the parts of the columns,
    by their numbers, whose torque depends on the accelerations.
    """

    columns: tuple[Column, ...]
    fixed: Array
    known: NDArray[np.bool_]
    forces: tuple[SmoothTorque, ...]
    shape: tuple[int, int]
    inertias: Mapping[int, Part] = field(default_factory=dict)

    @property
    def none(self) -> Choice:
        """The choice without any smooth force."""
        return (*(-1,) * len(self.forces), 0)

    def widths(self, choice: Choice) -> Array:
        """Return the prior standard deviation of each coefficient."""
        found = np.where(self.known, LOOSER[choice[-1]] * self.fixed, self.fixed)
        for force, option in zip(self.forces, choice[:-1], strict=True):
            if option >= 0:
                found[force.columns] = force.options[option]
        return found

    def price(self, choice: Choice) -> float:
        """Return the log penalty of a choice: each force that is present has one of its options, and `WORSE`."""
        options = [len(f.options) for f, option in zip(self.forces, choice[:-1], strict=True) if option >= 0]
        return sum(map(math.log, options)) + (WORSE if choice[-1] else 0.0)

    def force(self, coefficients: Array) -> Array:
        """Return the forces of coefficients (samples, 2n): those of the drives, then those on the links."""
        samples, n = self.shape
        found = np.zeros((samples, 2 * n))
        for c in np.flatnonzero(coefficients):
            column = self.columns[c]
            part = found[:, n:] if column.joint < 0 else found[:, column.joint]
            part += coefficients[c] * column.force
        return found

    def follow(self, accelerations: Array) -> Discrepancy:
        """Return the discrepancy with the torques of inertias under other accelerations.

        These are (samples, 2n), of links and of what the drives turn: the motor, where a joint has a gear.
        """
        columns, n = list(self.columns), self.shape[1]
        for i, part in self.inertias.items():
            columns[i] = _make_inertia(
                columns[i].name, columns[i].joint, part, accelerations[:, :n], accelerations[:, n:]
            )
        return replace(self, columns=tuple(columns))

    def _condition(self, gradient: Array, information: Array, looser: int) -> tuple[float, Array, Array]:
        """Return the log evidence of all but the smooth forces, and gradient and information of these given them."""
        smooth, widths = self.fixed == 0.0, self.widths((*self.none[:-1], looser))
        inner, cross = information[np.ix_(~smooth, ~smooth)], information[np.ix_(~smooth, smooth)]
        known = compute_log_evidence(gradient[~smooth], inner, widths[~smooth])
        pulled = np.linalg.solve(
            inner + np.diag(1.0 / widths[~smooth] ** 2), np.column_stack([cross, gradient[~smooth]])
        )
        return (
            known,
            gradient[smooth] - cross.T @ pulled[:, -1],
            information[np.ix_(smooth, smooth)] - cross.T @ pulled[:, :-1],
        )

    def choose(self, gradient: Array, information: Array, choice: Choice) -> Choice:
        """Return the choice of the largest evidence, from gradient and information of the coefficients at zero."""
        best, smooth = list(choice), self.fixed == 0.0
        given = [self._condition(gradient, information, option) for option in range(len(LOOSER))]

        def weigh(option: int, at: int) -> float:
            tried = (*best[:at], option, *best[at + 1 :])
            known, slope, bend = given[tried[-1]]
            return known + compute_log_evidence(slope, bend, self.widths(tried)[smooth]) - self.price(tried)

        for _ in range(SWEEPS):
            before = list(best)
            for at, force in enumerate(self.forces):
                weights = [weigh(option, at) for option in range(-1, len(force.options))]
                best[at] = int(np.argmax(weights)) - 1
            best[-1] = int(np.argmax([weigh(option, len(self.forces)) for option in range(len(LOOSER))]))
            if best == before:
                break
        return tuple(best)


def make_discrepancy(
    arm: TapedArm, scales: tuple[JointScales, ...], tolerance: float, estimated: set[str],
    inertial: Mapping[str, tuple[Part, float]], sizes: tuple[float, ...] = SIZES,
) -> Discrepancy:  # fmt: skip
    """Return the discrepancy of an arm along the path of its tape; values that are `estimated` are not in it.

    `inertial` are first moments and moments of inertia, each with its part of the tape and its usual size.
    """
    path = arm.tape.path
    parts = _list_inertias(arm, scales, tolerance, estimated, inertial)
    fixed = _list_known(arm, scales, tolerance, estimated)
    own = {f"{joint}.armature": j for j, joint in enumerate(arm.joints)}
    inertia = [_make_inertia(name, own.get(name, -1), part, path.a, path.a) for name, part, _ in parts]
    columns = [*inertia, *(c for c, _ in fixed)]
    widths, forces = [*(width for *_, width in parts), *(w for _, w in fixed)], []
    known = [True] * len(parts) + [c.name in arm.values for c, _ in fixed]
    time = np.asarray(np.arange(len(path.q)) * arm.log.dt, dtype=float)
    for j, scale in enumerate(scales):
        for over, x in (("position", path.q[:, j]), ("velocity", path.v[:, j]), ("time", time)):
            waves = _make_waves(x, linear=over == "time")
            place = slice(len(columns), len(columns) + len(waves))
            columns += [Column(f"{over}@{arm.joints[j]}", j, wave) for wave in waves]
            widths += [0.0] * len(waves)
            options = [size * scale.force * weights for size in sizes for weights in map(_weigh_waves, LENGTHS)]
            forces.append(SmoothTorque(j, over, place, np.array(options)))
    known += [False] * (len(columns) - len(known))
    inertias = {i: part for i, (_, part, _) in enumerate(parts)}
    return Discrepancy(tuple(columns), np.array(widths), np.array(known), tuple(forces), path.q.shape, inertias)


def _make_inertia(name: str, joint: int, part: Part, links: Array, drives: Array) -> Column:
    """Return the torque of one unit of an inertia of the links, or of the drive of a joint, under accelerations."""
    return Column(name, joint, -part.weigh(links) if joint < 0 else -part.weigh(drives)[:, joint])


def make_none(arm: TapedArm) -> Discrepancy:
    """Return a discrepancy without any column."""
    return Discrepancy((), np.zeros(0), np.zeros(0, dtype=bool), (), (arm.log.samples, len(arm.joints)))


def _make_waves(x: Array, *, linear: bool) -> Array:
    """Return the waves (count, samples) of a covariate over its range, without what is linear in it."""
    s = (x - x.min()) / max(float(np.ptp(x)), 1e-300)
    waves = math.sqrt(2.0) * np.cos(np.pi * np.outer(np.arange(1, WAVES + 1), s))
    plain = np.column_stack([np.ones_like(s), s][: 1 if linear else 2])
    return np.asarray(waves - (plain @ np.linalg.lstsq(plain, waves.T, rcond=None)[0]).T)


def _weigh_waves(length: float) -> Array:
    """Return the standard deviations of waves for a length in half widths; their squares sum to 1."""
    power = np.exp(-0.5 * (0.5 * np.pi * length * np.arange(1, WAVES + 1)) ** 2) + 1e-12
    return np.asarray(np.sqrt(power / power.sum()))


def _list_inertias(
    arm: TapedArm, scales: tuple[JointScales, ...], tolerance: float, estimated: set[str],
    inertial: Mapping[str, tuple[Part, float]],
) -> list[tuple[str, Part, float]]:  # fmt: skip
    """Return the names, parts and prior standard deviations of armatures, masses and inertial values that act."""
    least = NOTHING * np.array([scale.force for scale in scales])
    known = {name: (part, abs(arm.values[name])) for name, part in arm.parts.items() if name in arm.values}
    for j, joint in enumerate(arm.joints):
        own = np.zeros_like(arm.tape.mass)
        own[:, j, j] = 1.0
        known[f"{joint}.armature"] = Part(own, np.zeros_like(arm.tape.bias)), arm.get({}, "armature")[j]
    return [
        (name, part, tolerance * size)
        for name, (part, size) in {**known, **inertial}.items()
        if name not in estimated and np.any(tolerance * size * np.std(part.weigh(arm.tape.path.a), axis=0) > least)
    ]


def _list_known(
    arm: TapedArm, scales: tuple[JointScales, ...], tolerance: float, estimated: set[str]
) -> list[tuple[Column, float]]:
    """Return the columns of damping, friction, springs and of the torque, with their prior standard deviations."""
    found, log, path = [], arm.log, arm.tape.path
    drive = log.drive([], {})
    # Backward differences: a controller feeds the reading of the next sample, with its noise, into the next torque.
    slope = np.diff(drive, axis=0, prepend=drive[:1]) / log.dt

    def add(name: str, joint: int, force: Array, width: float) -> None:
        if width > 0.0 and name not in estimated:
            found.append((Column(name, joint, np.ascontiguousarray(force)), width))

    for j, (joint, scale) in enumerate(zip(arm.joints, scales, strict=True)):
        own = {kind: abs(arm.values.get(f"{joint}.{kind}", 0.0)) for kind in ("damping", "frictionloss")}
        stiffness, rest = arm.values.get(f"{joint}.stiffness", 0.0), arm.values.get(f"{joint}.rest", 0.0)
        add(f"{joint}.damping", j, -path.v[:, j], tolerance * own["damping"])
        add(f"{joint}.frictionloss", j, -np.sign(path.v[:, j]), tolerance * own["frictionloss"])
        add(f"{joint}.stiffness", j, rest - path.q[:, j], tolerance * abs(stiffness))
        add(f"{joint}.scale", j, arm.torque[:, j] if joint in log.controlled else drive[:, j], SCALE)
        add(f"{joint}.zero", j, np.ones(log.samples), ZERO * scale.force)
        add(f"{joint}.late", j, -slope[:, j], LATE * log.dt)
        add(f"{joint}.encoder", -1, -arm.tape.stiffness[:, :, j], ANGLE)
    return found
