"""The kernels of a model and of its laws: source text is written, cached in a folder, and compiled once.

A model is compiled without any law: its kernel calls the active laws by their addresses, which are in the wires. Each
law is a kernel of its own, independent of the model, and is compiled once for all models and places. So one compilation
serves every subset of the terms, and a new model needs no compilation of the library. The points are the innermost loop
of both, which the compiler turns into vector instructions. The same text runs as plain Python.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import numba
from numba import types

from lostmotion.kernels import plain, vector, windows
from lostmotion.kernels.vector import BARE
from lostmotion.likelihood.adopted import adopt_function, compute_fingerprint, define_module, explain_errors, store_text
from lostmotion.likelihood.kernels import read_source
from lostmotion.likelihood.plan import Blueprint, Law

FIRST = 11
"""Position in the wires of the number of forces and the number of sensor laws; then the offset of each table."""
X, V, PUSH, STATES = 1, 2, 3, 4
"""Rows of the desk of a law: position, velocity, force and first state."""
HEAD = 7
"""Entries of the table of a law before its copies: address, number, place, own row, onset row, copies, returns."""
SENSOR = -1
"""The place of a law that integrates the states of a sensor."""

_OFFERED = ("value", "assign", "load", "store", "larger", "select", "WIDTH")
_KERNEL = types.void(windows.BLOCK, windows.NUMBERS, types.intp)
_LAW = types.void(windows.BLOCK, windows.BLOCK, types.intp)


@dataclass(frozen=True)
class Functions:
    """The functions of a model as a filter calls them: addresses of compiled ones, or plain Python.

    `derive(block, wires, lanes)` writes the derivatives of the states, `observe` then the channels.
    """

    derive: Any
    observe: Any
    held: tuple[Any, ...] = ()


def _write_push(plan: Blueprint, row: int, inertia: int, push: str) -> str:
    """Return the line that adds the effect of a force to the derivatives of one body."""
    target, inverse = plan.rows.derivatives + row, plan.inverse(inertia)
    return f"            store(block, {target}, o, load(block, {target}, o) + {push} * load(block, {inverse}, o))"


def _write_place(index: int, plan: Blueprint) -> tuple[list[str], list[str]]:
    """Return the lines that give a law the motion at a place, and those that apply its force to the bodies there."""
    place, rows = plan.places[index], plan.rows
    lever = "" if place.lever is None else f"(block, {rows.params + place.lever}, "
    moved = f"column(block, {rows.states}, l, {plan.states}), u{lever and f', value{lever}l)'}"
    before = [
        f"    if place == {index}:",
        "        for l in range(lanes):",
        f"            u = column(block, {rows.inputs}, l, {plan.inputs})",
        f"            x, v = motion_{index}({moved})",
        f"            assign(block, {rows.desk + X}, l, x)",
        f"            assign(block, {rows.desk + V}, l, v)",
    ]
    after = [
        f"    if place == {index}:",
        "        for o in range(0, lanes, WIDTH):",
        "            since = load(block, 0, o) - load(block, wires[at + 4], o)",
        f"            begun = larger(0.5 + 0.5 * since / load(block, {rows.step}, o), 0.0)",
        "            begun = select(begun > 1.0, 1.0, begun)",
        f"            push = begun * load(block, {rows.desk + PUSH}, o)",
        _write_push(plan, place.row, place.inertia, "push"),
    ]
    if place.against:
        share = f"-1.0 * push * load{lever}o)" if lever else "-1.0 * push"
        after.append(_write_push(plan, *place.against, share))
    return before, after


def _write_latent(index: int, plan: Blueprint) -> list[str]:
    """Return the lines for a latent force on one body, which is a state of its own."""
    rows, body = plan.rows, plan.bodies[index]
    return [
        f"    latent = wires[{FIRST + 2 + index}]",
        "    if latent >= 0:",
        "        for o in range(0, lanes, WIDTH):",
        f"            push = load(block, {rows.states} + latent, o)",
        _write_push(plan, body.row, body.inertia, "push"),
        f"            store(block, {rows.derivatives} + latent, o, -1.0 * load(block, {rows.pace}, o) * push)",
    ]


def _write_arguments(plan: Blueprint, dydt: str) -> str:
    """Return the arguments of the functions of a model, with `dydt` after the states."""
    rows = plan.rows
    return (
        f"value(block, 0, l), column(block, {rows.states}, l, {plan.states}), {dydt}"
        f"column(block, {rows.inputs}, l, {plan.inputs}), column(block, {rows.params}, l, {plan.params})"
    )


def _write_observe(plan: Blueprint) -> list[str]:
    """Return the lines that write the channels of a model, indented by one more level."""
    slopes = f"column(block, {plan.rows.derivatives}, l, {plan.states})"
    return [
        "    for l in range(lanes):",
        f"        seen = column(block, {plan.rows.channels}, l, {plan.channels})",
        f"        model_observe({_write_arguments(plan, slopes + ', ')}, seen)",
    ]


def write_model(plan: Blueprint) -> str:
    """Return the source of a model that calls its laws, for many points at once."""
    rows, tables = plan.rows, FIRST + 2 + len(plan.bodies)
    slopes = f"column(block, {rows.derivatives}, l, {plan.states})"
    both = [_write_place(i, plan) for i in range(len(plan.places))]
    lines = [
        '"""Written by lostmotion.likelihood.compose: a model that calls its laws, at many points at once."""',
        "",
        "@part",
        "def copy_rows(block, wires, first, count, lanes):",
        "    for c in range(count):",
        "        for o in range(0, lanes, WIDTH):",
        "            store(block, wires[first + 2 * c + 1], o, load(block, wires[first + 2 * c], o))",
        "",
        "@part",
        "def apply_law(block, wires, at, lanes):",
        "    place = wires[at + 2]",
        *(line for before, _ in both for line in before),
        f"    copy_rows(block, wires, at + {HEAD}, wires[at + 5], lanes)",
        f"    own, desk = offset_rows(block, wires[at + 3]), offset_rows(block, {rows.desk})",
        "    failed = invoke_law(wires, at, own, desk, lanes)",
        *(line for _, after in both for line in after),
        f"    copy_rows(block, wires, at + {HEAD} + 2 * wires[at + 5], wires[at + 6], lanes)",
        "    return failed",
        "",
        "@kernel",
        "def derive(block, wires, lanes):",
        "    failed = 0",
        "    for l in range(lanes):",
        f"        model_rhs({_write_arguments(plan, '')}, {slopes})",
        "    for o in range(0, lanes, WIDTH):",
        f"        store(block, {rows.desk}, o, load(block, 0, o))",
        f"    for i in range(wires[{FIRST}]):",
        f"        failed |= apply_law(block, wires, wires[{tables} + i], lanes)",
        *(line for i in range(len(plan.bodies)) for line in _write_latent(i, plan)),
        f"    if wires[{FIRST + 1}] > 0:",
        *(f"    {line}" for line in _write_observe(plan)),
        f"    for i in range(wires[{FIRST}], wires[{FIRST}] + wires[{FIRST + 1}]):",
        f"        failed |= apply_law(block, wires, wires[{tables} + i], lanes)",
        "    if failed != 0:",
        '        raise ArithmeticError("a law raised an error")',
        "",
        "@kernel",
        "def observe(block, wires, lanes):",
        *_write_observe(plan),
    ]
    return "\n".join(lines) + "\n"


def write_law(law: Law, inputs: int) -> str:
    """Return the source of a law for many points at once; it reads its own numbers and its desk."""
    own = "(" + "".join(f"value(own, {a}, l), " for a in range(law.width)) + ")"
    if law.prepared:
        own = f"column(own, 0, l, {law.width})"
    states = "".join(f"value(desk, {STATES + a}, l), " for a in range(law.states))
    moving = f"value(desk, {V}, l)" if law.channel is None else "0.0"
    told = f"{'fields, ' if law.fields else ''}t, x, v, u, {own}, ({states})"
    lines = [
        '"""Written by lostmotion.likelihood.compose: one law, at many points at once."""',
        "",
        "@kernel",
        "def law(own, desk, lanes):",
        "    for l in range(lanes):",
        f"        t, x, v = value(desk, 0, l), value(desk, {X}, l), {moving}",
        f"        u = column(desk, {STATES + 2 * law.states}, l, {inputs})",
    ]
    if law.channel is None:
        lines.append(f"        assign(desk, {PUSH}, l, force({told}))")
    if law.states:
        lines.append(f"        rate({told}, column(desk, {STATES + law.states}, l, {law.states}))")
    return "\n".join(lines) + "\n"


def _list_model_parts(plan: Blueprint) -> dict[str, Callable[..., Any]]:
    """Return the functions of a model under the names they have in its text."""
    motions = {f"motion_{i}": place.motion for i, place in enumerate(plan.places)}
    return {"model_rhs": plan.rhs, "model_observe": plan.observe, **motions}


def _list_parts(law: Law) -> dict[str, Callable[..., Any]]:
    """Return the functions of a law under the names they have in its text."""
    force = {"force": law.force} if law.channel is None else {}
    return {**force, **({"rate": law.rate} if law.states else {})}


def _compile_text(text: str, parts: Mapping[str, Any], numbers: Mapping[str, Any], signature: Any) -> dict[str, Any]:
    """Return the kernels of a text by name, compiled or from the cache."""
    also = "".join(f"{name}{compute_fingerprint(part)}" for name, part in sorted(parts.items())) + repr(numbers)
    path = store_text(text, also + read_source("vector", "windows", "elementary"))
    given = {name: adopt_function(part, path.stem) for name, part in parts.items()}
    offered = {name: getattr(vector, name) for name in _OFFERED}
    offered |= {"column": windows.column, "offset_rows": windows.offset_rows, "invoke_law": windows.invoke_law}
    kernel = numba.njit(signature, **BARE, cache=True)
    part = numba.njit(**BARE)
    space = explain_errors(define_module)(
        text, str(path), {**given, **numbers, **offered, "kernel": kernel, "part": part}
    )
    kernels = {name: getattr(made, "overloads", {}) for name, made in space.items()}
    return {name: made[signature.args] for name, made in kernels.items() if signature.args in made}


def _find_address(made: Any) -> int:
    return int(made.library.get_pointer_to_function(made.fndesc.llvm_func_name))


@cache  # wires hold addresses alone: what stands there has to stay
def compile_law(law: Law, inputs: int) -> tuple[int, Any]:
    """Return the address of the compiled kernel of a law, and the object that keeps it in memory."""
    numbers = {"fields": law.fields} if law.fields else {}
    made = _compile_text(write_law(law, inputs), _list_parts(law), numbers, _LAW)["law"]
    return _find_address(made), made


def _define_plain_law(law: Law, inputs: int) -> Callable[..., Any]:
    """Return a law as plain Python."""
    space = {**_list_parts(law), "fields": law.fields, **plain.SPACE, "kernel": plain.jit}
    return explain_errors(define_module(write_law(law, inputs), "<slow twin of a law>", space)["law"])


@lru_cache(maxsize=64)
def compile_functions(plan: Blueprint) -> Functions:
    """Return the compiled functions of a model for many points at once, for any of its laws."""
    made = _compile_text(write_model(plan), _list_model_parts(plan), {}, _KERNEL)
    return Functions(_find_address(made["derive"]), _find_address(made["observe"]), tuple(made.values()))


@lru_cache(maxsize=64)
def define_plain_functions(plan: Blueprint) -> Functions:
    """Return the functions of a model with its laws as plain Python, equivalent to the compiled ones."""
    laws = [_define_plain_law(law, plan.inputs_of(law)) for law in plan.laws]

    def invoke_law(wires: Any, at: int, own: Any, desk: Any, lanes: int) -> int:
        laws[wires[at + 1]](own, desk, lanes)
        return 0

    given = {**_list_model_parts(plan), **plain.SPACE, "invoke_law": invoke_law, "kernel": plain.jit, "part": plain.jit}
    space = define_module(write_model(plan), "<slow twin>", given)
    return Functions(explain_errors(space["derive"]), explain_errors(space["observe"]))
