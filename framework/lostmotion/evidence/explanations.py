"""What a search has found: every hypothesis with its probability, and the fits without discrepancy.

The probability of a set of terms is the softmax of the scores; that of a term is the sum over the sets that have it.
Differences of scores are divided by one temper: the scatter of the scores of the best hypothesis beyond their
information, 1 where the model is right.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy.special import softmax

from lostmotion.contracts import Array
from lostmotion.evidence.bare import Terms
from lostmotion.evidence.hypothesis import UNKNOWN, Hypothesis
from lostmotion.evidence.posterior_draws import draw_own
from lostmotion.evidence.probabilities import compute_probabilities, measure_temper
from lostmotion.evidence.search import ExplanationSearch
from lostmotion.inference.curves import drop_all_curves
from lostmotion.inference.fit import Fit

TIED = math.log(20.0)
"""Two laws are not distinguished where the expected log likelihood ratio of one to the other is less than this."""
LEAST = 1e-3
"""Parameters are averaged over the hypotheses with at least this probability."""


@dataclass(frozen=True)
class Explanations:
    """The hypotheses of a diagnosis; `fits` are those of their terms alone, in the system of the case.

    Sets in `refuted` have no probability, because free runs over held-out data are worse with them. Those in `nested`
    give theirs to another set with a simpler law, from which the data do not tell theirs. `skipped` names the
    sets that were not extended for lack of time, `promised` has the log evidence that the slopes of each term promise.
    """

    fits: Mapping[Terms, Fit]
    found: Mapping[Terms, Hypothesis]
    refuted: frozenset[Terms] = frozenset()
    nested: Mapping[Terms, Terms] = field(default_factory=dict)
    skipped: tuple[str, ...] = ()
    promised: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, search: ExplanationSearch) -> Explanations:
        """Return the explanations that a search has found."""
        fits = {terms: drop_all_curves(fit, search.bare.plain) for terms, fit in search.bare.fits.items()}
        return cls(fits, dict(search.found), skipped=tuple(search.skipped), promised=search.bare.promised)

    @property
    def nominal(self) -> Fit:
        """The fit of the model without any term."""
        return self.fits[frozenset()]

    @cached_property
    def probabilities(self) -> Mapping[Terms, float]:
        """The posterior probability of each set."""
        allowed = [one for terms, one in self.found.items() if terms - {UNKNOWN} not in self.refuted]
        temper = measure_temper(allowed)
        shares = _share_ties(allowed, compute_probabilities(allowed, temper), temper)
        for rich, simple in self.nested.items():
            shares[simple] += shares[rich]
            shares[rich] = 0.0
        return shares

    @property
    def best(self) -> Hypothesis:
        """The most probable hypothesis."""
        return self.found[max(self.probabilities, key=lambda terms: self.probabilities[terms])]

    @property
    def terms(self) -> Terms:
        """The terms of the most probable hypothesis, without an unknown force."""
        return self.best.terms - {UNKNOWN}

    @property
    def chosen(self) -> Fit:
        """The fit of these terms."""
        return self.fits[self.terms]

    def inclusion(self, key: str) -> float:
        """Return the posterior probability of a term, or of `UNKNOWN`."""
        return min(sum(p for terms, p in self.probabilities.items() if key in terms), 1.0)

    def gain(self, key: str) -> float:
        """Return the log evidence that a term alone adds beside a discrepancy, or what its slopes promise."""
        alone = self.found.get(frozenset({key}))
        nothing = self.found[frozenset()]
        return (
            alone.log_evidence + alone.heldout - nothing.log_evidence - nothing.heldout
            if alone
            else self.promised.get(key, 0.0)
        )

    def gain_beside(self, key: str) -> float:
        """Return the score that a term of the best hypothesis adds to its other terms."""
        less = self.found.get(self.best.terms - {key})
        return self.best.score() - less.score() if less else self.gain(key)

    def is_close(self, terms: Terms, reach: float) -> bool:
        """Return whether a set was weighed, was not refuted, and has a score within `reach` of that of the best one."""
        if terms not in self.probabilities:
            return False
        temper = measure_temper(self.found.values())
        return self.found[terms].score(temper) > self.best.score(temper) - reach

    def simplify(self, simple: Terms) -> Explanations:
        """Return the explanations in which the most probable set gives its probability to one with a simpler law."""
        return replace(self, nested={**self.nested, self.best.terms: simple})

    def refute(self) -> Explanations:
        """Return the explanations without the most probable set of terms; without any, no curves are learned."""
        return replace(self, refuted=self.refuted | {self.terms if self.best.terms else frozenset({UNKNOWN})})

    def draw(self, keys: list[str], count: int, rng: np.random.Generator) -> Array:
        """Return draws (count, keys) of parameters of the chosen fit, averaged over all hypotheses by probability.

        A parameter that a hypothesis lacks is drawn from the best one (Hoeting et al., Statistical Science 14 (1999)
        382-417).
        """
        first, parts = self.best, [one for one in self.found if self.probabilities.get(one, 0.0) > LEAST]
        weights = np.array([self.probabilities[one] for one in parts])
        which = rng.choice(len(parts), size=count, p=weights / weights.sum())
        made = _draw(first, keys, count, rng)
        for number, terms in enumerate(parts):
            if self.found[terms] is not first:
                rows = np.flatnonzero(which == number)
                own = _draw(self.found[terms], keys, len(rows), rng)
                made[rows] = np.where(np.isfinite(own), own, made[rows])
        return made


def _share_ties(found: Sequence[Hypothesis], shares: dict[Terms, float], temper: float) -> dict[Terms, float]:
    """Return probabilities in which laws that predict the same readings are not told apart by the widths of priors.

    They have as many parameters, and one is in place of the other in the same set. They share theirs by their prior
    odds and by what they ask of the discrepancy: a law that predicts the same only beside a larger smooth force is less
    probable.
    """
    for best in sorted(found, key=lambda one: -one.score()):
        group = [one for one in found if one is best or _is_tied(best, one)]
        if len(group) > 1:
            weights = softmax([one.log_profile / temper - one.price for one in group])
            total = sum(shares[one.terms] for one in group)
            shares |= {one.terms: total * float(w) for one, w in zip(group, weights, strict=True)}
            break
    return shares


def _is_tied(best: Hypothesis, other: Hypothesis) -> bool:
    """Return whether a hypothesis has one other law than the best one, and predicts the same readings."""
    mine, its = best.terms - other.terms, other.terms - best.terms
    if len(mine) != 1 or len(its) != 1 or UNKNOWN in mine | its or best.frame.own != other.frame.own:
        return False
    return compute_expected_ratio(best, other) < TIED


def compute_expected_ratio(one: Hypothesis, other: Hypothesis) -> float:
    """Return the log likelihood ratio of the fitted data that is expected if a hypothesis is true and not the other.

    With the difference d of their one-step predictions and the variance S of the errors it is the sum of d^2 / (2 S)
    (the Kullback-Leibler divergence of normal densities with one variance), over the temper.
    """
    here, there = one.expansion.here, other.expansion.here
    apart = (here.errors - there.errors) ** 2 / here.variances
    return 0.5 * float(np.nansum(apart)) / one.scatter


def _draw(found: Hypothesis, keys: list[str], count: int, rng: np.random.Generator) -> Array:
    """Return draws (count, keys) of parameters from the posterior of one hypothesis; NaN where it lacks one."""
    free = found.frame.posterior.space.free[: found.frame.own]
    places = {f.key: i for i, f in enumerate(free) if f.physical}
    theta = draw_own(found, count, rng)
    made = np.full((count, len(keys)), np.nan)
    for column, key in enumerate(keys):
        if key in places:
            f = free[places[key]]
            made[:, column] = [f.value(at) for at in theta[:, places[key]]]
        elif key.rpartition(".")[0] in found.frame.terms:
            held = found.frame.posterior.known[found.frame.posterior.system.index[key]]
            made[:, column] = held or math.nan  # a complete law; at zero the amplitude is absent
    return made
