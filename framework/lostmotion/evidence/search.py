"""The search for explanations: slopes propose, fits decide, one score ranks all hypotheses."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from lostmotion.evidence.channels import list_channel_errors
from lostmotion.evidence.discrepancy import make_frame
from lostmotion.evidence.effects import Promise, Shapes, list_promises
from lostmotion.evidence.heldout import score_heldout
from lostmotion.evidence.hypothesis import Hypothesis, fit_hypothesis
from lostmotion.inference.candidates import ScoreTest, add_term, fit_term, replace_term
from lostmotion.inference.curves import add_all_curves
from lostmotion.inference.fit import ROUGHLY, Fit, maximise, restart
from lostmotion.inference.natural import find_term
from lostmotion.inference.penalties import compute_price, is_simpler
from lostmotion.kernels.threads import each
from lostmotion.likelihood.observation import Observation

Say = Callable[[str], None]
MOST_FITTED, MOST_BESIDE = 5, 3
"""The largest numbers of terms that are fitted beside a set: those that a fit without discrepancy promises, and those
that the hypothesis itself promises."""
CLOSE = 25.0
"""A bare fit within this distance of the best score is fitted with its discrepancy."""
REACH = 8.0
"""Hypotheses within this distance of the best score are extended."""
MOST_TERMS = 4


@dataclass
class Budget:
    """The processor time that a search may use, in s."""

    seconds: float
    begun: float = field(default_factory=time.process_time)

    @property
    def spent(self) -> bool:
        """Whether the time is used up."""
        return time.process_time() - self.begun > self.seconds


@dataclass
class ExplanationSearch:
    """A search beside a `nominal` fit among terms `keys`; `pieces` are held-out data with their first samples."""

    nominal: Fit
    keys: Sequence[str]
    pieces: Sequence[tuple[Observation, int]]
    budget: Budget
    shapes: Shapes = field(default_factory=dict)
    say: Say = lambda _: None
    found: dict[frozenset[str], Hypothesis] = field(default_factory=dict)
    bare: dict[frozenset[str], Fit] = field(default_factory=dict)
    skipped: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Prepare the system with every curve, and the usual errors of the channels."""
        whole = {o.name: o for o in (*self.nominal.problem.observations, *(o for o, _ in self.pieces))}
        self.errors = list_channel_errors(self.nominal, list(whole.values()))
        self.nominal = add_all_curves(self.nominal)

    def run(self) -> ExplanationSearch:
        """Return the search after it has ended by itself, or when its time was used up."""
        self._weigh(self.nominal)
        extended: set[frozenset[str]] = set()
        while (target := self._choose_next(extended)) is not None:
            if self.budget.spent:
                self.skipped.append(_name(target.terms))
                break
            extended.add(target.terms)
            self._extend(target)
        return self

    @property
    def best(self) -> Hypothesis:
        """The hypothesis with the largest score."""
        return max(self.found.values(), key=lambda one: one.score())

    def _choose_next(self, extended: set[frozenset[str]]) -> Hypothesis | None:
        """Return the next hypothesis to be extended: the best one close to the best of all, else the leading fit.

        A smooth force may imitate two laws together but neither alone, so sets that lead without a discrepancy are
        extended as well, as long as each leads the sets that were extended before.
        """
        least = self.best.score() - REACH
        rest = [h for h in self.found.values() if h.terms not in extended and len(h.terms) < MOST_TERMS]
        near = [h for h in rest if h.score() > least]
        if near:
            return max(near, key=lambda one: one.score())
        lead = max(self.bare, key=lambda terms: self._weigh_bare(self.bare[terms]))
        if lead in extended or len(lead) >= MOST_TERMS:
            return None
        if lead not in self.found:
            self._weigh(self.bare[lead])
        return self.found.get(lead)

    def _weigh_bare(self, fit: Fit) -> float:
        """Return the log evidence of a fit without discrepancy, less the price of its terms."""
        return fit.log_evidence - compute_price(fit.problem, len(self.keys))

    def _weigh(
        self, bare: Fit, begin: Mapping[str, float] | None = None, choice: tuple[int, ...] | None = None
    ) -> None:
        """Fit the hypothesis of a bare fit, and keep it if it is the best of its terms."""
        terms, price = bare.problem.active, compute_price(bare.problem, len(self.keys))
        self.say(f"weighing {_name(terms)}")
        frame = make_frame(bare.problem, bare.theta, self.errors)
        at = frame.start if begin is None else frame.transfer(begin)
        made = fit_hypothesis(frame, at, price, choice)
        if not math.isfinite(made.log_evidence):
            return
        made = replace(made, heldout=score_heldout(made, self.pieces))
        known = self.found.get(terms)
        if known is None or made.score() > known.score():
            self.found[terms] = made
        if terms not in self.bare or bare.log_evidence > self.bare[terms].log_evidence:
            self.bare[terms] = bare

    def _extend(self, target: Hypothesis) -> None:
        """Fit the sets with one more term that promise to be better, and the subsets of the set."""
        self.say(f"score tests beside {_name(target.terms)}")
        for key in sorted(target.terms):
            self._drop(target, key)
        bare = self.bare[target.terms]
        more = [key for key in self.keys if key not in target.terms and target.terms | {key} not in self.found]
        prices = {key: self._price(bare, key) for key in more}
        frame = make_frame(bare.problem, bare.theta, self.errors)
        alone = Hypothesis(frame, frame.expand(frame.start, bare.local.steps, frame.none), frame.none, 0.0, 0.0, 0.0)
        first = self._drop_richer([p for p in list_promises(alone, more, self.shapes, prices) if p.gain > 0.0])
        beside = self._drop_richer([p for p in list_promises(target, more, self.shapes, prices) if p.gain > 0.0])
        tasks = [(p, self._find_simpler(target, p.key)) for p in [*first[:MOST_FITTED], *beside[:MOST_BESIDE]]]
        self.say(f"fits beside {_name(target.terms)}: {', '.join(p.key for p, _ in tasks) or 'none'}")
        for promise, simpler in tasks:
            if simpler and not self.budget.spent:
                self._weigh_richer(target, promise, simpler)
        single, plain = (
            replace(bare, problem=replace(bare.problem, jobs=1)),
            [p for p in first[:MOST_FITTED] if not self._find_simpler(target, p.key)],
        )
        fits = each(lambda p: fit_term(single, _as_test(p)), plain, bare.problem.jobs)
        fits = [replace(f, problem=replace(f.problem, jobs=bare.problem.jobs)) for f in fits if f.status != "diverged"]
        for fit in fits:
            self.bare.setdefault(fit.problem.active, fit)
        ranked = sorted(fits, key=lambda f: -self._weigh_bare(f))
        for rank, fit in enumerate(ranked):
            weight = self._weigh_bare(fit) + target.heldout
            if (rank == 0 or weight > self.best.score() - CLOSE) and not self.budget.spent:
                self._weigh(fit)
        for promise in beside[:MOST_BESIDE]:
            if not self.budget.spent and not self._find_simpler(target, promise.key):
                self._weigh_beside(target, promise)

    def _drop_richer(self, promises: Sequence[Promise]) -> list[Promise]:
        """Return the promises without laws that contain a simpler law which promises something as well."""
        problem, keys = self.nominal.problem, {p.key for p in promises}
        return [
            p for p in promises if not any(self._contains(p.key, key) for key in keys if key in problem.system.keys)
        ]

    def _contains(self, richer: str, simpler: str) -> bool:
        """Return whether a law contains another one at the same place."""
        one, other = (find_term(self.nominal.problem, key)[0] for key in (richer, simpler))
        return is_simpler(other, one)

    def _find_simpler(self, target: Hypothesis, key: str) -> str:
        """Return the term of a hypothesis that another law contains; empty where there is none."""
        return next((mine for mine in sorted(target.terms) if self._contains(key, mine)), "")

    def _weigh_richer(self, target: Hypothesis, promise: Promise, simpler: str) -> None:
        """Fit the hypothesis with a richer law in place of one that it contains."""
        if (target.terms - {simpler}) | {promise.key} in self.found:
            return
        fit = replace_term(self.bare[target.terms], simpler, _as_test(promise))
        if fit.status != "diverged":
            self.bare.setdefault(fit.problem.active, fit)
            self._weigh(fit)

    def _weigh_beside(self, target: Hypothesis, promise: Promise) -> None:
        """Fit a hypothesis with one more term from the coordinates that another one predicts."""
        bare = self.bare[target.terms]
        problem = add_term(restart(bare), _as_test(promise), dict(promise.start))
        moved = dict(zip(target.frame.names, (target.at + promise.step).tolist(), strict=True))
        begin = {f.key: f.start for f in problem.free} | moved
        begin |= {f.key: f.start for f in problem.free if f.key.startswith(f"{promise.key}.")}
        theta = problem.clip(np.array([begin[key] for key in problem.keys]))
        begin |= dict(zip(problem.keys, theta.tolist(), strict=True))
        fit = self.bare.get(problem.active) or maximise(problem, theta, tolerance=ROUGHLY)
        if fit.status != "diverged":
            fit = replace(fit, problem=replace(problem, nsub=max(problem.nsub, fit.problem.nsub)))
            self._weigh(fit, begin, promise.choice)

    def _drop(self, target: Hypothesis, key: str) -> None:
        """Fit the set without one of its terms, starting from the set."""
        less = target.terms - {key}
        if self.budget.spent:
            return
        values = {f.key: f.value(target.values[f.key]) for f in target.frame.problem.free[: target.frame.own]}
        whole = self.bare[target.terms]
        problem = whole.problem.remove_term(key, values)
        fit = self.bare.get(less) or maximise(problem, tolerance=ROUGHLY)
        if fit.status != "diverged":
            begin = {k: v for k, v in target.values.items() if not k.startswith(f"{key}.")}
            self._weigh(fit, begin, target.choice)

    def _price(self, fit: Fit, key: str) -> float:
        """Return the log prior odds against one more term."""
        wider = replace(fit.problem, active=fit.problem.active | {key})
        return compute_price(wider, len(self.keys)) - compute_price(fit.problem, len(self.keys))


def _as_test(promise: Promise) -> ScoreTest:
    return ScoreTest(promise.key, promise.gain, promise.start, 1.0)


def _name(terms: Iterable[str]) -> str:
    return " and ".join(sorted(terms)) or "no term"


def compute_probabilities(found: Iterable[Hypothesis], temper: float) -> dict[frozenset[str], float]:
    """Return the posterior probability of each set: the softmax of the scores."""
    scores = {h.terms: h.score(temper) for h in found}
    top = max(scores.values())
    weights = {terms: math.exp(score - top) for terms, score in scores.items()}
    total = sum(weights.values())
    return {terms: weight / total for terms, weight in weights.items()}
