"""Checks of a selection on held-out data, where the model is wrong in other ways too.

The evidence for a term then grows with every sample, even if the term is wrong; its predictions do not improve. A found
term must therefore make free runs over held-out data better, and a delay must be longer than is usual in acquisition
systems.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.compare import compute_run_errors, cut_heldout, is_better
from lostmotion.diagnosis.findings import Outcome
from lostmotion.diagnosis.predictive import HeldOutStretch, score_heldout
from lostmotion.diagnosis.search import SearchResult
from lostmotion.diagnosis.states import delay_in_samples
from lostmotion.inference.channel_correction import CorrectedFit
from lostmotion.inference.fit import Fit
from lostmotion.inference.learned import OverTime
from lostmotion.inference.natural import find_term
from lostmotion.inference.random_force import compute_random_force_gain
from lostmotion.inference.robustness import RobustChecks
from lostmotion.inference.term_sets import Selection, SimplestTerms, TermSet
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.problem import RANDOM
from lostmotion.results import percent, rounded
from lostmotion.settings import HeldOutSettings

MOST_COMPARED = 3
"""The number of sets, of each size, whose predictions are compared."""


def find_unconfirmed(outcome: Outcome, observations: Sequence[Observation]) -> dict[str, str]:
    """Return a warning for each found term that held-out data do not confirm, by key; none where the model is adequate.

    The model is inadequate if a random force remains, or if smooth forces or channel errors predict a large gain beside
    the found terms (without a correction for autocorrelation).
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets.get(selection.chosen.problem.active)
    if here is None or _is_adequate(d, here):
        return {}
    pieces, warnings = cut_heldout(observations, d.held), {}
    errors = compute_run_errors(here.fit, pieces, outcome.horizon)
    for key in (key for key in d.named if key in here.terms):
        less = selection.fitted_sets.get(here.terms - {key})
        without = compute_run_errors(less.fit, pieces, outcome.horizon) if less else None
        if sentence := describe_usual_delay(d, key):
            warnings[key] = sentence
        elif without is not None and not is_better(errors, without, d.settings.heldout.chance):
            warnings[key] = (
                "The model is wrong in other ways too, and free runs over held-out data are not significantly better"
                f" with this term: they are better in {int(np.sum(errors < without))} of {len(errors)} parts (error"
                f" {percent(_compute_rms(errors), 3)} of the response with it,"
                f" {percent(_compute_rms(without), 3)} without it)."
            )
    return warnings


