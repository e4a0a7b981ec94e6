"""What no unbiased estimator beats: Cramer-Rao bounds of damping and gap, from sensitivities along the true motion.

Rao, Bull. Calcutta Math. Soc. 37 (1945) 81-91; Cramer, Mathematical Methods of Statistics (1946).

Nothing here is imported from lostmotion, and nothing is linearised but the true motion itself. The contact force is
continuous, so sensitivities obey dS/dt = J S + df/dtheta with J constant between contacts and no jump at them. The
start of the motion is a nuisance of two parameters.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numba
import numpy as np
from independent import FINE, Array, Machine, Recording, leapfrog

EVERY = 2
"""Leapfrog steps to each step of the sensitivities, of which there are fifty between samples."""


@numba.njit(cache=True)
def whitened(fine: Array, parts: int, numbers: tuple[float, ...], h: float, sigma: float, q: float) -> Array:
    """Return the sensitivities of the one-step errors (samples, 4) to log c, log x0 and the start, in their deviations.

    `fine` is the motion (steps, 2) every `h` s, seen every `parts` steps with white noise of `sigma` (m), under a white
    force of intensity `q` (N^2 s). What the filter believes is left out of the sensitivities at once (eta is the true
    sensitivity minus that of the filter), so that in chaos nothing grows that the data hold. With `q` = 0 it is the
    whole trajectory that is sensitive.
    """
    m, c, k1, k0, x0 = numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]
    eta = np.zeros((2, 4))
    eta[0, 2] = eta[1, 3] = 1.0
    cov = np.zeros((2, 2))
    seen = np.zeros((len(fine) // parts, 4))
    for i in range(len(seen) * parts):
        if i % parts == 0:
            s = cov[0, 0] + sigma * sigma
            gain0, gain1 = cov[0, 0] / s, cov[1, 0] / s
            for j in range(4):
                miss = eta[0, j]
                seen[i // parts, j] = miss / math.sqrt(s)
                eta[0, j] -= gain0 * miss
                eta[1, j] -= gain1 * miss
            left0, left1, left2 = (
                cov[0, 0] - gain0 * cov[0, 0],
                cov[0, 1] * (1.0 - gain0),
                cov[1, 1] - gain1 * cov[0, 1],
            )
            cov[0, 0], cov[0, 1], cov[1, 0], cov[1, 1] = left0, left1, left1, left2
        x, v = fine[i, 0], fine[i, 1]
        touches = 1.0 if abs(x) > x0 else 0.0
        stiff, loss = (k1 + touches * k0) / m, c / m
        f00, f01 = 1.0 - 0.5 * h * h * stiff, h - 0.5 * h * h * loss
        f10, f11 = -h * stiff + 0.5 * h * h * loss * stiff, 1.0 - h * loss + 0.5 * h * h * (loss * loss - stiff)
        push = (-c * v / m, touches * k0 * math.copysign(x0, x) / m, 0.0, 0.0)
        for j in range(4):
            a, b = eta[0, j], eta[1, j]
            eta[0, j] = f00 * a + f01 * b + 0.5 * h * h * push[j]
            eta[1, j] = f10 * a + f11 * b + h * (1.0 - 0.5 * h * loss) * push[j]
        cov[1, 1] += 0.5 * h * q / m**2
        a, b, d = cov[0, 0], cov[0, 1], cov[1, 1]
        cov[0, 0] = f00 * f00 * a + 2.0 * f00 * f01 * b + f01 * f01 * d
        cov[0, 1] = cov[1, 0] = f00 * f10 * a + (f00 * f11 + f01 * f10) * b + f01 * f11 * d
        cov[1, 1] = f10 * f10 * a + 2.0 * f10 * f11 * b + f11 * f11 * d + 0.5 * h * q / m**2
    return seen


def fine_motion(machine: Machine, seen: Recording) -> Array:
    """Return the true motion (steps, 2) behind a recording, at each step of the sensitivities."""
    h = float(seen.time[1]) / FINE
    middles = (np.arange(len(seen.time) * FINE) + 0.5) * h
    return leapfrog(machine.force(middles), machine.numbers, tuple(seen.states[0]), h, EVERY)


def bounds(machine: Machine, seen: Recording, sigma: float, q: float, *, window: int | None = None) -> Array:
    """Return the least standard deviations (2,) of log c and log x0 that white noise and a white force leave.

    From the information S' R^-1 S with R = sigma^2 I + q G G', G the response of the motion to the force; a Kalman
    filter along the true motion is the factor of R. With a `window` (samples) the recording is cut into pieces, each
    with a start of its own, as multiple shooting does it: what is known of a chaotic motion without a random force.
    """
    fine, parts, total = fine_motion(machine, seen), FINE // EVERY, np.zeros((2, 2))
    size = (window or len(seen.time)) * parts
    for begin in range(0, len(fine) - size + 1, size):
        rows = whitened(fine[begin : begin + size], parts, machine.numbers, seen.time[1] / parts, sigma, q)
        left = np.linalg.qr(rows[:, [2, 3, 0, 1]], mode="r")[2:, 2:]
        total += left.T @ left
    return np.sqrt(np.diag(np.linalg.inv(total)))


def by_simulation(machine: Machine, seen: Recording, width: float = 1e-5) -> Array:
    """Return the sensitivities (samples, 4) of the position to log c, log x0 and the start, by differences of runs."""
    begin = seen.states[0]
    ends = []
    for sign in (1.0, -1.0):
        grown = math.exp(sign * width)
        moved = sign * width
        ends.append([
            fine_motion(replace(machine, c=machine.c * grown), seen),
            fine_motion(replace(machine, x0=machine.x0 * grown), seen),
            fine_motion(machine, _from(seen, begin + np.array([moved * machine.x0, 0.0]))),
            fine_motion(machine, _from(seen, begin + np.array([0.0, moved]))),
        ])  # fmt: skip
    parts, units = FINE // EVERY, np.array([1.0, 1.0, machine.x0, 1.0])
    return np.stack([(a - b)[::parts, 0] for a, b in zip(*ends, strict=True)], axis=1) / (2.0 * width * units)


def _from(seen: Recording, start: Array) -> Recording:
    states = seen.states.copy()
    states[0] = start
    return replace(seen, states=states)
