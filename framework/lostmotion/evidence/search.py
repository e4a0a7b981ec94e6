"""The search for explanations: slopes propose, fits decide, one score ranks all hypotheses."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

import numpy as np

from lostmotion.defaults import LINEAR_FORCES
from lostmotion.evidence.bare import MOST_TERMS, BareFits, Budget, Say, Terms, make_weighed, name_terms
from lostmotion.evidence.channel_errors import ChannelError, list_channel_errors
from lostmotion.evidence.discrepancy import Choice, Quadratic, make_frame
from lostmotion.evidence.effects import Promise
from lostmotion.evidence.heldout import score_heldout
from lostmotion.evidence.hypothesis import Hypothesis, fit_hypothesis
from lostmotion.evidence.probabilities import measure_temper
from lostmotion.evidence.sensor_hum import renew_hums
from lostmotion.evidence.smooth_forces import LARGE, USUAL_OPTIONS
from lostmotion.inference.candidates import ScoreTest, add_term
from lostmotion.inference.curves import add_all_curves
from lostmotion.inference.fit import ROUGHLY, Fit, maximise, restart
from lostmotion.inference.late import find_onset
from lostmotion.inference.natural import find_term, sort_slots
from lostmotion.inference.penalties import compute_price
from lostmotion.inference.settling import settle_steps
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import ALWAYS, onset_key

MOST_BESIDE, MOST_CLOSE = 3, 4
"""The largest numbers of terms that are fitted from what a hypothesis promises, and of bare fits that are weighed."""
CLOSE = 25.0
"""A bare fit within this distance of the best one is weighed with a discrepancy."""
REACH = 8.0
"""Hypotheses within this distance of the best score are extended."""
MOST_UNKNOWN = 2
"""The number of sets with terms, best first, beside which an unknown force is fitted."""
FAR = 300.0
"""A known subset whose score is lower than the best by more than this is fitted again only from a better point."""


@dataclass
class ExplanationSearch:
    """A search beside a `nominal` fit among terms `keys`; `pieces` are held-out data with their first samples.

    `found` has the hypothesis of each set that was weighed, `skipped` the sets that were not extended for lack of time,
    and `cancelled` tells whether the user ended it. Smooth forces over the time reach to `until` (s). On a part of the
    samples, `temper` is its share of all: scores then predict those of all samples.
    """

    nominal: Fit
    keys: Sequence[str]
    pieces: Sequence[tuple[Observation, int]]
    budget: Budget
    temper: float = 1.0
    until: float = 0.0
    say: Say = lambda _: None
    errors: tuple[ChannelError, ...] = ()
    recordings: Sequence[Observation] = ()
    found: dict[Terms, Hypothesis] = field(default_factory=dict)
    extended: set[Terms] = field(default_factory=set)
    proposed: set[Terms] = field(default_factory=set)
    dropped: set[tuple[Terms, Terms]] = field(default_factory=set)
    skipped: list[str] = field(default_factory=list)
    cancelled: bool = False

    def __post_init__(self) -> None:
        """Prepare the system with every curve, and the usual errors of the channels if they are not given."""
        self.errors = self.errors or list_channel_errors(self.nominal, self._join_pieces(self.nominal.posterior))
        wide, plain = add_all_curves(self.nominal, self.until), self.nominal.posterior.system
        recordings = self.recordings or self.nominal.posterior.observations
        self.bare = BareFits(wide, plain, self.keys, self.errors, self.budget, recordings, self.temper, self.say)

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
        self.bare.climb(self.budget)
        lead = self.bare.lead
        plain = self.bare.fits[self.bare.leave_out_waves(lead)]
        self.use_errors(renew_hums(self.errors, plain, self.recordings or plain.posterior.observations))
        if len(lead) > 1:
            self.weigh(self.bare.fits[frozenset()])
            self._climb_beside()
        self.weigh(self.bare.fits[lead])
        if self.best.terms:
            self._drop_all(self.best)
        self._reduce(lead)
        self._weigh_close()
        self._replace_each()
        while (target := self._choose_next()) is not None:
            if self.budget.spent:
                self.skipped.append(name_terms(target.terms))
                break
            self.extended.add(target.terms)
            self._extend(target)
            self._replace_each()

    def _climb_beside(self) -> None:
        """Add to no law, one after another, what explains most beside smooth forces, while the score rises."""
        better = self.found.get(frozenset())
        while better is not None:
            target = better
            self._weigh_promised(target)
            self._weigh_wider(target)
            wider = [one for one in self.found.values() if self._is_wider(one.terms, target) and not one.unknown]
            better = max((one for one in wider if self.score(one) > self.score(target)), key=self.score, default=None)

    def _weigh_wider(self, target: Hypothesis) -> None:
        """Weigh the best fit without a discrepancy that has one law more than a set."""
        wider = [fit for terms, fit in self.bare.fits.items() if self._is_wider(terms, target)]
        best = max(wider, key=self.bare.weigh, default=None)
        if best is not None and best.posterior.active not in self.found and not self.budget.spent:
            self.weigh(best)

    @staticmethod
    def _is_wider(terms: Terms, target: Hypothesis) -> bool:
        """Return whether terms are those of a set and one more."""
        return terms > target.terms and len(terms) == len(target.terms) + 1

    def use_errors(self, errors: tuple[ChannelError, ...]) -> None:
        """Use these errors of channels from now on."""
        self.errors = self.bare.errors = errors

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
        constant or linear force does not, because no smooth force has its form.
        """
        self._drop_each()
        while len((best := self.best).terms) > 1 and all(best.terms - {key} in self.found for key in best.terms):
            gains = {key: best.score() - self.found[best.terms - {key}].score() for key in sorted(best.terms)}
            sharing = [key for key in gains if find_term(best.frame.posterior, key)[0].name not in LINEAR_FORCES]
            least = min(sharing, key=lambda key: gains[key], default="")
            if not least or gains[least] >= min(self._measure_leftover(best), max(gains.values())):
                return
            for terms in [one for one in self.found if one > {least}]:
                del self.found[terms]
            self.say(f"{least} only shares what a smooth force explains")
            self._drop_each()

    def _measure_leftover(self, found: Hypothesis) -> float:
        """Return the log evidence that the discrepancy adds to the laws of a hypothesis."""
        return (found.log_evidence - self.bare.fits[found.terms].log_evidence) / self.temper

    def weigh_unknown(self) -> None:
        """Fit the best sets, and the model without any term, with an unknown force."""
        ranked = sorted((one for one in self.found.values() if one.terms), key=self.score, reverse=True)
        for target in (self.found[frozenset()], *ranked[:MOST_UNKNOWN]):
            self._weigh_unknown(target)

    def score(self, found: Hypothesis) -> float:
        """Return the score of a hypothesis over the temper of all, the scatter of the best one."""
        return found.score(measure_temper(self.found.values(), self.temper))

    @property
    def best(self) -> Hypothesis:
        """The hypothesis with the largest score."""
        return max(self.found.values(), key=self.score)

    def _choose_next(self) -> Hypothesis | None:
        """Return the next hypothesis to be extended: the best one close to the best of all; None without any."""
        least = self.score(self.best) - REACH
        open_ = [one for terms, one in self.found.items() if terms not in self.extended and len(terms) < MOST_TERMS]
        near = [one for one in open_ if not one.unknown and self.score(one) > least]
        return max(near, key=self.score, default=None)

    def _extend(self, target: Hypothesis) -> None:
        """Weigh the subsets of a set, and the sets with one more term that promise to be better."""
        for key in sorted(target.terms):
            if not self.budget.spent:
                self._drop(target, key, target.terms - {key})
        self.bare.extend(target.terms)
        self._weigh_close()
        self._weigh_promised(target)

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
        whole = self._expand_whole(target)
        if self._choose_by_all(target, whole):
            target = self.found[target.terms]
            whole = self._expand_whole(target)
        promises = self.bare.list_promises(whole, known)
        least = max((p.gain - REACH for p in promises if p.key == instead), default=0.0)
        for promise in [p for p in promises if p.gain > least and p.key != instead][:MOST_BESIDE]:
            if not self.budget.spent:
                self._weigh_beside(target, promise)

    def _choose_by_all(self, target: Hypothesis, whole: Hypothesis) -> bool:
        """Fit a set with the smooth forces that fitted and held-out data need together; return whether this is better.

        Held-out data may need one that the fitted data do not.
        """
        choice, _ = Quadratic.of(whole.frame, whole.expansion.curvature).choose(target.choice)
        if choice != target.choice:
            made = fit_hypothesis(target.frame, target.at, target.price, choice, free=False)
            self._keep(made, self.bare.fits[target.terms])
        return self.found[target.terms] is not target

    def _expand_whole(self, target: Hypothesis) -> Hypothesis:
        """Return a hypothesis with its expansion over the fitted and the held-out data together."""
        if not self.pieces:
            return target
        fitted = target.frame.posterior
        wider = replace(target.frame, posterior=fitted.on(self._join_pieces(fitted)))
        return replace(target, frame=wider, expansion=wider.expand(target.at, target.frame.first_steps, target.choice))

    def _join_pieces(self, fitted: Posterior) -> tuple[Observation, ...]:
        """Return the recordings of a posterior, each with its held-out part, and those that are held out whole."""
        return tuple({o.name: o for o in (*fitted.observations, *(o for o, _ in self.pieces))}.values())

    def _weigh_close(self) -> None:
        """Weigh the bare fits that are close to the best one: a small discrepancy may make them better."""
        ranked = sorted(self.bare.fits.values(), key=self.bare.weigh, reverse=True)
        least = self.bare.weigh(ranked[0]) - CLOSE
        for fit in ranked[:MOST_CLOSE]:
            if fit.posterior.active not in self.found and self.bare.weigh(fit) > least and not self.budget.spent:
                self.weigh(fit)

    def weigh(self, bare: Fit, begin: Mapping[str, float] | None = None, choice: Choice | None = None) -> None:
        """Fit the hypothesis of a bare fit, from some coordinates, and keep it if it is the best of its terms.

        A term with an onset is weighed without it as well: what smooth forces explain may be what the onset is for.
        """
        self.say(f"weighing {name_terms(bare.posterior.active)}")
        bare = settle_steps(bare)
        self.bare.fits.setdefault(bare.posterior.active, bare)
        frame = make_frame(bare.posterior, bare.theta, self.errors, self.bare.odds)
        at, price = frame.start, compute_price(bare.posterior, len(self.keys))
        if begin is not None:
            at = max(frame.transfer(begin), at, key=lambda one: frame.log_likelihood(one, choice or frame.none))
        self._keep(fit_hypothesis(frame, at, price, choice), bare)
        if bare.posterior.active in self.found:
            self._lift(self.found[bare.posterior.active])
        if late := {onset_key(key) for key in bare.posterior.active if find_onset(bare.posterior, key) > ALWAYS}:
            always = maximise(restart(bare).hold_values(dict.fromkeys(late, ALWAYS)), bare.theta, tolerance=ROUGHLY)
            if always.status != "diverged":
                self.weigh(always, begin, choice)

    def _renew_bare(self, bare: Fit, found: Hypothesis) -> Fit:
        """Return the fit of a set without a discrepancy, from where its hypothesis is if that is much better."""
        theta = found.at[: len(bare.theta)]
        if bare.posterior.log_likelihood(theta) > bare.log_likelihood + REACH:
            return maximise(bare.posterior, theta, tolerance=ROUGHLY)
        return bare

    def _lift(self, low: Hypothesis) -> None:
        """Fit a set again from a subset that explains all data better: without its last term it would be as good.

        It has the smooth forces of the subset then. Held-out data may need one that the fitted data do not.
        """
        inside = [one for terms, one in self.found.items() if terms < low.terms and len(terms) == len(low.terms) - 1]
        below = max(inside, key=lambda one: one.log_profile, default=low)
        if below.log_profile < low.log_profile + REACH or self.budget.spent:
            return
        absent = {
            slot.key: slot.param.null
            for key in low.terms - below.terms
            for slot in sort_slots(low.frame.posterior, key)[0]
            if slot.param.null is not None
        }
        begin = low.frame.transfer(low.values | below.values | absent)
        self._keep(fit_hypothesis(low.frame, begin, low.price, below.choice, free=False), self.bare.fits[low.terms])

    def _weigh_unknown(self, target: Hypothesis) -> None:
        """Fit a set with a smooth force that is larger than the usual discrepancy; its price is that of a term."""
        self.say(f"weighing an unknown force beside {name_terms(target.terms)}")
        bare, price = self.bare.fits[target.terms], target.price + self.bare.odds
        frame = make_frame(bare.posterior, bare.theta, self.errors, self.bare.odds, LARGE)
        made = fit_hypothesis(frame, frame.transfer(target.values), price, target.choice)
        if max(made.choice, default=-1) >= USUAL_OPTIONS:
            self._keep(replace(made, unknown=True), bare)

    def _keep(self, made: Hypothesis, bare: Fit) -> None:
        """Keep a hypothesis, with the density of the held-out data and its bare fit, if it is the best of its terms."""
        if math.isfinite(made.log_evidence):
            made = replace(made, heldout=score_heldout(made, self.pieces))
        known = self.found.get(made.terms)
        if math.isfinite(made.score()) and (known is None or made.score() > known.score()):
            self.found[made.terms] = made
            self.bare.fits[made.frame.terms] = self._renew_bare(bare, made)
            self.say(make_weighed(made.terms, self.score(made), self.budget))

    def _weigh_beside(self, target: Hypothesis, promise: Promise) -> None:
        """Fit a hypothesis with one more term from the coordinates that another one predicts."""
        simpler = self.bare.find_simpler(target.terms, promise.key)
        bare = restart(self.bare.fits[target.terms])
        posterior = bare.remove_term(simpler, self._get_own_values(target)) if simpler else bare
        test = ScoreTest(promise.key, promise.gain, promise.start, 1.0)
        posterior = add_term(posterior, test, dict(promise.start))
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
        own = self._get_own_values(target)
        posterior = self.bare.fits[target.terms].posterior.remove_term(key, own)
        for simpler in less - target.terms:
            shared = {simpler + name.removeprefix(key): v for name, v in own.items() if name.startswith(f"{key}.")}
            posterior = add_term(posterior, ScoreTest(simpler, 0.0, shared, 1.0), {})
        known = self.bare.fits.get(less)
        if known and self._is_far(less) and not posterior.log_likelihood(posterior.space.start) > known.log_likelihood:
            return
        fit = known or maximise(posterior, tolerance=ROUGHLY)
        if fit.status != "diverged":
            self.weigh(fit, _leave_out(target, [key]), target.choice)

    def _is_far(self, terms: Terms) -> bool:
        """Return whether a set was weighed, and its score is far below the best one."""
        return terms in self.found and self.score(self.found[terms]) < self.score(self.best) - FAR

    def _drop_all(self, target: Hypothesis) -> None:
        """Weigh the model without any term, starting from a set."""
        self.dropped.add((target.terms, frozenset()))
        self.weigh(self.bare.fits[frozenset()], _leave_out(target, target.terms))
        if frozenset() not in self.found:
            self.weigh(self.bare.fits[frozenset()])

    def _get_own_values(self, target: Hypothesis) -> dict[str, float]:
        """Return the own parameters of a hypothesis by key, in their units."""
        return {f.key: f.value(target.values[f.key]) for f in target.frame.posterior.space.free[: target.frame.own]}


def _leave_out(target: Hypothesis, keys: Iterable[str]) -> dict[str, float]:
    """Return the coordinates of a hypothesis by name, without those of some terms."""
    owners = tuple(f"{key}." for key in keys)
    return {name: value for name, value in target.values.items() if not name.startswith(owners)}
