"""The smoothed latent force: an Ornstein-Uhlenbeck force in the filter, smoothed backwards, with its band."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from lostmotion.contracts import Array
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import PACE, RANDOM, FreeParameter

SHARES = (1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1)
PACES = (4.0, 12.0, 40.0)
"""Inverse correlation times that are tried, in units of one over the natural time of the motion."""
FASTEST = 1.5
"""The largest decay exponent per sample that is tried. A faster force cannot be distinguished from one that acts
between samples only: the smoothed force was twice as large as the law (dry friction in a decay, exponent 2), or five
times (exponent 10)."""


@dataclass(frozen=True)
class LatentForce:
    """The smoothed latent force of one recording: mean and standard deviation (samples,), in N or N m.

    `states` (samples, n) are the smoothed states of model and terms.

    `share` is its prior standard deviation in units of the drive and `time` its correlation time in s, both chosen by
    the likelihood. `levers` are those of `System.lever` by place; `body` are the states that are position and velocity
    of the first body.
    """

    force: Array
    sd: Array
    states: Array
    share: float
    time: float
    levers: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    body: tuple[int, int] = (0, 1)

    @property
    def position(self) -> Array:
        """The smoothed position (samples,)."""
        return self.states[:, self.body[0]]

    @property
    def velocity(self) -> Array:
        """The smoothed velocity (samples,)."""
        return self.states[:, self.body[1]]


def smooth_latent_force(posterior: Posterior, theta: Array, index: int = 0) -> LatentForce:
    """Return the latent force of recording `index` at fixed parameters: an Ornstein-Uhlenbeck force, smoothed.

    Alvarez, Luengo, Lawrence (2009); Rogers, Friis, MSSP 2022 (arXiv 2109.10681). It shows on what a missing force
    depends. It is not used to name the force, because the base parameters absorb the part of a force that correlates
    with them.
    """
    single = posterior.on((posterior.observations[index],))
    step = single.observations[0].dt / posterior.scales.time
    grid = [(s, p) for p in PACES if p == min(PACES) or p * step < FASTEST for s in SHARES]
    forced, thetas = _add_force(single, theta, grid)
    best = int(np.argmax(forced.log_likelihood(thetas)))
    seen = forced.filters[0].smooth(thetas[best])
    sd = np.sqrt(np.maximum(seen.covariance[:, -1, -1], 0.0))
    share, pace = grid[best]
    full, places = single.recordings[0].full(theta), posterior.system.model.places
    levers = {place.name: posterior.system.lever(full, place) for place in places}
    time, body = posterior.scales.time / pace, posterior.system.model.first_body
    return LatentForce(seen.states[:, -1], sd, seen.states[:, :-1], share, time, levers, body)


def smooth_expected_force(posterior: Posterior, theta: Array, index: int = 0) -> tuple[Array, Array]:
    """Return the smoothed states (samples, n) of a recording, and the expected random force (samples,).

    It is proportional to the gradient of the log-likelihood with respect to an added force. So a missing law correlates
    with it, even where the base parameters absorb most of the law.
    """
    single = posterior.on((posterior.observations[index],))
    pace = posterior.scales.time / posterior.observations[index].dt
    intensity = posterior.recordings[index].random_force(theta)
    share = math.sqrt(0.5 * intensity * pace / posterior.scales.time) / posterior.scales.force
    forced, thetas = _add_force(single, theta, [(share, pace)])
    states = forced.filters[0].smooth(thetas[0]).states
    return states[:, :-1], states[:, -1]


def _add_force(posterior: Posterior, theta: Array, grid: list[tuple[float, float]]) -> tuple[Posterior, Array]:
    """Return the posterior and coordinates (points, n) with latent forces of given shares of the drive and rates."""
    kept = [i for i, f in enumerate(posterior.space.free) if f.parameter not in (RANDOM, PACE)]
    frees = (*(posterior.space.free[i] for i in kept), make_fixed(RANDOM), make_fixed(PACE))
    rows = []
    for share, relative in grid:
        pace = relative / posterior.scales.time
        intensity = 2.0 * (share * posterior.scales.force) ** 2 / pace
        rows.append(np.append(theta[kept], [math.log(intensity), math.log(pace)]))
    return posterior.over(frees), np.array(rows)


def make_fixed(key: str) -> FreeParameter:
    """Return a level without bounds, for a point that is given and not estimated."""
    return FreeParameter(key, "1", 0.0, -math.inf, math.inf)
