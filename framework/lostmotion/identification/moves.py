"""Proposals of the ensemble sampler: mostly independent draws from a mixture fitted to the posterior, some walks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from lostmotion.contracts import Array
from lostmotion.identification.t_mixture import TMixture
from lostmotion.likelihood.space import ParameterSpace

JUMP_SHARE, JUMP_SHARE_AFTER_FIT = 0.95, 0.5
"""Share of independent proposals, and their share after the mixture was fitted to a chain that mixed badly.

The other proposals are differential evolution and snooker steps, which need no mixture."""


class TargetDensity(Protocol):
    """A posterior that can be sampled."""

    @property
    def space(self) -> ParameterSpace:
        """The free parameters with their priors."""

    def log_likelihood(self, points: Array) -> Array:
        """Return the log-likelihood (points,) at `points` (points, parameters), minus infinity where it diverges."""


@dataclass
class Density:
    """The log posterior density of many points at once; `evaluations` counts the evaluations of the likelihood."""

    posterior: TargetDensity
    evaluations: int = field(default=0)

    def __call__(self, points: Array) -> Array:
        """Return log densities (points,); minus infinity outside the prior or where the likelihood diverges."""
        log_densities = np.array(self.posterior.space.log_prior(points))
        inside = np.flatnonzero(np.isfinite(log_densities))
        if len(inside):
            log_densities[inside] += self.posterior.log_likelihood(points[inside])
        self.evaluations += len(inside)
        return np.where(np.isfinite(log_densities), log_densities, -np.inf)


def make_moves(mixture: TMixture, jumps: float = JUMP_SHARE) -> list[tuple[Any, float]]:
    """Return emcee's moves with their weights: independent jumps, differential evolution, and snooker steps."""
    from emcee.moves import DEMove, DESnookerMove, RedBlueMove

    class Jump(RedBlueMove):  # type: ignore[misc]
        """Propose from one fixed density for all walkers: Tierney, Annals of Statistics 22 (1994) 1701-1728."""

        def get_proposal(self, sample: Array, _complement: Any, random: Any) -> tuple[Array, Array]:
            points = mixture.draw(len(sample), random)
            return points, mixture.log_density(sample) - mixture.log_density(points)

    return [(Jump(), jumps), (DEMove(), 0.75 * (1.0 - jumps)), (DESnookerMove(), 0.25 * (1.0 - jumps))]


def make_sampler(moves: list[tuple[Any, float]], density: Callable[[Array], Array], backend: Any) -> Any:
    """Return an emcee sampler over the coordinates, which evaluates half of the walkers at a time."""
    import emcee

    return emcee.EnsembleSampler(*backend.shape, density, moves=moves, vectorize=True, backend=backend)


def make_state(points: Array, log_densities: Array, rng: np.random.Generator) -> Any:
    """Return emcee's state for walkers at `points` with these log densities.

    emcee silently ignores a seed in any other form.
    """
    import emcee

    seed = np.random.RandomState(np.random.MT19937(int(rng.integers(2**63))))
    return emcee.State(points, log_prob=log_densities, random_state=seed.get_state(legacy=True))
