"""Population Monte Carlo: weighted draws from a mixture, and a mixture fitted to them, in turns.

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
from lostmotion.identification.t_mixture import TMixture, root_of

ROUNDS = 12
GOOD = 0.82
"""The rounds end when this share of the draws of a round is effective."""
FAIR = 0.15
"""From this share on the kernels are where the posterior is, and can follow its shape."""
LATE, ENOUGH = 5, 0.6
"""After so many rounds this share is good enough."""
MANY = 20
"""With more kernels than that a mixture has been fitted before, and that share is good enough at once."""
WAIT = 2
"""After so many rounds a shape that is still not matched gets further kernels."""
NEW = 2
"""Kernels that are added in a round."""
TIMES = 4
"""Times that kernels are added to a mixture that is fitted to a chain."""
GUARD, WIDER = 0.05, 4.0
"""The share of a kernel with so many times the covariance of all others together: what a fit overlooked can still be
proposed."""


class ProposalSource(Protocol):
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
    log_densities: Array
    drawn: Array
    sources: list[tuple[int, ProposalSource]] = field(default_factory=list)

    @classmethod
    def empty(cls, density: Callable[[Array], Array], size: int) -> Population:
        """Return a population without draws."""
        return cls(density, np.empty((0, size)), np.empty(0), np.empty(0))

    def grow(self, source: ProposalSource, count: int, rng: np.random.Generator) -> float:
        """Take draws from a source; return the share of them that is effective."""
        points = source.draw(count, rng)
        log_densities, here = self.density(points), source.log_density(points)
        earlier = [math.log(n) + one.log_density(points) for n, one in self.sources]
        older = np.logaddexp(self.drawn, math.log(count) + source.log_density(self.points))
        newer = np.logaddexp.reduce([*earlier, math.log(count) + here], axis=0)
        self.points, self.log_densities = (
            np.concatenate([self.points, points]),
            np.concatenate([self.log_densities, log_densities]),
        )
        self.drawn = np.concatenate([older, newer])
        self.sources.append((count, source))
        return effective(_scaled(log_densities - here, 1.0)) / count

    def log_weights(self) -> Array:
        """Return the log weights (draws,) against the mixture of all that was drawn from."""
        return np.asarray(self.log_densities - self.drawn)

    def shares(self, least: float) -> Array:
        """Return weights (draws,) that add up to one, flattened until `least` draws or more are effective."""
        return tempered(self.log_weights(), least)

    def chosen(self, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
        """Return `count` points drawn by their weights, no point twice if there are enough, and their heights."""
        shares = self.shares(2.0 * count)
        again = bool(np.count_nonzero(shares) < count)
        which = rng.choice(len(shares), count, replace=again, p=shares)
        return self.points[which], self.log_densities[which]


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
    mixture: TMixture, population: Population, rng: np.random.Generator, watch: Callable[[int, str], None]
) -> TMixture:
    """Return the mixture fitted to the posterior by rounds of draws, of which `watch` is told."""
    count, least = max(24 * (mixture.size + 1), 8 * mixture.kernels), 4.0 * (mixture.size + 1)
    for turn in range(ROUNDS):
        share = population.grow(guarded(mixture), count, rng)
        watch(0, f"pilot draws, {share:.0%} effective")
        if share > ENOUGH and mixture.kernels > MANY:
            break
        shares = population.shares(least)
        mixture = mixture.fitted(population.points, shares)
        if share > (GOOD if turn < LATE else ENOUGH):
            break
        room = effective(shares) / (5.0 * (mixture.size + 1)) - mixture.kernels
        if turn >= WAIT and FAIR < share < ENOUGH and room >= NEW:
            mixture = with_new(mixture, population).fitted(population.points, shares)
    return guarded(mixture)


def with_new(mixture: TMixture, population: Population) -> TMixture:
    """Return the mixture with further kernels at draws whose weights say that the mixture is too thin there."""
    missing = tempered(population.log_densities - mixture.log_density(population.points), 1.0)
    return thickened(mixture, population.points, missing)


def thickened(mixture: TMixture, points: Array, missing: Array) -> TMixture:
    """Return the mixture with further kernels at the points where most is `missing`, which adds up to one."""
    wide = mixture.widened(1.0).roots[0]
    near = max(4 * (mixture.size + 1), len(points) // 20)
    for one in list(new_kernels(mixture.scale, np.sqrt(np.sum(wide**2, axis=1)), points, missing, (NEW, near))):
        mixture = mixture.beside(one, 1.0 / (mixture.kernels + 1.0))
    return mixture


def refitted(mixture: TMixture, points: Array, log_densities: Array) -> TMixture:
    """Return a mixture fitted to draws of the posterior itself, such as those of a chain that mixes badly."""
    points, which, counts = np.unique(points, axis=0, return_index=True, return_counts=True)
    log_densities, shares = log_densities[which], counts / counts.sum()
    mixture = mixture.fitted(points, shares)
    for _ in range(TIMES):
        missing = tempered(log_densities - mixture.log_density(points), 1.0)
        mixture = thickened(mixture, points, missing).fitted(points, shares)
    return guarded(mixture)


def guarded(mixture: TMixture) -> TMixture:
    """Return the mixture with a little of a kernel that is wider than all of it."""
    return mixture.beside(mixture.widened(WIDER), GUARD)


def new_kernels(
    scale: Scores, unit: Array, points: Array, shares: Array, limits: tuple[int, int]
) -> Iterator[TMixture]:
    """Yield kernels at the points of largest weight, at most `limits[0]`, each as wide as `limits[1]` points about it.

    Distances between scores are measured in `unit`. Raftery, Bao, Biometrics 66 (2010) 1162-1173.
    """
    scores, left = scale.of(points), shares.copy()
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
        yield TMixture(np.ones(1), scores[top][None], root_of(covariance)[None], scale)
