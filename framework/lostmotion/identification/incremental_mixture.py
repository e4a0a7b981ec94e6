"""A mixture for a posterior of many narrow modes, found from the prior: it must cost little to ask.

Incremental mixture importance sampling: Raftery, Bao, Biometrics 66 (2010) 1162-1173. It draws from the prior, puts
kernels where the weights say that too few draws were made, draws from them, and so on; population Monte Carlo then
fits all kernels together.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import qmc

from lostmotion.contracts import Array
from lostmotion.identification.moves import Density, Posterior
from lostmotion.identification.population import Population, new_kernels
from lostmotion.identification.t_mixture import TMixture
from lostmotion.likelihood.problem import FreeParameter

FIRST = 4096
"""Draws from the prior."""
TURNS = 20
NEW = 8
"""Kernels that are added in each turn, at most."""
NEAR = 60
"""Draws around a new kernel that give it its scale, and draws that are then made from it."""
SURE = 20.0
"""Weights are flattened until this many draws are effective, so that no early draw takes all kernels to itself."""
POLISH = 10
FILL = 2000
DONE = 0.6
"""The search ends when this share of the draws of a round is effective."""
PRIOR = 0.1
"""The share of proposals that come from the whole prior, whatever was found."""


@dataclass(frozen=True)
class Before:
    """The prior as something to draw from, evenly spread."""

    posterior: Posterior
    free: tuple[FreeParameter, ...]

    def draw(self, count: int, random: Any) -> Array:
        """Return points (count, parameters): a Sobol sequence, scrambled."""
        shares = qmc.Sobol(len(self.free), rng=random).random(count)
        return np.array([[f.quantile(float(s)) for f, s in zip(self.free, row, strict=True)] for row in shares])

    def log_density(self, points: Array) -> Array:
        """Return the log prior density (points,)."""
        return np.array([self.posterior.log_prior(p) for p in points])


def incremental_mixture(posterior: Posterior, rng: np.random.Generator) -> TMixture:
    """Return a mixture of up to `TURNS * NEW` kernels and the prior, fitted to the posterior."""
    free = tuple(posterior.free)
    whole = TMixture.of_prior(free)
    population = Population.empty(Density(posterior), whole.size)
    population.grow(Before(posterior, free), FIRST, rng)
    mixture = _spread(whole, population, rng)
    for _ in range(POLISH):
        share = population.grow(mixture.beside(whole, PRIOR), FILL, rng)
        mixture = _fitted(mixture, population)
        if share > DONE:
            break
    return mixture.beside(whole, PRIOR)


def _spread(whole: TMixture, population: Population, rng: np.random.Generator) -> TMixture:
    """Return the kernels that were put, turn by turn, where draws were too few."""
    found: list[TMixture] = []
    unit = np.diag(whole.roots[0])
    for _ in range(TURNS):
        fresh = list(new_kernels(whole.scale, unit, population.points, population.shares(SURE), (NEW, NEAR)))
        if not fresh:
            break
        for kernel in fresh:
            population.grow(kernel, NEAR, rng)
        found += fresh
    return _joined(found or [whole])


def _joined(mixtures: list[TMixture]) -> TMixture:
    """Return all kernels as one mixture, with equal weights."""
    count = len(mixtures)
    centres, roots = (np.concatenate([getattr(c, name) for c in mixtures]) for name in ("centres", "roots"))
    return TMixture(np.full(count, 1.0 / count), centres, roots, mixtures[0].scale)


def _fitted(mixture: TMixture, population: Population) -> TMixture:
    """Return the mixture fitted to the draws that matter."""
    shares = population.shares(SURE)
    kept = shares > 1e-9
    return mixture.fitted(population.points[kept], shares[kept] / shares[kept].sum(), steps=3)
