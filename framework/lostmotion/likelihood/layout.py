"""A model with its terms as a kernel sees it: positions of parameters, onsets, states and arguments of each law."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, DriveTerm, Interface, Machine, Model, Param, Place, SensorTerm, Term, place_of
from lostmotion.errors import ContractError, nearest
from lostmotion.likelihood.compose import Functions, compile_functions, define_plain_functions
from lostmotion.likelihood.drive import SILENT, DriveHarmonic
from lostmotion.likelihood.plan import Blueprint, KernelPlace, compute_room, make_law
from lostmotion.quantities import TIME

ALWAYS = -1e9
"""The onset (s) of a term that acts from the beginning."""
ONSET = Param("since", "time from which on it acts", TIME, null=ALWAYS)
NUMB = -1
"""The index of an observed channel that is not a state and has to be linearised."""


def onset_key(key: str) -> str:
    """Return the key of the onset of a term."""
    return f"{key}.since"


def key_of(term: Term) -> str:
    """Return the name of a term, with its place (`coulomb_friction@base`) unless that is ground, drive or sensor."""
    return term.name if term.at in ("ground", "drive", "sensor") else f"{term.name}@{term.at}"


@dataclass(frozen=True)
class Slot:
    """A parameter of the whole system: `key` is `c` for one of the model, `coulomb_friction.force` of a term."""

    key: str
    param: Param
    unit: str
    term: int | None


@dataclass(frozen=True)
class Layout:
    """A model and its possible terms as numbers: the full vector of parameters, and the meaning of each entry."""

    model: Machine
    terms: tuple[Term, ...] = ()

    @property
    def equations(self) -> Model:
        """The machine as a model that is written as equations; `ContractError` where it can only be stepped."""
        if not isinstance(self.model, Model):
            raise ContractError(f"{self.model.name} has a step and no equations: use a `Model` here")
        return self.model

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
        own = [Slot(q.name, q, q.unit(motion), None) for q in self.model.params]
        for i, term in enumerate(self.terms):
            own += [Slot(f"{self.keys[i]}.{q.name}", q, q.unit(motion), i) for q in term.params]
        return tuple(own)

    @cached_property
    def onsets(self) -> tuple[Slot, ...]:
        """The time from which each term acts: `key.since`; of forces first, then of the drive, then of sensors.

        They come after all parameters in the full vector.
        """
        keys = [key for key, _ in self.forces] + [k for k, t in self.channel_terms.items() if t.acts == "drive"]
        keys += self.rescaling
        return tuple(Slot(onset_key(key), ONSET, "s", self.keys.index(key)) for key in keys)

    @cached_property
    def rescaling(self) -> tuple[str, ...]:
        """The keys of the sensor terms that are a gain or an offset and nothing else: these may have an onset."""
        plain = ("delay", "bent", "rounded", "quantisation", "rate")
        return tuple(
            key
            for key, term in self.channel_terms.items()
            if isinstance(term, SensorTerm)
            and all(getattr(type(term), name) is getattr(SensorTerm, name) for name in plain)
        )

    @cached_property
    def index(self) -> Mapping[str, int]:
        """The position of each parameter key in the full vector."""
        return {slot.key: i for i, slot in enumerate((*self.slots, *self.onsets))}

    def onset(self, full: Array, key: str) -> float:
        """Return the time (s) from which a term acts, `ALWAYS` if from the beginning; `full` is (parameters,)."""
        at = self.index.get(onset_key(key))
        return ALWAYS if at is None else float(full[at])

    def slot(self, name: str) -> Slot:
        """Return the parameter called `name` or one of its aliases, or raise `ContractError` naming the nearest."""
        wanted = self.model.aliases.get(name, name)
        for slot in (*self.slots, *self.onsets):
            if slot.key == wanted:
                return slot
        known = [slot.key for slot in self.slots if slot.term is None]
        raise ContractError(
            f"{self.model.name} has no parameter {name!r}{nearest(name, known)}: it has {', '.join(known)}"
        )

    def vector(self, values: Mapping[str, float]) -> Array:
        """Return the full parameter vector; the default is `null`, or one for a shape parameter, or zero."""
        full = np.array([_find_default(slot) for slot in (*self.slots, *self.onsets)])
        for name, value in values.items():
            full[self.index[self.slot(name).key]] = value
        return full

    def states(self, active: Iterable[str]) -> int:
        """Return the number of states of the model with these terms."""
        chosen = set(active)
        return len(self.model.states) + sum(
            len(term.states) for key, term in zip(self.keys, self.terms, strict=True) if key in chosen
        )

    @cached_property
    def forces(self) -> tuple[tuple[str, Term], ...]:
        """The terms in the kernel, with their keys, in its order: forces, and sensors that have states.

        Those that need the acceleration come after all other forces, which determine it.
        """
        pairs = list(zip(self.keys, self.terms, strict=True))
        own = [(k, t) for k, t in pairs if t.acts == "motion" or (t.acts == "sensor" and t.states)]
        return tuple(sorted(own, key=lambda pair: (pair[1].acts == "sensor", "acceleration" in pair[1].needs)))

    @cached_property
    def channel_terms(self) -> Mapping[str, DriveTerm | SensorTerm]:
        """The terms of drive and sensor, by key."""
        pairs = zip(self.keys, self.terms, strict=True)
        return {key: term for key, term in pairs if isinstance(term, DriveTerm | SensorTerm)}

    @cached_property
    def inertias(self) -> tuple[int, ...]:
        """The indices of all inertias that forces move, each once."""
        moved = [name for i in self.equations.interfaces for name in (i.inertia, *(i.against or ())[1:])]
        return tuple(dict.fromkeys(self.index[name] for name in moved))

    def inertia(self, full: Array, place: Place) -> Any:
        """Return the inertia (kg or kg m^2) that a force at a place moves; of two bodies, 1 / (1/m1 + lever^2/m2).

        `full` is (parameters,) or (points, parameters).
        """
        place = self._interface(place)
        moved = [place.inertia, *(place.against[1:] if place.against else ())]
        inverse = [1.0 / full[..., self.index[name]] for name in moved]
        for lever in self.lever(full, place):
            inverse[-1] = lever**2 * inverse[-1]
        return 1.0 / np.sum(inverse, axis=0)

    def own_inertia(self, full: Array, place: Place) -> Any:
        """Return the inertia (kg or kg m^2) of the first body at a place; `full` is (parameters,)."""
        return full[..., self.index[self._interface(place).inertia]]

    @staticmethod
    def _interface(place: Place) -> Interface:
        if not isinstance(place, Interface):
            raise ContractError(f"the place {place.name} of a model lacks row and inertia: make it an `Interface`")
        return place

    def lever(self, full: Array, place: Place) -> tuple[Any, ...]:
        """Return the lever of the second body of a place, as its `motion` takes it: nothing where there is none."""
        lever = place.lever if isinstance(place, Interface) else None
        return () if lever is None else (full[..., self.index[lever]],)

    def wiring(self, active: Iterable[str]) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
        """Return the switches of the terms, and the index in `y` of the first state of each."""
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

    def functions(self, compiled: bool = True) -> Functions:
        """Return the functions `derive` and `observe` of the model, the same for all active terms."""
        return compile_functions(self.blueprint.bare) if compiled else define_plain_functions(self.blueprint)

    @cached_property
    def blueprint(self) -> Blueprint:
        """The description of the kernel of the model with all terms."""
        model = self.equations
        index = {q.name: i for i, q in enumerate(model.params)}
        places = tuple(
            KernelPlace(
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
            make_law(t, 0, model.channels.index(t.channel))
            if isinstance(t, SensorTerm)
            else make_law(t, names.index(place_of(model, t).name))
            for _, t in self.forces
        )
        sizes = (len(model.states), len(model.inputs), len(model.channels), len(model.params))
        return Blueprint(*sizes, model.rhs, model.observe, places, laws, compute_room(laws, len(places)))

    def pack(self, fulls: Array, step: float, harmonic: DriveHarmonic = SILENT, *, line: int = 1) -> Array:
        """Return the parameters of a model and its forces, (points, params): each force has its needs behind its own.

        `fulls` is (points, parameters); `step` is that of the integration (s); a law that jumps at rest takes `line`
        steps to cross its steep line. After the parameters of the model come the decay rate of a latent force, the
        step, and one over each inertia; then the numbers of each force, and the onset of each.
        """
        base = fulls[:, : len(self.model.params)]
        onsets = fulls[:, len(self.slots) : len(self.slots) + len(self.forces)]
        more = {"step": step, "finest": step, "omega": harmonic.omega, "amplitude": harmonic.amplitude}
        targets, origins, needs, ends = self._gathering
        numbers, moved = np.empty((len(fulls), ends[-1])), dict[int, Any]()
        numbers[:, targets] = fulls[:, origins]
        for column, kind, i in needs:
            if kind in ("mobility", "inertia") and i not in moved:
                moved[i] = self.inertia(fulls, self.model.places[i])
            if kind == "mobility":
                numbers[:, column] = line * step / moved[i]
            else:
                numbers[:, column] = moved[i] if kind == "inertia" else i if kind == "number" else more[kind]
        spans = zip(self.forces, itertools.pairwise(ends), strict=True)
        columns = [term.prepared(numbers[:, begin:end]) for (_, term), (begin, end) in spans]
        with np.errstate(divide="ignore"):
            inverse = [1.0 / fulls[:, i] for i in self.inertias]
        silent, steps = np.zeros(len(fulls)), np.full(len(fulls), step)
        return np.column_stack([base, silent, steps, *inverse, *columns, onsets])

    def values(self, full: Array, key: str, harmonic: DriveHarmonic) -> tuple[float, ...]:
        """Return `p` of a term outside of the kernel: its own parameters, then what it needs of the drive."""
        known = {"omega": harmonic.omega, "amplitude": harmonic.amplitude}
        return tuple(float(full[i] if kind == "own" else known.get(kind, 0.0)) for kind, i in self._sources[key])

    @cached_property
    def _gathering(self) -> tuple[NDArray[np.intp], NDArray[np.intp], list[tuple[int, str, int]], list[int]]:
        """How `pack` fills the columns of the forces, and where those of each force begin and end.

        Targets and origins of parameters, and the targets of what laws need besides, with its kind and index.
        """
        each = [self._sources[key] for key, _ in self.forces]
        flat = [(column, kind, i) for column, (kind, i) in enumerate(itertools.chain(*each))]
        own = np.array([(column, i) for column, kind, i in flat if kind == "own"], dtype=np.intp).reshape(-1, 2)
        ends = [0, *itertools.accumulate(len(sources) for sources in each)]
        return own[:, 0], own[:, 1], [entry for entry in flat if entry[1] != "own"], ends

    @cached_property
    def _sources(self) -> Mapping[str, tuple[tuple[str, int], ...]]:
        """The source of each entry of the `p` of a term: "own" with an index, "mobility" with that of its place."""
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
                yield need, self.model.places.index(place)
            elif need in ("acceleration", "force_input", "shake_input"):
                yield "number", self._input_of(need, place)
            elif need == "angle":
                yield "number", 1
            else:
                name = contact.get(need, need)
                yield ("own", self.index[name]) if name else ("number", 0)

    def _input_of(self, need: str, place: Place) -> int:
        """Return the index of the force on the body at a place, or of the base acceleration; -1 where there is none."""
        inputs, first = self.model.inputs, self.model.first_place.bodies[0]
        name = "base_acceleration" if need == "shake_input" else "force" if place.bodies[0] == first else "second_force"
        return inputs.index(name) if name in inputs and need != "acceleration" else NUMB


def _find_default(slot: Slot) -> float:
    if slot.param.null is not None:
        return slot.param.null
    if slot.param.prior.choices:
        return slot.param.prior.choices[0]
    return 1.0 if slot.param.scale == "log" else 0.0
