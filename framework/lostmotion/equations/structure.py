"""The content of equations of motion: bodies with masses and forces, inputs, parameters and springs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from lostmotion.equations.constants import check_constants
from lostmotion.equations.dimensions import Condition, Kind, conditions_of, force_condition, make_error, solve
from lostmotion.equations.linear import ONE, minus, negative, split_linear, times
from lostmotion.equations.read import CONSTANTS, FUNCTIONS, Node, error, read
from lostmotion.errors import CaseError, DataError
from lostmotion.quantities import QUANTITIES, Dimension, quantity_of

BASE = ("base_position", "base_velocity", "base_acceleration")
MOST = 20
"""The greatest number of equations: the filter has a covariance matrix of all states."""
POSITIVE = {"gap": (1, 2), "stop": (1, 2), "sat": (1,)}
"""The arguments of functions that must not be negative: stiffnesses, gaps and limits."""


@dataclass(frozen=True)
class BodyEquation:
    """A coordinate with its mass (a parameter), and the force (a node) equal to mass times second derivative."""

    name: str
    mass: str
    force: Node


@dataclass(frozen=True)
class Spring:
    """A spring on one coordinate, or between two, with the parameter of its stiffness and, if any, of its gap."""

    coordinates: tuple[str, ...]
    stiffness: str
    play: str = ""


@dataclass(frozen=True)
class Equations:
    """Solved equations of motion: bodies, inputs in the order of a model, parameters with their dimensions.

    `motions` are the kinds of motion for which the dimensions are consistent. `pairs` are coordinates that appear as a
    difference; `positive` names parameters that must not be negative.
    """

    texts: tuple[str, ...]
    bodies: tuple[BodyEquation, ...]
    inputs: tuple[str, ...]
    params: Mapping[str, Dimension]
    motions: tuple[Kind, ...]
    springs: tuple[Spring, ...]
    pairs: tuple[tuple[str, str], ...]
    positive: frozenset[str]

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The names of the coordinates, in the order of their equations."""
        return tuple(body.name for body in self.bodies)


def equations_of(
    texts: Sequence[str],
    *,
    units: Mapping[str, str] | None = None,
    motion: Kind | None = None,
    params: Collection[str] = (),
) -> Equations:
    """Return the content of equations; raise `CaseError` with the place of an error in the text.

    `params` are names of parameters that would otherwise be read as inputs; `units` gives units that the equations do
    not determine.
    """
    texts = tuple(texts)
    if not 0 < len(texts) <= MOST:
        raise CaseError(f"equations has {len(texts)} entries: expected one equation for each body, {MOST} at most")
    sides = [read(text) for text in texts]
    for line, pair in zip(texts, sides, strict=True):
        for side in pair:
            check_constants(line, side)
    every = [node for pair in sides for side in pair for node in side.nodes()]
    coordinates = find_coordinates(texts, sides)
    names = dict.fromkeys(node.text for node in every if node.kind == "name" and node.text not in coordinates)
    inputs = list_inputs(names, params)
    _check_primes(texts, sides, {*coordinates}, {*inputs})
    owned = [name for name in names if name not in inputs]
    if strange := set(units or {}) - set(owned):
        raise CaseError(f"[model] units names {sorted(strange)[0]!r}, which is not a parameter of the equations")
    variables = {**dict.fromkeys(coordinates, "position"), **{name: quantity_of(name) for name in inputs}}
    conditions = [
        same for text, pair in zip(texts, sides, strict=True) for same in conditions_of(text, pair, variables)
    ]
    if motion is None and any(name.endswith("torque") for name in inputs):
        motion = "rotation"
    bodies = tuple(
        _make_body(text, pair, name, {*owned}) for text, pair, name in zip(texts, sides, coordinates, strict=True)
    )
    forces = [force_condition(text, body.force, variables) for text, body in zip(texts, bodies, strict=True)]
    motions, dimensions = _find_dimensions(owned, (conditions, forces), units or {}, motion)
    differences = (_find_difference(node, coordinates) for node in every)
    pairs = tuple(dict.fromkeys(pair for pair in differences if pair))
    masses = {body.mass for body in bodies}
    bounded = {
        node.args[i].text for node in every if node.kind == "call" for i in POSITIVE.get(node.text, ())
        if node.args[i].kind == "name"
    }  # fmt: skip
    springs = tuple(dict.fromkeys(spring for node in every for spring in _find_springs(node, coordinates, {*owned})))
    return Equations(
        texts,
        bodies,
        order_inputs(inputs),
        dimensions,
        motions,
        springs,
        pairs,
        frozenset(masses | bounded & {*owned}),
    )


