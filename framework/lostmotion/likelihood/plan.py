"""The description of a kernel: a model by its functions and numbers, and all laws that it may have."""

from __future__ import annotations

import dis
import inspect
from collections import namedtuple
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from lostmotion.contracts import Array, Term, Values
from lostmotion.errors import ContractError

ROOM = 16
"""Additional states for which a block has room; where laws have more, in multiples of this."""


@dataclass(frozen=True)
class KernelPlace:
    """A place where a force acts: the row of `dydt`, the index of the inertia in `p`, and the relative motion there.

    `against` is row and inertia of a body that feels the opposite force, times the parameter with index `lever`.
    """

    row: int
    inertia: int
    motion: Callable[..., Any]
    against: tuple[int, int] | None = None
    lever: int | None = None


@dataclass(frozen=True)
class Law:
    """A term as the kernel sees it: its place, its functions, and its numbers of parameters (`width`) and of states.

    `steps` are the indices of its numbers that are the step of the integration. `fields` are the numbers of the term
    itself, passed to functions that are methods and not static ones. A law that is `prepared` may have many numbers: it
    receives a view on them. `felt` are the indices of its numbers that are the acceleration of the body. A law of a
    sensor is not a force, and receives what its `channel` shows.
    """

    place: int
    width: int
    states: int
    force: Callable[..., Any]
    rate: Callable[..., Any]
    steps: tuple[int, ...] = ()
    fields: tuple[Any, ...] | None = None
    prepared: bool = False
    felt: tuple[int, ...] = ()
    channel: int | None = None

    @cached_property
    def reads_inputs(self) -> bool:
        """Whether its functions read `u`, the inputs."""
        parts = (self.force, *((self.rate,) if self.states else ()))
        return any(_reads_argument(getattr(part, "py_func", part), 3 + bool(self.fields)) for part in parts)


def _reads_argument(function: Any, number: int) -> bool:
    """Return whether a function reads one of its arguments."""
    code = function.__code__
    name = code.co_varnames[number]
    loads = (step.argval for step in dis.get_instructions(code) if step.opname.startswith("LOAD_"))
    return name in code.co_cellvars or any(name in (one if isinstance(one, tuple) else (one,)) for one in loads)


class Rows(NamedTuple):
    """The first row of each quantity in the block of a model.

    `desk` holds the arguments of the law that is computed: time, position, velocity and force, then its states, their
    rates, and the inputs. `params` are those of the model, `pace` the decay rate of latent forces, `step` that of the
    integration (s), `inverse` one over each inertia, `own` the parameters of the laws, and `onset` the times (s) from
    which each law acts. All but the last two are the same for a model with any laws.
    """

    time: int
    states: int
    derivatives: int
    inputs: int
    channels: int
    desk: int
    params: int
    pace: int
    step: int
    inverse: int
    own: int
    onset: int
    total: int


@dataclass(frozen=True)
class Blueprint:
    """The description of the text of a kernel: a model by its functions and numbers, and all laws that it may have."""

    states: int
    inputs: int
    channels: int
    params: int
    rhs: Callable[..., Any]
    observe: Callable[..., Any]
    places: tuple[KernelPlace, ...]
    laws: tuple[Law, ...]
    room: int = ROOM
    """States of laws and of latent forces that have a place in a block."""

    @cached_property
    def bare(self) -> Blueprint:
        """The same model without laws, with room for their states."""
        return replace(self, laws=())

    @cached_property
    def bodies(self) -> tuple[KernelPlace, ...]:
        """One place for each row on which forces act, the first one first."""
        return tuple({place.row: place for place in reversed(self.places)}.values())[::-1]

    @cached_property
    def inertias(self) -> tuple[int, ...]:
        """The indices in `p` of all inertias that forces move, each once."""
        moved = [index for place in self.places for index in (place.inertia, *(place.against or ())[1:])]
        return tuple(dict.fromkeys(moved))

    @cached_property
    def rows(self) -> Rows:
        """The rows of the quantities in a block, with room for the states of all laws and a force on each body."""
        states = self.states + self.room
        sizes = [1, states, states, self.inputs, self.channels, 4 + 2 * states + self.inputs]
        sizes += [self.params, 1, 1, len(self.inertias), sum(law.width for law in self.laws), len(self.laws)]
        return Rows(*(int(start) for start in np.cumsum([0, *sizes])))

    @cached_property
    def starts(self) -> tuple[int, ...]:
        """The row of the first own number of each law."""
        widths = [law.width for law in self.laws]
        return tuple(self.rows.own + sum(widths[:i]) for i in range(len(widths)))

    def inputs_of(self, law: Law) -> int:
        """Return the number of inputs that a law receives: none where it reads none."""
        return self.inputs if law.reads_inputs else 0

    def inverse(self, inertia: int) -> int:
        """Return the row of one over an inertia, that with index `inertia` in `p`."""
        return self.rows.inverse + self.inertias.index(inertia)


def compute_room(laws: Sequence[Law], bodies: int) -> int:
    """Return the number of rows that a block needs for the states of laws and for a force on each body."""
    needed = sum(law.states for law in laws) + bodies
    return ROOM * max(-(-needed // ROOM), 1)


def make_law(term: Term, place: int, channel: int | None = None) -> Law:
    """Return a term as a law at a place of the model, or one of a sensor with its channel.

    Where its functions are methods and not static ones, they receive the numbers among the fields of the term.
    """
    cls, numbers = type(term), {f.name: getattr(term, f.name) for f in fields(term) if f.name != "at"}  # type: ignore[arg-type]
    numbers = {name: value for name, value in numbers.items() if is_numeric(value)}
    own = [name for name in ("force", "rate") if not isinstance(inspect.getattr_static(cls, name), staticmethod)]
    made = namedtuple("Fields", numbers)(**numbers) if own else None
    if own and not numbers:
        raise ContractError(
            f"{term.name} takes its own fields in {own[0]}, and has none that are numbers: make it static"
        )
    steps, felt = (
        tuple(len(term.params) + i for i, need in enumerate(term.needs) if need == name)
        for name in ("step", "acceleration")
    )
    prepared = cls.prepared is not Term.prepared
    if prepared and (steps or felt):
        raise ContractError(
            f"{term.name} prepares its numbers and needs `step` or `acceleration`, which change: let it do one of both"
        )
    width = term.prepared(np.ones((1, len(term.params) + len(term.needs)))).shape[1]
    return Law(place, width, len(term.states), cls.force, cls.rate, steps, made, prepared, felt, channel)


def prepare_values(term: Term, own: Sequence[float] | Array) -> Values:
    """Return the argument `p` of `force` and `rate` of a term at one point, for its parameters and needs `own`."""
    return tuple(term.prepared(np.array([own], dtype=float))[0].tolist())


def is_numeric(value: Any) -> bool:
    """Return whether a field of a term can be passed to a compiled law: a number, or several."""
    return isinstance(value, bool | int | float) or (
        isinstance(value, tuple) and len(value) > 0 and all(isinstance(v, int | float) for v in value)
    )
