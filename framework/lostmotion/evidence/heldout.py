"""The second factor of the evidence: the density of the held-out data, given the fitted data and the same model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.evidence.expansion import Expansion
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.inference.fit import choose_first_steps
from lostmotion.likelihood.observation import Observation


def score_heldout(found: Hypothesis, pieces: Sequence[tuple[Observation, int]]) -> float:
    """Return the log density of the held-out samples, averaged over the posterior of the fitted data.

    `pieces` are recordings and the first held-out sample of each. With g and H the gradient and the information of the
    held-out data at the maximum of the fitted data, and Q the precision of the posterior there:
    log p + (g' (Q + H)^-1 g - log det(I + Q^-1 H)) / 2, the closed form for errors that are linear in the parameters.
    """
    return sum(_score_piece(found, observation, begin) for observation, begin in pieces)


def _score_piece(found: Hypothesis, observation: Observation, begin: int) -> float:
    frame, fitted = found.frame, found.frame.problem
    one = replace(frame, problem=fitted.on((observation,)))
    steps = choose_first_steps(replace(fitted, free=fitted.free[: frame.own]))
    seen = cut_before(one.expand(found.at, steps, found.choice), begin * len(observation.sensors))
    value = float(seen.here.log_likelihood)
    if not math.isfinite(value):
        return -math.inf
    kept, precision = found.used, found.precision
    gradient = seen.gradient[kept]
    information = seen.information[np.ix_(kept, kept)]
    both = precision + information
    sign, more = np.linalg.slogdet(both)
    before = np.linalg.slogdet(precision)[1]
    if sign <= 0:
        return -math.inf
    gain = 0.5 * float(gradient @ np.linalg.solve(both, gradient)) - 0.5 * float(more - before)
    return value + gain


def cut_before(seen: Expansion, first: int) -> Expansion:
    """Return an expansion without the readings before number `first`."""
    here = replace(seen.here, errors=seen.here.errors[first:], variances=seen.here.variances[first:])
    return replace(seen, here=here, errors=seen.errors[:, first:], variances=seen.variances[:, first:])
