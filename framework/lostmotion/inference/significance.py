"""How far the amplitudes of terms stand out of their errors, where something with a memory may be left over."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import chdtri, ndtr

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, compute_robust_covariance
from lostmotion.inference.natural import sort_slots
from lostmotion.likelihood.problem import Problem

REFERENCE = 3.0
"""An amplitude counts when it is this many robust standard deviations from nothing."""


def measure_significance(fit: Fit) -> tuple[float, float]:
    """Return the least amplitude in robust standard deviations, and how much wider those are than usual.

    The signed amplitudes of a term are one: a wave has a cosine and a sine, and either may be nothing.
    """
    robust, usual = compute_robust_covariance(fit), fit.local.covariance
    groups = [at for term in sorted(fit.problem.active) for at in _list_amplitudes(fit.problem, term)]
    sizes = [compute_deviations(fit.theta[at], robust[np.ix_(at, at)]) for at in groups]
    every = [i for at in groups for i in at]
    wider = np.sqrt(np.diag(robust)[every] / np.maximum(np.diag(usual)[every], 1e-300))
    return min(sizes, default=math.inf), float(np.max(wider, initial=1.0))


def _list_amplitudes(problem: Problem, key: str) -> list[list[int]]:
    """Return where the amplitudes of a term stand among the free parameters, those together that count as one."""
    slots, _ = sort_slots(problem, key)
    alone = [[problem.keys.index(s.key)] for s in slots if s.param.low >= 0.0]
    signed = [problem.keys.index(s.key) for s in slots if s.param.low < 0.0]
    return [*alone, signed] if signed else alone


def compute_deviations(amplitudes: Array, covariance: Array) -> float:
    """Return how many standard deviations of one normal number are as rare as these amplitudes are if nothing is."""
    squared = float(amplitudes @ np.linalg.pinv(covariance) @ amplitudes)
    return math.sqrt(squared * REFERENCE**2 / chdtri(len(amplitudes), 2.0 * ndtr(-REFERENCE)))
