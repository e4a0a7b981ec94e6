"""Changes of an experiment that would help: another level, frequency or waveform of the drive, or a second sensor.

Each is simulated with the nominal model and its noise, and compared by the information that it gives on all parameters
and terms. The excitations are those among which a diagnosis seeks the next experiment.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.case import Experiment
from lostmotion.contracts import Array
from lostmotion.diagnosis.excitations import (
    HARMONIC,
    Excitation,
    Limits,
    choose_limits,
    list_candidates,
    repeat_drive,
)
from lostmotion.diagnosis.expected_findings import is_static
from lostmotion.diagnosis.experiment import compute_natural_frequency
from lostmotion.diagnosis.rehearsal import RehearsedModel, simulate_recording
from lostmotion.evidence.forecast import Forecast, make_forecast
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.noise_levels import make_noise_levels
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.predict import observe_states
from lostmotion.noises import NOISE
from lostmotion.quantities import quantity_of, unit_of
from lostmotion.report.words import to_words
from lostmotion.results import rounded
from lostmotion.results.expectation import Improvement

SAMPLES = 1500
"""The number of samples that are simulated."""
WORTH = 0.9
"""A change is told where it makes the smallest sizes, or the intervals, at least this much smaller."""
MOST = 3
"""The number of changes that are told."""


@dataclass(frozen=True)
class _Precision:
    """The standard deviations of parameters and of amplitudes of terms, by name."""

    parameters: dict[str, float]
    effects: dict[str, float]

    def compare(self, usual: _Precision) -> tuple[float, float]:
        """Return the deviations over usual ones, geometric means, of parameters and of amplitudes."""
        return _average_ratio(self.parameters, usual.parameters), _average_ratio(self.effects, usual.effects)


def _average_ratio(now: dict[str, float], usual: dict[str, float]) -> float:
    shared = [now[key] / usual[key] for key in now if usual.get(key, 0.0) > 0.0 and math.isfinite(now[key])]
    return math.exp(float(np.mean(np.log(shared)))) if shared else 1.0


def list_improvements(
    nominal: Fit, keys: Sequence[str], allowed: Experiment | None, rng: np.random.Generator
) -> tuple[Improvement, ...]:
    """Return the changes that help most, within the limits that a case has for experiments; none without a drive."""
    observation = nominal.posterior.observations[0]
    if allowed is None or observation.free or not observation.travel:
        return ()
    natural = compute_natural_frequency(nominal)
    usual = choose_limits(observation, natural)
    limits = Limits(allowed.max_level or usual.level, allowed.max_frequency or usual.frequency)
    samples, static = min(SAMPLES, observation.samples), [key for key in keys if is_static(nominal.posterior, key)]
    model = RehearsedModel.of(nominal)
    first = repeat_drive(observation, samples, natural)
    base = _measure(model, first, static, rng)
    if base is None:
        return ()
    tried = [
        (_describe_excitation(one, observation, nominal.posterior), one, _measure(model, one, static, rng))
        for one in _choose_excitations(observation, samples, limits, rng)
    ]
    tried += [
        (f"Add a sensor of the {to_words(channel)}", first, _measure(model, first, static, rng, channel))
        for channel in _list_further_channels(nominal.posterior)
    ]
    rows = [_make_improvement(nominal.posterior, words, one, seen.compare(base)) for words, one, seen in tried if seen]
    useful = [row for row in rows if min(row.intervals, row.effects) < WORTH and max(row.intervals, row.effects) < 1.0]
    return tuple(sorted(useful, key=lambda row: row.intervals * row.effects)[:MOST])


def _choose_excitations(
    observation: Observation, samples: int, limits: Limits, rng: np.random.Generator
) -> Iterator[Excitation]:
    """Yield the candidates that change one thing: the level, the frequency, or the waveform."""
    level, moved = observation.travel, replace(observation, inputs=observation.inputs)
    period = observation.period
    frequency = 1.0 / (period * observation.dt) if period else math.nan
    for one in list_candidates(moved, samples, limits, rng):
        same = abs(one.level - level) < 0.05 * level
        near = abs(one.band[0] - frequency) < 0.05 * frequency
        factor = one.level / level if near else one.band[0] / frequency if same else math.nan
        if one.waveform == HARMONIC and (same or near):
            if min(abs(factor - 2.0), abs(factor - 0.5), abs(factor - 1.4)) < 0.1:
                yield one
        elif one.waveform != HARMONIC and same:
            yield one


def _list_further_channels(posterior: Posterior) -> list[str]:
    """Return the channels of motion that no sensor of a recording shows."""
    first, model = posterior.observations[0], posterior.system.model
    shown = {sensor.channel for sensor in first.sensors}
    return [c for c in model.channels if c not in shown and quantity_of(c) in ("position", "velocity", "acceleration")]


def _measure(
    model: RehearsedModel, excitation: Excitation, keys: Sequence[str], rng: np.random.Generator, channel: str = ""
) -> _Precision | None:
    """Return what a simulated recording tells, with a second sensor of `channel`; None where it diverges."""
    z = simulate_recording(model, excitation, rng)
    if z is None:
        return None
    posterior, theta = model.pose(excitation, z), model.get_coordinates(excitation)
    if channel:
        posterior, theta = _add_sensor(posterior, theta, channel, rng)
    fit = replace(model.fit, posterior=posterior, local=replace(model.fit.local, theta=theta))
    return _read_precision(make_forecast(fit, keys, posterior.observations))


def _read_precision(forecast: Forecast) -> _Precision:
    """Return the expected standard deviations of the physical parameters and of the first amplitudes of terms."""
    found = forecast.found
    sds = np.sqrt(np.maximum(np.diag(found.covariance), 0.0))
    own = {f.key: float(sd) for f, sd in zip(found.frame.posterior.space.free, sds, strict=False) if f.physical}
    places = {key: forecast.joined.blocks[key].start for key in forecast.effects}
    told = {key: float(forecast.information[place, place]) for key, place in places.items()}
    return _Precision(own, {key: value**-0.5 for key, value in told.items() if value > 0.0})


def _add_sensor(posterior: Posterior, theta: Array, channel: str, rng: np.random.Generator) -> tuple[Posterior, Array]:
    """Return a posterior with a second sensor, whose noise is as large a share of its readings as that of the first."""
    old = posterior.observations[0]
    share = math.sqrt(posterior.recordings[0].measurement(theta, 0)) / max(float(np.nanstd(old.readings[:, 0])), 1e-300)
    states = posterior.filters[0].smooth(theta).filtered
    sensor = replace(old.sensors[0], channel=channel, name="second", loose=False, noises=old.sensors[0].noises[:1])
    first = replace(old.sensors[0], name=old.sensors[0].label)
    bare = replace(posterior, observations=(replace(old, sensors=(sensor,), readings=old.readings[:, :1]),))
    seen = observe_states(bare, theta, states, sensor=0)
    seen = seen + share * float(np.std(seen)) * rng.standard_normal(len(seen))
    both = replace(old, sensors=(first, sensor), readings=np.column_stack([old.readings[:, 0], seen]))
    levels = make_noise_levels((both,), posterior.scales)
    kept = [i for i, f in enumerate(posterior.space.free) if f.level != NOISE]
    added = [f for f in levels if f.level == NOISE]
    sizes = [share * float(np.nanstd(z)) for z in both.readings.T]
    values = [math.log(size) for f, size in zip(added, sizes, strict=True)]
    wide = replace(posterior, observations=(both,)).over((*(posterior.space.free[i] for i in kept), *added))
    return wide, np.concatenate([theta[kept], values])


def _describe_excitation(one: Excitation, old: Observation, posterior: Posterior) -> str:
    """Return a change of the drive in the imperative."""
    model = posterior.system.model
    unit, low, high = unit_of(model.inputs[old.lead], model.motion), *(rounded(f, 3) for f in one.band)
    if abs(one.level / old.travel - 1.0) > 0.05:
        return f"{'Raise' if one.level > old.travel else 'Lower'} the drive to {rounded(one.level, 3)} {unit}"
    if one.waveform == HARMONIC:
        return f"Drive at {low} Hz"
    if one.waveform == "two tones":
        return f"Drive with two tones, of {low} and {high} Hz"
    return f"Drive with a {one.waveform} from {low} to {high} Hz"


def _make_improvement(posterior: Posterior, words: str, one: Excitation, ratios: tuple[float, float]) -> Improvement:
    model, old = posterior.system.model, posterior.observations[0]
    return Improvement(
        change=words,
        waveform=one.waveform,
        level=one.level,
        unit=unit_of(model.inputs[old.lead], model.motion),
        band=one.band,
        intervals=ratios[0],
        effects=ratios[1],
    )
