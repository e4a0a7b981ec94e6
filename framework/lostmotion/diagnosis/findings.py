"""The entries of `found`: mechanisms with their parameters, and the force that no mechanism explains."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from lostmotion.contracts import Array, Model, SensorTerm, Term
from lostmotion.diagnosis.compare import Prediction
from lostmotion.diagnosis.stages import SearchResult, list_physical_keys
from lostmotion.diagnosis.states import (
    NAMED,
    OPEN,
    choose_state,
    compute_probability,
    is_valid,
    list_warnings,
)
from lostmotion.diagnosis.unknowns import make_learned_entry, make_unnamed_entry
from lostmotion.inference.fit import Fit
from lostmotion.inference.late import estimate_onset
from lostmotion.inference.mixture import draw_posterior
from lostmotion.inference.natural import find_term
from lostmotion.inference.origin import list_shifted, list_unlocated
from lostmotion.inference.profile import stretch_draws
from lostmotion.likelihood.predict import Horizon
from lostmotion.quantities import unit_of
from lostmotion.results import Interval, attach_unit, percent, rounded
from lostmotion.results.diagnosis import Mechanism

DRAWS = 2000


@dataclass(frozen=True)
class Outcome:
    """A diagnosis, the predictions of both models, their horizon, and draws (draws, keys) of both posteriors.

    Draws are empty until the terms are final. Sentences state angles in the unit `angle`, rad or deg.
    """

    diagnosis: SearchResult
    before: Prediction
    after: Prediction
    horizon: Horizon
    draws_before: Array = field(default_factory=lambda: np.zeros((0, 0)))
    draws_after: Array = field(default_factory=lambda: np.zeros((0, 0)))
    angle: str = "rad"


def draw_parameters(fit: Fit, rng: np.random.Generator, stretches: Array | None = None) -> Array:
    """Return draws (DRAWS, keys) of the physical parameters from the posterior about a fit.

    Their deviations are multiplied by `stretches`, as `measure_stretches` returns them.
    """
    free = fit.problem.free
    theta = draw_posterior(fit, rng, DRAWS)
    if stretches is not None:
        theta = stretch_draws(fit, theta, stretches)
    physical = set(list_physical_keys(fit))
    kept = [i for i, f in enumerate(free) if f.key in physical]
    return np.array([[free[i].value(row[i]) for i in kept] for row in theta])


def compute_intervals(fit: Fit, draws: Array) -> dict[str, Interval]:
    """Return median and central 95 % interval of each physical parameter."""
    units = {f.key: f.unit for f in fit.problem.free}
    low, median, high = np.quantile(draws, [0.025, 0.5, 0.975], axis=0)
    keys = list_physical_keys(fit)
    return {k: Interval(float(median[i]), float(low[i]), float(high[i]), units[k]) for i, k in enumerate(keys)}


def list_findings(outcome: Outcome) -> tuple[Mechanism, ...]:
    """Return the entries of `found`: terms, quantisation of the stored values, and what no term explains."""
    d = outcome.diagnosis
    after = compute_intervals(d.after, outcome.draws_after)
    entries = [_make_entry(outcome, key, after) for key in d.named] + [
        _make_quantised_entry(d, key) for key in d.quantised
    ]
    if d.learned:
        entries.append(make_learned_entry(d))
    elif d.unexplained and (not d.found or _is_random(d)):
        entries.append(make_unnamed_entry(d))
    why = explain_withheld(outcome)
    if why and not d.found and not d.unexplained:
        entries.append(replace(make_unnamed_entry(d), probability=1.0, says=why))
    return tuple(replace(entry, parameters=withhold_intervals(entry.parameters, why)) for entry in entries)


def compute_noise_floor(outcome: Outcome) -> float:
    """Return the share of the held-out readings that is noise, as the mean over the sensors."""
    fit, scales = outcome.diagnosis.after, outcome.after.scales
    noises = [math.sqrt(fit.problem.measurement(fit.theta, 0, i)) for i in range(len(scales))]
    return float(np.mean([noise / scale for noise, scale in zip(noises, scales, strict=True)]))


def explain_withheld(outcome: Outcome) -> str:
    """Return the reason why intervals are withheld: the model does not predict held-out data; empty if it does."""
    floor = compute_noise_floor(outcome)
    if is_valid(outcome.after, floor, outcome.diagnosis.settings.name):
        return ""
    model = "model" if outcome.diagnosis.found else "nominal model"
    return (
        f"The {model} is not valid: the error of its free runs over held-out data is"
        f" {percent(outcome.after.nrmse)} of the"
        f" response, and the noise is {percent(floor)}. What is missing remains open, and intervals are withheld."
    )


def withhold_intervals(parameters: Mapping[str, Interval], why: str) -> Mapping[str, Interval]:
    """Return parameters for the result; with a reason `why`, the bounds of their intervals are NaN."""
    if not why:
        return parameters
    return {name: replace(one, low=math.nan, high=math.nan, withheld=why) for name, one in parameters.items()}


def _is_random(d: SearchResult) -> bool:
    """Return whether the remaining force has no structure."""
    return not (d.left and d.left.structure)


def _make_entry(outcome: Outcome, key: str, after: Mapping[str, Interval]) -> Mechanism:
    d = outcome.diagnosis
    term, slots = find_term(d.after.problem, key)
    system, known = d.after.problem.system, d.after.problem.known
    held = {s.key: float(known[system.index[s.key]]) for s in slots}
    own = {s.param.name: after.get(s.key) or _make_interval(np.full(1, held[s.key]), s.unit) for s in slots}
    parameters, why = own | _compute_derived(outcome, term, held), explain_withheld(outcome)
    sentence, late = _describe_law(outcome, key, parameters), estimate_onset(d.after, key)
    if late:
        sentence += f", since {late}"
    share = float(np.max(np.abs(d.laws[key]))) / d.after.problem.scales.force
    doubts = list_warnings(d, key) + [why] * bool(why)
    size = "" if isinstance(term, SensorTerm) else f", up to {percent(share)} of {d.yardstick}"
    state, p = choose_state(d, doubts, valid=not why), compute_probability(d, key)
    return Mechanism(
        mechanism=term.name,
        at=term.at,
        probability=min(p, d.settings.name.simplest) if state == OPEN else p,
        state=state,
        doubts=tuple(doubts),
        parameters=parameters,
        share_of_drive=share,
        since=late,
        says=f"{sentence}{size}.",
    )


def _describe_law(outcome: Outcome, key: str, parameters: Mapping[str, Interval]) -> str:
    """Return the sentence of a term with its numbers; without intervals where they are withheld."""
    d, bare = outcome.diagnosis, bool(explain_withheld(outcome))
    term, _ = find_term(d.after.problem, key)
    shown = {name: i.with_angles_in(outcome.angle) for name, i in parameters.items()}
    numbers = {name: attach_unit(rounded(i.median, 3), i.unit) if bare else str(i) for name, i in shown.items()}
    words = {q.name: q.words[q.choices.index(parameters[q.name].median)] for q in term.params if q.words}
    turned, phase = {}, ""
    if key in list_unlocated(d.after):
        medians = {name: i.median for name, i in parameters.items()}
        turned = dict.fromkeys(list_shifted(term, medians, d.after.problem.scales.length), "an unknown part")
        sizes = [f"{q.meaning}: {numbers[q.name]}; " for q in term.further[:1]]
        phase = f" ({''.join(sizes)}the phase is unknown, because no sensor shows the position)"
    sentence = term.physics.format(**(numbers | words | turned)) + _name_sensor(d, term)
    if term.at in list_other_places(d.after.problem.system.model):
        sentence += f" at the place {term.at!r}"
    return sentence + phase


def list_other_places(model: Model) -> set[str]:
    """Return the names of the places where a force acts on another body than the first."""
    first = model.interfaces[0]
    return {place.name for place in model.interfaces if place.row != first.row or place.against != first.against}


def _make_quantised_entry(d: SearchResult, key: str) -> Mechanism:
    """Return the entry of a term that is visible in the stored values: their quantisation."""
    term, slots = find_term(d.before.problem, key)
    rows = zip(slots, *d.quantised[key], strict=True)
    channel = next((s.channel for s in d.shown.sensors if s.place == term.at), d.shown.channel)
    unit = unit_of(channel, d.after.problem.system.model.motion)
    own = {s.param.name: Interval(v, v - 1.96 * sd, v + 1.96 * sd, unit) for s, v, sd in rows}
    sentence = term.physics.format(
        **{name: attach_unit(rounded(i.median, 3), i.unit) for name, i in own.items()}
    ) + _name_sensor(d, term)
    return Mechanism(
        mechanism=term.name,
        at=term.at,
        probability=1.0,
        state=NAMED,
        parameters=own,
        says=f"{sentence}, as the stored values show.",
    )


def _name_sensor(d: SearchResult, term: Term) -> str:
    """Return the name of the sensor on which a term acts, as the end of a sentence; empty for a single sensor."""
    if not isinstance(term, SensorTerm) or len(d.shown.sensors) < 2:
        return ""
    return next((f" (sensor {s.label!r})" for s in d.shown.sensors if s.place == term.at), "")


def _compute_derived(outcome: Outcome, term: Term, held: Mapping[str, float]) -> dict[str, Interval]:
    """Return the intervals of the derived numbers of a term, from draws of its parameters (`held` if not free)."""
    after = outcome.diagnosis.after
    columns = {key: i for i, key in enumerate(list_physical_keys(after))}
    rows = [[row[columns[k]] if k in columns else value for k, value in held.items()] for row in outcome.draws_after]
    made = np.array([term.derived(tuple(row)) for row in rows])
    motion = after.problem.system.model.motion
    return {q.name: _make_interval(column, q.unit(motion)) for q, column in zip(term.further, made.T, strict=True)}


def _make_interval(draws: Array, unit: str) -> Interval:
    """Return median and central 95 % interval of draws (count,)."""
    low, median, high = np.quantile(draws, [0.025, 0.5, 0.975])
    return Interval(float(median), float(low), float(high), unit)
