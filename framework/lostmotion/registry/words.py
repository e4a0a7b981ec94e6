"""Whether what a plugin says of itself has the types that everybody who reads it counts on."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from numbers import Real
from typing import Any

TEXTS = ("name", "physics", "formula", "paper", "motion")
LISTS = ("states", "inputs", "channels", "needs", "motions", "resembles", "equals")
_MISSING = object()

Check = Callable[[Any], bool]


def misfit(cls: type[Any]) -> str:
    """Return the first thing that a class says of itself in a form that nobody can read, or an empty string."""
    return next(_misfits(cls), "")


def _misfits(cls: type[Any]) -> Iterator[str]:
    from lostmotion import contracts

    yield from _complaints(cls, TEXTS, _text, "text")
    yield from _complaints(cls, LISTS, _texts, "a tuple of texts")
    if hasattr(cls, "params") and not (getattr(cls, "motions", ()) or hasattr(cls, "motion")):
        yield "neither motion nor motions: write 'translation' or 'rotation', or both"
    for key, kind in (("params", contracts.Param), ("further", contracts.Param), ("interfaces", contracts.Interface)):
        entries = getattr(cls, key, ())
        if not isinstance(entries, tuple) or not all(isinstance(entry, kind) for entry in entries):
            yield f"{key} = {_short(entries)}: write a tuple of {kind.__name__}"
            return
        for entry in entries:
            yield from (f"{key}: {wrong}" for wrong in (_param(entry) if kind is contracts.Param else _place(entry)))


def _param(param: Any) -> Iterator[str]:
    from lostmotion.quantities import Dimension

    yield from _complaints(param, ("name", "meaning", "scale"), _text, "text")
    yield from _complaints(param, ("low", "high", "typical"), _real, "a number")
    yield from _complaints(param, ("null",), lambda value: value is None or _real(value), "a number or None")
    yield from _complaints(param, ("aliases", "words"), _texts, "a tuple of texts")
    if getattr(param, "words", ()) and len(param.words) != len(getattr(param, "choices", ())):
        yield f"{len(param.words)} words for {len(param.choices)} choices: write one for each"
    yield from _complaints(param, ("choices", "far"), lambda value: _all(value, _real), "a tuple of numbers")
    yield from _complaints(param, ("dimension",), lambda value: isinstance(value, Dimension), "a Dimension")


def _place(place: Any) -> Iterator[str]:
    yield from _complaints(place, ("name", "inertia"), _text, "text")
    yield from _complaints(place, ("row",), lambda value: isinstance(value, int), "a whole number")
    yield from _complaints(place, ("holds",), _texts, "a tuple of texts")


def _complaints(whose: Any, keys: Iterable[str], right: Check, wanted: str) -> Iterator[str]:
    """Yield a complaint for each attribute that is there and is not right."""
    for key in keys:
        value = getattr(whose, key, _MISSING)
        if value is not _MISSING and not right(value):
            yield f"{key} = {_short(value)}: write {wanted}"


def _text(value: Any) -> bool:
    return isinstance(value, str)


def _real(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return not math.isnan(float(value))
    except OverflowError:
        return False


def _texts(value: Any) -> bool:
    return _all(value, _text)


def _all(values: Any, right: Check) -> bool:
    return isinstance(values, (tuple, list, set, frozenset)) and all(map(right, values))


def _short(value: Any) -> str:
    try:
        return repr(value)[:40]
    except ValueError:
        return f"a {type(value).__name__} too long to print"
