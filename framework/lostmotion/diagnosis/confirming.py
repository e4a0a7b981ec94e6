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
from lostmotion.diagnosis.compare import HeldOutStretch, confirmed, pieces_of, run_errors
from lostmotion.diagnosis.findings import Outcome
from lostmotion.diagnosis.search import Diagnosed
from lostmotion.inference.course import Selection, Simplest, Visit
from lostmotion.inference.fit import Fit
from lostmotion.inference.learned import OverTime
from lostmotion.inference.leftovers import quiet
from lostmotion.inference.natural import term_of
from lostmotion.inference.rival import Righted
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import filtered
from lostmotion.likelihood.problem import RANDOM
from lostmotion.quantities import TIME
from lostmotion.results import percent, rounded

ASKED = 3
"""So many sets of each size are asked what they predict."""


def unconfirmed(outcome: Outcome, observations: Sequence[Observation]) -> dict[str, str]:
    """Return a sentence on each found term that is no more than likely, by key; none where the model is right else.

    It is not right where a random force is left, or where smooth forces or flaws of channels promise much beside what
    was found, each sample counting as one.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.visits.get(selection.chosen.problem.active)
    if here is None or _right(d, here):
        return {}
    pieces, told = pieces_of(observations, d.held), {}
    errors = run_errors(here.fit, pieces, outcome.horizon)
    for key in (key for key in d.named if key in here.terms):
        less = selection.visits.get(here.terms - {key})
        without = run_errors(less.fit, pieces, outcome.horizon) if less else None
        if sentence := usual(d, key):
            told[key] = sentence
        elif without is not None and not confirmed(errors, without, d.settings.heldout.chance):
            told[key] = (
                "The model is not right in other ways too, and free runs over held-out data are better with it in"
                f" {int(np.sum(errors < without))} of {len(errors)} parts only (they err by"
                f" {percent(_whole(errors), 3)} of the"
                f" response with it and by {percent(_whole(without), 3)} without it), which is within chance."
            )
    return told


def predicted_better(outcome: Outcome, observations: Sequence[Observation]) -> Fit | None:
    """Return the fit of another set of no more terms that predicts held-out data better than the chosen one, or None.

    Sets of terms may explain what they were fitted to equally well where the model is not right in other ways too;
    what they predict then decides. The best sets of each size are asked, and have to be better by more than chance.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.visits.get(selection.chosen.problem.active)
    if d.learned or here is None or _right(d, here):
        return None
    pieces, others = pieces_of(observations, d.held), _others(d, here)
    errors = run_errors(here.fit, pieces, outcome.horizon)
    rivals = [(visit, run_errors(visit.fit, pieces, outcome.horizon)) for visit in others]
    better = [(v, e) for v, e in rivals if confirmed(e, errors, d.settings.heldout.chance / len(rivals))]
    return min(better, key=lambda rival: _whole(rival[1]))[0].fit if better else None


