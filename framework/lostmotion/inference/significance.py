"""The significance of the amplitudes of terms by robust covariance, for residuals that may be autocorrelated."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import chdtri, ndtr

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, compute_robust_covariance
from lostmotion.inference.natural import sort_slots
from lostmotion.likelihood.problem import Problem

REFERENCE = 3.0
"""The number of standard deviations at which the significance of several amplitudes is compared with that of one."""


def measure_significance(fit: Fit) -> tuple[float, float]:
    """Return the smallest amplitude in robust standard deviations, and the ratio of robust to usual deviations.

    The signed amplitudes of a term count together: a wave has a cosine and a sine, and one of them may be zero.
    """
    robust, usual = compute_robust_covariance(fit), fit.local.covariance
    groups = [at for term in sorted(fit.problem.active) for at in _list_amplitudes(fit.problem, term)]
    sizes = [compute_deviations(fit.theta[at], robust[np.ix_(at, at)]) for at in groups]
    every = [i for at in groups for i in at]
    wider = np.sqrt(np.diag(robust)[every] / np.maximum(np.diag(usual)[every], 1e-300))
    return min(sizes, default=math.inf), float(np.max(wider, initial=1.0))


def _list_amplitudes(problem: Problem, key: str) -> list[list[int]]:
    """Return the indices of the amplitudes of a term among the free parameters, in groups that count together."""
    slots, _ = sort_slots(problem, key)
    alone = [[problem.keys.index(s.key)] for s in slots if s.param.low >= 0.0]
    signed = [problem.keys.index(s.key) for s in slots if s.param.low < 0.0]
    return [*alone, signed] if signed else alone


def compute_deviations(amplitudes: Array, covariance: Array) -> float:
    """Return the equivalent number of standard deviations of one normal variable for amplitudes with a covariance."""
    squared = float(amplitudes @ np.linalg.pinv(covariance) @ amplitudes)
    return math.sqrt(squared * REFERENCE**2 / chdtri(len(amplitudes), 2.0 * ndtr(-REFERENCE)))
