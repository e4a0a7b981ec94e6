"""Checks of the types of the attributes that a plugin class declares."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from numbers import Real
from typing import Any

TEXTS = ("name", "physics", "formula", "paper", "motion")
LISTS = ("inputs", "channels", "needs", "motions", "equals")
_MISSING = object()

Check = Callable[[Any], bool]


def find_misfit(cls: type[Any]) -> str:
    """Return a sentence on the first declared attribute of a class with a wrong type, or an empty string."""
    return next(_find_misfits(cls), "")


def _find_misfits(cls: type[Any]) -> Iterator[str]:
    from lostmotion import contracts

    yield from _check_attributes(cls, TEXTS, _is_text, "text")
    yield from _check_attributes(cls, LISTS, _is_texts, "a tuple of texts")
    yield from _check_attributes(cls, ("states",), lambda value: _is_texts(tuple(value)), "names of states")
    yield from _check_attributes(cls, ("aliases",), _maps_texts, "a mapping of texts to names of parameters")
    if issubclass(cls, contracts.Machine) and not (cls.motions or hasattr(cls, "motion")):
        yield "neither motion nor motions: write 'translation' or 'rotation', or both"
    lists = {"params": contracts.Param, "interfaces": contracts.Interface}
    for key, kind in (lists | ({"places": contracts.Place} if issubclass(cls, contracts.Dynamics) else {})).items():
        entries = getattr(cls, key, ())
        if not isinstance(entries, tuple) or not all(isinstance(entry, kind) for entry in entries):
            yield f"{key} = {_shorten(entries)}: write a tuple of {kind.__name__}"
            return
        for entry in entries:
            yield from (
                f"{key}: {wrong}" for wrong in (_check_param(entry) if kind is contracts.Param else _check_place(entry))
            )


def _check_param(param: Any) -> Iterator[str]:
    from lostmotion.parts import TermPrior
    from lostmotion.quantities import Dimension

    yield from _check_attributes(param, ("name", "meaning", "scale"), _is_text, "text")
    yield from _check_attributes(param, ("low", "high"), _is_real, "a number")
    yield from _check_attributes(param, ("null",), lambda value: value is None or _is_real(value), "a number or None")
    yield from _check_attributes(param, ("prior",), lambda value: isinstance(value, TermPrior), "a TermPrior")
    if isinstance(param.prior, TermPrior):
        yield from _check_prior(param.prior)
    yield from _check_attributes(param, ("dimension",), lambda value: isinstance(value, Dimension), "a Dimension")


def _check_prior(prior: Any) -> Iterator[str]:
    yield from _check_attributes(prior, ("typical",), _is_real, "a number")
    yield from _check_attributes(prior, ("words",), _is_texts, "a tuple of texts")
    yield from _check_attributes(prior, ("choices",), lambda value: _are_all(value, _is_real), "a tuple of numbers")
    if prior.words and len(prior.words) != len(prior.choices):
        yield f"{len(prior.words)} words for {len(prior.choices)} choices: write one for each"


def _check_place(place: Any) -> Iterator[str]:
    yield from _check_attributes(place, ("name", "inertia"), _is_text, "text")
    yield from _check_attributes(place, ("row",), lambda value: isinstance(value, int), "a whole number")
    yield from _check_attributes(place, ("holds",), _is_texts, "a tuple of texts")


def _check_attributes(whose: Any, keys: Iterable[str], right: Check, wanted: str) -> Iterator[str]:
    """Yield a sentence for each existing attribute that does not pass the check."""
    for key in keys:
        value = getattr(whose, key, _MISSING)
        if value is not _MISSING and not right(value):
            yield f"{key} = {_shorten(value)}: write {wanted}"


def _is_text(value: Any) -> bool:
    return isinstance(value, str)


def _is_real(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return not math.isnan(float(value))
    except OverflowError:
        return False


def _is_texts(value: Any) -> bool:
    return _are_all(value, _is_text)


def _maps_texts(value: Any) -> bool:
    return isinstance(value, Mapping) and _is_texts((*value, *value.values()))


def _are_all(values: Any, right: Check) -> bool:
    return isinstance(values, (tuple, list, set, frozenset)) and all(map(right, values))


def _shorten(value: Any) -> str:
    try:
        return repr(value)[:40]
    except ValueError:
        return f"a {type(value).__name__} too long to print"