def find_better_set(
    outcome: Outcome, observations: Sequence[Observation]
) -> tuple[Fit, Mapping[frozenset[str], float]] | None:
    """Return the fit of another set that predicts held-out data better than the chosen one, with its held-out gain.

    Where the model is wrong in other ways too, several sets may explain the fitted data equally well; their predictions
    then decide. The best sets of each size, of no more terms, are compared by paired t tests (Bonferroni), and the
    error must be smaller by more than `HeldOutSettings.rise`. None means that there is no such set. The gain is over
    the nominal model, alone or with a smooth force; a negative one counts as zero, because free runs decide here.
    Sets that free runs refute, and those that were not compared, have an infinite loss.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets.get(selection.chosen.problem.active)
    if d.learned or here is None or _is_adequate(d, here):
        return None
    pieces, others = cut_heldout(observations, d.held), _list_alternatives(d, here)
    errors = compute_run_errors(here.fit, pieces, outcome.horizon)
    rivals = [(term_set, compute_run_errors(term_set.fit, pieces, outcome.horizon)) for term_set in others]
    better = [(v, e) for v, e in rivals if _is_clearly_better(e, errors, d.settings.heldout, len(rivals))]
    if not better:
        return None
    best, lowest = min(better, key=lambda rival: _compute_rms(rival[1]))
    nothing = selection.fitted_sets[frozenset()]
    gains = _measure_heldout_gains(d, [best], nothing, pieces)
    equal = {v.terms for v, e in rivals if not _is_clearly_better(lowest, e, d.settings.heldout, len(rivals))}
    refuted = set(selection.fitted_sets) - equal - {nothing.terms, here.terms}
    return best.fit, {
        **dict.fromkeys(refuted, -math.inf),
        **{terms: max(gain, 0.0) for terms, gain in gains.items()},
    }


def _measure_heldout_gains(
    d: SearchResult, sets: Sequence[TermSet], base: TermSet, pieces: Sequence[HeldOutStretch]
) -> dict[frozenset[str], float]:
    """Return the log scores of held-out data of sets less the best of a basic set, alone or with what is smooth."""
    selection, rival = d.selection, d.selection.discrepancy_fit(base)
    against = [base.fit, *([rival.fit] if rival else ()), *([d.learned.fit] if d.learned else ())]
    bar = max(score_heldout(fit, pieces) for fit in against)
    if rival and rival.corrected:
        bar = max(bar, _score_corrected(rival.corrected, pieces))
    inflation = selection.expansion(base).inflation
    return {v.terms: (score_heldout(v.fit, pieces) - bar) / inflation for v in sets}


def decide_by_heldout(
    outcome: Outcome, observations: Sequence[Observation]
) -> tuple[Fit, Mapping[frozenset[str], float]] | None:
    """Return the fit of a set with one more term for which held-out data decide, and held-out gains of sets; or None.

    On the fitted data a small smooth force explains about as much as such a term. The log score of the held-out data is
    added to the log odds of the fitted data; the sum is the log posterior odds of all data. A set is compared with the
    best of: the smooth force, the smooth force with corrected channels, the learned curves, and the set without the
    term. Where a term of the chosen set is not supported beside the further term, the further term takes its place.
    Nothing is decided for a term if a usual error of a channel explains all data better.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets.get(selection.chosen.problem.active)
    if here is None or _has_force_over_time(selection, here):
        return None
    decisive, behind = d.settings.select.decisive, d.settings.heldout.behind
    further = [_drop_unsupported(selection, v, here) for v in _list_tied(selection, here, decisive)]
    further = [v for v in further if v.term_set.weight > v.without.weight + decisive]
    unbeaten = [v for v in further if selection.compute_log_odds(*v) > -behind]
    for v in unbeaten:
        selection.fit_discrepancy(v.term_set)
    close = [v for v in unbeaten if selection.compute_log_odds(*v) > -behind]
    close = sorted(close, key=lambda v: -selection.compute_log_odds(*v))[:MOST_COMPARED]
    if not close:
        return None
    channels = _list_tied(selection, here, decisive, channels=True)
    pieces, measured = cut_heldout(observations, d.held), dict[frozenset[str], dict[frozenset[str], float]]()
    for base in {v.without.terms: v.without for v in close}.values():
        sets = [v.term_set for v in close if v.without is base]
        measured[base.terms] = _measure_heldout_gains(d, [*sets, *channels], base, pieces)
    gains = {v.term_set.terms: measured[v.without.terms][v.term_set.terms] for v in close}
    best = max(close, key=lambda v: selection.compute_log_odds(*v) + gains[v.term_set.terms])
    gain, rivals = gains[best.term_set.terms], measured[best.without.terms]
    if not selection.compute_log_odds(*best) + gain - math.log(len(close)) > decisive:
        return None
    if any(v.weight + rivals[v.terms] > best.term_set.weight + gain for v in channels):
        return None
    return best.term_set.fit, gains


class FurtherTerm(NamedTuple):
    """A fitted set with a term that evidence supports, and the set without the term."""

    term_set: TermSet
    without: TermSet


def _drop_unsupported(selection: Selection, term_set: TermSet, here: TermSet) -> FurtherTerm:
    """Return a set with a further term, or its fitted subset with the term that has a larger weight.

    A term that was chosen first may stand for the further one: a dead zone of the drive, for an end stop.
    """
    more, known = term_set.terms - here.terms, selection.fitted_sets
    subsets = [v for terms, v in known.items() if more <= terms <= term_set.terms and terms - more in known]
    best = max((v for v in subsets if v.fit.status != "diverged"), key=lambda v: v.weight)
    return FurtherTerm(best, known[best.terms - more])


