"""Unknown forces: whether a learned curve explains what the library does not, or better than the library does.

Curves compete with the terms by log evidence, with a price for each: a curve is flexible, and the evidence accounts for
it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from lostmotion.inference.curves import CHOICES, ROUNDS, add_all_curves, fit_curve, run_curve_test
from lostmotion.inference.fit import Fit, maximise
from lostmotion.inference.learned import LearnedTerm
from lostmotion.inference.natural import find_term
from lostmotion.inference.penalties import compute_penalty, compute_unknown_price
from lostmotion.inference.random_force import has_usual_random_force, reduces_random_force
from lostmotion.inference.surfaces import RICHER
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM

MOST_SAMPLES = 8000
"""Samples on which curves are searched; they are then fitted to all samples."""
FITTED, RIVAL = 2, 0.7
"""The number of curves that are fitted in addition to each set, with at least this share of the best predicted gain: a
score test ranks correlated covariates only roughly."""

Progress = Callable[[str], None]


@dataclass(frozen=True)
class UnknownForce:
    """A fit with learned curves: their keys, and the log odds over the best set of terms of the library.

    `alone` says that they replace what the library had found.
    """

    fit: Fit
    keys: tuple[str, ...]
    gain: float
    alone: bool

    @property
    def probability(self) -> float:
        """The posterior probability of the curves."""
        return 1.0 / (1.0 + math.exp(-min(self.gain, 500.0)))

    @property
    def terms(self) -> tuple[LearnedTerm, ...]:
        """The learned terms, in the order in which they were selected."""
        terms = [find_term(self.fit.posterior, key)[0] for key in self.keys]
        return tuple(term for term in terms if isinstance(term, LearnedTerm))


@dataclass
class Search:
    """A search for curves: `many` candidates of the library, and the weight of each set of terms and curves."""

    many: int
    say: Progress = lambda _: None
    visits: dict[frozenset[str], tuple[Fit, float]] = field(default_factory=dict)
    learned: set[tuple[frozenset[str], bool]] = field(default_factory=set)

    def visit(self, fit: Fit) -> float:
        """Store a fit and return its weight: log evidence less the price of its terms and curves."""
        weight = fit.log_evidence - sum(self.price(fit.posterior, key) for key in fit.posterior.active)
        known = self.visits.get(fit.posterior.active)
        if known is None or weight > known[1]:
            self.visits[fit.posterior.active] = (fit, weight)
        return weight

    def price(self, posterior: Posterior, key: str) -> float:
        """Return the log prior penalty of a term, as in the selection, or of a curve with its chosen smoothness."""
        term, _ = find_term(posterior, key)
        if isinstance(term, LearnedTerm):
            return compute_unknown_price(self.many) + CHOICES
        return compute_penalty(term, self.many, posterior.settings)

    def learn(self, fit: Fit, count: int = FITTED, *, richer: bool = False) -> None:
        """Fit the curves that promise most on top of a fit, if they promise to be decisive, and to reach the best set.

        A score test promises too little where a large random force has to stand for what is missing. `richer` ones are
        over two things at once, or over the history of the motion, and are asked only then.
        """
        if (fit.posterior.active, richer) in self.learned:
            return
        self.learned.add((fit.posterior.active, richer))
        slopes = fit.slopes
        shapes = []
        for key, term in zip(fit.posterior.system.keys, fit.posterior.system.terms, strict=True):
            own = isinstance(term, LearnedTerm) and isinstance(term, RICHER) == richer
            if own and key not in fit.posterior.active:
                self.say(f"score test of {key}")
                shapes.append(run_curve_test(fit, slopes, key))
        short = max(weight for _, weight in self.visits.values()) - self.visits[fit.posterior.active][1]
        settings = fit.posterior.settings
        price = math.log(self.many) + 1.0 + CHOICES + settings.select.decisive
        needed = max(price, settings.unknown.hope * short)
        shapes = sorted((s for s in shapes if s.gain > needed), key=lambda s: -s.gain)
        for shape in [s for s in shapes[:count] if s.gain > RIVAL * shapes[0].gain]:
            self.say(f"fit with {shape.key}")
            self.visit(fit_curve(fit, shape))

    def bare(self, fit: Fit) -> Fit:
        """Return a fit with a richer curve without the named terms that are not decisive in addition to it.

        Laws that had imitated a force over two variables, or one with a memory, are not needed any more.
        """
        curves = _list_curves(fit.posterior)
        if not any(isinstance(find_term(fit.posterior, key)[0], RICHER) for key in curves):
            return fit
        for key in sorted(fit.posterior.active - set(curves)):
            self.say(f"learned curves without {key}")
            less = maximise(fit.posterior.remove_term(key, fit.values), rounds=2 * ROUNDS, tolerance=0.3)
            if self.visit(less) > self.visits[fit.posterior.active][1] - fit.posterior.settings.select.decisive:
                fit = less
        return fit


@dataclass(frozen=True)
class CurveSearch:
    """The search for learned curves at the end of a diagnosis, where `many` terms of the library were tried."""

    many: int
    say: Progress = lambda _: None

    def _begin(self, nominal: Fit) -> tuple[Fit, Search]:
        """Return a nominal fit in a system with every curve, on the samples for the search, and its search."""
        before = _shorten_fit(add_all_curves(nominal))
        learned = sum(isinstance(term, LearnedTerm) for term in before.posterior.system.terms)
        search = Search(self.many + learned, self.say)
        search.visit(before)
        return before, search

    def unknown(self, nominal: Fit, chosen: Fit) -> UnknownForce | None:
        """Return the learned curves that explain decisively more than the terms of the library, or None.

        Curves are tried in addition to the chosen terms and to the nominal model alone: where they do not need the
        terms, these are dropped, and otherwise the names are kept.
        """
        (before, search), limits = self._begin(nominal), nominal.posterior.settings.unknown
        after = before if chosen is nominal else _shorten_fit(add_all_curves(chosen))
        bar = max(search.visits[before.posterior.active][1], search.visit(after))
        if search.visits[after.posterior.active][0] is after:
            search.learned.discard((after.posterior.active, False))
        search.learn(after)
        if chosen.posterior.active:
            search.learn(before, 1)
        plain = _select_best(search)
        if plain is None or not has_usual_random_force(plain):
            search.learn(after, richer=True)
            search.learn(before, 1, richer=True)
        best = _select_best(search)
        if best is not None and _changes_named_law(best, after):
            best = search.bare(best)
        if best is None or _changes_named_law(best, after):
            return None
        while len(_list_curves(best.posterior)) < int(limits.most_curves) and not has_usual_random_force(best):
            search.learn(best, 1)
            further = _select_best(search, best.posterior.active) or best
            if further.posterior.active == best.posterior.active:
                break
            best = further
        gain = search.visits[best.posterior.active][1] - bar
        if (
            gain < best.posterior.settings.select.decisive
            or not _reduces_random_force(best, after)
            or _changes_named_law(best, after)
        ):
            return None
        alone = bool(chosen.posterior.active) and best.posterior.active == frozenset(_list_curves(best.posterior))
        if chosen.posterior.samples > best.posterior.samples:
            self.say("fit of the learned curves on all samples")
            whole = best.posterior.on(chosen.posterior.observations)
            best = maximise(whole, best.theta, rounds=ROUNDS, tolerance=0.3)
        return UnknownForce(best, _list_curves(best.posterior), gain, alone)


def _shorten_fit(fit: Fit) -> Fit:
    """Return the fit on the beginnings of its recordings where they are long: curves have dozens of coefficients."""
    observations, share = fit.posterior.observations, MOST_SAMPLES / fit.posterior.samples
    if share >= 1.0:
        return fit
    parts = tuple(t.part(0, round(share * t.samples)) for t in observations)
    return maximise(fit.posterior.on(parts), fit.theta, rounds=ROUNDS)


def _list_curves(posterior: Posterior) -> tuple[str, ...]:
    pairs = zip(posterior.system.keys, posterior.system.terms, strict=True)
    active = {key for key, term in pairs if isinstance(term, LearnedTerm) and key in posterior.active}
    seen = dict.fromkeys(f.key.rpartition(".")[0] for f in posterior.space.free)
    return tuple(key for key in seen if key in active)


def _select_best(search: Search, beyond: frozenset[str] = frozenset()) -> Fit | None:
    """Return the best fit with curves that contains all terms in `beyond`; None without any.

    A fit with one more curve has to be decisively better than the one without.
    """
    fits = [(f, w) for active, (f, w) in search.visits.items() if active >= beyond and _list_curves(f.posterior)]
    return max(fits, key=_penalise_curves)[0] if fits else None


def _penalise_curves(pair: tuple[Fit, float]) -> float:
    fit, weight = pair
    return weight - fit.posterior.settings.select.decisive * len(_list_curves(fit.posterior))


def _changes_named_law(fit: Fit, without: Fit) -> bool:
    """Return whether curves change the size of a named law by much: then they belong to its shape.

    A curve over velocity can be a part of dry friction; where the law is named, its size is to be that of the law.
    """
    old, new = without.values, fit.values
    sizes = [key for key in old if "." in key and key in new and abs(old[key]) > 0.0]
    amplitudes = [key for key in sizes if not next(f for f in without.posterior.space.free if f.key == key).log]
    kept = fit.posterior.settings.unknown.kept
    return any(abs(new[key] - old[key]) > kept * abs(old[key]) for key in amplitudes)


def _reduces_random_force(fit: Fit, without: Fit) -> bool:
    """Return whether curves reduce a random force that was above the usual by enough."""
    limits, at = fit.posterior.settings, without.posterior.space.keys.index(RANDOM)
    usual = without.theta[at] <= without.posterior.space.free[at].mean + 2.0 * math.log(limits.unknown.usual)
    return bool(usual) or reduces_random_force(fit, without, limits.select.share)
