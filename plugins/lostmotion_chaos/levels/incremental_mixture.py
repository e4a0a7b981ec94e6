"""A proposal mixture for a posterior with many narrow modes, found from the prior; the likelihood must be cheap.

Incremental mixture importance sampling: Raftery, Bao, Biometrics 66 (2010) 1162-1173. It draws from the prior, adds
kernels where the weights show too few draws, draws from these kernels, and repeats this. Population Monte Carlo then
fits all kernels together.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import qmc

from lostmotion.contracts import Array
from lostmotion.identification.moves import Density, TargetDensity
from lostmotion.identification.population import Population, place_kernels
from lostmotion.identification.t_mixture import TMixture
from lostmotion.likelihood.space import ParameterSpace

PRIOR_DRAWS = 4096
"""Draws from the prior."""
MAX_ROUNDS = 20
KERNELS_PER_ROUND = 8
"""Largest number of kernels that are added in each round."""
NEIGHBOURS = 60
"""Number of nearest draws that set the scale of a new kernel, and number of draws from the new kernel."""
LEAST_EFFECTIVE = 20.0
"""Weights are flattened until this many draws are effective, so that one early draw does not attract all kernels."""
FIT_ROUNDS = 10
FIT_DRAWS = 2000
EFFICIENCY_GOAL = 0.6
"""The fit ends when this share of the draws of a round is effective."""
PRIOR_SHARE = 0.1
"""Share of proposals from the whole prior."""


@dataclass(frozen=True)
class PriorSource:
    """The prior as a source of evenly distributed draws."""

    space: ParameterSpace

    def draw(self, count: int, random: Any) -> Array:
        """Return points (count, parameters) from a scrambled Sobol sequence."""
        shares = qmc.Sobol(len(self.space.free), rng=random).random(count)
        return np.array([[f.quantile(float(s)) for f, s in zip(self.space.free, row, strict=True)] for row in shares])

    def log_density(self, points: Array) -> Array:
        """Return the log prior density (points,)."""
        return np.asarray(self.space.log_prior(points))


def find_mixture(posterior: TargetDensity, rng: np.random.Generator) -> TMixture:
    """Return a mixture of up to `TURNS * NEW` kernels and the prior, fitted to the posterior."""
    whole = TMixture.of_prior(posterior.space.free)
    population = Population.empty(Density(posterior), whole.size)
    population.grow(PriorSource(posterior.space), PRIOR_DRAWS, rng)
    mixture = _place_kernels(whole, population, rng)
    for _ in range(FIT_ROUNDS):
        share = population.grow(mixture.mix_with(whole, PRIOR_SHARE), FIT_DRAWS, rng)
        mixture = _fit_mixture(mixture, population)
        if share > EFFICIENCY_GOAL:
            break
    return mixture.mix_with(whole, PRIOR_SHARE)


def _place_kernels(whole: TMixture, population: Population, rng: np.random.Generator) -> TMixture:
    """Return the kernels added, round by round, where there were too few draws."""
    found: list[TMixture] = []
    unit = np.diag(whole.roots[0])
    for _ in range(MAX_ROUNDS):
        fresh = list(
            place_kernels(
                whole.scale,
                unit,
                population.points,
                population.compute_weights(LEAST_EFFECTIVE),
                (KERNELS_PER_ROUND, NEIGHBOURS),
            )
        )
        if not fresh:
            break
        for kernel in fresh:
            population.grow(kernel, NEIGHBOURS, rng)
        found += fresh
    return _join_mixtures(found or [whole])


def _join_mixtures(mixtures: list[TMixture]) -> TMixture:
    """Return all kernels as one mixture, with equal weights."""
    count = len(mixtures)
    centres, roots = (np.concatenate([getattr(c, name) for c in mixtures]) for name in ("centres", "roots"))
    return TMixture(np.full(count, 1.0 / count), centres, roots, mixtures[0].scale)


def _fit_mixture(mixture: TMixture, population: Population) -> TMixture:
    """Return the mixture fitted to the draws with noticeable weight."""
    shares = population.compute_weights(LEAST_EFFECTIVE)
    kept = shares > 1e-9
    return mixture.fit(population.points[kept], shares[kept] / shares[kept].sum(), steps=3)
