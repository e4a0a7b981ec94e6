"""Correction of recordings for the channel errors that a discrepancy predicts, and the fit to corrected recordings."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.channel_errors import Change
from lostmotion.inference.fit import Fit, maximise, restart
from lostmotion.inference.rival import DiscrepancyExpansion
from lostmotion.likelihood.observation import Observation

ROUNDS = 4
"""Rounds of a fit to corrected recordings."""
ROUNDS_ALIKE = 8
"""Rounds of a fit to recordings with the corrections of another set: no expansion predicts where it starts."""


@dataclass(frozen=True)
class CorrectedFit:
    """A fit to recordings whose channels were corrected by `sizes` (channel errors,) in total.

    `log_jacobian` is the change of the log density of the readings by the change of their scale, and `price` the log
    penalty of the corrections: the prior of their sizes, and the Occam factor of their estimation. `changes` are the
    corrections, in order.
    """

    fit: Fit
    sizes: Array
    log_jacobian: float
    price: float
    changes: tuple[tuple[Change, float], ...]

    def correct(self, observation: Observation) -> Observation:
        """Return another recording of the same channels with the same corrections."""
        return reduce(lambda seen, step: step[0](seen, step[1]), self.changes, observation)


def correct_channels(expansion: DiscrepancyExpansion, before: CorrectedFit | None = None) -> CorrectedFit | None:
    """Return the fit to recordings that are corrected for channel errors; None where there are no channel errors.

    The recordings of the expansion may have been corrected `before`. A correction is at most `rival.correction` prior
    standard deviations: a larger error is a term of its own, such as a wrong gain or a delay. If the predicted
    correction reduces the log density of the readings by more than `rival.absurd`, the expansion is not valid, and
    nothing is fitted (None).
    """
    count, fit = len(expansion.channel_errors), expansion.fit
    if not count:
        return None
    best, observations = expansion.find_best(), fit.problem.observations
    widths, already = best.widths[-count:], before.sizes if before else np.zeros(count)
    most = fit.problem.settings.rival.correction * widths
    sizes = np.clip(already + best.mean[-count:], -most, most)
    wider, changes = (before.log_jacobian, before.changes) if before else (0.0, ())
    now = fit.local.log_posterior + wider
    for channel_error, size in zip(expansion.channel_errors, map(float, sizes - already), strict=True):
        observations = tuple(channel_error.change(o, size) for o in observations)
        wider += channel_error.log_jacobian * size
        changes += ((channel_error.change, size),)
    problem = restart(fit).on(observations)
    begin = problem.clip(expansion.shift_coordinates(sizes - already))
    if not problem.log_posterior(begin) + wider > now - fit.problem.settings.rival.absurd:
        return None
    better = maximise(problem, begin, rounds=ROUNDS, tolerance=0.3)
    inner = np.eye(count) + expansion.compute_channel_information() * np.outer(widths, widths)
    price = 0.5 * float(np.sum((sizes / widths) ** 2)) + 0.5 * float(np.linalg.slogdet(inner)[1])
    return CorrectedFit(better, sizes, wider, price, changes)


def correct_alike(fit: Fit, corrected: CorrectedFit) -> CorrectedFit:
    """Return a fit to recordings with the corrections that were made for another set of terms, at the same penalty."""
    observations = tuple(map(corrected.correct, fit.problem.observations))
    problem = restart(fit).on(observations)
    return replace(corrected, fit=maximise(problem, problem.clip(fit.theta), rounds=ROUNDS_ALIKE, tolerance=0.3))
