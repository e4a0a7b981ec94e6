"""What a recording can tell, from its nominal fit: expected intervals, and the smallest effects that would be named."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import place_of
from lostmotion.diagnosis.excitations import repeat_drive
from lostmotion.diagnosis.experiment import compute_natural_frequency
from lostmotion.diagnosis.rehearsal import RehearsedModel, simulate_recording
from lostmotion.diagnosis.stages import list_fitted_keys
from lostmotion.evidence.forecast import Detectable, Forecast, make_forecast, measure_levels
from lostmotion.evidence.hypothesis import WAVE
from lostmotion.inference.curves import add_all_curves
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import find_term
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM
from lostmotion.likelihood.system import Slot
from lostmotion.report.words import angles_in, format_size, sentence, to_words
from lostmotion.results import Interval, percent
from lostmotion.results.absent import UnlimitedTerm
from lostmotion.results.expectation import Detection, Expectation, ParameterPair

CORRELATED = 0.95
"""Two parameters with a larger correlation are hardly told apart."""
SIMULATED = 2000
"""The samples of a simulated recording."""
NORMAL = 1.959964
"""The half width of a 95 % interval in standard deviations."""


def forecast_recordings(nominal: Fit, recordings: Sequence[Observation], rng: np.random.Generator) -> Forecast:
    """Return the forecast for whole `recordings`, of which a nominal fit has a part, with the usual discrepancy.

    What a larger random force hides is measured in a simulated recording.
    """
    samples = sum(o.samples for o in recordings)
    keys = list_fitted_keys(nominal.posterior.system)
    repeated = max(samples / nominal.posterior.samples, 1.0)
    forecast = make_forecast(add_all_curves(nominal), keys, recordings, repeated=repeated)
    if not forecast.valid or (simulated := _simulate(nominal, rng)) is None:
        return forecast
    static = [key for key in keys if is_static(nominal.posterior, key)]
    return replace(forecast, levels=measure_levels(simulated, static, samples))


def _simulate(nominal: Fit, rng: np.random.Generator) -> Fit | None:
    """Return the nominal fit on a simulated recording with the usual random force; None where it diverges."""
    theta = nominal.theta.copy()
    for i, f in enumerate(nominal.posterior.space.free):
        if f.parameter == RANDOM:
            theta[i] = min(theta[i], f.mean)
    usual = replace(nominal, local=replace(nominal.local, theta=theta))
    observation, model = nominal.posterior.observations[0], RehearsedModel.of(usual)
    excitation = repeat_drive(observation, min(SIMULATED, observation.samples), compute_natural_frequency(nominal))
    seen = simulate_recording(model, excitation, rng)
    if seen is None:
        return None
    moved = replace(usual.local, theta=model.get_coordinates(excitation))
    return replace(usual, posterior=model.pose(excitation, seen), local=moved)


def is_static(posterior: Posterior, key: str) -> bool:
    """Return whether the effect of a term costs no run of the filter."""
    term, _ = find_term(posterior, key)
    return term.acts in ("motion", "drive") and not term.states


def describe_expectation(forecast: Forecast, yardstick: str, angle: str = "rad") -> Expectation:
    """Return what a recording can tell, with angles in sentences in the unit `angle`."""
    posterior = forecast.found.frame.posterior
    with angles_in(angle):
        rows = forecast.list_detectable()
        effects = [_make_detection(posterior, row, yardstick) for row in rows if math.isfinite(row.size)]
        seen = {(one.mechanism, one.at) for one in effects}
        lost = {row.key: row for row in rows if name_term(posterior, row.key) not in seen}
        unseen = tuple(_make_unseen(posterior, row) for row in lost.values())
    effects.sort(key=lambda one: (one.share_of_drive is None, one.share_of_drive or 0.0))
    return Expectation(
        parameters=_list_intervals(forecast), pairs=_list_pairs(forecast), effects=tuple(effects), unseen=unseen
    )


def _list_intervals(forecast: Forecast) -> Mapping[str, Interval]:
    """Return the expected interval of each physical parameter, within its bounds."""
    found = forecast.found
    sds = np.sqrt(np.maximum(np.diag(found.covariance), 0.0))
    rows = {}
    for f, at, sd in zip(found.frame.posterior.space.free, found.theta, sds, strict=False):
        if f.physical:
            ends = [f.value(min(max(float(at) + side * NORMAL * float(sd), f.low), f.high)) for side in (-1.0, 1.0)]
            rows[f.key] = Interval(float(f.value(float(at))), float(ends[0]), float(ends[1]), f.unit)
    return rows


def _list_pairs(forecast: Forecast) -> tuple[ParameterPair, ...]:
    """Return the pairs of physical parameters whose expected correlation is large, the largest first.

    Known values and channels are taken as exact: their errors scale all parameters together.
    """
    found, own_count = forecast.found, forecast.found.frame.own
    covariance = solve_scaled(found.precision[:own_count, :own_count], np.eye(own_count))
    sds = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    correlation = covariance / np.outer(sds, sds)
    own = [(i, f.key) for i, f in enumerate(found.frame.posterior.space.free[:own_count]) if f.physical]
    rows = [
        ParameterPair(one, other, float(np.clip(correlation[i, j], -1.0, 1.0)))
        for (i, one), (j, other) in itertools.combinations(own, 2)
    ]
    return tuple(sorted((r for r in rows if abs(r.correlation) > CORRELATED), key=lambda r: -abs(r.correlation)))


def name_term(posterior: Posterior, key: str) -> tuple[str, str]:
    """Return name and place of a term."""
    term, _ = find_term(posterior, key)
    return term.name, term.at


def _make_detection(posterior: Posterior, row: Detectable, yardstick: str) -> Detection:
    term, slots = find_term(posterior, row.key)
    shape = list_shape(slots, row.shape)
    share = row.share if math.isfinite(row.share) else None
    rivals = tuple(dict.fromkeys(find_term(posterior, key)[0].name for key in row.rivals))
    beside = f", not told from {' or '.join(map(to_words, rivals))}" if rivals else ""
    return Detection(
        mechanism=term.name,
        at=term.at,
        parameter=name_amplitude(row.slots),
        smallest=row.size,
        unit=row.slots[0].unit,
        share_of_drive=share,
        given={slot.param.name: row.shape[slot.key] for slot in shape},
        confused_with=rivals,
        says=f"{describe_term(posterior, row.key, row.slots)}"
        f" from {describe_size(posterior, row.key, row.slots, row.size)}"
        f"{describe_share(share, yardstick)}{beside}{describe_shape(shape, row.shape)}",
    )


def _make_unseen(posterior: Posterior, row: Detectable) -> UnlimitedTerm:
    term, _ = find_term(posterior, row.key)
    why = "it would hardly show, or as something else"
    if row.alike:
        why = f"the parameter {row.alike} has the same effect"
    elif not row.linear:
        why = "its effect is not proportional to its size where it is small, so no size can be predicted"
    name = sentence(describe_place(posterior, row.key))
    return UnlimitedTerm(term.name, term.at, f"{name} has no size from which it is named: {why}.")


def name_amplitude(slots: Sequence[Slot]) -> str:
    """Return the name of an amplitude; that of the two of a wave is `amplitude`."""
    name = slots[0].param.name
    return "amplitude" if name in WAVE else name


def describe_share(share: float | None, yardstick: str) -> str:
    """Return a share of the drive, or of another yardstick, in brackets; empty where it is not known."""
    return "" if share is None else f" ({percent(share)} of {yardstick})"


def list_shape(slots: Sequence[Slot], values: Mapping[str, float]) -> list[Slot]:
    """Return the slots of a term whose values are numbers that a reader needs."""
    return [slot for slot in slots if slot.key in values and not slot.param.prior.words]


def describe_shape(shape: Sequence[Slot], values: Mapping[str, float]) -> str:
    """Return the values of the other parameters of a term, as the end of a sentence."""
    shown = ", ".join(f"{to_words(slot.param.name)} {format_size(values[slot.key], slot.unit)}" for slot in shape)
    return f", for {shown}" if shown else ""


def describe_term(posterior: Posterior, key: str, bounded: Sequence[Slot]) -> str:
    """Return a term in words, with its place and its amplitude where there are several."""
    return describe_place(posterior, key) + ("" if is_alone(posterior, key, bounded) else f" with {name_one(bounded)}")


def describe_size(posterior: Posterior, key: str, bounded: Sequence[Slot], size: float) -> str:
    """Return a size with its unit; a number without one is told with its name, unless `describe_term` tells it."""
    text = format_size(size, bounded[0].unit)
    named = bounded[0].unit == "1" and is_alone(posterior, key, bounded)
    return f"{name_one(bounded)} of {text}" if named else text


def is_alone(posterior: Posterior, key: str, bounded: Sequence[Slot]) -> bool:
    """Return whether a term has no other amplitude than the bounded ones."""
    _, slots = find_term(posterior, key)
    return sum(slot.param.null is not None for slot in slots) == len(bounded)


def name_one(bounded: Sequence[Slot]) -> str:
    """Return the name of an amplitude in words, with its article."""
    name = to_words(name_amplitude(bounded))
    return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def describe_place(posterior: Posterior, key: str) -> str:
    """Return the name of a term in words, with its place where the machine has several of its kind."""
    term, _ = find_term(posterior, key)
    model, first = posterior.system.model, posterior.observations[0]
    counts = {"sensor": len(first.sensors), "drive": len(first.driven or ("",))}
    several = counts.get(term.acts, len(model.places)) > 1
    place = place_of(model, term).name if term.acts == "motion" else term.at
    return f"{to_words(term.name)} at the {place}" if several else to_words(term.name)
