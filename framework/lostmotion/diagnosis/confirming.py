"""What has to be confirmed before it is named, where the model is not right in other ways too.

There evidence grows with every sample, whatever the term; a prediction does not. So what was found must make free runs
over held-out data better, and a flaw of a channel must be larger than acquisition systems have as a rule.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.compare import HeldOutStretch, compute_run_errors, cut_heldout, is_better
from lostmotion.diagnosis.findings import Outcome
from lostmotion.diagnosis.search import SearchResult
from lostmotion.inference.fit import Fit
from lostmotion.inference.learned import OverTime
from lostmotion.inference.natural import find_term
from lostmotion.inference.random_force import has_usual_random_force
from lostmotion.inference.rival import CorrectedFit
from lostmotion.inference.term_sets import Selection, SimplestTerms, TermSet
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import filter_recording
from lostmotion.likelihood.problem import RANDOM
from lostmotion.quantities import TIME
from lostmotion.results import percent, rounded

MOST_COMPARED = 3
"""So many sets of each size are asked what they predict."""


def find_unconfirmed(outcome: Outcome, observations: Sequence[Observation]) -> dict[str, str]:
    """Return a sentence on each found term that is no more than likely, by key; none where the model is right else.

    It is not right where a random force is left, or where smooth forces or flaws of channels promise much beside what
    was found, each sample counting as one.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets.get(selection.chosen.problem.active)
    if here is None or _is_adequate(d, here):
        return {}
    pieces, told = cut_heldout(observations, d.held), {}
    errors = compute_run_errors(here.fit, pieces, outcome.horizon)
    for key in (key for key in d.named if key in here.terms):
        less = selection.fitted_sets.get(here.terms - {key})
        without = compute_run_errors(less.fit, pieces, outcome.horizon) if less else None
        if sentence := describe_usual_delay(d, key):
            told[key] = sentence
        elif without is not None and not is_better(errors, without, d.settings.heldout.chance):
            told[key] = (
                "The model is not right in other ways too, and free runs over held-out data are better with it in"
                f" {int(np.sum(errors < without))} of {len(errors)} parts only (they err by"
                f" {percent(_compute_rms(errors), 3)} of the"
                f" response with it and by {percent(_compute_rms(without), 3)} without it), which is within chance."
            )
    return told


def find_better_set(outcome: Outcome, observations: Sequence[Observation]) -> Fit | None:
    """Return the fit of another set of no more terms that predicts held-out data better than the chosen one, or None.

    Sets of terms may explain what they were fitted to equally well where the model is not right in other ways too;
    what they predict then decides. The best sets of each size are asked, and have to be better by more than chance.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets.get(selection.chosen.problem.active)
    if d.learned or here is None or _is_adequate(d, here):
        return None
    pieces, others = cut_heldout(observations, d.held), _list_alternatives(d, here)
    errors = compute_run_errors(here.fit, pieces, outcome.horizon)
    rivals = [(term_set, compute_run_errors(term_set.fit, pieces, outcome.horizon)) for term_set in others]
    better = [(v, e) for v, e in rivals if is_better(e, errors, d.settings.heldout.chance / len(rivals))]
    return min(better, key=lambda rival: _compute_rms(rival[1]))[0].fit if better else None


def decide_by_heldout(
    outcome: Outcome, observations: Sequence[Observation]
) -> tuple[Fit, Mapping[frozenset[str], float]] | None:
    """Return the fit of a set with one more term for which held-out data decide, and what sets win there; or None.

    On the fitted data a small smooth force without a name explains about as much as such a term. Both are asked for the
    log score of one-step predictions of held-out data, which is added to the log odds of the fitted data: this is what
    the posterior of all data would be, parameters left where they are. The smooth force, the learned curves and the
    chosen set itself stand against a term, whichever scores best; so does a smooth force beside channels put right.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets.get(selection.chosen.problem.active)
    if here is None or _has_force_over_time(selection, here):
        return None
    decisive, behind = d.settings.select.decisive, d.settings.heldout.behind
    unbeaten = [v for v in _list_tied(selection, here, decisive) if selection.compute_log_odds(v, here) > -behind]
    for term_set in unbeaten:
        selection.fit_discrepancy(term_set)
    close = [v for v in unbeaten if selection.compute_log_odds(v, here) > -behind]
    close = sorted(close, key=lambda v: -selection.compute_log_odds(v, here))[:MOST_COMPARED]
    if not close:
        return None
    pieces, rival = cut_heldout(observations, d.held), selection.discrepancy_fit(here)
    against = [here.fit, *([rival.fit] if rival else ()), *([d.learned.fit] if d.learned else ())]
    bar = max(_score_heldout(fit, pieces) for fit in against)
    if rival and rival.corrected:
        bar = max(bar, _score_corrected(rival.corrected, pieces))
    inflation = selection.expansion(here).inflation
    won = {v.terms: (_score_heldout(v.fit, pieces) - bar) / inflation for v in close}
    best = max(close, key=lambda v: selection.compute_log_odds(v, here) + won[v.terms])
    if not selection.compute_log_odds(best, here) + won[best.terms] - math.log(len(close)) > decisive:
        return None
    return best.fit, won


