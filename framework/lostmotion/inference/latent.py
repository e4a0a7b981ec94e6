"""The missing force over time: a latent force in the filter, smoothed backwards, with its band."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.problem import Problem
from lostmotion.kernels import smooth

SHARES = (1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1)
PACES = (4.0, 12.0, 40.0)
"""Correlation times that are tried, as fractions of the natural time of the motion."""


@dataclass(frozen=True)
class Missing:
    """The smoothed latent force of one recording: mean and standard deviation (samples,), in N or N m.

    `states` (samples, n) are those of model and terms, smoothed.

    `share` is its prior standard deviation in units of the drive and `time` its correlation time in s, both chosen
    by the likelihood; `log_gain` is what the likelihood prefers it by over a latent force of `SHARES[0]`.
    """

    force: Array
    sd: Array
    states: Array
    share: float
    time: float
    log_gain: float

    @property
    def position(self) -> Array:
        """The smoothed position (samples,)."""
        return self.states[:, 0]

    @property
    def velocity(self) -> Array:
        """The smoothed velocity (samples,)."""
        return self.states[:, 1]


def missing_force(problem: Problem, theta: Array, index: int = 0) -> Missing:
    """Return what is missing in recording `index` at fixed parameters: an Ornstein-Uhlenbeck force, smoothed.

    Alvarez, Luengo, Lawrence (2009); Rogers, Friis, MSSP 2022 (arXiv 2109.10681). Locate with it, do not name with it:
    a force that correlates with a base parameter is shrunk by it.
    """
    grid = [(s, p) for p in PACES for s in SHARES]
    heights = [_filter(problem, theta, index, choice, keep=False)[0] for choice in grid]
    best = int(np.argmax(heights))
    _, arrays = _filter(problem, theta, index, grid[best], keep=True)
    states, cov = smooth(*arrays)
    base = min(h for (s, _), h in zip(grid, heights, strict=True) if s == SHARES[0])
    sd = np.sqrt(np.maximum(cov[:, -1, -1], 0.0))
    share, pace = grid[best]
    return Missing(states[:, -1], sd, states[:, :-1], share, problem.scales.time / pace, heights[best] - base)


def _filter(
    problem: Problem, theta: Array, index: int, choice: tuple[float, float], *, keep: bool
) -> tuple[float, tuple[Array, ...]]:
    """Return the log-likelihood with a latent force of (share, pace), and what the smoother needs."""
    system, track, drive = problem.system, problem.tracks[index], problem.drives[index]
    n = system.states(problem.active) + 1
    base, own = system.pack(problem.full(theta), drive.dt / drive.nsub)
    on, at = system.wiring(problem.active)
    channel, direct = system.channel(track.channel)
    pace = choice[1] / problem.scales.time
    variance = (choice[0] * problem.scales.force) ** 2
    y0, cov = problem.initial(index, n)
    cov[-1, -1] = variance
    rows = track.samples if keep else 1
    arrays = (np.zeros((rows, n)), np.zeros((rows, n, n)), np.zeros((rows, n)), np.zeros((rows, n, n)), np.zeros((rows, n, n)))
    errors, variances = np.zeros(track.samples), np.ones(track.samples)
    done = system.kernel(problem.active, latent=True).track(
        track.z, drive.u, drive.dt, drive.nsub, base, own, on, at, pace, 2.0 * variance * pace,
        problem.noise(theta)[1], y0, cov, channel, direct, errors, variances, keep, *arrays,
    )  # fmt: skip
    if done < track.samples:
        return -math.inf, arrays
    return float(-0.5 * np.sum(errors**2 / variances + np.log(2.0 * np.pi * variances))), arrays
