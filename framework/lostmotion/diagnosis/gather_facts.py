"""The facts of a diagnosis, gathered from its search and the predictions of both models."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.contracts import Array, Machine, SensorTerm, Term
from lostmotion.diagnosis.facts import (
    AmplitudeChange,
    CandidateTerm,
    Facts,
    FoundTerm,
    PriorBound,
    SensorNoise,
    Support,
)
from lostmotion.diagnosis.outcome import Outcome, compute_intervals
from lostmotion.diagnosis.stages import SearchResult, list_fitted_keys, list_physical_keys
from lostmotion.diagnosis.states import NAMED
from lostmotion.diagnosis.unknowns import make_learned_entry, make_unnamed_entry, weigh_unknown
from lostmotion.evidence.hypothesis import Hypothesis, group_amplitudes, list_vague
from lostmotion.inference.contacts import list_short_contacts
from lostmotion.inference.fit import Fit
from lostmotion.inference.late import estimate_onset
from lostmotion.inference.natural import find_term, sort_slots
from lostmotion.inference.origin import list_shifted, list_unlocated
from lostmotion.inference.penalties import compute_penalty
from lostmotion.inference.unseen import BodyPosition, smooth_body_position
from lostmotion.likelihood.initial import shows_place
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.sensor_noise import compute_variance
from lostmotion.likelihood.system import key_of
from lostmotion.quantities import TIME, unit_of
from lostmotion.recording.spec import RecordingSpec
from lostmotion.report.words import to_words
from lostmotion.results import Interval, attach_unit, rounded
from lostmotion.results.diagnosis import DriveFacts, Mechanism, Units
from lostmotion.results.mismatch import UnexplainedForce

EDGE = 1e-3
"""A parameter is at a bound of its prior within this share of its range."""


def gather_facts(outcome: Outcome, case: CaseFile, said: Sequence[str] = ()) -> Facts:
    """Return the facts of a diagnosis; `said` are the notes on the case and its recordings."""
    d = outcome.diagnosis
    model, first = d.after.posterior.system.model, d.explained.chosen.posterior.observations[0]
    intervals = _widen_vague(d.explained.best, d.named, compute_intervals(d.after, outcome.draws_after))
    unknown, gain = weigh_unknown(d)
    return Facts(
        settings=d.settings,
        motion=model.motion,
        drive=describe_drive(d),
        input_unit=unit_of(model.inputs[0], model.motion),
        level=first.travel,
        sensors=_list_sensors(outcome),
        before=outcome.before,
        after=outcome.after,
        horizon=outcome.horizon,
        force_before=measure_unexplained(d, after=False),
        force_after=measure_unexplained(d, after=True),
        sets=d.explained.probabilities,
        candidates=_list_candidates(d),
        found=tuple(_make_found(outcome, key, intervals) for key in d.named),
        quantised=tuple(_make_quantised_entry(d, key) for key in d.quantised),
        unnamed=_make_unnamed(d),
        parameters_before=compute_intervals(d.before, outcome.draws_before),
        parameters_after=intervals,
        augmented=bool(d.found),
        learned=d.learned is not None,
        unexplained=d.unexplained,
        structured=bool(d.left and d.left.structure),
        on_other_body=_acts_on_other_body(d),
        remains=_measure_remains(d),
        smooth_fitted=any(one.unknown for one in d.explained.found.values()),
        unknown=unknown,
        unknown_gain=gain,
        explanations=len(d.explained.found),
        skipped=d.explained.skipped,
        withdrawn=d.withdrawn,
        corrected=tuple(d.corrections.describe(d.shown)),
        contacts=tuple(list_short_contacts(d.after)),
        bounds=tuple(_list_bounds(d.after)),
        position=find_position(d.after, d.shown),
        recordings=(*d.train, *d.held) if d.shown is d.held[0] else (d.shown,),
        fitted=d.train,
        held=d.held,
        said=tuple(said),
        angle=find_angle_unit(case.recordings),
    )


def find_angle_unit(recordings: Sequence[RecordingSpec]) -> str:
    """Return the unit of angles in the recordings of a case: deg if a column is in degrees, else rad."""
    columns = [c for recording in recordings for c in (*recording.inputs, *recording.sensors)]
    return "deg" if any(c.unit.startswith(("deg", "°")) for c in columns) else "rad"


def list_units(d: SearchResult) -> Units:
    """Return the units of the arrays."""
    if d.after.posterior.system.model.motion == "rotation":
        return Units("rad", "rad/s", "N m", "s")
    return Units("m", "m/s", "N", "s")


def describe_drive(d: SearchResult) -> DriveFacts:
    """Return amplitude, unit and frequency of the drive."""
    period = d.shown.period
    return DriveFacts(
        amplitude=d.after.posterior.scales.force,
        unit=list_units(d).force,
        of=d.yardstick,
        frequency=1.0 / (period * d.shown.dt) if period else None,
        free=d.shown.free,
    )


def measure_unexplained(d: SearchResult, *, after: bool) -> UnexplainedForce:
    """Return the force that the augmented (`after`) or the nominal model leaves unexplained."""
    located = d.left if after and d.left else d.located
    rms = float(np.std(located.missing.force))
    significant = d.unexplained if after else bool(d.found or d.unexplained)
    return UnexplainedForce(significant, rms, list_units(d).force, rms / d.after.posterior.scales.force)


def find_position(fit: Fit, observation: Observation) -> BodyPosition | None:
    """Return the smoothed position during a recording; None where a sensor shows it."""
    return None if shows_place(observation) else smooth_body_position(fit, observation)


def _measure_remains(d: SearchResult) -> float:
    """Return the share of the missing force that is still missing with all findings; 0 without a random force."""
    if not (d.unexplained and d.left):
        return 0.0
    return float(np.std(d.left.missing.force) / np.std(d.located.missing.force))


def _list_sensors(outcome: Outcome) -> tuple[SensorNoise, ...]:
    """Return the noise of each sensor in the augmented model, with the sentences of its parts."""
    d = outcome.diagnosis
    posterior, theta, motion = d.after.posterior, d.after.theta, d.after.posterior.system.model.motion
    first, marked = posterior.observations[0], {find_term(d.before.posterior, key)[0].at for key in d.quantised}
    rows = []
    for i, (sensor, scale) in enumerate(zip(d.shown.sensors, outcome.after.scales, strict=True)):
        whole, fitted = posterior.recordings[0].measurement(theta, i), posterior.recordings[0].sensors[i].noises
        slow = posterior.recordings[0].noise(theta, i).variance_after(first.samples // 2)
        kind = " + ".join(noise.name for noise in fitted[1:]) or fitted[0].name
        if kind == "white" and sensor.place in marked:
            kind = "quantised"
        words = []
        for noise, values in zip(fitted, posterior.recordings[0].noise_values(theta[None], i), strict=True):
            p = tuple(values[0].tolist())
            words.append(noise.words(p, compute_variance(noise.covariance(p, first.dt), first, i) / whole))
        rows.append(
            SensorNoise(
                name=sensor.label,
                channel=sensor.channel,
                unit=unit_of(sensor.channel, motion),
                sd=math.sqrt(whole),
                slow=slow**0.5,
                scale=scale,
                kind=kind,
                words=tuple(filter(None, words)),
            )
        )
    return tuple(rows)


def _list_bounds(fit: Fit) -> Iterator[PriorBound]:
    """Yield the parameters of the model that are at a bound of their prior."""
    for f, at in zip(fit.posterior.space.free, fit.theta, strict=True):
        reach = EDGE * (f.high - f.low)
        if f.physical and "." not in f.parameter and not f.low + reach < at < f.high - reach:
            yield PriorBound(f.key, f.value(f.low if at <= f.low + reach else f.high), f.unit)


def _list_candidates(d: SearchResult) -> tuple[CandidateTerm, ...]:
    explained, system = d.explained, d.explained.nominal.posterior.system
    many, nothing = len(list_fitted_keys(system)), explained.nominal.log_evidence
    alone = {next(iter(terms)): fit.log_evidence for terms, fit in explained.fits.items() if len(terms) == 1}
    return tuple(
        CandidateTerm(
            key=key,
            term=term,
            gain=explained.gain(key),
            price=compute_penalty(term, many, d.settings),
            fitted=frozenset({key}) in explained.found,
            alone=alone[key] - nothing if key in alone else None,
        )
        for key, term in ((key_of(term), term) for term in system.terms)
    )


def _make_unnamed(d: SearchResult) -> Mechanism | None:
    """Return the entry of a force that no term explains; None where terms explain all."""
    if d.learned:
        return make_learned_entry(d)
    return make_unnamed_entry(d) if d.unexplained or not d.found else None


def _make_found(outcome: Outcome, key: str, intervals: Mapping[str, Interval]) -> FoundTerm:
    d = outcome.diagnosis
    term, slots = find_term(d.after.posterior, key)
    system, known = d.after.posterior.system, d.after.posterior.known
    held = {s.key: float(known[system.index[s.key]]) for s in slots}
    own = {s.param.name: intervals.get(s.key) or _make_interval(np.full(1, held[s.key]), s.unit) for s in slots}
    parameters, unlocated = own | _compute_derived(outcome, term, held), None
    if key in list_unlocated(d.after):
        medians = {name: i.median for name, i in parameters.items()}
        unlocated = tuple(list_shifted(term, medians, d.after.posterior.scales.length))
    return FoundTerm(
        key=key,
        term=term,
        parameters=parameters,
        share=float(np.max(np.abs(d.laws[key]))) / d.after.posterior.scales.force,
        support=_make_support(d, key, intervals),
        since=estimate_onset(d.after, key),
        place=term.at if term.at in list_other_places(system.model) else "",
        sensor=_name_sensor(d, term),
        unlocated=unlocated,
    )


def _widen_vague(best: Hypothesis, named: Iterable[str], intervals: Mapping[str, Interval]) -> dict[str, Interval]:
    """Return the intervals, with that of each vague amplitude up to the value that does nothing.

    Where this value is a bound, quantiles of draws lie beside it, however probable it is.
    """
    found = dict(intervals)
    for key in named:
        vague = set(list_vague(best, key))
        for slot in sort_slots(best.frame.posterior, key)[0]:
            if slot.param.name in vague and slot.key in found:
                null, told = slot.param.null or 0.0, found[slot.key]
                found[slot.key] = replace(told, low=min(told.low, null), high=max(told.high, null))
    return found


def _make_support(d: SearchResult, key: str, intervals: Mapping[str, Interval]) -> Support:
    return Support(
        gain=d.explained.gain_beside(key),
        vague=tuple(
            dict.fromkeys((*list_vague(d.explained.best, key), *list_reaching(d.after.posterior, key, intervals)))
        ),
        moved=tuple(_list_moved(d, key)),
        delay=_count_delay(d.after, key),
        complete=tuple(_list_complete(d, key)),
    )


def list_reaching(posterior: Posterior, key: str, intervals: Mapping[str, Interval]) -> Iterator[str]:
    """Yield the amplitudes whose interval, averaged over all explanations, contains the value that does nothing.

    The two amplitudes of a wave count as one, whose intervals both contain it.
    """
    slots = sort_slots(posterior, key)[0]
    for group in group_amplitudes(posterior, key, slots):
        own = [slots[k].param for k in group]
        told = [intervals.get(slots[k].key) for k in group]
        if all(i and i.low <= (p.null or 0.0) <= i.high for p, i in zip(own, told, strict=True)):
            yield " and ".join(p.name for p in own)


def _list_moved(d: SearchResult, key: str) -> Iterator[AmplitudeChange]:
    """Yield the amplitudes of other found terms, without a found term and beside it."""
    whole = d.explained.best
    less = d.explained.found.get(whole.terms - {key})
    if less is None or key not in whole.terms:
        return
    sds = np.sqrt(np.maximum(np.diag(less.covariance), 0.0))
    for f, at, sd in zip(less.frame.posterior.space.free[: less.frame.own], less.theta, sds, strict=True):
        owner, _, name = f.key.rpartition(".")
        if owner and not f.log and f.key in whole.values:
            law = to_words(owner.partition("@")[0])
            yield AmplitudeChange(law, name, f.unit, float(at), float(whole.values[f.key]), float(sd))


def _count_delay(fit: Fit, key: str) -> float | None:
    """Return the delay or the time constant of a channel in samples; None for other terms."""
    term, slots = find_term(fit.posterior, key)
    late = [s for s in slots if s.param.dimension == TIME and s.key in fit.values]
    if term.acts == "motion" or not late:
        return None
    return abs(fit.values[late[0].key]) / fit.posterior.observations[0].dt


def _list_complete(d: SearchResult, key: str) -> Iterator[float]:
    """Yield the share of the recording after which each change is complete."""
    posterior = d.after.posterior
    for slot in find_term(posterior, key)[1]:
        if slot.param.prior.lasting and slot.param.dimension == TIME and slot.key in d.after.values:
            first = posterior.observations[0]
            yield (d.after.values[slot.key] - float(first.time[0])) / (first.samples * first.dt)


def list_other_places(model: Machine) -> set[str]:
    """Return the names of the places where a force acts on another body than the first."""
    return {place.name for place in model.places if place.bodies != model.first_place.bodies}


def _acts_on_other_body(d: SearchResult) -> bool:
    at = {find_term(d.after.posterior, key)[0].at for key in d.named}
    return bool(at & list_other_places(d.after.posterior.system.model))


def _name_sensor(d: SearchResult, term: Term) -> str:
    """Return the name of the sensor on which a term acts; empty for a single sensor."""
    if not isinstance(term, SensorTerm) or len(d.shown.sensors) < 2:
        return ""
    return next((s.label for s in d.shown.sensors if s.place == term.at), "")


def _make_quantised_entry(d: SearchResult, key: str) -> Mechanism:
    """Return the entry of a term that is visible in the stored values: their quantisation."""
    term, slots = find_term(d.before.posterior, key)
    rows = zip(slots, *d.quantised[key], strict=True)
    channel = next((s.channel for s in d.shown.sensors if s.place == term.at), d.shown.channel)
    unit = unit_of(channel, d.after.posterior.system.model.motion)
    own = {s.param.name: Interval(v, v - 1.96 * sd, v + 1.96 * sd, unit) for s, v, sd in rows}
    numbers = {name: attach_unit(rounded(i.median, 3), i.unit) for name, i in own.items()}
    sensor = _name_sensor(d, term)
    beside = f" (sensor {sensor!r})" if sensor else ""
    return Mechanism(
        mechanism=term.name,
        at=term.at,
        probability=1.0,
        state=NAMED,
        parameters=own,
        says=f"{term.physics.format(**numbers)}{beside}, as the stored values show.",
    )


def _compute_derived(outcome: Outcome, term: Term, held: Mapping[str, float]) -> dict[str, Interval]:
    """Return the intervals of the derived numbers of a term, from draws of its parameters (`held` if not free)."""
    after = outcome.diagnosis.after
    columns = {key: i for i, key in enumerate(list_physical_keys(after))}
    rows = [[row[columns[k]] if k in columns else value for k, value in held.items()] for row in outcome.draws_after]
    made, motion = [term.derived(tuple(row)) for row in rows], after.posterior.system.model.motion
    return {q.name: _make_interval(np.array([one[q] for one in made]), q.unit(motion)) for q in made[0]}


def _make_interval(draws: Array, unit: str) -> Interval:
    """Return median and central 95 % interval of draws (count,)."""
    low, median, high = np.quantile(draws, [0.025, 0.5, 0.975])
    return Interval(float(median), float(low), float(high), unit)
