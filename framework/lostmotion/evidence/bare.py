"""Fits of sets of terms without a discrepancy: a climb by slopes finds laws that a smooth force may imitate."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from lostmotion.evidence.channel_errors import ChannelError
from lostmotion.evidence.effects import Promise, hold_bare, list_promises
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.evidence.load_cell import fit_loads
from lostmotion.evidence.resonances import scan_resonances
from lostmotion.evidence.waves import scan_waves
from lostmotion.inference.candidates import fit_term, replace_term
from lostmotion.inference.commoner import rewrite_term
from lostmotion.inference.curves import drop_all_curves
from lostmotion.inference.fit import ROUGHLY, Fit, maximise, use_cores, use_one_core
from lostmotion.inference.late import list_onsets, price_onset
from lostmotion.inference.natural import find_term, find_wave
from lostmotion.inference.other_shapes import has_other_shapes, refit_complete, refit_shapes
from lostmotion.inference.penalties import compute_price, compute_unknown_price, is_simpler
from lostmotion.inference.shape_scan import scan_shapes
from lostmotion.kernels.threads import each
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System
from lostmotion.likelihood.work import count_work
from lostmotion.progress import Step

Say = Callable[[str], None]
Terms = frozenset[str]
"""The keys of a set of terms."""
MOST_SINGLE, MOST_FITTED = 10, 5
"""The largest numbers of terms that are fitted alone, and beside a set. Where the nominal fit is far from the truth,
slopes say little of a large effect, and a wrong first law is rarely left again."""
MOST_TERMS, MOST_BARE = 4, 3
"""The largest number of terms of a set, and of those that a climb without a discrepancy finds: beyond the first ones it
describes with laws what a smooth force explains."""
HALF = 0.5
"""Work that may wait is not begun once this share of the budget is used: a further step of the climb, other shapes of a
set, and AR(1) noise."""


@dataclass(kw_only=True)
class Budget:
    """The work that a search may do, in steps of filters (`count_work`), and the processor time, in s.

    Without a limit of time, the search ends at the same point on every machine. A part of a budget is this `share`.
    """

    steps: float = math.inf
    seconds: float = math.inf
    share: float = 1.0
    begun: int = field(default_factory=count_work)
    since: float = field(default_factory=time.process_time)

    @property
    def spent(self) -> bool:
        """Whether the work or the time is used up."""
        return count_work() - self.begun > self.steps or time.process_time() - self.since > self.seconds

    @property
    def used(self) -> float:
        """The share of the whole budget that is used; 0 where there is no limit."""
        if self.spent:
            return self.share
        done = (count_work() - self.begun) / self.steps, (time.process_time() - self.since) / self.seconds
        return self.share * max(done)

    def end(self) -> None:
        """Declare the work used up."""
        self.steps = -1.0

    def part(self, share: float) -> Budget:
        """Return the budget of a first part of the work."""
        return replace(self, steps=share * self.steps, seconds=share * self.seconds, share=share * self.share)


@dataclass
class BareFits:
    """The fits of sets of terms `keys` without a discrepancy, begun at that of no term.

    Weights are log evidences over `temper` less the price: on a part of the samples it is the share of that part, so
    that they predict those of all samples. `plain` is the system without curves, `errors` are those of channels, and
    `promised` is the log evidence that each law alone promises. `whole` are the recordings without cuts.
    """

    nominal: Fit
    plain: System
    keys: Sequence[str]
    errors: tuple[ChannelError, ...]
    budget: Budget
    whole: Sequence[Observation]
    temper: float = 1.0
    say: Say = lambda _: None
    shapes: dict[str, Sequence[Mapping[str, float]]] = field(default_factory=dict)
    fits: dict[Terms, Fit] = field(default_factory=dict)
    extended: set[Terms] = field(default_factory=set)
    refitted: set[Terms] = field(default_factory=set)
    promised: dict[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Keep the nominal fit."""
        self.fits.setdefault(frozenset(), self.nominal)

    @property
    def odds(self) -> float:
        """The log odds against any one more law."""
        return compute_unknown_price(len(self.keys))

    @property
    def lead(self) -> Terms:
        """The set with the largest weight."""
        return max(self.fits, key=lambda terms: self.weigh(self.fits[terms]))

    def weigh(self, fit: Fit) -> float:
        """Return the weight of a fit."""
        return fit.log_evidence / self.temper - compute_price(fit.posterior, len(self.keys))

    def keep(self, fit: Fit) -> None:
        """Keep a fit if it is the best of its terms and did not diverge."""
        terms = fit.posterior.active
        if fit.status != "diverged" and (terms not in self.fits or self.weigh(fit) > self.weigh(self.fits[terms])):
            self.fits[terms] = fit

    def climb(self, budget: Budget) -> None:
        """Extend the leading set until neither a further term nor another form makes it better."""
        while (lead := self.lead) not in self.refitted and not budget.spent:
            if lead in self.extended or len(lead) >= MOST_BARE:
                self.refit(lead)
            else:
                self.extend(lead)

    def extend(self, terms: Terms) -> None:
        """Fit the sets with one more term that promise to be better."""
        if terms in self.extended:
            return
        self.extended.add(terms)
        bare = self.fits[terms]
        plain = drop_all_curves(bare, self.plain)
        for found in (scan_shapes(plain), scan_resonances(plain), scan_waves(plain, self.whole)):
            for key, shapes in found.items():
                self.shapes[key] = (*self.shapes.get(key, ()), *shapes)
        self.say(f"score tests beside {name_terms(terms)}")
        alone = hold_bare(bare, self.errors, self.odds)
        promises = self.list_promises(alone, set(self.fits))[: MOST_FITTED if terms else MOST_SINGLE]
        self.say(f"fits beside {name_terms(terms)}: {', '.join(p.key for p in promises) or 'none'}")
        single = use_one_core(bare)
        for fit in each(lambda p: self._fit(single, p), promises, bare.posterior.jobs):
            self.keep(use_cores(fit, bare.posterior.jobs))
        if not terms:
            for fit in fit_loads(bare, self.keys, self.say):
                self.keep(fit)

    def list_promises(self, beside: Hypothesis, known: Iterable[Terms]) -> list[Promise]:
        """Return the terms that promise a better score beside a hypothesis, best first, without `known` sets.

        A law that contains a simpler one, which promises something as well, waits until the simpler one is found; one
        that a law of the hypothesis contains adds nothing.
        """
        bare, mine, have = beside.frame.posterior, beside.frame.terms, set(known)
        own = self.fits[mine]
        more = [key for key in self.keys if not self._holds(mine, key) and self._join(mine, key) not in have]
        prices = {key: self.temper * self._price(own, key) for key in more}
        onsets = list_onsets(self.nominal.posterior).tolist()
        every = list_promises(beside, more, self.shapes, prices, onsets, self.temper * price_onset(bare))
        if not mine:
            self.promised |= {p.key: (p.gain + prices[p.key]) / self.temper for p in every}
        found = [p for p in every if p.gain > 0.0]
        keys = {p.key for p in found} & set(bare.system.keys)
        return [p for p in found if not any(self._contains(p.key, key) for key in keys)]

    def leave_out_waves(self, terms: Terms) -> Terms:
        """Return the largest fitted subset of a set without waves of the drive: a line of hum looks like one."""
        posterior = self.nominal.posterior
        laws = {key for key in terms if find_term(posterior, key)[0].acts != "drive" or not find_wave(posterior, key)}
        return max((one for one in self.fits if one <= laws), key=lambda one: (len(one), self.weigh(self.fits[one])))

    def reduce(self, terms: Terms, key: str) -> list[Terms]:
        """Return a set without one of its terms, and with each simpler law that the term contains in its place."""
        rest = terms - {key}
        simpler = [law for law in self.keys if self._contains(key, law) and not self._holds(rest, law)]
        return [rest, *(rest | {law} for law in simpler)]

    def find_simpler(self, terms: Terms, key: str) -> str:
        """Return the term of a set that another law contains; empty where there is none."""
        return next((mine for mine in sorted(terms) if self._contains(key, mine)), "")

    def _holds(self, terms: Terms, key: str) -> bool:
        """Return whether a set has a law, by itself or within another one, or a part of it beside another law.

        Data do not tell how two laws that contain the same simpler one divide it.
        """
        return key in terms or any(self._contains(law, key) or self._overlaps(law, key) for law in terms)

    def _join(self, terms: Terms, key: str) -> Terms:
        """Return a set with one more law, in place of the simpler one that it contains."""
        return (terms - {self.find_simpler(terms, key)}) | {key}

    def _fit(self, bare: Fit, promise: Promise) -> Fit:
        """Return the fit with one more law, in place of the simpler one that it contains."""
        key, start = promise.key, promise.start
        simpler = self.find_simpler(bare.posterior.active, key)
        return replace_term(bare, simpler, key, start, promise.gain) if simpler else fit_term(bare, key, start)

    def refit(self, terms: Terms) -> None:
        """Fit other forms of a set: a rich law as a sum of simple ones, a complete law, other shapes."""
        self.refitted.add(terms)
        bare = self.fits[terms]
        for key in sorted(terms):
            if (posterior := rewrite_term(bare, key, self.keys)) is not None:
                self.keep(maximise(posterior, tolerance=ROUGHLY))
        for complete in refit_complete(bare):
            self.keep(use_cores(complete, bare.posterior.jobs))
        if has_other_shapes(bare.posterior):
            self.say(f"other shapes of {name_terms(terms)}")
            half = self.budget.part(HALF)
            self.keep(use_cores(refit_shapes(bare, lambda: half.spent), bare.posterior.jobs))

    def _contains(self, richer: str, simpler: str) -> bool:
        """Return whether a law contains another one at the same place."""
        one, other = (find_term(self.nominal.posterior, key)[0] for key in (richer, simpler))
        return is_simpler(other, one)

    def _overlaps(self, law: str, key: str) -> bool:
        """Return whether two forces share a simpler law, and the second one does not contain the first."""
        one, other = (find_term(self.nominal.posterior, name)[0] for name in (law, key))
        return (
            one.acts == "motion"
            and one.at == other.at
            and not is_simpler(one, other)
            and not set(one.extends).isdisjoint(other.extends)
        )

    def _price(self, fit: Fit, key: str) -> float:
        """Return the log prior odds against one more term."""
        wider = fit.posterior.acting(self._join(fit.posterior.active, key))
        return compute_price(wider, len(self.keys)) - compute_price(fit.posterior, len(self.keys))


def make_weighed(terms: Terms, score: float, budget: Budget) -> Step:
    """Return the step that tells the score of a set of terms, and the share of the budget that is used."""
    return Step(f"weighed {name_terms(terms)}", terms=sorted(terms), score=round(score, 2), used=round(budget.used, 4))


def name_terms(terms: Iterable[str]) -> str:
    """Return a set of terms in words."""
    return " and ".join(sorted(terms)) or "no term"
