"""The second factor of the evidence: the density of the held-out data, given the fitted data and the same model."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.evidence.discrepancy import JointFrame
from lostmotion.evidence.expansion import Expansion
from lostmotion.evidence.hypothesis import Hypothesis, maximise_within
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.observation import Observation

ROUNDS, CLOSE = 6, 1.0
"""The largest number of Gauss-Newton steps, and the gain in log density below which the next one is left out."""
SHARES = (1.0, 0.4, 0.1)
"""The shares of a step that are tried until one gains."""
LEAD = 0.1
"""The filter begins by this share of a recording before the held-out samples, and forgets how it began. Laws with
states of their own may not forget, as one that wears with the travel: it begins with the recording then."""


def score_heldout(found: Hypothesis, pieces: Sequence[tuple[Observation, int]]) -> float:
    """Return the log density of the held-out samples, averaged over the posterior of the fitted data.

    `pieces` are recordings and the first held-out sample of each.
    """
    return sum(_score_piece(found, observation, begin) for observation, begin in pieces)


def _score_piece(found: Hypothesis, observation: Observation, begin: int) -> float:
    frame, start = found.frame, max(begin - math.ceil(LEAD * observation.samples), 0)
    if any(find_term(frame.posterior, key)[0].states for key in frame.terms):
        start = 0
    one = replace(frame, posterior=frame.posterior.on((observation.part(start, observation.samples),)))
    first = (begin - start) * len(observation.sensors)

    def expand(step: Array) -> Expansion:
        return cut_before(one.expand(found.at + step, frame.first_steps, found.choice), first)

    def score(step: Array) -> float:
        return _score_point(one, found, found.at + step, first)

    low, high = (bound - found.at for bound in frame.bounds)
    return average_over_posterior(NormalPosterior(found.used, found.precision, frame.levels, low, high), expand, score)


@dataclass(frozen=True)
class NormalPosterior:
    """A normal posterior of coordinates `used`, of `precision` (used, used); `levels` (count,) tells noise levels.

    Steps from the maximum are between `low` and `high`, each (count,) or one number for all.
    """

    used: NDArray[np.intp]
    precision: Array
    levels: NDArray[np.bool_]
    low: Array | float = -math.inf
    high: Array | float = math.inf

    def weigh(self, step: Array) -> float:
        """Return the log density after a step (count,) from the maximum, relative to the maximum."""
        return -0.5 * float(step[self.used] @ self.precision @ step[self.used])

    def find_step(self, held: Expansion, step: Array, *, levels: bool) -> tuple[Array, float]:
        """Return the Gauss-Newton step (count,) from one with an expansion there, and the gain that it promises.

        Without `levels` the noise levels stay.
        """
        free = np.flatnonzero(levels | ~self.levels[self.used])
        pulled = (held.gradient[self.used] - self.precision @ step[self.used])[free]
        precision = self.add(held)[np.ix_(free, free)]
        rows = self.used[free]
        low, high = ((np.broadcast_to(bound, len(step)) - step)[rows] for bound in (self.low, self.high))
        further = np.zeros(len(step))
        further[rows] = made = maximise_within(pulled, precision, low, high)
        return further, float(pulled @ made) - 0.5 * float(made @ precision @ made)

    def add(self, held: Expansion) -> Array:
        """Return the precision (used, used) with the information of held-out data."""
        return np.asarray(self.precision + held.information[np.ix_(self.used, self.used)])


def average_over_posterior(
    posterior: NormalPosterior, expand: Callable[[Array], Expansion], score: Callable[[Array], float]
) -> float:
    """Return the log density of held-out data, averaged over a posterior of the fitted data with precision Q.

    It is the maximum of log p(held-out | s) - s'Q s / 2 over steps s (count,) from the maximum of the fitted data, less
    log det(I + Q^-1 H) / 2 with the information H there: Laplace's method, exact for errors that are linear in the
    coordinates. A smooth force over the time is free after the fitted data, so the first step may be long, and noise
    levels wait until it is found. `expand` and `score` return the held-out data and their log density after a step.
    """
    step = np.zeros(len(posterior.levels))
    held = expand(step)
    value = float(held.here.log_likelihood)
    for levels in (False, True):
        for _ in range(ROUNDS):
            if not (math.isfinite(value) and np.all(np.isfinite(held.information))):
                return -math.inf
            further, gain = posterior.find_step(held, step, levels=levels)
            for trial in (step + share * further for share in SHARES if gain > CLOSE):
                if (reached := score(trial) + posterior.weigh(trial)) > value:
                    break
            else:
                break
            left, step, value = gain - (reached - value), trial, reached
            held = expand(step)
            if left < CLOSE:
                break
    more = np.linalg.slogdet(posterior.add(held))[1] - np.linalg.slogdet(posterior.precision)[1]
    return value - 0.5 * float(more)


def _score_point(frame: JointFrame, found: Hypothesis, at: Array, first: int) -> float:
    """Return the log density of the readings from number `first` on at some coordinates; -inf after a divergence."""
    posterior = frame.bare(at, found.choice)
    seen = posterior.innovations(at[: len(posterior.space.free)])
    held = replace(seen, errors=seen.errors[first:], variances=seen.variances[first:])
    return float(held.log_likelihood)


def cut_before(seen: Expansion, first: int) -> Expansion:
    """Return an expansion without the readings before number `first`."""
    here = replace(seen.here, errors=seen.here.errors[first:], variances=seen.here.variances[first:])
    return replace(seen, here=here, errors=seen.errors[:, first:], variances=seen.variances[:, first:])
