"""A model made of equations of motion: a class like any other, that is compiled, checked and fitted in the same way.

Its text becomes functions of arithmetic on indexed numbers; no name of the text is ever looked up or called.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar, Literal

from lostmotion.case import WRITTEN
from lostmotion.contracts import Interface, Model, Motion, Param
from lostmotion.equations import BodyEquation, Equations, Node, Spring, equations_of

_FUNCTIONS = {
    "gap": "({1} * ({0} - min(max({0}, -{2}), {2})))",
    "stop": "({1} * max({0} - {2}, 0.0))",
    "sat": "min(max({0}, -{1}), {1})",
    "sign": "(1.0 if {0} > 0.0 else (-1.0 if {0} < 0.0 else 0.0))",
    "abs": "abs({0})",
    "min": "min({0}, {1})",
    "max": "max({0}, {1})",
}
"""What functions of an equation become that are none of `math`."""
SQUARES = 6
"""Whole powers up to this one are products."""


def is_equation(text: str) -> bool:
    """Return whether a text is meant as an equation, and not as the name of a model."""
    return bool(set("=*/+^('’′") & set(text))


def model_of(
    texts: str | Sequence[str],
    *,
    units: Mapping[str, str] | None = None,
    motion: Motion | None = None,
    params: Collection[str] = (),
) -> type[Model]:
    """Return the class of a model from its equations of motion, `m*x'' + c*x' + k*x = force`.

    `units` (SI, by parameter) are needed where the equations leave them open; `params` are names that are parameters
    although they look like an input. `CaseError` shows the place in the text that cannot be meant.
    """
    lines = (texts,) if isinstance(texts, str) else tuple(texts)
    return _class_of(lines, tuple(sorted((units or {}).items())), motion, tuple(sorted(params)))


@lru_cache(maxsize=64)
def _class_of(
    texts: tuple[str, ...], units: tuple[tuple[str, str], ...], motion: Motion | None, params: tuple[str, ...]
) -> type[Model]:
    found = equations_of(texts, units=dict(units), motion=motion, params=params)
    index = {name: f"y[{2 * i}]" for i, name in enumerate(found.coordinates)}
    index |= {f"{name}'": f"y[{2 * i + 1}]" for i, name in enumerate(found.coordinates)}
    index |= {name: f"p[{i}]" for i, name in enumerate(found.params)}
    for i, name in enumerate(found.inputs):
        index[name] = f"u[{i}]"
        index[f"{name.removesuffix('force')}torque" if name.endswith("force") else name] = f"u[{i}]"
    index["base_position'"] = index.get("base_velocity", "")
    space = _functions(found, index)
    members = {
        "__doc__": "; ".join(found.texts),
        "__module__": __name__,
        "__annotations__": {"motion": Motion},
        "name": WRITTEN,
        "paper": f"written down: {'; '.join(found.texts)}",
        "equations": found.texts,
        "origin": (found.texts, units, motion, params),
        "coordinates": found.coordinates,
        "motion": found.motions[0],
        "motions": found.motions,
        "states": tuple(name for body in found.bodies for name in _states(body, found)),
        "inputs": found.inputs,
        "channels": tuple(_channels(found)),
        "params": tuple(_param(name, found) for name in found.params),
        "interfaces": tuple(_places(found, space)),
        "groups": (),
        "rhs": staticmethod(space["rhs"]),
        "observe": staticmethod(space["observe"]),
    }
    made: type[Model] = dataclass(frozen=True)(type("Written", (Written,), members))
    return made


class Written(Model):
    """A model that was made of equations: `equations` are their texts, `coordinates` the names in their order."""

    equations: ClassVar[tuple[str, ...]]
    coordinates: ClassVar[tuple[str, ...]]
    origin: ClassVar[tuple[Any, ...]]

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self.origin, self.motion)


def _again(origin: tuple[Any, ...], motion: Motion) -> Model:
    """Return a model made anew, in another process."""
    cls: Any = _class_of(*origin)
    made: Model = cls(motion=motion)
    return made


def _states(body: BodyEquation, found: Equations) -> tuple[str, str]:
    if body is found.bodies[0]:
        return "position", "velocity"
    return body.name, f"{body.name}.velocity"


def _channels(found: Equations) -> list[str]:
    names = ["position", "velocity", "acceleration"]
    for name in found.coordinates:
        names += [name, f"{name}.velocity", f"{name}.acceleration"]
    return names


def _param(name: str, found: Equations) -> Param:
    low = 0.0 if name in found.positive else -math.inf
    masses = {body.mass for body in found.bodies}
    scale: Literal["linear", "log"] = "log" if name in found.positive else "linear"
    meaning = (
        f"mass of {next(b.name for b in found.bodies if b.mass == name)}" if name in masses else f"parameter {name}"
    )
    return Param(name, meaning, found.params[name], low=low, scale=scale)


def _places(found: Equations, space: Mapping[str, Callable[..., tuple[float, float]]]) -> list[Interface]:
    """Return the places of forces: each body against the ground, and between two that appear as a difference."""
    rows = {body.name: (2 * i + 1, body.mass) for i, body in enumerate(found.bodies)}
    places = []
    for i, name in enumerate(found.coordinates):
        row, mass = rows[name]
        spring = _spring(found.springs, (name,))
        places.append(_place("ground" if i == 0 else name, row, mass, space[f"place_{i}"], spring))
    for k, (a, b) in enumerate(found.pairs):
        spring = _spring(found.springs, (a, b))
        places.append(_place(f"{a}-{b}", *rows[a], space[f"pair_{k}"], spring, rows[b]))
    return places


def _spring(springs: Sequence[Spring], coordinates: tuple[str, ...]) -> Spring | None:
    """Return the spring at a place: that with play, if there is one."""
    here = [spring for spring in springs if spring.coordinates == coordinates]
    return next((spring for spring in here if spring.play), here[0] if here else None)


def _place(
    name: str,
    row: int,
    mass: str,
    motion: Callable[..., tuple[float, float]],
    spring: Spring | None,
    against: tuple[int, str] | None = None,
) -> Interface:
    holds = tuple(part for part in (spring.stiffness, spring.play) if part) if spring else ()
    stiffness, play = (spring.stiffness, spring.play or None) if spring else (None, None)
    return Interface(
        name, row=row, inertia=mass, motion=motion, holds=holds, stiffness=stiffness, play=play, against=against
    )


def _functions(found: Equations, index: Mapping[str, str]) -> dict[str, Any]:
    """Return `rhs`, `observe` and the motion at each place, made of text that holds indices and numbers alone."""
    places = {f"place_{i}": (2 * i, None) for i in range(len(found.bodies))}
    order = {name: 2 * i for i, name in enumerate(found.coordinates)}
    pairs = {f"pair_{k}": (order[a], order[b]) for k, (a, b) in enumerate(found.pairs)}
    base = f" + u[{found.inputs.index('base_acceleration')}]" if "base_acceleration" in found.inputs else ""
    lines = ["def rhs(t, y, u, p, dydt):"]
    for i, body in enumerate(found.bodies):
        lines += [f"    dydt[{2 * i}] = y[{2 * i + 1}]"]
        lines += [f"    dydt[{2 * i + 1}] = ({_emitted(body.force, index)}) / {index[body.mass]}"]
    lines.append("def observe(t, y, dydt, u, p, seen):")
    for k, i in enumerate((0, *range(len(found.bodies)))):
        shown = (f"y[{2 * i}]", f"y[{2 * i + 1}]", f"dydt[{2 * i + 1}]{base}")
        lines += [f"    seen[{3 * k + j}] = {value}" for j, value in enumerate(shown)]
    for name, (a, b) in (places | pairs).items():
        position = f"y[{a}]" if b is None else f"y[{a}] - y[{b}]"
        velocity = f"y[{a + 1}]" if b is None else f"y[{a + 1}] - y[{b + 1}]"
        lines += [f"def {name}(y, u):", f"    return {position}, {velocity}"]
    space: dict[str, Any] = {"math": math}
    exec(compile("\n".join(lines), "<equations>", "exec"), space)  # noqa: S102 - our own text of indices and numbers
    return space


def _emitted(node: Node, index: Mapping[str, str]) -> str:
    """Return a node as Python: numbers, indexed arrays, arithmetic and the functions of this module and `math`."""
    if node.kind == "number":
        return repr(node.value)
    if node.kind == "name":
        return index[node.plain]
    parts = [_emitted(part, index) for part in node.args]
    if node.kind == "negative":
        return f"(-{parts[0]})"
    if node.kind == "call":
        own = _FUNCTIONS.get(node.text, f"math.{node.text}({{0}})")
        return own.format(*parts)
    power = node.args[1]
    if node.kind == "^" and power.kind == "number" and power.value in range(1, SQUARES + 1):
        return f"({' * '.join([parts[0]] * int(power.value))})"
    return f"({parts[0]} {'**' if node.kind == '^' else node.kind} {parts[1]})"
