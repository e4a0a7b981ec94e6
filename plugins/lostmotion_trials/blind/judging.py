"""The last step of a blind trial: what a diagnosis said of a case, held against the truth once that is unsealed."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from lostmotion.errors import LostMotionError, PlaceError
from lostmotion.registry import Registry
from lostmotion.workflow.prepare import prepare
from lostmotion_trials.blind.bound import ALIKE, Yardstick, alike, covered, spelled, yardstick
from lostmotion_trials.blind.commitment import label, unsealed
from lostmotion_trials.blind.mechanisms import TABLE

Row = Mapping[str, Any]
HIT, CONFUSED, NOTICED, MISNAMED, MISSED = "hit", "confused", "noticed", "misnamed", "missed"
OUTCOMES = (HIT, CONFUSED, NOTICED, MISNAMED, MISSED)
"""What may become of an effect: named; named as one that the diagnosis says it cannot tell from it; called unknown;
called something else; not noticed."""
VAGUE = ("unknown", "random_force")
RUB = tuple(name for name, mechanism in TABLE.items() if mechanism.kin == "rub")
"""Laws of dry friction: where the true one has a random shape, each of them names it."""
FLAWS = ("sensor_quantisation",)
"""What every machine of an imperfect world has and the library knows."""
SURE = 0.95
REPEATED = ("cosine", "sine")
"""Parameters that say again what an amplitude and a phase say."""
TURNING = {"phase": ("depth", "amplitude")}
"""Angles, and the amplitudes whose sign turns them by half a turn."""


def judged(out: Path, registry: Registry, number: int) -> dict[str, Any]:
    """Return what became of a case: each effect with its outcome, what was named in error, parameters, held-out errors.

    Raises `DataError` when case or truth are not those that were sealed.
    """
    truth, case = unsealed(out, number), label(number)
    told = {"case": case, "model": truth["machine"]["model"], "variant": truth["variant"], "margin": None}
    place = out / "cases" / case
    path = place / "diagnosis" / "diagnosis.json"
    diagnosis = json.loads(path.read_text(encoding="utf-8")) if path.exists() else None
    if "world" in truth:
        return _judged_roughly({**told, "kind": truth["world"]["kind"]}, diagnosis, truth)
    try:
        prepared = prepare(place / "case.toml", registry)
        best = yardstick(prepared, truth, diagnosis)
        places = len(prepared.model.interfaces)
    except PlaceError:
        raise
    except (LostMotionError, ArithmeticError, ValueError) as err:
        best = Yardstick((None,) * len(truth["effects"]), ("failed",) * len(truth["effects"]))
        told["oracle"], places = " ".join(str(err).split()), 2 if truth["machine"]["model"] == "robot_joint" else 1
    told["margin"] = best.margin
    effects = [
        {**effect, "gain": gain, "status": status}
        for effect, gain, status in zip(truth["effects"], best.gains, best.status, strict=True)
    ]
    if diagnosis is None:
        return {**told, "verdict": "failed", "effects": [{**e, "outcome": MISSED} for e in effects], **_nothing()}
    answer = _held_against(diagnosis, effects, truth, several=places > 1)
    return {**told, "verdict": diagnosis["verdict"], **answer, **_heldout(diagnosis, best)}


def _judged_roughly(told: dict[str, Any], diagnosis: Row | None, truth: Row) -> dict[str, Any]:
    """Return what became of a case in an imperfect world, where no model is true: nothing is held against an oracle.

    Names that were stated with more than `SURE` are listed with whether what they name is there; an effect is `sure`
    where one of them names it.
    """
    several = told["model"] == "robot_joint"
    effects = [{**effect, "gain": None, "status": "no true model"} for effect in truth["effects"]]
    if diagnosis is None:
        missed = [{**e, "outcome": MISSED, "sure": False} for e in effects]
        return {**told, "verdict": "failed", "effects": missed, "sure": [], **_nothing()}
    answer = _held_against(diagnosis, effects, truth, several=several)
    named = [entry for entry in diagnosis["found"] if entry["mechanism"] not in VAGUE]
    stated = [entry for entry in named if entry["probability"] > SURE and entry.get("state", "named") == "named"]
    sure = [[_name(entry), there_is(effects, entry, several=several)] for entry in stated]
    answer["effects"] = [_sured(e, named, stated, several=several) for e in answer["effects"]]
    answer["false"] = [name for name, right in sure if not right]
    answer["stated"] = list(_stated(diagnosis, effects, several=several, rough=True))
    errors = [diagnosis["fit"][when]["heldout_nrmse"] for when in ("before", "after")]
    fallen = None if None in errors else errors[1] - errors[0]
    return {
        **told,
        "verdict": diagnosis["verdict"],
        **answer,
        "sure": sure,
        "parameters": [],
        "worse": fallen,
        "heldout": None,
    }


def in_kind(effect: Row, entry: Row, *, several: bool) -> bool:
    """Return whether an entry names an effect, at its place; any law of friction names friction of a random shape."""
    if same(effect, entry, several=several):
        return True
    as_named = {**effect, "mechanism": entry["mechanism"]}
    return {effect["mechanism"], entry["mechanism"]} <= set(RUB) and same(as_named, entry, several=several)


def there_is(effects: Sequence[Row], entry: Row, *, several: bool) -> bool:
    """Return whether what an entry names is in a machine of an imperfect world: hidden, or a flaw that each has."""
    return entry["mechanism"] in FLAWS or any(in_kind(e, entry, several=several) for e in effects)


def _sured(effect: Row, named: Sequence[Row], stated: Sequence[Row], *, several: bool) -> dict[str, Any]:
    """Return an effect with its outcome, and whether a sure name names it; any law of friction names friction."""
    hit = any(in_kind(effect, entry, several=several) for entry in named)
    sure = any(in_kind(effect, entry, several=several) for entry in stated)
    return {**effect, "outcome": HIT if hit else effect["outcome"], "sure": sure}


def _nothing() -> dict[str, Any]:
    return {"named": [], "false": [], "parameters": [], "stated": [], "heldout": None}


def _held_against(diagnosis: Row, effects: Sequence[Row], truth: Row, *, several: bool) -> dict[str, Any]:
    found = diagnosis["found"]
    right = [entry for entry in found if any(same(e, entry, several=several) for e in effects)]
    rows = [{**e, **_outcome(e, diagnosis, several=several)} for e in effects]
    if len(right) == len(found):
        rows = [{**row, "outcome": MISSED} if row["outcome"] == MISNAMED else row for row in rows]
    exact = len(right) == len(found) and all(row["outcome"] == HIT for row in rows)
    return {
        "effects": rows,
        "named": [_name(entry) for entry in found],
        "false": [_name(entry) for entry in found if entry not in right],
        "parameters": [
            *(row for e in effects for row in _of_effect(_spelled(e, truth), found, several=several)),
            *(_of_machine(diagnosis, truth) if exact else ()),
        ],
        "stated": list(_stated(diagnosis, effects, several=several)),
    }


def _spelled(effect: Row, truth: Row) -> dict[str, Any]:
    return {**effect, "parameters": spelled(effect["parameters"], truth["machine"])}


def same(effect: Row, entry: Row, *, several: bool) -> bool:
    """Return whether an entry names an effect, at its place where there are several and it has one."""
    here = not several or not effect["at"] or entry.get("at", effect["at"]) in (effect["at"], "drive", "sensor")
    return here and alike(effect["mechanism"], entry["mechanism"])


def _name(entry: Row) -> str:
    at = entry.get("at", "")
    return entry["mechanism"] if at in ("", "ground", "drive", "sensor") else f"{entry['mechanism']}@{at}"


def _outcome(effect: Row, diagnosis: Row, *, several: bool) -> dict[str, Any]:
    """Return what became of an effect, and the probability that was stated of what was found of it."""
    found = diagnosis["found"]
    for entry in found:
        if same(effect, entry, several=several):
            return {"outcome": HIT, "probability": entry["probability"]}
    others = [*diagnosis.get("confused_with", ()), *(o for entry in found for o in entry.get("confused_with", ()))]
    if found and any(same(effect, _entry(other), several=several) for other in others):
        return {"outcome": CONFUSED, "probability": None}
    if any(entry["mechanism"] in VAGUE for entry in found):
        return {"outcome": NOTICED, "probability": None}
    return {"outcome": MISNAMED if found else MISSED, "probability": None}


def _entry(other: Row | str) -> Row:
    return {"mechanism": other} if isinstance(other, str) else other


def _of_effect(effect: Row, found: Sequence[Row], *, several: bool) -> Iterator[dict[str, Any]]:
    """Yield each parameter of an effect that was named exactly, with whether its interval holds the truth."""
    for entry in found:
        if entry["mechanism"] != effect["mechanism"] or not same(effect, entry, several=several):
            continue
        own = _turned(effect["parameters"], entry["parameters"])
        for name, interval in entry["parameters"].items():
            if name in own and _wide(interval) and name not in REPEATED:
                yield _parameter(f"{effect['mechanism']}.{name}", own[name], interval, turn=name in TURNING)
        return


def _turned(truth: Mapping[str, float], said: Mapping[str, Row]) -> dict[str, float]:
    """Return the true parameters with that sign of the amplitude which was found; an angle turns with it."""
    own = dict(truth)
    for angle, amplitudes in TURNING.items():
        for amplitude in amplitudes:
            if angle in own and amplitude in own and said.get(amplitude, {}).get("median", 0.0) * own[amplitude] < 0.0:
                own[amplitude], own[angle] = -own[amplitude], own[angle] + math.pi
    return own


def _of_machine(diagnosis: Row, truth: Row) -> Iterator[dict[str, Any]]:
    """Yield the parameters of the machine itself, which are to be right where everything was named."""
    values = truth["machine"]["values"]
    for name, interval in diagnosis["parameters"]["after"].items():
        if name in values and _wide(interval):
            yield _parameter(name, values[name], interval)


def _wide(interval: Row) -> bool:
    """Return whether there is an interval: where a model does not hold it is withheld."""
    return interval["low"] is not None and bool(interval["low"] < interval["high"])


def _parameter(name: str, truth: float, interval: Row, *, turn: bool = False) -> dict[str, Any]:
    error = interval["median"] - truth
    if turn:
        error = math.remainder(error, 2.0 * math.pi)
    sizes = {key: interval[key] for key in ("low", "median", "high")}
    inside = covered(interval, truth, turn=turn)
    relative = error / abs(truth) if truth and not turn else None
    return {"name": name, "truth": truth, **sizes, "inside": inside, "relative_error": relative}


def _stated(diagnosis: Row, effects: Sequence[Row], *, several: bool, rough: bool = False) -> Iterator[list[float]]:
    """Yield each probability that was stated of a mechanism, and 1 if that was at work, else 0.

    Of mechanisms that no recording tells apart it is the probability that it is one of them. In a `rough` world all
    laws of dry friction are one.
    """
    shares: dict[tuple[str, str], list[Row]] = {}
    for row in diagnosis["ranking"]:
        name = row["mechanism"]
        if name not in (*VAGUE, "nothing_missing"):
            kin = next((min(names) for names in ALIKE if name in names), name)
            place = row["at"] if row["at"] in ("ground", "base") else ""
            shares.setdefault(("rub" if rough and name in RUB else kin, place), []).append(row)
    there = there_is if rough else _at_work
    for rows in shares.values():
        yield [min(sum(row["probability"] for row in rows), 1.0), float(there(effects, rows[0], several=several))]


def _at_work(effects: Sequence[Row], entry: Row, *, several: bool) -> bool:
    return any(same(effect, entry, several=several) for effect in effects)


def _heldout(diagnosis: Row, best: Yardstick) -> dict[str, Any]:
    """Return the errors on held-out data of nominal, found and true model, and the share of what can be won."""
    fit = diagnosis["fit"]
    before, after, true = fit["before"]["heldout_nrmse"], fit["after"]["heldout_nrmse"], best.nrmse
    if true is None or before is None or after is None:
        return {"heldout": None}
    to_win = before - true
    share = (before - after) / to_win if to_win > 0.02 * true else None
    return {"heldout": {"before": before, "after": after, "true": true, "share": share, "ratio": after / true}}