def list_inputs(names: Iterable[str], params: Collection[str]) -> list[str]:
    """Return the names, each once, that are read as inputs; `params` are parameters in spite of their names."""
    return [name for name in dict.fromkeys(names) if name not in params and _is_input(name)]


def _is_input(name: str) -> bool:
    return name in BASE or name.split("_")[-1] in ("force", "torque")


def order_inputs(inputs: Iterable[str]) -> tuple[str, ...]:
    """Return the inputs with the names of a model: a torque is a force, a base position is followed by its velocity."""
    named = dict.fromkeys(f"{name.removesuffix('torque')}force" if name.endswith("torque") else name for name in inputs)
    moved = [name for name in BASE[:2] if {*BASE[:2]} & {*named}]
    rest = [name for name in named if name not in BASE]
    shaken = [name for name in BASE[2:] if name in named]
    return (*moved, *rest, *shaken) or ("force",)


def find_coordinates(texts: Sequence[str], sides: Sequence[tuple[Node, Node]]) -> tuple[str, ...]:
    """Return the coordinate of each equation, whose second derivative it contains."""
    found = []
    for text, pair in zip(texts, sides, strict=True):
        second = [node for side in pair for node in side.nodes() if node.kind == "name" and node.primes == 2]
        named = dict.fromkeys(node.text for node in second)
        if not named:
            raise error(text, 0, "has no second derivative, such as x'': write mass * x'' as a term of it")
        if len(named) > 1:
            other = next(node for node in second if node.text != next(iter(named)))
            raise error(
                text, other.at, f"has the second derivatives of {' and '.join(named)}: write one in each equation"
            )
        found.append(next(iter(named)))
    if twice := [name for name, count in Counter(found).items() if count > 1]:
        raise CaseError(f"two equations have the second derivative of {twice[0]!r}: write one for each coordinate")
    known = {*FUNCTIONS, *CONSTANTS, *QUANTITIES, *BASE, "torque", "ground", "drive", "sensor"}
    if bad := [name for name in found if name in known or _is_input(name)]:
        raise CaseError(f"{bad[0]!r} is the name of a coordinate, but has another meaning already: choose another name")
    return tuple(found)


def _check_primes(
    texts: Sequence[str], sides: Sequence[tuple[Node, Node]], coordinates: set[str], inputs: set[str]
) -> None:
    """Raise `CaseError` for derivatives of parameters, of inputs other than a base position, and of third order."""
    for text, pair in zip(texts, sides, strict=True):
        for node in (node for side in pair for node in side.nodes() if node.kind == "name"):
            most = 2 if node.text in coordinates else int(node.text == "base_position")
            if node.primes > most:
                kind = "an input" if node.text in inputs else "a parameter"
                why = "the second is the highest" if node.text in coordinates else f"it is {kind}"
                raise error(text, node.at, f"has the derivative {node.plain}: {why}")


