"""Oscillators with backlash as flows that are exact up to rounding: no time steps, and no crossing is missed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array, Orbit
from lostmotion.errors import ContractError
from lostmotion_plugins.models._kernels import strobe

_RESONANCE = 1e-7
"""Relative distance from an undamped resonance below which the closed form loses its accuracy."""


@dataclass(frozen=True, eq=False)
class ExactBacklash:
    """m x'' + c x' + k1 x + F(x) = A cos(omega t + phase) solved in closed form from contact to contact.

    Contact times are found to rounding (see `_kernels`). The force is continuous, so no saltation matrix is needed, and
    the tangent is the product of the propagators of the pieces, which is exact as well. With a `base` motion of this
    amplitude and the frequency and phase of the drive, the states are those of base plus x.
    """

    numbers: tuple[float, ...]
    start: Array
    base: float = 0.0
    states: tuple[str, ...] = ("position", "velocity")

    @property
    def period(self) -> float:
        """The period of the drive, or the time between two recorded states (s)."""
        return 2.0 * math.pi / self.numbers[6]

    @property
    def driven(self) -> bool:
        """Whether there is a drive, whose phase is one more direction of the flow with the exponent zero."""
        return self.numbers[5] != 0.0

    def strobe(self, start: Array, *, periods: int, tangents: int) -> Orbit:
        """Return the orbit from `start` (2,) at drive phase 0, with the growth of `tangents` orthogonal vectors."""
        return self._run(start, periods, 1, tangents)[0]

    def sample(self, start: Array, *, periods: int, looks: int) -> Array:
        """Return states (periods * looks + 1, 2) at `looks` evenly spaced times of each period."""
        return self._run(start, periods, looks, 0)[0].states

    def crossings(self, start: Array, *, periods: int, looks: int = 1) -> int:
        """Return how often the motion from `start` enters or leaves the gap; `looks` as in `sample`."""
        return self._run(start, periods, looks, 0)[1]

    def _run(self, start: Array, periods: int, looks: int, tangents: int) -> tuple[Orbit, int]:
        begin = np.asarray(start, dtype=float)
        if begin.shape != (2,) or not 0 <= tangents <= 2:
            raise ContractError(f"a start of shape {begin.shape} and {tangents} tangents do not fit 2 states")
        states, growth = np.full((periods * looks + 1, 2), np.nan), np.zeros((periods, tangents))
        base = self._base_motion(np.arange(len(states)) % looks / looks)
        done, crossings, stiff = strobe(begin - base[0], self.numbers, looks, states, growth)
        states += base
        if done < len(states):
            growth[max(done - 1, 0) // looks :] = np.nan
        return Orbit(states, growth, "too_stiff" if stiff else "ok" if done == len(states) else "failed"), crossings

    def _base_motion(self, share: Array) -> Array:
        """Return position and velocity (times, 2) of the base at these shares of the period."""
        angle, omega = 2.0 * math.pi * share + self.numbers[7], self.numbers[6]
        return self.base * np.stack([np.cos(angle), -omega * np.sin(angle)], axis=1)


def solve_joint_exactly(
    values: Mapping[str, float], drive: tuple[float, float, float], start: Array | None
) -> ExactBacklash | None:
    """Return the exact flow of a joint with backlash under a base motion (amplitude, omega, phase), or None.

    Relative to its base a link without weight is the oscillator with backlash, driven by m * amplitude * omega^2. The
    result is None where `mgl` is not zero, and where `solve_exactly` returns None.
    """
    amplitude, omega, phase = drive
    pull = (values["m"] * amplitude * omega**2, omega, phase)
    flow = None if values["mgl"] != 0.0 else solve_exactly({**values, "k1": 0.0}, pull, start)
    return flow and replace(flow, base=amplitude)


def solve_exactly(
    values: Mapping[str, float], drive: tuple[float, float, float], start: Array | None
) -> ExactBacklash | None:
    """Return the exact flow of these parameters under a drive (amplitude, omega, phase), or None where there is none.

    That is where a parameter is out of its bounds, and at an undamped resonance.
    """
    m, c, k1, k0, x0 = (float(values[name]) for name in ("m", "c", "k1", "k0", "x0"))
    amplitude, omega, phase = (float(x) for x in drive)
    begin = np.zeros(2) if start is None else np.asarray(start, dtype=float)
    numbers = (m, c, k1, k0, x0, amplitude, omega, phase)
    if not np.isfinite([*numbers, *begin]).all() or m <= 0.0 or omega <= 0.0 or min(c, k1, k0, x0) < 0.0:
        return None
    for k in (k1, k1 + k0):
        near = abs(complex(k / m - omega * omega, c / m * omega)) < _RESONANCE * (k / m + omega * omega)
        if near and amplitude:
            return None
    return ExactBacklash(numbers, begin)