def find_simplest(outcome: Outcome, observations: Sequence[Observation]) -> tuple[Fit, SimplestTerms] | None:
    """Return the fit of the terms that are the simplest explanation, with the probability of each; None without any.

    It is asked where no set is ahead of a generic smooth force. A set qualifies when no random force is left with it,
    when its log evidence, less the penalties of its terms, exceeds that of the best learned curve, of the chosen set,
    and of the usual errors of known values and channels, and when it predicts held-out data as well as the best of
    them. It does not extend terms that were chosen: these stand on their own. Its terms are reported as likely: a
    smooth force without a name explains about as much.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets.get(selection.chosen.problem.active)
    if here is None or not (d.learned or selection.tied or d.unexplained):
        return None
    decisive, usual = d.settings.select.decisive, selection.expansion(here)
    curve = d.learned.gain if d.learned else 0.0
    least = here.weight + max(curve, decisive + max(usual.compute_fixed_gain(usual.inflation), 0.0))
    sets = _list_simple_sets(selection, here)
    good = sorted((v for v in sets if v.weight > least), key=lambda v: -v.weight)[:MOST_COMPARED]
    best = (
        _select_predicting(outcome, good, cut_heldout(observations, d.held), decisive * usual.inflation)
        if good
        else None
    )
    if best is None:
        return None
    weights = [(v.terms, v.weight) for v in sets] + [(here.terms, here.weight + curve)]
    total = float(np.logaddexp.reduce([weight for _, weight in weights]))
    keys = sorted({key for terms, _ in weights for key in terms})
    shares = {key: sum(math.exp(weight - total) for terms, weight in weights if key in terms) for key in keys}
    return best.fit, SimplestTerms({key: d.settings.name.simplest * share for key, share in shares.items()}, curve)


def _select_predicting(
    outcome: Outcome, sets: Sequence[TermSet], pieces: Sequence[HeldOutStretch], slack: float
) -> TermSet | None:
    """Return the first set that predicts held-out data better than the chosen one, and as well as a smooth force.

    Its log score of one-step predictions may be behind that of the best smooth force by the `slack`; its free runs may
    not err more than those of the present model by more than chance.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.fitted_sets[selection.chosen.problem.active]
    rival, own = selection.discrepancy_fit(here), _score_heldout(here.fit, pieces)
    others = [*([rival.fit] if rival else ()), *([d.learned.fit] if d.learned else ())]
    bar = max([own, *(_score_heldout(fit, pieces) for fit in others)]) - slack
    errors = compute_run_errors(d.after, pieces, outcome.horizon)
    for term_set in sets:
        score, its = _score_heldout(term_set.fit, pieces), compute_run_errors(term_set.fit, pieces, outcome.horizon)
        if own < score > bar and not is_better(errors, its, d.settings.heldout.chance):
            return term_set
    return None


def _list_simple_sets(selection: Selection, here: TermSet) -> list[TermSet]:
    """Return the visited sets that leave no random force, without terms that are not decisive or usual in channels.

    Neither the chosen set nor a part of it is among them, nor one that only adds to chosen terms.
    """
    barred, settings = selection.declined | selection.withdrawn, selection.nominal.problem.settings

    def qualifies(term_set: TermSet) -> bool:
        if term_set.terms <= here.terms or (here.terms and term_set.terms > here.terms) or term_set.terms & barred:
            return False
        if term_set.fit.status == "diverged" or not has_usual_random_force(term_set.fit):
            return False
        parts = (selection.fitted_sets.get(term_set.terms - {key}) for key in term_set.terms)
        decisive = all(term_set.weight > part.weight + settings.select.decisive for part in parts if part)
        return decisive and all(_delay_in_samples(term_set.fit, key) > settings.rival.late for key in term_set.terms)

    return [v for v in selection.fitted_sets.values() if qualifies(v)]


