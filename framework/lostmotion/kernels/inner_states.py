"""Laws at joints with an inner state: hysteresis, and friction through bristles that bend before they slide."""

from __future__ import annotations

import math

import numpy as np

from lostmotion.kernels.joint_laws import FEW, FEW_SHARES, MANY, MANY_SHARES, call, fill_numbers, pointer
from lostmotion.kernels.stored import stored
from lostmotion.kernels.vector import STRIDE

FORCE, STATE, RATE = 3, 4, 5
"""Rows of the desk of a law."""


@stored(nogil=True, error_model="numpy")
def average_law(t, means, spreads, row, a, hs, table, own, desk, slopes):  # type: ignore[no-untyped-def]
    """Return mean and remaining variance of a row of the desk of law `a`, and write its `slopes` (3,).

    `means` and `spreads` (3,) are those of position, velocity and inner state.
    """
    addresses, firsts, widths, needs, numbers = table
    near = abs(means[1]) < 6.0 * spreads[1] + 1e-9
    count = len(MANY) if near else len(FEW)
    lanes = count + 4
    for o in range(lanes):
        desk[0, o], desk[1, o], desk[2, o], desk[STATE, o] = t, means[0], means[1], means[2]
        desk[FORCE, o], desk[RATE, o] = 0.0, 0.0
    for o in range(count):
        desk[2, o] += spreads[1] * (MANY[o] if near else FEW[o])
    desk[1, count] += spreads[0]
    desk[1, count + 1] -= spreads[0]
    desk[STATE, count + 2] += spreads[2]
    desk[STATE, count + 3] -= spreads[2]
    fill_numbers(a, lanes, 0.0, hs, firsts, widths, needs, numbers, own)
    if call(addresses[a], pointer(own), pointer(desk), lanes) != 0:
        slopes[:] = 0.0
        return math.nan, 0.0
    mean, square, slope = 0.0, 0.0, 0.0
    for o in range(count):
        share, node = (MANY_SHARES[o], MANY[o]) if near else (FEW_SHARES[o], FEW[o])
        found = desk[row, o]
        mean += share * found
        square += share * found * found
        slope += share * node * found
    slopes[0] = (desk[row, count] - desk[row, count + 1]) / (2.0 * spreads[0])
    slopes[1] = slope / spreads[1]
    slopes[2] = (desk[row, count + 2] - desk[row, count + 3]) / (2.0 * spreads[2])
    return mean, max(square - mean * mean - slope * slope, 0.0)


@stored(nogil=True, error_model="numpy")
def follow_path(address, numbers, t, q, v, found):  # type: ignore[no-untyped-def]
    """Write the force of a law with all its `numbers` along a path (samples,) into `found`; False where it fails.

    The inner state begins at zero.
    """
    own, desk = np.zeros((16, STRIDE)), np.zeros((8, STRIDE))
    for a in range(len(numbers)):
        own[a, 0] = numbers[a]
    for k in range(len(t)):
        desk[0, 0], desk[1, 0], desk[2, 0] = t[k], q[k], v[k]
        desk[FORCE, 0], desk[RATE, 0] = 0.0, 0.0
        if call(address, pointer(own), pointer(desk), 1) != 0:
            return False
        found[k] = desk[FORCE, 0]
        if k + 1 < len(t):
            desk[STATE, 0] += (t[k + 1] - t[k]) * desk[RATE, 0]
    return True


@stored(nogil=True, error_model="numpy")
def see_motion(x, P, ends, hs, means, spreads):  # type: ignore[no-untyped-def]
    """Write means and standard deviations (3,) of position, velocity and inner state of a law.

    `ends` (5,) are the states of position, velocity and inner state, and those that position and velocity are relative
    to, or -1. The position is that in the middle of a step of length `hs`.
    """
    b, c, s, b2, c2 = ends
    q, v, var_q, var_v = x[b] - 0.5 * hs * x[c], x[c], P[b, b], P[c, c]
    if b2 >= 0:
        q, v = q - x[b2] + 0.5 * hs * x[c2], v - x[c2]
        var_q += P[b2, b2] - 2.0 * P[b, b2]
        var_v += P[c2, c2] - 2.0 * P[c, c2]
    means[0], means[1], means[2] = q, v, x[s]
    spreads[0], spreads[1] = math.sqrt(max(var_q, 1e-24)), math.sqrt(max(var_v, 1e-24))
    spreads[2] = math.sqrt(max(P[s, s], 1e-24))


@stored(nogil=True, error_model="numpy")
def combine_rows(M, ends, slopes, found):  # type: ignore[no-untyped-def]
    """Write the combination of rows of a matrix (L, columns) by the slopes of a law into `found` (columns,)."""
    b, c, s, b2, c2 = ends
    for j in range(M.shape[1]):
        found[j] = slopes[0] * M[b, j] + slopes[1] * M[c, j] + slopes[2] * M[s, j]
        if b2 >= 0:
            found[j] -= slopes[0] * M[b2, j] + slopes[1] * M[c2, j]


@stored(nogil=True, error_model="numpy")
def place_law(ends, joint, links, motor, slot, between):  # type: ignore[no-untyped-def]
    """Write the states of a law at a joint of `links` joints, whose motor has the place `motor` or -1, into `ends`."""
    ends[0], ends[1], ends[2], ends[3], ends[4] = joint, links + joint, slot, -1, -1
    if motor >= 0:
        ends[0], ends[1] = motor, motor + 1
        if between:
            ends[3], ends[4] = joint, links + joint


@stored(nogil=True, error_model="numpy")
def follow_law(t, x, P, F, E, keep, ends, row, push, hs, a, table, own, desk, room):  # type: ignore[no-untyped-def]
    """Add a row of the desk of law `a`, averaged over the uncertainty, to the state `x` along `push` (L,).

    For `RATE` that is its inner state, before a step; for `FORCE` the velocities, after it. So the inner state is that
    in the middle of the step (leapfrog: Hairer, Lubich, Wanner, Acta Numerica 12 (2003) 399-450). With `keep` the
    transitions `F` and `E` follow. `room` (2, wide) is overwritten.
    """
    L = len(x)
    means, spreads, slopes = np.zeros(3), np.zeros(3), np.zeros(3)
    d, more = room[0], room[1]
    see_motion(x, P, ends, hs, means, spreads)
    mean, left = average_law(t, means, spreads, row, a, hs, table, own, desk, slopes)
    combine_rows(P, ends, slopes, d)
    inner = slopes[0] * d[ends[0]] + slopes[1] * d[ends[1]] + slopes[2] * d[ends[2]] + left
    if ends[3] >= 0:
        inner -= slopes[0] * d[ends[3]] + slopes[1] * d[ends[4]]
    for i in range(L):
        x[i] += push[i] * mean
        for j in range(L):
            P[i, j] += push[i] * d[j] + d[i] * push[j] + inner * push[i] * push[j]
    if keep:
        for M in (F, E):
            combine_rows(M, ends, slopes, more)
            for i in range(L):
                for j in range(M.shape[1]):
                    M[i, j] += push[i] * more[j]
