"""The nine kinds of plugin. Subclass one of them directly, as a frozen dataclass, and name the class in a hook.

`rhs` and `observe` of a `Model`, `force` and `rate` of a `Term` are scalar Python functions on NumPy arrays. The
framework compiles them with numba into one kernel, so they may use arithmetic, branches and `math`, but no NumPy
functions and no objects. `step` and `observe` of a `Dynamics` are called as they are. A quantity that is *estimated*
is an entry of `p`, not a field. `lostmotion plugins check NAME` tests all rules. Values are in SI units.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, Self

from lostmotion.errors import ContractError, nearest
from lostmotion.methods import Denoiser, Embedder, Quantifier, Surrogate
from lostmotion.noises import Noise, NoiseBlock, NoiseParameter, SensorScales
from lostmotion.parts import (
    PSEUDO_NEEDS,
    Array,
    Drive,
    Group,
    Input,
    Interface,
    Motion,
    Param,
    Place,
    TermPrior,
    Values,
)
from lostmotion.quantities import Dimension, quantity_of
from lostmotion.simulators import Simulator
from lostmotion.subjects import Attractors, Data, Flow, Motions, Orbit, Series

__all__ = [
    "KINDS", "PSEUDO_NEEDS", "Array", "Assembly", "Attractors", "Data", "Denoiser", "Drive", "DriveTerm", "Dynamics",
    "Embedder", "Flow", "Group", "Input", "Interface", "Machine", "Model", "Motion", "Motions", "Noise", "NoiseBlock",
    "NoiseParameter", "Orbit", "Param", "Place", "Quantifier", "SensorScales", "SensorTerm", "Series",
    "Simulator", "Surrogate", "Term", "TermPrior", "Values", "place_of"]  # fmt: skip

_NOWHERE = Place("", lambda y, u: (0.0, 0.0))
UNKNOWN_TO_STEPS = frozenset({"acceleration", "force_input", "shake_input"})
"""Needs of a term that a machine without equations cannot tell."""


class Machine(ABC):
    """What all machines declare: a `Model`, written as equations, and a `Dynamics`, which can only be stepped.

    `states` names the entries of the state, `inputs` those of `u`: "force", "second_force" and so on, "base_position"
    followed by "base_velocity", or "base_acceleration". An input that nothing drives is zero. `channels` names what
    sensors can show; the last part of a name is its quantity ("second_position"). `params` names the entries of `p`,
    `aliases` maps further names to these, `groups` are dimensionless numbers. `motion` is "translation" (N, m) or
    "rotation" (N m, rad). Where the machine may be of both, it is a field, and `motions` lists both. `paper` cites the
    source.
    """

    name: ClassVar[str]
    paper: ClassVar[str]
    motion: Motion
    motions: ClassVar[tuple[str, ...]] = ()
    states: ClassVar[tuple[str, ...]]
    inputs: ClassVar[tuple[str, ...]]
    channels: ClassVar[tuple[str, ...]]
    params: ClassVar[tuple[Param, ...]]
    aliases: ClassVar[Mapping[str, str]] = {}
    groups: ClassVar[tuple[Group, ...]] = ()

    @property
    @abstractmethod
    def places(self) -> tuple[Place, ...]:
        """The places where terms may act."""

    @property
    def first_place(self) -> Place:
        """The place to which natural sizes refer, and the terms of a drive."""
        return self.places[0]

    @property
    def first_body(self) -> tuple[int, int]:
        """The states that are position and velocity of the first body, to which natural sizes refer."""
        position = next((i for i, name in enumerate(self.states) if quantity_of(name) == "position"), 0)
        rate = self.find_rate(position)
        return position, position if rate is None else rate

    def find_rate(self, state: int) -> int | None:
        """Return the state that is the velocity of another one, found by its name; None where there is none."""
        name = self.states[state]
        rates = (f"{name.removesuffix('position')}velocity", f"{name}.velocity", f"{name}_velocity")
        return next((self.states.index(rate) for rate in rates if rate in self.states), None)

    @property
    def driven(self) -> tuple[str, ...]:
        """The names of the inputs that a single drive sets: the first, and for a base position also its velocity."""
        return self.inputs[: 2 if self.inputs[:1] == ("base_position",) else 1]

    def turned(self, motion: str) -> Self:
        """Return the machine for "translation" or "rotation"; raise `ContractError` where it does not support that."""
        if motion not in (known := self.motions or (self.motion,)):
            words = " or ".join(known)
            raise ContractError(f"{self.name} is of {words}, not of {motion}: ask for {words}, or another model")
        return self if motion == self.motion else replace(self, motion=motion)  # type: ignore[type-var]

    def __add__(self, term: Term) -> Assembly:
        return Assembly(self) + term


class Dynamics(Machine):
    """A machine that can be stepped, in NumPy: who integrates it, and how, is its own business.

    `step` and `observe` get many rows at once, each an independent machine: `x` (rows, states), `u` (rows, inputs), `f`
    (rows, places), the generalised forces of terms and of the unknown at `places`, and `p` (rows, params). None of them
    may be changed. Rows do not depend on each other. The mass matrix belongs to the machine: a force at a place enters
    `step` like a force of the machine itself. Results that are not finite mark a divergence. A state or channel that
    ends in `.velocity` or `_velocity` is the rate of that before the ending. `plugins/template` has an arm of two
    joints.
    """

    @abstractmethod
    def step(self, x: Array, u: Array, f: Array, p: Array, dt: float) -> Array:
        """Return the states (rows, states) after `dt` s, in SI units, with forces `f` and inputs `u` held meanwhile.

        Any `dt` down to the smallest must be possible; without it nothing moves. `u` is the mean over `dt`.
        """

    @abstractmethod
    def observe(self, x: Array, u: Array, f: Array, p: Array) -> Array:
        """Return the channels (rows, channels) at states `x`, in SI units; an acceleration depends on `u` and `f`."""


class Model(Machine):
    """A machine as a system of first-order equations under *measured* inputs.

    `states` names the entries of `y`, position and velocity of the first body in front. With a "base_acceleration" the
    motion is relative to the base, while an accelerometer shows both. `channels` names the entries that `observe`
    writes, `interfaces` the places where terms may act. `plugins/template` has a complete example.
    """

    interfaces: ClassVar[tuple[Interface, ...]]

    @property
    def places(self) -> tuple[Interface, ...]:
        """The interfaces."""
        return self.interfaces

    @property
    def first_place(self) -> Interface:
        """The first of the interfaces."""
        return self.interfaces[0]

    @property
    def first_body(self) -> tuple[int, int]:
        """The first two states."""
        return 0, 1

    def find_rate(self, state: int) -> int | None:
        """Return the state that is the velocity of another one; the next one where no name tells it."""
        following = state + 1 if state + 1 < len(self.states) else None
        found = super().find_rate(state)
        return following if found is None else found

    @staticmethod
    @abstractmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        """Write the time derivative of the states `y` (states,) into every entry of `dydt` (states,), in SI units.

        `t` is the time (s), `u` (inputs,) and `p` (params,); none of the arguments but `dydt` may be changed. For
        m x'' + c x' = u: `dydt[0] = y[1]` and `dydt[1] = (u[0] - p[1] * y[1]) / p[0]`.
        """

    @staticmethod
    @abstractmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        """Write the values of the channels into every entry of `seen` (channels,), in SI units.

        `dydt` (states,) is the derivative with the forces of all terms: `seen[2] = dydt[1]` shows the acceleration.
        """

    @classmethod
    def exact(cls, values: Mapping[str, float], drive: Drive, start: Array | None) -> Flow | None:
        """Return the closed-form flow under a `drive` from `start` (states,), or None; `values` maps all parameters."""
        return None


class Term(ABC):
    """A physical effect that a model may lack: a force at an interface, with states of its own where it needs them.

    `at` names the interface, `physics` is a sentence with the parameters in braces, `formula` the law. A parameter with
    a `null` is an amplitude: where all of these are at their null, the force is exactly zero. `p` holds the values of
    `params`, then of `needs`: parameters that the interface `holds`, or names in `PSEUDO_NEEDS`. `states` are names of
    own states, which start at zero; or a mapping from each name to the size at the start, which is a dimension or the
    name of an own parameter, None for zero. `equals` names terms that no recording of a machine with constant
    parameters can tell from this one, `extends` simpler laws that it contains. `force` and `rate` are static, or
    methods that read numeric fields.
    """

    at: str
    name: ClassVar[str]
    physics: ClassVar[str]
    formula: ClassVar[str]
    paper: ClassVar[str]
    params: ClassVar[tuple[Param, ...]]
    states: ClassVar[Mapping[str, Dimension | str | None] | tuple[str, ...]] = ()
    needs: ClassVar[tuple[str, ...]] = ()
    equals: ClassVar[tuple[str, ...]] = ()
    extends: ClassVar[tuple[str, ...]] = ()

    @staticmethod
    @abstractmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return the generalised force (N or N m) on the body, positive in the direction of positive motion.

        `t` is the time (s), `x` and `v` the relative position and velocity at the interface (friction is negative for
        v > 0), `u` (inputs,), `p` the values of `params` and `needs`, `s` those of `states`. The result is finite.
        """

    @staticmethod  # noqa: B027 - most terms have no states of their own
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        """Write the time derivative of the own states into every entry of `dsdt` (states,), where there are any."""

    def prepared(self, p: Array) -> Array:
        """Return the numbers (points, any) that `force` gets as `p`, computed once for each point of `p`."""
        return p

    @staticmethod
    def derived(p: Values) -> Mapping[Param, float]:
        """Return further numbers, the same ones for all `p`: for instance a phase, from two amplitudes."""
        return {}

    @staticmethod
    def shifted(p: Values, by: float) -> Values:
        """Return `params` with which the force at x - `by` (m or rad) is that of `p` at x: a wave has another phase."""
        return p

    def commoner(self, values: Mapping[str, float]) -> Mapping[str, Mapping[str, float]]:
        """Return more common terms whose sum is the same force at these values, `{name: {param: value}}`, or `{}`.

        The diagnosis then reports these: friction with two nearly equal levels is dry friction plus a constant force.
        """
        return {}

    @property
    def acts(self) -> Literal["motion", "drive", "sensor"]:
        """On what the term acts: a `DriveTerm` or a `SensorTerm` belongs to a channel, any other term is a force."""
        return "motion"

    @property
    def sizes(self) -> tuple[Dimension | str | None, ...]:
        """The size at the start of each of the states."""
        return tuple(self.states.values()) if isinstance(self.states, Mapping) else (None,) * len(self.states)

    @property
    def marked(self) -> bool:
        """Whether the term is read from the stored values (`SensorTerm.quantisation`) and therefore not fitted."""
        return False

    def null(self) -> dict[str, float]:
        """Return the null of each amplitude, by name: with these values the term has no effect."""
        return {q.name: q.null for q in self.params if q.null is not None}

    def fits(self, model: Machine) -> bool:
        """Return whether the term can act in `model`: its place, kind of motion and `needs` exist there."""
        try:
            return bool(place_of(model, self))
        except ContractError:
            return False


