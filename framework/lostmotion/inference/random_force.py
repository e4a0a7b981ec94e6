"""The remaining random force of a fit: whether it exceeds the usual noise of a drive, and its log-likelihood gain."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from lostmotion.inference.fit import ROUGHLY, Fit, maximise
from lostmotion.inference.sensitivity import MANY
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM


def has_usual_random_force(fit: Fit) -> bool:
    """Return whether the random force is at most three times the usual noise of the drive (`locate.quiet`)."""
    most = _compute_excess(fit.posterior)
    return all(
        at <= f.mean + most for f, at in zip(fit.posterior.space.free, fit.theta, strict=True) if f.parameter == RANDOM
    )


def _compute_excess(posterior: Posterior) -> float:
    """Return the largest usual excess of the log intensity of the random force over its prior mean."""
    return 2.0 * math.log(posterior.settings.locate.quiet)


def reduces_random_force(fit: Fit, over: Fit, share: float) -> bool:
    """Return whether the random force of a fit is lower than that of another one by more than a share."""
    mine, other = (v.theta[v.posterior.space.keys.index(RANDOM)] for v in (fit, over))
    return bool(mine < other + math.log(1.0 - share))


def compute_random_force_gain(fit: Fit) -> float:
    """Return the log-likelihood that a random force beyond three times the usual noise of the drive adds.

    If each recording has its own random force, all of them are limited together.
    """
    posterior, theta, frees = fit.posterior, fit.theta.copy(), list(fit.posterior.space.free)
    for i, free in enumerate(frees):
        cap = free.mean + _compute_excess(posterior)
        if free.parameter == RANDOM and theta[i] > cap:
            theta[i], frees[i] = cap, replace(free, high=cap, start=cap)
    if np.array_equal(theta, fit.theta):
        return 0.0
    capped = maximise(posterior.over(frees), theta, rounds=6 if len(theta) > MANY else 40, tolerance=ROUGHLY)
    return float(np.maximum(fit.log_likelihood - capped.log_likelihood, 0.0))
