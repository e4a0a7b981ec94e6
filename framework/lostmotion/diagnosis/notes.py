"""The notes of a diagnosis: sentences on its limitations."""

from __future__ import annotations

import math
from collections.abc import Sequence

from lostmotion.diagnosis.findings import Outcome
from lostmotion.diagnosis.free_decays import note_restarts
from lostmotion.diagnosis.repetition_notes import note_repetitions
from lostmotion.diagnosis.stages import SearchResult
from lostmotion.diagnosis.states import warn_of_moved_amplitudes, warn_of_short_delay
from lostmotion.inference.contacts import list_short_contacts
from lostmotion.inference.fit import Fit
from lostmotion.inference.unseen import smooth_body_position
from lostmotion.likelihood.initial import shows_place
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.sensor_noise import compute_variance
from lostmotion.results import percent, rounded

EDGE = 1e-3


def write_notes(outcome: Outcome, said: Sequence[str]) -> list[str]:
    """Return the notes of a diagnosis: those on the recordings (`said`), and those on the result."""
    d = outcome.diagnosis
    doubts = [
        *list_short_contacts(d.after),
        *_note_bounds(d),
        *_note_large_errors(outcome),
        *_note_noise(d),
    ]
    doubts += [text for key in d.named for text in warn_of_moved_amplitudes(d, key)]
    if d.corrections:
        told = ", ".join(d.corrections.describe(d.shown))
        doubts.append(
            f"Usual errors of channels and known values are corrected: {told}. They are within"
            " what acquisition systems and drawings usually have, so nothing is missing in the model for them."
        )
    doubts += [text for key in d.named for text in warn_of_short_delay(d, key)]
    if d.explained.skipped:
        doubts.append(
            f"The search used up its processor time after {len(d.explained.found)} explanations; what might be missing"
            f" beside {' or '.join(d.explained.skipped)} was not tried. A larger `--budget` continues the search."
        )
    again = note_repetitions(_list_recordings(d), d.train, d.held, d.settings.note)
    return [*said, *_note_unrecorded_inputs(d), *doubts, *again, *note_unknown_position(d.after, d.shown)]


def _list_recordings(d: SearchResult) -> tuple[Observation, ...]:
    """Return the recordings, each with its fitted and its held-out part."""
    return (*d.train, *d.held) if d.shown is d.held[0] else (d.shown,)


def _note_unrecorded_inputs(d: SearchResult) -> list[str]:
    """Return a note for each recording without an input in which an unrecorded input acted."""
    return [note for observation in _list_recordings(d) for note in note_restarts(observation)]


def _note_noise(d: SearchResult) -> list[str]:
    """Return the sentences of the noises of each sensor."""
    problem, theta, notes = d.after.problem, d.after.theta, []
    for i, sensor in enumerate(d.shown.sensors):
        whole, observation = problem.measurement(theta, 0, i), problem.observations[0]
        for noise, values in zip(
            problem.find_sensor(0, i).noises, problem.noise_values(theta[None], 0, i), strict=True
        ):
            p = tuple(values[0].tolist())
            part = compute_variance(noise.covariance(p, observation.dt), observation, i)
            if said := noise.words(p, part / whole):
                notes.append(f"{sensor.label}: {said}" if len(d.shown.sensors) > 1 else said)
    return notes


def note_large_noise(outcome: Outcome) -> list[str]:
    """Return a note for each sensor whose estimated noise is so large, in held-out data, that it may be motion."""
    d, notes = outcome.diagnosis, []
    problem, theta, limits = d.after.problem, d.after.theta, d.settings.note
    for i, (sensor, size) in enumerate(zip(d.shown.sensors, outcome.after.scales, strict=True)):
        middle = problem.observations[0].samples // 2
        whole, slow = problem.measurement(theta, 0, i), problem.noise(theta, 0, i).variance_after(middle)
        ar1, share = (v**0.5 / size for v in (slow, whole))
        if ar1 > limits.coloured or share > limits.noise:
            whose = f" of {sensor.label}" if len(d.shown.sensors) > 1 else ""
            kind = " is autocorrelated and" if ar1 > limits.coloured else ""
            notes.append(
                f"The estimated noise{whose}{kind} is {percent(share)} of the held-out readings: it may be motion that"
                " the model does not describe, such as another mode, or the sensor may not measure what the case states"
                " (check its sign and place). In both cases the result is not valid."
            )
    return notes


def _note_bounds(d: SearchResult) -> list[str]:
    """Return a note for each parameter at a bound of its prior."""
    notes = []
    for f, at in zip(d.after.problem.free, d.after.theta, strict=True):
        reach = EDGE * (f.high - f.low)
        if f.physical and "." not in f.parameter and not f.low + reach < at < f.high - reach:
            bound = f.value(f.low if at <= f.low + reach else f.high)
            notes.append(
                f"{f.key} is at the bound {rounded(bound, 4)} {f.unit} of its prior: widen the prior,"
                " or check the known"
                " values; the found terms may compensate for a wrong value."
            )
    return notes


def _note_large_errors(outcome: Outcome) -> list[str]:
    d = outcome.diagnosis
    noises = [d.after.problem.measurement(d.after.theta, 0, i) ** 0.5 for i in range(len(d.shown.sensors))]
    errors = zip(outcome.after.by_sensor, outcome.after.scales, noises, strict=True)
    far = min(error * scale / noise for error, scale, noise in errors)
    if far < d.settings.note.error:
        return []
    return [
        f"The error of free runs over held-out data is {rounded(far)} times the measurement noise: either something is"
        " missing that one-step errors do not show, or small errors of the state grow fast."
    ]


def note_unknown_position(fit: Fit, observation: Observation) -> list[str]:
    """Return a note if no sensor of a recording measures the position and its estimate is uncertain."""
    if shows_place(observation):
        return []
    place = smooth_body_position(fit, observation)
    reach, amplitude = 2.0 * float(place.sd.max()), math.sqrt(2.0) * float(place.mean.std())
    if not reach > fit.problem.settings.note.position * amplitude:
        return []
    if not (math.isfinite(reach) and reach < amplitude):
        return [
            "No sensor measures the position, and the recording does not determine it: do not trust results that depend"
            " on it."
        ]
    rotation, share = fit.problem.system.model.motion == "rotation", 100.0 * reach / amplitude
    size = f"{rounded(reach)} rad" if rotation else f"{rounded(1e3 * reach)} mm"
    return [
        f"No sensor measures the position: it is known to +-{size} only (2 standard deviations, largest over the"
        f" recording), {rounded(share)} % of its amplitude. The intervals of what depends on the"
        " position, such as a gap,"
        " include this."
    ]
