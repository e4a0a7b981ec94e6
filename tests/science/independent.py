"""Recordings made without the framework: leapfrog in small steps, with friction that is set-valued and truly sticks.

Nothing here is imported from lostmotion, so that a slip in its kernels cannot hide in the data that test them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
FINE = 100
"""Leapfrog steps between samples."""


@numba.njit(cache=True)
def leapfrog(push: Array, numbers: Any, start: Any, step: float, every: int) -> Array:
    """Return position and velocity (samples, 2) under the force `push` (steps,) at the middle of each step.

    m x'' + c x' + k1 x + F(x) + coulomb + quadratic v|v| + cubic x^3 = push. The friction impulse is whatever stops
    the mass, up to its bound.
    """
    m, c, k1, k0, x0, coulomb, quadratic, cubic = numbers
    x, v = start
    loss, bound = 0.5 * step * c / m, step * coulomb / m
    seen = np.zeros((len(push) // every, 2))
    for k in range(len(seen) * every):
        if k % every == 0:
            seen[k // every, 0] = x
            seen[k // every, 1] = v
        middle = x + 0.5 * step * v
        pressed = middle - min(max(middle, -x0), x0)
        pull = push[k] - k1 * middle - k0 * pressed - quadratic * v * abs(v) - cubic * middle**3
        free = (v * (1.0 - loss) + step * pull / m) / (1.0 + loss)
        v = free - min(max(free, -bound), bound)
        x = middle + 0.5 * step * v
    return seen


@dataclass(frozen=True)
class Machine:
    """The oscillator with backlash under a harmonic force, in SI units: Case 1 of the paper unless told otherwise."""

    m: float = 1.0
    c: float = 8.0
    k1: float = 0.0
    k0: float = 4e4
    x0: float = 0.005
    coulomb: float = 0.0
    quadratic: float = 0.0
    cubic: float = 0.0
    amplitude: float = 100.0
    omega: float = 40.0

    @property
    def numbers(self) -> tuple[float, ...]:
        """What `leapfrog` asks for."""
        return self.m, self.c, self.k1, self.k0, self.x0, self.coulomb, self.quadratic, self.cubic

    def force(self, t: Array) -> Array:
        """Return the drive (N) at the times `t` (s)."""
        return self.amplitude * np.cos(self.omega * t)


@dataclass(frozen=True)
class Recording:
    """What a rig would give: time (s), force (N) and noisy position (m); and the true states (samples, 2)."""

    time: Array
    force: Array
    position: Array
    states: Array


def lin_oscillator(machine: Machine, start: tuple[float, float], dt: float, samples: int) -> Array:
    """Return the true position and velocity (samples, 2) every `dt` s."""
    middles = (np.arange(samples * FINE) + 0.5) * dt / FINE
    return leapfrog(machine.force(middles), machine.numbers, start, dt / FINE, FINE)


def recording(
    machine: Machine, *, periods: int = 100, per_period: int = 200, noise: float = 0.01, seed: int = 0
) -> Recording:
    """Return a recording of the settled motion; `noise` is a share of the position's standard deviation."""
    rng = np.random.default_rng(seed)
    dt, settle = 2.0 * math.pi / machine.omega / per_period, 50 * per_period
    start = (machine.x0 * rng.uniform(-0.5, 0.5), 0.1)
    states = lin_oscillator(machine, start, dt, settle + periods * per_period)[settle:]
    time, x = np.arange(len(states)) * dt, states[:, 0]
    return Recording(time, machine.force(time), x + noise * x.std() * rng.standard_normal(len(x)), states)
