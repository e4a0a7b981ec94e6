"""The last step of a blind trial: a diagnosis is compared with the opened truth of its case."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from lostmotion.errors import LostMotionError, PlaceError
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Candidate, Confusion, Diagnosis, HeldOutScores, Mechanism
from lostmotion.storage import load_result
from lostmotion_trials.blind.bound import (
    EQUIVALENT,
    LikelihoodBound,
    add_library_names,
    are_equivalent,
    compute_bound,
    is_covered,
)
from lostmotion_trials.blind.commitment import open_sealed
from lostmotion_trials.blind.mechanisms import TABLE
from lostmotion_trials.blind.pilot import Effect
from lostmotion_trials.blind.results import HeldAgainst, HeldOutJudged, JudgedCase, JudgedEffect, JudgedParameter
from lostmotion_trials.blind.sealed import SealedTruth
from lostmotion_trials.blind.simulator import BlindMachine

Named = Mechanism | Candidate | Confusion
"""What names a mechanism at a place."""
FAILED = "failed"
HIT, CONFUSED, NOTICED, MISNAMED, MISSED = "hit", "confused", "noticed", "misnamed", "missed"
OUTCOMES = (HIT, CONFUSED, NOTICED, MISNAMED, MISSED)
"""The outcomes of an effect: named; named as one that the diagnosis lists as indistinguishable from it; called unknown
or a random force; something else named; not noticed."""
VAGUE = ("unknown", "random_force")
NEVER_HIDDEN = ("friction_drift_travel", "friction_drift_twice")
"""Laws of dry friction that a trial does not hide."""
FRICTION_TERMS = (*(name for name, mechanism in TABLE.items() if mechanism.kin == "rub"), *NEVER_HIDDEN)
"""Laws of dry friction: where the true law has a random shape, each of these names is correct."""
FLAWS = ("sensor_quantisation",)
"""Imperfections of every machine of an imperfect world for which the library has a term."""
SURE = 0.95
"""A name is sure where its stated probability is above this."""
REPEATED = ("cosine", "sine")
"""Parameters that are not counted, since amplitude and phase contain them."""
TURNING = {"phase": ("depth", "amplitude")}
"""Angles, and the amplitudes whose sign turns them by half a turn."""


def score_case(out: Path, registry: Registry, number: int) -> JudgedCase:
    """Return the score of a case: each effect with its outcome, false names, parameters, held-out errors.

    Raises `DataError` when case or truth are not those that were sealed.
    """
    truth = open_sealed(out, number)
    place = out / "cases" / truth.case
    file = place / "diagnosis" / "diagnosis.json"
    answer = load_result(Diagnosis, file, "run the same command again") if file.exists() else None
    if truth.world:
        return _score_imperfect(answer, truth, truth.world.kind)
    bound_status = None
    try:
        prepared = prepare(place / "case.toml", registry)
        best = compute_bound(prepared, truth.machine, truth.effects, answer)
        places = len(prepared.model.places)
    except PlaceError:
        raise
    except (LostMotionError, ArithmeticError, ValueError) as err:
        best = LikelihoodBound((math.nan,) * len(truth.effects), ("failed",) * len(truth.effects))
        bound_status, places = " ".join(str(err).split()), 2 if truth.machine.model == "robot_joint" else 1
    each = zip(truth.effects, best.gains, best.status, strict=True)
    effects = tuple(_assume_missed(effect, gain, status) for effect, gain, status in each)
    return JudgedCase(
        case=truth.case,
        model=truth.machine.model,
        variant=truth.variant,
        margin=best.margin,
        bound_status=bound_status,
        verdict=answer.verdict if answer else FAILED,
        answer=_compare_answer(answer, effects, truth.machine, several=places > 1) if answer else HeldAgainst(effects),
        heldout=_judge_heldout(answer.fit, best) if answer else None,
    )


def _assume_missed(effect: Effect, gain: float, status: str) -> JudgedEffect:
    """Return an effect as it stands where nothing was said of it."""
    return JudgedEffect(**vars(effect), gain=gain, status=status, outcome=MISSED)


def _score_imperfect(answer: Diagnosis | None, truth: SealedTruth, kind: str) -> JudgedCase:
    """Return what became of a case in an imperfect world, where no model is true: nothing is held against a bound.

    Names that were stated with more than `SURE` are listed with whether what they name is there; an effect is `sure`
    where one of them names it.
    """
    several = truth.machine.model == "robot_joint"
    effects = tuple(_assume_missed(effect, math.nan, "no true model") for effect in truth.effects)
    make_row = partial(
        JudgedCase, case=truth.case, model=truth.machine.model, variant=truth.variant, margin=math.nan, kind=kind,
        heldout=None,
    )  # fmt: skip
    if answer is None:
        return make_row(verdict=FAILED, answer=HeldAgainst(tuple(replace(e, sure=False) for e in effects)), sure=())
    against = _compare_answer(answer, effects, truth.machine, several=several)
    named = [entry for entry in answer.found if entry.mechanism not in VAGUE]
    stated = [entry for entry in named if entry.probability > SURE and entry.state == "named"]
    sure = tuple((_format_name(entry), is_present(effects, entry, several=several)) for entry in stated)
    against = replace(
        against,
        effects=tuple(_mark_sure(e, named, stated, several=several) for e in against.effects),
        false=tuple(name for name, right in sure if not right),
        parameters=(),
        stated=tuple(_list_stated(answer.ranking, effects, several=several, rough=True)),
    )
    risen = answer.fit.after.nrmse - answer.fit.before.nrmse
    return make_row(verdict=answer.verdict, answer=against, sure=sure, worse=risen)


def is_same_kind(effect: Effect, entry: Named, *, several: bool) -> bool:
    """Return whether an entry names an effect, at its place; any law of friction names friction of a random shape."""
    if names_effect(effect, entry, several=several):
        return True
    as_named = replace(effect, mechanism=entry.mechanism)
    return {effect.mechanism, entry.mechanism} <= set(FRICTION_TERMS) and names_effect(as_named, entry, several=several)


def is_present(effects: Sequence[Effect], entry: Named, *, several: bool) -> bool:
    """Return whether what an entry names is in a machine of an imperfect world: hidden, or a flaw that each has."""
    return entry.mechanism in FLAWS or any(is_same_kind(e, entry, several=several) for e in effects)


def _mark_sure(
    effect: JudgedEffect, named: Sequence[Mechanism], stated: Sequence[Mechanism], *, several: bool
) -> JudgedEffect:
    """Return an effect with its outcome, and whether a sure name names it; any law of friction names friction."""
    hit = any(is_same_kind(effect, entry, several=several) for entry in named)
    sure = any(is_same_kind(effect, entry, several=several) for entry in stated)
    return replace(effect, outcome=HIT if hit else effect.outcome, sure=sure)


def _compare_answer(
    answer: Diagnosis, effects: Sequence[JudgedEffect], machine: BlindMachine, *, several: bool
) -> HeldAgainst:
    found = answer.found
    right = [entry for entry in found if any(names_effect(e, entry, several=several) for e in effects)]
    rows = [_find_outcome(e, answer, several=several) for e in effects]
    if len(right) == len(found):
        rows = [replace(row, outcome=MISSED) if row.outcome == MISNAMED else row for row in rows]
    exact = len(right) == len(found) and all(row.outcome == HIT for row in rows)
    return HeldAgainst(
        effects=tuple(rows),
        named=tuple(_format_name(entry) for entry in found),
        false=tuple(_format_name(entry) for entry in found if entry not in right),
        parameters=(
            *(
                row
                for e in effects
                for row in _judge_effect_parameters(add_library_names(e, machine), found, several=several)
            ),
            *(_judge_machine_parameters(answer.parameters.after, machine.values) if exact else ()),
        ),
        stated=tuple(_list_stated(answer.ranking, effects, several=several)),
    )


def names_effect(effect: Effect, entry: Named, *, several: bool) -> bool:
    """Return whether an entry names an effect, at its place where there are several and it has one."""
    at = effect.at if entry.at is None else entry.at
    here = not several or not effect.at or at in (effect.at, "drive", "sensor")
    return here and are_equivalent(effect.mechanism, entry.mechanism)


def _format_name(entry: Mechanism) -> str:
    return entry.mechanism if entry.at in ("", "ground", "drive", "sensor") else f"{entry.mechanism}@{entry.at}"


def _find_outcome(effect: JudgedEffect, answer: Diagnosis, *, several: bool) -> JudgedEffect:
    """Return an effect with what became of it, and the probability that was stated of what was found of it."""
    for entry in answer.found:
        if names_effect(effect, entry, several=several):
            return replace(effect, outcome=HIT, probability=entry.probability)
    if answer.found and any(names_effect(effect, other, several=several) for other in answer.confused_with):
        return replace(effect, outcome=CONFUSED)
    if any(entry.mechanism in VAGUE for entry in answer.found):
        return replace(effect, outcome=NOTICED)
    return replace(effect, outcome=MISNAMED if answer.found else MISSED)


def _judge_effect_parameters(effect: Effect, found: Sequence[Mechanism], *, several: bool) -> Iterator[JudgedParameter]:
    """Yield each parameter of an effect that was named exactly, with whether its interval holds the truth."""
    for entry in found:
        if entry.mechanism != effect.mechanism or not names_effect(effect, entry, several=several):
            continue
        own = _align_sign(effect.parameters, entry.parameters)
        for name, interval in entry.parameters.items():
            if name in own and interval.low < interval.high and name not in REPEATED:
                yield _judge_parameter(f"{effect.mechanism}.{name}", own[name], interval, turn=name in TURNING)
        return


def _align_sign(truth: Mapping[str, float], said: Mapping[str, Interval]) -> dict[str, float]:
    """Return the true parameters with that sign of the amplitude which was found; an angle turns with it."""
    own = dict(truth)
    for angle, amplitudes in TURNING.items():
        for amplitude in amplitudes:
            if {angle, amplitude} <= set(own) and amplitude in said and said[amplitude].median * own[amplitude] < 0.0:
                own[amplitude], own[angle] = -own[amplitude], own[angle] + math.pi
    return own


def _judge_machine_parameters(said: Mapping[str, Interval], truth: Mapping[str, float]) -> Iterator[JudgedParameter]:
    """Yield the parameters of the machine itself, which are to be right where everything was named.

    Where a model does not hold an interval is withheld: its ends are NaN.
    """
    for name, interval in said.items():
        if name in truth and interval.low < interval.high:
            yield _judge_parameter(name, truth[name], interval)


def _judge_parameter(name: str, truth: float, said: Interval, *, turn: bool = False) -> JudgedParameter:
    error = said.median - truth
    if turn:
        error = math.remainder(error, 2.0 * math.pi)
    inside = is_covered(said, truth, turn=turn)
    relative = error / abs(truth) if truth and not turn else math.nan
    return JudgedParameter(name, truth, said.low, said.median, said.high, inside, relative)


def _list_stated(
    ranking: Sequence[Candidate], effects: Sequence[Effect], *, several: bool, rough: bool = False
) -> Iterator[tuple[float, float]]:
    """Yield each probability that was stated of a mechanism, and 1 if that was at work, else 0.

    Of mechanisms that no recording tells apart it is the probability that it is one of them. In a `rough` world all
    laws of dry friction are one.
    """
    shares: dict[tuple[str, str], list[Candidate]] = {}
    for row in ranking:
        name = row.mechanism
        if name not in (*VAGUE, "nothing_missing"):
            kin = next((min(names) for names in EQUIVALENT if name in names), name)
            place = row.at if row.at in ("ground", "base") else ""
            shares.setdefault(("rub" if rough and name in FRICTION_TERMS else kin, place), []).append(row)
    there = is_present if rough else _is_at_work
    for rows in shares.values():
        yield min(sum(row.probability for row in rows), 1.0), float(there(effects, rows[0], several=several))


def _is_at_work(effects: Sequence[Effect], entry: Named, *, several: bool) -> bool:
    return any(names_effect(effect, entry, several=several) for effect in effects)


def _judge_heldout(fit: HeldOutScores, best: LikelihoodBound) -> HeldOutJudged | None:
    """Return the errors on held-out data of nominal, found and true model, and the share of what can be won."""
    before, after, true = fit.before.nrmse, fit.after.nrmse, best.nrmse
    if not all(map(math.isfinite, (before, after, true))):
        return None
    to_win = before - true
    share = (before - after) / to_win if to_win > 0.02 * true else math.nan
    return HeldOutJudged(before, after, true, share, after / true)
