"""A density to propose from: a mixture of multivariate t distributions in the logits of the coordinates."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.inference.problem import Free

TAIL = 6.0
"""Degrees of freedom of each kernel: its tails are heavier than those of any posterior met here."""
FAR = 20.0
"""No proposal lies further out than this logit, so that it stays a number apart from its bound."""
QUANTILES = 400
CHUNK = 2000
FITTING = 12
"""Steps of expectation and maximisation in one fit: what is wanted is a good proposal, not the last digit."""


@dataclass(frozen=True)
class Cloud:
    """A mixture of multivariate t kernels in the logits of the coordinates between their bounds.

    `weights` (kernels,) add up to one, `centres` (kernels, parameters) and `roots` (kernels, parameters, parameters)
    are logits; a root times its transpose is the kernel's scale. Far from the bounds a logit is as good as the
    coordinate; near one it spreads out a posterior that piles up there.
    """

    weights: Array
    centres: Array
    roots: Array
    low: Array
    high: Array

    @classmethod
    def of_modes(
        cls, points: Array, covariances: Sequence[Array] | Array, weights: Array, free: tuple[Free, ...]
    ) -> Cloud:
        """Return the cloud of normal approximations at `points` (modes, parameters).

        A centre that is closer to a bound than one deviation moves away from it.
        """
        low, high = bounds_of(free)
        spreads = np.stack([np.sqrt(np.diag(c)) for c in covariances])
        room = np.minimum(spreads, 0.25 * (high - low))
        centres = np.clip(np.atleast_2d(points), low + room, high - room)
        slopes = 1.0 / (centres - low) + 1.0 / (high - centres)
        roots = [root_of(c * np.outer(s, s)) for c, s in zip(covariances, slopes, strict=True)]
        shares = np.asarray(weights, dtype=float)
        return cls(shares / shares.sum(), _logits(centres, low, high), np.stack(roots), low, high)

    @classmethod
    def of_prior(cls, free: tuple[Free, ...]) -> Cloud:
        """Return the cloud of one kernel that covers the prior."""
        low, high = bounds_of(free)
        shares = (np.arange(QUANTILES) + 0.5) / QUANTILES
        points = np.array([[f.quantile(float(s)) for f in free] for s in shares])
        logits = _logits(points, low, high)
        return cls(np.ones(1), logits.mean(axis=0)[None], np.diag(logits.std(axis=0))[None], low, high)

    @classmethod
    def swarm(cls, posterior: Any, rng: np.random.Generator) -> Cloud:
        """Return a cloud found from the prior by population Monte Carlo, for a rugged posterior that costs little."""
        from lostmotion.stages._swarm import swarm  # which is built on clouds

        return swarm(posterior, rng)

    @property
    def kernels(self) -> int:
        """The number of kernels."""
        return len(self.weights)

    @property
    def size(self) -> int:
        """The number of parameters."""
        return len(self.low)

    def draw(self, count: int, random: Any) -> Array:
        """Return points (count, parameters); `random` is NumPy's `Generator` or the `RandomState` of emcee."""
        which = random.choice(self.kernels, count, p=self.weights)
        normal = random.standard_normal((count, self.size))
        stretch = np.sqrt(TAIL / random.chisquare(TAIL, count))
        logits = self.centres[which] + stretch[:, None] * np.einsum("kij,kj->ki", self.roots[which], normal)
        points = self.low + (self.high - self.low) / (1.0 + np.exp(-np.clip(logits, -FAR, FAR)))
        beyond = np.any(np.abs(logits) > FAR, axis=1)
        if beyond.any():
            points[beyond] = self.draw(int(beyond.sum()), random)
        return np.asarray(points)

    def log_density(self, points: Array) -> Array:
        """Return the log density (count,) of points; what lies beyond `FAR` is too little to be left out of it."""
        up, down = points - self.low, self.high - points
        with np.errstate(divide="ignore"):
            slope = np.sum(np.log(1.0 / up + 1.0 / down), axis=1)
        parts, _ = self._parts(self.logits(points))
        return np.asarray(np.logaddexp.reduce(parts, axis=1) + slope)

    def fitted(self, points: Array, shares: Array, *, steps: int = FITTING) -> Cloud:
        """Return the cloud moved towards the density of which `points` with weights `shares` (sum 1) are draws.

        The steps of expectation and maximisation of Cappe et al., Statistics and Computing 18 (2008) 447-459. A kernel
        that few draws fall into keeps its scale, and one that none falls into goes.
        """
        logits = self.logits(points)
        draws = 1.0 / float(np.sum(shares**2))
        before = np.einsum("kij,klj->kil", self.roots, self.roots)
        cloud = self
        for _ in range(steps):
            cloud = cloud._step(logits, shares, before, draws)
        kept = cloud.weights * draws > 1e-3
        return cloud.only(kept) if kept.any() else self

    def _step(self, logits: Array, shares: Array, before: Array, draws: float) -> Cloud:
        """Return the cloud after one step; scales are those `before` as if seen in a few draws more."""
        parts, lengths = self._parts(logits)
        belongs = shares[:, None] * np.exp(parts - np.logaddexp.reduce(parts, axis=1)[:, None])
        pulls = belongs * (TAIL + self.size) / (TAIL + lengths)
        mass, pulled = belongs.sum(axis=0), np.maximum(pulls.sum(axis=0), 1e-300)
        seen = pulled * draws > 0.5
        centres = np.where(seen[:, None], pulls.T @ logits / pulled[:, None], self.centres)
        few = self.size + 2.0
        roots = []
        for k in range(self.kernels):
            off = logits - centres[k]
            scale = draws * (pulls[:, k, None] * off).T @ off + few * before[k]
            roots.append(root_of(scale / (draws * mass[k] + few)))
        return replace(self, weights=mass / mass.sum(), centres=centres, roots=np.stack(roots))

    def logits(self, points: Array) -> Array:
        """Return the logits of points between the bounds, none of them beyond `FAR`."""
        return _logits(points, self.low, self.high)

    @cached_property
    def _inverse(self) -> tuple[Array, Array]:
        """The inverse of each root, transposed, and the logarithm of its volume."""
        return np.swapaxes(np.linalg.inv(self.roots), 1, 2), np.asarray(np.linalg.slogdet(self.roots)[1])

    def _parts(self, logits: Array) -> tuple[Array, Array]:
        """Return the log density of each kernel times its weight, and the squared distances, (count, kernels)."""
        inverse, volumes = self._inverse
        lengths = np.empty((len(logits), self.kernels))
        for begin in range(0, len(logits), CHUNK):
            some = logits[begin : begin + CHUNK]
            white = (some[None] - self.centres[:, None]) @ inverse
            lengths[begin : begin + CHUNK] = np.sum(white**2, axis=2).T
        with np.errstate(divide="ignore"):
            heights = np.log(self.weights) - volumes
        heights += math.lgamma(0.5 * (TAIL + self.size)) - math.lgamma(0.5 * TAIL)
        heights -= 0.5 * self.size * math.log(TAIL * math.pi)
        return heights - 0.5 * (TAIL + self.size) * np.log1p(lengths / TAIL), lengths

    def only(self, kept: NDArray[np.bool_]) -> Cloud:
        """Return the cloud of some of the kernels."""
        weights = self.weights[kept]
        return replace(self, weights=weights / weights.sum(), centres=self.centres[kept], roots=self.roots[kept])

    def split(self, parts: int, rng: np.random.Generator) -> Cloud:
        """Return the cloud with `parts` smaller kernels in place of each, scattered about its centre."""
        roots = np.repeat(self.roots, parts, axis=0)
        moved = np.einsum("kij,kj->ki", roots, rng.standard_normal((parts * self.kernels, self.size)))
        return replace(
            self,
            weights=np.repeat(self.weights, parts) / parts,
            centres=np.repeat(self.centres, parts, axis=0) + 0.7 * moved,
            roots=0.7 * roots,
        )

    def beside(self, other: Cloud, share: float) -> Cloud:
        """Return the mixture of this cloud and the `share` of another."""
        return replace(
            self,
            weights=np.concatenate([(1.0 - share) * self.weights, share * other.weights]),
            centres=np.concatenate([self.centres, other.centres]),
            roots=np.concatenate([self.roots, other.roots]),
        )

    def widened(self, factor: float) -> Cloud:
        """Return one kernel with the mean and `factor` times the covariance of the mixture."""
        centre = self.weights @ self.centres
        off = self.centres - centre
        within = np.einsum("k,kij,klj->il", self.weights, self.roots, self.roots)
        covariance = within + (self.weights[:, None] * off).T @ off
        return replace(
            self, weights=np.ones(1), centres=centre[None], roots=math.sqrt(factor) * root_of(covariance)[None]
        )


def bounds_of(free: tuple[Free, ...]) -> tuple[Array, Array]:
    """Return the lower and the upper bounds of the coordinates."""
    return np.array([f.low for f in free]), np.array([f.high for f in free])


def _logits(points: Array, low: Array, high: Array) -> Array:
    with np.errstate(divide="ignore"):
        return np.asarray(np.clip(np.log((points - low) / (high - points)), -FAR, FAR))


def root_of(covariance: Array) -> Array:
    """Return a square root of a covariance that may be nearly singular."""
    scale = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    values, vectors = np.linalg.eigh(covariance / np.outer(scale, scale))
    return np.asarray(scale[:, None] * vectors * np.sqrt(np.maximum(values, 1e-12 * float(values[-1]))))
