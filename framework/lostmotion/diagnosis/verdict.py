"""The parts of a diagnosis that describe both models: ranking, held-out scores, unexplained force, first sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lostmotion.diagnosis.compare import Prediction
from lostmotion.diagnosis.facts import Facts
from lostmotion.diagnosis.findings import withhold_intervals
from lostmotion.diagnosis.notes import note_large_noise
from lostmotion.diagnosis.states import LIKELY, NAMED, explain_withheld, is_uncertain, is_valid
from lostmotion.report.words import chance, sentence, span, to_words
from lostmotion.results import percent, rounded
from lostmotion.results.diagnosis import (
    Both,
    BothTrue,
    BothWhite,
    Candidate,
    Confusion,
    Exponents,
    HeldOutScore,
    HeldOutScores,
    Mechanism,
    OpenTerm,
    ParameterSets,
    SensorFacts,
    ValidTimes,
    Whiteness,
)

MOST_OPEN = 2
"""The number of open terms that the opening sentences list; the report lists all."""


def list_exponents(facts: Facts) -> Exponents:
    """Return the largest Lyapunov exponents of both models."""
    return Exponents(facts.before.exponent, facts.after.exponent, "1/s")


def list_valid_times(facts: Facts) -> ValidTimes:
    """Return the valid prediction times of both models, in s and in the unit of the horizon."""
    before, after, horizon = facts.before, facts.after, facts.horizon
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


def describe_whiteness(facts: Facts) -> BothWhite:
    """Return the tests of whiteness of the one-step errors of both models."""
    certain = facts.settings.name.white
    before, after = facts.before.white, facts.after.white
    return BothWhite(
        Whiteness(before, _describe_p_value(before, certain)), Whiteness(after, _describe_p_value(after, certain))
    )


def _describe_p_value(p: float, certain: float) -> str:
    if p < certain:
        return f"One-step errors are autocorrelated (Ljung-Box {chance(p)}): a part of them can still be predicted."
    if p < 5.0 * certain:
        return f"One-step errors may be autocorrelated (Ljung-Box p = {rounded(p)})."
    return f"One-step errors are not distinguishable from white noise (Ljung-Box p = {rounded(p)})."


def list_sensors(facts: Facts) -> tuple[SensorFacts, ...]:
    """Return name, channel, unit, standard deviation and kind of noise of each sensor."""
    return tuple(SensorFacts(one.name, one.channel, one.unit, one.sd, one.kind) for one in facts.sensors)


def list_scores(facts: Facts) -> HeldOutScores:
    """Return the scores of both models on held-out data."""
    horizon = facts.horizon
    return HeldOutScores(
        before=_make_score(facts, facts.before),
        after=_make_score(facts, facts.after),
        noise_floor_nrmse=facts.noise_floor,
        horizon_unit=horizon.unit,
        horizon_unit_time=horizon.unit_time,
    )


def _make_score(facts: Facts, p: Prediction) -> HeldOutScore:
    by_sensor = dict(zip((one.name for one in facts.sensors), p.by_sensor, strict=True))
    return HeldOutScore(p.log_score, p.nrmse, by_sensor, facts.horizon.number)


def list_parameters(facts: Facts) -> ParameterSets:
    """Return the parameters of both models, with their intervals unless these are withheld."""
    why = explain_withheld(facts)
    return ParameterSets(
        before=withhold_intervals(facts.parameters_before, "" if facts.augmented else why),
        after=withhold_intervals(facts.parameters_after, why),
    )


def rank_candidates(facts: Facts, found: Sequence[Mechanism]) -> tuple[Candidate, ...]:
    """Return every candidate with log evidence, prior penalty and probability, with "nothing_missing" and "unknown".

    A found term has the probability that `found` states. If the model fails on held-out data, something is missing,
    independently of the evidence. "unknown" is what the library does not explain: learned curves or, if nothing was
    found, a random force beyond the usual.
    """
    failed = not is_valid(facts) and not facts.augmented
    unknown = 1.0 if failed else facts.unknown
    stated = {(entry.mechanism, entry.at): entry.probability for entry in found}
    rows = [
        Candidate(
            mechanism=one.term.name,
            at=one.term.at,
            log_evidence_gain=one.gain,
            probability=stated.get((one.term.name, one.term.at), facts.inclusion(one.key)),
            price=one.price,
            fitted=one.fitted,
        )
        for one in facts.candidates
    ]
    nothing = min(0.0 if failed else facts.sets.get(frozenset(), 0.0), 1.0 - unknown)
    rows += [
        Candidate(mechanism="nothing_missing", at="", log_evidence_gain=0.0, probability=nothing, fitted=True),
        Candidate(
            mechanism="unknown",
            at="",
            log_evidence_gain=facts.unknown_gain,
            probability=unknown,
            fitted=facts.smooth_fitted,
        ),
    ]
    return tuple(sorted(rows, key=lambda row: (-row.probability, -row.log_evidence_gain)))


def list_confusions(facts: Facts) -> list[Confusion]:
    """Return the terms of other probable sets, and the terms that cannot be distinguished from found ones."""
    rows, found = [], {one.key for one in facts.found}
    for one in facts.candidates:
        p = facts.inclusion(one.key)
        if one.key not in found and p > facts.settings.name.worth:
            says = (
                f"{sentence(to_words(one.term.name))} has a probability of {p:.2f} after this recording:"
                f" {name_other_recording(facts)} would decide."
            )
            rows.append(Confusion(mechanism=one.term.name, at=one.term.at, probability=p, says=says))
    return [*rows, *_list_indistinguishable(facts)]


def name_other_recording(facts: Facts) -> str:
    """Return which other recording may distinguish laws that are equal at one amplitude of the motion."""
    return "a decay from a larger or smaller start" if facts.drive.free else "another drive level"


def _list_indistinguishable(facts: Facts) -> Iterator[Confusion]:
    """Yield the terms that no recording of an unchanged machine can distinguish from a found term."""
    if len(facts.sensors) > 1:  # what delays one sensor delays no other
        return
    for found in facts.found:
        p = facts.inclusion(found.key)
        for other in found.term.equals:
            says = (
                f"No recording of this machine can distinguish {to_words(other)} from {to_words(found.term.name)}:"
                " measure the delay between the channels directly."
            )
            yield Confusion(mechanism=other, at="", probability=p, says=says)


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


def summarise(facts: Facts, found: Sequence[Mechanism], rest: Sequence[OpenTerm] = ()) -> tuple[str, ...]:
    """Return the opening sentences of the report, from the found terms and the `rest` that remains open."""
    noise, time = note_large_noise.write(facts), span(facts.horizon.number, facts.horizon.unit)
    if not found:
        return (
            "Nothing is missing that this recording can show.",
            f"The free-running prediction error of the nominal model over {time} of held-out data is"
            f" {percent(facts.before.nrmse)} of the response; the noise alone is {percent(facts.noise_floor)}.",
            *noise,
        )
    left = [f"Open: {row.says}" for row in rest[:MOST_OPEN]]
    if not facts.augmented:
        return (*(entry.says for entry in found), *left)
    opening = list(_list_finding_sentences(found))
    if len(found) == 1 and found[0].state == NAMED:
        opening[0] = f"{opening[0][:-1]}, and the model leaves it out."
    elif len(found) > 1 and all(entry.state == NAMED for entry in found):
        opening.append(f"The model leaves out {'both' if len(found) == 2 else f'all {len(found)} of them'}.")
    opening += [_describe_improvement(facts, len(found), time), *noise]
    if facts.unexplained:
        new = facts.force_after
        opening.append(f"A force of {rounded(new.rms, 3)} {new.unit} rms remains that no term of the library explains.")
    return (*opening, *left)


def _describe_improvement(facts: Facts, found: int, time: str) -> str:
    """Return the sentence on the unexplained force and the held-out error without and with the found terms.

    The size of the force is told only where it falls: without the terms, other parameters take a part of it.
    """
    errors, old, new = [facts.before.nrmse, facts.after.nrmse], facts.force_before, facts.force_after
    worse = errors[1] > errors[0]
    verb, force = " rises" if worse else " falls", ""
    if new.rms < old.rms:
        body = ", if it acts on the first body," if facts.on_other_body else ""
        force = (
            f" the unexplained force{body} falls from {rounded(old.rms, 3)} to {rounded(new.rms, 3)}"
            f" {new.unit} (rms), and"
        )
        verb = verb if worse else ""
    return (
        f"With {'it' if found == 1 else 'them'}{force} the free-running prediction error of held-out data over"
        f" {time}{verb} from {percent(errors[0])} to {percent(errors[1])} of the response; the noise alone is"
        f" {percent(facts.noise_floor)}."
    )
