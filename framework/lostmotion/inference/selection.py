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
from lostmotion.inference.course import BEAM, CLOSE, Selection, Visit
from lostmotion.inference.fit import Fit, maximise, raise_random_force, restart, use_cores, use_one_core
from lostmotion.inference.late import compute_onset_price, drop_weak_onsets
from lostmotion.inference.leftovers import quiet
from lostmotion.inference.natural import find_term
from lostmotion.inference.prices import price_of, related
from lostmotion.inference.standing import standing
from lostmotion.kernels.threads import each
from lostmotion.likelihood.problem import RANDOM

MOST_FITTED, MOST_LATE = 6, 2
"""Terms fitted that act from the beginning, and that begin later: where a motion changes, many promise much then."""
CONTESTED = 4
"""So many of the heaviest sets are held against the discrepancy in each round: each costs a hundred filter runs."""
FAR = 300.0
"""Sets that are so far behind the heaviest in log weight are not held against it: they may come back as it grows."""
MOST_VISITS = 80  # a search ends after so many sets of terms, whatever is left
NEARLY = 2.5
RICH = 4
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
        self.course = Selection(nominal, nominal)
        self._settled: set[frozenset[str]] = set()
        self._been: set[frozenset[str]] = set()
        self._retold: set[frozenset[str]] = set()
        self._sure: dict[frozenset[str], tuple[float, float]] = {}
        self._visit(nominal)

    def run(self) -> Selection:
        """Return the finished selection."""
        return self._finished(lambda: self._forward() and not self._outshone())

    def resumed(self, fit: Fit) -> Selection:
        """Return the selection begun at a set that was found with another noise: what stood in for that is dropped."""
        self._begun([fit])
        return self.run()

    def verified(self, found: Fit, rivals: Iterable[Fit]) -> Selection:
        """Return the selection among a set that was found on other recordings, sets close to it, and a term more."""
        self._begun([found, *rivals])
        return self._finished(self._extended)

    def further(self, course: Selection, fresh: Iterable[str]) -> Selection:
        """Return a selection gone on with, now that `fresh` terms have shapes that had not been tried.

        Sets with these are forgotten, and tried anew from the nominal and from the chosen fit on.
        """
        new, chosen = set(fresh), course.chosen.problem.active
        kept = {terms: visit for terms, visit in course.visits.items() if terms <= chosen or not terms & new}
        self.course = replace(course, visits=kept, hints=())
        self._additions(course.nominal)
        again = {hint.key for hint in self.course.hints}
        self.course.hints += tuple(hint for hint in course.hints if hint.key not in again)
        return self.run()

    def _begun(self, fits: Iterable[Fit]) -> None:
        """Choose the best of some sets, less what it can do without, after score tests on top of the nominal fit."""
        self._screened(self.course.nominal)
        self.course.chosen = max((self._visit(fit) for fit in fits), key=lambda v: v.weight).fit
        self._shrink()

    def _finished(self, step: Callable[[], bool]) -> Selection:
        """Return the selection after as many steps forward as lead on, and then backward."""
        while len(self.course.chosen.problem.active) < self.limits.most_terms and step():
            pass
        self._shrink()
        tested = {self.course.chosen.problem.active}
        while len(tested) <= CONTESTED and (ahead := self._ahead(tested)):
            self._challenge(ahead)
            tested.add(ahead.terms)
        return self.course

    def _ahead(self, tested: set[frozenset[str]]) -> Visit | None:
        """Return the most probable set, if that is not the chosen one, of those that were not `tested` yet."""
        shares = {terms: p for terms, p in self.course.probabilities().items() if terms not in tested}
        best = max(shares, key=lambda terms: shares[terms], default=frozenset())
        least = self.course.probabilities()[self.course.chosen.problem.active]
        return self.course.visits[best] if shares.get(best, 0.0) > least else None

    def _challenge(self, visit: Visit) -> None:
        """Put a set in place of the chosen one if it leads still after terms are dropped that it can do without.

        A set that is no better than a part of itself says nothing against another one.
        """
        old = self.course.visits[self.course.chosen.problem.active]
        self.course.chosen = visit.fit
        self._shrink()
        new = self.course.visits[self.course.chosen.problem.active]
        if new.terms != old.terms and not self.course.lead(new, old) > 0.0:
            self.course.chosen = old.fit

    def _extended(self) -> bool:
        """Take the best of what one more term leads to, if it is decisive."""
        here = self.course.visits[self.course.chosen.problem.active]
        self._additions(here.fit)
        return self._better(here)

    def _outshone(self) -> bool:
        """Return whether one learned curve wins so much more than the terms found that more of them will not do."""
        here = self.course.visits[self.course.chosen.problem.active]
        if self.promise is None or quiet(here.fit):
            return False
        won = here.weight - self.course.visits[frozenset()].weight
        if not won < self.limits.outshone * len(here.terms) * self.promise(self.course.nominal):
            return False
        self.say("a learned curve explains far more than the terms that were found")
        return True

    def _visit(self, fit: Fit) -> Visit:
        """Note a fitted set in the commonest terms that say it, weighted by evidence and the prices of its terms."""
        told = rewrite_in_commoner_terms(fit := drop_weak_onsets(fit), self.candidates)
        if told is not fit:
            self._retold.add(fit.problem.active)
            fit = told
        terms = fit.problem.active
        price = sum(
            price_of(find_term(fit.problem, key)[0], len(self.candidates), fit.problem.settings) for key in terms
        )
        price += compute_onset_price(fit.problem)
        visit = Visit(terms, fit, fit.log_evidence - price)
        known = self.course.visits.get(terms)
        if known is None or visit.weight > known.weight:
            self.course.visits[terms] = visit
        return self.course.visits[terms]

    def _forward(self) -> bool:
        """Take the best of what additions and swaps lead to, if it is decisive."""
        if len(self.course.visits) > MOST_VISITS:
            self.course.stopped = True
            return False
        here = self.course.visits[self.course.chosen.problem.active]
        for visit in [here] if here.terms and quiet(here.fit) else self._beam(here):
            self._additions(visit.fit)
        self._swaps(here.fit)
        for visit in self._nearly(here):
            self._additions(visit.fit)
        self._settle()
        return self._better(here)

    def _better(self, here: Visit) -> bool:
        """Take the best set visited in place of the chosen one, if it is decisively better and may be believed.

        It has to be better alone, and beside the smooth force that nobody has named. Of those that lead by about as
        much the one of most evidence is taken: a law is not exchanged for a relative with more parameters.
        """
        self._been.add(here.terms)
        others = [v for v in self.course.visits.values() if v.terms not in self._been]
        good = sorted((v for v in others if self._decided(v, here)), key=lambda v: -v.weight)[:CONTESTED]
        good = [v for v in good if v.weight > good[0].weight - FAR]
        same = [v for v in others if v.terms in self.course.smooth and len(v.terms) == len(here.terms)]
        good += [v for v in same if v not in good]
        if good:
            self.course.check(here)
        needs = {
            v.terms: self.limits.decisive if v.terms > here.terms or not self._decided(v, here) else 0.0 for v in good
        }
        for visit in good:
            self.course.contest(visit, here, needs[visit.terms])
        leads = {v.terms: self.course.lead(v, here) for v in good}
        self.course.unbeaten = set()
        near = [v for v in good if leads[v.terms] > max(leads.values()) - self.limits.decisive]
        behind = [v for v in good if v not in near]
        for visit in [*sorted(near, key=lambda v: -v.weight), *sorted(behind, key=lambda v: -leads[v.terms])]:
            if not leads[visit.terms] > needs[visit.terms]:
                self.course.unbeaten |= visit.terms - here.terms if visit.terms > here.terms else frozenset()
                continue
            if self._certain(visit, here):
                self.course.chosen = visit.fit
                self.course.declined.clear()
                self.course.unbeaten = set()
                return True
            self.course.declined.update(visit.terms - here.terms)
        return False

    def _decided(self, visit: Visit, here: Visit) -> bool:
        """Return whether a set has decisively more weight than the chosen one, by the evidence alone."""
        return visit.weight > here.weight + (self.limits.decisive if visit.terms > here.terms else 0.0)

    def _nearly(self, here: Visit) -> list[Visit]:
        """Return the best sets of one more term, where none is decisive but some are not far from it.

        Two small effects may be decisive together where neither is alone.
        """
        more = [v for v in self.course.visits.values() if v.terms > here.terms]
        if any(v.weight > here.weight + self.limits.decisive for v in more):
            return []
        good = [v for v in more if v.fit.log_evidence > here.fit.log_evidence + NEARLY]
        return sorted(good, key=lambda v: -v.weight)[: BEAM - 1]

    def _settle(self) -> None:
        """Fit the best sets again from a raised random force: some of them may have stopped at a false maximum.

        One that leaves nothing over has not.
        """
        best = max(v.weight for v in self.course.visits.values())
        close = [v for v in self.course.visits.values() if v.weight > best - CLOSE and v.terms not in self._settled]
        close = [v for v in close if not quiet(v.fit)]
        if not close:
            return
        self.say(f"again with {', '.join(' and '.join(sorted(v.terms)) or 'nothing' for v in close)}")
        self._settled.update(v.terms for v in close)

        def again(visit: Visit) -> Fit:
            fit = use_one_core(visit.fit)
            return maximise(fit.problem, raise_random_force(fit.problem, fit.theta, 6.0))

        self._visit_all(each(again, close, self.jobs))

    def _certain(self, visit: Visit, here: Visit) -> bool:
        """Return whether a better set may be believed where something with a memory is left over.

        Then samples are not independent, and a term that resembles the leftovers always gains. So an amplitude has to
        stand out of its robust deviation; where that is more than some times the usual, the set has to take a
        share off the random force.
        """
        if visit.terms not in self._sure:
            self._sure[visit.terms] = standing(visit.fit)
        least, memory = self._sure[visit.terms]
        levels = [v.fit.theta[v.fit.problem.keys.index(RANDOM)] for v in (visit, here)]
        calm = memory < self.limits.memory or levels[0] < levels[1] + math.log(1.0 - self.limits.share)
        return least > self.limits.certain and calm

    def _beam(self, here: Visit) -> list[Visit]:
        """Return the sets to build on: the chosen one, and others of its size that explain at least half as much.

        One term can stand in for two others until both are in.
        """
        if not here.terms:
            return [here]
        bottom = self.course.visits[frozenset()].weight
        rivals = [v for v in self.course.visits.values() if len(v.terms) == len(here.terms) and v.terms != here.terms]
        rivals = [v for v in rivals if v.weight - bottom > 0.5 * (here.weight - bottom)]
        return [here, *sorted(rivals, key=lambda v: -v.weight)[: BEAM - 1]]

    def _screened(self, fit: Fit) -> list[ScoreTest]:
        """Return what score tests promise of the terms on top of a fit, of rich ones where a relative promises much.

        Those on top of the nominal fit are kept, and made once.
        """
        if self.course.hints and not fit.problem.active:
            return [h for h in self.course.hints if not self._tried(fit, h.key)]
        slopes, single = compute_slopes(fit), use_one_core(fit)
        hints: list[ScoreTest] = []
        untried = [k for k in self.candidates if not self._tried(fit, k)]
        for rich in (False, True):
            keys = [key for key in untried if self._rich(fit, key) == rich]
            if rich:
                promising = [h.key for h in hints if h.gain > self.limits.promising]
                keys = [key for key in keys if any(self._related(fit, key, other) for other in promising)]
            if keys:
                self.say(f"score tests of {', '.join(keys)}")
            found = each(lambda key: run_score_tests(single, slopes, key, self.shapes.get(key, ())), keys, self.jobs)
            hints += [hint for of_key in found for hint in of_key]
        if not fit.problem.active:
            self.course.hints = tuple(hints)
        return hints

    def _additions(self, fit: Fit) -> None:
        """Fit the terms whose score tests promise most on top of a fit, those first that promise most."""
        hints, single = self._screened(fit), use_one_core(fit)
        good = sorted((h for h in hints if h.gain > self.limits.promising and h.distinct > SAME), key=lambda h: -h.gain)
        good = [h for h in good if not h.late][:MOST_FITTED] + [h for h in good if h.late][:MOST_LATE]
        for size in sorted({len(h.start) for h in good}):
            group = [h for h in good if len(h.start) == size]
            self.say(f"fits with {', '.join(h.key for h in group)}")
            self._visit_all(each(partial(self._fitted, single, self._hopeless()), group, self.jobs))
        self._large(fit)

    def _tried(self, fit: Fit, key: str) -> bool:
        """Return whether a term is in a fit already, itself or as a relative, or was tried on top of it."""
        active = fit.problem.active
        known = active | {key} in self.course.visits or active | {key} in self._retold
        return key in active or any(self._related(fit, mine, key) for mine in active) or known

    def _visit_all(self, fits: Iterable[Fit]) -> None:
        """Note fits that were made on one core each."""
        for fit in fits:
            self._visit(use_cores(fit, self.jobs))

    def _large(self, fit: Fit) -> None:
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
                self._visit(maximise(add_term(restart(calm), hint, hint.start)))

    def _fitted(self, fit: Fit, hopeless: float, hint: ScoreTest) -> Fit:
        """Return the fit with one more term, begun at the fit with a simpler relative of it where there is one."""
        for key in self.candidates:
            visit = self.course.visits.get(fit.problem.active | {key})
            if visit and self._related(visit.fit, key, hint.key):
                return replace_term(use_one_core(visit.fit), key, hint, hopeless=hopeless)
        return fit_term(fit, hint, hopeless=hopeless)

    def _hopeless(self) -> float:
        """Return the log posterior below which a fit cannot matter any more."""
        return max(v.fit.local.log_posterior for v in self.course.visits.values()) - 30.0

    def _swaps(self, fit: Fit) -> None:
        """Fit each relative of a term in place of it, so that one that only stands in for another gives way."""
        for key in sorted(fit.problem.active):
            known = self.course.visits.get(fit.problem.active - {key})
            without = known.fit if known else self._visit(maximise(fit.problem.remove_term(key, fit.values))).fit
            slopes = compute_slopes(without)
            for other in self.candidates:
                terms = without.problem.active | {other}
                if other in fit.problem.active or terms in self.course.visits or not self._related(fit, key, other):
                    continue
                self.say(f"{other} in place of {key}")
                hint = run_score_test(without, slopes, other)
                if hint.gain > self.limits.promising and hint.distinct > SAME:
                    self._visit(fit_term(without, hint, hopeless=self._hopeless()))

    def _shrink(self) -> None:
        """Drop terms until none is left without which the set has more weight."""
        while self._backward():
            pass

    def _backward(self) -> bool:
        """Drop a term without which the set has more weight."""
        chosen = self.course.chosen
        here = self.course.visits[chosen.problem.active]
        for key in sorted(chosen.problem.active):
            terms = chosen.problem.active - {key}
            self.say(f"without {key}")
            visit = self.course.visits.get(terms) or self._visit(
                maximise(chosen.problem.remove_term(key, chosen.values))
            )
            self.course.check(visit)
            self.course.contest(here, visit, self.limits.decisive)
            told = here.weight > visit.weight + self.limits.decisive
            if not told or not self.course.lead(here, visit) > self.limits.decisive:
                self.course.unbeaten |= {key} if told else set()
                self.course.chosen = visit.fit
                return True
        return False

    @staticmethod
    def _rich(fit: Fit, key: str) -> bool:
        """Return whether a term has so many parameters that it is tried only where a simpler relative promises much."""
        return len(find_term(fit.problem, key)[1]) >= RICH

    @staticmethod
    def _related(fit: Fit, mine: str, other: str) -> bool:
        return related(find_term(fit.problem, mine)[0], find_term(fit.problem, other)[0])
