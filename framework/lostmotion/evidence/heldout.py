"""The second factor of the evidence: the density of the held-out data, given the fitted data and the same model."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.evidence.discrepancy import JointFrame
from lostmotion.evidence.expansion import Expansion
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.inference.fit import choose_first_steps
from lostmotion.likelihood.observation import Observation


def score_heldout(found: Hypothesis, pieces: Sequence[tuple[Observation, int]]) -> float:
    """Return the log density of the held-out samples, averaged over the posterior of the fitted data.

    `pieces` are recordings and the first held-out sample of each.
    """
    return sum(_score_piece(found, observation, begin) for observation, begin in pieces)


def _score_piece(found: Hypothesis, observation: Observation, begin: int) -> float:
    frame, fitted = found.frame, found.frame.problem
    one = replace(frame, problem=fitted.on((observation,)))
    steps = choose_first_steps(replace(fitted, free=fitted.free[: frame.own]))
    first = begin * len(observation.sensors)
    held = cut_before(one.expand(found.at, steps, found.choice), first)
    return average_over_posterior(
        held, found.used, found.precision, lambda step: _score_point(one, found, found.at + step, first)
    )


def average_over_posterior(
    held: Expansion, used: NDArray[np.intp], precision: Array, score: Callable[[Array], float]
) -> float:
    """Return the log density of held-out data, averaged over a posterior of `precision` (used, used).

    With g and H the gradient and the information of the held-out data at the maximum of the fitted data, and Q the
    precision of the posterior there, it is log p + g' s / 2 - log det(I + Q^-1 H) / 2 with the step s = (Q + H)^-1 g:
    the closed form for errors that are linear in the coordinates `used`. Where they are not, the step gains less than
    g' s / 2, and the gain of the step counts; `score` returns the log density after a step (count,).
    """
    value = float(held.here.log_likelihood)
    both = precision + held.information[np.ix_(used, used)]
    sign, more = np.linalg.slogdet(both)
    if sign <= 0 or not math.isfinite(value):
        return -math.inf
    step = np.zeros(len(held.at))
    step[used] = np.linalg.solve(both, held.gradient[used])
    gained = score(step) - value - 0.5 * float(step[used] @ precision @ step[used])
    gain = max(min(0.5 * float(held.gradient @ step), gained), 0.0)
    return value + gain - 0.5 * float(more - np.linalg.slogdet(precision)[1])


def _score_point(frame: JointFrame, found: Hypothesis, at: Array, first: int) -> float:
    """Return the log density of the readings from number `first` on at some coordinates; -inf after a divergence."""
    problem = frame.bare(at, found.choice)
    seen = problem.innovations(at[: len(problem.free)])
    held = replace(seen, errors=seen.errors[first:], variances=seen.variances[first:])
    return float(held.log_likelihood)


def cut_before(seen: Expansion, first: int) -> Expansion:
    """Return an expansion without the readings before number `first`."""
    here = replace(seen.here, errors=seen.here.errors[first:], variances=seen.here.variances[first:])
    return replace(seen, here=here, errors=seen.errors[:, first:], variances=seen.variances[:, first:])
