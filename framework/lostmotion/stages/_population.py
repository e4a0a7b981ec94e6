"""Population Monte Carlo: weighted draws from a cloud, and a cloud fitted to them, in turns.

Cappe et al., J. Computational and Graphical Statistics 13 (2004) 907-929; all draws so far share one weight function as
in Cornuet et al., Scandinavian J. Statistics 39 (2012) 798-812.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from lostmotion.contracts import Array
from lostmotion.stages._cloud import Cloud

ROUNDS = 8
GOOD = 0.75
"""The rounds end when this share of the draws of a round is effective."""
FAIR = 0.15
"""From this share on the kernels are where the posterior is, and each is split to follow its shape."""
PARTS = 3
GUARD = 0.05
"""The share of a kernel that is wider than all others together: what a fit overlooked can still be proposed."""


class Source(Protocol):
    """A density that can be drawn from."""

    def draw(self, count: int, random: Any) -> Array:
        """Return points (count, parameters)."""

    def log_density(self, points: Array) -> Array:
        """Return the log density (points,)."""


@dataclass
class Population:
    """Draws from several sources in turn with their log posterior density.

    `drawn` is the logarithm of the density from which all of them were drawn, times their number.
    """

    density: Callable[[Array], Array]
    points: Array
    heights: Array
    drawn: Array
    sources: list[tuple[int, Source]] = field(default_factory=list)

    @classmethod
    def empty(cls, density: Callable[[Array], Array], size: int) -> Population:
        """Return a population without draws."""
        return cls(density, np.empty((0, size)), np.empty(0), np.empty(0))

    def grow(self, source: Source, count: int, rng: np.random.Generator) -> float:
        """Take draws from a source; return the share of them that is effective."""
        points = source.draw(count, rng)
        heights, here = self.density(points), source.log_density(points)
        earlier = [math.log(n) + one.log_density(points) for n, one in self.sources]
        older = np.logaddexp(self.drawn, math.log(count) + source.log_density(self.points))
        newer = np.logaddexp.reduce([*earlier, math.log(count) + here], axis=0)
        self.points, self.heights = np.concatenate([self.points, points]), np.concatenate([self.heights, heights])
        self.drawn = np.concatenate([older, newer])
        self.sources.append((count, source))
        return effective(_scaled(heights - here, 1.0)) / count

    def log_weights(self) -> Array:
        """Return the log weights (draws,) against the mixture of all that was drawn from."""
        return np.asarray(self.heights - self.drawn)

    def shares(self, least: float) -> Array:
        """Return weights (draws,) that add up to one, flattened until `least` draws or more are effective."""
        return tempered(self.log_weights(), least)

    def chosen(self, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
        """Return `count` points drawn by their weights, no point twice if there are enough, and their heights."""
        shares = self.shares(2.0 * count)
        again = bool(np.count_nonzero(shares) < count)
        which = rng.choice(len(shares), count, replace=again, p=shares)
        return self.points[which], self.heights[which]


def effective(shares: Array) -> float:
    """Return the effective number of draws with weights that add up to one: Kong, Univ. of Chicago TR 348 (1992)."""
    total = float(np.sum(shares**2))
    return 1.0 / total if total > 0.0 else 0.0


def tempered(log_weights: Array, least: float) -> Array:
    """Return weights that add up to one, raised to the highest power up to 1 that leaves `least` draws effective."""
    shares = _scaled(log_weights, 1.0)
    if effective(shares) >= least or np.count_nonzero(np.isfinite(log_weights)) <= least:
        return shares if effective(shares) >= least else _scaled(log_weights, 0.0)
    low, high = 0.0, 1.0
    for _ in range(40):
        power = 0.5 * (low + high)
        enough = effective(_scaled(log_weights, power)) >= least
        low, high = (power, high) if enough else (low, power)
    return _scaled(log_weights, low)


def _scaled(log_weights: Array, power: float) -> Array:
    finite = np.isfinite(log_weights)
    if not finite.any():
        return np.zeros(len(log_weights))
    weights = np.where(finite, np.exp(power * (np.where(finite, log_weights, 0.0) - log_weights[finite].max())), 0.0)
    return np.asarray(weights / weights.sum())


def adapted(
    cloud: Cloud, population: Population, rng: np.random.Generator, watch: Callable[[int, str], None]
) -> tuple[Cloud, float]:
    """Return the cloud fitted to the posterior, and the effective share of the draws that it was last fitted to."""
    divided, share = False, 0.0
    count, least = 24 * (cloud.size + 1), 4.0 * (cloud.size + 1)
    for _ in range(ROUNDS):
        share = population.grow(guarded(cloud), count, rng)
        shares = population.shares(least)
        cloud = cloud.fitted(population.points, shares)
        if not divided and share > FAIR and effective(shares) > 10.0 * PARTS * cloud.size:
            cloud, divided = cloud.split(PARTS, rng).fitted(population.points, shares), True
        watch(0, f"pilot draws, {share:.0%} effective")
        if share > GOOD:
            break
    return guarded(cloud), share


def guarded(cloud: Cloud) -> Cloud:
    """Return the cloud with a little of a kernel that is wider than all of it."""
    return cloud.beside(cloud.widened(2.0), GUARD)
