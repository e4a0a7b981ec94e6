"""One kernel out of a model and its terms: source text is written, kept in a cache folder, and compiled once.

Every term has a switch at run time, so one compilation serves each subset of the terms in it, with any number of
sensors, latent forces and points: a diagnosis tries a whole library without compiling again. Each law is a loop of its
own over the points, which the compiler turns into vector instructions. The same text runs as plain Python.
"""

from __future__ import annotations

import inspect
from collections import namedtuple
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numba
import numpy as np
from numba import types

from lostmotion.contracts import Array, Term, Values
from lostmotion.errors import ContractError
from lostmotion.kernels import plain, windows
from lostmotion.kernels.vector import BARE, value
from lostmotion.likelihood.adopted import adopted, defined, fingerprint, kept_as, told

FIRST = 11
"""Where the switches of the laws begin in the wires."""


@dataclass(frozen=True)
class Place:
    """Where a force acts: the row of `dydt`, the index of the inertia in `p`, and the relative motion there.

    `against` is row and inertia of a body that feels the opposite force, times the parameter with index `lever`.
    """

    row: int
    inertia: int
    motion: Callable[..., Any]
    against: tuple[int, int] | None = None
    lever: int | None = None


@dataclass(frozen=True)
class Law:
    """A term as the kernel sees it: where it acts, its functions, and how many of `w` and of `y` are its own.

    `steps` are those of its own numbers that are the step of the integration. `fields` are the numbers of the term
    itself, handed to functions that are methods and not static ones. The numbers of a law that is `prepared` may be
    many: it is handed a window on them. `felt` are those of its own numbers that are the acceleration of the body. One
    of a sensor is no force, and is told what its `channel` shows.
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


class Rows(NamedTuple):
    """Where in the block of a model its quantities begin.

    `own` are the parameters of the laws, `onset` the times (s) from which on each law acts, `pace` how fast latent
    forces fade, `step` is that of the integration (s), and `inverse` one over each inertia.
    """

    time: int
    states: int
    derivatives: int
    inputs: int
    channels: int
    params: int
    own: int
    onset: int
    pace: int
    step: int
    inverse: int
    total: int


@dataclass(frozen=True)
class Blueprint:
    """All that decides the text of a kernel: a model by its functions and numbers, and every law it may have."""

    states: int
    inputs: int
    channels: int
    params: int
    rhs: Callable[..., Any]
    observe: Callable[..., Any]
    places: tuple[Place, ...]
    laws: tuple[Law, ...]

    @cached_property
    def bodies(self) -> tuple[Place, ...]:
        """One place for each row on which forces act, the first one first."""
        return tuple({place.row: place for place in reversed(self.places)}.values())[::-1]

    @cached_property
    def inertias(self) -> tuple[int, ...]:
        """The indices in `p` of all inertias that forces move, each once."""
        moved = [index for place in self.places for index in (place.inertia, *(place.against or ())[1:])]
        return tuple(dict.fromkeys(moved))

    @cached_property
    def rows(self) -> Rows:
        """Where the quantities stand in a block; there is room for the states of all laws and a force on each body."""
        states = self.states + sum(law.states for law in self.laws) + len(self.bodies)
        width = sum(law.width for law in self.laws)
        sizes = [1, states, states, self.inputs, self.channels, self.params, width, len(self.laws), 1, 1]
        starts = np.cumsum([0, *sizes, len(self.inertias)])
        return Rows(*(int(start) for start in starts))

    def inverse(self, inertia: int) -> int:
        """Return the row of one over an inertia, that with index `inertia` in `p`."""
        return self.rows.inverse + self.inertias.index(inertia)


def law_of(term: Term, place: int, channel: int | None = None) -> Law:
    """Return a term as a law at a place of the model, or one of a sensor with its channel.

    Where its functions are methods and not static ones, they are handed the numbers among the fields of the term.
    """
    cls, numbers = type(term), {f.name: getattr(term, f.name) for f in fields(term) if f.name != "at"}  # type: ignore[arg-type]
    numbers = {name: value for name, value in numbers.items() if numeric(value)}
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


def handed(term: Term, own: Sequence[float] | Array) -> Values:
    """Return what `force` and `rate` of a term get as `p` at one point, for its parameters and needs `own`."""
    return tuple(term.prepared(np.array([own], dtype=float))[0].tolist())


def numeric(value: Any) -> bool:
    """Return whether a field of a term can be handed to a compiled law: a number, or several."""
    return isinstance(value, bool | int | float) or (
        isinstance(value, tuple) and len(value) > 0 and all(isinstance(v, int | float) for v in value)
    )


@dataclass(frozen=True)
class Functions:
    """The functions of a composed kernel as an engine calls them: addresses of compiled ones, or plain Python.

    `derive(block, wires, lanes)` writes derivatives of the states, `observe` then what the sensors see.
    """

    derive: Any
    observe: Any
    rows: Rows
    compiled: bool
    held: tuple[Any, ...] = ()


def parts_of(plan: Blueprint) -> dict[str, Callable[..., Any]]:
    """Return the functions of the plugins under the names they have in the composed text."""
    parts = {"model_rhs": plan.rhs, "model_observe": plan.observe}
    parts |= {f"motion_{i}": place.motion for i, place in enumerate(plan.places)}
    for i, law in enumerate(plan.laws):
        parts |= {f"force_{i}": law.force}
        parts |= {f"rate_{i}": law.rate} if law.states else {}
    return parts


def _pushed(plan: Blueprint, row: int, inertia: int, push: str) -> str:
    """Return the line that adds what a force does to the derivatives of one body."""
    target, inverse = plan.rows.derivatives + row, plan.inverse(inertia)
    return f"            add(block, {target}, l, {push} * value(block, {inverse}, l))"


def _law_lines(index: int, plan: Blueprint, start: int) -> list[str]:
    """Return the lines that add one law to the derivatives of all points, behind its switch."""
    law, rows = plan.laws[index], plan.rows
    place, at = plan.places[law.place], FIRST + len(plan.laws) + index
    places = [rows.step if a in law.steps else rows.own + start + a for a in range(law.width)]
    for a in law.felt:
        places[a] = rows.derivatives + place.row
    own = "(" + "".join(f"value(block, {row}, l), " for row in places) + ")"
    if law.prepared:
        own = f"column(block, {rows.own + start}, l, {law.width})"
    lever = "" if place.lever is None else f"value(block, {rows.params + place.lever}, l)"
    moved = f"column(block, {rows.states}, l, {plan.states}), u{lever and ', ' + lever}"
    states = "".join(f"value(block, {rows.states + a} + at, l), " for a in range(law.states))
    first = f"fields_{index}, " if law.fields else ""
    told = f"{first}value(block, 0, l), x, v, u, {own}, ({states})"
    lines = [
        f"    if wires[{FIRST + index}] != 0:",
        f"        at = wires[{at}]",
        "        for l in range(lanes):",
        f"            u = column(block, {rows.inputs}, l, {plan.inputs})",
        f"            x, v = motion_{law.place}({moved})",
        f"            since = value(block, 0, l) - value(block, {rows.onset + index}, l)",
        f"            begun = min(max(0.5 + 0.5 * since / value(block, {rows.step}, l), 0.0), 1.0)",
        f"            push = begun * force_{index}({told})",
        _pushed(plan, place.row, place.inertia, "push"),
    ]
    if place.against:
        lines.append(_pushed(plan, *place.against, f"-push * {lever}" if lever else "-push"))
    if law.states:
        lines.append(f"            rate_{index}({told}, column(block, {rows.derivatives} + at, l, {law.states}))")
    return lines


def _sensor_lines(index: int, plan: Blueprint, start: int) -> list[str]:
    """Return the lines that move the states of one sensor on, once all forces have acted."""
    law, rows, at = plan.laws[index], plan.rows, FIRST + len(plan.laws) + index
    own = "".join(
        f"value(block, {rows.step if a in law.steps else rows.own + start + a}, l), " for a in range(law.width)
    )
    states = "".join(f"value(block, {rows.states + a} + at, l), " for a in range(law.states))
    told = (
        f"{'fields_' + str(index) + ', ' if law.fields else ''}value(block, 0, l), shown, 0.0, u, ({own}), ({states})"
    )
    slopes = f"column(block, {rows.derivatives}, l, {plan.states})"
    return [
        f"    if wires[{FIRST + index}] != 0:",
        f"        at = wires[{at}]",
        "        for l in range(lanes):",
        f"            u = column(block, {rows.inputs}, l, {plan.inputs})",
        f"            seen = column(block, {rows.channels}, l, {plan.channels})",
        f"            model_observe({_told(plan, slopes + ', ')}, seen)",
        f"            shown = value(block, {rows.channels + (law.channel or 0)}, l)",
        f"            rate_{index}({told}, column(block, {rows.derivatives} + at, l, {law.states}))",
    ]


def _told(plan: Blueprint, dydt: str) -> str:
    """Return what the functions of a model are told, with `dydt` behind the states."""
    rows = plan.rows
    return (
        f"value(block, 0, l), column(block, {rows.states}, l, {plan.states}), {dydt}"
        f"column(block, {rows.inputs}, l, {plan.inputs}), column(block, {rows.params}, l, {plan.params})"
    )


def _latent_lines(index: int, plan: Blueprint) -> list[str]:
    """Return the lines that let a force push one body which is a state of its own, where there is one."""
    rows, body = plan.rows, plan.bodies[index]
    return [
        f"    at = wires[{FIRST + 2 * len(plan.laws) + index}]",
        "    if at >= 0:",
        "        for l in range(lanes):",
        f"            push = value(block, {rows.states} + at, l)",
        _pushed(plan, body.row, body.inertia, "push"),
        f"            pull = value(block, {rows.pace}, l) * push",
        f"            column(block, {rows.derivatives} + at, l, 1)[0] = -pull",
    ]


def _lane_text(plan: Blueprint) -> str:
    """Return the source of a model and its terms for many points at once."""
    rows = plan.rows
    starts = [sum(law.width for law in plan.laws[:i]) for i in range(len(plan.laws))]
    forces, sensors = ([i for i, law in enumerate(plan.laws) if (law.channel is None) == own] for own in (True, False))
    slopes = f"column(block, {rows.derivatives}, l, {plan.states})"
    lines = [
        '"""Written by lostmotion.likelihood.compose: a model and its terms, at many points at once."""',
        "",
        "@kernel",
        "def derive(block, wires, lanes):",
        "    for l in range(lanes):",
        f"        model_rhs({_told(plan, '')}, {slopes})",
        *(line for i in forces for line in _law_lines(i, plan, starts[i])),
        *(line for i in range(len(plan.bodies)) for line in _latent_lines(i, plan)),
        *(line for i in sensors for line in _sensor_lines(i, plan, starts[i])),
        "",
        "@kernel",
        "def observe(block, wires, lanes):",
        "    for l in range(lanes):",
        f"        seen = column(block, {rows.channels}, l, {plan.channels})",
        f"        model_observe({_told(plan, slopes + ', ')}, seen)",
    ]
    return "\n".join(lines) + "\n"


def fields_of(plan: Blueprint) -> dict[str, Any]:
    """Return the numbers of the terms whose functions are methods, under the names they have in a composed text."""
    return {f"fields_{i}": law.fields for i, law in enumerate(plan.laws) if law.fields}


@lru_cache(maxsize=64)
def functions(plan: Blueprint, compiled: bool = True) -> Functions:
    """Return the functions of a plan for many points at once, compiled, or as plain Python."""
    text, parts, numbers = _lane_text(plan), parts_of(plan), fields_of(plan)
    if not compiled:
        space = defined(text, "<slow twin>", {**parts, **numbers, **plain.SPACE, "kernel": plain.jit})
        return Functions(told(space["derive"]), told(space["observe"]), plan.rows, False)
    also = "".join(f"{name}{fingerprint(part)}" for name, part in sorted(parts.items())) + repr(numbers)
    path = kept_as(text, also)
    given = {name: adopted(part, path.stem) for name, part in parts.items()}
    offered = {"column": windows.column, "value": value, "add": windows.add}
    signature = types.void(windows.BLOCK, windows.NUMBERS, types.intp)
    kernel = numba.njit(signature, **BARE, cache=True)
    space = told(defined)(text, str(path), {**given, **numbers, **offered, "kernel": kernel})
    both = [space[name].overloads[signature.args] for name in ("derive", "observe")]
    addresses = [made.library.get_pointer_to_function(made.fndesc.llvm_func_name) for made in both]
    return Functions(addresses[0], addresses[1], plan.rows, True, tuple(both))
