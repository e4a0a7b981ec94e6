"""Models from equations of motion as text. The result is a class that is compiled, checked and fitted like any other.

The text is translated to arithmetic on indexed arrays; no name in the text is ever looked up or called.
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
from lostmotion.quantities import ANGULAR_FREQUENCY, FREQUENCY

_FUNCTIONS = {
    "gap": "({1} * ({0} - min(max({0}, -{2}), {2})))",
    "stop": "({1} * max({0} - {2}, 0.0))",
    "sat": "min(max({0}, -{1}), {1})",
    "sign": "(1.0 if {0} > 0.0 else (-1.0 if {0} < 0.0 else 0.0))",
    "abs": "abs({0})",
    "min": "min({0}, {1})",
    "max": "max({0}, {1})",
}
"""The Python text of the functions of an equation that are not in `math`."""
SQUARES = 6
"""The largest integer power that is written as a product."""


def is_equation(text: str) -> bool:
    """Return whether a text is an equation and not the name of a model."""
    return bool(set("=*/+^('’′") & set(text))


def model_of(
    texts: str | Sequence[str],
    *,
    units: Mapping[str, str] | None = None,
    motion: Motion | None = None,
    params: Collection[str] = (),
) -> type[Model]:
    """Return the class of a model from its equations of motion, `m*x'' + c*x' + k*x = force`.

    `units` (SI, by parameter) are needed where the equations do not determine them. `params` are names of parameters
    that would otherwise be read as inputs. `CaseError` shows the place of an error in the text.
    """
    lines = (texts,) if isinstance(texts, str) else tuple(texts)
    return _make_class(lines, tuple(sorted((units or {}).items())), motion, tuple(sorted(params)))


@lru_cache(maxsize=64)
def _make_class(
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
    space = _compile_functions(found, index)
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
        "states": tuple(name for body in found.bodies for name in _state_names(body, found)),
        "inputs": found.inputs,
        "channels": tuple(_channel_names(found)),
        "params": tuple(_make_param(name, found) for name in found.params),
        "interfaces": tuple(_make_interfaces(found, space)),
        "groups": (),
        "rhs": staticmethod(space["rhs"]),
        "observe": staticmethod(space["observe"]),
    }
    made: type[Model] = dataclass(frozen=True, repr=False)(type("Written", (Written,), members))
    return made


class Written(Model):
    """A model made from equations: `equations` are their texts, `coordinates` their names in the same order."""

    equations: ClassVar[tuple[str, ...]]
    coordinates: ClassVar[tuple[str, ...]]
    origin: ClassVar[tuple[Any, ...]]

    def __repr__(self) -> str:
        return f"<model {'; '.join(self.equations)} ({self.motion})>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuild_model, (self.origin, self.motion)


def _rebuild_model(origin: tuple[Any, ...], motion: Motion) -> Model:
    """Return the model built again from its texts, after unpickling in another process."""
    cls: Any = _make_class(*origin)
    made: Model = cls(motion=motion)
    return made


def _state_names(body: BodyEquation, found: Equations) -> tuple[str, str]:
    if body is found.bodies[0]:
        return "position", "velocity"
    return body.name, f"{body.name}.velocity"


def _channel_names(found: Equations) -> list[str]:
    names = ["position", "velocity", "acceleration"]
    for name in found.coordinates:
        names += [name, f"{name}.velocity", f"{name}.acceleration"]
    return names


def _make_param(name: str, found: Equations) -> Param:
    low = 0.0 if name in found.positive else -math.inf
    masses = {body.mass for body in found.bodies}
    scale: Literal["linear", "log"] = "log" if name in found.positive else "linear"
    meaning = (
        f"mass of {next(b.name for b in found.bodies if b.mass == name)}" if name in masses else f"parameter {name}"
    )
    dimension = ANGULAR_FREQUENCY if found.params[name] == FREQUENCY else found.params[name]
    return Param(name, meaning, dimension, low=low, scale=scale)


def _make_interfaces(found: Equations, space: Mapping[str, Callable[..., tuple[float, float]]]) -> list[Interface]:
    """Return the places of forces: each body against the ground, and pairs whose coordinates appear as a difference."""
    rows = {body.name: (2 * i + 1, body.mass) for i, body in enumerate(found.bodies)}
    places = []
    for i, name in enumerate(found.coordinates):
        row, mass = rows[name]
        spring = _find_spring(found.springs, (name,))
        places.append(_make_interface("ground" if i == 0 else name, row, mass, space[f"place_{i}"], spring))
    for k, (a, b) in enumerate(found.pairs):
        spring = _find_spring(found.springs, (a, b))
        places.append(_make_interface(f"{a}-{b}", *rows[a], space[f"pair_{k}"], spring, rows[b]))
    return places


def _find_spring(springs: Sequence[Spring], coordinates: tuple[str, ...]) -> Spring | None:
    """Return the spring at a place, preferably one with play; None where there is no spring."""
    here = [spring for spring in springs if spring.coordinates == coordinates]
    return next((spring for spring in here if spring.play), here[0] if here else None)


def _make_interface(
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


def _compile_functions(found: Equations, index: Mapping[str, str]) -> dict[str, Any]:
    """Return `rhs`, `observe` and the motion at each place, compiled from text of indices and numbers only."""
    places = {f"place_{i}": (2 * i, None) for i in range(len(found.bodies))}
    order = {name: 2 * i for i, name in enumerate(found.coordinates)}
    pairs = {f"pair_{k}": (order[a], order[b]) for k, (a, b) in enumerate(found.pairs)}
    base = f" + u[{found.inputs.index('base_acceleration')}]" if "base_acceleration" in found.inputs else ""
    lines = ["def rhs(t, y, u, p, dydt):"]
    for i, body in enumerate(found.bodies):
        lines += [f"    dydt[{2 * i}] = y[{2 * i + 1}]"]
        lines += [f"    dydt[{2 * i + 1}] = ({_format_node(body.force, index)}) / {index[body.mass]}"]
    lines.append("def observe(t, y, dydt, u, p, seen):")
    for k, i in enumerate((0, *range(len(found.bodies)))):
        shown = (f"y[{2 * i}]", f"y[{2 * i + 1}]", f"dydt[{2 * i + 1}]{base}")
        lines += [f"    seen[{3 * k + j}] = {value}" for j, value in enumerate(shown)]
    for name, (a, b) in (places | pairs).items():
        position = f"y[{a}]" if b is None else f"y[{a}] - y[{b}]"
        velocity = f"y[{a + 1}]" if b is None else f"y[{a + 1}] - y[{b + 1}]"
        lines += [f"def {name}(y, u):", f"    return {position}, {velocity}"]
    space: dict[str, Any] = {"math": math}
    exec(compile("\n".join(lines), "<equations>", "exec"), space)  # noqa: S102 - generated text of indices and numbers only
    return space


def _format_node(node: Node, index: Mapping[str, str]) -> str:
    """Return a node as Python text: numbers, indexed arrays, arithmetic, functions of this module and of `math`."""
    if node.kind == "number":
        return repr(node.value)
    if node.kind == "name":
        return index[node.plain]
    parts = [_format_node(part, index) for part in node.args]
    if node.kind == "negative":
        return f"(-{parts[0]})"
    if node.kind == "call":
        own = _FUNCTIONS.get(node.text, f"math.{node.text}({{0}})")
        return own.format(*parts)
    power = node.args[1]
    if node.kind == "^" and power.kind == "number" and power.value in range(1, SQUARES + 1):
        return f"({' * '.join([parts[0]] * int(power.value))})"
    return f"({parts[0]} {'**' if node.kind == '^' else node.kind} {parts[1]})"
