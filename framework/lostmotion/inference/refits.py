"""Refits of sets of terms that may have stopped at a local maximum: which sets, and from where."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from lostmotion.inference.candidates import refit_with_noise
from lostmotion.inference.fit import Fit, maximise, raise_random_force, use_one_core
from lostmotion.inference.natural import find_term
from lostmotion.inference.other_shapes import has_other_shapes, refit_choices
from lostmotion.inference.penalties import is_simpler
from lostmotion.inference.random_force import has_usual_random_force
from lostmotion.inference.term_sets import CLOSE, Selection, TermSet
from lostmotion.inference.unseen import begins_elsewhere, lacks_position, refit_start_in_play
from lostmotion.likelihood.space import LEVELS

FAR = 300.0
"""Sets whose log weight is lower than the largest by more than this are not refitted."""
DISPLACED = 50.0
"""Sets within this distance of the best in log weight are refitted if their motion begins elsewhere: with the initial
state of the nominal model, a late drive was 26 in log-likelihood behind its own maximum."""
MOST_SHARED = 3
"""The number of sets that are refitted from the best one in each round."""

WAVED, MOST_SHAPED = 30.0, 2
"""Sets within this distance of the best in log weight are refitted with other shapes, so many in each round."""


@dataclass
class Refits:
    """The sets that were refitted: from their own fit, from that of another set, and from other shapes."""

    own: set[frozenset[str]] = field(default_factory=set)
    shared: set[tuple[frozenset[str], frozenset[str]]] = field(default_factory=set)
    shaped: set[frozenset[str]] = field(default_factory=set)

    def take_close(self, selection: Selection) -> list[TermSet]:
        """Return the sets close to the best one that were not refitted yet, and count them as refitted.

        A set without a random force beyond the usual is refitted only where no sensor shows the position. There, sets
        that are further behind count too if their motion begins elsewhere.
        """
        sets = selection.fitted_sets.values()
        best = max(v.weight for v in sets)
        close = [v for v in sets if v.weight > best - CLOSE and v.terms not in self.own]
        close = [v for v in close if not has_usual_random_force(v.fit) or (v.terms and lacks_position(v.fit.problem))]
        close += self._list_displaced(sets, best)
        self.own.update(v.terms for v in close)
        return close

    def _list_displaced(self, sets: Iterable[TermSet], best: float) -> list[TermSet]:
        """Return sets behind the close ones whose motion begins elsewhere, where no sensor shows the position.

        Only the best of those that were not refitted yet are asked.
        """
        behind = [
            v for v in sets if best - CLOSE >= v.weight > best - DISPLACED and v.terms and v.terms not in self.own
        ]
        behind = [v for v in behind if v.fit.status == "converged" and lacks_position(v.fit.problem)]
        return [v for v in sorted(behind, key=lambda v: -v.weight)[:MOST_SHARED] if begins_elsewhere(v.fit)]

    def take_far(self, selection: Selection, best: TermSet) -> list[TermSet]:
        """Return sets as large as the best one that have another noise, and count them as refitted from it.

        The random force, the white and the slow noise of a sensor divide the scatter of the readings among them, and a
        fit may stop at a wrong division.
        """
        sets = [v for v in selection.fitted_sets.values() if len(v.terms) == len(best.terms)]
        sets = [v for v in sets if best.weight > v.weight > best.weight - FAR and v.fit.status != "diverged"]
        far = [v for v in sets if (v.terms, best.terms) not in self.shared and _have_other_noise(v.fit, best.fit)]
        far = sorted(far, key=lambda v: -v.weight)[:MOST_SHARED]
        self.shared.update((v.terms, best.terms) for v in far)
        return far

    def take_subsets(self, selection: Selection, best: TermSet) -> list[TermSet]:
        """Return the sets that lack one term of the best one, and count them as refitted from it.

        It is done where no sensor shows the position: a better initial state would count as an effect of the term.
        """
        if not lacks_position(best.fit.problem):
            return []
        sets = [selection.fitted_sets.get(best.terms - {key}) for key in sorted(best.terms)]
        less = [v for v in sets if v and (v.terms, best.terms) not in self.shared and v.fit.status != "diverged"]
        self.shared.update((v.terms, best.terms) for v in less)
        return less

    def take_shaped(self, selection: Selection) -> list[TermSet]:
        """Return the best sets with shapes from which they were not refitted yet, and count them as refitted.

        A wave at a wrong pitch is far behind, so sets count that are further from the best one than close ones. Those
        that are no better than one of their subsets do not. If no random force remains, other shapes have nothing to
        explain, and those that are no better than a set with a simpler law do not count either.
        """
        sets = sorted(selection.fitted_sets.values(), key=lambda v: -v.weight)
        near = [v for v in sets if v.weight > sets[0].weight - WAVED and v.terms not in self.shaped]
        near = [v for v in near if not any(w.weight > v.weight and _is_enough(w, v) for w in sets)]
        taken = [v for v in near if v.fit.status == "converged" and has_other_shapes(v.fit.problem)][:MOST_SHAPED]
        self.shaped.update(v.terms for v in taken)
        return taken

    def refit_subset(self, term_set: TermSet) -> Fit | None:
        """Return the fit of a set with initial states that are smoothed with its terms; None if it has been refitted.

        It is needed only where no sensor shows the position, and the nominal model has it from the beginning.
        """
        if not term_set.terms or term_set.terms in self.own or not lacks_position(term_set.fit.problem):
            return None
        self.own.add(term_set.terms)
        return refit_start_in_play(term_set.fit)


def _is_enough(less: TermSet, more: TermSet) -> bool:
    """Return whether a set is a subset of another one, or has simpler laws in it and no random force remains."""
    extra, dropped = less.terms - more.terms, more.terms - less.terms
    if not extra:
        return bool(dropped)
    if len(extra) > len(dropped) or not has_usual_random_force(more.fit):
        return False
    laws = [[find_term(more.fit.problem, key)[0] for key in sorted(keys)] for keys in (extra, dropped)]
    return all(any(is_simpler(one, other) for other in laws[1]) for one in laws[0])


def refit_with_terms(fit: Fit) -> Fit:
    """Return the fit on one core from two other noise levels, and with initial states that are smoothed with its terms.

    It begins at a larger random force, and with the residuals as measurement noise and no random force. A fit without
    a random force beyond the usual begins where it is.
    """
    fit = use_one_core(fit)
    if not has_usual_random_force(fit):
        warm = maximise(fit.problem, raise_random_force(fit.problem, fit.theta, 6.0))
        fit = max(warm, refit_with_noise(fit), key=lambda found: found.local.log_posterior)
    return refit_start_in_play(fit)


def refit_from(fit: Fit, other: Fit) -> Fit:
    """Return the fit on one core from the coordinates, where they are the same, and initial states of another one."""
    theta, keys = fit.theta.copy(), other.problem.keys
    for i, key in enumerate(fit.problem.keys):
        if key in keys:
            theta[i] = other.theta[keys.index(key)]
    problem = use_one_core(fit).problem.on(other.problem.observations)
    return maximise(problem, problem.clip(theta))


def refit_without(fit: Fit, key: str) -> Fit:
    """Return the fit without one term, with the best choices of the shapes of the others."""
    less = maximise(fit.problem.remove_term(key, fit.values))
    return refit_choices(less, less.problem.active)


def _have_other_noise(one: Fit, other: Fit) -> bool:
    """Return whether a noise level differs by more than a factor e."""
    levels = {f.key for f in one.problem.free if f.level in LEVELS} & set(other.values)
    return any(abs(one.values[key] - other.values[key]) > 1.0 for key in levels)
