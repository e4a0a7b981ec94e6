"""Selection of the missing terms: forward selection with swaps, backward elimination, and posterior probabilities."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial

from lostmotion.inference.beam import list_beam, list_near_sets
from lostmotion.inference.candidates import (
    ScoreTest,
    Shapes,
    compute_slopes,
    fit_term,
    refit_with_noise,
    replace_term,
    run_score_test,
    run_score_tests,
)
from lostmotion.inference.commoner import rewrite_in_commoner_terms
from lostmotion.inference.fit import HOPELESS, Fit, use_cores, use_one_core
from lostmotion.inference.large_forces import fit_large_force, guess_large_force
from lostmotion.inference.late import drop_weak_onsets
from lostmotion.inference.natural import find_term
from lostmotion.inference.other_shapes import compute_complete_gain, refit_choices, refit_shapes
from lostmotion.inference.penalties import are_related, compute_price
from lostmotion.inference.random_force import has_usual_random_force
from lostmotion.inference.refits import Refits, refit_from, refit_with_terms, refit_without
from lostmotion.inference.robustness import RobustChecks
from lostmotion.inference.term_sets import CLOSE, Selection, TermSet
from lostmotion.kernels.threads import each

MOST_FITTED, MOST_LATE = 6, 2
"""The numbers of terms without and with an onset that are fitted in a round. If the motion changes, many terms with an
onset predict a large gain."""
MOST_SIMPLE, MOST_FIRST, SHARE = 3, 6, 0.5
"""So many more terms are fitted that predict this share of the largest gain: those with one parameter, and beside the
nominal model any. A test far from the maximum ranks some laws too high."""
MOST_COMPARED = 4
"""The number of sets of largest weight that are compared with the discrepancy in each round: each costs a hundred
runs of the filter."""
FAR_BEHIND = 300.0
"""Sets whose log weight is lower than the largest by more than this are not compared with the discrepancy in this
round."""
MOST_SETS = 80
"""A search ends after this number of sets of terms."""
MANY_PARAMETERS = 4
"""A term with at least this number of parameters is tested only if a related, simpler term predicts a large gain."""
LEAST_DISTINCT = 1e-4
"""A term is not distinguishable from the free parameters if less than this share of its information remains."""


Progress = Callable[[str], None]
Promise = Callable[[Fit], float]
"""Predicts the log evidence that the best learned curve adds to a nominal fit."""


class Selector:
    """Carries out one selection, starting from the `nominal` fit; `say` receives messages on its progress."""

    def __init__(
        self,
        nominal: Fit,
        candidates: Iterable[str],
        say: Progress,
        shapes: Shapes | None = None,
        promise: Promise | None = None,
    ) -> None:
        self.candidates = tuple(candidates)
        self.say, self.shapes, self.jobs, self.promise = say, shapes or {}, nominal.problem.jobs, promise
        self.limits = nominal.problem.settings.select
        self.selection = Selection(nominal, nominal)
        self._refits = Refits()
        self._built_on: set[frozenset[str]] = set()
        self._rewritten: set[frozenset[str]] = set()
        self._checks = RobustChecks(self.limits)
        self._add_set(nominal)

    def run(self) -> Selection:
        """Return the finished selection."""
        return self._finish(lambda: self._step_forward() and not self._is_outshone())

    def resume(self, fit: Fit) -> Selection:
        """Return the selection that starts from a set found with another noise model; unnecessary terms are dropped."""
        self._begin_from([fit])
        return self.run()

    def verify(self, found: Fit, rivals: Iterable[Fit]) -> Selection:
        """Return the selection among a set found on shorter recordings, sets close to it, and further terms."""
        self._begin_from([found, *rivals])
        return self._finish(self._extend_once)

    def extend(self, earlier: Selection, fresh: Iterable[str]) -> Selection:
        """Return a selection that is continued, because `fresh` terms have new shapes to try.

        Sets with these terms are removed, and fitted again starting from the nominal and from the chosen fit.
        """
        new, chosen = set(fresh), earlier.chosen.problem.active
        kept = {
            terms: term_set for terms, term_set in earlier.fitted_sets.items() if terms <= chosen or not terms & new
        }
        self.selection = replace(earlier, fitted_sets=kept, hints=())
        self._fit_additions(earlier.nominal)
        again = {hint.key for hint in self.selection.hints}
        self.selection.hints += tuple(hint for hint in earlier.hints if hint.key not in again)
        return self.run()

    def _begin_from(self, fits: Iterable[Fit]) -> None:
        """Choose the best of some sets, without unnecessary terms, after score tests at the nominal fit."""
        self._run_score_tests(self.selection.nominal)
        self.selection.chosen = max((self._add_set(fit) for fit in fits), key=lambda v: v.weight).fit
        self._drop_terms()

    def _finish(self, step: Callable[[], bool]) -> Selection:
        """Return the selection after all forward steps, backward elimination and final comparisons."""
        while len(self.selection.chosen.problem.active) < self.limits.most_terms and step():
            pass
        self._drop_terms()
        tested = {self.selection.chosen.problem.active}
        while len(tested) <= MOST_COMPARED and (ahead := self._find_most_probable(tested)):
            self._challenge(ahead)
            tested.add(ahead.terms)
        return self.selection

    def _find_most_probable(self, tested: set[frozenset[str]]) -> TermSet | None:
        """Return the most probable set that was not yet `tested`, if it is more probable than the chosen one."""
        shares = {terms: p for terms, p in self.selection.probabilities().items() if terms not in tested}
        best = max(shares, key=lambda terms: shares[terms], default=frozenset())
        least = self.selection.probabilities()[self.selection.chosen.problem.active]
        return self.selection.fitted_sets[best] if shares.get(best, 0.0) > least else None

    def _challenge(self, term_set: TermSet) -> None:
        """Replace the chosen set by another one if that is more probable after backward elimination.

        A set that is no better than one of its subsets is no argument against the chosen set.
        """
        old = self.selection.fitted_sets[self.selection.chosen.problem.active]
        self.selection.chosen = term_set.fit
        self._drop_terms()
        new = self.selection.fitted_sets[self.selection.chosen.problem.active]
        if new.terms != old.terms and not self.selection.compute_log_odds(new, old) > 0.0:
            self.selection.chosen = old.fit

    def _extend_once(self) -> bool:
        """Take the best set with one more term, if it is decisive."""
        here = self.selection.fitted_sets[self.selection.chosen.problem.active]
        self._fit_additions(here.fit)
        return self._take_best(here)

    def _is_outshone(self) -> bool:
        """Return whether one learned curve predicts far more evidence than the found terms, which only imitate it."""
        here = self.selection.fitted_sets[self.selection.chosen.problem.active]
        if self.promise is None or has_usual_random_force(here.fit):
            return False
        gain = here.weight - self.selection.fitted_sets[frozenset()].weight
        if not gain < self.limits.outshone * len(here.terms) * self.promise(self.selection.nominal):
            return False
        self.say("a learned curve explains far more than the terms that were found")
        return True

    def _add_set(self, fit: Fit) -> TermSet:
        """Store a fitted set, in the most common equivalent terms, weighted by log evidence less prior penalties."""
        rewritten = rewrite_in_commoner_terms(fit := drop_weak_onsets(fit), self.candidates)
        if rewritten is not fit:
            self._rewritten.add(fit.problem.active)
            fit = rewritten
        terms, weight = fit.problem.active, fit.log_evidence - compute_price(fit.problem, len(self.candidates))
        if weight > max((v.weight for v in self.selection.fitted_sets.values()), default=weight) - CLOSE:
            weight += compute_complete_gain(fit)
        term_set = TermSet(terms, fit, weight)
        known = self.selection.fitted_sets.get(terms)
        if known is None or term_set.weight > known.weight:
            self.selection.fitted_sets[terms] = term_set
        return self.selection.fitted_sets[terms]

    def _step_forward(self) -> bool:
        """Take the best set after additions and swaps, if it is decisive."""
        if len(self.selection.fitted_sets) > MOST_SETS:
            self.selection.stopped = True
            return False
        here = self.selection.fitted_sets[self.selection.chosen.problem.active]
        for term_set in [here] if here.terms and has_usual_random_force(here.fit) else list_beam(self.selection, here):
            self._fit_additions(term_set.fit)
        self._fit_swaps(here.fit)
        for term_set in list_near_sets(self.selection, here):
            self._fit_additions(term_set.fit)
        self._refit_close_sets()
        return self._take_best(self.selection.fitted_sets[here.terms])

    def _take_best(self, here: TermSet) -> bool:
        """Replace the chosen set by the best fitted set, if that is decisively better and robust.

        It must be better by evidence, and when both sets are compared with the generic smooth force. Among sets with
        nearly equal log odds, the one with the largest weight is taken: a term is not replaced by a related one with
        more parameters.
        """
        self._built_on.add(here.terms)
        others = [v for v in self.selection.fitted_sets.values() if v.terms not in self._built_on]
        good = sorted((v for v in others if self._is_decisive(v, here)), key=lambda v: -v.weight)[:MOST_COMPARED]
        good = [v for v in good if v.weight > good[0].weight - FAR_BEHIND]
        same = [v for v in others if v.terms in self.selection.discrepancy_fits and len(v.terms) == len(here.terms)]
        good += [v for v in same if v not in good]
        if good:
            self.selection.fit_discrepancy(here)
        needs = {
            v.terms: self.limits.decisive if v.terms > here.terms or not self._is_decisive(v, here) else 0.0
            for v in good
        }
        for term_set in good:
            self.selection.settle_comparison(term_set, here, needs[term_set.terms])
        for term_set in good[1:]:
            self.selection.confirm_lead(term_set, good[0])
        log_odds = {v.terms: self.selection.compute_log_odds(v, here) for v in good}
        self.selection.tied = set()
        near = [v for v in good if log_odds[v.terms] > max(log_odds.values()) - self.limits.decisive]
        behind = [v for v in good if v not in near]
        for term_set in [*sorted(near, key=lambda v: -v.weight), *sorted(behind, key=lambda v: -log_odds[v.terms])]:
            better = log_odds[term_set.terms] > needs[term_set.terms]
            sound = better and self._checks.is_robust(term_set, here)
            if (taken := term_set if sound else self._drop_vague_term(term_set, here)) is not None:
                self.selection.chosen = taken.fit
                self.selection.declined.clear()
                self.selection.tied = set()
                return True
            if better:
                self.selection.declined.update(term_set.terms - here.terms)
            elif term_set.terms > here.terms:
                self.selection.tied |= term_set.terms - here.terms
        return False

    def _drop_vague_term(self, term_set: TermSet, here: TermSet) -> TermSet | None:
        """Return a set without the chosen term that its further terms make most vague; None if that is no better.

        The further terms may be what the chosen one only imitated: a damping that differs by direction looks like a
        constant force. Both together may be no better than a smooth force, because the vague one has its penalty too.
        """
        vague = [key for key in self._checks.list_vague(term_set) if key in here.terms]
        if not vague or term_set.terms - {vague[0]} in self._built_on:
            return None
        less = self._get_without(term_set.fit, vague[0])
        self.selection.settle_comparison(less, here, 0.0)
        better = less.weight > here.weight and self.selection.compute_log_odds(less, here) > 0.0
        return less if better and self._checks.is_robust(less, here) else None

    def _get_without(self, fit: Fit, key: str) -> TermSet:
        """Return the set of a fit without a term, fitted if it was not yet."""
        known = self.selection.fitted_sets.get(fit.problem.active - {key})
        return known or self._add_set(refit_without(fit, key))

    def _is_decisive(self, term_set: TermSet, here: TermSet) -> bool:
        """Return whether a set has decisively more weight than the chosen one, without the discrepancy."""
        return term_set.weight > here.weight + (self.limits.decisive if term_set.terms > here.terms else 0.0)

    def _refit_close_sets(self) -> None:
        """Refit the best sets, and from the best one its subsets and sets with another noise: some are local maxima."""
        if close := self._refits.take_close(self.selection):
            self.say(f"refits with {', '.join(' and '.join(sorted(v.terms)) or 'no term' for v in close)}")
            self._add_sets(each(lambda v: refit_with_terms(v.fit), close, self.jobs))
        best = max(self.selection.fitted_sets.values(), key=lambda v: v.weight)
        if far := self._refits.take_far(self.selection, best) + self._refits.take_subsets(self.selection, best):
            self.say(f"refits from the fit with {' and '.join(sorted(best.terms)) or 'no term'}")
            self._add_sets(each(lambda v: refit_from(v.fit, best.fit), far, self.jobs))
        for term_set in self._refits.take_shaped(self.selection):
            self.say(f"refits with other shapes of {' and '.join(sorted(term_set.terms))}")
            self._add_set(use_cores(refit_shapes(term_set.fit), self.jobs))

    def _run_score_tests(self, fit: Fit) -> list[ScoreTest]:
        """Return the score tests of all terms at a fit; terms with many parameters only if a related one is promising.

        Those at the nominal fit are computed once and stored.
        """
        if self.selection.hints and not fit.problem.active:
            return [h for h in self.selection.hints if not self._is_tried(fit, h.key)]
        slopes, single = compute_slopes(fit), use_one_core(fit)
        hints: list[ScoreTest] = []
        untried = [k for k in self.candidates if not self._is_tried(fit, k)]
        for rich in (False, True):
            keys = [key for key in untried if self._has_many_parameters(fit, key) == rich]
            if rich:
                promising = [h.key for h in hints if h.gain > self.limits.promising]
                keys = [key for key in keys if any(self._are_related(fit, key, other) for other in promising)]
            if keys:
                self.say(f"score tests of {', '.join(keys)}")
            found = each(lambda key: run_score_tests(single, slopes, key, self.shapes.get(key, ())), keys, self.jobs)
            hints += [hint for of_key in found for hint in of_key]
        if not fit.problem.active:
            self.selection.hints = tuple(hints)
        return hints

    def _fit_additions(self, fit: Fit) -> None:
        """Fit the terms with the largest predicted gains by score tests at a fit."""
        hints, single = self._run_score_tests(fit), use_one_core(fit)
        good = sorted(
            (h for h in hints if h.gain > self.limits.promising and h.distinct > LEAST_DISTINCT), key=lambda h: -h.gain
        )
        soon, late = [h for h in good if not h.late], [h for h in good if h.late]
        more = [h for h in soon[MOST_FITTED:] if h.gain > SHARE * soon[0].gain]
        more = [h for h in more if len(h.start) == 1][:MOST_SIMPLE] if fit.problem.active else more[:MOST_FIRST]
        good = soon[:MOST_FITTED] + more + late[:MOST_LATE]
        for size in sorted({len(h.start) for h in good}):
            group = [h for h in good if len(h.start) == size]
            self.say(f"fits with {', '.join(h.key for h in group)}")
            self._add_sets(each(partial(self._fit_hint, single, self._compute_hopeless()), group, self.jobs))
        self._fit_large_forces(fit)

    def _is_tried(self, fit: Fit, key: str) -> bool:
        """Return whether a fit has a term or a related one, or was already extended by it."""
        active = fit.problem.active
        known = active | {key} in self.selection.fitted_sets or active | {key} in self._rewritten
        return key in active or any(self._are_related(fit, mine, key) for mine in active) or known

    def _add_sets(self, fits: Iterable[Fit]) -> None:
        """Store fits that were made on one core each."""
        for fit in fits:
            self._add_set(use_cores(fit, self.jobs))

    def _fit_large_forces(self, fit: Fit) -> None:
        """Fit each force as the main part of the readings of a load cell.

        The random force of a nominal fit follows such a recording sample by sample, so score tests at this fit are
        nearly blind.
        """
        if fit.problem.active or any(observation.channel != "force" for observation in fit.problem.observations):
            return
        self.say("fit with a small random force")
        calm = refit_with_noise(fit)
        for key in self.candidates:
            hint = guess_large_force(fit.problem, key)
            if hint and calm.status != "diverged":
                self.say(f"fit with a large {key}")
                self._add_set(fit_large_force(fit, calm, hint))

    def _fit_hint(self, fit: Fit, hopeless: float, hint: ScoreTest) -> Fit:
        """Return the fit with one more term, starting from the fit with a simpler related term if there is one."""
        for key in self.candidates:
            term_set = self.selection.fitted_sets.get(fit.problem.active | {key})
            if term_set and self._are_related(term_set.fit, key, hint.key):
                return replace_term(use_one_core(term_set.fit), key, hint, hopeless=hopeless)
        return refit_choices(fit_term(fit, hint, hopeless=hopeless), {hint.key})

    def _compute_hopeless(self) -> float:
        """Return the log posterior below which a fit is abandoned."""
        return max(v.fit.local.log_posterior for v in self.selection.fitted_sets.values()) - HOPELESS

    def _fit_swaps(self, fit: Fit) -> None:
        """Fit each related term in place of an active one (swap), because a term may only imitate a related one."""
        for key in sorted(fit.problem.active):
            without = self._get_without(fit, key).fit
            slopes = compute_slopes(without)
            for other in self.candidates:
                terms = without.problem.active | {other}
                if (
                    other in fit.problem.active
                    or terms in self.selection.fitted_sets
                    or not self._are_related(fit, key, other)
                ):
                    continue
                self.say(f"{other} in place of {key}")
                hint = run_score_test(without, slopes, other, self.shapes.get(other, ()))
                if hint.gain > self.limits.promising and hint.distinct > LEAST_DISTINCT:
                    self._add_set(fit_term(without, hint, hopeless=self._compute_hopeless()))

    def _drop_terms(self) -> None:
        """Drop terms until each remaining term is decisive (backward elimination)."""
        while self._drop_one_term():
            pass

    def _drop_one_term(self) -> bool:
        """Drop one term that is not decisive, and return whether there was one."""
        chosen = self.selection.chosen
        here = self.selection.fitted_sets[chosen.problem.active]
        for key in sorted(chosen.problem.active):
            self.say(f"without {key}")
            term_set = self._get_without(chosen, key)
            if (refitted := self._refits.refit_subset(term_set)) is not None:
                term_set = self._add_set(refitted)
            self.selection.fit_discrepancy(term_set)
            self.selection.settle_comparison(here, term_set, self.limits.decisive)
            decisive = here.weight > term_set.weight + self.limits.decisive
            if not decisive or not self.selection.compute_log_odds(here, term_set) > self.limits.decisive:
                self.selection.tied |= {key} if decisive else set()
                self.selection.chosen = term_set.fit
                return True
            if not self._checks.is_robust(here, term_set, [key]):
                self.selection.declined.add(key)
                self.selection.chosen = term_set.fit
                return True
        return False

    @staticmethod
    def _has_many_parameters(fit: Fit, key: str) -> bool:
        """Return whether a term has so many parameters that it is tested only if a related one is promising."""
        return len(find_term(fit.problem, key)[1]) >= MANY_PARAMETERS

    @staticmethod
    def _are_related(fit: Fit, mine: str, other: str) -> bool:
        return are_related(find_term(fit.problem, mine)[0], find_term(fit.problem, other)[0])
