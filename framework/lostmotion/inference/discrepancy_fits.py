"""Fits of a set of terms with the smooth forces and the corrected channels of its discrepancy (`rival.py`)."""

from __future__ import annotations

from typing import NamedTuple

from lostmotion.inference.channel_correction import CorrectedFit, correct_alike, correct_channels
from lostmotion.inference.fit import Fit
from lostmotion.inference.rival import DiscrepancyExpansion, expand_fit, fit_discrepancy

LEAST_GAIN = -10.0
"""The least gain of a discrepancy without effect: free known values and channel errors that explain nothing reduce the
log evidence by about this much."""

MOST_ADDITIONS, WORTHWHILE = 2, 6.0
"""Smooth forces are added to a fit at most this number of times, if they predict at least this gain in log evidence."""
MOST_CORRECTIONS = 3
"""Channels are corrected at most this number of times, if their errors predict a large gain."""


class DiscrepancyFit(NamedTuple):
    """The fit of a set with the smooth forces of its discrepancy: gain in log evidence, log penalty, predicted rest.

    `rest` is the gain that errors of known values and channels predict in addition, up to a limit. `fit` is the fit
    with smooth forces to the uncorrected recordings, `corrected` the fit to recordings with corrected channels.
    """

    evidence: float
    price: float
    rest: float
    fit: Fit
    corrected: CorrectedFit | None = None

    @property
    def free_values_cost(self) -> float:
        """The measured change of log evidence by free known values and channel errors, at most zero."""
        return max(LEAST_GAIN, min(self.rest, 0.0))

    def compute_gain(self, inflation: float) -> float:
        """Return the gain in log evidence, with log-likelihoods divided by `inflation`."""
        return self.evidence / inflation - self.price + self.rest


def evaluate_fit(found: tuple[Fit, float] | None, fit: Fit) -> DiscrepancyFit | None:
    """Return the evaluated fit with smooth forces, compared with the fit without; None if there is none."""
    if found is None or found[0].status == "diverged":
        return None
    best, price, rest = _add_smooth_forces(*found)
    right = None
    fitted = bare = DiscrepancyFit(best.log_evidence - fit.log_evidence, price, _limit_gain(rest), best)
    for _ in range(MOST_CORRECTIONS):
        if not rest.compute_fixed_gain(rest.inflation) > rest.fit.problem.settings.rival.much:
            break
        right = correct_channels(rest, right)
        if right is None or right.fit.status == "diverged":
            break
        rest = expand_fit(right.fit)
        more = _add_corrections(bare, right, rest, fit)
        if not more.compute_gain(rest.inflation) > fitted.compute_gain(rest.inflation):
            break
        fitted = more
    return fitted


def evaluate_alike(known: DiscrepancyFit, fit: Fit, corrected: CorrectedFit) -> DiscrepancyFit:
    """Return the discrepancy fit of a set with the channel corrections of another set, if it is better than without.

    A linear expansion predicts corrections. Far from its maximum it predicts absurd ones, which are not tried, so one
    of two sets may be left without corrections that serve both.
    """
    right = correct_alike(known.fit, corrected)
    if right.fit.status == "diverged":
        return known
    rest = expand_fit(right.fit)
    found = _add_corrections(known, right, rest, fit)
    return max(known, found, key=lambda fitted: fitted.compute_gain(rest.inflation))


def _add_corrections(bare: DiscrepancyFit, right: CorrectedFit, rest: DiscrepancyExpansion, fit: Fit) -> DiscrepancyFit:
    """Return the evaluated fit to corrected recordings; `bare` is the one without, `rest` the expansion of `right`."""
    evidence = right.fit.log_evidence + right.log_jacobian - fit.log_evidence
    return DiscrepancyFit(evidence, bare.price + right.price, _limit_gain(rest), bare.fit, right)


def _add_smooth_forces(best: Fit, price: float) -> tuple[Fit, float, DiscrepancyExpansion]:
    """Return a fit with smooth forces, its log penalty, and its expansion.

    Further smooth forces are added as long as they predict a further gain and the fit confirms it.
    """
    rest = expand_fit(best)
    for _ in range(MOST_ADDITIONS):
        if not rest.find_best().gain - rest.compute_fixed_gain(rest.inflation) > WORTHWHILE:
            break
        more = fit_discrepancy(rest)
        if more is None or more[0].status == "diverged" or more[0].log_evidence - more[1] < best.log_evidence:
            break
        best, price = more[0], price + more[1]
        rest = expand_fit(best)
    return best, price, rest


def _limit_gain(rest: DiscrepancyExpansion) -> float:
    """Return the predicted gain of an expansion about a fit with smooth forces, up to a limit."""
    predicted, limits = rest.predict_gain(), rest.fit.problem.settings.rival
    return min(predicted if predicted < limits.absurd else rest.compute_fixed_gain(rest.inflation), limits.much)
