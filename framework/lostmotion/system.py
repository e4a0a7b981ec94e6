"""A model with its terms as something that runs: parameter layout, compiled kernels, measured inputs.

A `System` holds a model and a library of terms, each of which is on or off (`active`) at run time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lostmotion.beside import DriveTerm, Input, SensorTerm
from lostmotion.contracts import Array, Assembly, Interface, Model, Param, Term, place_of
from lostmotion.errors import ContractError, nearest
from lostmotion.forcing import SILENT, Drive, Tone
from lostmotion.kernels import Blueprint, Compiled, Law, Place, build

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
    def index(self) -> Mapping[str, int]:
        """The position of each parameter key in the full vector."""
        return {slot.key: i for i, slot in enumerate(self.slots)}

    def slot(self, name: str) -> Slot:
        """Return the parameter called `name` or one of its aliases, or raise `ContractError` naming the nearest."""
        for slot in self.slots:
            if name == slot.key or (slot.term is None and name in slot.param.aliases):
                return slot
        known = [slot.key for slot in self.slots if slot.term is None]
        raise ContractError(
            f"{self.model.name} has no parameter {name!r}{nearest(name, known)}: it has {', '.join(known)}"
        )

    def vector(self, values: Mapping[str, float]) -> Array:
        """Return the full parameter vector; what is not given is `null`, or one for a shape parameter, or zero."""
        full = np.array([_default(slot) for slot in self.slots])
        for name, value in values.items():
            full[self.index[self.slot(name).key]] = value
        return full

    def states(self, active: Iterable[str]) -> int:
        """Return how many states the model has with these terms."""
        chosen = set(active)
        return len(self.model.states) + sum(
            len(term.states) for key, term in zip(self.keys, self.terms, strict=True) if key in chosen
        )

    def kernel(self, active: Iterable[str], *, latent: bool = False, compiled: bool = True) -> Compiled:
        """Return the kernel for as many states as these terms need; it is the same for any terms without states."""
        wanted = self.states(active) + latent, latent
        if wanted not in self._plans:
            self._plans[wanted] = self._plan(*wanted)
        return build(self._plans[wanted], compiled)

    @cached_property
    def _plans(self) -> dict[tuple[int, bool], Blueprint]:
        """What was planned already: a filter asks for its kernel at every point."""
        return {}

    def _plan(self, n: int, latent: bool) -> Blueprint:
        model = self.model
        index = {q.name: i for i, q in enumerate(model.params)}
        places = tuple(
            Place(i.row, index[i.inertia], i.motion, i.against and (i.against[0], index[i.against[1]]))
            for i in model.interfaces
        )
        names = [i.name for i in model.interfaces]
        laws = tuple(
            Law(names.index(place_of(model, t).name), len(t.params) + len(t.needs), len(t.states), t.force, t.rate)
            for _, t in self.forces
        )
        return Blueprint(n, len(model.channels), model.rhs, model.observe, places, laws, latent)

    def inertia(self, full: Array, place: Interface) -> float:
        """Return the inertia (kg or kg m^2) that a force at a place moves; of two bodies, m1 m2 / (m1 + m2)."""
        moved = [place.inertia, *(place.against[1:] if place.against else ())]
        return float(1.0 / np.sum([1.0 / full[self.index[name]] for name in moved]))

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

    def pack(self, full: Array, step: float, tone: Tone = SILENT) -> tuple[Array, Array]:
        """Return the parameters of the model, and those of all forces, each with what it needs behind its own.

        `step` is that of the integration (s).
        """
        base = np.ascontiguousarray(full[: len(self.model.params)])
        more = {"step": step, "omega": tone.omega, "amplitude": tone.amplitude, "none": 0.0}
        sources = [source for key, _ in self.forces for source in self._sources[key]]
        places = self.model.interfaces
        own = [
            full[i] if kind == "own" else more[kind] if kind in more else step / self.inertia(full, places[i])
            for kind, i in sources
        ]
        return base, np.array(own, dtype=float)

    def values(self, full: Array, key: str, tone: Tone) -> tuple[float, ...]:
        """Return `p` of a term beside the machine: its own parameters, and behind them what it needs."""
        return tuple(float(full[i] if kind == "own" else getattr(tone, kind)) for kind, i in self._sources[key])

    @cached_property
    def forces(self) -> tuple[tuple[str, Term], ...]:
        """The terms that act on the motion, with their keys, in the order of the kernel."""
        return tuple((k, t) for k, t in zip(self.keys, self.terms, strict=True) if t.acts == "motion")

    @cached_property
    def beside(self) -> Mapping[str, DriveTerm | SensorTerm]:
        """The terms of drive and sensor, by key."""
        pairs = zip(self.keys, self.terms, strict=True)
        return {key: term for key, term in pairs if isinstance(term, DriveTerm | SensorTerm)}

    def shaping(self, active: Iterable[str]) -> tuple[str, ...]:
        """Return the keys of those terms that change the input which acts: of the drive, and delays of the sensor."""
        return tuple(k for k, t in self.beside.items() if k in set(active) and not t.marked)

    def acting(self, u: Input, full: Array, active: Iterable[str], tone: Tone) -> Input:
        """Return the input that acts in place of the recorded `u`, in the time of what the sensor shows."""
        for key in self.shaping(active):
            u = _through(self.beside[key], u, self.values(full, key, tone))
        return u

    def gain(self, full: Array, active: Iterable[str]) -> float:
        """Return what the sensor shows of one unit of the channel."""
        sensors = [(k, t) for k, t in self.beside.items() if isinstance(t, SensorTerm) and k in set(active)]
        return math.prod(t.gain(self.values(full, key, SILENT)) for key, t in sensors)

    @cached_property
    def _sources(self) -> Mapping[str, tuple[tuple[str, int], ...]]:
        """Where each entry of the `p` of a term comes from: "own" with an index, "mobility" with that of its place."""
        return {key: tuple(self._entries(key, term)) for key, term in zip(self.keys, self.terms, strict=True)}

    def _entries(self, key: str, term: Term) -> Iterable[tuple[str, int]]:
        place = place_of(self.model, term)
        contact = {"stiffness": place.stiffness, "play": place.play}
        yield from (("own", self.index[f"{key}.{q.name}"]) for q in term.params)
        for need in term.needs:
            if need in ("step", "omega", "amplitude"):
                yield need, NUMB
            elif need == "mobility":
                yield need, self.model.interfaces.index(place)
            else:
                name = contact.get(need, need)
                yield ("own", self.index[name]) if name else ("none", NUMB)

    def channel(self, name: str) -> tuple[int, int]:
        """Return the index of an observed channel, and that of the state it shows directly (-1 when it is none)."""
        if name not in self.model.channels:
            known = ", ".join(self.model.channels)
            raise ContractError(
                f"{self.model.name} does not show {name!r}{nearest(name, self.model.channels)}: it shows {known}"
            )
        direct = self.model.states.index(name) if name in self.model.states else NUMB
        return self.model.channels.index(name), direct

    def simulate(self, full: Array, active: Iterable[str], y0: Array, drive: Drive) -> Motion:
        """Return the free motion from the state `y0` (padded with zeros for the states of terms) under `drive`."""
        chosen = tuple(active)
        base, own = self.pack(full, drive.dt / drive.nsub, drive.tone)
        on, at = self.wiring(chosen)
        start = np.zeros(self.states(chosen))
        start[: min(len(start), len(y0))] = y0[: len(start)]
        states = np.full((drive.samples, len(start)), np.nan)
        run = self.kernel(chosen).run
        return Motion(
            states, int(run(start, drive.u, drive.begin, drive.dt, drive.nsub, base, own, on, at, 0.0, states))
        )

    def stiffness(self, full: Array, active: Iterable[str], states: Array, inputs: Array) -> float:
        """Return the fastest rate (1/s) of the linearised motion over the given states (points, n) and inputs.

        Infinite where it is beyond all numbers.
        """
        chosen = tuple(active)
        base, own = self.pack(full, 1.0)
        on, at = self.wiring(chosen)
        derivative = self.kernel(chosen).derivative
        n, fastest = self.states(chosen), 0.0
        spread = np.maximum(1e-6 * (np.ptp(states, axis=0) + 1e-12), 1e-9 * np.abs(states).max(axis=0))

        def slope(y: Array, u: Array) -> Array:
            dydt = np.zeros(n)
            derivative(0.0, y, u, base, own, on, at, 0.0, dydt)
            return dydt

        for y, u in zip(states, inputs, strict=True):
            full_y = np.zeros(n)
            full_y[: len(y)] = y
            m = len(y)
            jac = np.array(
                [(slope(full_y + _unit(n, a) * spread[a], u) - slope(full_y, u)) / spread[a] for a in range(m)]
            )
            if not np.all(np.isfinite(jac)):
                return math.inf
            fastest = max(fastest, float(np.abs(np.linalg.eigvals(jac[:, :m])).max()))
        return fastest


def _through(term: DriveTerm | SensorTerm, u: Input, p: tuple[float, ...]) -> Input:
    """Return an input after one term; a sensor that is late sees what an earlier input has done."""
    if isinstance(term, DriveTerm):
        return lambda t, order: term.true(u, t, p, order)
    late = term.delay(p)
    return (lambda t, order: u(t - late, order)) if late else u


def _unit(n: int, a: int) -> Array:
    e = np.zeros(n)
    e[a] = 1.0
    return e


def _default(slot: Slot) -> float:
    if slot.param.null is not None:
        return slot.param.null
    if slot.param.choices:
        return slot.param.choices[0]
    return 1.0 if slot.param.scale == "log" else 0.0
