"""What drives a system, on the grid of its integrator."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from lostmotion.beside import Input
from lostmotion.contracts import Array


class Tone(NamedTuple):
    """What the drive of a recording is: angular frequency (rad/s; 0 where it has none) and amplitude."""

    omega: float = 0.0
    amplitude: float = 0.0


SILENT = Tone()


@dataclass(frozen=True)
class Drive:
    """Measured inputs on the grid of the integrator: `u` (3 * nsub * samples, inputs), three rows to each step.

    The rows are the input at the start, the middle and the end of a step, the end as a limit from the left, so that
    an input that jumps at the samples (`hold="step"`) is integrated exactly. `begin` is the time of the first sample
    (s).
    """

    u: Array
    dt: float
    nsub: int
    samples: int
    begin: float = 0.0
    tone: Tone = SILENT

    @classmethod
    def smooth(cls, columns: list[Any], dt: float, nsub: int, samples: int) -> Drive:
        """Return the drive of functions of time (s), one to each input, for instance splines through the samples."""
        h = dt / nsub
        start = np.arange(samples * nsub) * h
        t = np.minimum((start[:, None] + np.array([0.0, 0.5 * h, h])).ravel(), (samples - 1) * dt)
        return cls(np.ascontiguousarray(np.stack([f(t) for f in columns], axis=1)), dt, nsub, samples)

    @classmethod
    def acting(cls, u: Input, orders: int, grid: Drive, held: bool) -> Drive:
        """Return the drive of an input on the `grid` of another drive; one that is `held` is constant over a step."""
        h = grid.dt / grid.nsub
        start: Array = grid.begin + np.arange(grid.samples * grid.nsub, dtype=float) * h
        if held:
            columns = [np.repeat(u(start + 0.5 * h, k), 3) for k in range(orders)]
        else:
            t = (start[:, None] + np.array([0.0, 0.5 * h, h])).ravel()
            columns = [u(t, k) for k in range(orders)]
        return replace(grid, u=np.ascontiguousarray(np.stack(columns, axis=1)))

    @classmethod
    def held(cls, columns: list[Array], dt: float, nsub: int, samples: int) -> Drive:
        """Return the drive of inputs (samples,) that are held between the samples."""
        u = np.stack([np.repeat(np.asarray(c, dtype=float), 3 * nsub) for c in columns], axis=1)
        return cls(np.ascontiguousarray(u), dt, nsub, samples)


def substeps(rate: float, dt: float, *, accuracy: float = 0.06, most: int = 64) -> int:
    """Return how many steps to take between samples so that `rate * step <= accuracy` (0.06: 105 steps a cycle)."""
    return math.ceil(min(max(rate * dt / accuracy, 1.0), most))
