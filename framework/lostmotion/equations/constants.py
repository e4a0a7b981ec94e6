"""Parts of an equation that are numbers: each has to be finite, and nothing may be divided by zero."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable

from lostmotion.equations.read import Node, error

HIGHEST = 100.0
"""The highest power of a part of an equation."""
_FUNCTIONS: dict[str, Callable[..., float]] = {
    "gap": lambda x, k, x0: k * (x - min(max(x, -x0), x0)),
    "stop": lambda x, k, x0: k * max(x - x0, 0.0),
    "sat": lambda x, limit: min(max(x, -limit), limit),
    "sign": lambda x: math.copysign(1.0, x) if x else 0.0,
    "abs": abs,
    "min": min,
    "max": max,
}
"""The functions of an equation that are not in `math`."""
_OPERATORS: dict[str, Callable[[float, float], complex]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "^": operator.pow,
}


def check_constants(text: str, node: Node) -> None:
    """Raise `CaseError` with the place in the text where a node divides by zero or has a part that is not finite."""
    _find_constant(text, node)


def _find_constant(text: str, node: Node) -> float | None:
    """Return the number that a node is whatever its names mean, or None for another node."""
    parts = [_find_constant(text, part) for part in node.args]
    if node.kind == "number":
        return node.value
    if node.kind == "/" and parts[1] == 0.0:
        raise error(text, node.args[1].begin, "divides by zero")
    if node.kind == "^" and parts[1] is not None and abs(parts[1]) > HIGHEST:
        raise error(text, node.args[1].begin, f"has a power above {HIGHEST:g}, with which numbers overflow")
    if node.kind == "-" and _are_alike(*node.args):
        return 0.0
    if node.kind in ("*", "/") and 0.0 in parts:
        return 0.0
    known = [part for part in parts if part is not None]
    if node.kind == "name" or len(known) < len(parts):
        return None
    try:
        value = _compute(node, known)
    except (ValueError, OverflowError, ZeroDivisionError):
        value = math.nan
    if isinstance(value, complex) or not math.isfinite(value):
        raise error(text, node.begin, "has a part that is no finite number")
    return value


def _compute(node: Node, parts: list[float]) -> complex:
    """Return the value of a function or an operator; a power of a negative number may be complex."""
    if node.kind == "negative":
        return -parts[0]
    if node.kind == "call":
        own = _FUNCTIONS.get(node.text) or getattr(math, node.text)
        return float(own(*parts))
    return _OPERATORS[node.kind](*parts)


def _are_alike(one: Node, other: Node) -> bool:
    """Return whether two nodes have the same text, so that their difference is zero."""
    return (
        (one.kind, one.text, one.primes, one.value) == (other.kind, other.text, other.primes, other.value)
        and len(one.args) == len(other.args)
        and all(map(_are_alike, one.args, other.args))
    )
