"""The parts of a diagnosis that describe both models: ranking, held-out scores, unexplained force, first sentences."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.diagnosis.compare import Prediction
from lostmotion.diagnosis.findings import (
    Outcome,
    compute_intervals,
    compute_noise_floor,
    explain_withheld,
    list_other_places,
    withhold_intervals,
)
from lostmotion.diagnosis.notes import note_large_noise
from lostmotion.diagnosis.stages import SearchResult, list_fitted_keys
from lostmotion.diagnosis.states import LIKELY, NAMED, is_uncertain
from lostmotion.diagnosis.unknowns import compute_unknown_odds
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.inference.penalties import compute_penalty
from lostmotion.likelihood.system import key_of
from lostmotion.quantities import unit_of
from lostmotion.report.words import chance, sentence, span, to_words
from lostmotion.results import percent, rounded
from lostmotion.results.diagnosis import (
    Both,
    BothTrue,
    BothWhite,
    Candidate,
    Confusion,
    DriveFacts,
    Exponents,
    HeldOutScore,
    HeldOutScores,
    Labels,
    Mechanism,
    OpenTerm,
    ParameterSets,
    SensorFacts,
    Units,
    ValidTimes,
    Whiteness,
)
from lostmotion.results.mismatch import UnexplainedForce
from lostmotion.written import Written

MOST_OPEN = 2
"""The number of open terms that the opening sentences list; the report lists all."""


def label_model(fit: Fit) -> str:
    """Return the name of a model, or its equations, followed by its terms."""
    model = fit.problem.system.model
    name = f"({'; '.join(model.equations)})" if isinstance(model, Written) else model.name
    return " + ".join([name, *sorted(fit.problem.active)])


def label_models(d: SearchResult) -> Labels:
    """Return the labels of both models."""
    return Labels(label_model(d.before), label_model(d.after))


def find_angle_unit(case: CaseFile) -> str:
    """Return the unit of angles in a case: deg if a column is in degrees, else rad."""
    columns = [c for recording in case.recordings for c in (*recording.inputs, *recording.sensors)]
    return "deg" if any(c.unit.startswith(("deg", "°")) for c in columns) else "rad"


def list_units(d: SearchResult) -> Units:
    """Return the units of the arrays."""
    if d.after.problem.system.model.motion == "rotation":
        return Units("rad", "rad/s", "N m", "s")
    return Units("m", "m/s", "N", "s")


def describe_drive(d: SearchResult) -> DriveFacts:
    """Return amplitude, unit and frequency of the drive."""
    period = d.shown.period
    return DriveFacts(
        amplitude=d.after.problem.scales.force,
        unit=list_units(d).force,
        of=d.yardstick,
        frequency=1.0 / (period * d.shown.dt) if period else None,
        free=d.shown.free,
    )


def list_exponents(outcome: Outcome) -> Exponents:
    """Return the largest Lyapunov exponents of both models."""
    return Exponents(outcome.before.exponent, outcome.after.exponent, "1/s")


def list_valid_times(outcome: Outcome) -> ValidTimes:
    """Return the valid prediction times of both models, in s and in the unit of the horizon."""
    before, after, horizon = outcome.before, outcome.after, outcome.horizon
    scaled = Both(before.valid_time / horizon.unit_time, after.valid_time / horizon.unit_time)
    return ValidTimes(
        before=before.valid_time,
        after=after.valid_time,
        unit="s",
        or_longer=BothTrue(bool(before.valid_time >= before.lead[-1]), bool(after.valid_time >= after.lead[-1])),
        in_lyapunov_times=scaled if horizon.unit == "Lyapunov times" else None,
        in_drive_periods=scaled if horizon.unit == "drive periods" else None,
        in_natural_periods=scaled if horizon.unit == "natural periods" else None,
    )


def describe_whiteness(outcome: Outcome) -> BothWhite:
    """Return the tests of whiteness of the one-step errors of both models."""
    certain = outcome.diagnosis.settings.name.white
    before, after = outcome.before.white, outcome.after.white
    return BothWhite(
        Whiteness(before, _describe_p_value(before, certain)), Whiteness(after, _describe_p_value(after, certain))
    )


def _describe_p_value(p: float, certain: float) -> str:
    if p < certain:
        return f"One-step errors are autocorrelated (Ljung-Box {chance(p)}): a part of them can still be predicted."
    if p < 5.0 * certain:
        return f"One-step errors may be autocorrelated (Ljung-Box p = {rounded(p)})."
    return f"One-step errors are not distinguishable from white noise (Ljung-Box p = {rounded(p)})."


def list_sensors(d: SearchResult) -> tuple[SensorFacts, ...]:
    """Return name, channel, unit, standard deviation and kind of noise of each sensor."""
    motion = d.after.problem.system.model.motion
    rows = []
    for i, (sensor, name, noise) in enumerate(
        zip(d.shown.sensors, list_sensor_names(d), list_noise_levels(d), strict=True)
    ):
        fitted = d.after.problem.find_sensor(0, i).noises
        kind = " + ".join(noise.name for noise in fitted[1:]) or fitted[0].name
        if kind == "white" and any(find_term(d.before.problem, key)[0].at == sensor.place for key in d.quantised):
            kind = "quantised"
        rows.append(SensorFacts(name, sensor.channel, unit_of(sensor.channel, motion), noise, kind))
    return tuple(rows)


def list_sensor_names(d: SearchResult) -> list[str]:
    """Return the names of the sensors; a sensor without a name has that of its channel."""
    return [sensor.label for sensor in d.shown.sensors]


def list_noise_levels(d: SearchResult) -> list[float]:
    """Return the standard deviation of the measurement noise of each sensor in the augmented model."""
    fit = d.after
    return [math.sqrt(fit.problem.measurement(fit.theta, 0, i)) for i in range(len(d.shown.sensors))]


def list_scores(outcome: Outcome) -> HeldOutScores:
    """Return the scores of both models on held-out data."""
    horizon = outcome.horizon
    return HeldOutScores(
        before=_make_score(outcome, outcome.before),
        after=_make_score(outcome, outcome.after),
        noise_floor_nrmse=compute_noise_floor(outcome),
        horizon_unit=horizon.unit,
        horizon_unit_time=horizon.unit_time,
    )


def _make_score(outcome: Outcome, p: Prediction) -> HeldOutScore:
    by_sensor = dict(zip(list_sensor_names(outcome.diagnosis), p.by_sensor, strict=True))
    return HeldOutScore(p.log_score, p.nrmse, by_sensor, outcome.horizon.number)


def list_parameters(outcome: Outcome) -> ParameterSets:
    """Return the parameters of both models, with their intervals unless these are withheld."""
    d, why = outcome.diagnosis, explain_withheld(outcome)
    return ParameterSets(
        before=withhold_intervals(compute_intervals(d.before, outcome.draws_before), "" if d.found else why),
        after=withhold_intervals(compute_intervals(d.after, outcome.draws_after), why),
    )


def rank_candidates(d: SearchResult, found: Sequence[Mechanism], *, failed: bool) -> tuple[Candidate, ...]:
    """Return every candidate with log evidence, prior penalty and probability, with "nothing_missing" and "unknown".

    A found term has the probability that `found` states. If the model has `failed` on held-out data, something is
    missing, independently of the evidence. "unknown" is what the library does not explain: learned curves or, if
    nothing was found, a random force beyond the usual.
    """
    explained = d.explained
    unknown, gain = compute_unknown_odds(d)
    unknown = 1.0 if failed and not d.found else unknown
    stated = {(entry.mechanism, entry.at): entry.probability for entry in found}
    rows: list[Candidate] = []
    many = len(list_fitted_keys(explained.nominal.problem.system))
    for term in explained.nominal.problem.system.terms:
        key = key_of(term)
        p = stated[term.name, term.at] if key in d.named else explained.inclusion(key)
        rows.append(
            Candidate(
                mechanism=term.name,
                at=term.at,
                log_evidence_gain=explained.gain(key),
                probability=p,
                price=compute_penalty(term, many, d.settings),
                fitted=frozenset({key}) in explained.found,
            )
        )
    nothing = 0.0 if failed and not d.found else explained.probabilities.get(frozenset(), 0.0)
    nothing = min(nothing, 1.0 - unknown)
    fitted = any(one.unknown for one in explained.found.values())
    rows += [
        Candidate(mechanism="nothing_missing", at="", log_evidence_gain=0.0, probability=nothing, fitted=True),
        Candidate(mechanism="unknown", at="", log_evidence_gain=gain, probability=unknown, fitted=fitted),
    ]
    return tuple(sorted(rows, key=lambda row: (-row.probability, -row.log_evidence_gain)))


def list_confusions(d: SearchResult) -> list[Confusion]:
    """Return the terms of other probable sets, and the terms that cannot be distinguished from found ones."""
    rows = []
    for term in d.before.problem.system.terms:
        key = key_of(term)
        p = d.explained.inclusion(key)
        if key not in d.found and p > d.settings.name.worth:
            says = (
                f"{sentence(to_words(term.name))} has a probability of {p:.2f} after this recording:"
                f" {name_other_recording(d)} would decide."
            )
            rows.append(Confusion(mechanism=term.name, at=term.at, probability=p, says=says))
    return rows + [row for key in d.named for row in _list_indistinguishable(d, key)]


def count_bodies(d: SearchResult) -> int:
    """Return the number of bodies of the model on which a force may act."""
    return len({place.row for place in d.after.problem.system.model.interfaces})


def _describe_body(d: SearchResult) -> str:
    """Return a clause on the unexplained force if a found term acts on another body than the first; else nothing."""
    at = {find_term(d.after.problem, key)[0].at for key in d.named}
    others = list_other_places(d.after.problem.system.model)
    return ", if it acts on the first body," if at & others else ""


def name_other_recording(d: SearchResult) -> str:
    """Return which other recording may distinguish laws that are equal at one amplitude of the motion."""
    return "a decay from a larger or smaller start" if d.shown.free else "another drive level"


def _list_indistinguishable(d: SearchResult, key: str) -> list[Confusion]:
    """Return the terms that no recording of an unchanged machine can distinguish from a found term."""
    term, _ = find_term(d.after.problem, key)
    if len(d.shown.sensors) > 1:  # what delays one sensor delays no other
        return []
    says = (
        f"No recording of this machine can distinguish {{}} from {to_words(term.name)}: measure the delay between the"
        " channels directly."
    )
    p = d.explained.inclusion(key)
    return [Confusion(mechanism=n, at="", probability=p, says=says.format(to_words(n))) for n in term.equals]


def measure_unexplained(d: SearchResult, *, after: bool) -> UnexplainedForce:
    """Return the force that the augmented (`after`) or the nominal model leaves unexplained."""
    located = d.left if after and d.left else d.located
    rms = float(np.std(located.missing.force))
    significant = d.unexplained if after else bool(d.found or d.unexplained)
    return UnexplainedForce(significant, rms, list_units(d).force, rms / d.after.problem.scales.force)


def _list_finding_sentences(found: Sequence[Mechanism]) -> Iterator[str]:
    """Yield the sentences on the found terms; one that is likely or open has its warnings, each of them once."""
    given: set[str] = set()
    for entry in found:
        if not is_uncertain(entry):
            yield entry.says
            continue
        doubts = [doubt for doubt in entry.doubts if doubt not in given]
        given.update(doubts)
        opening = "Likely, not certain" if entry.state == LIKELY else "Open"
        yield " ".join([f"{opening}: {entry.says}", *doubts])


def summarise(outcome: Outcome, found: Sequence[Mechanism], rest: Sequence[OpenTerm] = ()) -> tuple[str, ...]:
    """Return the opening sentences of the report, from the found terms and the `rest` that remains open."""
    d = outcome.diagnosis
    horizon, floor = outcome.horizon, compute_noise_floor(outcome)
    time = span(horizon.number, horizon.unit)
    if not found:
        return (
            "Nothing is missing that this recording can show.",
            f"The free-running prediction error of the nominal model over {time} of held-out data is"
            f" {percent(outcome.before.nrmse)} of the response; the noise alone is {percent(floor)}.",
            *note_large_noise(outcome),
        )
    left = [f"Open: {row.says}" for row in rest[:MOST_OPEN]]
    if not d.found:
        return (*(entry.says for entry in found), *left)
    opening = list(_list_finding_sentences(found))
    if len(found) == 1 and not is_uncertain(found[0]):
        opening[0] = f"{opening[0][:-1]}, and the model leaves it out."
    elif len(found) > 1 and all(entry.state == NAMED for entry in found):
        opening.append(f"The model leaves out {'both' if len(found) == 2 else f'all {len(found)} of them'}.")
    opening.append(_describe_improvement(outcome, len(found), time, floor))
    opening += note_large_noise(outcome)
    if d.unexplained:
        new = measure_unexplained(d, after=True)
        opening.append(f"A force of {rounded(new.rms, 3)} {new.unit} rms remains that no term of the library explains.")
    return (*opening, *left)


def _describe_improvement(outcome: Outcome, found: int, time: str, floor: float) -> str:
    """Return the sentence on the unexplained force and the held-out error without and with the found terms.

    The size of the force is told only where it falls: without the terms, other parameters take a part of it.
    """
    d, errors = outcome.diagnosis, [outcome.before.nrmse, outcome.after.nrmse]
    old, new = measure_unexplained(d, after=False), measure_unexplained(d, after=True)
    worse = errors[1] > errors[0]
    verb, force = " rises" if worse else " falls", ""
    if new.rms < old.rms:
        force = (
            f" the unexplained force{_describe_body(d)} falls from {rounded(old.rms, 3)} to {rounded(new.rms, 3)}"
            f" {new.unit} (rms), and"
        )
        verb = verb if worse else ""
    return (
        f"With {'it' if found == 1 else 'them'}{force} the free-running prediction error of held-out data over"
        f" {time}{verb} from {percent(errors[0])} to {percent(errors[1])} of the response; the noise alone is"
        f" {percent(floor)}."
    )
