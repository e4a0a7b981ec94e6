"""Population Monte Carlo: weighted draws from a mixture, and a mixture fitted to the draws, alternately.

Cappe et al., J. Computational and Graphical Statistics 13 (2004) 907-929; all draws so far share one weight function as
in Cornuet et al., Scandinavian J. Statistics 39 (2012) 798-812.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from lostmotion.contracts import Array
from lostmotion.identification.normal_scores import Scores
from lostmotion.identification.t_mixture import TMixture, compute_root
from lostmotion.results import percent

MAX_ROUNDS = 12
EFFICIENCY_GOAL = 0.82
"""The rounds end when this share of the draws of a round is effective."""
EFFICIENCY_LEAST = 0.15
"""From this share on, the kernels cover the posterior, and further kernels can improve its shape."""
LATE_ROUND, LATE_EFFICIENCY_GOAL = 5, 0.6
"""After this many rounds, this lower share is sufficient."""
MANY_KERNELS = 20
"""A mixture with more kernels than this has been fitted before; the lower share is then sufficient from the start."""
FIRST_GROWTH_ROUND = 2
"""From this round on, kernels are added where the shape of the posterior is not matched."""
KERNELS_PER_ROUND = 2
"""Kernels added in a round."""
REFIT_ROUNDS = 4
"""Number of times that kernels are added to a mixture that is fitted to a chain."""
GUARD_SHARE, GUARD_SCALE = 0.05, 4.0
"""Share of a wide kernel, and its covariance relative to that of the whole mixture.

