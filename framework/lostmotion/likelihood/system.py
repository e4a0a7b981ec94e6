"""A model with its terms as something that runs: parameter layout, compiled kernels, measured inputs.

A `System` holds a model and a library of terms, each of which is on or off (`active`) at run time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Assembly, DriveTerm, Input, Interface, Model, Param, SensorTerm, Term, place_of
from lostmotion.errors import ContractError, nearest
from lostmotion.likelihood.acting import Column, Recorded, of_order, through
from lostmotion.likelihood.compose import Blueprint, Functions, Place, functions, law_of
from lostmotion.likelihood.drive import SILENT, Drive, Tone
from lostmotion.likelihood.motion import derivatives, run
from lostmotion.likelihood.sensors import Sensor
from lostmotion.quantities import TIME

PIECE = 200_000
"""Steps of a long motion that are computed at a time."""
ALWAYS = -1e9
"""The onset (s) of a term that was there from the beginning."""
ONSET = Param("since", "time from which on it acts", TIME, null=ALWAYS)
NUMB = -1
"""The index of an observed channel that is no state and has to be linearised."""


def key_of(term: Term) -> str:
    """Return the name of a term, with its place when that is neither the ground nor plain: `coulomb_friction@base`."""
    return term.name if term.at in ("ground", "drive", "sensor") else f"{term.name}@{term.at}"


@dataclass(frozen=True)
class Slot:
    """A parameter of the whole system: `key` is `c` for the model's, `coulomb_friction.force` for a term's."""

    key: str
    param: Param
    unit: str
    term: int | None


class Clock(NamedTuple):
    """When a motion is looked at: so many `samples` every `dt` s, with `nsub` steps between two."""

    dt: float
    nsub: int
    samples: int


@dataclass(frozen=True)
class Motion:
    """A free simulation: `states` (samples, n) at the sample times, and how many of them are finite."""

    states: Array
    finite: int


@dataclass(frozen=True)
class System:
    """A model and the terms it may have; all terms are known to the kernel, `active` says which act."""

    model: Model
    terms: tuple[Term, ...] = ()

    @classmethod
    def of(cls, assembly: Assembly | Model) -> System:
        """Return the system of a model or of `model + term + ...`."""
        if isinstance(assembly, Model):
            return cls(assembly)
        return cls(assembly.model, assembly.terms)

    @property
    def everything(self) -> frozenset[str]:
        """The keys of all terms."""
        return frozenset(self.keys)

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The key of each term, in order."""
        return tuple(key_of(term) for term in self.terms)

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """Every parameter: the model's first, then those of each term."""
        motion = self.model.motion
        own = [Slot(q.name, q, q.dimension.unit(motion), None) for q in self.model.params]
        for i, term in enumerate(self.terms):
            own += [Slot(f"{self.keys[i]}.{q.name}", q, q.dimension.unit(motion), i) for q in term.params]
        return tuple(own)

    @cached_property
    def onsets(self) -> tuple[Slot, ...]:
        """The time from which on each term acts: `key.since`; those of the kernel first, then those of the drive.

        They stand behind all parameters in the full vector. What a sensor shows has no onset.
        """
        keys = [key for key, _ in self.forces] + [k for k, t in self.beside.items() if t.acts == "drive"]
        return tuple(Slot(f"{key}.since", ONSET, "s", self.keys.index(key)) for key in keys)

    @cached_property
    def index(self) -> Mapping[str, int]:
        """The position of each parameter key in the full vector."""
        return {slot.key: i for i, slot in enumerate((*self.slots, *self.onsets))}

    def slot(self, name: str) -> Slot:
        """Return the parameter called `name` or one of its aliases, or raise `ContractError` naming the nearest."""
        for slot in (*self.slots, *self.onsets):
            if name == slot.key or (slot.term is None and name in slot.param.aliases):
                return slot
        known = [slot.key for slot in self.slots if slot.term is None]
        raise ContractError(
            f"{self.model.name} has no parameter {name!r}{nearest(name, known)}: it has {', '.join(known)}"
        )

    def vector(self, values: Mapping[str, float]) -> Array:
        """Return the full parameter vector; what is not given is `null`, or one for a shape parameter, or zero."""
        full = np.array([_default(slot) for slot in (*self.slots, *self.onsets)])
        for name, value in values.items():
            full[self.index[self.slot(name).key]] = value
        return full

    def states(self, active: Iterable[str]) -> int:
        """Return how many states the model has with these terms."""
        chosen = set(active)
        return len(self.model.states) + sum(
            len(term.states) for key, term in zip(self.keys, self.terms, strict=True) if key in chosen
        )

    def functions(self, compiled: bool = True) -> Functions:
        """Return what derives and what observes the states, the same whatever terms are active."""
        return functions(self.blueprint, compiled)

    @cached_property
    def blueprint(self) -> Blueprint:
        """The plan of the kernel of the model with all terms."""
        model = self.model
        index = {q.name: i for i, q in enumerate(model.params)}
        places = tuple(
            Place(
                i.row,
                index[i.inertia],
                i.motion,
                i.against and (i.against[0], index[i.against[1]]),
                None if i.lever is None else index[i.lever],
            )
            for i in model.interfaces
        )
        names = [i.name for i in model.interfaces]
        laws = tuple(
            law_of(t, 0, model.channels.index(t.channel))
            if isinstance(t, SensorTerm)
            else law_of(t, names.index(place_of(model, t).name))
            for _, t in self.forces
        )
        sizes = (len(model.states), len(model.inputs), len(model.channels), len(model.params))
        return Blueprint(*sizes, model.rhs, model.observe, places, laws)

    def inertia(self, full: Array, place: Interface) -> Any:
        """Return the inertia (kg or kg m^2) that a force at a place moves; of two bodies, 1 / (1/m1 + lever^2/m2).

        `full` is (parameters,) or (points, parameters).
        """
        moved = [place.inertia, *(place.against[1:] if place.against else ())]
        inverse = [1.0 / full[..., self.index[name]] for name in moved]
        for lever in self.lever(full, place):
            inverse[-1] = lever**2 * inverse[-1]
        return 1.0 / np.sum(inverse, axis=0)

    def lever(self, full: Array, place: Interface) -> tuple[Any, ...]:
        """Return the lever of the second body of a place, as its `motion` takes it: nothing where there is none."""
        return () if place.lever is None else (full[..., self.index[place.lever]],)

    def wiring(self, active: Iterable[str]) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
        """Return the switches of the terms, and where in `y` the states of each begin."""
        chosen = set(active)
        if unknown := chosen - set(self.keys):
            raise ContractError(
                f"no term {sorted(unknown)[0]!r} in this system{nearest(sorted(unknown)[0], self.keys)}"
            )
        on = np.array([key in chosen for key, _ in self.forces], dtype=np.bool_)
        at, start = np.zeros(len(on), dtype=np.int64), len(self.model.states)
        for i, (_, term) in enumerate(self.forces):
            at[i] = start if on[i] else 0
            start += len(term.states) if on[i] else 0
        return on, at

    def pack(self, fulls: Array, step: float, tone: Tone = SILENT, *, line: int = 1) -> Array:
        """Return what a model and its forces are handed, (points, params): each force has what it needs behind its own.

        `fulls` is (points, parameters); `step` is that of the integration (s), of which a law that jumps at rest takes
        `line` to pass its steep line. Behind the parameters of the model and of the forces stand the pace of a latent
        force, the step, and one over each inertia; before these the onset of each force.
        """
        base = fulls[:, : len(self.model.params)]
        onsets = fulls[:, len(self.slots) : len(self.slots) + len(self.forces)]
        more = {"step": step, "finest": step, "omega": tone.omega, "amplitude": tone.amplitude}
        columns = []
        for key, term in self.forces:
            own = np.empty((len(fulls), len(self._sources[key])))
            for column, (kind, i) in enumerate(self._sources[key]):
                if kind in ("mobility", "inertia"):
                    moved = self.inertia(fulls, self.model.interfaces[i])
                    own[:, column] = moved if kind == "inertia" else line * step / moved
                elif kind == "number":
                    own[:, column] = i
                else:
                    own[:, column] = fulls[:, i] if kind == "own" else more[kind]
            columns.append(term.prepared(own))
        with np.errstate(divide="ignore"):
            inverse = [1.0 / fulls[:, i] for i in self.blueprint.inertias]
        silent, steps = np.zeros(len(fulls)), np.full(len(fulls), step)
        return np.column_stack([base, *columns, onsets, silent, steps, *inverse])

    def values(self, full: Array, key: str, tone: Tone) -> tuple[float, ...]:
        """Return `p` of a term beside the machine: its own parameters, and behind them what it needs of the drive."""
        known = {"omega": tone.omega, "amplitude": tone.amplitude}
        return tuple(float(full[i] if kind == "own" else known.get(kind, 0.0)) for kind, i in self._sources[key])

    @cached_property
    def forces(self) -> tuple[tuple[str, Term], ...]:
        """The terms that the kernel knows, with their keys, in its order: forces, and sensors that have states.

        Those that feel the acceleration come behind all other forces, which make it.
        """
        pairs = list(zip(self.keys, self.terms, strict=True))
        own = [(k, t) for k, t in pairs if t.acts == "motion" or (t.acts == "sensor" and t.states)]
        return tuple(sorted(own, key=lambda pair: (pair[1].acts == "sensor", "acceleration" in pair[1].needs)))

    @cached_property
    def beside(self) -> Mapping[str, DriveTerm | SensorTerm]:
        """The terms of drive and sensor, by key."""
        pairs = zip(self.keys, self.terms, strict=True)
        return {key: term for key, term in pairs if isinstance(term, DriveTerm | SensorTerm)}

    @cached_property
    def groups(self) -> tuple[tuple[str, tuple[int, ...]], ...]:
        """The inputs by name, with their columns among those of the model: of a base motion value and derivative."""
        names = self.model.inputs
        found: list[tuple[str, tuple[int, ...]]] = []
        for i, name in enumerate(names):
            if name == "base_position" and "base_velocity" in names:
                found.append((name, (i, names.index("base_velocity"))))
            elif name != "base_velocity" or "base_position" not in names:
                found.append((name, (i,)))
        return tuple(found)

    def shaping(self, active: Iterable[str], *, alone: bool = True) -> tuple[str, ...]:
        """Return the keys of those terms that change the input which acts: of the drive, and delays of the sensor.

        A sensor that is `alone` is late as the drive is; of several, each has a delay of its own.
        """
        return tuple(
            k
            for k, t in self.beside.items()
            if k in set(active) and not t.marked and (alone or isinstance(t, DriveTerm))
        )

    def idle(self, full: Array, key: str) -> bool:
        """Return whether a term does nothing: all its parameters with a null are at it."""
        term = self.terms[self.keys.index(key)]
        return all(full[self.index[f"{key}.{name}"]] == null for name, null in term.null().items())

    def acting(
        self, columns: Sequence[Column], full: Array, keys: Iterable[str], tone: Tone, *, lead: int = 0
    ) -> list[Column | None]:
        """Return what acts in place of the recorded inputs, one function of time (s) for each; None where it is that.

        `keys` are terms of the drive, which act on the input that drives (in column `lead`) unless they name another,
        and delays of a sensor: one that is late sees what all inputs have done before.
        """
        made: list[Column | None] = [None] * len(columns)
        for name, places in self.groups:
            if max(places) >= len(columns):  # an input that nothing drives
                continue
            u: Input = Recorded(tuple(columns[place] for place in places))
            own = [key for key in keys if self._touches(key, name, lead in places)]
            for key in own:
                since = full[self.index[f"{key}.since"]] if f"{key}.since" in self.index else ALWAYS
                u = through(self.beside[key], u, self.values(full, key, tone), float(since))
            for order, place in enumerate(places if own else ()):
                made[place] = partial(of_order, u, order)
        return made

    def _touches(self, key: str, name: str, leads: bool) -> bool:
        term = self.beside[key]
        return isinstance(term, SensorTerm) or term.at == name or (term.at == "drive" and leads)

    def gain(self, full: Array, active: Iterable[str], place: str = "sensor") -> float:
        """Return what the sensor at a place shows of one unit of its channel."""
        return math.prod(t.gain(p) for t, p in self.at_sensor(full, active, place))

    def at_sensor(self, full: Array, active: Iterable[str], place: str) -> list[tuple[SensorTerm, tuple[float, ...]]]:
        """Return the active terms of the sensor at a place, with what each is handed."""
        chosen = set(active)
        return [
            (term, self.values(full, key, SILENT))
            for key, term in self.beside.items()
            if isinstance(term, SensorTerm) and key in chosen and term.at == place
        ]

    @cached_property
    def _sources(self) -> Mapping[str, tuple[tuple[str, int], ...]]:
        """Where each entry of the `p` of a term comes from: "own" with an index, "mobility" with that of its place."""
        return {key: tuple(self._entries(key, term)) for key, term in zip(self.keys, self.terms, strict=True)}

    def _entries(self, key: str, term: Term) -> Iterable[tuple[str, int]]:
        place = place_of(self.model, term)
        contact = {"stiffness": place.stiffness, "play": place.play}
        contact["contact"] = place.stiffness if place.play else None
        yield from (("own", self.index[f"{key}.{q.name}"]) for q in term.params)
        for need in term.needs:
            if need in ("step", "finest", "omega", "amplitude"):
                yield need, NUMB
            elif need in ("mobility", "inertia"):
                yield need, self.model.interfaces.index(place)
            elif need in ("acceleration", "force_input", "shake_input"):
                yield "number", self._input_of(need, place)
            else:
                name = contact.get(need, need)
                yield ("own", self.index[name]) if name else ("number", 0)

    def _input_of(self, need: str, place: Interface) -> int:
        """Return which input is the force on the body at a place, or the acceleration of the base; -1 where none is."""
        inputs, first = self.model.inputs, self.model.interfaces[0].row
        name = "base_acceleration" if need == "shake_input" else "force" if place.row == first else "second_force"
        return inputs.index(name) if name in inputs and need != "acceleration" else NUMB

    @cached_property
    def bending(self) -> tuple[str, ...]:
        """The keys of the terms that bend what a sensor shows."""
        bent = SensorTerm.bent
        return tuple(k for k, t in self.beside.items() if isinstance(t, SensorTerm) and type(t).bent is not bent)

    @cached_property
    def lagging(self) -> tuple[str, ...]:
        """The keys of the sensors that have states of their own."""
        return tuple(key for key, term in self.beside.items() if term.acts == "sensor" and term.states)

    def gauging(self, active: Iterable[str]) -> bool:
        """Return whether any sensor term is active."""
        return any(isinstance(self.beside[key], SensorTerm) for key in set(active) & set(self.beside))

    @cached_property
    def delaying(self) -> bool:
        """Whether any of the terms makes a sensor late."""
        return any(isinstance(t, SensorTerm) and type(t).delay is not SensorTerm.delay for t in self.terms)

    def feels(self, name: str) -> bool:
        """Return whether a channel shows the forces on a body at once, as an accelerometer does."""
        return name in self._felt

    @cached_property
    def _felt(self) -> frozenset[str]:
        """The channels that change with the derivatives of states on which forces act."""
        model, rng = self.model, np.random.default_rng(0)
        y, u = rng.random(len(model.states)), rng.random(max(len(model.inputs), 1))
        p, seen, pushed = rng.random(len(model.params)), np.zeros(len(model.channels)), np.zeros(len(model.channels))
        still, push = np.zeros(len(y)), np.zeros(len(y))
        push[[body.row for body in self.blueprint.bodies]] = 1.0
        model.observe(0.0, y, still, u, p, seen)
        model.observe(0.0, y, push, u, p, pushed)
        return frozenset(name for name, a, b in zip(model.channels, seen, pushed, strict=True) if a != b)

    def channel(self, name: str) -> tuple[int, int]:
        """Return the index of an observed channel, and that of the state it shows directly (-1 when it is none)."""
        if name not in self.model.channels:
            known = ", ".join(self.model.channels)
            raise ContractError(
                f"{self.model.name} does not show {name!r}{nearest(name, self.model.channels)}: it shows {known}"
            )
        direct = self.model.states.index(name) if name in self.model.states else NUMB
        return self.model.channels.index(name), direct

    def shown(self, sensor: Sensor, active: Iterable[str]) -> tuple[int, int]:
        """Return the index of the channel of a sensor, and that of the state it shows directly (-1 when it is none).

        One with a state of its own shows that.
        """
        chosen = set(active)
        for (key, term), at in zip(self.forces, self.wiring(chosen)[1], strict=True):
            if key in chosen and isinstance(term, SensorTerm) and term.at == sensor.place:
                return self.channel(sensor.channel)[0], int(at)
        return self.channel(sensor.channel)

    def simulate(self, full: Array, active: Iterable[str], y0: Array, drive: Drive, nsub: int = 1) -> Motion:
        """Return the free motion by RK4, `nsub` steps to a sample, from the state `y0` under `drive`.

        What `y0` lacks, the states of terms, begins at zero; inputs that `drive` lacks are zero.
        """
        chosen, drive = frozenset(active), drive.widened(len(self.model.inputs))
        start = np.zeros((1, self.states(chosen)))
        start[0, : min(start.shape[1], len(y0))] = y0[: start.shape[1]]
        packed = self.pack(full[None], drive.dt / nsub, drive.tone)
        states, reached = run(self, chosen, packed, start, drive, nsub, np.zeros(1, dtype=np.int64), drive.samples)
        return Motion(states[0], int(reached[0]))

    def moved(
        self, full: Array, y0: Array, columns: Sequence[Callable[[Array], Array]], clock: Clock, tone: Tone = SILENT
    ) -> Motion:
        """Return the free motion with all terms under inputs that are known at any time (s), one function to each.

        Each step has a cubic of its own, so the inputs may be of any frequency that the steps resolve.
        """
        dt, count, states, done = clock.dt / clock.nsub, max(PIECE // clock.nsub, 1), [], 0
        start = np.zeros(self.states(self.everything))
        start[: min(len(start), len(y0))] = y0[: len(start)]
        while done < clock.samples:
            steps = min(count, clock.samples - done) * clock.nsub + 1
            drive = replace(Drive.smooth(columns, dt, steps, done * clock.dt), tone=tone)
            piece = self.simulate(full, self.everything, start, drive)
            states.append(piece.states[: -1 : clock.nsub])
            start = piece.states[-1]
            done += count
        seen = np.concatenate(states)
        bad = np.flatnonzero(~np.isfinite(seen).all(axis=1))
        return Motion(seen, int(bad[0]) if len(bad) else len(seen))

    def stiffness(self, full: Array, active: Iterable[str], states: Array, inputs: Array) -> float:
        """Return the fastest rate (1/s) of the linearised motion over the given states (points, n) and inputs.

        Infinite where it is beyond all numbers. A state that is the same at all points, as that of a second body where
        nobody knows it, is moved by as little as the one that varies least.
        """
        chosen, (points, m) = frozenset(active), states.shape
        wide = np.ptp(states, axis=0)
        wide = np.where(wide > 0.0, wide, np.min(wide, where=wide > 0.0, initial=np.max(wide)))
        spread = np.maximum(1e-6 * (wide + 1e-12), 1e-9 * np.abs(states).max(axis=0))
        moved = np.zeros((m + 1, points, self.states(chosen)))
        moved[:, :, :m] = states
        for a in range(m):
            moved[a + 1, :, a] += spread[a]
        tiled = np.tile(inputs, (m + 1, 1))
        rates, _ = derivatives(self, chosen, self.pack(full[None], 1.0), moved.reshape(-1, moved.shape[2]), tiled)
        rates = rates.reshape(moved.shape)[:, :, :m]
        jacobians = np.moveaxis((rates[1:] - rates[0]) / spread[:, None, None], 0, 2)
        if not np.all(np.isfinite(jacobians)):
            return math.inf
        return float(np.abs(np.linalg.eigvals(jacobians)).max(initial=0.0))


def _default(slot: Slot) -> float:
    if slot.param.null is not None:
        return slot.param.null
    if slot.param.choices:
        return slot.param.choices[0]
    return 1.0 if slot.param.scale == "log" else 0.0
