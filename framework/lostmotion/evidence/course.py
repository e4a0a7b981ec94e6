"""The course of a search: on stretches of long recordings first, and again with AR(1) noise of sensors if supported."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from lostmotion.evidence.bare import HALF, Budget, Say, Terms
from lostmotion.evidence.explanations import Explanations
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.evidence.search import ExplanationSearch
from lostmotion.inference.curves import drop_all_curves
from lostmotion.inference.fit import ROUGHLY, Fit, maximise
from lostmotion.inference.memory import add_same_memory, fit_noise_memory, is_memory_supported
from lostmotion.inference.random_force import has_usual_random_force
from lostmotion.inference.stretches import cut_stretches
from lostmotion.likelihood.observation import Observation

FIRST = 0.6
"""The share of the processor time for the search on stretches."""
MOST_WHOLE, REACH = 4, 20.0
"""The number of sets that are weighed on all samples, and the largest distance of their scores from the best one."""


@dataclass(frozen=True)
class Course:
    """What every search of a diagnosis has in common: terms `keys`, held-out `pieces`, processor time and progress."""

    keys: Sequence[str]
    pieces: Sequence[tuple[Observation, int]]
    budget: Budget
    say: Say

    def find_explanations(self, nominal: Fit) -> Explanations:
        """Return the explanations of the data that a nominal model leaves something out of, or nothing."""
        search = self._search(nominal, {})
        if not self.budget.part(HALF).spent and (coloured := self._find_memory(search)) is not None:
            again = self._search(coloured, search.found)
            if again.best.score() > search.best.score():
                search = again
        return Explanations.of(search)

    def _search(self, nominal: Fit, seeds: Mapping[Terms, Hypothesis]) -> ExplanationSearch:
        """Return the search beside a nominal fit; `seeds` are hypotheses of the same data with another noise."""
        until = max((float(o.time[-1]) for o, _ in self.pieces), default=0.0)
        whole = ExplanationSearch(nominal, self.keys, self.pieces, self.budget, until=until, say=self.say, seeds=seeds)
        short = cut_stretches(nominal.posterior)
        bare = nominal if short is nominal.posterior else maximise(short, nominal.theta)
        if bare is nominal or bare.status == "diverged":
            whole.run()
            self._complete(whole)
            return whole
        self.say(f"search on {short.samples} samples in {len(short.observations)} stretches")
        share = short.samples / nominal.posterior.samples
        part, recordings = self.budget.part(FIRST), nominal.posterior.observations
        first = ExplanationSearch(bare, self.keys, (), part, share, until, self.say, whole.errors, recordings).run()
        with first.cancellable():
            first.leave_out_sharers()
        whole.cancelled = first.cancelled
        whole.use_errors(first.errors)
        if whole.cancelled:
            self.budget.end()
        self.say("the best explanations on all samples")
        for rank, found in enumerate(_list_best(first)):
            if rank > 1 and self.budget.spent:
                break
            fit = first.bare.fits[found.terms]
            if found.terms:
                fit = maximise(fit.posterior.on(nominal.posterior.observations), fit.theta, tolerance=ROUGHLY)
            else:
                fit = whole.bare.nominal
            if fit.status != "diverged":
                whole.weigh(fit, found.values, found.choice)
        whole.skipped += first.skipped
        best = first.best
        whole.bare.promised |= first.bare.promised | {key: first.measure_gain(best, key) for key in best.terms}
        self._complete(whole, whole.best.terms == best.terms)
        return whole

    def _complete(self, search: ExplanationSearch, reduced: bool = False) -> None:
        """Weigh unknown forces and, unless it is known, what is left without each law of the best set.

        Nothing more is weighed after the user has cancelled.
        """
        if not search.cancelled:
            with search.cancellable():
                if not reduced:
                    search.leave_out_sharers()
                search.weigh_unknown()

    def _find_memory(self, search: ExplanationSearch) -> Fit | None:
        """Return the nominal fit with AR(1) noise where a fit supports it; white noise and a force imitate it."""
        plain, nominal = (
            drop_all_curves(search.bare.fits[terms], search.bare.plain)
            for terms in (search.best.frame.terms, frozenset())
        )
        if has_usual_random_force(plain):
            return None
        self.say("AR(1) measurement noise")
        coloured = fit_noise_memory(plain)
        if coloured is None or not is_memory_supported(plain, coloured):
            return None
        made = add_same_memory(nominal, coloured) if plain.posterior.active else coloured
        if made is None or made.status == "diverged":
            return None
        return replace(made, posterior=replace(made.posterior, jobs=nominal.posterior.jobs))


def _list_best(search: ExplanationSearch) -> list[Hypothesis]:
    """Return the best hypothesis, that without any term, and others near the best one, best first."""
    least = search.score(search.best) - REACH
    near = sorted((one for one in search.found.values() if search.score(one) > least), key=search.score, reverse=True)
    nothing = search.found[frozenset()]
    best, *others = [one for one in near if one.terms] or [nothing]
    return [best, *([nothing] if best.terms else []), *others[: MOST_WHOLE - 1]]
