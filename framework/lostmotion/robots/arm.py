"""An arm: a tape with the values that were taken out of it, a log, and the filter that joins them.

`TapedArm.filter` returns the one-step errors of the log for values by name, terms of the library at joints, and forces
that are added to the recorded torques.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from lostmotion.contracts import DriveTerm, Term
from lostmotion.kernels.chain import differentiate_errors, filter_chain
from lostmotion.likelihood.compose import compile_law
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.plan import Law
from lostmotion.parts import Array, Param, Values
from lostmotion.quantities import FORCE
from lostmotion.robots.gears import Gear
from lostmotion.robots.log import RobotLog, average_neighbours
from lostmotion.robots.tape import Part, Tape
from lostmotion.simulators import AT_GEAR

Whole = NDArray[np.int64]
NEEDS = {"angle": 0, "mobility": 1, "step": 2, "finest": 2, "inertia": 3}
"""What the filter knows at a joint, with the number under which its kernel knows it; 0 for what is known before."""
KNOWN_NEEDS = {"angle": 1.0}
"""The values of those that are known before."""
LAW_STEPS = 4
"""Steps of the filter within a sample where a law acts: dry friction needs them (study: 1 step costs 10 to 25 nats)."""
FASTEST, MOST_STEPS = 0.5, 64
"""The largest angle (rad) by which the motion of a gear may turn in one step; the largest number of steps."""
SETTLING = 0.1
"""The time (s) at the beginning of a log that does not count."""
CORRECTED = 0.03
"""The time (s) over which the corrections of accelerations by readings are averaged."""
SLOW = 1e-9
"""The velocity (SI) at which the stiffness of bristles is found."""
DOUBT_ANGLE, DOUBT_SPEED = 1e-3, 0.1
"""Standard deviations of the first position and velocity (SI)."""


def can_act(term: Term) -> bool:
    """Return whether a term can act at a joint: a law of the motion with at most one inner state, or of a drive."""
    if isinstance(term, DriveTerm):
        return not term.needs
    plain = isinstance(inspect.getattr_static(type(term), "force", None), staticmethod)
    known = set(term.needs) <= set(NEEDS)
    if not (term.acts == "motion" and plain and known) or len(term.states) > 1:
        return False
    return not make_law(term).reads_inputs


def make_law(term: Term) -> Law:
    """Return a term as the kernels of laws know it."""
    return Law(0, len(term.params) + len(term.needs), len(term.states), term.force, term.rate)


class _LawTable(NamedTuple):
    """Laws as the kernel knows them: their joints, slots, addresses, first numbers, widths, needs and numbers.

    `slots` are the places of inner states in the state of the filter, or -1. Laws `between` motor and link have one.
    """

    joints: Whole
    slots: Whole
    between: NDArray[np.bool_]
    addresses: Whole
    firsts: Whole
    widths: Whole
    needs: Whole
    numbers: Array


@dataclass(frozen=True, eq=False)
class FilteredLog:
    """One-step errors of a log, and what their derivatives need; `states` are the filtered ones (samples, L)."""

    seen: Innovations
    states: Array
    accelerations: Array
    gains: Array
    moves: Array
    pushes: Array


@dataclass(frozen=True, eq=False)
class TapedArm:
    """A machine with n joints: its log, tape, the parts of linear values, and all values by name.

    `values` holds `joint.damping`, `.frictionloss`, `.armature`, `.stiffness`, `.rest`, and values of `parts` relative
    to which the tape was made. `side` is where the torque was measured: "motor", or "link" of each gear;
    `motor_inertia` is that of the model (kg m^2), which a sensor behind the gear does not feel.
    """

    log: RobotLog
    tape: Tape
    parts: Mapping[str, Part]
    values: Mapping[str, float]
    side: str = "motor"
    motor_inertia: Mapping[str, float] = field(default_factory=dict)
    _cache: dict[tuple[object, ...], tuple[Array, ...]] = field(default_factory=dict)

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the joints."""
        return self.log.joints

    @cached_property
    def torque(self) -> Array:
        """The torque (samples, n) that acts along the path of the tape."""
        return self.log.measure_torque(self.tape.path.q, self.tape.path.v)

    @property
    def settling(self) -> int:
        """The number of samples at the beginning that do not count, because the first state is not known."""
        return round(SETTLING / self.log.dt)

    @cached_property
    def _middle(self) -> tuple[Array, ...]:
        """Stiffness, damping, bias and mass of the tape, position and velocity, in the middle of each interval."""
        tape, path = self.tape, self.tape.path
        return tuple(
            average_neighbours(x) for x in (tape.stiffness, tape.damping, tape.bias, tape.mass, path.q, path.v)
        )

    def get(self, values: Mapping[str, float], kind: str) -> Array:
        """Return a value of each joint (n,), from `values` or else from the machine itself."""
        names = [f"{joint}.{kind}" for joint in self.joints]
        return np.array([values.get(name, self.values.get(name, 0.0)) for name in names])

    def _build(self, values: Mapping[str, float], soft: tuple[int, ...], steps: tuple[int, int]) -> tuple[Array, ...]:
        """Return the inverses for two numbers of steps, Kq, Kv and h for values, with some joints behind a gear."""
        changed = tuple((name, values[name]) for name in sorted(self.parts) if name in values)
        base = ("damping", "armature", "stiffness", "rest")
        own = tuple(tuple(self.get(values, kind).tolist()) for kind in base)
        key = (changed, own, soft, steps)
        known = self._cache.get(key)
        if known is not None:
            return known
        stiffness, damping, bias, mass, q0, v0 = self._middle
        loss, armature, spring, rest = (self.get(values, kind) for kind in base)
        loss[list(soft)], armature[list(soft)] = 0.0, 0.0
        n, eye = len(self.joints), np.eye(len(self.joints))
        mass, bias = mass + eye * armature, bias + spring * (q0 - rest)
        if self.log.gains is not None:
            stiff, lossy = self.log.gains.T
            bias, spring, loss = bias + stiff * q0, spring + stiff, loss + lossy
        for name, value in changed:
            more = value - self.values.get(name, 0.0)
            part = self.parts[name]
            mass, bias = mass + more * average_neighbours(part.mass), bias + more * average_neighbours(part.bias)
        kv, kq = damping + eye * loss, np.ascontiguousarray(stiffness + eye * spring)
        made = {count: np.linalg.inv(mass + 0.5 * self.log.dt / count * kv) for count in dict.fromkeys(steps)}
        inverse = np.stack([made[count] for count in steps])
        free = bias - np.einsum("kij,kj->ki", damping, v0)
        if len(self._cache) > 40 // n:
            self._cache.clear()
        made_now = inverse, kq, kv, free
        self._cache[key] = made_now
        return made_now

    @cached_property
    def _mobility(self) -> Array:
        """One over the inertia of each link (n,), that of the first sample."""
        return np.diag(np.linalg.inv(self.tape.mass[0]))

    def count_steps(self, gears: Mapping[int, Gear], bristles: Mapping[int, float]) -> int:
        """Return the number of steps of the filter within a sample that springs need.

        They are those of gears and of laws with an inner state: `bristles` are the stiffnesses of these, by joint.
        """
        steps = 1
        for j in {*gears, *bristles}:
            stiff = (gears[j].stiffness if j in gears else 0.0) + bristles.get(j, 0.0)
            light = self._mobility[j] + (1.0 / self.values[f"{self.joints[j]}.armature"] if j in gears else 0.0)
            steps = max(steps, math.ceil(math.sqrt(stiff * light) * self.log.dt / FASTEST))
        return min(steps, MOST_STEPS)

    def filter(
        self,
        values: Mapping[str, float],
        terms: Sequence[Term],
        levels: tuple[Array, Array],
        *,
        gears: Mapping[int, Gear] | None = None,
        force: Array | None = None,
        last: int | None = None,
        keep: bool = False,
        readings: Array | None = None,
        start: tuple[int, Array, Array] | None = None,
    ) -> FilteredLog:
        """Return the one-step errors of the log up to sample `last` under values, terms and levels.

        `levels` are the intensities of the random forces (n,) in (N m)^2 s, and the variances of the readings. `force`
        (samples, n) is added to the torques of the drives; (samples, 2n) has forces on the links as well. `readings`
        replace those of the log; `start` is a first sample, with the mean and covariance of the state there.
        """
        log, gears = self.log, dict(gears or {})
        laws = [(t, self.joints.index(t.at.removesuffix(AT_GEAR))) for t in terms if not isinstance(t, DriveTerm)]
        table = self._list_laws(laws, values, 2 * len(self.joints) + 2 * len(gears))
        coarse = self.count_steps(gears, _measure_bristles(laws, values))
        fine = max(coarse, LAW_STEPS) if len(table.joints) else coarse
        inverses, kq, kv, free = self._build(values, tuple(sorted(gears)), (coarse, fine))
        tau = log.drive([t for t in terms if isinstance(t, DriveTerm)], values)
        n = len(self.joints)
        if force is not None:
            tau, free = tau + force[:, :n], free - force[:, n:] if force.shape[1] > n else free
        first = 0 if start is None else start[0]
        part = slice(first, last)
        z = (log.readings if readings is None else readings)[part]
        motors, plain = self._place_motors(gears, values)
        inner = int(np.count_nonzero(table.slots >= 0))
        mean, cov = self._begin(gears, motors, inner) if start is None else start[1:]
        samples, count, size = len(z), z.shape[1], len(mean)
        errors, variances = np.zeros((samples, count)), np.ones((samples, count))
        kept = samples if keep else 0
        picks = self.pick(gears)
        wide = {
            "states": (size,), "accelerations": (2 * n,), "gains": (count, size), "moves": (size, size),
            "pushes": (size, 2 * n),
        }  # fmt: skip
        made = {name: np.zeros((kept, *shape)) for name, shape in wide.items()}
        *_, q0, v0 = self._middle
        reached = _run_filter(
            z, picks, log.dt, coarse, fine, inverses[:, part], kq[part], kv[part], free[part], q0[part], v0[part],
            np.ascontiguousarray(tau[part]), levels[0], levels[1], motors, plain, *table, first * log.dt, mean, cov,
            errors, variances, made["states"], made["accelerations"], made["gains"], made["moves"], made["pushes"],
        )  # fmt: skip
        if keep:
            made["accelerations"] += self._correct(made["states"], made["accelerations"], motors)
        errors[: max(self.settling - first, 0)], variances[: max(self.settling - first, 0)] = 0.0, 1.0 / (2.0 * math.pi)
        seen = Innovations.of(errors[None], variances[None], np.array([reached]))[0]
        return FilteredLog(seen, **made)

    def _correct(self, states: Array, accelerations: Array, motors: Whole) -> Array:
        """Return the mean correction (samples, 2n) of accelerations by the readings before each sample.

        A force that the model lacks moves the joints all the same. Later readings would put their own noise in.
        """
        n = len(motors)
        rates = np.concatenate([n + np.arange(n), np.where(motors < 0, n + np.arange(n), motors + 1)])
        found = np.zeros_like(accelerations)
        found[1:] = np.diff(states[:, rates], axis=0) / self.log.dt - accelerations[:-1]
        width = max(round(CORRECTED / self.log.dt), 1)
        return np.asarray(lfilter(np.full(width, 1.0 / width), 1.0, found, axis=0))

    def pick(self, gears: Mapping[int, Gear]) -> Whole:
        """Return the index of the state that each reading shows: that of the motor, where a joint has a gear."""
        order, n, found = sorted(gears), len(self.joints), []
        for j, order_of in self.log.picks:
            state = order_of * n + j
            if j in gears and self.side == "motor":
                state = 2 * n + 2 * order.index(j) + order_of
            found.append(state)
        return np.array(found, dtype=np.int64)

    def _list_laws(self, laws: Sequence[tuple[Term, int]], values: Mapping[str, float], states: int) -> _LawTable:
        """Return the tables of the laws for the kernel, with the friction that the model itself has.

        Inner states of laws come after the other `states`.
        """
        rows = [(t, j, [values[f"{t.name}@{t.at}.{q.name}"] for q in t.params]) for t, j in laws]
        for j, force in enumerate(self.get(values, "frictionloss").tolist()):
            if force != 0.0:
                rows.append((BASE_FRICTION, j, [force]))
        made = [make_law(term) for term, *_ in rows]
        widths = [law.width for law in made]
        numbers = [x for term, _, given in rows for x in (*given, *(KNOWN_NEEDS.get(name, 0.0) for name in term.needs))]
        needs = [k for term, _, given in rows for k in (*[0] * len(given), *(NEEDS[name] for name in term.needs))]
        firsts = np.cumsum([0, *widths])[:-1]
        inner = np.array([len(term.states) for term, *_ in rows], dtype=np.int64)
        return _LawTable(
            np.array([j for _, j, _ in rows], dtype=np.int64),
            np.where(inner > 0, states + np.cumsum(inner) - 1, -1),
            np.array([term.at.endswith(AT_GEAR) for term, *_ in rows], dtype=np.bool_),
            np.array([compile_law(law, 0)[0] for law in made], dtype=np.int64),
            firsts.astype(np.int64),
            np.array(widths, dtype=np.int64),
            np.array(needs, dtype=np.int64),
            np.array(numbers, dtype=float),
        )

    def _place_motors(self, gears: Mapping[int, Gear], values: Mapping[str, float]) -> tuple[Whole, Array]:
        """Return the position of each motor in the state (n,), and the numbers of its gear (n, 5)."""
        n = len(self.joints)
        motors: Whole = np.full(n, -1, dtype=np.int64)
        plain = np.zeros((n, 5))
        inertia, loss = self.get(values, "armature"), self.get(values, "damping")
        for s, j in enumerate(sorted(gears)):
            motors[j] = 2 * n + 2 * s
            plain[j] = gears[j].play, gears[j].stiffness, gears[j].damp(inertia[j]), 1.0 / inertia[j], loss[j]
        return motors, plain

    def _begin(self, gears: Mapping[int, Gear], motors: Whole, inner: int) -> tuple[Array, Array]:
        """Return mean and covariance of the first state: motors are where joints are, bristles are not bent."""
        n, path, more = len(self.joints), self.tape.path, np.zeros(2 * len(gears) + inner)
        mean = np.concatenate([path.q[0], path.v[0], more])
        spread = np.concatenate([np.full(n, DOUBT_ANGLE), np.full(n, DOUBT_SPEED), more])
        for j, gear in gears.items():
            w = motors[j]
            mean[w], mean[w + 1], spread[w], spread[w + 1] = path.q[0, j], path.v[0, j], DOUBT_ANGLE, DOUBT_SPEED
            side = np.sign(self.log.torque[0, j]) if gear.play else 0.0
            mean[j] -= side * gear.play
            spread[j] = max(2.0 * gear.play, DOUBT_ANGLE)
        return mean, np.diag(spread**2)

    def differentiate(self, kept: FilteredLog, columns: Sequence[Column], gears: Mapping[int, Gear]) -> Array:
        """Return the derivatives (columns, samples * readings) of one-step errors over coefficients of forces."""
        samples, count, _ = kept.gains.shape
        found = np.zeros((len(columns), samples, count))
        order = np.argsort([column.joint for column in columns], kind="stable")  # forces on all links first
        for begin in range(0, len(order), CHUNK):
            part = order[begin : begin + CHUNK]
            made = np.zeros((len(part), samples, count))
            differentiate_errors(
                self.pick(gears), kept.gains, kept.moves, kept.pushes,
                *self._stack([columns[c] for c in part], samples), np.zeros((len(part), count)), made,
            )  # fmt: skip
            found[part] = made
        missing = np.isnan(self.log.readings[:samples])
        if missing.any():
            found[:, missing] = 0.0
        found[:, : self.settling] = 0.0
        return found.reshape(len(columns), samples * count)

    def _stack(self, columns: Sequence[Column], samples: int) -> tuple[Array, Array, Whole]:
        """Return the forces on all links (samples, n, count), by drives (samples, count), and where each joint begins.

        The columns are in the order of their joints, those of forces on all links first.
        """
        n, joints = len(self.joints), [column.joint for column in columns]
        wide = joints.count(-1)
        links, drives = np.zeros((samples, n, wide)), np.zeros((samples, len(columns) - wide))
        for c, column in enumerate(columns[:wide]):
            links[:, :, c] = column.force[:samples]
        for c, column in enumerate(columns[wide:]):
            drives[:, c] = column.force[:samples]
        return links, drives, np.searchsorted(joints[wide:], np.arange(n + 1)).astype(np.int64)


