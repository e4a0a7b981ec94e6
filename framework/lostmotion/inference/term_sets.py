"""The sets of terms that a selection has fitted, their comparison with a generic smooth force, and their probabilities.

Each set of terms is compared together with a model discrepancy (`rival.py`). The log evidence that the discrepancy adds
is either predicted by a local expansion about a fit, or confirmed by a fit with the smooth forces.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from lostmotion.inference.candidates import ScoreTest
from lostmotion.inference.discrepancy_fits import DiscrepancyFit, evaluate_alike, evaluate_fit
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.inference.rival import (
    DiscrepancyExpansion,
    expand_fit,
    fit_discrepancy,
    fit_imitation,
)
from lostmotion.settings import RivalSettings

CLOSE = 12.0
"""Sets within this distance of the best in log weight are refitted, and kept for comparison."""
BEAM = 3
"""The number of sets of one size that are extended in each round."""


@dataclass(frozen=True)
class TermSet:
    """A fitted set of terms with its fit and its log posterior weight (log evidence plus log prior of the set)."""

    terms: frozenset[str]
    fit: Fit
    weight: float


class KnownLogOdds(NamedTuple):
    """The log odds of a set over another one, and the fits from which they were computed."""

    basis: tuple[object, ...]
    value: float


@dataclass(frozen=True)
class SimplestTerms:
    """Terms that explain the data better than any learned curve, and no better than a generic smooth force.

    `probabilities` are those of the terms by key, `unknown` that of a force which the library does not contain, and
    `nothing` that of the nominal model. `curve` is the log evidence that the best learned curve adds, zero where none
    is decisive.
    """

    probabilities: Mapping[str, float]
    curve: float
    unknown: float
    nothing: float


@dataclass
class Selection:
    """The state of a selection: the nominal fit, all fitted sets, the score tests of the first round, the chosen set.

    `declined` are terms with evidence that is not reliable, because the residuals are autocorrelated. `expansions` has
    the expansion of each set with the discrepancy, and `tied` the terms that are supported by the evidence but not
    better than a smooth force. `stopped` states that the search ended at its limit. `withdrawn` are terms that held-out
    data refuted, and `replaced` those of a set that predicted held-out data worse than the chosen one: sets with one of
    them have no probability, but a set with a replaced term may be chosen if the chosen one is refuted. `heldout_gains`
    are differences in the log score of held-out data, which are added to the log odds of sets. `simplest` replaces the
    probabilities if the chosen set is only the simplest explanation. `discrepancy_fits` has the fit of the discrepancy
    of each set for which one was made, `known_log_odds` the log odds that were computed, and `imitations` the pairs of
    sets, one a part of the other, for which smooth forces were fitted in place of the additional terms.
    `corrected_alike` has the discrepancy fits of sets for which the channel corrections of another set were tried.
    """

    nominal: Fit
    chosen: Fit
    fitted_sets: dict[frozenset[str], TermSet] = field(default_factory=dict)
    hints: tuple[ScoreTest, ...] = ()
    declined: set[str] = field(default_factory=set)
    expansions: dict[frozenset[str], tuple[Fit, DiscrepancyExpansion]] = field(default_factory=dict)
    tied: set[str] = field(default_factory=set)
    stopped: bool = False
    withdrawn: frozenset[str] = frozenset()
    replaced: frozenset[str] = frozenset()
    heldout_gains: dict[frozenset[str], float] = field(default_factory=dict)
    simplest: SimplestTerms | None = None
    discrepancy_fits: dict[frozenset[str], tuple[Fit, DiscrepancyFit | None]] = field(default_factory=dict)
    known_log_odds: dict[tuple[frozenset[str], frozenset[str]], KnownLogOdds] = field(default_factory=dict)
    imitations: dict[tuple[frozenset[str], frozenset[str]], tuple[Fit, Fit]] = field(default_factory=dict)
    corrected_alike: dict[frozenset[str], DiscrepancyFit] = field(default_factory=dict)

    @property
    def best_nominal(self) -> Fit:
        """The best fit of the nominal model: the first one, or a better one from the initial states of another set."""
        return self.fitted_sets[frozenset()].fit

    @property
    def limits(self) -> RivalSettings:
        """The usual imperfections of real machines."""
        return self.nominal.problem.settings.rival

    def expansion(self, term_set: TermSet) -> DiscrepancyExpansion:
        """Return the expansion of a set with its discrepancy; it is computed once for each fit."""
        known = self.expansions.get(term_set.terms)
        if known is None or known[0] is not term_set.fit:
            self.expansions[term_set.terms] = (term_set.fit, expand_fit(term_set.fit))
        return self.expansions[term_set.terms][1]

    def compute_log_odds(self, term_set: TermSet, over: TermSet) -> float:
        """Return the log odds of a set over another one, both with the discrepancy.

        Differences in log-likelihood are divided by the inflation of the scatter of scores by autocorrelation. If the
        other set is a subset, it is also evaluated by the expansion about the larger set, in which the random force is
        no larger than necessary. The subset counts with the whole predicted gain of its discrepancy, the larger set
        only with the gain that a fit confirms (`fit_discrepancy`). If both were fitted, the fits are compared.
        """
        if term_set.terms < over.terms:
            return -self.compute_log_odds(over, term_set)
        basis = (
            term_set.fit,
            self.discrepancy_fit(term_set),
            over.fit,
            self.discrepancy_fit(over),
            self._has_discrepancy_fit(term_set),
            self._has_discrepancy_fit(over),
        )
        known = self.known_log_odds.get((term_set.terms, over.terms))
        if known is None or any(old is not new for old, new in zip(known.basis, basis, strict=True)):
            known = self.known_log_odds[term_set.terms, over.terms] = KnownLogOdds(
                basis, self._evaluate_log_odds(term_set, over)
            )
        return known.value

    def fit_discrepancy(self, term_set: TermSet) -> None:
        """Fit the smooth forces of the discrepancy of a set if they predict a large gain; the fitted gain counts then.

        Such a fit costs as much as a hundred score tests, so it is made only for sets that can decide a choice.
        """
        if not self._has_discrepancy_fit(term_set):
            if self.expansion(term_set).find_best().gain >= self.limits.much:
                self._fit_smooth_forces(term_set)
            else:
                self.discrepancy_fits[term_set.terms] = (term_set.fit, None)

    def _fit_smooth_forces(self, term_set: TermSet) -> None:
        """Fit the discrepancy beside a set, and store the result."""
        self.discrepancy_fits[term_set.terms] = (
            term_set.fit,
            evaluate_fit(fit_discrepancy(self.expansion(term_set)), term_set.fit),
        )

    def confirm_lead(self, term_set: TermSet, over: TermSet) -> None:
        """Fit the discrepancy of a set that leads one of larger weight by a gain that is only predicted."""
        gain = self.expansion(term_set).find_best().gain
        if self.discrepancy_fit(term_set) is None and gain > 0.0 and self.compute_log_odds(term_set, over) > 0.0:
            self._fit_smooth_forces(term_set)

    def discrepancy_fit(self, term_set: TermSet) -> DiscrepancyFit | None:
        """Return the fit of the discrepancy of a set; None if none was made."""
        return self.discrepancy_fits[term_set.terms][1] if self._has_discrepancy_fit(term_set) else None

    def settle_comparison(self, term_set: TermSet, over: TermSet, needed: float) -> None:
        """Fit discrepancies where this can decide whether the log odds of a set over another one exceed `needed`.

        Such a fit reduces the log odds, unless the expansion about the set is not valid. If the discrepancy of one of
        the two sets was fitted, that of the other is fitted too, even if it predicts a small gain.
        """
        if (
            self.compute_log_odds(term_set, over) > needed
            or self.expansion(term_set).find_best().gain >= self.limits.absurd
        ):
            self.fit_discrepancy(term_set)
        bare = [v for v in (term_set, over) if self.discrepancy_fit(v) is None]
        if len(bare) == 1 and self.compute_log_odds(term_set, over) > needed:
            self._fit_smooth_forces(bare[0])
        if over.terms < term_set.terms and self._compare_by_fits(term_set, over) > needed >= self.compute_log_odds(
            term_set, over
        ):
            self._fit_imitation(term_set, over)
        self._correct_alike(term_set, over, needed)

    def _correct_alike(self, term_set: TermSet, over: TermSet, needed: float) -> None:
        """Correct the channels for both sets, if they were corrected only for the one that is ahead."""
        ahead, behind = (term_set, over) if self.compute_log_odds(term_set, over) > needed else (over, term_set)
        best, known = self.discrepancy_fit(ahead), self.discrepancy_fit(behind)
        if not (best and best.corrected and known) or known.corrected:
            return
        if self.corrected_alike.get(behind.terms) is not known:
            found = evaluate_alike(known, behind.fit, best.corrected)
            self.discrepancy_fits[behind.terms] = (behind.fit, found)
            self.corrected_alike[behind.terms] = found

    def _fit_imitation(self, term_set: TermSet, over: TermSet) -> None:
        """Fit smooth forces in place of the terms that a set has in addition to a subset, starting from its expansion.

        The gain counts for the subset; from then on the log odds of the two sets are computed from fits only.
        """
        known = self.discrepancy_fit(over)
        if known is None or self.discrepancy_fit(term_set) is None:
            return
        found = evaluate_fit(fit_imitation(self.expansion(term_set), term_set.terms - over.terms), over.fit)
        if found is not None:
            self.discrepancy_fits[over.terms] = (
                over.fit,
                max(known, found, key=lambda fitted: fitted.compute_gain(1.0)),
            )
            self.imitations[term_set.terms, over.terms] = (term_set.fit, over.fit)

    def _has_discrepancy_fit(self, term_set: TermSet) -> bool:
        return term_set.terms in self.discrepancy_fits and self.discrepancy_fits[term_set.terms][0] is term_set.fit

    def predict_smooth_gain(self) -> float:
        """Return the gain in log evidence that smooth forces predict beside the chosen set; 0 without an expansion."""
        terms = self.chosen.problem.active
        if terms not in self.expansions:
            return 0.0
        expansion = self.expansion(self.fitted_sets[terms])
        return expansion.find_best().gain - expansion.compute_fixed_gain(expansion.inflation)

    def estimate_confirmed_gain(self, term_set: TermSet, inflation: float) -> float:
        """Return the log evidence that a discrepancy adds to a set; if it was fitted, at most the confirmed gain."""
        expansion = self.expansion(term_set)
        predicted, fitted = expansion.find_best(inflation).gain, self.discrepancy_fit(term_set)
        if fitted is None:
            return predicted
        return min(
            predicted,
            max(fitted.compute_gain(inflation), min(expansion.compute_fixed_gain(inflation), fitted.free_values_cost)),
        )

    def estimate_largest_gain(self, term_set: TermSet, inflation: float, more: frozenset[str] = frozenset()) -> float:
        """Return the log evidence that a discrepancy may add to a subset: the larger of predicted and fitted gain.

        If scores have a long autocorrelation, a fitted gain is mostly that of the autocorrelation, and only the
        predicted gain counts. A predicted gain that a fit does not confirm counts up to `absurd`, except against `more`
        terms with a prior penalty for uncommon causes.
        """
        predicted = self.expansion(term_set).find_best(inflation).gain
        fitted = self.discrepancy_fit(term_set) if inflation < self.limits.lasting else None
        if fitted is None:
            return predicted
        last = any(find_term(self.chosen.problem, key)[0].unlikely > 0.0 for key in more)
        return max(predicted if last else min(predicted, self.limits.absurd), fitted.compute_gain(inflation))

    @staticmethod
    def _compare_penalties(term_set: TermSet, over: TermSet) -> float:
        """Return the prior penalty of a set less that of another one."""
        return (term_set.fit.log_evidence - term_set.weight) - (over.fit.log_evidence - over.weight)

    def _evaluate_log_odds(self, term_set: TermSet, over: TermSet) -> float:
        here, inflation = self.expansion(term_set), self.expansion(term_set).inflation
        own, penalties = self.estimate_confirmed_gain(term_set, inflation), self._compare_penalties(term_set, over)
        if not over.terms < term_set.terms:
            behind = (over.fit.log_evidence - term_set.fit.log_evidence) / inflation
            return own - behind - self.estimate_confirmed_gain(over, inflation) - penalties
        log_odds, imitation = self._compare_by_fits(term_set, over), self.imitations.get((term_set.terms, over.terms))
        if not self.is_expansion_valid(term_set) or (
            imitation and imitation[0] is term_set.fit and imitation[1] is over.fit
        ):
            return log_odds
        dropped = here.list_coordinates(term_set.terms - over.terms)
        return min(log_odds, own - here.predict_gain(dropped, inflation=inflation) - penalties)

    def _compare_by_fits(self, term_set: TermSet, over: TermSet) -> float:
        """Return the log odds of a set over a subset from predicted or fitted gains of smooth forces beside either."""
        here, inflation = self.expansion(term_set), self.expansion(term_set).inflation
        fitted = (
            self.discrepancy_fit(term_set) if self.discrepancy_fit(over) and inflation < self.limits.lasting else None
        )
        own = (
            max(fitted.compute_gain(inflation), min(here.compute_fixed_gain(inflation), fitted.free_values_cost))
            if fitted
            else self.estimate_confirmed_gain(term_set, inflation)
        )
        behind = (over.fit.log_evidence - term_set.fit.log_evidence) / inflation
        return (
            own
            - behind
            - self.estimate_largest_gain(over, inflation, term_set.terms - over.terms)
            - self._compare_penalties(term_set, over)
        )

    def is_expansion_valid(self, term_set: TermSet) -> bool:
        """Return whether the expansion about a set is valid; a body at rest, for instance, ignores small forces.

        It is not valid if it predicts a very large gain and a fit confirms nothing of it.
        """
        fitted = self.discrepancy_fit(term_set)
        return fitted is None or fitted.evidence > 0.0 or self.expansion(term_set).find_best().gain < self.limits.absurd

    def probabilities(self) -> dict[frozenset[str], float]:
        """Return the posterior probability of each fitted set, without sets of declined or withdrawn terms.

        Sets with an expansion or close to the chosen one are compared together with the discrepancy; the others are
        compared by evidence, and are at most as probable as the least probable of the former. The log odds of a set
        over a subset are at most those that were confirmed, and those of any set are limited where no fit confirms the
        gain of its discrepancy.
        """
        excluded = (self.declined | self.withdrawn | self.replaced) - self.chosen.problem.active
        considered = {k: v for k, v in self.fitted_sets.items() if not k & excluded}
        chosen = self.fitted_sets[self.chosen.problem.active]
        if chosen.terms in self.expansions:
            for term_set in [v for v in considered.values() if v.weight > chosen.weight - CLOSE]:
                self.expansion(term_set)
        log_odds = {k: v.weight - chosen.weight for k, v in considered.items()}
        known = [terms for terms in considered if terms in self.expansions and terms != chosen.terms]
        pairs = [(terms, considered[terms]) for terms in known]
        free = log_odds | {k: -self.compute_log_odds(chosen, v) for k, v in pairs}
        for (more, fewer), known_odds in sorted(self.known_log_odds.items(), key=lambda known: len(known[0][0])):
            if fewer < more and more in free and fewer in free and more != chosen.terms:
                free[more] = min(free[more], free[fewer] + known_odds.value)
        log_odds = free | {k: min(free[k], self._limit_log_odds(v, chosen)) for k, v in pairs}
        least = min([0.0, *(log_odds[terms] for terms in known)])
        log_odds |= {k: min(h, least) for k, h in log_odds.items() if k not in self.expansions}
        log_odds |= {k: log_odds[k] + score for k, score in self.heldout_gains.items() if k in log_odds}
        top = max(log_odds.values())
        raw = {k: math.exp(height - top) for k, height in log_odds.items()}
        total = sum(raw.values())
        return {k: w / total for k, w in raw.items()}

    def _limit_log_odds(self, term_set: TermSet, over: TermSet) -> float:
        """Return the largest log odds of a set over the chosen one: a gain that no fit confirms counts up to `much`.

        It does not count for a set of less weight, nor for one with additional terms.
        """
        ahead = term_set.weight - over.weight
        if term_set.terms > over.terms:
            return ahead
        if self.discrepancy_fit(term_set) is not None:
            return math.inf
        return ahead + self.limits.much if ahead > 0.0 else ahead

    def list_close_fits(self) -> list[Fit]:
        """Return the fits of the best sets that are close to the chosen one, without that one."""
        top = self.fitted_sets[self.chosen.problem.active].weight - CLOSE
        good = [v for v in self.fitted_sets.values() if v.weight > top and v.fit is not self.chosen]
        return [v.fit for v in sorted(good, key=lambda v: -v.weight)[:BEAM]]

    def inclusion(self, key: str) -> float:
        """Return the posterior inclusion probability of a term."""
        if self.simplest:
            return self.simplest.probabilities.get(key, 0.0)
        return sum(p for terms, p in self.probabilities().items() if key in terms)

    def gain(self, key: str) -> float:
        """Return the log evidence that a term alone adds to the nominal model, or a bound from its score test."""
        alone = self.fitted_sets.get(frozenset({key}))
        if alone:
            return alone.fit.log_evidence - self.best_nominal.log_evidence
        return max((hint.gain - 5.0 for hint in self.hints if hint.key == key), default=0.0)
