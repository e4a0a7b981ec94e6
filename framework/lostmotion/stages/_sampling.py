"""How an ensemble moves: mostly jumps drawn from a wide normal-like density fitted to the posterior, some walks."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.problem import Free, Innovations

TAIL = 6.0
"""Degrees of freedom of the jumps: their tails are heavier than those of any posterior met here."""
JUMPS = 0.9
"""The share of jumps; the rest are walks, which also mix where the density of the jumps fits badly."""
FAR = 30.0
"""No proposal lies further out than this logit, so that it stays a number apart from its bound."""


class Posterior(Protocol):
    """What is asked of a problem that is to be sampled."""

    @property
    def free(self) -> tuple[Free, ...]:
        """The free parameters."""

    def log_prior(self, theta: Array) -> float:
        """Return the log prior density at the coordinates `theta`."""

    def many(self, thetas: list[Array]) -> list[Innovations]:
        """Return what holds the log-likelihood at several points."""


@dataclass(frozen=True)
class Cloud:
    """A density to propose from: multivariate t in the logits of the coordinates between their bounds.

    Far from the bounds a logit is as good as the coordinate; near one it spreads out a posterior that piles up there.
    """

    centre: Array
    root: Array
    low: Array
    high: Array

    @classmethod
    def about(cls, theta: Array, covariance: Array, free: tuple[Free, ...]) -> Cloud:
        """Return the cloud of a normal approximation; a centre closer to a bound than one deviation moves away."""
        low, high = _bounds(free)
        room = np.minimum(np.sqrt(np.diag(covariance)), 0.25 * (high - low))
        centre = np.clip(theta, low + room, high - room)
        slope = 1.0 / (centre - low) + 1.0 / (high - centre)
        return cls(np.log((centre - low) / (high - centre)), _root(covariance * np.outer(slope, slope)), low, high)

    @classmethod
    def around(cls, points: Array, free: tuple[Free, ...]) -> Cloud:
        """Return the cloud with the mean and the covariance of draws (draws, parameters)."""
        low, high = _bounds(free)
        logits = np.log((points - low) / (high - points))
        return cls(logits.mean(axis=0), _root(np.atleast_2d(np.cov(logits.T))), low, high)

    def draw(self, count: int, random: Any) -> Array:
        """Return points (count, parameters)."""
        normal = random.standard_normal((count, len(self.centre)))
        stretch = np.sqrt(TAIL / random.chisquare(TAIL, count))
        logits = np.clip(self.centre + stretch[:, None] * normal @ self.root.T, -FAR, FAR)
        return np.asarray(self.low + (self.high - self.low) / (1.0 + np.exp(-logits)))

    def log_density(self, points: Array) -> Array:
        """Return the log density (count,) of points, but for a constant."""
        up, down = points - self.low, self.high - points
        white = np.linalg.solve(self.root, (np.log(up / down) - self.centre).T)
        shape = -0.5 * (TAIL + len(self.centre)) * np.log1p(np.sum(white**2, axis=0) / TAIL)
        return np.asarray(shape + np.sum(np.log(1.0 / up + 1.0 / down), axis=1))


def _bounds(free: tuple[Free, ...]) -> tuple[Array, Array]:
    return np.array([f.low for f in free]), np.array([f.high for f in free])


def _root(covariance: Array) -> Array:
    """Return a square root of a covariance that may be nearly singular."""
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 1e-14 * float(values[-1]))))


@dataclass
class Density:
    """The log posterior density of many points at once; `evaluations` counts the runs of the likelihood."""

    posterior: Posterior
    evaluations: int = field(default=0)

    def __call__(self, points: Array) -> Array:
        """Return log densities (points,); minus infinity outside the prior or where the filter diverges."""
        heights = np.array([self.posterior.log_prior(p) for p in points])
        inside = np.flatnonzero(np.isfinite(heights))
        found = self.posterior.many([points[i] for i in inside])
        self.evaluations += len(inside)
        heights[inside] += [one.log_likelihood if math.isfinite(one.log_likelihood) else -math.inf for one in found]
        return heights


def moves(cloud: Cloud) -> list[tuple[Any, float]]:
    """Return emcee's moves with their weights: independent jumps, differential evolution, and snooker steps."""
    from emcee.moves import DEMove, DESnookerMove, RedBlueMove

    class Jump(RedBlueMove):  # type: ignore[misc]
        """Propose from one fixed density, whatever the walker: Tierney, Annals of Statistics 22 (1994) 1701-1728."""

        def get_proposal(self, sample: Array, _complement: Any, random: Any) -> tuple[Array, Array]:
            points = cloud.draw(len(sample), random)
            return points, cloud.log_density(sample) - cloud.log_density(points)

    return [(Jump(), JUMPS), (DEMove(), 0.75 * (1.0 - JUMPS)), (DESnookerMove(), 0.25 * (1.0 - JUMPS))]


def sampler_of(cloud: Cloud, density: Callable[[Array], Array], walkers: int) -> Any:
    """Return an emcee sampler over the coordinates, which hands over half of the walkers at a time."""
    import emcee

    return emcee.EnsembleSampler(walkers, len(cloud.centre), density, moves=moves(cloud), vectorize=True)


def state_of(points: Array, rng: np.random.Generator) -> Any:
    """Return emcee's state for the walkers at `points`; emcee would silently pass over a seed in any other form."""
    import emcee

    seed = np.random.RandomState(np.random.MT19937(int(rng.integers(2**63))))
    return emcee.State(points, random_state=seed.get_state(legacy=True))