def _measure_bristles(laws: Sequence[tuple[Term, int]], values: Mapping[str, float]) -> dict[int, float]:
    """Return the stiffness (N m/rad or N/m) of laws with an inner state by joint, that before anything slides."""
    found: dict[int, float] = {}
    for term, j in laws:
        if term.states:
            own, rate = [values[f"{term.name}@{term.at}.{q.name}"] for q in term.params], np.zeros(1)
            term.rate(0.0, 0.0, SLOW, rate, (*own, *(SLOW for _ in term.needs)), (0.0,), rate)
            found[j] = found.get(j, 0.0) + abs(float(rate[0])) / SLOW
    return found


_run_filter: Callable[..., int] = filter_chain

CHUNK = 64
"""The number of columns whose derivatives are computed at once."""


@dataclass(frozen=True, eq=False)
class Column:
    """The force of a unit coefficient: (samples,) by one drive, or (samples, n) on all links if `joint` is -1."""

    name: str
    joint: int
    force: Array


@dataclass(frozen=True)
class _BaseFriction(Term):
    """The dry friction that the model itself has."""

    at: str = ""
    name: ClassVar[str] = "frictionloss"
    physics: ClassVar[str] = "Dry friction of {force} opposes the motion"
    formula: ClassVar[str] = "-force * sign(v)"
    paper: ClassVar[str] = "Coulomb (1785)"
    params = (Param("force", "friction force", FORCE, low=0.0, null=0.0),)
    needs = ("mobility",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return dry friction that is a steep line around rest."""
        width = p[0] * p[1]
        return -p[0] if v >= width else (p[0] if v <= -width else -p[0] * v / width)


BASE_FRICTION = _BaseFriction()
