"""Which terms are missing: forward selection with swaps, a backward check, and probabilities over what was visited."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial

from lostmotion.inference.candidates import (
    ScoreTest,
    Shapes,
    add_term,
    compute_slopes,
    fit_term,
    guess_large_force,
    refit_with_noise,
    replace_term,
    run_score_test,
    run_score_tests,
)
from lostmotion.inference.commoner import rewrite_in_commoner_terms
from lostmotion.inference.fit import Fit, maximise, raise_random_force, restart, use_cores, use_one_core
from lostmotion.inference.late import compute_onset_price, drop_weak_onsets
from lostmotion.inference.natural import find_term
from lostmotion.inference.penalties import are_related, compute_penalty
from lostmotion.inference.random_force import has_usual_random_force
from lostmotion.inference.significance import measure_significance
from lostmotion.inference.term_sets import BEAM, CLOSE, Selection, TermSet
from lostmotion.kernels.threads import each
from lostmotion.likelihood.problem import RANDOM

MOST_FITTED, MOST_LATE = 6, 2
"""Terms fitted that act from the beginning, and that begin later: where a motion changes, many promise much then."""
CONTESTED = 4
"""So many of the heaviest sets are held against the discrepancy in each round: each costs a hundred filter runs."""
FAR = 300.0
"""Sets that are so far behind the heaviest in log weight are not held against it: they may come back as it grows."""
MOST_VISITS = 80  # a search ends after so many sets of terms, whatever is left
NEAR_GAIN = 2.5
MANY_PARAMETERS = 4
SAME = 1e-4
"""Below this share of its own information a term cannot be told from parameters that are estimated anyway."""


Progress = Callable[[str], None]
Promise = Callable[[Fit], float]
"""Tells what the best learned curve would add to the log evidence of a nominal fit."""


class Selector:
    """Carries out one selection from the `nominal` fit; `say` is told what is being tried."""

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
        self._refitted: set[frozenset[str]] = set()
        self._built_on: set[frozenset[str]] = set()
        self._rewritten: set[frozenset[str]] = set()
        self._significances: dict[frozenset[str], tuple[float, float]] = {}
        self._add_set(nominal)

    def run(self) -> Selection:
        """Return the finished selection."""
        return self._finish(lambda: self._step_forward() and not self._is_outshone())

    def resume(self, fit: Fit) -> Selection:
        """Return the selection begun at a set that was found with another noise: what stood in for that is dropped."""
        self._begin_from([fit])
        return self.run()

    def verify(self, found: Fit, rivals: Iterable[Fit]) -> Selection:
        """Return the selection among a set that was found on other recordings, sets close to it, and a term more."""
        self._begin_from([found, *rivals])
        return self._finish(self._extend_once)

    def extend(self, course: Selection, fresh: Iterable[str]) -> Selection:
        """Return a selection gone on with, now that `fresh` terms have shapes that had not been tried.

        Sets with these are forgotten, and tried anew from the nominal and from the chosen fit on.
        """
        new, chosen = set(fresh), course.chosen.problem.active
        kept = {terms: term_set for terms, term_set in course.fitted_sets.items() if terms <= chosen or not terms & new}
        self.selection = replace(course, fitted_sets=kept, hints=())
        self._fit_additions(course.nominal)
        again = {hint.key for hint in self.selection.hints}
        self.selection.hints += tuple(hint for hint in course.hints if hint.key not in again)
        return self.run()

    def _begin_from(self, fits: Iterable[Fit]) -> None:
        """Choose the best of some sets, less what it can do without, after score tests on top of the nominal fit."""
        self._run_score_tests(self.selection.nominal)
        self.selection.chosen = max((self._add_set(fit) for fit in fits), key=lambda v: v.weight).fit
        self._drop_terms()

    def _finish(self, step: Callable[[], bool]) -> Selection:
        """Return the selection after as many steps forward as lead on, and then backward."""
        while len(self.selection.chosen.problem.active) < self.limits.most_terms and step():
            pass
        self._drop_terms()
        tested = {self.selection.chosen.problem.active}
        while len(tested) <= CONTESTED and (ahead := self._find_most_probable(tested)):
            self._challenge(ahead)
            tested.add(ahead.terms)
        return self.selection

    def _find_most_probable(self, tested: set[frozenset[str]]) -> TermSet | None:
        """Return the most probable set, if that is not the chosen one, of those that were not `tested` yet."""
        shares = {terms: p for terms, p in self.selection.probabilities().items() if terms not in tested}
        best = max(shares, key=lambda terms: shares[terms], default=frozenset())
        least = self.selection.probabilities()[self.selection.chosen.problem.active]
        return self.selection.fitted_sets[best] if shares.get(best, 0.0) > least else None

    def _challenge(self, term_set: TermSet) -> None:
        """Put a set in place of the chosen one if it leads still after terms are dropped that it can do without.

        A set that is no better than a part of itself says nothing against another one.
        """
        old = self.selection.fitted_sets[self.selection.chosen.problem.active]
        self.selection.chosen = term_set.fit
        self._drop_terms()
        new = self.selection.fitted_sets[self.selection.chosen.problem.active]
        if new.terms != old.terms and not self.selection.compute_log_odds(new, old) > 0.0:
            self.selection.chosen = old.fit

    def _extend_once(self) -> bool:
        """Take the best of what one more term leads to, if it is decisive."""
        here = self.selection.fitted_sets[self.selection.chosen.problem.active]
        self._fit_additions(here.fit)
        return self._take_best(here)

    def _is_outshone(self) -> bool:
        """Return whether one learned curve wins so much more than the terms found that more of them will not do."""
        here = self.selection.fitted_sets[self.selection.chosen.problem.active]
        if self.promise is None or has_usual_random_force(here.fit):
            return False
        won = here.weight - self.selection.fitted_sets[frozenset()].weight
        if not won < self.limits.outshone * len(here.terms) * self.promise(self.selection.nominal):
            return False
        self.say("a learned curve explains far more than the terms that were found")
        return True

    def _add_set(self, fit: Fit) -> TermSet:
        """Note a fitted set in the commonest terms that say it, weighted by evidence and the prices of its terms."""
        told = rewrite_in_commoner_terms(fit := drop_weak_onsets(fit), self.candidates)
        if told is not fit:
            self._rewritten.add(fit.problem.active)
            fit = told
        terms = fit.problem.active
        price = sum(
            compute_penalty(find_term(fit.problem, key)[0], len(self.candidates), fit.problem.settings) for key in terms
        )
        price += compute_onset_price(fit.problem)
        term_set = TermSet(terms, fit, fit.log_evidence - price)
        known = self.selection.fitted_sets.get(terms)
        if known is None or term_set.weight > known.weight:
            self.selection.fitted_sets[terms] = term_set
        return self.selection.fitted_sets[terms]

    def _step_forward(self) -> bool:
        """Take the best of what additions and swaps lead to, if it is decisive."""
        if len(self.selection.fitted_sets) > MOST_VISITS:
            self.selection.stopped = True
            return False
        here = self.selection.fitted_sets[self.selection.chosen.problem.active]
        for term_set in [here] if here.terms and has_usual_random_force(here.fit) else self._list_beam(here):
            self._fit_additions(term_set.fit)
        self._fit_swaps(here.fit)
        for term_set in self._list_near_sets(here):
            self._fit_additions(term_set.fit)
        self._refit_close_sets()
        return self._take_best(here)

    def _take_best(self, here: TermSet) -> bool:
        """Take the best set visited in place of the chosen one, if it is decisively better and may be believed.

        It has to be better alone, and beside the smooth force that nobody has named. Of those that lead by about as
        much the one of most evidence is taken: a law is not exchanged for a relative with more parameters.
        """
        self._built_on.add(here.terms)
        others = [v for v in self.selection.fitted_sets.values() if v.terms not in self._built_on]
        good = sorted((v for v in others if self._is_decisive(v, here)), key=lambda v: -v.weight)[:CONTESTED]
        good = [v for v in good if v.weight > good[0].weight - FAR]
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
        log_odds = {v.terms: self.selection.compute_log_odds(v, here) for v in good}
        self.selection.tied = set()
        near = [v for v in good if log_odds[v.terms] > max(log_odds.values()) - self.limits.decisive]
        behind = [v for v in good if v not in near]
        for term_set in [*sorted(near, key=lambda v: -v.weight), *sorted(behind, key=lambda v: -log_odds[v.terms])]:
            if not log_odds[term_set.terms] > needs[term_set.terms]:
                self.selection.tied |= term_set.terms - here.terms if term_set.terms > here.terms else frozenset()
                continue
            if self._is_robust(term_set, here):
                self.selection.chosen = term_set.fit
                self.selection.declined.clear()
                self.selection.tied = set()
                return True
            self.selection.declined.update(term_set.terms - here.terms)
        return False

    def _is_decisive(self, term_set: TermSet, here: TermSet) -> bool:
        """Return whether a set has decisively more weight than the chosen one, by the evidence alone."""
        return term_set.weight > here.weight + (self.limits.decisive if term_set.terms > here.terms else 0.0)

    def _list_near_sets(self, here: TermSet) -> list[TermSet]:
        """Return the best sets of one more term, where none is decisive but some are not far from it.

        Two small effects may be decisive together where neither is alone.
        """
        more = [v for v in self.selection.fitted_sets.values() if v.terms > here.terms]
        if any(v.weight > here.weight + self.limits.decisive for v in more):
            return []
        good = [v for v in more if v.fit.log_evidence > here.fit.log_evidence + NEAR_GAIN]
        return sorted(good, key=lambda v: -v.weight)[: BEAM - 1]

    def _refit_close_sets(self) -> None:
        """Fit the best sets again from a raised random force: some of them may have stopped at a false maximum.

        One that leaves nothing over has not.
        """
        best = max(v.weight for v in self.selection.fitted_sets.values())
        close = [
            v for v in self.selection.fitted_sets.values() if v.weight > best - CLOSE and v.terms not in self._refitted
        ]
        close = [v for v in close if not has_usual_random_force(v.fit)]
        if not close:
            return
        self.say(f"again with {', '.join(' and '.join(sorted(v.terms)) or 'nothing' for v in close)}")
        self._refitted.update(v.terms for v in close)

        def again(term_set: TermSet) -> Fit:
            fit = use_one_core(term_set.fit)
            return maximise(fit.problem, raise_random_force(fit.problem, fit.theta, 6.0))

        self._add_sets(each(again, close, self.jobs))

    def _is_robust(self, term_set: TermSet, here: TermSet) -> bool:
        """Return whether a better set may be believed where something with a memory is left over.

        Then samples are not independent, and a term that resembles the leftovers always gains. So an amplitude has to
        stand out of its robust deviation; where that is more than some times the usual, the set has to take a
        share off the random force.
        """
        if term_set.terms not in self._significances:
            self._significances[term_set.terms] = measure_significance(term_set.fit)
        least, memory = self._significances[term_set.terms]
        levels = [v.fit.theta[v.fit.problem.keys.index(RANDOM)] for v in (term_set, here)]
        calm = memory < self.limits.memory or levels[0] < levels[1] + math.log(1.0 - self.limits.share)
        return least > self.limits.certain and calm

    def _list_beam(self, here: TermSet) -> list[TermSet]:
        """Return the sets to build on: the chosen one, and others of its size that explain at least half as much.

        One term can stand in for two others until both are in.
        """
        if not here.terms:
            return [here]
        bottom = self.selection.fitted_sets[frozenset()].weight
        rivals = [
            v for v in self.selection.fitted_sets.values() if len(v.terms) == len(here.terms) and v.terms != here.terms
        ]
        rivals = [v for v in rivals if v.weight - bottom > 0.5 * (here.weight - bottom)]
        return [here, *sorted(rivals, key=lambda v: -v.weight)[: BEAM - 1]]

    def _run_score_tests(self, fit: Fit) -> list[ScoreTest]:
        """Return what score tests promise of the terms on top of a fit, of rich ones where a relative promises much.

        Those on top of the nominal fit are kept, and made once.
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
        """Fit the terms whose score tests promise most on top of a fit, those first that promise most."""
        hints, single = self._run_score_tests(fit), use_one_core(fit)
        good = sorted((h for h in hints if h.gain > self.limits.promising and h.distinct > SAME), key=lambda h: -h.gain)
        good = [h for h in good if not h.late][:MOST_FITTED] + [h for h in good if h.late][:MOST_LATE]
        for size in sorted({len(h.start) for h in good}):
            group = [h for h in good if len(h.start) == size]
            self.say(f"fits with {', '.join(h.key for h in group)}")
            self._add_sets(each(partial(self._fit_hint, single, self._compute_hopeless()), group, self.jobs))
        self._fit_large_forces(fit)

    def _is_tried(self, fit: Fit, key: str) -> bool:
        """Return whether a term is in a fit already, itself or as a relative, or was tried on top of it."""
        active = fit.problem.active
        known = active | {key} in self.selection.fitted_sets or active | {key} in self._rewritten
        return key in active or any(self._are_related(fit, mine, key) for mine in active) or known

    def _add_sets(self, fits: Iterable[Fit]) -> None:
        """Note fits that were made on one core each."""
        for fit in fits:
            self._add_set(use_cores(fit, self.jobs))

    def _fit_large_forces(self, fit: Fit) -> None:
        """Fit each force as most of what a load cell has measured.

        The random force of a nominal fit follows such a recording as well, sample by sample, and score tests on top of
        that see next to nothing.
        """
        if fit.problem.active or any(observation.channel != "force" for observation in fit.problem.observations):
            return
        self.say("calm start")
        calm = refit_with_noise(fit)
        for key in self.candidates:
            hint = guess_large_force(fit.problem, key)
            if hint and calm.status != "diverged":
                self.say(f"fit with much of {key}")
                self._add_set(maximise(add_term(restart(calm), hint, hint.start)))

    def _fit_hint(self, fit: Fit, hopeless: float, hint: ScoreTest) -> Fit:
        """Return the fit with one more term, begun at the fit with a simpler relative of it where there is one."""
        for key in self.candidates:
            term_set = self.selection.fitted_sets.get(fit.problem.active | {key})
            if term_set and self._are_related(term_set.fit, key, hint.key):
                return replace_term(use_one_core(term_set.fit), key, hint, hopeless=hopeless)
        return fit_term(fit, hint, hopeless=hopeless)

    def _compute_hopeless(self) -> float:
        """Return the log posterior below which a fit cannot matter any more."""
        return max(v.fit.local.log_posterior for v in self.selection.fitted_sets.values()) - 30.0

    def _fit_swaps(self, fit: Fit) -> None:
        """Fit each relative of a term in place of it, so that one that only stands in for another gives way."""
        for key in sorted(fit.problem.active):
            known = self.selection.fitted_sets.get(fit.problem.active - {key})
            without = known.fit if known else self._add_set(maximise(fit.problem.remove_term(key, fit.values))).fit
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
                hint = run_score_test(without, slopes, other)
                if hint.gain > self.limits.promising and hint.distinct > SAME:
                    self._add_set(fit_term(without, hint, hopeless=self._compute_hopeless()))

    def _drop_terms(self) -> None:
        """Drop terms until none is left without which the set has more weight."""
        while self._drop_one_term():
            pass

    def _drop_one_term(self) -> bool:
        """Drop a term without which the set has more weight."""
        chosen = self.selection.chosen
        here = self.selection.fitted_sets[chosen.problem.active]
        for key in sorted(chosen.problem.active):
            terms = chosen.problem.active - {key}
            self.say(f"without {key}")
            term_set = self.selection.fitted_sets.get(terms) or self._add_set(
                maximise(chosen.problem.remove_term(key, chosen.values))
            )
            self.selection.fit_discrepancy(term_set)
            self.selection.settle_comparison(here, term_set, self.limits.decisive)
            told = here.weight > term_set.weight + self.limits.decisive
            if not told or not self.selection.compute_log_odds(here, term_set) > self.limits.decisive:
                self.selection.tied |= {key} if told else set()
                self.selection.chosen = term_set.fit
                return True
        return False

    @staticmethod
    def _has_many_parameters(fit: Fit, key: str) -> bool:
        """Return whether a term has so many parameters that it is tried only where a simpler relative promises much."""
        return len(find_term(fit.problem, key)[1]) >= MANY_PARAMETERS

    @staticmethod
    def _are_related(fit: Fit, mine: str, other: str) -> bool:
        return are_related(find_term(fit.problem, mine)[0], find_term(fit.problem, other)[0])