def _has_force_over_time(selection: Selection, here: TermSet) -> bool:
    """Return whether the smooth force beside a set is one over time: nobody knows how that goes on."""
    rival = selection.discrepancy_fit(here)
    return rival is not None and any(OverTime.name in key for key in rival.fit.problem.active)


def _list_tied(selection: Selection, here: TermSet, decisive: float) -> list[TermSet]:
    """Return the sets with one force more than a chosen one that win by evidence, and not over a smooth force.

    Flaws of channels are not among them: the usual ones are a part of what stands against a name.
    """
    keys = [k for k in sorted(selection.tied - here.terms) if find_term(here.fit.problem, k)[0].acts == "motion"]
    more = [here.terms | {key} for key in keys]
    sets = [selection.fitted_sets[terms] for terms in more if terms in selection.fitted_sets]
    return [v for v in sets if v.fit.status != "diverged" and v.weight > here.weight + decisive]


def _score_heldout(fit: Fit, pieces: Sequence[HeldOutStretch]) -> float:
    """Return the log score of one-step predictions of held-out data; minus infinity where a filter runs away."""
    total = 0.0
    for piece in pieces:
        seen = filter_recording(fit.problem.on((piece.observation,)), fit.theta)
        total += seen.log_score(slice(piece.begin, None)) * (piece.observation.samples - piece.begin)
    return total if math.isfinite(total) else -math.inf


def _score_corrected(right: CorrectedFit, pieces: Sequence[HeldOutStretch]) -> float:
    """Return the log score of a smooth force where channels are put right, in the units of the readings as they are."""
    held = sum(piece.observation.samples - piece.begin for piece in pieces)
    wider = right.log_jacobian * held / right.fit.problem.samples
    return _score_heldout(right.fit, [replace(p, observation=right.correct(p.observation)) for p in pieces]) + wider


def _list_alternatives(d: SearchResult, here: TermSet) -> list[TermSet]:
    """Return the sets of most weight of each size up to that of a chosen one, but for this one and the empty set.

    One that wins a small share of what the chosen one wins on the fitted data does not explain these, nor does one
    that leaves more of a random force than the nominal model.
    """
    selection, found = d.selection, list[TermSet]()
    nothing = selection.fitted_sets[frozenset()].weight
    least = nothing + d.settings.heldout.explains * max(here.weight - nothing, 0.0)
    for size in range(1, len(here.terms) + 1):
        same = [v for v in selection.fitted_sets.values() if len(v.terms) == size and v.terms != here.terms]
        same = [v for v in same if v.fit.status != "diverged" and not v.terms & selection.declined]
        same = [v for v in same if v.weight > least and _log_intensity(v.fit) <= _log_intensity(selection.nominal)]
        found += sorted(same, key=lambda v: -v.weight)[:MOST_COMPARED]
    return found


def _log_intensity(fit: Fit) -> float:
    """Return the log level of the random force of a fit; minus infinity where it has none."""
    keys = fit.problem.keys
    return float(fit.theta[keys.index(RANDOM)]) if RANDOM in keys else -math.inf


def _is_adequate(d: SearchResult, here: TermSet) -> bool:
    """Return whether nothing else is wrong with the model beside what was found, each sample counting as one."""
    if not here.terms:
        return True
    return not d.unexplained and not d.selection.expansion(here).find_best(1.0).gain > d.settings.rival.much


def describe_usual_delay(d: SearchResult, key: str) -> str:
    """Return a sentence on a delay that is no longer than acquisition systems have as a rule; empty for all others."""
    samples = _delay_in_samples(d.after, key)
    if not samples <= d.settings.rival.late:
        return ""
    return (
        f"A delay of {rounded(samples)} samples is within what acquisition systems have as a rule, and the model is not"
        " right in other ways too."
    )


def _delay_in_samples(fit: Fit, key: str) -> float:
    """Return the delay or the lag of a channel in samples; infinity for other terms."""
    term, slots = find_term(fit.problem, key)
    late = [s for s in slots if s.param.dimension == TIME and s.key in fit.values]
    if term.acts == "motion" or not late:
        return math.inf
    return abs(fit.values[late[0].key]) / fit.problem.observations[0].dt


def _compute_rms(errors: Array) -> float:
    return math.sqrt(float(np.mean(errors**2)))