def find_simplest(outcome: Outcome, observations: Sequence[Observation]) -> tuple[Fit, SimplestTerms] | None:
    """Return the fit of the set of terms that is the simplest explanation, with their probabilities; None without any.

    It is used where no set is better than a generic smooth force. A set qualifies if no random force remains with it,
    if its log evidence less the prior penalties exceeds that of the best learned curve, of the chosen set, and of the
    usual errors of known values and channels (as predicted, or as fitted if that is less), and if it predicts held-out
    data as well as the best of them. It is no extension of chosen terms, and no other such set is decisively better.
    Its terms are reported as likely, because a smooth force explains about as much, and only if no other term is about
    as probable. Sets that predict held-out data worse have no probability.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets.get(selection.chosen.problem.active)
    if here is None or not (d.learned or selection.tied or d.unexplained):
        return None
    decisive, usual = d.settings.select.decisive, selection.expansion(here)
    curve = d.learned.gain if d.learned else 0.0
    gain, fitted = usual.compute_fixed_gain(usual.inflation), selection.discrepancy_fit(here)
    gain = min(gain, fitted.compute_gain(usual.inflation)) if fitted else gain
    least = here.weight + max(curve, decisive + max(gain, 0.0))
    sets = _list_simple_sets(selection, here)
    good = sorted((v for v in sets if v.weight > least), key=lambda v: -v.weight)[:MOST_COMPARED]
    good = [v for v in good if v.weight > good[0].weight - decisive]
    good = [v for v in good if compute_random_force_gain(v.fit) <= d.settings.locate.significant]
    best = (
        _select_predicting(outcome, good, cut_heldout(observations, d.held), decisive * usual.inflation)
        if good
        else None
    )
    if best is None:
        return None
    refuted = good[: good.index(best)]
    weights = [(v.terms, v.weight) for v in sets if v not in refuted] + [(here.terms, here.weight + curve)]
    total = float(np.logaddexp.reduce([weight for _, weight in weights]))
    keys = sorted({key for terms, _ in weights for key in terms})
    shares = {key: sum(math.exp(weight - total) for terms, weight in weights if key in terms) for key in keys}
    if any(shares[key] < d.settings.name.simplest_share for key in best.terms):
        return None
    most, nothing = d.settings.name.simplest, selection.fitted_sets[frozenset()].weight
    known = most * sum(math.exp(weight - total) for _, weight in weights[:-1])
    bare = most * math.exp(min(nothing - total, 0.0))
    stated = {key: most * share for key, share in shares.items()}
    return best.fit, SimplestTerms(stated, curve, unknown=1.0 - known - bare, nothing=bare)


def _select_predicting(
    outcome: Outcome, sets: Sequence[TermSet], pieces: Sequence[HeldOutStretch], slack: float
) -> TermSet | None:
    """Return the first set that predicts held-out data better than the chosen one, and as well as a smooth force.

    Its log score may be lower than that of the best smooth force by `slack`; its free runs must not be worse than those
    of the present model, significantly and by more than `HeldOutSettings.rise`.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets[selection.chosen.problem.active]
    rival, own = selection.discrepancy_fit(here), score_heldout(here.fit, pieces)
    others = [*([rival.fit] if rival else ()), *([d.learned.fit] if d.learned else ())]
    bar = max([own, *(score_heldout(fit, pieces) for fit in others)]) - slack
    for term_set in sets:
        score, its = score_heldout(term_set.fit, pieces), compute_run_errors(term_set.fit, pieces, outcome.horizon)
        if own < score > bar and not _is_clearly_better(outcome.after.errors, its, d.settings.heldout):
            return term_set
    return None


def _list_simple_sets(selection: Selection, here: TermSet) -> list[TermSet]:
    """Return the fitted sets in which each term is decisive.

    The chosen set, its subsets and, if it has terms, its extensions are left out, and sets of several terms with a
    delay that is usual in acquisition systems.
    """
    barred, settings = selection.declined | selection.withdrawn, selection.nominal.problem.settings

    def qualifies(term_set: TermSet) -> bool:
        if term_set.terms <= here.terms or (here.terms and term_set.terms > here.terms) or term_set.terms & barred:
            return False
        if term_set.fit.status == "diverged":
            return False
        parts = (selection.fitted_sets.get(term_set.terms - {key}) for key in term_set.terms)
        decisive = all(term_set.weight > part.weight + settings.select.decisive for part in parts if part)
        usual = [key for key in term_set.terms if not delay_in_samples(term_set.fit, key) > settings.rival.late]
        return decisive and (not usual or len(term_set.terms) == 1)

    return [v for v in selection.fitted_sets.values() if qualifies(v)]


