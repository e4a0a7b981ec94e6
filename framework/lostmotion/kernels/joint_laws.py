"""The forces of laws at a joint, and the moments of a clipped position, under the uncertainty of the state."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from lostmotion.kernels import vector
from lostmotion.kernels.stored import stored
from lostmotion.kernels.vector import STRIDE

pointer: Any = vector.pointer
call: Any = vector.call

_FEW = np.polynomial.hermite_e.hermegauss(3)
_MANY = np.polynomial.hermite_e.hermegauss(14)
FEW, FEW_SHARES = _FEW[0], _FEW[1] / _FEW[1].sum()
MANY, MANY_SHARES = _MANY[0], _MANY[1] / _MANY[1].sum()
"""Nodes and weights of Gauss-Hermite quadrature: far from zero velocity, where laws are smooth, and near it."""
_RT2, _RT2PI = math.sqrt(2.0), math.sqrt(2.0 * math.pi)


@stored(nogil=True, error_model="numpy")
def clip_moments(m, s, c):  # type: ignore[no-untyped-def]
    """Return mean, slope and remaining variance of clip(d, -c, c) for d of mean `m` and standard deviation `s`."""
    a, b = (-c - m) / s, (c - m) / s
    if a > 8.0:
        return -c, 0.0, 0.0
    if b < -8.0:
        return c, 0.0, 0.0
    below, above = 0.5 * math.erfc(-a / _RT2), 0.5 * math.erfc(b / _RT2)
    fa = math.exp(-0.5 * a * a) / _RT2PI if abs(a) < 30.0 else 0.0
    fb = math.exp(-0.5 * b * b) / _RT2PI if abs(b) < 30.0 else 0.0
    p = 1.0 - below - above
    mean = c * (above - below) + m * p + s * (fa - fb)
    square = c * c * (below + above) + (m * m + s * s) * p + 2.0 * m * s * (fa - fb) + s * s * (a * fa - b * fb)
    return mean, p, max(square - mean * mean - p * p * s * s, 0.0)


@stored(nogil=True, error_model="numpy")
def fill_numbers(a, lanes, mobility, step, firsts, widths, needs, numbers, own):  # type: ignore[no-untyped-def]
    """Write the numbers of law `a` into its desk `own`, with those that only the filter knows."""
    for b in range(widths[a]):
        kind = needs[firsts[a] + b]
        number = numbers[firsts[a] + b]
        if kind == 1:
            number = mobility
        elif kind == 2:
            number = step
        elif kind == 3:
            number = step / mobility
        for o in range(lanes):
            own[b, o] = number


@stored(nogil=True, error_model="numpy", forceinline=True)
def find_push(push, k, W, joint, motor, light, hs, between):  # type: ignore[no-untyped-def]
    """Write what a unit force at a joint changes in the state within a step of sample `k` into `push` (L,).

    It acts on the link, or on the `motor` (its place in the state, or -1) of mobility `light`; a force `between` both
    acts on the link in the opposite direction.
    """
    n = W.shape[1]
    push[:] = 0.0
    if motor < 0 or between:
        sign = 1.0 if motor < 0 else -1.0
        for a in range(n):
            push[n + a] = sign * hs * W[k, a, joint]
            push[a] = 0.5 * hs * push[n + a]
    if motor >= 0:
        push[motor + 1] = hs * light
        push[motor] = 0.5 * hs * push[motor + 1]


@stored(nogil=True, error_model="numpy")
def average_laws(  # type: ignore[no-untyped-def]
    t, q, v, gained, sq, sv, j, mobility, step, joints, slots, addresses, firsts, widths, needs, numbers, own, desk
):  # fmt: skip
    """Return the mean force of the laws of a joint, its slopes over position and velocity, and its variance.

    `v` is the velocity after a step, of which `gained` has been gained in it: far from rest, laws act at the velocity
    in the middle. Laws with an inner state, in one of the `slots` of the state, do not count.
    """
    spread = 6.0 * sv
    near = abs(v) < spread + 1e-9
    for a in range(len(joints)):
        if joints[a] == j and slots[a] < 0:  # the width of the line of dry friction: a force times the mobility
            for b in range(widths[a]):
                if needs[firsts[a] + b] == 1 and abs(v) < spread + 3.0 * mobility * abs(numbers[firsts[a]]):
                    near = True
    if not near:
        v -= 0.5 * gained
    count = len(MANY) if near else len(FEW)
    lanes = count + 2
    for o in range(lanes):
        node = 0.0
        if o < count:
            node = MANY[o] if near else FEW[o]
        desk[0, o], desk[2, o], desk[3, o] = t, v + sv * node, 0.0
        desk[1, o] = q + (sq if o == count else (-sq if o == count + 1 else 0.0))
    mean, square, slope, slant = 0.0, 0.0, 0.0, 0.0
    total = desk[4]
    for o in range(lanes):
        total[o] = 0.0
    for a in range(len(joints)):
        if joints[a] != j or slots[a] >= 0:
            continue
        fill_numbers(a, lanes, mobility, step, firsts, widths, needs, numbers, own)
        if call(addresses[a], pointer(own), pointer(desk), lanes) != 0:
            return math.nan, 0.0, 0.0, 0.0
        for o in range(lanes):
            total[o] += desk[3, o]
    for o in range(count):
        share = MANY_SHARES[o] if near else FEW_SHARES[o]
        node = MANY[o] if near else FEW[o]
        mean += share * total[o]
        square += share * total[o] * total[o]
        slope += share * node * total[o]
    slope /= sv
    slant = (total[count] - total[count + 1]) / (2.0 * sq)
    return mean, slant, slope, max(square - mean * mean - slope * slope * sv * sv, 0.0)


@stored(nogil=True, error_model="numpy")
def evaluate_law(address, numbers, t, q, v, found):  # type: ignore[no-untyped-def]
    """Write the force of a law with all its `numbers` at times, positions and velocities (samples,) into `found`."""
    own, desk = np.zeros((16, STRIDE)), np.zeros((8, STRIDE))
    for first in range(0, len(t), STRIDE):
        lanes = min(STRIDE, len(t) - first)
        for o in range(lanes):
            desk[0, o], desk[1, o], desk[2, o] = t[first + o], q[first + o], v[first + o]
            for a in range(len(numbers)):
                own[a, o] = numbers[a]
        if call(address, pointer(own), pointer(desk), lanes) != 0:
            return False
        for o in range(lanes):
            found[first + o] = desk[3, o]
    return True
