"""What a model consists of: bodies, springs, dampers, gaps and inputs, found by probing its equations.

A parameter belongs to a spring if the force that it causes alone depends on positions, to a damper if it depends on
velocities, and to a load if it depends on neither. The force acts on one body, from the ground or the moved base, or on
two. So a picture needs no declaration beside the equations: models of other packages and equations of a user have one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Model
from lostmotion.quantities import FORCE, INERTIA, LENGTH, NUMBER, quantity_of

Array = NDArray[np.float64]
Kind = Literal["spring", "damper", "load", "weight"]
Shape = Literal["linear", "gap", "stop", "nonlinear"]
GROUND, BASE = -1, -2
"""What an element is attached to, if it is no body."""
SAMPLES, REACH, TIME = 24, 10.0, 0.3
"""The number of random states, their size in units of the gaps, and the time (s) at which a model is probed."""
SAME = 1e-9
"""Forces that differ by a smaller share are equal."""


@dataclass(frozen=True)
class DrawnElement:
    """A spring, a damper, a load or a weight between a body and another end, with the names of its parameters.

    `length` is the parameter of its gap or of the place of its stop.
    """

    kind: Kind
    body: int
    end: int
    name: str
    shape: Shape = "linear"
    length: str = ""


@dataclass(frozen=True)
class MachineParts:
    """The bodies of a model by their inertia, its elements, the input of each body ("" for none), and other parameters.

    `moved` tells that the motion of a base drives the machine.
    """

    motion: str
    bodies: tuple[str, ...]
    elements: tuple[DrawnElement, ...]
    inputs: tuple[str, ...]
    others: tuple[str, ...]
    moved: bool = False


def find_parts(model: Model) -> MachineParts:
    """Return the parts of a model; the declared places alone where its equations cannot be probed."""
    try:
        with np.errstate(all="ignore"):
            return ProbedModel(model).find_parts()
    except Exception:  # equations of a third party
        return declare_parts(model)


def declare_parts(model: Model) -> MachineParts:
    """Return the parts that the places of a model declare: bodies, and springs with their gaps."""
    bodies = list_bodies(model)
    rows = [rate for _, rate in bodies]
    elements = []
    for place in model.interfaces:
        end = rows.index(place.against[0]) if place.against and place.against[0] in rows else GROUND
        if place.stiffness and place.row in rows:
            shape: Shape = "gap" if place.play else "linear"
            elements.append(
                DrawnElement("spring", rows.index(place.row), end, place.stiffness, shape, place.play or "")
            )
    names = {place.row: place.inertia for place in reversed(model.interfaces)}
    inertias = tuple(str(names.get(row) or "") for row in rows)
    drawn = {*inertias, *(name for one in elements for name in (one.name, one.length))}
    others = tuple(param.name for param in model.params if param.name not in drawn)
    first = model.inputs[0] if model.inputs and not model.inputs[0].startswith("base") else ""
    return MachineParts(model.motion, inertias, tuple(elements), (first, *[""] * (len(rows) - 1)), others)


def list_bodies(model: Model) -> list[tuple[int, int]]:
    """Return for each body the numbers of its position and of its velocity among the states."""
    found = [(i, model.find_rate(i)) for i, name in enumerate(model.states) if quantity_of(name) == "position"]
    return [(position, rate) for position, rate in found if rate is not None] or [model.first_body]


class ProbedModel:
    """A model whose equations are called with random states and with single parameters."""

    def __init__(self, model: Model) -> None:
        self.model, self.bodies = model, list_bodies(model)
        self.names = [param.name for param in model.params]
        rng = np.random.default_rng(0)
        self.states = rng.uniform(-REACH, REACH, (SAMPLES, len(model.states)))
        self.given = rng.uniform(-REACH, REACH, (SAMPLES, len(model.inputs)))
        self.fixed = self._list_fixed()

    def find_parts(self) -> MachineParts:
        """Return the parts of the model."""
        inertias = self._name_inertias()
        found = [one for j in range(len(self.names)) if j not in self.fixed for one in self._find_elements(j)]
        drawn = {*inertias, *(name for one in found for name in (one.name, one.length))}
        return MachineParts(
            self.model.motion,
            inertias,
            tuple(found),
            tuple(self._find_input(body) for body in range(len(self.bodies))),
            tuple(name for name in self.names if name not in drawn),
            moved="base_position" in self.model.inputs,
        )

    def _call(self, y: Array, u: Array, p: Array) -> Array:
        rates = np.zeros(len(y))
        self.model.rhs(TIME, y, u, p, rates)
        return rates

    def _list_fixed(self) -> set[int]:
        """Return the parameters that are not switched off: lengths, ratios, and those by which the equations divide."""
        levers = {place.lever for place in self.model.interfaces}
        found = {
            j
            for j, q in enumerate(self.model.params)
            if q.dimension in (LENGTH, INERTIA) or q.name in levers or (q.dimension == NUMBER and q.scale == "log")
        }
        for j in set(range(len(self.names))) - found:
            p = np.ones(len(self.names))
            p[j] = 0.0
            try:
                finite = bool(np.isfinite(self._call(self.states[0], self.given[0], p)).all())
            except ZeroDivisionError:
                finite = False
            if not finite:
                found.add(j)
        return found

    def _name_inertias(self) -> tuple[str, ...]:
        """Return the parameter of the inertia of each body: declared by a place, or in the order of the bodies."""
        declared = {place.row: place.inertia for place in self.model.interfaces}
        spare = [q.name for q in self.model.params if q.dimension == INERTIA and q.name not in declared.values()]
        return tuple(str(declared.get(rate) or (spare.pop(0) if spare else "")) for _, rate in self.bodies)

    def _push(self, j: int, y: Array, u: Array, lengths: Array | None = None) -> Array:
        """Return the acceleration (bodies,) that parameter j alone causes, the other ones switched off."""
        p = np.array([1.0 if k in self.fixed else 0.0 for k in range(len(self.names))])
        p = p if lengths is None else np.where(np.isnan(lengths), p, lengths)
        off = self._call(y, u, p)
        p[j] = 1.0
        return np.array([(self._call(y, u, p) - off)[rate] for _, rate in self.bodies])

    def _push_all(self, j: int, states: Array, given: Array, lengths: Array | None = None) -> Array:
        """Return the accelerations (samples, bodies) that parameter j alone causes."""
        return np.array([self._push(j, y, u, lengths) for y, u in zip(states, given, strict=True)])

    def _find_elements(self, j: int) -> Iterator[DrawnElement]:
        """Yield the element to which parameter j gives its strength; none where it only changes other elements."""
        pushed = self._push_all(j, self.states, self.given)
        acting = [body for body in range(len(self.bodies)) if np.abs(pushed[:, body]).max() > SAME]
        if not acting:
            return
        positions, rates = ([pair[side] for pair in self.bodies] for side in (0, 1))
        on_place, on_speed = (self._depends(j, pushed, columns) for columns in (positions, rates))
        other = sorted(set(range(len(self.model.states))) - {*positions, *rates})
        if other and self._depends(j, pushed, other):
            return  # the constant of a motor
        by_input = [k for k, name in enumerate(self.model.inputs) if not name.startswith("base")]
        if by_input and self._depends(j, pushed, (), by_input):
            return
        kind: Kind = "spring" if on_place else "damper" if on_speed else "load"
        if kind == "spring" and self.model.params[j].dimension == FORCE:
            kind = "weight"
        one = DrawnElement(kind, acting[0], self._find_end(j, pushed, acting, positions + rates), self.names[j])
        yield self._find_shape(j, one) if kind == "spring" else one

    def _depends(self, j: int, pushed: Array, states: Sequence[int], inputs: Sequence[int] = ()) -> bool:
        """Return whether the push of parameter j changes with some states or inputs."""
        y, u = self.states.copy(), self.given.copy()
        y[:, list(states)] *= -0.7
        u[:, list(inputs)] *= -0.7
        return not _are_equal(self._push_all(j, y, u), pushed)

    def _find_end(self, j: int, pushed: Array, acting: Sequence[int], columns: Sequence[int]) -> int:
        """Return the other end of an element: a second body, the moved base, or the ground."""
        if len(acting) > 1:
            return acting[1]
        own = set(self.bodies[acting[0]])
        for body, pair in enumerate(self.bodies):
            if body != acting[0] and self._depends(j, pushed, pair):
                return body
        moved = [k for k, name in enumerate(self.model.inputs) if name in ("base_position", "base_velocity")]
        return BASE if moved and own & set(columns) and self._depends(j, pushed, (), moved) else GROUND

    def _find_shape(self, j: int, one: DrawnElement) -> DrawnElement:
        """Return a spring with its shape, from its force over the position of its body, and its length."""
        across = np.array([-0.8, -0.4, 0.4, 0.8, 2.0, 4.0, 8.0, -2.0, -4.0, -8.0])
        states = np.zeros((across.size, self.states.shape[1]))
        states[:, self.bodies[one.body][0]] = across
        still = np.zeros((across.size, self.given.shape[1]))
        force = self._push_all(j, states, still)[:, one.body]
        scale = np.abs(force).max() or 1.0
        near, right, left = (np.abs(force[part]).max() > SAME * scale for part in (slice(4), slice(4, 7), slice(7, 10)))
        if right != left:
            shape: Shape = "stop"
        elif not near:
            shape = "gap"
        else:
            slope = force / across
            shape = "linear" if np.ptp(slope) < 1e-6 * np.abs(slope).max() else "nonlinear"
        return replace(one, shape=shape, length=self._find_length(j, states, still, force, one.body))

    def _find_length(self, j: int, states: Array, still: Array, force: Array, body: int) -> str:
        """Return the length that changes the force of a spring, empty for none."""
        for k, param in enumerate(self.model.params):
            if param.dimension == LENGTH:
                lengths = np.full(len(self.names), np.nan)
                lengths[k] = 1.5
                if not _are_equal(self._push_all(j, states, still, lengths)[:, body], force):
                    return param.name
        return ""

    def _find_input(self, body: int) -> str:
        """Return the first input that acts on a body, directly or by way of a further state; the base acts on all."""
        rate = self.bodies[body][1]
        p = np.ones(len(self.names))
        bodies = {state for pair in self.bodies for state in pair}
        for k, name in enumerate(self.model.inputs):
            if name.startswith("base"):
                continue
            u = self.given.copy()
            u[:, k] += 1.0
            pairs = zip(self.states, self.given, u, strict=True)
            moved = np.array([self._call(y, v, p) - self._call(y, w, p) for y, w, v in pairs])
            reached = np.flatnonzero(np.abs(moved).max(axis=0) > SAME)
            if rate in reached or (body == 0 and set(reached.tolist()) - bodies):
                return name
        return ""


def _are_equal(one: Array, other: Array) -> bool:
    return bool(np.abs(one - other).max() <= SAME * max(float(np.abs(one).max()), float(np.abs(other).max()), 1e-300))
