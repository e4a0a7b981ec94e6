"""Free decays in a diagnosis: of the recording, cycle by cycle, and of free runs of the models from the same starts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.diagnosis.stages import SearchResult
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import observe_states, simulate_run
from lostmotion.quantities import quantity_of, unit_of
from lostmotion.recording.warnings import is_impulsive
from lostmotion.report.words import choose_scale, to_words
from lostmotion.results import percent, rounded
from lostmotion.results.behaviour import DecayCycles, Decays
from lostmotion.signals.decay import Decay, decay_of
from lostmotion.signals.impacts import hits_of, onsets_of
from lostmotion.signals.trends import says

MOST_STRETCHES, MOST_CYCLES = 10, 240
"""The numbers of hits, and of cycles of all of them together, that are evaluated (0.1 to 0.2 s of computation)."""
DIGITS = 5
BOUND = 1e3
"""A free run beyond this multiple of the largest reading has diverged."""
PARTS, FEWEST = 8, 3
"""Parts of a decay in which a model is compared with the recording, and the fewest cycles of a part."""
OVERLAP = 5
"""The number of neighbouring cycles with common noise."""
REACH = 1.2
"""Ratio of amplitudes by which the ends of the decay of a model are extrapolated."""
NONE_MEASURED = (
    "No free decay could be measured: this requires at least four cycles of one mode that exceed the noise and fall by"
    " at least 10 %."
)


@dataclass(frozen=True)
class DecayOptions:
    """When a part of a decay is compared with that of a model, and when two values agree; errors are relative."""

    known: float = 0.02
    """A part is compared when its decrement or frequency has a smaller standard error."""
    certain: float = 3.0
    """A part is also compared when the model differs by this many standard errors."""
    change: float = 0.05
    """A decrement that changes by less than this share is constant; a frequency with a tenth of it."""
    decrement: float = 0.15
    """A model has the recorded decrement when its error is below this."""
    frequency: float = 0.02
    """A model has the recorded frequency when its error is below this."""


OPTIONS = DecayOptions()


class DecayStretch(NamedTuple):
    """The samples from `start` up to `stop` of a recording, in which nothing drives the machine."""

    start: int
    stop: int


def describe_decays(d: SearchResult) -> Decays | None:
    """Return the free decays of the shown recording and of both models; None if there are none.

    For an undriven recording without a measurable decay the result has a sentence only.
    """
    stretches = find_stretches(d.shown)
    most = MOST_CYCLES // max(len(stretches), 1)
    seen = [(s, decay_of(d.shown.response[s.start : s.stop], d.shown.dt, most=most)) for s in stretches]
    measured = [(stretch, decay) for stretch, decay in seen if decay is not None]
    if not measured:
        return Decays(NONE_MEASURED) if d.shown.free else None
    models = {"before": _measure_model(d.before, d.shown, measured)}
    if d.found:
        models["after"] = _measure_model(d.after, d.shown, measured)
    unit = unit_of(d.shown.channel, d.after.posterior.system.model.motion)
    rows = {
        name: tuple(_list_cycles(stretch, made, d.shown) for stretch, made in pairs if made)
        for name, pairs in models.items()
    }
    text = _describe_decay(d, measured, {name: [decay for _, decay in pairs] for name, pairs in models.items()}, unit)
    recorded = tuple(_list_cycles(stretch, decay, d.shown) for stretch, decay in measured)
    return Decays(text, unit, recorded, rows["before"], rows.get("after"))


def find_stretches(observation: Observation) -> tuple[DecayStretch, ...]:
    """Return the undriven stretches: between onsets if no input was recorded, or between hits of a hammer."""
    if observation.free:
        starts = sorted({0, *onsets_of(observation.response, observation.dt)})
        ends = [*starts[1:], observation.samples]
        return tuple(map(DecayStretch, starts, ends))[:MOST_STRETCHES]
    if not is_struck(observation):
        return ()
    hits = hits_of(observation.excitation, observation.dt)
    ends = [*(hit.start for hit in hits[1:]), observation.samples]
    pairs = (DecayStretch(hit.stop, end) for hit, end in zip(hits, ends, strict=True))
    return tuple(pair for pair in pairs if pair.stop > pair.start)[:MOST_STRETCHES]


def is_struck(observation: Observation) -> bool:
    """Return whether the only input is the force of a hammer."""
    one = observation.driven is not None and len(observation.driven) == 1
    if not one or quantity_of(observation.driven[0]) != "force":  # type: ignore[index]
        return False
    return bool(observation.excitation.any()) and is_impulsive(observation.excitation)


def note_restarts(observation: Observation) -> Iterator[str]:
    """Yield a note if a vibration starts again in a recording without any input."""
    if not observation.free:
        return
    times = [
        f"{rounded(place * observation.dt, 4)} s" for place in onsets_of(observation.response, observation.dt) if place
    ]
    if times:
        where = times[0] if len(times) == 1 else f"{', '.join(times[:-1])} and {times[-1]}"
        yield (
            f"{observation.name}: no input was recorded, but the vibration starts again at {where} after the start: an"
            " unrecorded input acted there, and the fit interprets it as missing physics. Cut the recording with"
            " t_start and t_end so that each part has one decay, or record the force and give it as an input."
        )


Measured = Sequence[tuple[DecayStretch, Decay]]


def _measure_model(fit: Fit, observation: Observation, measured: Measured) -> list[tuple[DecayStretch, Decay | None]]:
    """Return the decay of a free run of a model from the start of each measured decay; None if it has none."""
    posterior = fit.posterior.on((observation,))
    states = posterior.filters[0].smooth(fit.theta).states
    bound = BOUND * float(np.nanmax(np.abs(observation.response)))
    most, found = MOST_CYCLES // len(measured), []
    for stretch, seen in measured:
        start, stop = stretch
        run = simulate_run(posterior, fit.theta, states[start], start, stop - start)
        decay = None
        if np.all(np.abs(run) < 1e100):
            shown = observe_states(posterior, fit.theta, run, (start, 0))
            decay = _measure_same_mode(shown, observation.dt, seen, most) if np.all(np.abs(shown) < bound) else None
        found.append((stretch, decay))
    return found


def _measure_same_mode(shown: Array, dt: float, seen: Decay, most: int) -> Decay | None:
    """Return the decay of a run (samples,) in the mode closest to the measured one, or else in its strongest mode."""
    near = decay_of(shown, dt, noise=seen.noise, near=float(np.median(seen.frequency)), most=most)
    return near or decay_of(shown, dt, noise=seen.noise, most=most)


def _list_cycles(stretch: DecayStretch, decay: Decay, observation: Observation) -> DecayCycles:
    """Return the cycles of a decay, with the time from the start of the recording."""
    return DecayCycles(
        time=_round_values(decay.time + (observation.begin + stretch.start) * observation.dt),
        amplitude=_round_values(decay.amplitude),
        frequency=_round_values(decay.frequency),
        decrement=_round_values(decay.decrement),
        damping_ratio=_round_values(decay.damping_ratio),
    )


def _round_values(values: Array) -> tuple[float, ...]:
    return tuple(float(f"{value:.{DIGITS}g}") for value in values)


def _describe_decay(d: SearchResult, measured: Measured, models: dict[str, list[Decay | None]], unit: str) -> str:
    """Return a sentence on the decay with the largest range of amplitudes, and on the errors of the models."""
    widest = max(range(len(measured)), key=lambda i: float(np.ptp(np.log(measured[i][1].amplitude))))
    stretch, decay = measured[widest]
    scale = choose_scale(float(decay.amplitude.max()), unit)
    opening = ""
    if len(measured) > 1:
        begun = (d.shown.begin + stretch.start) * d.shown.dt
        opening = f"Of {len(measured)} decays, that from {rounded(begun, 4)} s has the largest range: "
    words = says(decay, scale.unit, factor=scale.factor)
    parts = [_compare_decays(_name_model(d, name), decay, made[widest]) for name, made in models.items()]
    compared = "; ".join(parts)
    return f"{opening}{words if not opening else words[:1].lower() + words[1:]} {compared[:1].upper()}{compared[1:]}."


def _name_model(d: SearchResult, version: str) -> str:
    if not d.found:
        return "the model"
    if version == "before":
        return "the nominal model"
    terms = [to_words(find_term(d.after.posterior, key)[0].name) for key in d.named]
    terms += ["the learned curve"] if d.learned else []
    return f"the model with {' and '.join([', '.join(terms[:-1]), terms[-1]] if len(terms) > 1 else terms)}"


def _compare_decays(who: str, seen: Decay, made: Decay | None) -> str:
    """Return a clause on the difference between the decay of a model and the recorded one."""
    if made is None:
        return f"a free run of {who} has no measurable decay"
    loss, pitch = (compute_largest_error(seen, made, name) for name in ("decrement", "frequency"))
    if math.isnan(loss):
        return f"{who} has too few amplitudes in common with the recording for a comparison"
    if loss < OPTIONS.decrement and pitch < OPTIONS.frequency:
        return (
            f"{who} has the recorded decrement to within {percent(loss)} and the frequency to within {percent(pitch)}"
        )
    loss_range = _describe_range(made.decrement, OPTIONS.change, "a decrement")
    pitch_range = _describe_range(made.frequency, 0.1 * OPTIONS.change, "a frequency", " Hz")
    return (
        f"{who} decays with {loss_range}, up to {percent(loss)} from the recorded one, and {pitch_range}, up to"
        f" {percent(pitch)} from it"
    )


def _describe_range(values: Array, share: float, what: str, unit: str = "") -> str:
    """Return for example "a decrement of 0.094 at all amplitudes", or its first and last values during the decay."""
    middle, first, last = (float(v) for v in (np.median(values), values[0], values[-1]))
    if abs(last - first) < share * abs(middle):
        return f"{what} of {rounded(middle, 3)}{unit} at all amplitudes"
    return f"{what} that changes from {rounded(first, 3)} to {rounded(last, 3)}{unit}"


def compute_largest_error(seen: Decay, made: Decay, name: str) -> float:
    """Return the largest relative error of a model in the recorded `name`, over at most eight parts of the decay.

    Only common amplitudes are compared; NaN if there are too few. Cycles are weighted by the squared amplitude. A part
    counts if its mean has a standard error of at most 2 % (neighbouring cycles have common noise), or if the model is
    three standard errors away; if no part counts, all cycles are one part.
    """
    order = np.argsort(made.amplitude)
    size = made.amplitude[order]
    shared = np.flatnonzero((seen.amplitude > size[0] / REACH) & (seen.amplitude < size[-1] * REACH))
    if shared.size < FEWEST:
        return math.nan
    expected = np.interp(np.log(seen.amplitude[shared]), np.log(size), getattr(made, name)[order])
    values, errors = getattr(seen, name)[shared], getattr(seen, f"{name}_error")[shared]
    weights = seen.amplitude[shared] ** 2

    def part(inside: NDArray[np.intp]) -> tuple[float, bool]:
        model, true = (float(np.average(v[inside], weights=weights[inside])) for v in (expected, values))
        error = math.sqrt(OVERLAP * float(np.sum((weights * errors)[inside] ** 2))) / float(np.sum(weights[inside]))
        apart, scale = abs(model - true), max(abs(true), 1e-300)
        return apart / scale, error < OPTIONS.known * scale or apart > OPTIONS.certain * error

    parts = np.array_split(np.arange(shared.size), min(PARTS, shared.size // FEWEST))
    counted = [share for share, counts in map(part, parts) if counts]
    return max(counted) if counted else part(np.arange(shared.size))[0]
