"""The significance of the amplitudes of terms by robust covariance, for residuals that may be autocorrelated."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtri, ndtr

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, compute_covariance, compute_robust_covariance
from lostmotion.inference.natural import collect_shapes, sort_slots
from lostmotion.likelihood.problem import Problem
from lostmotion.settings import SelectSettings

REFERENCE = 3.0
"""The number of standard deviations at which the significance of several amplitudes is compared with that of one."""


@dataclass(frozen=True)
class Significance:
    """How well the terms of a fit are determined.

    `deviations` has the smallest amplitude of each term in robust standard deviations from its null value, `ratio` is
    the largest ratio of robust to usual standard deviations of an amplitude.
    """

    deviations: Mapping[str, float]
    ratio: float

    def list_vague(self, limits: SelectSettings) -> list[str]:
        """Return the terms whose amplitudes are not significant, most vague first.

        With autocorrelated residuals samples are not independent, and a term that resembles them always gains. Where
        robust standard deviations do not exceed the usual ones, samples are independent, and the evidence decides.
        """
        if self.ratio < limits.independent:
            return []
        order = sorted(self.deviations, key=lambda key: self.deviations[key])
        return [key for key in order if not self.deviations[key] > limits.certain]


def measure_significance(fit: Fit) -> Significance:
    """Return how well the terms of a fit are determined, by robust and by usual standard deviations.

    The signed amplitudes of a term count together: a wave has a cosine and a sine, and one of them may be zero. Shapes
    are held: at the null value nothing depends on them, and with a free limit the share of a drive that saturates is
    vague, though a drive that does not saturate is excluded.
    """
    shapes = _list_shapes(fit.problem)
    robust, usual = compute_robust_covariance(fit, shapes), compute_covariance(fit, shapes)
    groups = {term: _list_amplitudes(fit.problem, term) for term in sorted(fit.problem.active)}
    deviations = {
        term: min((compute_deviations(fit.theta[at], robust[np.ix_(at, at)]) for at in own), default=math.inf)
        for term, own in groups.items()
    }
    every = [i for own in groups.values() for at in own for i in at]
    wider = np.sqrt(np.diag(robust)[every] / np.maximum(np.diag(usual)[every], 1e-300))
    return Significance(deviations, float(np.max(wider, initial=1.0)))


def _list_shapes(problem: Problem) -> list[int]:
    """Return the indices of the shapes of all terms among the free parameters."""
    keys = {s.key for s in collect_shapes(problem, problem.active)}
    return [i for i, key in enumerate(problem.keys) if key in keys]


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
