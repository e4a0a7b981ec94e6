"""The search for explanations: slopes propose, fits decide, one score ranks all hypotheses."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

import numpy as np

from lostmotion.defaults import LINEAR_FORCES
from lostmotion.evidence.bare import HALF, MOST_TERMS, Terms, name_terms
from lostmotion.evidence.effects import Promise
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.evidence.sensor_hum import renew_hums
from lostmotion.evidence.weighing import REACH, WeighedSets
from lostmotion.inference.candidates import add_term
from lostmotion.inference.fit import ROUGHLY, maximise, restart
from lostmotion.inference.natural import find_term

MOST_BESIDE, MOST_CLOSE, FEW = 3, 4, 2
"""The largest numbers of terms that are fitted from what a hypothesis promises, of bare fits that are weighed because
they are close to the best one, and of the laws of these: a third law often describes what a smooth force explains."""
CLOSE = 25.0
"""A bare fit within this distance of the best one is weighed with a discrepancy."""


@dataclass
class ExplanationSearch(WeighedSets):
    """A search among sets of terms.

    `skipped` are the sets that were not extended for lack of time, and `cancelled` tells whether the user ended it.
    """

    extended: set[Terms] = field(default_factory=set)
    proposed: set[Terms] = field(default_factory=set)
    dropped: set[tuple[Terms, Terms]] = field(default_factory=set)
    skipped: list[str] = field(default_factory=list)
    cancelled: bool = False

    def run(self) -> ExplanationSearch:
        """Return the search after it has ended by itself, when its time was used up, or when the user cancelled it."""
        with self.cancellable():
            self._run()
        return self

    @contextmanager
    def cancellable(self) -> Iterator[None]:
        """End the work within, and use up the time, when the user cancels it and nothing missing is weighed already."""
        try:
            yield
        except KeyboardInterrupt:
            if frozenset() not in self.found:
                raise
            self.budget.end()
            self.cancelled = True
            self.skipped.append("any set")
            self.say("cancelled: the best explanation so far")

    def _run(self) -> None:
        """Climb, weigh what is near the best set, and extend it."""
        self.bare.climb(self.budget.part(HALF))
        lead = self.bare.lead
        plain = self.bare.fits[self.bare.leave_out_waves(lead)]
        self.use_errors(renew_hums(self.errors, plain, self.recordings or plain.posterior.observations))
        self.weigh(self.bare.fits[lead])
        if self.best.terms:
            self._drop_all(self.best)
        self._reduce(lead)
        self._weigh_close(FEW)
        self._replace_each()
        while (target := self._choose_next()) is not None:
            if self.budget.spent:
                self.skipped.append(name_terms(target.terms))
                break
            self.extended.add(target.terms)
            self._extend(target)
            self._replace_each()

    def _drop_each(self) -> None:
        """Weigh the best set without each of its terms, and with simpler ones, until the best set stays the same."""
        tried: set[Terms] = set()
        while (best := self.best).terms not in tried:
            tried.add(best.terms)
            self._drop_every(best)

    def _reduce(self, terms: Terms) -> None:
        """Weigh a set without each of its terms, and the best of what is left again, while the score does not fall.

        A set that is found without a discrepancy may stand for one law and a smooth force.
        """
        least = -math.inf
        while terms and terms in self.found and self.score(self.found[terms]) > least and not self.budget.spent:
            least = self.score(self.found[terms]) - REACH
            self._drop_every(self.found[terms])
            fewer = [less for key in sorted(terms) for less in self.bare.reduce(terms, key) if less in self.found]
            terms = max(fewer, key=lambda less: self.score(self.found[less]), default=frozenset())

    def _drop_every(self, target: Hypothesis) -> None:
        """Weigh a set without each of its terms in turn, and with each simpler law that the term contains."""
        for key in sorted(target.frame.terms):
            for less in self.bare.reduce(target.terms, key):
                self._drop(target, key, less)

    def leave_out_sharers(self) -> None:
        """Leave out laws that add less to the best set than its discrepancy does, but the one that adds most.

        They only share with the discrepancy what it explains: several such names are one force without a name. A
        constant or linear force does not, because smooth forces have little of its form.
        """
        self._drop_each()
        while least := self._find_sharer(self.best):
            for terms in [one for one in self.found if one > {least}]:
                del self.found[terms]
            self.say(f"{least} only shares what a smooth force explains")
            self._drop_each()

    def _find_sharer(self, found: Hypothesis) -> str:
        """Return the law that adds less to a set than its discrepancy does, if another one adds more; empty if none."""
        if len(found.terms) < 2 or not all(found.terms - {key} in self.found for key in found.terms):
            return ""
        gains = {key: self.measure_gain(found, key) for key in sorted(found.terms)}
        sharing = [key for key in gains if find_term(found.frame.posterior, key)[0].name not in LINEAR_FORCES]
        least = min(sharing, key=lambda key: gains[key], default="")
        return least if least and gains[least] < min(self._measure_leftover(found), max(gains.values())) else ""

    def measure_gain(self, found: Hypothesis, key: str) -> float:
        """Return the score that a law adds to the others of a set; zero if the set was not weighed without it."""
        less = self.found.get(found.terms - {key})
        return found.score() - less.score() if less else 0.0

    def _measure_leftover(self, found: Hypothesis) -> float:
        """Return the log evidence that the discrepancy adds to the laws of a hypothesis."""
        return (found.log_evidence - self.bare.fits[found.terms].log_evidence) / self.temper

    def _choose_next(self) -> Hypothesis | None:
        """Return the next hypothesis to be extended: the best one close to the best of all; None without any."""
        least = self.score(self.best) - REACH
        open_ = [one for terms, one in self.found.items() if terms not in self.extended and len(terms) < MOST_TERMS]
        near = [one for one in open_ if not one.unknown and self.score(one) > least]
        return max(near, key=self.score, default=None)

    def _extend(self, target: Hypothesis) -> None:
        """Weigh the subsets of a set, and the sets with one more term that promise to be better.

        A set with a law that only shares what a smooth force explains is not extended.
        """
        for key in sorted(target.terms):
            if not self.budget.spent:
                self._drop(target, key, target.terms - {key})
        if self._find_sharer(target):
            return
        if target.smooth > 0.0:
            self._weigh_promised(target)
        else:
            self.bare.extend(target.terms)
            self._weigh_close(len(target.terms) + 1)

    def _replace_each(self) -> None:
        """Weigh what promises more than each law of the best set, in its place, until the best set stays the same."""
        before = None
        while (best := self.best.terms) != before:
            before = best
            for key in sorted(best):
                if best - {key} in self.found:
                    self._weigh_promised(self.found[best - {key}], key)

    def _weigh_promised(self, target: Hypothesis, instead: str = "") -> None:
        """Weigh a set with one more law, for each of those that promise most beside its smooth forces.

        With `instead` they promise nearly as much as this law. Like the score, a promise is of all data: a law that
        matters only in the held-out part promises nothing in the fitted part.
        """
        if target.terms in self.proposed or target.smooth <= 0.0 or self.budget.spent:
            return
        self.proposed.add(target.terms)
        self.say(f"score tests beside {name_terms(target.terms)} and a smooth force")
        known = set(self.found) - {target.terms | {instead}}
        promises = self.bare.list_promises(self.choose_by_all(target), known)
        least = max((p.gain - REACH for p in promises if p.key == instead), default=0.0)
        for promise in [p for p in promises if p.gain > least and p.key != instead][:MOST_BESIDE]:
            if not self.budget.spent:
                self._weigh_beside(self.found[target.terms], promise)

    def _weigh_close(self, most: int) -> None:
        """Weigh the bare fits of so many laws at most that are close to the best of these.

        A small discrepancy may make them better.
        """
        few = [fit for terms, fit in self.bare.fits.items() if len(terms) <= most]
        ranked = sorted(few, key=self.bare.weigh, reverse=True)
        least = self.bare.weigh(ranked[0]) - CLOSE
        for fit in ranked[:MOST_CLOSE]:
            if fit.posterior.active not in self.found and self.bare.weigh(fit) > least and not self.budget.spent:
                self.weigh(fit)

    def _weigh_beside(self, target: Hypothesis, promise: Promise) -> None:
        """Fit a hypothesis with one more term from the coordinates that another one predicts."""
        simpler = self.bare.find_simpler(target.terms, promise.key)
        bare = restart(self.bare.fits[target.terms])
        posterior = bare.remove_term(simpler, self.get_own_values(target)) if simpler else bare
        posterior = add_term(posterior, promise.key, promise.start)
        moved = dict(zip(target.frame.names, (target.at + promise.step).tolist(), strict=True))
        begin = {f.key: f.start for f in posterior.space.free} | moved
        begin |= {f.key: f.start for f in posterior.space.free if f.key.startswith(f"{promise.key}.")}
        theta = posterior.space.clip(np.array([begin[key] for key in posterior.space.keys]))
        begin |= dict(zip(posterior.space.keys, theta.tolist(), strict=True))
        known = self.bare.fits.get(posterior.active)
        if known is None or known.posterior.space.keys != posterior.space.keys:
            known = maximise(posterior, theta, tolerance=ROUGHLY)
        if known.status != "diverged":
            fit = replace(
                known, posterior=posterior.stepped(max(posterior.dynamics.nsub, known.posterior.dynamics.nsub))
            )
            self.weigh(fit, begin, promise.choice)

    def _drop(self, target: Hypothesis, key: str, less: Terms) -> None:
        """Fit a set `less` without one of the terms, perhaps with a simpler law in its place, starting from the set."""
        if (target.terms, less) in self.dropped:
            return
        self.dropped.add((target.terms, less))
        own = self.get_own_values(target)
        posterior = self.bare.fits[target.terms].posterior.remove_term(key, own)
        for simpler in less - target.terms:
            shared = {simpler + name.removeprefix(key): v for name, v in own.items() if name.startswith(f"{key}.")}
            posterior = add_term(posterior, simpler, shared)
        known = self.bare.fits.get(less)
        if known and self.is_far(less) and not posterior.log_likelihood(posterior.space.start) > known.log_likelihood:
            return
        fit = known or maximise(posterior, tolerance=ROUGHLY)
        if fit.status != "diverged":
            self.weigh(fit, _leave_out(target, [key]), target.choice)

    def _drop_all(self, target: Hypothesis) -> None:
        """Weigh the model without any term, starting from a set."""
        self.dropped.add((target.terms, frozenset()))
        self.weigh(self.bare.fits[frozenset()], _leave_out(target, target.terms))
        if frozenset() not in self.found:
            self.weigh(self.bare.fits[frozenset()])


def _leave_out(target: Hypothesis, keys: Iterable[str]) -> dict[str, float]:
    """Return the coordinates of a hypothesis by name, without those of some terms."""
    owners = tuple(f"{key}." for key in keys)
    return {name: value for name, value in target.values.items() if not name.startswith(owners)}
