"""Measures that compare the behaviour of both models with the recording: before, after, and the noise floor."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.analysis.embed import embed
from lostmotion.analysis.period import find_return
from lostmotion.analysis.quantify import quantify
from lostmotion.contracts import Array, Series
from lostmotion.defaults import DIMENSION, EMBEDDER
from lostmotion.diagnosis.attractors import SectionDistance, measure_distances
from lostmotion.diagnosis.compare import Prediction, average_exponent_blocks
from lostmotion.diagnosis.decays import find_stretches
from lostmotion.diagnosis.findings import Outcome
from lostmotion.diagnosis.show_words import TRANSIENT, describe_behaviour
from lostmotion.errors import LostMotionError
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import Horizon, observe_states
from lostmotion.registry import Registry
from lostmotion.results import Estimate
from lostmotion.results.behaviour import (
    Behaviour,
    Chance,
    DimensionInterval,
    Distance,
    ExponentInterval,
    HorizonLength,
    MeasureTexts,
    ModelBehaviour,
    NoiseFloor,
    ValidTime,
)
from lostmotion.settings import MotionSettings
from lostmotion.signals import checked

PAIRS = 250_000
"""Pairs of points for a dimension; 20,000 samples take a few tenths of a second."""
LONGEST = 50_000
"""A dimension is estimated from at most this number of samples, those at the beginning."""
STUDENT = 2.262
"""The half width of the 95 % interval of a mean of ten blocks, in standard errors (Student's t)."""
FEWEST = 50
UNITS = MeasureTexts(
    heldout_log_score="1",
    free_run_error="1",
    valid_prediction_time="",
    attractor_distance="standard deviations of the motion",
    largest_exponent="1/s",
    d2="1",
    whiteness="1",
)
"""Units of the measures; that of the valid prediction time is the unit of the horizon."""
PERIODIC = "The motion is periodic: its orbit is a closed curve, and no dimension is estimated."


@dataclass(frozen=True)
class ShownMotions:
    """The outcome of a diagnosis, the motions (samples, n) of recording and models, all recordings, and the plugins."""

    outcome: Outcome
    motions: Mapping[str, Array]
    observations: tuple[Observation, ...]
    registry: Registry


def measure_behaviour(seen: ShownMotions, rng: np.random.Generator) -> Behaviour:
    """Return the measures of the motion: of the nominal model, of the augmented model if there is one, and of noise."""
    outcome, d = seen.outcome, seen.outcome.diagnosis
    both = {"before": (outcome.before, d.before)}
    if d.found:
        both["after"] = (outcome.after, d.after)
    dies = bool(find_stretches(d.shown))
    distances, strobed = (_refuse_distances(both), False) if dies else measure_distances(seen.motions, d.shown, rng)
    dimensions = _refuse_dimensions(both) if dies else _estimate_dimensions(seen, rng)
    models = {
        name: _describe_model(prediction, outcome.horizon, distances[name], dimensions[name])
        for name, (prediction, _) in both.items()
    }
    prediction, fit = both.get("after", both["before"])
    noise = math.sqrt(fit.problem.measurement(fit.theta))
    floor = NoiseFloor(
        heldout_log_score=prediction.expected_score,
        free_run_error=noise / prediction.scales[0],
        attractor_distance=_make_distance(distances["noise_floor"]),
        d2=_make_dimension(dimensions["recorded"]),
    )
    horizon = HorizonLength(outcome.horizon.number, outcome.horizon.unit)
    last = models.get("after", models["before"])
    return Behaviour(
        before=models["before"],
        after=models.get("after"),
        noise_floor=floor,
        units=replace(UNITS, valid_prediction_time=horizon.unit),
        horizon=horizon,
        says=describe_behaviour(last, floor, horizon, strobed, driven=not d.shown.free, limits=d.settings),
    )


def _describe_model(
    prediction: Prediction, horizon: Horizon, distance: SectionDistance, dimension: Estimate
) -> ModelBehaviour:
    return ModelBehaviour(
        heldout_log_score=prediction.log_score,
        free_run_error=prediction.nrmse,
        valid_prediction_time=ValidTime(
            prediction.valid_time / horizon.unit_time, bool(prediction.valid_time >= prediction.lead[-1])
        ),
        attractor_distance=_make_distance(distance),
        largest_exponent=_make_exponent(prediction),
        d2=_make_dimension(dimension),
        whiteness=Chance(prediction.white),
    )


def _refuse_distances(names: Iterable[str]) -> dict[str, SectionDistance]:
    """Return distances without a value: a motion that decays has no attractor."""
    return dict.fromkeys((*names, "noise_floor"), SectionDistance(math.nan, math.nan, TRANSIENT))


def _refuse_dimensions(names: Iterable[str]) -> dict[str, Estimate]:
    return dict.fromkeys((*names, "recorded"), Estimate.refused(TRANSIENT, "The motion dies away."))


def _make_distance(distance: SectionDistance) -> Distance:
    return Distance(distance.value, distance.chance, distance.status)


def _make_exponent(prediction: Prediction) -> ExponentInterval:
    """Return the largest Lyapunov exponent with an interval from the scatter over blocks of the recording."""
    value, blocks = prediction.exponent, average_exponent_blocks(prediction.rates)
    if not len(blocks) or not math.isfinite(value):
        return ExponentInterval(value, math.nan, math.nan, "too_short")
    half = STUDENT * float(np.std(blocks, ddof=1)) / math.sqrt(len(blocks))
    return ExponentInterval(value, value - half, value + half, "ok")


def _make_dimension(estimate: Estimate) -> DimensionInterval:
    return DimensionInterval(estimate.value, estimate.low, estimate.high, estimate.status, estimate.says)


def _estimate_dimensions(seen: ShownMotions, rng: np.random.Generator) -> dict[str, Estimate]:
    """Return the correlation dimensions of the recording and of free runs of the models, with the same embedding."""
    outcome, d = seen.outcome, seen.outcome.diagnosis
    observation, period = d.shown.part(0, min(d.shown.samples, LONGEST)), d.shown.period
    seconds = period * observation.dt if period else None
    finite = (
        observation.response[np.isfinite(observation.response)] if len(observation.response) else observation.response
    )
    fits = {"before": d.before, "after": d.after} if d.found else {"before": d.before}
    try:
        recorded = embed(finite, seen.registry.make("embedder", EMBEDDER), dt=observation.dt, period=seconds)
    except LostMotionError as err:
        return dict.fromkeys(("recorded", *fits), Estimate.refused("failed", str(err)))
    noise = math.sqrt(d.after.problem.measurement(d.after.theta)) / max(float(np.std(finite)), 1e-300)
    meter = DimensionEstimator(seen.registry, rng, d.settings.motion)
    found = {"recorded": meter.estimate(recorded, noise)}
    exponents = {"before": outcome.before.exponent, "after": outcome.after.exponent}
    for name, fit in fits.items():
        if not exponents[name] > 0.0:
            found[name] = Estimate.refused("regular", "The model is not chaotic: no dimension is estimated.")
            continue
        found[name] = meter.estimate_model(fit, observation, seen.motions[name][:LONGEST], recorded)
    return found


@dataclass(frozen=True)
class DimensionEstimator:
    """Estimates correlation dimensions, with the plugins of `registry`, unless a motion repeats by `limits`."""

    registry: Registry
    rng: np.random.Generator
    limits: MotionSettings

    def estimate(self, series: Series, noise: float) -> Estimate:
        """Return the dimension of a series with noise (share of its deviation); a refusal if the series is periodic."""
        if series.period and series.n * series.dt < FEWEST * series.period:
            return Estimate.refused("too_short", f"Fewer than {FEWEST} drive periods are too few for a dimension.")
        if series.period and find_return(series, series.period, noise, self.limits)[0]:
            return Estimate.refused("regular", PERIODIC)
        return quantify(series, self.registry.make("quantifier", DIMENSION, pairs=PAIRS), rng=self.rng)

    def estimate_model(self, fit: Fit, observation: Observation, states: Array, recorded: Series) -> Estimate:
        """Return the dimension of a free run of a model (samples, n), embedded like the `recorded` series."""
        x = observe_states(fit.problem.on((observation,)), fit.theta, states)
        if not np.isfinite(x).all():
            return Estimate.refused("diverged", "The free run diverges.")
        try:
            return self.estimate(replace(recorded, x=checked(x)), 0.0)
        except LostMotionError as err:
            return Estimate.refused("failed", str(err))