def _find_dimensions(
    owned: Sequence[str],
    conditions: tuple[Sequence[Condition], Sequence[Condition]],
    units: Mapping[str, str],
    motion: Kind | None,
) -> tuple[tuple[Kind, ...], Mapping[str, Dimension]]:
    """Return the kinds of motion with consistent dimensions, and the dimensions of the parameters."""
    tried: tuple[Kind, ...] = (motion,) if motion else ("translation", "rotation")
    wrong: CaseError | None = None
    found: dict[Kind, Mapping[str, Dimension]] = {}
    for one in tried:
        try:
            solved = solve(owned, conditions[0], units, one, conditions[1])
        except DataError as err:
            raise CaseError(f"[model] units: {err}") from err
        except CaseError as err:
            wrong = wrong or err
            continue
        if isinstance(solved, Condition):
            wrong = wrong or make_error(solved)
        else:
            found[one] = solved
    if not found and wrong:
        raise wrong
    first = next(iter(found))
    same = tuple(kind for kind in found if found[kind] == found[first])
    return same, found[first]


def _make_body(text: str, sides: tuple[Node, Node], name: str, params: set[str]) -> BodyEquation:
    """Return the body of an equation: its mass, a single parameter, and the force on it."""
    mass, rest = split_linear(text, minus(*sides), f"{name}''")
    force = negative(rest)
    if mass.kind == "negative":
        mass, force = mass.args[0], negative(force)
    if mass == ONE:
        mass, force = _multiply_by_mass(force)
    if mass.kind != "name" or mass.text not in params:
        raise error(text, mass.at, f"has no single parameter as the mass of {name}: write one, as in m*{name}''")
    return BodyEquation(name, mass.text, force)


def _multiply_by_mass(force: Node) -> tuple[Node, Node]:
    """Return mass and force of an equation divided by its mass, which is the divisor of the input."""
    for node in force.nodes():
        if node.kind == "/" and node.args[0].kind == "name" and _is_input(node.args[0].text):
            divisor = node.args[1]
            if divisor.kind == "name":
                return divisor, _multiply_out(force, divisor)
    return ONE, force


def _multiply_out(node: Node, divisor: Node) -> Node:
    """Return a sum times a divisor; terms that are divided by it lose the divisor."""
    if node.kind in ("+", "-", "negative"):
        return Node(node.kind, node.at, args=tuple(_multiply_out(part, divisor) for part in node.args))
    if node.kind == "/" and node.args[1].plain == divisor.plain:
        return node.args[0]
    return times(divisor, node)


def _find_difference(node: Node, coordinates: Collection[str]) -> tuple[str, str] | None:
    """Return the coordinates of a difference such as `x1 - x2` or `x1' - x2'`; None for another node."""
    if node.kind != "-":
        return None
    a, b = node.args
    named = a.kind == b.kind == "name" and a.primes == b.primes and a.text != b.text
    if not (named and {a.text, b.text} <= {*coordinates}):
        return None
    order = [*coordinates]
    return (a.text, b.text) if order.index(a.text) < order.index(b.text) else (b.text, a.text)


def _find_span(node: Node, coordinates: Collection[str]) -> tuple[str, ...]:
    """Return the coordinate of a position, or the two of a relative position; none for another node."""
    if node.kind == "name":
        return (node.text,) if node.text in coordinates and not node.primes else ()
    pair = _find_difference(node, coordinates)
    return pair if pair and not node.args[0].primes else ()


def _find_springs(node: Node, coordinates: Collection[str], params: set[str]) -> Iterable[Spring]:
    """Yield the springs in a node: `gap(x, k, x0)`, `stop(x, k, x0)`, or `k * x` in a sum."""
    if node.kind == "call" and node.text in ("gap", "stop"):
        place, (k, x0) = _find_span(node.args[0], coordinates), node.args[1:]
        if place and k.text in params:
            yield Spring(place, k.text, x0.text if node.text == "gap" and x0.text in params else "")
    if node.kind == "*":
        for one, other in (node.args, node.args[::-1]):
            place = _find_span(other, coordinates)
            if place and one.kind == "name" and one.text in params:
                yield Spring(place, one.text)
