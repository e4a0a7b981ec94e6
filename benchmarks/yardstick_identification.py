"""The likelihood of the oscillator with backlash in plain NumPy: the same filter as ours, written down once more.

Points that do not wait for one another go through the force in one call, as one does in NumPy. It shares with ours the
splined drive, the start and the noise levels of a problem, and nothing of its kernels.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
STRAIGHT, QUICK = 0.004, 0.03
GAUSS = 0.5 - math.sqrt(1.0 / 12.0)
UNIT = np.eye(2)


def plain_log_likelihood(problem: Any, theta: Array) -> float:
    """Return the log-likelihood of the first recording of a problem (`lin_backlash`, no term) at `theta`."""
    track, drive, values = problem.tracks[0], problem.drives[0], problem.full(theta)
    m, c, k1, k0, x0 = values[:5]
    q, r = problem.noise(theta)
    mean, cov = problem.initial(0, 2)
    way = Way(np.array([m, c, k1, k0, x0]), drive.u[:, 0], drive.dt / drive.nsub, q / m**2)
    total = 0.0
    for k, z in enumerate(track.z):
        if np.isfinite(z):
            miss, s = z - mean[0], cov[0, 0] + r
            total -= 0.5 * (miss * miss / s + math.log(2.0 * math.pi * s))
            gain = cov[:, 0] / s
            mean, cov = mean + gain * miss, cov - np.outer(gain, gain) * s
        if k < track.samples - 1:
            mean, cov = way.across(mean, cov, k * drive.nsub, drive.nsub)
    return total


class Way:
    """The motion from sample to sample: parameters (m, c, k1, k0, x0), drive, step (s) and noise of the velocity."""

    def __init__(self, numbers: Array, u: Array, step: float, noise: float) -> None:
        self.numbers, self.u, self.step, self.noise = numbers, u, step, noise

    def rates(self, y: Array, u: Array | float) -> Array:
        """Return the rates (2, points) at states (2, points) and forces (points,)."""
        m, c, k1, k0, x0 = self.numbers
        x, v = y
        return np.stack([v, (u - c * v - k1 * x - k0 * (x - np.clip(x, -x0, x0))) / m])

    def across(self, mean: Array, cov: Array, first: int, most: int) -> tuple[Array, Array]:
        """Return mean and covariance one sample on, in at most `most` steps."""
        j, wide = 0, most
        while j < most:
            reach = np.sqrt(3.0 * np.diag(cov))
            now = self.rates(np.stack([mean, mean + reach, mean - reach], axis=1), self.u[3 * (first + j)])
            wide = min(wide, most - j)
            while True:
                step = Step(self, mean, cov, now, 3 * (first + j), wide)
                if wide == 1 or step.straight(now, reach):
                    break
                wide //= 2
            mean, cov = step.taken()
            j, wide = j + wide, 2 * wide
        return mean, cov


class Step:
    """One step of `wide` parts: its four rates, the linearisation in its middle, and what bends there."""

    def __init__(self, way: Way, mean: Array, cov: Array, now: Array, start: int, wide: int) -> None:
        self.way, self.mean, self.cov, self.h = way, mean, cov, wide * way.step
        middle = way.u[start + 3 * (wide // 2) + wide % 2]
        self.ends = way.u[start], way.u[start + 3 * wide - 1]
        self.k1 = now[:, 0]
        self.middle = mean + 0.5 * self.h * self.k1
        d = np.sqrt(3.0 * np.diag(cov)) + 1e-14 * (1.0 + np.abs(self.middle))
        around = self.middle[:, None] + np.hstack([np.zeros((2, 1)), np.diag(d), -np.diag(d)])
        seen = way.rates(around, middle)
        self.k2, above, below = seen[:, 0], seen[:, 1:3], seen[:, 3:]
        self.slope = (above - below) / (2.0 * d)
        self.bend = (above + below - 2.0 * self.k2[:, None]) @ (np.diag(cov) / (2.0 * d * d))
        self.k3 = way.rates((mean + 0.5 * self.h * self.k2)[:, None], middle)[:, 0]
        self.end = mean + self.h * self.k3
        self.k4 = way.rates(self.end[:, None], self.ends[1])[:, 0]

    def straight(self, now: Array, reach: Array) -> bool:
        """Return whether the force bends too little along the step to matter, and the step is short for the motion."""
        points = np.stack([self.middle, self.middle, self.end - reach, self.end + reach], axis=1)
        at_start, at_end, left, right = self.way.rates(points, np.array([self.ends[0], *3 * [self.ends[1]]])).T
        kink = self.k1 + self.k4 - at_start - at_end - self.slope @ (self.mean + self.end - 2.0 * self.middle)
        near, far = 0.5 * (now[:, 1] + now[:, 2]) - self.k1, 0.5 * (left + right) - self.k4
        kink = np.abs(kink) + np.abs(near) + 3.0 * np.abs(self.bend) + np.abs(far)
        quick = self.h**2 * np.abs(np.diag(self.slope @ self.slope))
        return bool(np.all(self.h * kink <= STRAIGHT * np.sqrt(np.diag(self.cov))) and np.all(quick <= QUICK))

    def taken(self) -> tuple[Array, Array]:
        """Return mean and covariance at the end of the step."""
        h, a = self.h, self.slope
        fifth = h * h / 30.0 * (a @ a @ (self.k3 - self.k2))
        mean = self.mean + h * ((self.k1 + 2.0 * self.k2 + 2.0 * self.k3 + self.k4) / 6.0 + fifth + self.bend)
        ha = h * a
        by = UNIT + ha @ (UNIT + ha / 2.0 @ (UNIT + ha / 3.0 @ (UNIT + ha / 4.0)))
        noise = np.zeros((2, 2))
        for part in (GAUSS, 1.0 - GAUSS):
            pushed = (UNIT + part * ha + 0.5 * part**2 * ha @ ha)[:, 1]
            noise += 0.5 * h * self.way.noise * np.outer(pushed, pushed)
        return mean, by @ self.cov @ by.T + noise
