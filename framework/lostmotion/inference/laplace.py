"""Marginal likelihoods checked by importance sampling: Laplace's method assumes a normal posterior."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import gammaln, logsumexp

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit
from lostmotion.inference.sensitivity import MANY
from lostmotion.results.diagnosis import SampledEvidence

HEAVY = 5.0
"""Degrees of freedom of the t proposal density: its tails must be heavier than those of the posterior."""
WIDER = 1.2


def sample_evidence(fit: Fit, rng: np.random.Generator, draws: int = 150) -> SampledEvidence:
    """Return the log evidence of a fit by importance sampling about its maximum.

    Geweke, Econometrica 57 (1989) 1317-1339. Coordinates at a bound are drawn beyond it as well; such draws have weight
    zero, so the truncation is included. So is the roughness of a filter through kinks. Beyond `MANY` coordinates a few
    draws would have all the weight, and nothing is sampled.
    """
    if len(fit.theta) > MANY:
        return SampledEvidence(fit.log_evidence, -math.inf, math.inf, 0.0)
    theta, covariance = fit.theta, fit.local.covariance
    sd = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    shape = covariance / np.outer(sd, sd) * WIDER**2 + 1e-10 * np.eye(len(sd))
    raw, told = _draw_t(shape, draws, rng)
    points, log_densities = theta + raw * sd, told - float(np.sum(np.log(sd)))
    weights = fit.posterior.log_density(points) - log_densities
    if not np.isfinite(weights).any():
        return SampledEvidence(fit.log_evidence, -math.inf, math.inf, 0.0)
    total = float(logsumexp(weights))
    crowd = float(np.sum(np.exp(weights - total) ** 2))
    error = math.sqrt(max(crowd - 1.0 / draws, 0.0))
    return SampledEvidence(fit.log_evidence, total - math.log(draws), error, 1.0 / crowd)


def _draw_t(shape: Array, draws: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Return draws (draws, n) of a t density about zero, and its logarithm (draws,) there.

    SciPy has both, in a module that takes longer to import than this takes to compute.
    """
    values, axes = np.linalg.eigh(shape)
    n, root = len(shape), axes * np.sqrt(np.maximum(values, 1e-12))
    wide = np.sqrt(rng.chisquare(HEAVY, size=draws) / HEAVY)
    white = rng.standard_normal((draws, n)) / wide[:, None]
    constant = gammaln(0.5 * (HEAVY + n)) - gammaln(0.5 * HEAVY) - 0.5 * n * math.log(HEAVY * math.pi)
    tail = -0.5 * (HEAVY + n) * np.log1p(np.sum(white**2, axis=1) / HEAVY)
    return white @ root.T, constant - 0.5 * float(np.sum(np.log(np.maximum(values, 1e-12)))) + tail
