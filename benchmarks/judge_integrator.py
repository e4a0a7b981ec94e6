"""A body with forces that no term of the library describes, simulated by leapfrog without code of the framework.

Dry friction is set-valued, as in `lostmotion_trials.integrators.hidden`. The laws are those of `judge_foreign.py`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numba
import numpy as np

NOTHING, EXPONENTIAL, ONE_SIDED, POWER_DRAG, PATCH, SPRING_RUB, CLIPPED, MAXWELL = range(8)
SOFT_EDGE, SATURATED, SQUEEZE, HUMPS, PENDULUM = range(8, 13)
"""The kinds of laws."""


class Law(NamedTuple):
    """A hidden law: its kind, its size and up to three further numbers, in SI units; `friction` (N) acts beside it."""

    kind: int = NOTHING
    size: float = 0.0
    a: float = 1.0
    b: float = 1.0
    c: float = 1.0
    friction: float = 0.0


@numba.njit(cache=True, nogil=True)
def compute_force(x, v, z, body, law):  # type: ignore[no-untyped-def]
    """Return the force (N) of a law at position and velocity; `z` is the force of a Maxwell element."""
    kind, size = law.kind, law.size
    depth = abs(x) - body.x0
    side = 1.0 if x > 0.0 else -1.0
    force = 0.0
    if kind == EXPONENTIAL and depth > 0.0:
        force = -side * size * (math.exp(min(depth / law.a, 30.0)) - 1.0)
    elif kind == ONE_SIDED:
        force = -size * max(x, 0.0) ** 1.5
    elif kind == POWER_DRAG:
        force = -math.copysign(size * abs(v) ** 1.5, v)
    elif kind == CLIPPED:
        force = -size * min(max(x / law.a, -1.0), 1.0)
    elif kind == MAXWELL:
        force = -z
    elif kind == SOFT_EDGE:
        soft = law.a * math.log1p(math.exp(-abs(depth) / law.a))
        force = -side * size * body.k0 * soft
    elif kind == SATURATED:
        force = -size * math.tanh(x / law.a)
    elif kind == SQUEEZE:
        force = -size * x * x * v
    elif kind == HUMPS:
        at = x / law.a
        force = size * (math.exp(-(((at - 0.4) / 0.5) ** 2)) - 0.7 * math.exp(-(((at + 0.7) / 0.3) ** 2)))
    elif kind == PENDULUM:
        force = -size * math.sin(x)
    return force


@numba.njit(cache=True, nogil=True)
def compute_level(x, law):  # type: ignore[no-untyped-def]
    """Return the level (N) of the dry friction of a law at a position."""
    level = law.friction
    if law.kind == PATCH:
        ahead, behind = (x - law.a + law.b) / law.c, (x - law.a - law.b) / law.c
        level += law.size * 0.5 * (math.tanh(ahead) - math.tanh(behind))
    elif law.kind == SPRING_RUB:
        level += law.size * abs(x)
    return level


@numba.njit(cache=True, nogil=True)
def move_law(force, body, law, state, step, every):  # type: ignore[no-untyped-def]
    """Return position, velocity and acceleration (samples, 3) before every `every` steps; `state` moves on to the end.

    `force` (steps,) acts at the middle of each step of `step` seconds. `body` has m, c, k, k0 and x0 as in
    `hidden.Body`. `state` has position, velocity, acceleration and the force of a Maxwell element, whose stiffness is
    the size of the law and whose time constant is its `a`.
    """
    x, v, acceleration, z = state[0], state[1], state[2], state[3]
    loss = 0.5 * step * body.c / body.m
    seen = np.zeros((len(force) // every, 3))
    fade = math.exp(-step / law.a)
    for k in range(len(seen) * every):
        middle, fast = x + 0.5 * step * v, v + 0.5 * step * acceleration
        if law.kind == MAXWELL:
            z = z * fade + law.size * law.a * (1.0 - fade) * fast
        pressed = middle - min(max(middle, -body.x0), body.x0)
        pull = force[k] - body.k * middle - body.k0 * pressed + compute_force(middle, fast, z, body, law)
        bound = step * compute_level(middle, law) / body.m
        after = (v * (1.0 - loss) + step * pull / body.m) / (1.0 + loss)
        after -= min(max(after, -bound), bound)
        if k % every == 0:
            seen[k // every, 0], seen[k // every, 1], seen[k // every, 2] = x, v, (after - v) / step
        acceleration, v = (after - v) / step, after
        x = middle + 0.5 * step * v
    state[0], state[1], state[2], state[3] = x, v, acceleration, z
    return seen
