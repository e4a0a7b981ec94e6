"""A body with any of the effects that a blind trial hides, simulated by leapfrog and independent of the terms.

All coordinates are absolute. Dry friction is set-valued: the impulse of a step is the one that holds the parts
together, up to its bound, so the body sticks exactly (Moreau's time stepping; Acary, Brogliato, Numerical Methods for
Nonsmooth Dynamical Systems (2008)). A place is 0 for the ground and 1 for the base.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from lostmotion.kernels.stored import stored

DAHL, LUGRE, BOUC_WEN = 1.0, 2.0, 3.0
"""The kinds of a force with a state of its own."""


class Body(NamedTuple):
    """The nominal parameters in SI units: c and k0 with the gap x0 act towards the base, k towards the ground."""

    m: float
    c: float
    k: float
    k0: float
    x0: float


class Hidden(NamedTuple):
    """The hidden effects, in SI units; with the default values there are none."""

    friction: float = 0.0
    excess: float = 0.0
    velocity: float = 1.0
    friction_place: float = 0.0
    rough: float = 0.0
    rough_length: float = 1.0
    drag: float = 0.0
    drag_place: float = 0.0
    square: float = 0.0
    square_place: float = 0.0
    contact_drag: float = 0.0
    spring: float = 0.0
    spring_place: float = 0.0
    cube: float = 0.0
    cube_place: float = 0.0
    shift: float = 0.0
    push: float = 0.0
    memory: float = 0.0
    memory_force: float = 0.0
    memory_excess: float = 0.0
    memory_velocity: float = 1.0
    memory_travel: float = 1.0
    memory_place: float = 0.0
    depth: float = 0.0
    pace: float = 0.0
    phase: float = 0.0
    drift: float = 0.0
    ripple: float = 0.0
    ripple_length: float = 1.0
    ripple_phase: float = 0.0
    ripple_chirp: float = 0.0
    bump: float = 0.0
    bump_middle: float = 0.0
    bump_width: float = 1.0
    mixed: float = 0.0
    play: float = 0.0
    stop: float = 0.0
    stop_travel: float = 1.0
    stop_side: float = 0.0
    crush: float = 0.0
    hertz: float = 0.0
    fold: float = 0.0
    bow: float = 0.0
    mode_mass: float = 0.0
    mode_stiffness: float = 0.0
    mode_drag: float = 0.0
    friction_back: float = -1.0
    wave: float = 0.0
    wave_length: float = 1.0
    wave_phase: float = 0.0
    load: float = 0.0
    warm: float = 0.0
    warm_time: float = 1.0
    slant: float = 0.0
    aging: float = 0.0
    added: float = 0.0
    added_from: float = 0.0
    onset: float = -1e9


@stored(nogil=True)
def _springs(t, x, gap, body, h):  # type: ignore[no-untyped-def]
    """Return the force (N) of everything that depends on position and time."""
    wave = 1.0 + h.depth * math.cos(h.pace * t + h.phase)
    soft = wave if body.k0 == 0.0 else 1.0
    half = body.x0 + h.drift * max(t, 0.0)
    pressed = gap - h.shift
    pressed -= min(max(pressed, -half), half)
    force = h.push - body.k * soft * (x - min(max(x, -h.play), h.play))
    if body.k0 > 0.0:
        force -= body.k0 * wave * pressed
        if h.hertz != 0.0:
            force -= math.copysign(h.hertz * abs(pressed) ** 1.5, pressed)
    force -= h.fold * abs(x) + h.bow * x * x
    if h.stop > 0.0:
        over = max(x - h.stop_travel, 0.0) if h.stop_side >= 0.0 else 0.0
        under = max(-h.stop_travel - x, 0.0) if h.stop_side <= 0.0 else 0.0
        force -= h.stop * (over - under)
    force -= h.spring * (x if h.spring_place == 0.0 else gap)
    force -= h.cube * (x if h.cube_place == 0.0 else gap) ** 3
    if h.ripple != 0.0:
        turns = x / h.ripple_length
        force += h.ripple * math.sin(2.0 * math.pi * turns * (1.0 + h.ripple_chirp * turns) + h.ripple_phase)
    if h.bump != 0.0:
        force += h.bump * math.exp(-(((x - h.bump_middle) / h.bump_width) ** 2))
    return force


@stored(nogil=True)
def _drags(t, x, v, gap, slide, body, h):  # type: ignore[no-untyped-def]
    """Return the force (N) of every drag but the viscous one of the model and dry friction."""
    square = v if h.square_place == 0.0 else slide
    force = -h.drag * (v if h.drag_place == 0.0 else slide) - h.square * square * abs(square)
    if abs(gap) > body.x0:
        force -= (h.contact_drag + h.crush * (abs(gap) - body.x0)) * slide
    return force - h.mixed * x * x * v - h.slant * abs(v) - h.aging * max(t, 0.0) * v


@stored(nogil=True)
def _ridden(far, fast_far, middle, fast, step, h):  # type: ignore[no-untyped-def]
    """Return the force (N) of a hidden mass on the body, and position and velocity of that mass after one step."""
    between = h.mode_stiffness * (far + 0.5 * step * fast_far - middle) + h.mode_drag * (fast_far - fast)
    fast_far -= step * between / h.mode_mass
    return between, far + step * fast_far, fast_far


@stored(nogil=True)
def _levels(t, rub, place, load, h):  # type: ignore[no-untyped-def]
    """Return the level of dry friction (N) against motion in positive and in negative direction."""
    level = h.friction + h.excess * math.exp(-((rub / h.velocity) ** 2)) + h.rough * (place / h.rough_length) ** 2
    if h.wave != 0.0:
        level += h.wave * math.cos(2.0 * math.pi * place / h.wave_length + h.wave_phase)
    if h.warm != 0.0:
        level += h.warm * (1.0 - math.exp(-max(t, 0.0) / h.warm_time))
    level = max(level + h.load * load, 0.0)
    return level, level if h.friction_back < 0.0 else h.friction_back


@stored(nogil=True)
def _pressing(force, gap, body):  # type: ignore[no-untyped-def]
    """Return the load (N) on the parts: the contact force, or the drive where there is no contact."""
    if body.k0 > 0.0:
        return body.k0 * max(abs(gap) - body.x0, 0.0)
    return abs(force)


@stored(nogil=True)
def _remembered(z, v, step, h):  # type: ignore[no-untyped-def]
    """Return the state of a force with memory after one step at the velocity `v`: the force (N), or its share."""
    if h.memory == BOUC_WEN:
        middle = z + 0.5 * step * (v - 0.5 * (abs(v) * abs(z) * z + v * z * z)) / h.memory_travel
        return z + step * (v - 0.5 * (abs(v) * abs(middle) * middle + v * middle * middle)) / h.memory_travel
    level, travel = h.memory_force, h.memory_travel
    if h.memory == LUGRE:
        level += h.memory_excess * math.exp(-((v / h.memory_velocity) ** 2))
        travel *= level / h.memory_force
    level = level if v > 0.0 else -level
    return level + (z - level) * math.exp(-abs(v) * step / travel)


def move(force, base, body, hidden, state, clock, every):  # type: ignore[no-untyped-def]
    """Return position, velocity and acceleration (samples, 3) before every `every` steps; `state` moves on to the end.

    `force` (steps,) acts at the middle of each step; `base` (3, steps) is the position of the base at the middle and
    its velocity at the middle and at the end; `clock` is the time at the beginning and the step, in s. `state` has
    position, velocity, acceleration, the state of the force with memory, and position and velocity of a hidden mass.
    Hidden effects act from their onset on.
    """
    return _moved(force, base, body, hidden, Hidden(), state, clock, every)


@stored(nogil=True)
def _moved(force, base, body, hidden, nothing, state, clock, every):  # type: ignore[no-untyped-def]
    """Return the result of `move`; before the onset `nothing` replaces the hidden effects."""
    begin, step = clock
    x, v, a, z, far, fast_far = state
    seen = np.zeros((len(force) // every, 3))
    for k in range(len(seen) * every):
        now = begin + (k + 0.5) * step
        h = hidden if now >= hidden.onset else nothing
        m = body.m + (h.added if now >= h.added_from else 0.0)
        loss = 0.5 * step * body.c / m
        middle, fast = x + 0.5 * step * v, v + 0.5 * step * a
        gap, slide = middle - base[0, k], fast - base[1, k]
        pull = force[k] + _springs(now, middle, gap, body, h) + _drags(now, middle, fast, gap, slide, body, h)
        if h.mode_mass > 0.0:
            between, far, fast_far = _ridden(far, fast_far, middle, fast, step, h)
            pull += between
        if h.memory > 0.0:
            new = _remembered(z, slide if h.memory_place == 1.0 else fast, step, h)
            pull -= 0.5 * (z + new) * (h.memory_force if h.memory == BOUC_WEN else 1.0)
            z = new
        rub = slide if h.friction_place == 1.0 else fast
        place = gap if h.friction_place == 1.0 else middle
        ahead, back = _levels(now, rub, place, _pressing(force[k], gap, body), h)
        still = base[2, k] * h.friction_place
        slip = (v * (1.0 - loss) + step * pull / m + 2.0 * loss * base[1, k]) / (1.0 + loss) - still
        after = still + slip - min(max(slip, -step * back / m), step * ahead / m)
        if k % every == 0:
            seen[k // every, 0], seen[k // every, 1], seen[k // every, 2] = x, v, (after - v) / step
        a, v = (after - v) / step, after
        x = middle + 0.5 * step * v
    state[0], state[1], state[2], state[3], state[4], state[5] = x, v, a, z, far, fast_far
    return seen
