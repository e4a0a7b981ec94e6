"""The numbers that rules try: strictly positive parameters, states of every sign, and copies that betray a change."""

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
"""The integration step (s) of a term that has states or asks for `step`."""
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


def values(params: Sequence[Param], rng: np.random.Generator | None) -> list[float]:
    """Return parameters of one, or near it at random, kept within their bounds: strictly positive where they may be."""
    near = np.ones(len(params)) if rng is None else np.exp(0.5 * rng.standard_normal(len(params)))
    return [float(min(max(v, q.low), q.high)) for v, q in zip(near, params, strict=True)]


def of_model(model: Model) -> Iterator[Point]:
    """Yield points for a model: the first with every parameter at one."""
    rng = np.random.default_rng(7)
    for i in range(DRAWS):
        p = np.array(values(model.params, rng if i else None))
        yield Point(0.1 * i, _spread(rng, len(model.states)), _spread(rng, len(model.inputs)), p)


def of_term(term: Term, *, null: bool = False) -> Iterator[Point]:
    """Yield points for a term, its own parameters followed by its needs; with `null`, where it must do nothing."""
    rng = np.random.default_rng(11)
    for i in range(DRAWS):
        own = values(term.params, rng if i else None)
        if null:
            own = [v if q.null is None else q.null for v, q in zip(own, term.params, strict=True)]
        needs = [_NEEDED.get(name, float(np.exp(0.5 * rng.standard_normal()))) for name in term.needs]
        x, v = (float(a) for a in _spread(rng, 2))
        states = np.zeros(len(term.states)) if null else _spread(rng, len(term.states))
        yield Point(0.1 * i, states, _spread(rng, 2), np.array(own + needs), x, v)


def _spread(rng: np.random.Generator, n: int) -> Array:
    """Return numbers of either sign, from small to a few times one."""
    return np.asarray(3.0 * rng.standard_normal(n) * rng.random())


def blank(n: int) -> Array:
    """Return an array in which an entry that was not written is seen: NaN stays, and nothing can be added to it."""
    return np.full(n, math.nan)


def differ(a: Any, b: Any) -> float:
    """Return the largest difference between two results relative to their size; equal infinities do not differ."""
    one, two = np.atleast_1d(np.asarray(a, float)), np.atleast_1d(np.asarray(b, float))
    if np.array_equal(one, two, equal_nan=True):
        return 0.0
    gap = float(np.max(np.abs(one - two) / np.maximum(1.0, np.abs(one))))
    return gap if math.isfinite(gap) else math.inf


@lru_cache(maxsize=256)
def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the function compiled as the host compiles it, with the plain functions that it calls."""
    from lostmotion.likelihood.adopted import adopted

    fast: Callable[..., Any] = adopted(function, __name__)
    return fast
