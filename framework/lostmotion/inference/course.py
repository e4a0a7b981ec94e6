"""The course of a selection: the sets of terms that were visited, what they are worth, and their probabilities."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from lostmotion.inference.candidates import ScoreTest
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.inference.rival import Expansion, Righted, expanded, fitted, righted, stood_in
from lostmotion.settings import RivalSettings

CLOSE = 12.0
"""Sets that are so close to the best in log weight are fitted again, and kept for comparison."""
BEAM = 3
FLOOR = -10.0
"""What a discrepancy is worth at most whose promise does not come true: known values and channels that are left open
cost about so much where they explain nothing."""

AGAIN, NEWS = 2, 6.0
"""So often smooth forces are added to a fit with some of them, where they promise so much more log evidence."""
RIGHTED = 3
"""So often the channels of a recording are put right where their flaws promise much."""


@dataclass(frozen=True)
class Visit:
    """A set of terms with its fit and its log posterior weight (log evidence plus log prior of the set)."""

    terms: frozenset[str]
    fit: Fit
    weight: float


class Won(NamedTuple):
    """What smooth forces have won when they were fitted: log evidence, their log price, and what is promised `beside`.

    That rest, wrong known values and channels, is believed up to a limit. `fit` is the one with the smooth
    forces, to the recordings as they are, and `right` the one to recordings whose channels were put right.
    """

    evidence: float
    price: float
    beside: float
    fit: Fit
    right: Righted | None = None

    @property
    def open(self) -> float:
        """What known values and channels that are left open cost at the most, as far as it was measured."""
        return max(FLOOR, min(self.beside, 0.0))

    def over(self, worse: float) -> float:
        """Return the log evidence that was won, where likelihoods count by one over `worse`."""
        return self.evidence / worse - self.price + self.beside


def _won_by(found: tuple[Fit, float] | None, fit: Fit) -> Won | None:
    """Return what a fit with smooth forces has won over the one without; None where there is none."""
    if found is None or found[0].status == "diverged":
        return None
    best, price, rest = _settled(*found)
    right = None
    won = Won(best.log_evidence - fit.log_evidence, price, _believed(rest), best)
    for _ in range(RIGHTED):
        if not rest.bare(rest.worse) > rest.fit.problem.settings.rival.much:
            break
        right = righted(rest, right)
        if right is None or right.fit.status == "diverged":
            break
        rest = expanded(right.fit)
        evidence = right.fit.log_evidence + right.wider - fit.log_evidence
        more = Won(evidence, price + right.price, _believed(rest), best, right)
        if not more.over(rest.worse) > won.over(rest.worse):
            break
        won = more
    return won


def _settled(best: Fit, price: float) -> tuple[Fit, float, Expansion]:
    """Return a fit with smooth forces, and with more of them as long as these promise news and it comes true.

    With it its log price, and the expansion about it.
    """
    rest = expanded(best)
    for _ in range(AGAIN):
        if not rest.promise().gain - rest.bare(rest.worse) > NEWS:
            break
        more = fitted(rest)
        if more is None or more[0].status == "diverged" or more[0].log_evidence - more[1] < best.log_evidence:
            break
        best, price = more[0], price + more[1]
        rest = expanded(best)
    return best, price, rest


def _believed(rest: Expansion) -> float:
    """Return what is believed of the promise of an expansion about a fit with smooth forces: no more than a limit."""
    promised, limits = rest.gain(), rest.fit.problem.settings.rival
    return min(promised if promised < limits.absurd else rest.bare(rest.worse), limits.much)


class Lead(NamedTuple):
    """The log odds of a set over another one, and what they were worked out from."""

    basis: tuple[object, ...]
    value: float


@dataclass(frozen=True)
class Simplest:
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
    visits: dict[frozenset[str], Visit] = field(default_factory=dict)
    hints: tuple[ScoreTest, ...] = ()
    declined: set[str] = field(default_factory=set)
    rivals: dict[frozenset[str], tuple[Fit, Expansion]] = field(default_factory=dict)
    unbeaten: set[str] = field(default_factory=set)
    stopped: bool = False
    withdrawn: frozenset[str] = frozenset()
    scored: dict[frozenset[str], float] = field(default_factory=dict)
    simplest: Simplest | None = None
    smooth: dict[frozenset[str], tuple[Fit, Won | None]] = field(default_factory=dict)
    leads: dict[tuple[frozenset[str], frozenset[str]], Lead] = field(default_factory=dict)
    stood: dict[tuple[frozenset[str], frozenset[str]], tuple[Fit, Fit]] = field(default_factory=dict)

    @property
    def limits(self) -> RivalSettings:
        """What is usual on real machines."""
        return self.nominal.problem.settings.rival

    def expansion(self, visit: Visit) -> Expansion:
        """Return the expansion of a visited set with the discrepancy; it is made once for each fit."""
        known = self.rivals.get(visit.terms)
        if known is None or known[0] is not visit.fit:
            self.rivals[visit.terms] = (visit.fit, expanded(visit.fit))
        return self.rivals[visit.terms][1]

    def lead(self, visit: Visit, over: Visit) -> float:
        """Return the log odds of a set over another one where either stands beside the discrepancy.

        What one-step errors win is divided by how much their scores scatter more than independent ones would. Where
        the other is a part of the set, it is also asked what it is worth seen from here: with a random force that
        is no larger than it has to be once the terms are in. A part is feared by all that its discrepancy promises; the
        set itself is believed by what comes true (`check`). Where both were fitted, fits are compared.
        """
        if visit.terms < over.terms:
            return -self.lead(over, visit)
        basis = (
            visit.fit,
            self.won(visit),
            over.fit,
            self.won(over),
            self._is_checked(visit),
            self._is_checked(over),
        )
        known = self.leads.get((visit.terms, over.terms))
        if known is None or any(old is not new for old, new in zip(known.basis, basis, strict=True)):
            known = self.leads[visit.terms, over.terms] = Lead(basis, self._led(visit, over))
        return known.value

    def check(self, visit: Visit) -> None:
        """Fit the smooth forces of the discrepancy of a set where they promise much: from then on what they win counts.

        Such a fit costs as much as a hundred score tests, so it is made only of sets on which a choice depends.
        """
        if not self._is_checked(visit):
            if self.expansion(visit).promise().gain >= self.limits.much:
                self._fit_beside(visit)
            else:
                self.smooth[visit.terms] = (visit.fit, None)

    def _fit_beside(self, visit: Visit) -> None:
        """Fit the discrepancy beside a set, and note what it has won."""
        self.smooth[visit.terms] = (visit.fit, _won_by(fitted(self.expansion(visit)), visit.fit))

    def won(self, visit: Visit) -> Won | None:
        """Return what the smooth forces of a set have won when they were fitted; None where they were not."""
        return self.smooth[visit.terms][1] if self._is_checked(visit) else None

    def contest(self, visit: Visit, over: Visit, needed: float) -> None:
        """Check a set where that may decide whether it leads by as much as is needed.

        A check makes a lead smaller, but where slopes about the set turn out to mean nothing. Where the discrepancy of
        one of the two was fitted, that of the other is fitted too, however little it promises.
        """
        if self.lead(visit, over) > needed or self.expansion(visit).promise().gain >= self.limits.absurd:
            self.check(visit)
        bare = [v for v in (visit, over) if self.won(v) is None]
        if len(bare) == 1 and self.lead(visit, over) > needed:
            self._fit_beside(bare[0])
        if over.terms < visit.terms and self._by_fits(visit, over) > needed >= self.lead(visit, over):
            self._stand_in(visit, over)

    def _stand_in(self, visit: Visit, over: Visit) -> None:
        """Fit smooth forces in place of the terms that a set has beyond a part of it, as slopes about it say they can.

        What they win is won by the part; from then on fits alone tell how far the set is ahead of it.
        """
        known = self.won(over)
        if known is None or self.won(visit) is None:
            return
        found = _won_by(stood_in(self.expansion(visit), visit.terms - over.terms), over.fit)
        if found is not None:
            self.smooth[over.terms] = (over.fit, max(known, found, key=lambda won: won.over(1.0)))
            self.stood[visit.terms, over.terms] = (visit.fit, over.fit)

    def _is_checked(self, visit: Visit) -> bool:
        return visit.terms in self.smooth and self.smooth[visit.terms][0] is visit.fit

    def beaten(self) -> float:
        """Return the log evidence that smooth forces promise beside the chosen set, where its expansion is known."""
        terms = self.chosen.problem.active
        if terms not in self.rivals:
            return 0.0
        expansion = self.expansion(self.visits[terms])
        return expansion.promise().gain - expansion.bare(expansion.worse)

    def worth(self, visit: Visit, worse: float) -> float:
        """Return the log evidence that a discrepancy adds to a set; once it is checked, no more than comes true."""
        expansion = self.expansion(visit)
        promised, won = expansion.promise(worse).gain, self.won(visit)
        if won is None:
            return promised
        return min(promised, max(won.over(worse), min(expansion.bare(worse), won.open)))

    def feared(self, visit: Visit, worse: float, more: frozenset[str] = frozenset()) -> float:
        """Return the log evidence that a discrepancy may add to a part of a set: promised or fitted, whichever is more.

        Where scores have a long memory what a fit wins is mostly that memory, and the promise alone counts. Of an
        absurd promise that did not come true no more than `absurd` is feared, but where it stands against `more`: terms
        that an engineer looks for last.
        """
        promised = self.expansion(visit).promise(worse).gain
        won = self.won(visit) if worse < self.limits.lasting else None
        if won is None:
            return promised
        last = any(find_term(self.chosen.problem, key)[0].unlikely > 0.0 for key in more)
        return max(promised if last else min(promised, self.limits.absurd), won.over(worse))

    @staticmethod
    def _prices(visit: Visit, over: Visit) -> float:
        """Return by how much the terms of a set cost more than those of another one."""
        return (visit.fit.log_evidence - visit.weight) - (over.fit.log_evidence - over.weight)

    def _led(self, visit: Visit, over: Visit) -> float:
        here, worse = self.expansion(visit), self.expansion(visit).worse
        own, prices = self.worth(visit, worse), self._prices(visit, over)
        if not over.terms < visit.terms:
            behind = (over.fit.log_evidence - visit.fit.log_evidence) / worse
            return own - behind - self.worth(over, worse) - prices
        lead, stood = self._by_fits(visit, over), self.stood.get((visit.terms, over.terms))
        if not self.sound(visit) or (stood and stood[0] is visit.fit and stood[1] is over.fit):
            return lead
        dropped = here.coordinates_of(visit.terms - over.terms)
        return min(lead, own - here.gain(dropped, worse=worse) - prices)

    def _by_fits(self, visit: Visit, over: Visit) -> float:
        """Return the lead of a set over a part of it by what smooth forces promise or win beside either."""
        here, worse = self.expansion(visit), self.expansion(visit).worse
        won = self.won(visit) if self.won(over) and worse < self.limits.lasting else None
        own = max(won.over(worse), min(here.bare(worse), won.open)) if won else self.worth(visit, worse)
        behind = (over.fit.log_evidence - visit.fit.log_evidence) / worse
        return own - behind - self.feared(over, worse, visit.terms - over.terms) - self._prices(visit, over)

    def sound(self, visit: Visit) -> bool:
        """Return whether slopes about a set say what happens: a body at rest answers small forces not at all.

        They do not where they promise much and nothing of it comes true.
        """
        won = self.won(visit)
        return won is None or won.evidence > 0.0 or self.expansion(visit).promise().gain < self.limits.absurd

    def probabilities(self) -> dict[frozenset[str], float]:
        """Return the posterior probability of each set among those visited, but for sets that were not believed.

        Sets of which the expansion is known are weighed beside the discrepancy, all others by their evidence alone: by
        that they come behind those, and weigh no more than the least of them. No set is ahead of a part of it by more
        than was confirmed.
        """
        doubted = (self.declined | self.withdrawn) - self.chosen.problem.active
        believed = {k: v for k, v in self.visits.items() if not k & doubted}
        chosen = self.visits[self.chosen.problem.active]
        log_odds = {k: v.weight - chosen.weight for k, v in believed.items()}
        known = [terms for terms in believed if terms in self.rivals and terms != chosen.terms]
        log_odds |= {terms: -self.lead(chosen, self.visits[terms]) for terms in known}
        for (more, fewer), lead in sorted(self.leads.items(), key=lambda known: len(known[0][0])):
            if fewer < more and more in log_odds and fewer in log_odds and more != chosen.terms:
                log_odds[more] = min(log_odds[more], log_odds[fewer] + lead.value)
        least = min([0.0, *(log_odds[terms] for terms in known)])
        log_odds |= {k: min(h, least) for k, h in log_odds.items() if k not in self.rivals}
        log_odds |= {k: log_odds[k] + score for k, score in self.scored.items() if k in log_odds}
        top = max(log_odds.values())
        raw = {k: math.exp(height - top) for k, height in log_odds.items()}
        total = sum(raw.values())
        return {k: w / total for k, w in raw.items()}

    def close(self) -> list[Fit]:
        """Return the fits of the best sets but for the chosen one, as far as they are close to it."""
        top = self.visits[self.chosen.problem.active].weight - CLOSE
        good = [v for v in self.visits.values() if v.weight > top and v.fit is not self.chosen]
        return [v.fit for v in sorted(good, key=lambda v: -v.weight)[:BEAM]]

    def inclusion(self, key: str) -> float:
        """Return the posterior probability that a term is at work."""
        if self.simplest:
            return self.simplest.probabilities.get(key, 0.0)
        return sum(p for terms, p in self.probabilities().items() if key in terms)

    def gain(self, key: str) -> float:
        """Return the log evidence that the term alone adds to the nominal model, or what its score test bounds."""
        alone = self.visits.get(frozenset({key}))
        if alone:
            return alone.fit.log_evidence - self.nominal.log_evidence
        return max((hint.gain - 5.0 for hint in self.hints if hint.key == key), default=0.0)
