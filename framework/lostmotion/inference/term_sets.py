"""The course of a selection: the sets of terms that were visited, what they are worth, and their probabilities."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from lostmotion.inference.candidates import ScoreTest
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.inference.rival import (
    CorrectedFit,
    DiscrepancyExpansion,
    correct_channels,
    expand_fit,
    fit_discrepancy,
    fit_imitation,
)
from lostmotion.settings import RivalSettings

CLOSE = 12.0
"""Sets that are so close to the best in log weight are fitted again, and kept for comparison."""
BEAM = 3
LEAST_GAIN = -10.0
"""What a discrepancy is worth at most whose promise does not come true: known values and channels that are left open
cost about so much where they explain nothing."""

MOST_ADDITIONS, WORTHWHILE = 2, 6.0
"""So often smooth forces are added to a fit with some of them, where they promise so much more log evidence."""
MOST_CORRECTIONS = 3
"""So often the channels of a recording are put right where their flaws promise much."""


@dataclass(frozen=True)
class TermSet:
    """A set of terms with its fit and its log posterior weight (log evidence plus log prior of the set)."""

    terms: frozenset[str]
    fit: Fit
    weight: float


class DiscrepancyFit(NamedTuple):
    """What smooth forces have won when they were fitted: log evidence, their log price, and what is promised `beside`.

    That rest, wrong known values and channels, is believed up to a limit. `fit` is the one with the smooth
    forces, to the recordings as they are, and `right` the one to recordings whose channels were put right.
    """

    evidence: float
    price: float
    rest: float
    fit: Fit
    corrected: CorrectedFit | None = None

    @property
    def free_values_cost(self) -> float:
        """What known values and channels that are left open cost at the most, as far as it was measured."""
        return max(LEAST_GAIN, min(self.rest, 0.0))

    def compute_gain(self, inflation: float) -> float:
        """Return the log evidence that was won, where likelihoods count by one over `worse`."""
        return self.evidence / inflation - self.price + self.rest


def _evaluate_fit(found: tuple[Fit, float] | None, fit: Fit) -> DiscrepancyFit | None:
    """Return what a fit with smooth forces has won over the one without; None where there is none."""
    if found is None or found[0].status == "diverged":
        return None
    best, price, rest = _add_smooth_forces(*found)
    right = None
    won = DiscrepancyFit(best.log_evidence - fit.log_evidence, price, _limit_gain(rest), best)
    for _ in range(MOST_CORRECTIONS):
        if not rest.compute_fixed_gain(rest.inflation) > rest.fit.problem.settings.rival.much:
            break
        right = correct_channels(rest, right)
        if right is None or right.fit.status == "diverged":
            break
        rest = expand_fit(right.fit)
        evidence = right.fit.log_evidence + right.log_jacobian - fit.log_evidence
        more = DiscrepancyFit(evidence, price + right.price, _limit_gain(rest), best, right)
        if not more.compute_gain(rest.inflation) > won.compute_gain(rest.inflation):
            break
        won = more
    return won


def _add_smooth_forces(best: Fit, price: float) -> tuple[Fit, float, DiscrepancyExpansion]:
    """Return a fit with smooth forces, and with more of them as long as these promise news and it comes true.

    With it its log price, and the expansion about it.
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
    """Return what is believed of the promise of an expansion about a fit with smooth forces: no more than a limit."""
    promised, limits = rest.predict_gain(), rest.fit.problem.settings.rival
    return min(promised if promised < limits.absurd else rest.compute_fixed_gain(rest.inflation), limits.much)


class KnownLogOdds(NamedTuple):
    """The log odds of a set over another one, and what they were worked out from."""

    basis: tuple[object, ...]
    value: float


@dataclass(frozen=True)
class SimplestTerms:
    """Terms that explain the data better than any learned curve, and no better than a generic smooth force.

    `probabilities` are those of the terms by key; `curve` is the log evidence that the best learned curve adds, zero
    where none is decisive.
    """

    probabilities: Mapping[str, float]
    curve: float


