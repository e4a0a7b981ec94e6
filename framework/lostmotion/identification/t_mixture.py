"""A proposal density: a mixture of multivariate t distributions in normal scores of the coordinates."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.identification.normal_scores import MAX_SCORE, Scores
from lostmotion.likelihood.space import FreeParameter

KERNEL_DOF = 10.0
"""Degrees of freedom of each kernel: its tails are heavier than those of the posteriors in this project."""
QUANTILES = 400
CHUNK = 2000
FIT_STEPS = 12
"""Expectation-maximisation steps in one fit: a good proposal is sufficient, full convergence is not needed."""


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
        low, high = collect_bounds(free)
        spreads = np.stack([np.sqrt(np.diag(c)) for c in covariances])
        room = np.minimum(spreads, 0.25 * (high - low))
        centres = np.clip(np.atleast_2d(points), low + room, high - room)
        shares = np.asarray(weights, dtype=float) / np.sum(weights)
        main = int(np.argmax(shares))
        scale = Scores.piled(low, high, np.atleast_2d(points)[main], spreads[main])
        slopes = np.exp(scale.compute_log_slopes(centres))
        roots = [compute_root(c * np.outer(s, s)) for c, s in zip(covariances, slopes, strict=True)]
        return cls(shares, scale.to_scores(centres), np.stack(roots), scale)

    @classmethod
    def of_prior(cls, free: tuple[FreeParameter, ...]) -> TMixture:
        """Return the mixture of one kernel that covers the prior."""
        scale = Scores.flat(*collect_bounds(free))
        shares = (np.arange(QUANTILES) + 0.5) / QUANTILES
        points = np.array([[f.quantile(float(s)) for f in free] for s in shares])
        scores = scale.to_scores(points)
        return cls(np.ones(1), scores.mean(axis=0)[None], np.diag(scores.std(axis=0))[None], scale)

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
        stretch = np.sqrt(KERNEL_DOF / random.chisquare(KERNEL_DOF, count))
        scores = self.centres[which] + stretch[:, None] * np.einsum("kij,kj->ki", self.roots[which], normal)
        points = self.scale.to_points(scores)
        beyond = np.any(np.abs(scores) > MAX_SCORE, axis=1)
        if beyond.any():
            points[beyond] = self.draw(int(beyond.sum()), random)
        return np.asarray(points)

    def log_density(self, points: Array) -> Array:
        """Return the log density (count,) of points; the mass beyond `MAX_SCORE` is too small to be corrected for."""
        parts, _ = self._compute_parts(self.scale.to_scores(points))
        return np.asarray(np.logaddexp.reduce(parts, axis=1) + np.sum(self.scale.compute_log_slopes(points), axis=1))

    def fit(self, points: Array, shares: Array, *, steps: int = FIT_STEPS) -> TMixture:
        """Return the mixture fitted to the density of which `points` with weights `shares` (sum 1) are draws.

        Expectation-maximisation of Cappe et al., Statistics and Computing 18 (2008) 447-459. A kernel with few draws
        keeps its scale, and a kernel without draws is removed.
        """
        scores = self.scale.to_scores(points)
        draws = 1.0 / float(np.sum(shares**2))
        before = np.einsum("kij,klj->kil", self.roots, self.roots)
        mixture = self
        for _ in range(steps):
            mixture = mixture._take_step(scores, shares, before, draws)
        kept = mixture.weights * draws > 1e-3
        return mixture.select_kernels(kept) if kept.any() else self

    def _take_step(self, scores: Array, shares: Array, before: Array, draws: float) -> TMixture:
        """Return the mixture after one step; the scales `before` enter like a few additional draws."""
        parts, lengths = self._compute_parts(scores)
        belongs = shares[:, None] * np.exp(parts - np.logaddexp.reduce(parts, axis=1)[:, None])
        pulls = belongs * (KERNEL_DOF + self.size) / (KERNEL_DOF + lengths)
        mass, pulled = belongs.sum(axis=0), np.maximum(pulls.sum(axis=0), 1e-300)
        seen = pulled * draws > 0.5
        centres = np.where(seen[:, None], pulls.T @ scores / pulled[:, None], self.centres)
        few = self.size + 2.0
        roots = []
        for k in range(self.kernels):
            off = scores - centres[k]
            scale = draws * (pulls[:, k, None] * off).T @ off + few * before[k]
            roots.append(compute_root(scale / (draws * mass[k] + few)))
        return replace(self, weights=mass / mass.sum(), centres=centres, roots=np.stack(roots))

    @cached_property
    def _inverse(self) -> tuple[Array, Array]:
        """The transposed inverse of each root, and the logarithm of its determinant."""
        return np.swapaxes(np.linalg.inv(self.roots), 1, 2), np.asarray(np.linalg.slogdet(self.roots)[1])

    def _compute_parts(self, scores: Array) -> tuple[Array, Array]:
        """Return the log density of each kernel times its weight, and the squared distances, (count, kernels)."""
        inverse, volumes = self._inverse
        lengths = np.empty((len(scores), self.kernels))
        for begin in range(0, len(scores), CHUNK):
            some = scores[begin : begin + CHUNK]
            white = (some[None] - self.centres[:, None]) @ inverse
            lengths[begin : begin + CHUNK] = np.sum(white**2, axis=2).T
        with np.errstate(divide="ignore"):
            log_densities = np.log(self.weights) - volumes
        log_densities += math.lgamma(0.5 * (KERNEL_DOF + self.size)) - math.lgamma(0.5 * KERNEL_DOF)
        log_densities -= 0.5 * self.size * math.log(KERNEL_DOF * math.pi)
        return log_densities - 0.5 * (KERNEL_DOF + self.size) * np.log1p(lengths / KERNEL_DOF), lengths

    def select_kernels(self, kept: NDArray[np.bool_]) -> TMixture:
        """Return the mixture of some of the kernels."""
        weights = self.weights[kept]
        return replace(self, weights=weights / weights.sum(), centres=self.centres[kept], roots=self.roots[kept])

    def mix_with(self, other: TMixture, share: float) -> TMixture:
        """Return the mixture of this one and the `share` of another."""
        return replace(
            self,
            weights=np.concatenate([(1.0 - share) * self.weights, share * other.weights]),
            centres=np.concatenate([self.centres, other.centres]),
            roots=np.concatenate([self.roots, other.roots]),
        )

    def widen(self, factor: float) -> TMixture:
        """Return one kernel with the mean and `factor` times the covariance of the mixture."""
        centre = self.weights @ self.centres
        off = self.centres - centre
        within = np.einsum("k,kij,klj->il", self.weights, self.roots, self.roots)
        covariance = within + (self.weights[:, None] * off).T @ off
        return replace(
            self, weights=np.ones(1), centres=centre[None], roots=math.sqrt(factor) * compute_root(covariance)[None]
        )


def collect_bounds(free: tuple[FreeParameter, ...]) -> tuple[Array, Array]:
    """Return the lower and the upper bounds of the coordinates."""
    return np.array([f.low for f in free]), np.array([f.high for f in free])


def compute_root(covariance: Array) -> Array:
    """Return a square root of a covariance that may be nearly singular."""
    scale = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    values, vectors = np.linalg.eigh(covariance / np.outer(scale, scale))
    return np.asarray(scale[:, None] * vectors * np.sqrt(np.maximum(values, 1e-12 * float(values[-1]))))