def decided(outcome: Outcome, observations: Sequence[Observation]) -> tuple[Fit, Mapping[frozenset[str], float]] | None:
    """Return the fit of a set with one more term for which held-out data decide, and what sets win there; or None.

    On the fitted data a small smooth force without a name explains about as much as such a term. Both are asked for the
    log score of one-step predictions of held-out data, which is added to the log odds of the fitted data: this is what
    the posterior of all data would be, parameters left where they are. The smooth force, the learned curves and the
    chosen set itself stand against a term, whichever scores best; so does a smooth force beside channels put right.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.visits.get(selection.chosen.problem.active)
    if here is None or _over_time(selection, here):
        return None
    decisive, behind = d.settings.select.decisive, d.settings.heldout.behind
    unbeaten = [v for v in _unbeaten(selection, here, decisive) if selection.lead(v, here) > -behind]
    for visit in unbeaten:
        selection.check(visit)
    close = [v for v in unbeaten if selection.lead(v, here) > -behind]
    close = sorted(close, key=lambda v: -selection.lead(v, here))[:ASKED]
    if not close:
        return None
    pieces, rival = pieces_of(observations, d.held), selection.won(here)
    against = [here.fit, *([rival.fit] if rival else ()), *([d.learned.fit] if d.learned else ())]
    bar = max(_scored(fit, pieces) for fit in against)
    if rival and rival.right:
        bar = max(bar, _righted(rival.right, pieces))
    worse = selection.expansion(here).worse
    won = {v.terms: (_scored(v.fit, pieces) - bar) / worse for v in close}
    best = max(close, key=lambda v: selection.lead(v, here) + won[v.terms])
    if not selection.lead(best, here) + won[best.terms] - math.log(len(close)) > decisive:
        return None
    return best.fit, won


def find_simplest(outcome: Outcome, observations: Sequence[Observation]) -> tuple[Fit, Simplest] | None:
    """Return the fit of the terms that are the simplest explanation, with the probability of each; None without any.

    It is asked where no set is ahead of a generic smooth force. A set qualifies when no random force is left with it,
    when its log evidence, less the penalties of its terms, exceeds that of the best learned curve, of the chosen set,
    and of the usual errors of known values and channels, and when it predicts held-out data as well as the best of
    them. It does not extend terms that were chosen: these stand on their own. Its terms are reported as likely: a
    smooth force without a name explains about as much.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.visits.get(selection.chosen.problem.active)
    if here is None or not (d.learned or selection.unbeaten or d.unexplained):
        return None
    decisive, usual = d.settings.select.decisive, selection.expansion(here)
    curve = d.learned.gain if d.learned else 0.0
    least = here.weight + max(curve, decisive + max(usual.bare(usual.worse), 0.0))
    sets = _simpler_sets(selection, here)
    good = sorted((v for v in sets if v.weight > least), key=lambda v: -v.weight)[:ASKED]
    best = _predicting(outcome, good, pieces_of(observations, d.held), decisive * usual.worse) if good else None
    if best is None:
        return None
    weights = [(v.terms, v.weight) for v in sets] + [(here.terms, here.weight + curve)]
    total = float(np.logaddexp.reduce([weight for _, weight in weights]))
    keys = sorted({key for terms, _ in weights for key in terms})
    shares = {key: sum(math.exp(weight - total) for terms, weight in weights if key in terms) for key in keys}
    return best.fit, Simplest({key: d.settings.name.simplest * share for key, share in shares.items()}, curve)


