"""A diagnosis as `diagnosis.json` says it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import term_of
from lostmotion.inference.prices import price_of
from lostmotion.likelihood.system import key_of
from lostmotion.quantities import quantity_of, unit_of
from lostmotion.report.words import chance, span, spoken
from lostmotion.results import rounded
from lostmotion.stages.compare import Prediction
from lostmotion.stages.diagnose import Diagnosed, fitted_keys
from lostmotion.workflow.findings import (
    Outcome,
    elsewhere,
    found_in,
    intervals,
    noise_floor,
    shown,
    why_withheld,
)
from lostmotion.workflow.notes import drowned
from lostmotion.workflow.sharings import shared_in
from lostmotion.workflow.states import LIKELY, doubted, in_order, open_of
from lostmotion.workflow.unknowns import unknown_odds, where
from lostmotion.written import Written

MOST_OPEN = 2
"""So many of the terms that stay open are told in the opening; the others stand in the report."""


def verdict(outcome: Outcome) -> dict[str, Any]:
    """Return the content of `diagnosis.json`, provenance and title left out."""
    d = outcome.diagnosis
    found, why, rest = found_in(outcome), why_withheld(outcome), open_of(d)
    shared = shared_in(d, found)
    found = in_order([doubted(entry, d.settings.name.sure) for entry in shared.pop("found", found)])
    return {
        "schema": "lostmotion.diagnosis/1",
        "verdict": "mismatch" if found else "adequate",
        "says": says(outcome, found, rest),
        "found": found,
        "open": rest,
        "ranking": _ranking(d, found, failed=bool(why)),
        "confused_with": _confused(d),
        "unexplained": _unexplained(d, after=True),
        "unexplained_before": _unexplained(d, after=False),
        "where": {**where(d.located, d.learned), "bodies": _bodies(d)},
        "where_after": where(d.left or d.located),
        "parameters": {
            "before": shown(told(d.before, outcome.draws_before), "" if d.found else why),
            "after": shown(told(d.after, outcome.draws_after), why),
        },
        "fit": _fit(outcome),
        "model": {"before": label(d.before), "after": label(d.after)},
        **_setting(outcome),
        **shared,
    }


def label(fit: Fit) -> str:
    """Return the model with its terms as people write it: its name, or its equations."""
    model = fit.problem.system.model
    name = f"({'; '.join(model.equations)})" if isinstance(model, Written) else model.name
    return " + ".join([name, *sorted(fit.problem.active)])


def _setting(outcome: Outcome) -> dict[str, Any]:
    d = outcome.diagnosis
    model, scales = d.after.problem.system.model, d.after.problem.scales
    rotation = model.motion == "rotation"
    period = d.shown.period
    units = ("rad", "rad/s", "N m") if rotation else ("m", "m/s", "N")
    predictions = {"before": outcome.before, "after": outcome.after}
    return {
        "drive": {
            "amplitude": scales.force,
            "unit": units[2],
            "of": d.yardstick,
            "frequency": 1.0 / (period * d.shown.dt) if period else None,
            "free": d.shown.free,
        },
        "units": {"position": units[0], "velocity": units[1], "force": units[2], "time": "s"},
        "response": {"quantity": quantity_of(d.shown.channel)},
        "sensors": _sensors(d),
        "lyapunov": {**{k: p.exponent for k, p in predictions.items()}, "unit": "1/s"},
        "valid_prediction_time": {
            **{k: p.valid_time for k, p in predictions.items()},
            "unit": "s",
            "or_longer": {k: bool(p.valid_time >= p.lead[-1]) for k, p in predictions.items()},
            "in_" + outcome.horizon.unit.replace(" ", "_").lower(): {
                k: p.valid_time / outcome.horizon.unit_time for k, p in predictions.items()
            },
        },
        "whiteness": {
            k: {"p": p.white, "says": _white(p.white, d.settings.name.white)} for k, p in predictions.items()
        },
    }


def _white(p: float, certain: float) -> str:
    if p < certain:
        return (
            f"One-step errors are not white (Ljung-Box {chance(p)}): they still hold something that can be predicted."
        )
    if p < 5.0 * certain:
        return f"One-step errors may hold something that can be predicted (Ljung-Box p = {p:.2g})."
    return f"One-step errors cannot be told from white noise (Ljung-Box p = {p:.2g})."


def _sensors(d: Diagnosed) -> list[dict[str, Any]]:
    """Return name, channel, unit, standard deviation and kind of noise of each sensor."""
    motion = d.after.problem.system.model.motion
    rows = []
    for i, (sensor, name, noise) in enumerate(zip(d.shown.sensors, names_of(d), noises_of(d), strict=True)):
        unit, kind = unit_of(sensor.channel, motion), sensor.noise.kind
        if d.after.problem.slow(d.after.theta, 0, i)[0]:
            kind = "ar1"
        elif any(term_of(d.before.problem, key)[0].at == sensor.place for key in d.marks):
            kind = "quantised"
        rows.append({"name": name, "channel": sensor.channel, "unit": unit, "noise_sd": noise, "kind": kind})
    return rows


def names_of(d: Diagnosed) -> list[str]:
    """Return the names of the sensors: the channel of one that was given none."""
    return [sensor.label for sensor in d.shown.sensors]


def noises_of(d: Diagnosed) -> list[float]:
    """Return the standard deviation of all measurement noise of each sensor, after."""
    fit = d.after
    return [math.sqrt(fit.problem.measurement(fit.theta, 0, i)) for i in range(len(d.shown.sensors))]


def _fit(outcome: Outcome) -> dict[str, Any]:
    d = outcome.diagnosis

    def entry(p: Prediction) -> dict[str, Any]:
        return {
            "heldout_log_score": p.log_score,
            "heldout_nrmse": p.nrmse,
            "heldout_nrmse_by_sensor": dict(zip(names_of(d), p.by_sensor, strict=True)),
            "horizon": outcome.horizon.number,
        }

    floor = noise_floor(outcome)
    unit = {"horizon_unit": outcome.horizon.unit, "horizon_unit_time": outcome.horizon.unit_time}
    return {"before": entry(outcome.before), "after": entry(outcome.after), "noise_floor_nrmse": floor, **unit}


def told(fit: Fit, draws: Array) -> dict[str, dict[str, Any]]:
    """Return median and interval of each physical parameter, ready for JSON."""
    return {key: interval.as_dict() for key, interval in intervals(fit, draws).items()}


def _ranking(d: Diagnosed, found: Sequence[dict[str, Any]], *, failed: bool) -> list[dict[str, Any]]:
    """Return every candidate with its evidence, price and probability, beside them "nothing missing" and "unknown".

    A term that was found has the probability that is told of it. Where the model has `failed` on held-out data,
    something is missing, whatever the evidence says. "Unknown" is what the library does not explain: curves that were
    learned, or, when nothing was found, a force beyond the usual.
    """
    selection = d.selection
    unknown, gain = unknown_odds(d)
    unknown = 1.0 if failed and not d.found else unknown
    told = {(entry["mechanism"], entry["at"]): entry["probability"] for entry in found if "at" in entry}
    rows: list[dict[str, Any]] = []
    many = len(fitted_keys(selection.nominal.problem.system))
    for term in selection.nominal.problem.system.terms:
        key = key_of(term)
        p = told[term.name, term.at] if key in d.named else selection.inclusion(key) * (1.0 - unknown)
        rows.append(
            {
                "mechanism": term.name,
                "at": term.at,
                "log_evidence_gain": selection.gain(key),
                "probability": p,
                "price": price_of(term, many, d.settings),
                "fitted": frozenset({key}) in selection.visits,
            }
        )
    nothing = selection.probabilities().get(frozenset(), 0.0) * (1.0 - unknown)
    rows.append(
        {"mechanism": "nothing_missing", "at": "", "log_evidence_gain": 0.0, "probability": nothing, "fitted": True}
    )
    fitted = d.learned is not None
    rows.append({"mechanism": "unknown", "at": "", "log_evidence_gain": gain, "probability": unknown, "fitted": fitted})
    return sorted(rows, key=lambda row: (-row["probability"], -row["log_evidence_gain"]))


def _confused(d: Diagnosed) -> list[dict[str, Any]]:
    """Return the terms that are in other sets of some weight, and relatives of what was found."""
    rows = []
    for term in d.selection.nominal.problem.system.terms:
        key = key_of(term)
        p = 0.0 if d.learned else d.selection.inclusion(key)
        if key not in d.found and p > d.settings.name.worth:
            says = f"This recording gives {spoken(term.name)} a probability of {p:.2f}: {other_level(d)} would decide."
            rows.append({"mechanism": term.name, "at": term.at, "probability": p, "says": says})
    return rows + [row for key in d.named for row in _equal(d, key)]


def _bodies(d: Diagnosed) -> int:
    """Return on how many bodies of the model a force may act."""
    return len({place.row for place in d.after.problem.system.model.interfaces})


def _taken_as(d: Diagnosed) -> str:
    """Return how the unexplained force is to be read where what was found acts on another body than the first."""
    at = {term_of(d.after.problem, key)[0].at for key in d.named}
    others = elsewhere(d.after.problem.system.model)
    return ", taken as one that acts on the first body," if at & others else ""


def other_level(d: Diagnosed) -> str:
    """Return what recording may tell two laws apart that are alike at one size of the motion."""
    return "a decay from a larger or smaller start" if d.shown.free else "another drive level"


def _equal(d: Diagnosed, key: str) -> list[dict[str, Any]]:
    """Return the terms that no recording of a machine that does not age can tell from a term that was found."""
    term, _ = term_of(d.after.problem, key)
    if len(d.shown.sensors) > 1:  # what delays one sensor delays no other
        return []
    says = (
        f"No recording of this machine can tell {{}} from {spoken(term.name)}: measure the time lag of the channels by"
        " itself."
    )
    p = d.selection.inclusion(key)
    return [{"mechanism": n, "at": "", "probability": p, "says": says.format(spoken(n))} for n in term.equals]


def _unexplained(d: Diagnosed, *, after: bool) -> dict[str, Any]:
    located = d.left if after and d.left else d.located
    rms = float(np.std(located.missing.force))
    rotation = d.after.problem.system.model.motion == "rotation"
    return {
        "significant": d.unexplained if after else bool(d.found or d.unexplained),
        "rms": rms,
        "unit": "N m" if rotation else "N",
        "share_of_drive": rms / d.after.problem.scales.force,
    }


def _said(found: Sequence[dict[str, Any]]) -> Iterator[str]:
    """Yield the sentences on what was found; what is no more than likely is told so, each doubt once."""
    told: set[str] = set()
    for entry in found:
        if entry.get("state") != LIKELY:
            yield str(entry["says"])
            continue
        doubts = [doubt for doubt in entry["doubts"] if doubt not in told]
        told.update(doubts)
        yield " ".join([f"Likely, not certain: {entry['says']}", *doubts])


def says(outcome: Outcome, found: list[dict[str, Any]], rest: Sequence[dict[str, Any]] = ()) -> list[str]:
    """Return the opening sentences of the report, from what was found and the `rest` that stays open."""
    d = outcome.diagnosis
    fit, horizon = _fit(outcome), outcome.horizon
    time = span(horizon.number, horizon.unit)
    if not found:
        error = fit["before"]["heldout_nrmse"]
        return [
            "Nothing is missing that this recording can show.",
            f"The nominal model predicts held-out data over {time} to {error:.1%} of the response; the noise alone is"
            f" {fit['noise_floor_nrmse']:.1%}.",
            *drowned(outcome),
        ]
    left = [f"Open: {row['says']}" for row in rest[:MOST_OPEN]]
    if not d.found:
        return [entry["says"] for entry in found] + left
    opening = list(_said(found))
    if len(found) == 1 and found[0].get("state") != LIKELY:
        opening[0] = f"{opening[0][:-1]}, and the model leaves it out."
    elif len(found) > 1:
        opening.append(f"The model leaves out {'both' if len(found) == 2 else f'all {len(found)} of them'}.")
    old, new = _unexplained(d, after=False), _unexplained(d, after=True)
    errors = [fit[when]["heldout_nrmse"] for when in ("before", "after")]
    sizes = [f"{rounded(one['rms'], 3)}" for one in (old, new)]
    verbs = ["rises" if new["rms"] > old["rms"] else "falls", " rises" if errors[1] > errors[0] else " falls"]
    if verbs[1].strip() == verbs[0]:
        verbs[1] = ""
    opening.append(
        f"With {'it' if len(found) == 1 else 'them'} the unexplained force{_taken_as(d)} {verbs[0]} from"
        f" {sizes[0]} to {sizes[1]} {new['unit']} (rms), and the free-running prediction error of held-out"
        f" data over {time}{verbs[1]} from {errors[0]:.1%} to {errors[1]:.1%} of the response; the noise alone is"
        f" {fit['noise_floor_nrmse']:.1%}."
    )
    opening += drowned(outcome)
    if d.unexplained:
        opening.append(f"A force of {sizes[1]} {new['unit']} rms remains that no term of the library explains.")
    return opening + left