class _NoForce(Term):
    """A term that changes an input or a reading and exerts no force."""

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return zero."""
        return 0.0


class DriveTerm(_NoForce):
    """An effect between the recorded input and the input that acts on the machine, for instance a delay. No force.

    `at` is the name of the input. Example of a delayed drive, `true`: `return u(t - p[0], order)`.
    """

    @property
    def acts(self) -> Literal["drive"]:
        """The drive."""
        return "drive"

    @staticmethod
    @abstractmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        """Return the acting input at times `t` (s from the start, any shape), or for `order` 1 its time derivative.

        `u(t, order)` is the recorded input, `p` is as for `Term.force`. At the null the result equals `u(t, order)`.
        """


class SensorTerm(_NoForce):
    """An effect between the motion and its recorded readings, for instance a wrong gain. No force.

    The sensor reads `rounded(gain * bent(x) + offset)`, `delay` s late. Override what applies; the defaults have no
    effect. Where the term has states, the sensor reads the first of them, and `rate` gets the value of `channel` (a
    field) as `x`. A `relative` term is tried only where there are several sensors. `p` is as for `Term.force`.
    """

    channel: str = "position"
    relative: ClassVar[bool] = False

    @property
    def acts(self) -> Literal["sensor"]:
        """A sensor."""
        return "sensor"

    @staticmethod
    def gain(p: Values) -> float:
        """Return the gain, reading per value of the channel (dimensionless); 1 for an exact sensor."""
        return 1.0

    @staticmethod
    def offset(p: Values) -> float:
        """Return the reading at zero, in the unit of the channel."""
        return 0.0

    @staticmethod
    def delay(p: Values) -> float:
        """Return the delay of the reading, in s."""
        return 0.0

    @staticmethod
    def bent(x: Array, p: Values) -> Array:
        """Return the nonlinear reading for values `x` of any shape, with that shape; it increases with `x`."""
        return x

    @staticmethod
    def rounded(z: Array, p: Values) -> Array:
        """Return the readings `z` (samples,) as a file stores them, for instance in steps of a converter."""
        return z

    @staticmethod
    def quantisation(z: Array) -> tuple[Values, Values]:
        """Return the parameters that values `z` (samples,) reveal, and their errors (sd), or two empty tuples."""
        return (), ()

    @staticmethod
    def scatter(p: Values) -> float:
        """Return the standard deviation of the error that this rounding adds, in the unit of the channel."""
        return 0.0

    @property
    def marked(self) -> bool:
        """Whether the term is read from the stored values, because it overrides `quantisation`."""
        return type(self).quantisation is not SensorTerm.quantisation


@dataclass(frozen=True)
class Assembly:
    """A model plus named terms, `model + term + term`: the form in which machines are simulated, fitted and drawn."""

    model: Machine
    terms: tuple[Term, ...] = ()

    def __add__(self, term: Term) -> Assembly:
        place_of(self.model, term)
        if any((t.name, t.at) == (term.name, term.at) for t in self.terms):
            raise ContractError(f"{term.name} at {term.at} is in the model already: add it once, or at another place")
        return replace(self, terms=(*self.terms, term))

    @property
    def label(self) -> str:
        """The sum as text, for instance `lin_backlash + coulomb_friction`."""
        return " + ".join([self.model.name, *(t.name for t in self.terms)])


def place_of(model: Machine, term: Term) -> Place:
    """Return the place of `model` at which `term` acts; raise `ContractError` that says what is missing there."""
    beside = model.inputs if term.acts == "drive" else (term.at,)
    named = {name: replace(_NOWHERE, name=name) for name in (term.acts, *beside)}
    places = {i.name: i for i in model.places} if term.acts == "motion" else named
    if term.at not in places:
        raise ContractError(
            f"{term.name} acts at {term.at!r}, but {model.name} has {', '.join(places)}{nearest(term.at, places)}"
        )
    place = places[term.at]
    known = {*place.holds, *PSEUDO_NEEDS} - (set() if place.stiffness else {"stiffness", "play"})
    known -= UNKNOWN_TO_STEPS if isinstance(model, Dynamics) else set()
    known -= set() if model.motion == "rotation" else {"angle"}
    if lacking := [n for n in term.needs if n not in known]:
        raise ContractError(
            f"{term.name} needs {', '.join(lacking)}, which {model.name} ({model.motion}) does not have at {term.at}"
        )
    return place


KINDS: Mapping[str, type[Any]] = {
    c.__name__.lower(): c for c in (Model, Dynamics, Term, Embedder, Quantifier, Surrogate, Denoiser, Noise, Simulator)
}
