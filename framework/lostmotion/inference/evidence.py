"""Marginal likelihoods checked by sampling: Laplace's method assumes a normal posterior."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp
from scipy.stats import multivariate_t

from lostmotion.inference.fit import MANY, Fit

HEAVY = 5.0
"""Degrees of freedom of the t density that is sampled from: its tails must be heavier than those of the posterior."""
WIDER = 1.2


@dataclass(frozen=True)
class Check:
    """A log evidence by Laplace's method and by importance sampling, with the standard error of the latter.

    `effective` counts the draws that the weights leave; below a few tens the sampled value is not to be trusted.
    """

    laplace: float
    sampled: float
    error: float
    effective: float


def checked(fit: Fit, rng: np.random.Generator, draws: int = 150) -> Check:
    """Return the log evidence of a fit by importance sampling about its maximum.

    Geweke, Econometrica 57 (1989) 1317-1339. Coordinates that press against a bound are drawn beyond it as well; such
    draws have no weight, so the cut is counted. The noise of a filter through kinks counts as well. Beyond `MANY`
    coordinates the weights would fall on a few draws, and nothing is sampled.
    """
    if len(fit.theta) > MANY:
        return Check(fit.log_evidence, -math.inf, math.inf, 0.0)
    theta, covariance = fit.theta, fit.local.covariance
    sd = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    shape = covariance / np.outer(sd, sd) * WIDER**2 + 1e-10 * np.eye(len(sd))
    density = multivariate_t(np.zeros(len(sd)), shape, df=HEAVY)
    raw = np.atleast_2d(density.rvs(size=draws, random_state=rng)).reshape(draws, len(sd))
    points = theta + raw * sd
    heights = density.logpdf(raw) - float(np.sum(np.log(sd)))
    weights = fit.problem.log_posteriors(points) - heights
    if not np.isfinite(weights).any():
        return Check(fit.log_evidence, -math.inf, math.inf, 0.0)
    total = float(logsumexp(weights))
    crowd = float(np.sum(np.exp(weights - total) ** 2))
    error = math.sqrt(max(crowd - 1.0 / draws, 0.0))
    return Check(fit.log_evidence, total - math.log(draws), error, 1.0 / crowd)
