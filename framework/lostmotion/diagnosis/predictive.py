"""The log score of held-out data under the posterior predictive distribution of a fit.

A model with a small random force is sure of its predictions: with the parameters held at the maximum, small errors of a
few of them, extrapolated over the held-out data, cost far more than the true model deserves. The density of the
held-out data is therefore averaged over draws from the posterior (Gelman et al., Bayesian Data Analysis, 3rd ed.,
section 7.1).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit
from lostmotion.inference.mixture import compute_root
from lostmotion.likelihood.observation import Observation

DRAWS, BLOCKS = 32, 20


@dataclass(frozen=True)
class HeldOutStretch:
    """A held-out part: its recording, and the sample at which it begins."""

    observation: Observation
    begin: int


def compute_block_scores(fit: Fit, piece: HeldOutStretch) -> Array:
    """Return the log density per sample of successive blocks of a held-out part, (blocks,), at most `BLOCKS`.

    Each is the logarithm of the mean density over draws from the posterior: a block alone hardly changes the posterior.
    """
    parts = np.array_split(_compute_log_densities(fit, piece, _draw_near(fit)), BLOCKS, axis=1)
    return np.array([_average(np.sum(part, axis=1)) / part.shape[1] for part in parts if part.shape[1]])


def _average(log_densities: Array) -> float:
    """Return the logarithm of the mean of densities."""
    return float(logsumexp(log_densities)) - math.log(len(log_densities))


def _draw_near(fit: Fit) -> Array:
    """Return the maximum of the posterior, and draws from the normal approximation there: (1 + DRAWS, coordinates)."""
    if not np.all(np.isfinite(fit.local.covariance)):
        return fit.theta[None]
    noise = np.random.default_rng(0).standard_normal((DRAWS, len(fit.theta)))
    return np.vstack([fit.theta, fit.posterior.space.clip(fit.theta + noise @ compute_root(fit.local.covariance).T)])


def _compute_log_densities(fit: Fit, piece: HeldOutStretch, thetas: Array) -> Array:
    """Return the log densities of one-step predictions (points, held-out samples), of all sensors together."""
    seen = fit.posterior.on((piece.observation,)).innovations(thetas)
    with np.errstate(invalid="ignore", divide="ignore"):
        each = -0.5 * (seen.errors**2 / seen.variances + np.log(2.0 * np.pi * seen.variances))
    samples = np.sum(each.reshape(len(thetas), piece.observation.samples, -1), axis=2)
    return np.where(np.isfinite(samples) & seen.finite[:, None], samples, -np.inf)[:, piece.begin :]
