"""A diagnosis as `diagnosis.json` says it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from lostmotion.contracts import Array, Term
from lostmotion.inference.candidates import term_of
from lostmotion.inference.fit import Fit
from lostmotion.inference.mixture import draws
from lostmotion.inference.predict import Horizon
from lostmotion.inference.problem import LEVELS
from lostmotion.inference.tracks import period_samples
from lostmotion.results import Interval
from lostmotion.stages.compare import Prediction
from lostmotion.stages.diagnose import STRUCTURED, Diagnosis, base_keys
from lostmotion.system import key_of

DRAWS = 2000
WORTH_NAMING = 0.05


@dataclass(frozen=True)
class Outcome:
    """A diagnosis, its predictions, the horizon they are judged over, draws (draws, keys) of both posteriors."""

    diagnosis: Diagnosis
    before: Prediction
    after: Prediction
    horizon: Horizon
    draws_before: Array
    draws_after: Array


def draws_of(fit: Fit, rng: np.random.Generator) -> Array:
    """Return draws (DRAWS, keys) of the physical parameters from the posterior about a fit."""
    free = fit.problem.free
    theta = draws(fit, rng, DRAWS)
    kept = [i for i, f in enumerate(free) if f.key not in LEVELS]
    return np.array([[free[i].value(row[i]) for i in kept] for row in theta])


def intervals(fit: Fit, draws: Array) -> dict[str, Interval]:
    """Return median and central 95 % interval of each physical parameter."""
    units = {f.key: f.unit for f in fit.problem.free}
    low, median, high = np.quantile(draws, [0.025, 0.5, 0.975], axis=0)
    keys = base_keys(fit)
    return {k: Interval(float(median[i]), float(low[i]), float(high[i]), units[k]) for i, k in enumerate(keys)}


def verdict(outcome: Outcome) -> dict[str, Any]:
    """Return the content of `diagnosis.json`, provenance and title left out."""
    d = outcome.diagnosis
    found = _found(outcome)
    return {
        "schema": "lostmotion.diagnosis/1",
        "verdict": "mismatch" if found else "adequate",
        "says": says(outcome, found),
        "found": found,
        "ranking": _ranking(d),
        "confused_with": _confused(d),
        "unexplained": _unexplained(d, after=True),
        "unexplained_before": _unexplained(d, after=False),
        "where": {"summary": d.located.summary, "explained_by": d.located.shares},
        "parameters": {
            "before": {k: v.as_dict() for k, v in intervals(d.before, outcome.draws_before).items()},
            "after": {k: v.as_dict() for k, v in intervals(d.after, outcome.draws_after).items()},
        },
        "fit": _fit(outcome),
        "model": {"before": label(d.before), "after": label(d.after)},
        **_setting(outcome),
    }


def label(fit: Fit) -> str:
    """Return the model with its terms as people write it."""
    return " + ".join([fit.problem.system.model.name, *sorted(fit.problem.active)])


def _setting(outcome: Outcome) -> dict[str, Any]:
    d = outcome.diagnosis
    model, scales = d.after.problem.system.model, d.after.problem.scales
    rotation = model.motion == "rotation"
    period = period_samples(d.shown)
    units = ("rad", "rad/s", "N m") if rotation else ("m", "m/s", "N")
    predictions = {"before": outcome.before, "after": outcome.after}
    return {
        "drive": {
            "amplitude": scales.force,
            "unit": units[2],
            "frequency": 1.0 / (period * d.shown.dt) if period else None,
        },
        "units": {"position": units[0], "velocity": units[1], "force": units[2], "time": "s"},
        "response": {"quantity": d.shown.channel},
        "lyapunov": {**{k: p.exponent for k, p in predictions.items()}, "unit": "1/s"},
        "valid_prediction_time": {
            **{k: p.valid_time for k, p in predictions.items()},
            "unit": "s",
            "or_longer": {k: bool(p.valid_time >= p.lead[-1]) for k, p in predictions.items()},
            "in_" + outcome.horizon.unit.replace(" ", "_").lower(): {
                k: p.valid_time / outcome.horizon.unit_time for k, p in predictions.items()
            },
        },
        "whiteness": {k: {"p": p.white, "says": _white(p.white)} for k, p in predictions.items()},
    }


def _white(p: float) -> str:
    if p < 0.01:
        return (
            f"One-step errors are not white (Ljung-Box p = {p:.2g}): they still hold something that can be predicted."
        )
    return f"One-step errors cannot be told from white noise (Ljung-Box p = {p:.2g})."


def _fit(outcome: Outcome) -> dict[str, Any]:
    def entry(p: Prediction) -> dict[str, Any]:
        return {
            "heldout_log_score": p.log_score,
            "heldout_nrmse": p.nrmse,
            "horizon": outcome.horizon.number,
        }

    d = outcome.diagnosis
    noise = math.sqrt(d.after.problem.noise(d.after.theta)[1])
    floor = noise / float(np.nanstd(d.shown.z))
    unit = {"horizon_unit": outcome.horizon.unit, "horizon_unit_time": outcome.horizon.unit_time}
    return {"before": entry(outcome.before), "after": entry(outcome.after), "noise_floor_nrmse": floor, **unit}


def _found(outcome: Outcome) -> list[dict[str, Any]]:
    d = outcome.diagnosis
    after = intervals(d.after, outcome.draws_after)
    entries = [_entry(outcome, key, after) for key in d.found]
    if not entries and d.unexplained:
        depends = [k for k, share in d.located.shares.items() if share > STRUCTURED]
        entries.append(_unnamed(d, depends))
    return entries


def _entry(outcome: Outcome, key: str, after: Mapping[str, Interval]) -> dict[str, Any]:
    d = outcome.diagnosis
    term, slots = term_of(d.after.problem, key)
    system, known = d.after.problem.system, d.after.problem.known
    held = {s.key: float(known[system.index[s.key]]) for s in slots}
    own = {s.param.name: after.get(s.key) or _of(np.full(1, held[s.key]), s.unit) for s in slots}
    sentence = term.physics.format(**{name: str(i) for name, i in own.items()})
    share = float(np.max(np.abs(d.laws[key]))) / d.after.problem.scales.force
    return {
        "mechanism": term.name,
        "at": term.at,
        "probability": d.selection.inclusion(key),
        "parameters": {name: i.as_dict() for name, i in (own | _derived(outcome, term, held)).items()},
        "share_of_drive": share,
        "says": f"{sentence}, up to {100.0 * share:.2g} % of the drive.",
    }


def _of(draws: Array, unit: str) -> Interval:
    """Return median and central 95 % interval of draws (count,)."""
    low, median, high = np.quantile(draws, [0.025, 0.5, 0.975])
    return Interval(float(median), float(low), float(high), unit)


def _derived(outcome: Outcome, term: Term, held: Mapping[str, float]) -> dict[str, Interval]:
    """Return the intervals of the further numbers of a term, from draws of its parameters (`held` where not free)."""
    after = outcome.diagnosis.after
    columns = {key: i for i, key in enumerate(base_keys(after))}
    rows = [[row[columns[k]] if k in columns else value for k, value in held.items()] for row in outcome.draws_after]
    made = np.array([term.derived(tuple(row)) for row in rows])
    motion = after.problem.system.model.motion
    return {q.name: _of(column, q.dimension.unit(motion)) for q, column in zip(term.further, made.T, strict=True)}


def _unnamed(d: Diagnosis, depends: list[str]) -> dict[str, Any]:
    """Return the entry of a mismatch that no term explains: structured ("unknown") or not ("random_force")."""
    rms = float(np.std(d.located.missing.force))
    unit = "N m" if d.after.problem.system.model.motion == "rotation" else "N"
    gain = Interval(rms, rms, rms, unit)
    share = rms / d.after.problem.scales.force
    name = "unknown" if depends else "random_force"
    on = f"depends on {' and '.join(depends)}" if depends else "depends on nothing that was recorded"
    return {
        "mechanism": name,
        "probability": 1.0 - math.exp(-d.random_gain),
        "parameters": {"rms": gain.as_dict()},
        "depends_on": depends,
        "says": f"A force of {rms:.3g} {unit} rms, {share:.1%} of the drive, is missing; no term explains it; it {on}.",
    }


def _ranking(d: Diagnosis) -> list[dict[str, Any]]:
    """Return every candidate with its evidence and probability, and beside them "nothing missing" and "unknown".

    "Unknown" is what the library does not explain: when nothing was found and a force beyond the usual is left.
    """
    selection = d.selection
    unknown = 0.0 if d.found or not d.unexplained else 1.0 - math.exp(-d.random_gain)
    rows = []
    for term in selection.nominal.problem.system.terms:
        key = key_of(term)
        rows.append(
            {
                "mechanism": term.name,
                "at": term.at,
                "log_evidence_gain": selection.gain(key),
                "probability": selection.inclusion(key) * (1.0 - unknown),
                "fitted": frozenset({key}) in selection.visits,
            }
        )
    nothing = selection.probabilities().get(frozenset(), 0.0) * (1.0 - unknown)
    rows.append(
        {"mechanism": "nothing_missing", "at": "", "log_evidence_gain": 0.0, "probability": nothing, "fitted": True}
    )
    gain = d.random_gain if unknown else 0.0
    rows.append({"mechanism": "unknown", "at": "", "log_evidence_gain": gain, "probability": unknown, "fitted": False})
    return sorted(rows, key=lambda row: (-row["probability"], -row["log_evidence_gain"]))


def _confused(d: Diagnosis) -> list[dict[str, Any]]:
    """Return the terms that are in other sets of some weight, and relatives of what was found."""
    rows = []
    for term in d.after.problem.system.terms:
        key = key_of(term)
        p = d.selection.inclusion(key)
        if key not in d.found and p > WORTH_NAMING:
            says = f"This recording gives {term.name} a probability of {p:.2f}: another drive level would decide."
            rows.append({"mechanism": term.name, "at": term.at, "probability": p, "says": says})
    return rows + [row for key in d.found for row in _equal(d, key)]


def _equal(d: Diagnosis, key: str) -> list[dict[str, Any]]:
    """Return the terms that no recording of a machine that does not age can tell from a term that was found."""
    term, _ = term_of(d.after.problem, key)
    says = (
        f"No recording of this machine can tell {{}} from {term.name}: measure the time lag of the channels by itself."
    )
    p = d.selection.inclusion(key)
    return [{"mechanism": n, "at": "", "probability": p, "says": says.format(n)} for n in term.equals]


def _unexplained(d: Diagnosis, *, after: bool) -> dict[str, Any]:
    located = d.left if after and d.left else d.located
    rms = float(np.std(located.missing.force))
    rotation = d.after.problem.system.model.motion == "rotation"
    return {
        "significant": d.unexplained if after else bool(d.found or d.unexplained),
        "rms": rms,
        "unit": "N m" if rotation else "N",
        "share_of_drive": rms / d.after.problem.scales.force,
    }


def says(outcome: Outcome, found: list[dict[str, Any]]) -> list[str]:
    """Return the opening sentences of the report."""
    d = outcome.diagnosis
    fit, horizon = _fit(outcome), outcome.horizon
    span = f"{horizon.number:g} {horizon.unit}" if horizon.number != 1 else f"one {horizon.unit.rstrip('s')}"
    if not found:
        error = fit["before"]["heldout_nrmse"]
        return [
            "Nothing is missing that this recording can show.",
            f"The nominal model predicts held-out data over {span} to {error:.1%} of the response; the noise alone is"
            f" {fit['noise_floor_nrmse']:.1%}.",
        ]
    if not d.found:
        return [found[0]["says"]]
    opening = [entry["says"] for entry in found]
    if len(found) == 1:
        opening[0] = f"{opening[0][:-1]}, and the model leaves it out."
    else:
        opening.append(f"The model leaves out {'both' if len(found) == 2 else f'all {len(found)} of them'}.")
    old, new = _unexplained(d, after=False), _unexplained(d, after=True)
    opening.append(
        f"With {'it' if len(found) == 1 else 'them'} the unexplained force falls from {old['rms']:.3g} to"
        f" {new['rms']:.2g} {new['unit']} (rms), and the free-running prediction error of held-out data over {span}"
        f" from {fit['before']['heldout_nrmse']:.1%} to {fit['after']['heldout_nrmse']:.1%} of the response; the noise"
        f" alone is {fit['noise_floor_nrmse']:.1%}."
    )
    if d.unexplained:
        opening.append(f"A force of {new['rms']:.2g} {new['unit']} rms remains that no term of the library explains.")
    return opening
