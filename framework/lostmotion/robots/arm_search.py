"""The search for what an arm lacks: slopes propose, fits decide, one score ranks all sets of effects."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from lostmotion.evidence.bare import Budget, make_weighed
from lostmotion.evidence.probabilities import compute_probabilities
from lostmotion.inference.penalties import compute_unknown_price
from lostmotion.kernels.threads import each
from lostmotion.parts import Array
from lostmotion.robots.arm_discrepancy import Discrepancy
from lostmotion.robots.arm_effects import ArmEffect
from lostmotion.robots.arm_hypothesis import ArmFrame, ArmHypothesis, find_precision, fit_hypothesis, score_heldout
from lostmotion.robots.promises import (
    SAME_LAW,
    ArmPromise,
    Group,
    Screen,
    leave_richer,
    list_gear_promises,
    list_groups,
    list_promises,
)

Say = Callable[[str], None]
Terms = frozenset[str]
MOST_FITTED, MOST_SMALL, MOST_GEARS = 6, 3, 3
"""The numbers of effects that are fitted beside a set: by promises at the fitted random force, by those at a small one
or with values of the model held, and of gears."""
REACH, STRONGER = 3.0, 3.0
"""Sets within this distance of the best score are extended. Fits gain more than their slopes promise, but beside one
set by factors that differ less than this: those that cannot come so near to the best set are not made."""
SMALL = 0.1
"""The random force of a second start, as a share of the fitted one: a gap is else taken for noise."""
NOTHING = "nothing_missing"
"""The name of the set without any effect."""
UNKNOWN_PRICE = 1.0
"""The log odds of an unknown force against those of one effect of the library."""


class ProposedFit(NamedTuple):
    """Effects that are fitted beside a set, from starts whose random forces are shifted (logarithms)."""

    promises: Group
    shifts: tuple[float, ...]


@dataclass
class ArmSearch:
    """A search from the fit of the nominal model; `found` has the best hypothesis of each set of effects.

    `samples` is the length of the log, of which the `frame` fits the first part. `large` is the discrepancy with a
    larger smooth force.
    """

    frame: ArmFrame
    screen: Screen
    large: Discrepancy
    samples: int
    most: int
    budget: Budget
    jobs: int = 1
    say: Say = lambda _: None
    found: dict[Terms, ArmHypothesis] = field(default_factory=dict)
    extended: set[Terms] = field(default_factory=set)
    dropped: set[tuple[Terms, Terms]] = field(default_factory=set)
    skipped: bool = False

    @property
    def price(self) -> float:
        """The log odds against any one effect."""
        return compute_unknown_price(len(self.screen.effects))

    @property
    def temper(self) -> float:
        """What log evidences are divided by: the scatter of the best hypothesis."""
        best = max(self.found.values(), key=lambda one: one.log_evidence + one.heldout - one.price)
        return best.scatter

    @property
    def best(self) -> ArmHypothesis:
        """The hypothesis of the largest score."""
        return max(self.found.values(), key=lambda one: one.score(self.temper))

    def run(self, nominal: Array) -> ArmSearch:
        """Return the search after it has ended, started at coordinates of the nominal model."""
        self.weigh((), self._vary_levels(nominal))
        if not self.found:
            return self
        while (target := self._choose_next()) is not None:
            if self.budget.spent:
                self.skipped = True
                break
            self.extended.add(target.terms)
            self.extend(target)
            if len(target.terms) > 1:
                self.drop_each(target)
        self.drop_each(self.best)
        while not self.budget.spent and self.swap_each(self.best):
            self.drop_each(self.best)
        for target in sorted(self.found.values(), key=lambda one: -one.score(self.temper))[:2]:
            self.weigh_unknown(target)
        if not any(one.unknown and not one.frame.terms for one in self.found.values()):
            self.weigh_unknown(self.found[frozenset()])
        return self

    def _choose_next(self) -> ArmHypothesis | None:
        least = self.best.score(self.temper) - REACH
        open_ = [one for terms, one in self.found.items() if terms not in self.extended and len(terms) < self.most]
        near = [one for one in open_ if not one.unknown and one.score(self.temper) > least]
        return max(near, key=lambda one: one.score(self.temper), default=None)

    def extend(self, target: ArmHypothesis) -> None:
        """Fit the sets with one more effect that promise to be better: those that may come near to the best, last."""
        groups, singles = self._list_proposals(target)
        first = [*groups, *singles[:1]]
        self._fit_all(target, first)
        gained = self.best.score(self.temper) - target.score(self.temper)
        promised = max((sum(p.gain for p in one.promises) for one in first), default=1.0)
        most = STRONGER * max(gained / promised, 1.0)
        self._fit_all(target, [one for one in singles[1:] if most * one.promises[0].gain > gained - REACH])

    def _list_proposals(self, target: ArmHypothesis) -> tuple[list[ProposedFit], list[ProposedFit]]:
        """Return what is proposed beside a set: groups of effects, and single effects, the best first."""
        small, every = self._make_small(target), self._list_promises(target)
        groups = list_groups(every, self.most - len(target.terms))
        usual = leave_richer(every)[:MOST_FITTED]
        known = {p.effect.key for p in usual if p.gain > 0.0}
        if target.choice[-1]:
            held = leave_richer(self._list_promises(self._hold_values(target)))
            usual += [p for p in held[:MOST_SMALL] if p.effect.key not in known]
            known |= {p.effect.key for p in usual}
        more = leave_richer(self._list_promises(small))[:MOST_SMALL] if small is not None else []
        gears = list_gear_promises(self.screen, target, SMALL, self.price, self.temper)[:MOST_GEARS]
        singles = [ProposedFit((p,), (0.0,)) for p in usual if p.gain > 0.0]
        singles += [ProposedFit((p,), (math.log(SMALL),)) for p in more if p.gain > 0.0 and p.effect.key not in known]
        singles += [ProposedFit((p,), tuple(math.log(level) for level in p.levels)) for p in gears if p.gain > 0.0]
        return [ProposedFit(group, (0.0,)) for group in groups], singles

    def _list_promises(self, beside: ArmHypothesis) -> list[ArmPromise]:
        return list_promises(self.screen, beside, self.price, self.temper)

    def _fit_all(self, target: ArmHypothesis, proposals: Sequence[ProposedFit]) -> None:
        """Fit what is proposed beside a set, and keep it."""
        told = [name_set(frozenset(p.effect.key for p in one.promises)) for one in proposals]
        if told:
            self.say(f"fits beside {name_set(target.terms)}: {', '.join(told)}")

        def fit(one: ProposedFit) -> ArmHypothesis | None:
            if self.budget.spent:
                self.skipped = True
                return None
            return self._fit_beside(target, one.promises, one.shifts)

        for made in each(fit, proposals, self.jobs):
            self._keep(made)

    def _hold_values(self, target: ArmHypothesis) -> ArmHypothesis:
        """Return the hypothesis with values known within the tolerance: less well known ones may hide an effect."""
        choice = (*target.choice[:-1], 0)
        used, precision = find_precision(target.frame, target.expansion, choice)
        return replace(target, choice=choice, used=used, precision=precision)

    def _make_small(self, target: ArmHypothesis) -> ArmHypothesis | None:
        """Return the hypothesis with a small random force, at which slopes of effects that look like noise show."""
        at = target.at.copy()
        at[: len(self.frame.arm.joints)] += math.log(SMALL)
        seen, kept = target.frame.expand(at)
        if not math.isfinite(float(kept.seen.log_likelihood)):
            return None
        used, precision = find_precision(target.frame, seen, target.choice)
        return replace(target, at=at, expansion=seen, kept=kept, used=used, precision=precision)

    def _fit_beside(self, target: ArmHypothesis, group: Group, shifts: tuple[float, ...]) -> ArmHypothesis | None:
        """Return the fitted set with further effects, in place of simpler ones that they contain."""
        replaced = {key for promise in group for key in promise.effect.extends}
        kept = [e for e in target.frame.effects if e.key not in replaced]
        effects = tuple(sorted((*kept, *(promise.effect for promise in group)), key=lambda e: e.key))
        if frozenset(e.key for e in effects) in self.found:
            return None
        known = self._read(self._move(target, [p.shift for p in group if p.shift is not None]))
        known |= {
            c.key: c.place(promise.start.get(c.key, c.value(c.mean)))
            for promise in group
            for c in promise.effect.coordinates
        }
        return self._fit(effects, self._vary_levels(self._place(effects, known), shifts), target)

    def _move(self, one: ArmHypothesis, shifts: list[Array]) -> ArmHypothesis:
        """Return a hypothesis with the coefficients of its discrepancy where promises expect them."""
        of_discrepancy = np.arange(len(one.at)) >= len(one.frame.own)
        return replace(one, at=one.at + np.where(of_discrepancy, sum(shifts), 0.0))

    def _vary_levels(self, at: Array, shifts: tuple[float, ...] = (0.0, math.log(SMALL))) -> list[Array]:
        """Return starts with other random forces, whose logarithms are shifted."""
        first = np.arange(len(at)) < len(self.frame.arm.joints)
        return [np.where(first, at + shift, at) for shift in shifts]

    def _read(self, one: ArmHypothesis) -> dict[str, float]:
        """Return the coordinates of a hypothesis by key, those of the discrepancy by number."""
        own = {c.key: float(x) for c, x in zip(one.frame.own, one.at, strict=False)}
        return own | {f"#{i}": float(x) for i, x in enumerate(one.at[len(one.frame.own) :])}

    def _place(self, effects: tuple[ArmEffect, ...], known: Mapping[str, float]) -> Array:
        """Return the coordinates of a frame with some effects."""
        frame = replace(self.frame, effects=effects)
        own = [known.get(c.key, c.mean) for c in frame.own]
        more = [known.get(f"#{i}", 0.0) for i in range(len(frame.discrepancy.columns))]
        return np.array([*own, *more])

    def weigh(self, effects: tuple[ArmEffect, ...], starts: list[Array], beside: ArmHypothesis | None = None) -> None:
        """Fit a set of effects from several starts, and keep the best fit."""
        self._keep(self._fit(effects, starts, beside))

    def _fit(
        self, effects: tuple[ArmEffect, ...], starts: list[Array], beside: ArmHypothesis | None
    ) -> ArmHypothesis | None:
        """Return the best fit of a set of effects from several starts, with its density of held-out data."""
        frame = replace(self.frame, effects=effects)
        if beside is not None and not beside.unknown:
            frame = replace(frame, discrepancy=beside.frame.discrepancy)
        price = sum(self.price + effect.price for effect in effects)
        choice = beside.choice if beside is not None else None
        worth = -math.inf if beside is None else beside.log_evidence + self.temper * (price - beside.price)
        made = [fit_hypothesis(frame, start, price, choice, worth=worth) for start in starts]
        fitted = [one for one in made if one is not None]
        return self._score(max(fitted, key=lambda one: one.log_evidence)) if fitted else None

    def _score(self, made: ArmHypothesis) -> ArmHypothesis:
        return replace(made, heldout=score_heldout(made, self.frame.last, self.samples))

    def _keep(self, made: ArmHypothesis | None) -> None:
        if made is None:
            return
        known = self.found.get(made.terms)
        better = known is None or made.log_evidence + made.heldout > known.log_evidence + known.heldout
        if math.isfinite(made.heldout) and better:
            self.found[made.terms] = made
            self.say(make_weighed(made.terms, made.score(self.temper), self.budget))

    def drop_each(self, target: ArmHypothesis) -> None:
        """Weigh a set without each of its effects in turn, starting from the set."""
        known = self._read(target)

        def fit(rest: tuple[ArmEffect, ...]) -> ArmHypothesis | None:
            start, terms = self._place(rest, known), frozenset(e.key for e in rest)
            if terms in self.found:
                levels = self.found[terms].at[: self.frame.levels]
                start[: len(levels)] = levels
            return self._fit(rest, [start], target)

        wanted = []
        for effect in target.frame.effects:
            rest = tuple(e for e in target.frame.effects if e is not effect)
            pair = (target.terms, frozenset(e.key for e in rest))
            if pair not in self.dropped:
                self.dropped.add(pair)
                wanted.append(rest)
        for made in each(fit, wanted, self.jobs):
            self._keep(made)

    def swap_each(self, target: ArmHypothesis) -> bool:
        """Fit a set with other laws in the place of each of its effects, and return whether one is better.

        A search that adds effects to the best set does not meet them: a law that does the same for two effects, such as
        a lag and a delay, is tried beside the other one.
        """
        best = self.best.score(self.temper)
        for effect in target.frame.effects if len(target.terms) > 1 and not target.unknown else ():
            rest = self.found.get(target.terms - {effect.key})
            if rest is not None:
                others = (*self._list_simpler(target, effect), *self._list_rivals(rest, effect))
                self._fit_all(rest, [ProposedFit((promise,), (0.0,)) for promise in others])
        return self.best.score(self.temper) > best

    def _list_simpler(self, target: ArmHypothesis, effect: ArmEffect) -> list[ArmPromise]:
        """Return the simpler forms of an effect of a set, if an amplitude that they lack may be zero."""
        names = {c.key.rpartition(".")[2]: c for c in effect.coordinates}
        found = []
        for simpler in self.screen.effects:
            own = {c.key.rpartition(".")[2]: c for c in simpler.coordinates}
            more = [c for name, c in names.items() if c.amplitude and name not in own]
            if simpler.key in effect.extends and any(target.is_vague(c.key) for c in more):
                start = {c.key: target.values[names[name].key] for name, c in own.items() if name in names}
                found.append(ArmPromise(simpler, start, 0.0))
        return found

    def _list_rivals(self, rest: ArmHypothesis, effect: ArmEffect) -> list[ArmPromise]:
        """Return the law that promises most beside the rest of a set at the place of an effect, if it is another."""
        place = effect.key.partition("@")[2]
        for promise in self._list_promises(rest):
            other = promise.effect
            if other.key.partition("@")[2] == place and promise.gain > 0.0 and other.key != effect.key:
                nested = other.key in effect.extends or effect.key in other.extends
                return [] if nested else [promise]
        return []

    def weigh_unknown(self, target: ArmHypothesis) -> None:
        """Fit a set with a smooth force that is larger than the usual discrepancy."""
        if target.unknown:
            return
        frame = replace(target.frame, discrepancy=self.large)
        price = target.price + self.price + UNKNOWN_PRICE
        made = fit_hypothesis(frame, target.at, price, _widen(target, self.large))
        if made is None:
            return
        usual = [len(force.options) for force in target.frame.discrepancy.forces]
        if any(option >= count for option, count in zip(made.choice[:-1], usual, strict=True)):
            self._keep(self._score(replace(made, unknown=True)))


def _widen(target: ArmHypothesis, large: Discrepancy) -> tuple[int, ...]:
    """Return the choice of a hypothesis among the options of a larger discrepancy, whose first ones are the same."""
    options = zip(target.choice[:-1], large.forces, strict=True)
    return (*(min(option, len(f.options) - 1) for option, f in options), target.choice[-1])


def name_set(terms: Terms) -> str:
    """Return a set of effects in words."""
    return " and ".join(sorted(terms)) or "no effect"


def find_probabilities(search: ArmSearch) -> dict[str, float]:
    """Return the posterior probability of each effect: the sum over the sets that contain it.

    A set with a law that contains a simpler one, and explains hardly more than it, is counted as that with the simpler
    law: friction that drifts within its first hundredth of a second is dry friction.
    """
    shares: dict[str, float] = {}
    for terms, share in compute_probabilities(search.found.values(), search.temper).items():
        for key in simplify(search, terms) or {NOTHING}:
            shares[key] = shares.get(key, 0.0) + share
    return dict(sorted(shares.items(), key=lambda pair: -pair[1]))


def simplify(search: ArmSearch, terms: Terms) -> Terms:
    """Return the terms of a set with each law in its simplest form that explains as much."""
    one = search.found[terms]
    for effect in one.frame.effects:
        for simpler in effect.extends:
            plain = search.found.get((terms - {effect.key}) | {simpler})
            if plain is not None:
                gain = one.log_evidence + one.heldout - plain.log_evidence - plain.heldout
                if gain < SAME_LAW * search.temper:
                    return simplify(search, plain.terms)
    return terms
