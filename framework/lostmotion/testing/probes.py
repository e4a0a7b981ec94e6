"""The test points of rules: strictly positive parameters, and states of either sign."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from lostmotion.contracts import Array, Model, Param, Term

DRAWS = 12
STEP = 1e-3
"""The integration step (s) of a term that has states or needs `step`."""
_NEEDED = {"step": STEP, "finest": STEP, "mobility": STEP, "force_input": 0.0, "shake_input": -1.0}


@dataclass(frozen=True)
class Point:
    """One set of arguments: time, states `y` or motion `x`, `v` with states `s`, inputs `u`, parameters `p`."""

    t: float
    y: Array
    u: Array
    p: Array
    x: float = 0.0
    v: float = 0.0


def draw_values(params: Sequence[Param], rng: np.random.Generator | None) -> list[float]:
    """Return parameters of one, or random ones near it, within their bounds: strictly positive where possible."""
    near = np.ones(len(params)) if rng is None else np.exp(0.5 * rng.standard_normal(len(params)))
    return [float(min(max(v, q.low), q.high)) for v, q in zip(near, params, strict=True)]


def points_of_model(model: Model) -> Iterator[Point]:
    """Yield test points for a model; at the first one each parameter is one."""
    rng = np.random.default_rng(7)
    for i in range(DRAWS):
        p = np.array(draw_values(model.params, rng if i else None))
        yield Point(0.1 * i, _draw_numbers(rng, len(model.states)), _draw_numbers(rng, len(model.inputs)), p)


def points_of_term(term: Term, *, null: bool = False) -> Iterator[Point]:
    """Yield test points for a term, with `p` of parameters and needs; with `null`, where it must have no effect."""
    rng = np.random.default_rng(11)
    for i in range(DRAWS):
        own = draw_values(term.params, rng if i else None)
        if null:
            own = [v if q.null is None else q.null for v, q in zip(own, term.params, strict=True)]
        needs = [_NEEDED.get(name, float(np.exp(0.5 * rng.standard_normal()))) for name in term.needs]
        x, v = (float(a) for a in _draw_numbers(rng, 2))
        states = np.zeros(len(term.states)) if null else _draw_numbers(rng, len(term.states))
        yield Point(0.1 * i, states, _draw_numbers(rng, 2), np.array(own + needs), x, v)


def _draw_numbers(rng: np.random.Generator, n: int) -> Array:
    """Return random numbers of either sign and different sizes, up to a few times one."""
    return np.asarray(3.0 * rng.standard_normal(n) * rng.random())


def make_blank(n: int) -> Array:
    """Return an array of NaN, in which entries that are not written, or only added to, can be detected."""
    return np.full(n, math.nan)


def relative_difference(a: Any, b: Any) -> float:
    """Return the largest difference between two results relative to their size; equal infinities do not differ."""
    one, two = np.atleast_1d(np.asarray(a, float)), np.atleast_1d(np.asarray(b, float))
    if np.array_equal(one, two, equal_nan=True):
        return 0.0
    gap = float(np.max(np.abs(one - two) / np.maximum(1.0, np.abs(one))))
    return gap if math.isfinite(gap) else math.inf


@lru_cache(maxsize=256)
def compile_function(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the function compiled as the host compiles it, with the plain functions that it calls."""
    from lostmotion.likelihood.adopted import adopt_function

    fast: Callable[..., Any] = adopt_function(function, __name__)
    return fast
