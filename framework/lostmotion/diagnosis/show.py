"""Measures that compare the behaviour of both models with the recording: before, after, and the noise floor."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.defaults import ATTRACTORS
from lostmotion.diagnosis.compare import Prediction, average_exponent_blocks
from lostmotion.diagnosis.free_decays import find_stretches
from lostmotion.diagnosis.outcome import Outcome
from lostmotion.diagnosis.show_words import ABSENT, TRANSIENT, describe_behaviour
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import Horizon, observe_states
from lostmotion.offers import MEASURE
from lostmotion.registry import Registry
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
from lostmotion.subjects import Attractors, Motions

STUDENT = 2.262
"""The half width of the 95 % interval of a mean of ten blocks, in standard errors (Student's t)."""
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


def measure_behaviour(
    outcome: Outcome, states: Mapping[str, Array], registry: Registry, rng: np.random.Generator
) -> Behaviour:
    """Return the measures of the motion: of the nominal model, of the augmented model if there is one, and of noise.

    `states` (samples, n) are those of `list_motions`.
    """
    d = outcome.diagnosis
    both = {"before": (outcome.before, d.before)}
    if d.found:
        both["after"] = (outcome.after, d.after)
    attractors = measure_attractors(outcome, states, registry, rng)
    models = {
        name: _describe_model(prediction, outcome.horizon, attractors.distances[name], attractors.dimensions[name])
        for name, (prediction, _) in both.items()
    }
    prediction, fit = both.get("after", both["before"])
    noises = [math.sqrt(fit.posterior.recordings[0].measurement(fit.theta, i)) for i in range(len(prediction.scales))]
    floor = NoiseFloor(
        heldout_log_score=prediction.expected_score,
        free_run_error=float(np.mean(np.divide(noises, prediction.scales))),
        attractor_distance=attractors.distances["noise_floor"],
        d2=attractors.dimensions["recorded"],
    )
    horizon = HorizonLength(outcome.horizon.number, outcome.horizon.unit)
    last = models.get("after", models["before"])
    return Behaviour(
        before=models["before"],
        after=models.get("after"),
        noise_floor=floor,
        units=replace(UNITS, valid_prediction_time=horizon.unit),
        horizon=horizon,
        says=describe_behaviour(
            last, floor, horizon, attractors.stroboscopic, driven=not d.shown.free, limits=d.settings
        ),
    )


def _describe_model(
    prediction: Prediction, horizon: Horizon, distance: Distance, dimension: DimensionInterval
) -> ModelBehaviour:
    return ModelBehaviour(
        heldout_log_score=prediction.log_score,
        free_run_error=prediction.nrmse,
        valid_prediction_time=ValidTime(
            prediction.valid_time / horizon.unit_time, bool(prediction.valid_time >= prediction.lead[-1])
        ),
        attractor_distance=distance,
        largest_exponent=_make_exponent(prediction),
        d2=dimension,
        whiteness=Chance(prediction.white),
    )


def measure_attractors(
    outcome: Outcome, states: Mapping[str, Array], registry: Registry, rng: np.random.Generator
) -> Attractors:
    """Return what a package measures of the attractors; a motion that decays has none."""
    d = outcome.diagnosis
    if refused := refuse_attractors(d.shown, registry):
        return refused
    models = {"before": (outcome.before, d.before)} | ({"after": (outcome.after, d.after)} if d.found else {})
    runs = {
        name: observe_states(fit.posterior.on((d.shown,)), fit.theta, states[name]) for name, (_, fit) in models.items()
    }
    motions = Motions(
        states=states,
        responses={"recorded": d.shown.response, **runs},
        exponents={name: prediction.exponent for name, (prediction, _) in models.items()},
        dt=d.shown.dt,
        period=d.shown.period,
        noise=math.sqrt(d.after.posterior.recordings[0].measurement(d.after.theta)),
    )
    measured: Attractors = registry.function(MEASURE, ATTRACTORS)(motions, registry, rng)
    return measured


def refuse_attractors(shown: Observation, registry: Registry) -> Attractors | None:
    """Return why attractors are not measured: the motion decays, or no package measures them; None if they are."""
    if find_stretches(shown):
        return Attractors.refused(TRANSIENT, "The motion dies away.")
    if ATTRACTORS not in registry.offered(MEASURE):
        return Attractors.refused(ABSENT, f"Not measured: {registry.explain_absence(MEASURE, ATTRACTORS)}.")
    return None


def _make_exponent(prediction: Prediction) -> ExponentInterval:
    """Return the largest Lyapunov exponent with an interval from the scatter over blocks of the recording."""
    value, blocks = prediction.exponent, average_exponent_blocks(prediction.rates)
    if not len(blocks) or not math.isfinite(value):
        return ExponentInterval(value, math.nan, math.nan, "too_short")
    half = STUDENT * float(np.std(blocks, ddof=1)) / math.sqrt(len(blocks))
    return ExponentInterval(value, value - half, value + half, "ok")