def _predicting(
    outcome: Outcome, sets: Sequence[Visit], pieces: Sequence[HeldOutStretch], slack: float
) -> Visit | None:
    """Return the first set that predicts held-out data better than the chosen one, and as well as a smooth force.

    Its log score of one-step predictions may be behind that of the best smooth force by the `slack`; its free runs may
    not err more than those of the present model by more than chance.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.visits[selection.chosen.problem.active]
    rival, own = selection.won(here), _scored(here.fit, pieces)
    others = [*([rival.fit] if rival else ()), *([d.learned.fit] if d.learned else ())]
    bar = max([own, *(_scored(fit, pieces) for fit in others)]) - slack
    errors = run_errors(d.after, pieces, outcome.horizon)
    for visit in sets:
        score, its = _scored(visit.fit, pieces), run_errors(visit.fit, pieces, outcome.horizon)
        if own < score > bar and not confirmed(errors, its, d.settings.heldout.chance):
            return visit
    return None


def _simpler_sets(selection: Selection, here: Visit) -> list[Visit]:
    """Return the visited sets that leave no random force, without terms that are not decisive or usual in channels.

    Neither the chosen set nor a part of it is among them, nor one that only adds to chosen terms.
    """
    barred, settings = selection.declined | selection.withdrawn, selection.nominal.problem.settings

    def qualifies(visit: Visit) -> bool:
        if visit.terms <= here.terms or (here.terms and visit.terms > here.terms) or visit.terms & barred:
            return False
        if visit.fit.status == "diverged" or not quiet(visit.fit):
            return False
        parts = (selection.visits.get(visit.terms - {key}) for key in visit.terms)
        decisive = all(visit.weight > part.weight + settings.select.decisive for part in parts if part)
        return decisive and all(_delay_in_samples(visit.fit, key) > settings.rival.late for key in visit.terms)

    return [v for v in selection.visits.values() if qualifies(v)]


def _over_time(selection: Selection, here: Visit) -> bool:
    """Return whether the smooth force beside a set is one over time: nobody knows how that goes on."""
    rival = selection.won(here)
    return rival is not None and any(OverTime.name in key for key in rival.fit.problem.active)


def _unbeaten(selection: Selection, here: Visit, decisive: float) -> list[Visit]:
    """Return the sets with one force more than a chosen one that win by evidence, and not over a smooth force.

    Flaws of channels are not among them: the usual ones are a part of what stands against a name.
    """
    keys = [k for k in sorted(selection.unbeaten - here.terms) if term_of(here.fit.problem, k)[0].acts == "motion"]
    more = [here.terms | {key} for key in keys]
    sets = [selection.visits[terms] for terms in more if terms in selection.visits]
    return [v for v in sets if v.fit.status != "diverged" and v.weight > here.weight + decisive]


def _scored(fit: Fit, pieces: Sequence[HeldOutStretch]) -> float:
    """Return the log score of one-step predictions of held-out data; minus infinity where a filter runs away."""
    total = 0.0
    for piece in pieces:
        seen = filtered(fit.problem.on((piece.observation,)), fit.theta)
        total += seen.log_score(slice(piece.begin, None)) * (piece.observation.samples - piece.begin)
    return total if math.isfinite(total) else -math.inf


def _righted(right: Righted, pieces: Sequence[HeldOutStretch]) -> float:
    """Return the log score of a smooth force where channels are put right, in the units of the readings as they are."""
    held = sum(piece.observation.samples - piece.begin for piece in pieces)
    wider = right.wider * held / right.fit.problem.samples
    return _scored(right.fit, [replace(p, observation=right.put_right(p.observation)) for p in pieces]) + wider


def _others(d: Diagnosed, here: Visit) -> list[Visit]:
    """Return the sets of most weight of each size up to that of a chosen one, but for this one and the empty set.

    One that wins a small share of what the chosen one wins on the fitted data does not explain these, nor does one
    that leaves more of a random force than the nominal model.
    """
    selection, found = d.selection, list[Visit]()
    nothing = selection.visits[frozenset()].weight
    least = nothing + d.settings.heldout.explains * max(here.weight - nothing, 0.0)
    for size in range(1, len(here.terms) + 1):
        same = [v for v in selection.visits.values() if len(v.terms) == size and v.terms != here.terms]
        same = [v for v in same if v.fit.status != "diverged" and not v.terms & selection.declined]
        same = [v for v in same if v.weight > least and _level(v.fit) <= _level(selection.nominal)]
        found += sorted(same, key=lambda v: -v.weight)[:ASKED]
    return found


def _level(fit: Fit) -> float:
    """Return the log level of the random force of a fit; minus infinity where it has none."""
    keys = fit.problem.keys
    return float(fit.theta[keys.index(RANDOM)]) if RANDOM in keys else -math.inf


def _right(d: Diagnosed, here: Visit) -> bool:
    """Return whether nothing else is wrong with the model beside what was found, each sample counting as one."""
    if not here.terms:
        return True
    return not d.unexplained and not d.selection.expansion(here).promise(1.0).gain > d.settings.rival.much


def usual(d: Diagnosed, key: str) -> str:
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
    term, slots = term_of(fit.problem, key)
    late = [s for s in slots if s.param.dimension == TIME and s.key in fit.values]
    if term.acts == "motion" or not late:
        return math.inf
    return abs(fit.values[late[0].key]) / fit.problem.observations[0].dt


def _whole(errors: Array) -> float:
    return math.sqrt(float(np.mean(errors**2)))
