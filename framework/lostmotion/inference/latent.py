"""The missing force over time: a latent force in the filter, smoothed backwards, with its band."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.problem import PACE, RANDOM, Free, Kept, Problem
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
    single = problem.on((problem.tracks[index],))
    grid = [(s, p) for p in PACES for s in SHARES]
    trials = [_with_force(single, theta, *choice) for choice in grid]
    heights = [p.innovations(t).log_likelihood for p, t in trials]
    best = int(np.argmax(heights))
    kept, _, _ = kept_by(*trials[best])
    states, cov = smooth(*kept)
    base = min(h for (s, _), h in zip(grid, heights, strict=True) if s == SHARES[0])
    sd = np.sqrt(np.maximum(cov[:, -1, -1], 0.0))
    share, pace = grid[best]
    return Missing(states[:, -1], sd, states[:, :-1], share, problem.scales.time / pace, heights[best] - base)


def leaning(problem: Problem, theta: Array, index: int = 0) -> tuple[Array, Array]:
    """Return the smoothed states (samples, n) of a recording, and how much it leans (samples,) to a force each time.

    That is the expected random force, which is proportional to the gradient of the log-likelihood with respect to an
    added force: a law that belongs there goes with it, however much of the law is shrunk away.
    """
    single = problem.on((problem.tracks[index],))
    pace = problem.scales.time / problem.tracks[index].dt
    intensity, _ = problem.noise(theta, index)
    share = math.sqrt(0.5 * intensity * pace / problem.scales.time) / problem.scales.force
    kept, _, _ = kept_by(*_with_force(single, theta, share, pace))
    states, _ = smooth(*kept)
    return states[:, :-1], states[:, -1]


def kept_by(problem: Problem, theta: Array) -> tuple[Kept, Array, Array]:
    """Return what a smoother needs of the first recording, and the innovations with their variances."""
    rows = problem.tracks[0].samples
    n = problem.system.states(problem.active) + problem.coloured
    square = (rows, n, n)
    kept = (np.zeros((rows, n)), np.zeros(square), np.zeros((rows, n)), np.zeros(square), np.zeros(square))
    errors, variances = np.zeros(rows), np.ones(rows)
    problem.track(0, theta, errors, variances, kept)
    return kept, errors, variances


def _with_force(problem: Problem, theta: Array, share: float, pace: float) -> tuple[Problem, Array]:
    """Return the problem and coordinates with a latent force of the given share of the drive and pace."""
    pace = pace / problem.scales.time
    intensity = 2.0 * (share * problem.scales.force) ** 2 / pace
    kept = [i for i, f in enumerate(problem.free) if f.parameter not in (RANDOM, PACE)]
    frees = (*(problem.free[i] for i in kept), fixed(RANDOM), fixed(PACE))
    return replace(problem, free=frees), np.append(theta[kept], [math.log(intensity), math.log(pace)])


def fixed(key: str) -> Free:
    """Return a level without bounds, for a point that is given and not estimated."""
    return Free(key, "1", 0.0, -math.inf, math.inf)
