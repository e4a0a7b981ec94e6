"""The notes of a diagnosis: remarks on its limitations."""

from __future__ import annotations

import math
from collections.abc import Iterator

from lostmotion.diagnosis.facts import Facts, Remark, remark, write_remarks
from lostmotion.diagnosis.free_decays import note_restarts
from lostmotion.diagnosis.repetition_notes import note_repetitions
from lostmotion.diagnosis.states import doubt_moved_amplitudes, doubt_short_delay
from lostmotion.report.words import to_words
from lostmotion.results import percent, rounded

SLOW = 0.3
"""Autocorrelated noise above this share of the held-out readings of a sensor may be motion."""


@remark("recordings")
def note_unrecorded_inputs(facts: Facts) -> Iterator[str]:
    """Yield a note for each recording without an input in which an unrecorded input acted."""
    for observation in facts.recordings:
        yield from note_restarts(observation)


@remark("bounds")
def note_bounds(facts: Facts) -> Iterator[str]:
    """Yield a note for each parameter at a bound of its prior."""
    for one in facts.bounds:
        yield (
            f"{one.name} is at the bound {rounded(one.bound, 4)} {one.unit} of its prior: widen the prior,"
            " or check the known"
            " values; the found terms may compensate for a wrong value."
        )


@remark()
def note_large_errors(facts: Facts) -> Iterator[str]:
    """Yield a note if the errors of free runs are many times the noise of every sensor."""
    errors = zip(facts.after.by_sensor, facts.sensors, strict=True)
    far = min(error * sensor.scale / sensor.sd for error, sensor in errors)
    if not far < facts.settings.note.error:
        yield (
            f"The error of free runs over held-out data is {rounded(far)} times the measurement noise: either something"
            " is missing that one-step errors do not show, or small errors of the state grow fast."
        )


@remark()
def note_noise(facts: Facts) -> Iterator[str]:
    """Yield the sentences of the noises of each sensor."""
    for sensor in facts.sensors:
        for said in sensor.words:
            yield f"{sensor.name}: {said}" if len(facts.sensors) > 1 else said


@remark()
def note_large_noise(facts: Facts) -> Iterator[str]:
    """Yield a note for each sensor whose estimated noise is so large, in held-out data, that it may be motion."""
    limits = facts.settings.note
    for sensor in facts.sensors:
        slow, share = (size / sensor.scale for size in (sensor.slow, sensor.sd))
        if slow > SLOW or share > limits.noise:
            whose = f" of {sensor.name}" if len(facts.sensors) > 1 else ""
            kind = " is autocorrelated and" if slow > SLOW else ""
            yield (
                f"The estimated noise{whose}{kind} is {percent(share)} of the held-out readings: it may be motion that"
                " the model does not describe, such as another mode, or the sensor may not measure what the case states"
                " (check its sign and place). In both cases the result is not valid."
            )


@remark("found")
def note_moved_amplitudes(facts: Facts) -> Iterator[str]:
    """Yield a note for each amplitude that changes strongly when another term is added."""
    for one in facts.found:
        yield from doubt_moved_amplitudes.write(facts, one)


@remark("corrected")
def note_corrections(facts: Facts) -> Iterator[str]:
    """Yield the errors of channels and known values that were corrected."""
    yield (
        f"Usual errors of channels and known values are corrected: {', '.join(facts.corrected)}. They are within"
        " what acquisition systems and drawings usually have, so nothing is missing in the model for them."
    )


@remark("found")
def note_short_delays(facts: Facts) -> Iterator[str]:
    """Yield a note for each found delay that is as short as in most acquisition systems."""
    for one in facts.found:
        yield from doubt_short_delay.write(facts, one)


@remark("skipped")
def note_budget(facts: Facts) -> Iterator[str]:
    """Yield a note if the search ended before all sets of terms were extended."""
    yield (
        f"The search used up its processor time after {facts.explanations} explanations; what might be missing"
        f" beside {' or '.join(map(to_words, facts.skipped))} was not tried. A larger `--budget` continues the search."
    )


@remark("recordings")
def note_repeated_motion(facts: Facts) -> Iterator[str]:
    """Yield notes on cycles that are equal, and on held-out data that repeat fitted data."""
    yield from note_repetitions(facts.recordings, facts.fitted, facts.held)


@remark("recordings")
def note_gauge_noise(facts: Facts) -> Iterator[str]:
    """Yield a note for each recording whose periodic force was used without the noise of its gauge."""
    for one in facts.recordings:
        if one.gauge_noise:
            share = rounded(100.0 * one.gauge_noise / one.travel)
            where = f"of {one.name} " if len(facts.recordings) > 1 else ""
            yield (
                f"The drive {where}repeats, but for {share} % of its amplitude (rms). The model predicts the response"
                " better without this part, so it was left out as noise of the measurement."
            )


@remark("recordings")
def note_outliers(facts: Facts) -> Iterator[str]:
    """Yield a note for each recording of which single readings were left out."""
    for one in facts.recordings:
        if one.outliers:
            where = f" of {one.name}" if len(facts.recordings) > 1 else ""
            what = "single reading is an outlier" if one.outliers == 1 else "single readings are outliers"
            yield (
                f"{one.outliers} {what}, of {one.readings.size}{where}: so far from the prediction that noise does not"
                " explain it, while the readings after it agree with the model. The diagnosis does not use"
                f" {'it' if one.outliers == 1 else 'them'}."
            )


@remark("position")
def note_unknown_position(facts: Facts) -> Iterator[str]:
    """Yield a note if no sensor measures the position and its estimate is uncertain."""
    place = facts.position
    if place is None:
        return
    reach, amplitude = 2.0 * float(place.sd.max()), math.sqrt(2.0) * float(place.mean.std())
    if not reach > facts.settings.note.position * amplitude:
        return
    if not (math.isfinite(reach) and reach < amplitude):
        yield (
            "No sensor measures the position, and the recording does not determine it: do not trust results that depend"
            " on it."
        )
        return
    size = f"{rounded(reach)} rad" if facts.motion == "rotation" else f"{rounded(1e3 * reach)} mm"
    yield (
        f"No sensor measures the position: it is known to +-{size} only (2 standard deviations, largest over the"
        f" recording), {rounded(100.0 * reach / amplitude)} % of its amplitude. The intervals of what depends on the"
        " position, such as a gap, include this."
    )


NOTES: tuple[Remark, ...] = (
    Remark(("said",), lambda facts: facts.said),
    note_unrecorded_inputs,
    Remark(("contacts",), lambda facts: facts.contacts),
    note_bounds,
    note_large_errors,
    note_noise,
    note_moved_amplitudes,
    note_corrections,
    note_short_delays,
    note_budget,
    note_gauge_noise,
    note_outliers,
    note_repeated_motion,
    note_unknown_position,
)
"""The notes in their order."""


def write_notes(facts: Facts) -> tuple[str, ...]:
    """Return the notes of a diagnosis: those on the case and its recordings, and those on the result."""
    return write_remarks(NOTES, facts)
