"""Rules for models and terms: their parameters, and the functions that are compiled."""

from __future__ import annotations

import inspect
from collections import Counter
from dataclasses import fields
from typing import Any

from lostmotion.contracts import Model
from lostmotion.likelihood.plan import is_numeric
from lostmotion.quantities import Dimension
from lostmotion.testing.rules import join_words, rule

_COMPILED = {"model": ("rhs", "observe"), "term": ("force", "rate")}


def find_repeated(words: Any) -> list[str]:
    """Return the words that occur more than once."""
    return [word for word, count in Counter(iter(words)).items() if count > 1]


@rule("model", "dynamics", "term", declaration=True)
def params_are_unique(component: Any) -> str:
    """Give each parameter a unique name, and aliases of parameters that are no names: a case file uses either."""
    names, aliases = [q.name for q in component.params], getattr(component, "aliases", {})
    if again := find_repeated((*names, *aliases)):
        return f"{join_words(again)} occurs twice"
    if bad := [name for name in names if not name.isidentifier()]:
        return f"{bad[0]!r} is not an identifier"
    lost = [alias for alias, name in aliases.items() if name not in names]
    return f"{lost[0]!r} is an alias of {aliases[lost[0]]!r}, which is no parameter" if lost else ""


@rule("model", "dynamics", "term", declaration=True)
def bounds_are_ordered(component: Any) -> str:
    """Give physical bounds with `low` below `high`; with the scale "log", `low` is 0 or more."""
    for q in component.params:
        if not q.low < q.high:
            return f"{q.name} goes from {q.low:g} to {q.high:g}"
        if q.scale not in ("linear", "log") or (q.scale == "log" and q.low < 0.0):
            return f"{q.name} has scale {q.scale!r} and low {q.low:g}"
        if not q.prior.typical > 0.0:
            return f"{q.name} has the typical size {q.prior.typical:g}, and a prior needs a positive value"
    return ""


@rule("model", "dynamics", "term", declaration=True)
def dimensions_are_dimensions(component: Any) -> str:
    """Give each parameter a `Dimension` from lostmotion.quantities, such as DAMPING, which determines its unit."""
    bad = [q.name for q in component.params if not isinstance(q.dimension, Dimension)]
    return f"the dimension of {bad[0]} is not a Dimension" if bad else ""


@rule("model", "dynamics", "term", declaration=True, courtesy=True)
def params_have_meanings(component: Any) -> str:
    """Describe each parameter in a few words: reports and `lostmotion plugins show` print them."""
    bad = [q.name for q in component.params if not q.meaning.strip()]
    return f"{bad[0]} has no meaning" if bad else ""


@rule("model", "term", declaration=True)
def functions_are_static(component: Any) -> str:
    """Write `@staticmethod` above the functions; those of a term may be methods that read numeric fields."""
    kind = "model" if isinstance(component, Model) else "term"
    found = {name: inspect.getattr_static(type(component), name) for name in _COMPILED[kind]}
    bad = [name for name, function in found.items() if not isinstance(function, staticmethod)]
    values = [getattr(component, f.name) for f in fields(component) if f.name != "at"]
    if kind == "term" and any(is_numeric(value) for value in values):
        return ""
    return f"{bad[0]} is not a static method" if bad else ""


@rule("model", "dynamics", "term", declaration=True)
def states_are_named(component: Any) -> str:
    """Name each state once, with an identifier: results and reports use these names."""
    again, bad = (
        find_repeated(component.states),
        [s for s in component.states if not str(s).replace(".", "_").isidentifier()],
    )
    return f"state {join_words(again or bad)} is not a unique identifier" if again or bad else ""