def _has_force_over_time(selection: Selection, here: TermSet) -> bool:
    """Return whether the smooth force beside a set depends on time: it cannot be extrapolated to held-out data."""
    rival = selection.discrepancy_fit(here)
    return rival is not None and any(OverTime.name in key for key in rival.fit.problem.active)


def _list_tied(selection: Selection, here: TermSet, decisive: float, *, channels: bool = False) -> list[TermSet]:
    """Return the sets with one more term that evidence supports, but that are not better than a smooth force.

    With `channels` it is a usual error of a channel, which is a part of the discrepancy; otherwise any other term.
    """
    keys = sorted(selection.tied - here.terms)
    keys = [k for k in keys if find_term(here.fit.problem, k)[0].usual == channels]
    more = [here.terms | {key} for key in keys]
    sets = [selection.fitted_sets[terms] for terms in more if terms in selection.fitted_sets]
    return [v for v in sets if v.fit.status != "diverged" and v.weight > here.weight + decisive]


def _score_corrected(right: CorrectedFit, pieces: Sequence[HeldOutStretch]) -> float:
    """Return the log score of a smooth force with corrected channels, as a density of the uncorrected readings."""
    held = sum(piece.observation.samples - piece.begin for piece in pieces)
    wider = right.log_jacobian * held / right.fit.problem.samples
    return score_heldout(right.fit, [replace(p, observation=right.correct(p.observation)) for p in pieces]) + wider


def _list_alternatives(d: SearchResult, here: TermSet) -> list[TermSet]:
    """Return the other sets of largest weight of each size up to that of the chosen one, and the most probable ones.

    A set is left out if its gain on the fitted data is a small share of that of the chosen set, if its random force is
    larger than that of the nominal model, or if one of its terms is not significant.
    """
    selection, found = d.selection, list[TermSet]()
    checks = RobustChecks(d.settings.select)
    probable = {terms: p for terms, p in selection.probabilities().items() if p > d.settings.name.rival}
    nothing = selection.fitted_sets[frozenset()].weight
    least = nothing + d.settings.heldout.explains * max(here.weight - nothing, 0.0)
    for size in range(1, len(here.terms) + 1):
        same = [v for v in selection.fitted_sets.values() if len(v.terms) == size and v.terms != here.terms]
        same = [v for v in same if v.fit.status != "diverged" and not v.terms & selection.declined]
        same = [v for v in same if v.weight > least and _log_intensity(v.fit) <= _log_intensity(selection.nominal)]
        same = sorted(same, key=lambda v: (-probable.get(v.terms, 0.0), -v.weight))
        found += list(itertools.islice((v for v in same if not checks.list_vague(v)), MOST_COMPARED))
    return found


def _log_intensity(fit: Fit) -> float:
    """Return the log intensity of the random force of a fit; minus infinity if it has none."""
    keys = fit.problem.keys
    return float(fit.theta[keys.index(RANDOM)]) if RANDOM in keys else -math.inf


def _is_adequate(d: SearchResult, here: TermSet) -> bool:
    """Return whether the model is adequate with the found terms (without a correction for autocorrelation)."""
    if not here.terms:
        return True
    return not d.unexplained and not d.selection.expansion(here).find_best(1.0).gain > d.settings.rival.much


def describe_usual_delay(d: SearchResult, key: str) -> str:
    """Return a warning on a delay that is usual in acquisition systems; empty for longer delays and other terms."""
    samples = delay_in_samples(d.after, key)
    if not samples <= d.settings.rival.late:
        return ""
    return (
        f"A delay of {rounded(samples)} samples is usual in acquisition systems, and the model is"
        " wrong in other ways too."
    )


def _is_clearly_better(errors: Array, without: Array, limits: HeldOutSettings, many: int = 1) -> bool:
    """Return whether errors (PARTS,) are smaller, significantly and by more than `rise`; one of `many` comparisons."""
    smaller = (1.0 + limits.rise) * _compute_rms(errors) < _compute_rms(without)
    return smaller and is_better(errors, without, limits.chance / many)


def _compute_rms(errors: Array) -> float:
    return math.sqrt(float(np.mean(errors**2)))
