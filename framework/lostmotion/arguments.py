"""Checks of the arguments of public functions: one sentence for a value that cannot be meant.

A rule is a function of a value and of its name in messages; it returns the value, perhaps as another type, or raises
`CaseError`. `@checked(rate=positive, seed=whole(0))` applies rules to the arguments of a function by their names.
"""

from __future__ import annotations

import functools
import inspect
import math
import os
import reprlib
from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from numbers import Integral, Real
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import numpy as np

from lostmotion.errors import CaseError, nearest

Rule = Callable[[Any, str], Any]
P = ParamSpec("P")
R = TypeVar("R")
_PLAIN = (str, bytes, bool, int, float, complex, Decimal, np.generic, type(None))
_LARGEST = 2**62
LONGEST = 255
"""The most bytes of the name of a file."""
HUGE = 1e150
"""The square of a larger number would be infinite."""


def checked(**rules: Rule) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Return a decorator of a function, each argument of which is checked by the rule of its name, where it is given.

    A call with unknown or missing arguments fails as any other call in Python does.
    """

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        signature = inspect.signature(function)
        others = next((p.name for p in signature.parameters.values() if p.kind is p.VAR_KEYWORD), "")

        @functools.wraps(function)
        def call(*args: P.args, **kwargs: P.kwargs) -> R:
            given = signature.bind(*args, **kwargs)
            for place in (given.arguments, given.arguments.get(others, {})):
                place |= {name: rule(place[name], name) for name, rule in rules.items() if name in place}
            return function(*given.args, **given.kwargs)

        return call

    return decorate


def describe(value: object) -> str:
    """Return a value as one short text: plain values as Python writes them, others by their type."""
    if isinstance(value, _PLAIN):
        if isinstance(value, int) and value.bit_length() > _LARGEST.bit_length():
            return f"a whole number of {value.bit_length()} bits"
        return ascii(value)[:60] if isinstance(value, (bytes, str)) and len(value) < 60 else reprlib.repr(value)
    if isinstance(value, np.ndarray):
        return f"an array {value.shape} of {value.dtype}"
    if isinstance(value, type):
        return f"the class {value.__name__}"
    package = type(value).__module__.partition(".")[0]
    return f"a {type(value).__name__}" + (f" of {package}" if package not in ("builtins", "__main__") else "")


def error(value: object, name: str, wanted: str) -> CaseError:
    """Return an error on a value; `wanted` says what is expected."""
    return CaseError(f"{name} is {describe(value)}: expected {wanted}")


def to_number(value: object) -> float | None:
    """Return a finite real number of Python or NumPy as a float; None for anything else, such as a text."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (Real, Decimal)):
        return None
    try:
        number = float(value)
    except (OverflowError, ValueError):
        return None
    return number if math.isfinite(number) else None


def number(value: Any, name: str) -> float:
    """Return a finite number."""
    if (found := to_number(value)) is None:
        raise error(value, name, "a finite number")
    return found


def positive(value: Any, name: str) -> float:
    """Return a number above zero, of a size whose square is a number too."""
    found = to_number(value)
    if found is None or found <= 0.0:
        raise error(value, name, "a number above 0")
    if not 1.0 / HUGE < found < HUGE:
        raise error(value, name, f"a number from {1.0 / HUGE:g} to {HUGE:g}")
    return found


def share(value: Any, name: str) -> float:
    """Return a number from zero, of a size whose square is a number too."""
    found = to_number(value)
    if found is None or not 0.0 <= found < HUGE:
        raise error(value, name, f"a number from 0 to {HUGE:g}")
    return found


def whole(least: int, most: int = _LARGEST) -> Rule:
    """Return a rule for whole numbers from `least` to `most`."""
    wanted = f"a whole number from {least}" + (f" to {most}" if most < _LARGEST else "")

    def rule(value: Any, name: str) -> int:
        if not isinstance(value, Integral) or isinstance(value, bool) or not least <= int(value) <= most:
            raise error(value, name, wanted)
        return int(value)

    return rule


def text(value: Any, name: str) -> str:
    """Return a text of one line."""
    if not isinstance(value, str) or not value.isprintable():
        raise error(value, name, "a text of one line")
    return value


def flag(value: Any, name: str) -> bool:
    """Return True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise error(value, name, "True or False")
    return bool(value)


def words(value: Any, name: str) -> str | tuple[str, ...]:
    """Return one text, or a tuple of texts."""
    if isinstance(value, str):
        return text(value, name)
    if isinstance(value, (Mapping, bytes)) or not isinstance(value, Iterable):
        raise error(value, name, "a text, or a list of texts")
    try:
        several = tuple(value)
    except (TypeError, ValueError) as err:  # a lazy frame, an array without dimension
        raise error(value, name, "a text, or a list of texts") from err
    return tuple(text(one, f"an entry of {name}") for one in several)


def list_texts(given: str | Iterable[str]) -> tuple[str, ...]:
    """Return one text or several texts as a tuple."""
    return (given,) if isinstance(given, str) else tuple(given)


def path(value: Any, name: str) -> Path:
    """Return the path of a file or folder."""
    if not isinstance(value, (str, os.PathLike)) or not isinstance(found := os.fspath(value), str):
        raise error(value, name, "the path of a file or folder")
    if not found.strip() or "\0" in found or any(len(os.fsencode(part)) > LONGEST for part in Path(found).parts):
        raise error(found, name, "the path of a file or folder")
    return Path(found)


def paths(value: Any, name: str) -> tuple[Path, ...]:
    """Return the paths of files or folders."""
    if isinstance(value, (str, os.PathLike, Mapping, bytes)) or not isinstance(value, Iterable):
        raise error(value, name, "a list of paths")
    return tuple(path(one, f"an entry of {name}") for one in value)


def choice(*known: str) -> Rule:
    """Return a rule for one of some texts."""

    def rule(value: Any, name: str) -> str:
        if not isinstance(value, str) or value not in known:
            hint = nearest(value, known) if isinstance(value, str) else ""
            raise CaseError(f"{name} is {describe(value)}{hint}: expected one of {', '.join(known)}")
        return value

    return rule


def mapping(rule: Rule, example: str) -> Rule:
    """Return a rule for a dictionary with texts as keys, whose values pass another rule; `example` is shown."""

    def check(value: Any, name: str) -> dict[str, Any]:
        if not isinstance(value, Mapping):
            raise error(value, name, f"a dictionary, such as {example}")
        if wrong := [key for key in value if not isinstance(key, str) or not key.isprintable()]:
            raise error(wrong[0], f"a key of {name}", f"a text, such as in {example}")
        return {key: rule(one, f"{name}[{key!r}]") for key, one in value.items()}

    return check


def anything(value: Any, _name: str) -> Any:
    """Return any value."""
    return value


def maybe(rule: Rule) -> Rule:
    """Return a rule that accepts None too."""
    return lambda value, name: None if value is None else rule(value, name)


def instance(kind: type, wanted: str) -> Rule:
    """Return a rule for objects of a class; `wanted` says how one is made."""

    def rule(value: Any, name: str) -> Any:
        if not isinstance(value, kind):
            raise error(value, name, wanted)
        return value

    return rule


random = instance(np.random.Generator, "a generator, such as numpy.random.default_rng(0)")
"""The rule of generators of random numbers."""