With it, regions that the fit has missed can still be proposed."""


class ProposalSource(Protocol):
    """A density that can be drawn from."""

    def draw(self, count: int, random: Any) -> Array:
        """Return points (count, parameters)."""

    def log_density(self, points: Array) -> Array:
        """Return the log density (points,)."""


@dataclass
class Population:
    """Draws from several sources with their log posterior density.

    `log_proposal` is the log density of the mixture from which all of them were drawn, times their number.
    """

    density: Callable[[Array], Array]
    points: Array
    log_densities: Array
    log_proposal: Array
    sources: list[tuple[int, ProposalSource]] = field(default_factory=list)

    @classmethod
    def empty(cls, density: Callable[[Array], Array], size: int) -> Population:
        """Return a population without draws."""
        return cls(density, np.empty((0, size)), np.empty(0), np.empty(0))

    def grow(self, source: ProposalSource, count: int, rng: np.random.Generator) -> float:
        """Add draws from a source; return the share of them that is effective."""
        points = source.draw(count, rng)
        log_densities, here = self.density(points), source.log_density(points)
        earlier = [math.log(n) + one.log_density(points) for n, one in self.sources]
        older = np.logaddexp(self.log_proposal, math.log(count) + source.log_density(self.points))
        newer = np.logaddexp.reduce([*earlier, math.log(count) + here], axis=0)
        self.points, self.log_densities = (
            np.concatenate([self.points, points]),
            np.concatenate([self.log_densities, log_densities]),
        )
        self.log_proposal = np.concatenate([older, newer])
        self.sources.append((count, source))
        return count_effective(_scale_weights(log_densities - here, 1.0)) / count

    def compute_log_weights(self) -> Array:
        """Return the log importance weights (draws,) relative to the mixture of all sources."""
        return np.asarray(self.log_densities - self.log_proposal)

    def compute_weights(self, least: float) -> Array:
        """Return weights (draws,) that add up to one, flattened until `least` draws or more are effective."""
        return temper_weights(self.compute_log_weights(), least)

    def choose_points(self, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
        """Return `count` points drawn by their weights, without repetition if possible, and their log densities."""
        shares = self.compute_weights(2.0 * count)
        again = bool(np.count_nonzero(shares) < count)
        which = rng.choice(len(shares), count, replace=again, p=shares)
        return self.points[which], self.log_densities[which]


def count_effective(shares: Array) -> float:
    """Return the effective number of draws with weights that add up to one: Kong, Univ. of Chicago TR 348 (1992)."""
    total = float(np.sum(shares**2))
    return 1.0 / total if total > 0.0 else 0.0


def temper_weights(log_weights: Array, least: float) -> Array:
    """Return weights that add up to one, raised to the highest power up to 1 that leaves `least` draws effective."""
    shares = _scale_weights(log_weights, 1.0)
    if count_effective(shares) >= least or np.count_nonzero(np.isfinite(log_weights)) <= least:
        return shares if count_effective(shares) >= least else _scale_weights(log_weights, 0.0)
    low, high = 0.0, 1.0
    for _ in range(40):
        power = 0.5 * (low + high)
        enough = count_effective(_scale_weights(log_weights, power)) >= least
        low, high = (power, high) if enough else (low, power)
    return _scale_weights(log_weights, low)


def _scale_weights(log_weights: Array, power: float) -> Array:
    finite = np.isfinite(log_weights)
    if not finite.any():
        return np.zeros(len(log_weights))
    weights = np.where(finite, np.exp(power * (np.where(finite, log_weights, 0.0) - log_weights[finite].max())), 0.0)
    return np.asarray(weights / weights.sum())


def adapt_mixture(
    mixture: TMixture, population: Population, rng: np.random.Generator, watch: Callable[[int, str], None]
) -> TMixture:
    """Return the mixture fitted to the posterior in rounds of draws; `watch` receives the progress."""
    count, least = max(24 * (mixture.size + 1), 8 * mixture.kernels), 4.0 * (mixture.size + 1)
    for turn in range(MAX_ROUNDS):
        share = population.grow(add_guard_kernel(mixture), count, rng)
        watch(0, f"pilot draws, {percent(share)} effective")
        if share > LATE_EFFICIENCY_GOAL and mixture.kernels > MANY_KERNELS:
            break
        shares = population.compute_weights(least)
        mixture = mixture.fit(population.points, shares)
        if share > (EFFICIENCY_GOAL if turn < LATE_ROUND else LATE_EFFICIENCY_GOAL):
            break
        room = count_effective(shares) / (5.0 * (mixture.size + 1)) - mixture.kernels
        if turn >= FIRST_GROWTH_ROUND and EFFICIENCY_LEAST < share < LATE_EFFICIENCY_GOAL and room >= KERNELS_PER_ROUND:
            mixture = add_kernels(mixture, population).fit(population.points, shares)
    return add_guard_kernel(mixture)


def add_kernels(mixture: TMixture, population: Population) -> TMixture:
    """Return the mixture with further kernels at draws where the density of the mixture is too low."""
    missing = temper_weights(population.log_densities - mixture.log_density(population.points), 1.0)
    return add_kernels_at(mixture, population.points, missing)


def add_kernels_at(mixture: TMixture, points: Array, missing: Array) -> TMixture:
    """Return the mixture with further kernels at the points with the largest `missing` weights (sum one)."""
    wide = mixture.widen(1.0).roots[0]
    near = max(4 * (mixture.size + 1), len(points) // 20)
    for one in list(
        place_kernels(mixture.scale, np.sqrt(np.sum(wide**2, axis=1)), points, missing, (KERNELS_PER_ROUND, near))
    ):
        mixture = mixture.mix_with(one, 1.0 / (mixture.kernels + 1.0))
    return mixture


def refit_mixture(mixture: TMixture, points: Array, log_densities: Array) -> TMixture:
    """Return a mixture fitted to draws of the posterior itself, such as those of a chain that mixes badly."""
    points, which, counts = np.unique(points, axis=0, return_index=True, return_counts=True)
    log_densities, shares = log_densities[which], counts / counts.sum()
    mixture = mixture.fit(points, shares)
    for _ in range(REFIT_ROUNDS):
        missing = temper_weights(log_densities - mixture.log_density(points), 1.0)
        mixture = add_kernels_at(mixture, points, missing).fit(points, shares)
    return add_guard_kernel(mixture)


def add_guard_kernel(mixture: TMixture) -> TMixture:
    """Return the mixture with a small share of one kernel that is wider than the whole mixture."""
    return mixture.mix_with(mixture.widen(GUARD_SCALE), GUARD_SHARE)


def place_kernels(
    scale: Scores, unit: Array, points: Array, shares: Array, limits: tuple[int, int]
) -> Iterator[TMixture]:
    """Yield at most `limits[0]` kernels at the points of largest weight, each scaled to its `limits[1]` nearest points.

    Distances between scores are measured in `unit`. Raftery, Bao, Biometrics 66 (2010) 1162-1173.
    """
    scores, left = scale.to_scores(points), shares.copy()
    evenly = 1.0 / len(shares)
    for _ in range(limits[0]):
        top = int(np.argmax(left))
        if left[top] < 3.0 * evenly:
            return
        off = scores - scores[top]
        near = np.argsort(np.sum((off / unit) ** 2, axis=1), kind="stable")[: limits[1]]
        weights = shares[near] + evenly
        covariance = (weights[:, None] * off[near]).T @ off[near] / weights.sum()
        left[near] = 0.0
        yield TMixture(np.ones(1), scores[top][None], compute_root(covariance)[None], scale)