@dataclass
class Selection:
    """The course of a selection: the nominal fit, every set visited, the hints of the first round, the set chosen.

    `declined` names terms with evidence that was not believed, since what is left over has a memory. `rivals` holds the
    expansions of fits with the discrepancy that every name has to beat, `unbeaten` the terms that did not. `stopped`
    says that the search ended at its bound. `withdrawn` are terms that held-out data spoke against: no set with one of
    them is weighed. `scored` holds the log score of held-out data that sets have won over the best of what stands
    against them: it is added to their log odds. `simplest` replaces the probabilities where the chosen terms are only
    the simplest explanation.
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
    heldout_gains: dict[frozenset[str], float] = field(default_factory=dict)
    simplest: SimplestTerms | None = None
    discrepancy_fits: dict[frozenset[str], tuple[Fit, DiscrepancyFit | None]] = field(default_factory=dict)
    known_log_odds: dict[tuple[frozenset[str], frozenset[str]], KnownLogOdds] = field(default_factory=dict)
    imitations: dict[tuple[frozenset[str], frozenset[str]], tuple[Fit, Fit]] = field(default_factory=dict)

    @property
    def limits(self) -> RivalSettings:
        """What is usual on real machines."""
        return self.nominal.problem.settings.rival

    def expansion(self, term_set: TermSet) -> DiscrepancyExpansion:
        """Return the expansion of a visited set with the discrepancy; it is made once for each fit."""
        known = self.expansions.get(term_set.terms)
        if known is None or known[0] is not term_set.fit:
            self.expansions[term_set.terms] = (term_set.fit, expand_fit(term_set.fit))
        return self.expansions[term_set.terms][1]

    def compute_log_odds(self, term_set: TermSet, over: TermSet) -> float:
        """Return the log odds of a set over another one where either stands beside the discrepancy.

        What one-step errors win is divided by how much their scores scatter more than independent ones would. Where
        the other is a part of the set, it is also asked what it is worth seen from here: with a random force that
        is no larger than it has to be once the terms are in. A part is feared by all that its discrepancy promises; the
        set itself is believed by what comes true (`check`). Where both were fitted, fits are compared.
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
        """Fit the smooth forces of the discrepancy of a set where they promise much: from then on what they win counts.

        Such a fit costs as much as a hundred score tests, so it is made only of sets on which a choice depends.
        """
        if not self._has_discrepancy_fit(term_set):
            if self.expansion(term_set).find_best().gain >= self.limits.much:
                self._fit_smooth_forces(term_set)
            else:
                self.discrepancy_fits[term_set.terms] = (term_set.fit, None)

    def _fit_smooth_forces(self, term_set: TermSet) -> None:
        """Fit the discrepancy beside a set, and note what it has won."""
        self.discrepancy_fits[term_set.terms] = (
            term_set.fit,
            _evaluate_fit(fit_discrepancy(self.expansion(term_set)), term_set.fit),
        )

    def discrepancy_fit(self, term_set: TermSet) -> DiscrepancyFit | None:
        """Return what the smooth forces of a set have won when they were fitted; None where they were not."""
        return self.discrepancy_fits[term_set.terms][1] if self._has_discrepancy_fit(term_set) else None

    def settle_comparison(self, term_set: TermSet, over: TermSet, needed: float) -> None:
        """Check a set where that may decide whether it leads by as much as is needed.

        A check makes a lead smaller, but where slopes about the set turn out to mean nothing. Where the discrepancy of
        one of the two was fitted, that of the other is fitted too, however little it promises.
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

    def _fit_imitation(self, term_set: TermSet, over: TermSet) -> None:
        """Fit smooth forces in place of the terms that a set has beyond a part of it, as slopes about it say they can.

        What they win is won by the part; from then on fits alone tell how far the set is ahead of it.
        """
        known = self.discrepancy_fit(over)
        if known is None or self.discrepancy_fit(term_set) is None:
            return
        found = _evaluate_fit(fit_imitation(self.expansion(term_set), term_set.terms - over.terms), over.fit)
        if found is not None:
            self.discrepancy_fits[over.terms] = (over.fit, max(known, found, key=lambda won: won.compute_gain(1.0)))
            self.imitations[term_set.terms, over.terms] = (term_set.fit, over.fit)

    def _has_discrepancy_fit(self, term_set: TermSet) -> bool:
        return term_set.terms in self.discrepancy_fits and self.discrepancy_fits[term_set.terms][0] is term_set.fit

    def predict_smooth_gain(self) -> float:
        """Return the log evidence that smooth forces promise beside the chosen set, where its expansion is known."""
        terms = self.chosen.problem.active
        if terms not in self.expansions:
            return 0.0
        expansion = self.expansion(self.fitted_sets[terms])
        return expansion.find_best().gain - expansion.compute_fixed_gain(expansion.inflation)

    def estimate_confirmed_gain(self, term_set: TermSet, inflation: float) -> float:
        """Return the log evidence that a discrepancy adds to a set; once it is checked, no more than comes true."""
        expansion = self.expansion(term_set)
        promised, won = expansion.find_best(inflation).gain, self.discrepancy_fit(term_set)
        if won is None:
            return promised
        return min(
            promised,
            max(won.compute_gain(inflation), min(expansion.compute_fixed_gain(inflation), won.free_values_cost)),
        )

    def estimate_largest_gain(self, term_set: TermSet, inflation: float, more: frozenset[str] = frozenset()) -> float:
        """Return the log evidence that a discrepancy may add to a part of a set: promised or fitted, whichever is more.

        Where scores have a long memory what a fit wins is mostly that memory, and the promise alone counts. Of an
        absurd promise that did not come true no more than `absurd` is feared, but where it stands against `more`: terms
        that an engineer looks for last.
        """
        promised = self.expansion(term_set).find_best(inflation).gain
        won = self.discrepancy_fit(term_set) if inflation < self.limits.lasting else None
        if won is None:
            return promised
        last = any(find_term(self.chosen.problem, key)[0].unlikely > 0.0 for key in more)
        return max(promised if last else min(promised, self.limits.absurd), won.compute_gain(inflation))

    @staticmethod
    def _compare_penalties(term_set: TermSet, over: TermSet) -> float:
        """Return by how much the terms of a set cost more than those of another one."""
        return (term_set.fit.log_evidence - term_set.weight) - (over.fit.log_evidence - over.weight)

    def _evaluate_log_odds(self, term_set: TermSet, over: TermSet) -> float:
        here, inflation = self.expansion(term_set), self.expansion(term_set).inflation
        own, prices = self.estimate_confirmed_gain(term_set, inflation), self._compare_penalties(term_set, over)
        if not over.terms < term_set.terms:
            behind = (over.fit.log_evidence - term_set.fit.log_evidence) / inflation
            return own - behind - self.estimate_confirmed_gain(over, inflation) - prices
        lead, stood = self._compare_by_fits(term_set, over), self.imitations.get((term_set.terms, over.terms))
        if not self.is_expansion_valid(term_set) or (stood and stood[0] is term_set.fit and stood[1] is over.fit):
            return lead
        dropped = here.list_coordinates(term_set.terms - over.terms)
        return min(lead, own - here.predict_gain(dropped, inflation=inflation) - prices)

    def _compare_by_fits(self, term_set: TermSet, over: TermSet) -> float:
        """Return the lead of a set over a part of it by what smooth forces promise or win beside either."""
        here, inflation = self.expansion(term_set), self.expansion(term_set).inflation
        won = self.discrepancy_fit(term_set) if self.discrepancy_fit(over) and inflation < self.limits.lasting else None
        own = (
            max(won.compute_gain(inflation), min(here.compute_fixed_gain(inflation), won.free_values_cost))
            if won
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
        """Return whether slopes about a set say what happens: a body at rest answers small forces not at all.

        They do not where they promise much and nothing of it comes true.
        """
        won = self.discrepancy_fit(term_set)
        return won is None or won.evidence > 0.0 or self.expansion(term_set).find_best().gain < self.limits.absurd

    def probabilities(self) -> dict[frozenset[str], float]:
        """Return the posterior probability of each set among those visited, but for sets that were not believed.

        Sets of which the expansion is known are weighed beside the discrepancy, all others by their evidence alone: by
        that they come behind those, and weigh no more than the least of them. No set is ahead of a part of it by more
        than was confirmed.
        """
        doubted = (self.declined | self.withdrawn) - self.chosen.problem.active
        believed = {k: v for k, v in self.fitted_sets.items() if not k & doubted}
        chosen = self.fitted_sets[self.chosen.problem.active]
        log_odds = {k: v.weight - chosen.weight for k, v in believed.items()}
        known = [terms for terms in believed if terms in self.expansions and terms != chosen.terms]
        log_odds |= {terms: -self.compute_log_odds(chosen, self.fitted_sets[terms]) for terms in known}
        for (more, fewer), lead in sorted(self.known_log_odds.items(), key=lambda known: len(known[0][0])):
            if fewer < more and more in log_odds and fewer in log_odds and more != chosen.terms:
                log_odds[more] = min(log_odds[more], log_odds[fewer] + lead.value)
        least = min([0.0, *(log_odds[terms] for terms in known)])
        log_odds |= {k: min(h, least) for k, h in log_odds.items() if k not in self.expansions}
        log_odds |= {k: log_odds[k] + score for k, score in self.heldout_gains.items() if k in log_odds}
        top = max(log_odds.values())
        raw = {k: math.exp(height - top) for k, height in log_odds.items()}
        total = sum(raw.values())
        return {k: w / total for k, w in raw.items()}

    def list_close_fits(self) -> list[Fit]:
        """Return the fits of the best sets but for the chosen one, as far as they are close to it."""
        top = self.fitted_sets[self.chosen.problem.active].weight - CLOSE
        good = [v for v in self.fitted_sets.values() if v.weight > top and v.fit is not self.chosen]
        return [v.fit for v in sorted(good, key=lambda v: -v.weight)[:BEAM]]

    def inclusion(self, key: str) -> float:
        """Return the posterior probability that a term is at work."""
        if self.simplest:
            return self.simplest.probabilities.get(key, 0.0)
        return sum(p for terms, p in self.probabilities().items() if key in terms)

    def gain(self, key: str) -> float:
        """Return the log evidence that the term alone adds to the nominal model, or what its score test bounds."""
        alone = self.fitted_sets.get(frozenset({key}))
        if alone:
            return alone.fit.log_evidence - self.nominal.log_evidence
        return max((hint.gain - 5.0 for hint in self.hints if hint.key == key), default=0.0)
