"""A density to propose from: a mixture of multivariate t distributions in normal scores of the coordinates."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.identification.normal_scores import FAR, Scores
from lostmotion.likelihood.problem import FreeParameter

TAIL = 10.0
"""Degrees of freedom of each kernel: its tails are heavier than those of any posterior met here."""
QUANTILES = 400
CHUNK = 2000
FITTING = 12
"""Steps of expectation and maximisation in one fit: what is wanted is a good proposal, not the last digit."""


@dataclass(frozen=True)
class TMixture:
    """A mixture of multivariate t kernels in the scores of the coordinates.

    `weights` (kernels,) add up to one, `centres` (kernels, parameters) and `roots` (kernels, parameters, parameters)
    are scores; a root times its transpose is the kernel's scale.
    """

    weights: Array
    centres: Array
    roots: Array
    scale: Scores

    @classmethod
    def of_modes(
        cls, points: Array, covariances: Sequence[Array] | Array, weights: Array, free: tuple[FreeParameter, ...]
    ) -> TMixture:
        """Return the mixture of normal approximations at `points` (modes, parameters).

        A centre that is closer to a bound than one deviation moves away from it.
        """
        low, high = bounds_of(free)
        spreads = np.stack([np.sqrt(np.diag(c)) for c in covariances])
        room = np.minimum(spreads, 0.25 * (high - low))
        centres = np.clip(np.atleast_2d(points), low + room, high - room)
        shares = np.asarray(weights, dtype=float) / np.sum(weights)
        main = int(np.argmax(shares))
        scale = Scores.piled(low, high, np.atleast_2d(points)[main], spreads[main])
        slopes = np.exp(scale.log_slopes(centres))
        roots = [root_of(c * np.outer(s, s)) for c, s in zip(covariances, slopes, strict=True)]
        return cls(shares, scale.of(centres), np.stack(roots), scale)

    @classmethod
    def of_prior(cls, free: tuple[FreeParameter, ...]) -> TMixture:
        """Return the mixture of one kernel that covers the prior."""
        scale = Scores.flat(*bounds_of(free))
        shares = (np.arange(QUANTILES) + 0.5) / QUANTILES
        points = np.array([[f.quantile(float(s)) for f in free] for s in shares])
        scores = scale.of(points)
        return cls(np.ones(1), scores.mean(axis=0)[None], np.diag(scores.std(axis=0))[None], scale)

    @classmethod
    def by_importance_sampling(cls, posterior: Any, rng: np.random.Generator) -> TMixture:
        """Return a mixture found from the prior by population Monte Carlo, for a rugged posterior that costs little."""
        from lostmotion.identification.incremental_mixture import incremental_mixture  # which is built on this class

        return incremental_mixture(posterior, rng)

    @property
    def kernels(self) -> int:
        """The number of kernels."""
        return len(self.weights)

    @property
    def size(self) -> int:
        """The number of parameters."""
        return int(self.centres.shape[1])

    def draw(self, count: int, random: Any) -> Array:
        """Return points (count, parameters); `random` is NumPy's `Generator` or the `RandomState` of emcee."""
        which = random.choice(self.kernels, count, p=self.weights)
        normal = random.standard_normal((count, self.size))
        stretch = np.sqrt(TAIL / random.chisquare(TAIL, count))
        scores = self.centres[which] + stretch[:, None] * np.einsum("kij,kj->ki", self.roots[which], normal)
        points = self.scale.points(scores)
        beyond = np.any(np.abs(scores) > FAR, axis=1)
        if beyond.any():
            points[beyond] = self.draw(int(beyond.sum()), random)
        return np.asarray(points)

    def log_density(self, points: Array) -> Array:
        """Return the log density (count,) of points; what lies beyond `FAR` is too little to be left out of it."""
        parts, _ = self._parts(self.scale.of(points))
        return np.asarray(np.logaddexp.reduce(parts, axis=1) + np.sum(self.scale.log_slopes(points), axis=1))

    def fitted(self, points: Array, shares: Array, *, steps: int = FITTING) -> TMixture:
        """Return the mixture moved towards the density of which `points` with weights `shares` (sum 1) are draws.

        The steps of expectation and maximisation of Cappe et al., Statistics and Computing 18 (2008) 447-459. A kernel
        that few draws fall into keeps its scale, and one that none falls into goes.
        """
        scores = self.scale.of(points)
        draws = 1.0 / float(np.sum(shares**2))
        before = np.einsum("kij,klj->kil", self.roots, self.roots)
        mixture = self
        for _ in range(steps):
            mixture = mixture._step(scores, shares, before, draws)
        kept = mixture.weights * draws > 1e-3
        return mixture.only(kept) if kept.any() else self

    def _step(self, scores: Array, shares: Array, before: Array, draws: float) -> TMixture:
        """Return the mixture after one step; scales are those `before` as if seen in a few draws more."""
        parts, lengths = self._parts(scores)
        belongs = shares[:, None] * np.exp(parts - np.logaddexp.reduce(parts, axis=1)[:, None])
        pulls = belongs * (TAIL + self.size) / (TAIL + lengths)
        mass, pulled = belongs.sum(axis=0), np.maximum(pulls.sum(axis=0), 1e-300)
        seen = pulled * draws > 0.5
        centres = np.where(seen[:, None], pulls.T @ scores / pulled[:, None], self.centres)
        few = self.size + 2.0
        roots = []
        for k in range(self.kernels):
            off = scores - centres[k]
            scale = draws * (pulls[:, k, None] * off).T @ off + few * before[k]
            roots.append(root_of(scale / (draws * mass[k] + few)))
        return replace(self, weights=mass / mass.sum(), centres=centres, roots=np.stack(roots))

    @cached_property
    def _inverse(self) -> tuple[Array, Array]:
        """The inverse of each root, transposed, and the logarithm of its volume."""
        return np.swapaxes(np.linalg.inv(self.roots), 1, 2), np.asarray(np.linalg.slogdet(self.roots)[1])

    def _parts(self, scores: Array) -> tuple[Array, Array]:
        """Return the log density of each kernel times its weight, and the squared distances, (count, kernels)."""
        inverse, volumes = self._inverse
        lengths = np.empty((len(scores), self.kernels))
        for begin in range(0, len(scores), CHUNK):
            some = scores[begin : begin + CHUNK]
            white = (some[None] - self.centres[:, None]) @ inverse
            lengths[begin : begin + CHUNK] = np.sum(white**2, axis=2).T
        with np.errstate(divide="ignore"):
            log_densities = np.log(self.weights) - volumes
        log_densities += math.lgamma(0.5 * (TAIL + self.size)) - math.lgamma(0.5 * TAIL)
        log_densities -= 0.5 * self.size * math.log(TAIL * math.pi)
        return log_densities - 0.5 * (TAIL + self.size) * np.log1p(lengths / TAIL), lengths

    def only(self, kept: NDArray[np.bool_]) -> TMixture:
        """Return the mixture of some of the kernels."""
        weights = self.weights[kept]
        return replace(self, weights=weights / weights.sum(), centres=self.centres[kept], roots=self.roots[kept])

    def split(self, parts: int, rng: np.random.Generator) -> TMixture:
        """Return the mixture with `parts` smaller kernels in place of each, scattered about its centre."""
        roots = np.repeat(self.roots, parts, axis=0)
        moved = np.einsum("kij,kj->ki", roots, rng.standard_normal((parts * self.kernels, self.size)))
        return replace(
            self,
            weights=np.repeat(self.weights, parts) / parts,
            centres=np.repeat(self.centres, parts, axis=0) + 0.7 * moved,
            roots=0.7 * roots,
        )

    def beside(self, other: TMixture, share: float) -> TMixture:
        """Return the mixture of this one and the `share` of another."""
        return replace(
            self,
            weights=np.concatenate([(1.0 - share) * self.weights, share * other.weights]),
            centres=np.concatenate([self.centres, other.centres]),
            roots=np.concatenate([self.roots, other.roots]),
        )

    def widened(self, factor: float) -> TMixture:
        """Return one kernel with the mean and `factor` times the covariance of the mixture."""
        centre = self.weights @ self.centres
        off = self.centres - centre
        within = np.einsum("k,kij,klj->il", self.weights, self.roots, self.roots)
        covariance = within + (self.weights[:, None] * off).T @ off
        return replace(
            self, weights=np.ones(1), centres=centre[None], roots=math.sqrt(factor) * root_of(covariance)[None]
        )


def bounds_of(free: tuple[FreeParameter, ...]) -> tuple[Array, Array]:
    """Return the lower and the upper bounds of the coordinates."""
    return np.array([f.low for f in free]), np.array([f.high for f in free])


def root_of(covariance: Array) -> Array:
    """Return a square root of a covariance that may be nearly singular."""
    scale = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    values, vectors = np.linalg.eigh(covariance / np.outer(scale, scale))
    return np.asarray(scale[:, None] * vectors * np.sqrt(np.maximum(values, 1e-12 * float(values[-1]))))
