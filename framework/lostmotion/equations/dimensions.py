"""The dimensions of parameters from equations: all terms of a sum have the same dimension, and given units are kept.

The exponents of force, length, time and metre solve linear equations, one for each comparison in the text. In rotation,
force means torque and length means angle, which is allowed in a sine; metre is the unit of a lever.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lostmotion.equations.read import Node, error
from lostmotion.errors import CaseError
from lostmotion.quantities import Dimension, unit_powers

Kind = Literal["translation", "rotation"]
LENGTH, TIME = 1, 2
_ANGLES = ("sin", "cos", "tan")
_PURE = ("sqrt", "exp", "log", "asin", "acos", "atan", "sinh", "cosh", "tanh", *_ANGLES)
_QUANTITIES = {"force": (1.0, 0.0, 0.0), "position": (0.0, 1.0, 0.0), "velocity": (0.0, 1.0, -1.0)}
_QUANTITIES["acceleration"] = (0.0, 1.0, -2.0)
EXACT = 1e-9


@dataclass(frozen=True)
class Power:
    """The dimension of an expression: the exponents (4,) of known quantities, and the power of each parameter."""

    fixed: NDArray[np.float64]
    of: Mapping[str, float] = field(default_factory=dict)

    def times(self, other: Power, sign: float = 1.0) -> Power:
        """Return the dimension of a product, or of a quotient with `sign` -1."""
        names = dict.fromkeys((*self.of, *other.of))
        of = {name: self.of.get(name, 0.0) + sign * other.of.get(name, 0.0) for name in names}
        return Power(self.fixed + sign * other.fixed, {name: power for name, power in of.items() if power})

    def to_power(self, power: float) -> Power:
        """Return the dimension of a power."""
        return Power(power * self.fixed, {name: power * own for name, own in self.of.items()})


@dataclass(frozen=True)
class Condition:
    """The condition that an expression is dimensionless; it may be an angle if `may_turn`."""

    power: Power
    may_turn: bool
    text: str
    at: int
    says: str


class _Walk:
    """Walks through an equation and collects the conditions on dimensions."""

    def __init__(self, text: str, variables: Mapping[str, str]) -> None:
        self.text, self.variables, self.conditions = text, variables, list[Condition]()

    def power(self, node: Node) -> Power:
        """Return the dimension of an expression; conditions of its parts are collected."""
        if node.kind == "number":
            return Power(np.zeros(4))
        if node.kind == "name":
            return self._name_power(node)
        if node.kind == "negative":
            return self.power(node.args[0])
        if node.kind in ("+", "-"):
            return self.compare(tuple(_split_sum(node)))
        if node.kind == "^":
            return self._power_of_power(node)
        if node.kind == "call":
            return self._call_power(node)
        first, second = (self.power(part) for part in node.args)
        return first.times(second, 1.0 if node.kind == "*" else -1.0)

    def _name_power(self, node: Node) -> Power:
        if node.text not in self.variables:
            return Power(np.zeros(4), {node.text: 1.0})
        powers = np.array([*_QUANTITIES[self.variables[node.text]], 0.0])
        powers[TIME] -= node.primes
        return Power(powers)

    def compare(self, parts: Sequence[Node]) -> Power:
        """Return the common dimension of the parts; a zero fits any dimension."""
        real = [part for part in parts if not (part.kind == "number" and part.value == 0.0)]
        found = [self.power(part) for part in real]
        for other, part in zip(found[1:], real[1:], strict=True):
            says = "adds or compares quantities of different dimensions"
            self.conditions.append(Condition(found[0].times(other, -1.0), False, self.text, part.begin, says))
        return found[0] if found else Power(np.zeros(4))

    def _power_of_power(self, node: Node) -> Power:
        base, power = node.args
        sign = -1.0 if power.kind == "negative" else 1.0
        inner = power.args[0] if power.kind == "negative" else power
        if inner.kind == "number":
            return self.power(base).to_power(sign * inner.value)
        for part in (base, power):
            says = "has a power that is not a number: then base and power must be dimensionless"
            self.conditions.append(Condition(self.power(part), False, self.text, node.at, says))
        return Power(np.zeros(4))

    def _call_power(self, node: Node) -> Power:
        name, args = node.text, node.args
        if name in ("gap", "stop"):
            self.compare((args[0], args[2]))
            return self.power(args[1]).times(self.power(args[0]))
        if name in ("min", "max", "sat"):
            return self.compare(args)
        inner = self.power(args[0])
        if name == "sqrt":
            return inner.to_power(0.5)
        if name in _PURE:
            says = f"takes {name} of a quantity with a dimension: divide it by a parameter of that dimension"
            self.conditions.append(Condition(inner, name in _ANGLES, self.text, node.at, says))
        return inner if name == "abs" else Power(np.zeros(4))


def _split_sum(node: Node) -> Iterator[Node]:
    """Yield the terms of a sum."""
    if node.kind in ("+", "-"):
        for part in node.args:
            yield from _split_sum(part)
    else:
        yield node


def conditions_of(text: str, sides: tuple[Node, Node], variables: Mapping[str, str]) -> Iterator[Condition]:
    """Yield the conditions of an equation; `variables` are coordinates and inputs with their quantities."""
    walk = _Walk(text, variables)
    walk.compare([part for side in sides for part in _split_sum(side)])
    yield from walk.conditions


def force_condition(text: str, node: Node, variables: Mapping[str, str]) -> Condition:
    """Return the condition that an expression is a force."""
    power = _Walk(text, variables).power(node).times(Power(np.array([1.0, 0.0, 0.0, 0.0])), -1.0)
    return Condition(power, False, text, node.at, "is not a balance of forces")


def solve(
    names: Sequence[str],
    conditions: Sequence[Condition],
    units: Mapping[str, str],
    motion: Kind,
    forces: Sequence[Condition] = (),
) -> dict[str, Dimension] | Condition:
    """Return the dimension of each parameter, or the first condition that contradicts earlier ones.

    Where a dimension is undetermined, the conditions `forces` are added: each equation is a balance of forces.

    `CaseError` is raised for a dimension that remains undetermined, or for a unit that is not an SI unit.
    """
    rows, wanted, masks = _unit_equations(names, units, motion)
    for same in conditions:
        row = np.array([same.power.of.get(name, 0.0) for name in names])
        mask = np.ones(4, dtype=bool)
        mask[LENGTH] = not (same.may_turn and motion == "rotation")
        rows, wanted, masks = [*rows, row], [*wanted, -same.power.fixed], [*masks, mask]
        if not all(_fits(rows, wanted, masks, k) for k in range(4)):
            return same
    if forces and _find_undetermined(names, rows):
        return solve(names, [*conditions, *forces], units, motion)
    _check_determined(names, rows, motion)
    powers = (
        np.column_stack([_solve_exponents(rows, wanted, masks, k)[0] for k in range(4)]) if names else np.zeros((0, 4))
    )
    whole = np.where(np.abs(2.0 * powers - np.round(2.0 * powers)) < EXACT, np.round(2.0 * powers) / 2.0, powers)
    return {name: Dimension(*(float(p) for p in row)) for name, row in zip(names, whole, strict=True)}


def _unit_equations(
    names: Sequence[str], units: Mapping[str, str], motion: Kind
) -> tuple[list[NDArray[np.float64]], list[NDArray[np.float64]], list[NDArray[np.bool_]]]:
    """Return rows, values and masks of the linear equations from given units."""
    rows, wanted, masks = [], [], []
    for name, unit in units.items():
        rows.append(np.array([float(other == name) for other in names]))
        wanted.append(np.array(unit_powers(unit, motion)))
        masks.append(np.array([True, motion == "translation", True, True]))
    return rows, wanted, masks


def _solve_exponents(
    rows: Sequence[NDArray[np.float64]],
    wanted: Sequence[NDArray[np.float64]],
    masks: Sequence[NDArray[np.bool_]],
    k: int,
) -> tuple[NDArray[np.float64], float]:
    """Return the exponents (parameters,) of one base dimension, and their largest error."""
    kept = [i for i, mask in enumerate(masks) if mask[k]]
    if not kept:
        return np.zeros(len(rows[0]) if rows else 0), 0.0
    matrix, values = np.array([rows[i] for i in kept]), np.array([wanted[i][k] for i in kept])
    if matrix.shape[1] == 0:
        return np.zeros(0), float(np.abs(values).max())
    found = np.linalg.lstsq(matrix, values, rcond=None)[0]
    return found, float(np.abs(matrix @ found - values).max())


def _fits(
    rows: Sequence[NDArray[np.float64]],
    wanted: Sequence[NDArray[np.float64]],
    masks: Sequence[NDArray[np.bool_]],
    k: int,
) -> bool:
    return _solve_exponents(rows, wanted, masks, k)[1] < EXACT


def _find_undetermined(names: Sequence[str], rows: Sequence[NDArray[np.float64]]) -> list[str]:
    """Return the parameters whose dimensions are not determined."""
    if not names:
        return []
    _, sizes, directions = np.linalg.svd(np.array(rows).reshape(-1, len(names)))
    free = directions[int(np.sum(sizes > EXACT)) :]
    return [name for i, name in enumerate(names) if len(free) and np.abs(free[:, i]).max() > EXACT]


def _check_determined(names: Sequence[str], rows: Sequence[NDArray[np.float64]], motion: Kind) -> None:
    """Raise `CaseError` for parameters whose dimensions are not determined."""
    if lacking := _find_undetermined(names, rows):
        example = "kg" if motion == "translation" else "kg m^2"
        raise CaseError(
            f"the equations do not determine the units of {', '.join(lacking)}: write one parameter for their product,"
            f' or give [model] units = {{ {lacking[0]} = "{example}", ... }}'
        )


def make_error(same: Condition) -> CaseError:
    """Return the error for a condition that cannot be fulfilled."""
    return error(same.text, same.at, same.says)
