"""The remaining random force of a fit: whether it exceeds the usual noise of a drive, and its log-likelihood gain."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from lostmotion.inference.fit import MANY, Fit, maximise
from lostmotion.likelihood.problem import RANDOM

USUAL_EXCESS = 2.0 * math.log(3.0)
"""A random force this far above the usual one, in log intensity, is reason to look for more."""


def has_usual_random_force(fit: Fit) -> bool:
    """Return whether the random force is at most three times the usual noise of the drive."""
    return all(
        at <= f.mean + USUAL_EXCESS for f, at in zip(fit.problem.free, fit.theta, strict=True) if f.parameter == RANDOM
    )


def compute_random_force_gain(fit: Fit) -> float:
    """Return the log-likelihood that a random force beyond three times the usual noise of the drive adds.

    If each recording has its own random force, all of them are limited together.
    """
    problem, theta, frees = fit.problem, fit.theta.copy(), list(fit.problem.free)
    for i, free in enumerate(frees):
        cap = free.mean + USUAL_EXCESS
        if free.parameter == RANDOM and theta[i] > cap:
            theta[i], frees[i] = cap, replace(free, high=cap, start=cap)
    if np.array_equal(theta, fit.theta):
        return 0.0
    capped = maximise(replace(problem, free=tuple(frees)), theta, rounds=6 if len(theta) > MANY else 40)
    return float(np.maximum(fit.log_likelihood - capped.log_likelihood, 0.0))
