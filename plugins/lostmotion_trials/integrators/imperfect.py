"""A body with the imperfections of real rigs, simulated by leapfrog: small forces that no library term describes.

The hidden mechanisms are those of `hidden`. In addition there are a force over position, a force over velocity,
friction whose level follows a curve over the speed, a compliant foot, and a mode far above the band that the sensor
sees. Without these the motion equals that of `hidden.move` (`tests/science/test_rough.py`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lostmotion.kernels.stored import stored
from lostmotion_trials.integrators.hidden import (
    BOUC_WEN,
    Hidden,
    _drags,
    _levels,
    _pressing,
    _remembered,
    _ridden,
    _springs,
)

CELLS = 400
REACH = 3.0
"""Curves are tabulated over so many scales of the motion to either side, and constant beyond."""


class Flaws(NamedTuple):
    """The imperfections of a rig, in SI units; with the default values there are none.

    `position` and `velocity` (m, m/s) are the scales of the three curves. The foot has a stiffness (N/m, 0: rigid) and
    a drag (N s/m). The far mode has an angular frequency (rad/s, 0: none), a damping ratio and a compliance (m/N).
    """

    position: float = 1.0
    velocity: float = 1.0
    foot: float = 0.0
    foot_drag: float = 1.0
    far_pace: float = 0.0
    far_loss: float = 0.01
    far_compliance: float = 0.0


@stored(nogil=True)
def _read(table, z):  # type: ignore[no-untyped-def]
    """Return the value of a curve (CELLS + 1,) over [-REACH, REACH] at `z`, by straight lines between its nodes."""
    at = min(max((z + REACH) * CELLS / (2.0 * REACH), 0.0), CELLS - 1e-9)
    cell = int(at)
    return table[cell] + (at - cell) * (table[cell + 1] - table[cell])


def move_rough(force, base, body, hidden, flaws, curves, state, clock, every):  # type: ignore[no-untyped-def]
    """Return what a sensor at the body shows (samples, 1) before every `every` steps; `state` moves on to the end.

    As `hidden.move`, with `curves` (3, CELLS + 1): force (N) over position, force (N) over velocity, and the
    level of friction over the speed, in shares of its usual one. `state` holds position, velocity, acceleration, what
    is remembered, the way of the foot, place and velocity of the far mode, and those of a hidden mass.
    """
    return _moved(force, base, body, hidden, Hidden(), flaws, curves, state, clock, every)


@stored(nogil=True)
def _moved(force, base, body, hidden, nothing, flaws, curves, state, clock, every):  # type: ignore[no-untyped-def]
    """Return what `move_rough` does; before its onset `nothing` stands for what is hidden."""
    begin, step = clock
    x, v, a, z, sunk, far, fast_far, own, fast_own = state
    seen = np.zeros((len(force) // every, 1))
    for k in range(len(seen) * every):
        if k % every == 0:
            seen[k // every, 0] = x + far
        now = begin + (k + 0.5) * step
        h = hidden if now >= hidden.onset else nothing
        m = body.m + (h.added if now >= h.added_from else 0.0)
        loss = 0.5 * step * body.c / m
        middle, fast = x + 0.5 * step * v, v + 0.5 * step * a
        gap, slide = middle - base[0, k] - sunk, fast - base[1, k]
        inner = _springs(now, middle, gap, body, h) + _drags(now, middle, fast, gap, slide, body, h)
        if h.mode_mass > 0.0:
            between, own, fast_own = _ridden(own, fast_own, middle, fast, step, h)
            inner += between
        inner += _read(curves[0], middle / flaws.position) + _read(curves[1], fast / flaws.velocity)
        pull = force[k] + inner
        if flaws.foot > 0.0:
            sunk += step * (-inner - flaws.foot * sunk) / flaws.foot_drag
        if h.memory > 0.0:
            new = _remembered(z, slide if h.memory_place == 1.0 else fast, step, h)
            shape = _read(curves[2], abs(fast) / flaws.velocity)
            pull -= shape * 0.5 * (z + new) * (h.memory_force if h.memory == BOUC_WEN else 1.0)
            z = new
        rub = slide if h.friction_place == 1.0 else fast
        place = gap if h.friction_place == 1.0 else middle
        ahead, back = _levels(now, rub, place, _pressing(force[k], gap, body), h)
        shape = _read(curves[2], abs(rub) / flaws.velocity)
        still = base[2, k] * h.friction_place
        slip = (v * (1.0 - loss) + step * pull / m + 2.0 * loss * base[1, k]) / (1.0 + loss) - still
        after = still + slip - min(max(slip, -step * shape * back / m), step * shape * ahead / m)
        a, v = (after - v) / step, after
        x = middle + 0.5 * step * v
        if flaws.far_pace > 0.0:
            push = flaws.far_compliance * m * a - far
            fast_far += step * (flaws.far_pace**2 * push - 2.0 * flaws.far_loss * flaws.far_pace * fast_far)
            far += step * fast_far
    state[0], state[1], state[2], state[3] = x, v, a, z
    state[4], state[5], state[6], state[7], state[8] = sunk, far, fast_far, own, fast_own
    return seen
