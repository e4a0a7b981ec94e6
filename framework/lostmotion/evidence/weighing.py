"""Sets of terms that are weighed: each is fitted with its discrepancy and scored, and the best fit of each is kept."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from lostmotion.evidence.bare import BareFits, Budget, Say, Terms, make_weighed, name_terms
from lostmotion.evidence.channel_errors import ChannelError, list_channel_errors
from lostmotion.evidence.discrepancy import Choice, Quadratic, make_frame
from lostmotion.evidence.heldout import score_heldout
from lostmotion.evidence.hypothesis import Hypothesis, fit_hypothesis
from lostmotion.evidence.probabilities import measure_temper
from lostmotion.evidence.smooth_forces import LARGE, USUAL_OPTIONS
from lostmotion.inference.curves import add_all_curves
from lostmotion.inference.fit import ROUGHLY, Fit, maximise, restart
from lostmotion.inference.late import find_onset
from lostmotion.inference.natural import sort_slots
from lostmotion.inference.penalties import compute_price
from lostmotion.inference.settling import settle_steps
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import ALWAYS, onset_key

REACH = 8.0
"""Scores within this distance of each other are close."""
MOST_UNKNOWN = 2
"""The number of sets with terms, best first, beside which an unknown force is fitted."""
FAR = 300.0
"""A known subset whose score is lower than the best by more than this is fitted again only from a better point."""


@dataclass
class WeighedSets:
    """Hypotheses beside a `nominal` fit among terms `keys`; `pieces` are held-out data with their first samples.

    `found` has the hypothesis of each set that was weighed. Smooth forces over the time reach to `until` (s). On a part
    of the samples, `temper` is its share of all: scores then predict those of all samples. `seeds` are hypotheses of
    the same data with another noise, from which fits may begin.
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
    seeds: Mapping[Terms, Hypothesis] = field(default_factory=dict)
    found: dict[Terms, Hypothesis] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Prepare the system with every curve, and the usual errors of the channels if they are not given."""
        self.errors = self.errors or list_channel_errors(self.nominal, self._join_pieces(self.nominal.posterior))
        wide, plain = add_all_curves(self.nominal, self.until), self.nominal.posterior.system
        recordings = self.recordings or self.nominal.posterior.observations
        self.bare = BareFits(wide, plain, self.keys, self.errors, self.budget, recordings, self.temper, self.say)

    def score(self, found: Hypothesis) -> float:
        """Return the score of a hypothesis over the temper of all, the scatter of the best one."""
        return found.score(measure_temper(self.found.values(), self.temper))

    @property
    def best(self) -> Hypothesis:
        """The hypothesis with the largest score."""
        return max(self.found.values(), key=self.score)

    def use_errors(self, errors: tuple[ChannelError, ...]) -> None:
        """Use these errors of channels from now on."""
        self.errors = self.bare.errors = errors

    def weigh(self, bare: Fit, begin: Mapping[str, float] | None = None, choice: Choice | None = None) -> None:
        """Fit the hypothesis of a bare fit, from some coordinates, and keep it if it is the best of its terms.

        A term with an onset is weighed without it as well: what smooth forces explain may be what the onset is for.
        """
        self.say(f"weighing {name_terms(bare.posterior.active)}")
        bare = settle_steps(bare)
        self.bare.fits.setdefault(bare.posterior.active, bare)
        frame = make_frame(bare.posterior, bare.theta, self.errors, self.bare.odds)
        price, starts = compute_price(bare.posterior, len(self.keys)), [(frame.start, choice)]
        if begin is not None:
            starts.append((frame.transfer(begin), choice))
        if (seed := self.seeds.get(bare.posterior.active)) is not None:
            starts.append((frame.transfer(seed.values), seed.choice))
        if len(starts) > 1:
            starts.sort(key=lambda one: -frame.log_likelihood(one[0], one[1] or frame.none))
        self._keep(fit_hypothesis(frame, starts[0][0], price, starts[0][1]), bare)
        if bare.posterior.active in self.found:
            self._lift(self.found[bare.posterior.active])
        if late := {onset_key(key) for key in bare.posterior.active if find_onset(bare.posterior, key) > ALWAYS}:
            always = maximise(restart(bare).hold_values(dict.fromkeys(late, ALWAYS)), bare.theta, tolerance=ROUGHLY)
            if always.status != "diverged":
                self.weigh(always, begin, choice)

    def weigh_unknown(self) -> None:
        """Fit the best sets that are close, and the model without any term, with an unknown force."""
        least = self.score(self.best) - REACH
        close = (one for one in self.found.values() if one.terms and self.score(one) > least)
        ranked = sorted(close, key=self.score, reverse=True)
        for target in (self.found[frozenset()], *ranked[:MOST_UNKNOWN]):
            self._weigh_unknown(target)

    def _weigh_unknown(self, target: Hypothesis) -> None:
        """Fit a set with a smooth force that is larger than the usual discrepancy; its price is that of a term."""
        self.say(f"weighing an unknown force beside {name_terms(target.terms)}")
        bare, price = self.bare.fits[target.terms], target.price + self.bare.odds
        frame = make_frame(bare.posterior, bare.theta, self.errors, self.bare.odds, LARGE)
        made = fit_hypothesis(frame, frame.transfer(target.values), price, target.choice)
        if max(made.choice, default=-1) >= USUAL_OPTIONS:
            self._keep(replace(made, unknown=True), bare)

    def choose_by_all(self, target: Hypothesis) -> Hypothesis:
        """Return a set with its expansion over fitted and held-out data, and the smooth forces that both together need.

        Held-out data may need a smooth force that the fitted data do not.
        """
        whole = self._expand_whole(target)
        choice, _ = Quadratic.of(whole.frame, whole.expansion.curvature).choose(target.choice)
        if choice == target.choice:
            return whole
        made = fit_hypothesis(target.frame, target.at, target.price, choice, free=False)
        self._keep(made, self.bare.fits[target.terms])
        better = self.found[target.terms]
        return whole if better is target else self._expand_whole(better)

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

    def get_own_values(self, target: Hypothesis) -> dict[str, float]:
        """Return the own parameters of a hypothesis by key, in their units."""
        return {f.key: f.value(target.values[f.key]) for f in target.frame.posterior.space.free[: target.frame.own]}

    def is_far(self, terms: Terms) -> bool:
        """Return whether a set was weighed, and its score is far below the best one."""
        return terms in self.found and self.score(self.found[terms]) < self.score(self.best) - FAR

    def _keep(self, made: Hypothesis, bare: Fit) -> None:
        """Keep a hypothesis, with the density of the held-out data and its bare fit, if it is the best of its terms."""
        if math.isfinite(made.log_evidence):
            made = replace(made, heldout=score_heldout(made, self.pieces))
        known = self.found.get(made.terms)
        if math.isfinite(made.score()) and (known is None or made.score() > known.score()):
            self.found[made.terms] = made
            self.bare.fits[made.frame.terms] = self._renew_bare(bare, made)
            self.say(make_weighed(made.terms, self.score(made), self.budget))

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
        inside = [one for terms, one in self.found.items() if is_wider(low.terms, terms)]
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


def is_wider(terms: Terms, target: Terms) -> bool:
    """Return whether terms are those of a target set and one more."""
    return terms > target and len(terms) == len(target) + 1
