"""Sentences on the measures of `show`."""

from __future__ import annotations

import math

from lostmotion.report.words import span
from lostmotion.results import rounded
from lostmotion.results.behaviour import (
    DimensionInterval,
    Distance,
    ExponentInterval,
    HorizonLength,
    MeasureTexts,
    ModelBehaviour,
    NoiseFloor,
)
from lostmotion.settings import DEFAULT, Settings

TRANSIENT = "transient"
"""The status of a measure of attractors if the motion decays; it has no sentence."""
ABSENT = "absent"
"""The status of a measure that no installed package offers."""
DIFFERENT, POSSIBLE = 0.01, 0.05
"""A distance between attractors is significant, or may be, when its p-value is below this."""


def describe_behaviour(
    last: ModelBehaviour,
    floor: NoiseFloor,
    horizon: HorizonLength,
    strobed: bool,
    *,
    driven: bool = True,
    limits: Settings = DEFAULT,
) -> MeasureTexts:
    """Return a sentence on each measure of the last model; `driven` states whether an input was recorded.

    A p-value of whiteness below `name.white` is reported as a finding, and below five times that as a possibility.
    """
    return MeasureTexts(
        heldout_log_score=_describe_score(last, floor),
        free_run_error=_describe_error(last, floor, horizon),
        valid_prediction_time=_describe_valid_time(last),
        attractor_distance=_describe_distance(last.attractor_distance, strobed),
        largest_exponent=_describe_exponent(last.largest_exponent, driven=driven),
        d2=_describe_dimension(floor.d2, last.d2),
        whiteness=_describe_whiteness(last.whiteness.p, limits.name.white),
    )


def _describe_score(last: ModelBehaviour, floor: NoiseFloor) -> str:
    short = floor.heldout_log_score - last.heldout_log_score
    opening = "Log density of held-out samples, one step ahead"
    if short < 0.02:
        return f"{opening}: equal to the value that the last model predicts."
    return f"{opening}: {rounded(short)} per sample below the value that the last model predicts."


def _describe_error(last: ModelBehaviour, floor: NoiseFloor, horizon: HorizonLength) -> str:
    ratio = last.free_run_error / max(floor.free_run_error, 1e-300)
    length = span(horizon.value, horizon.unit)
    opening = f"Error of free runs over {length}, relative to the standard deviation of the response"
    if ratio < 1.2:
        return f"{opening}: no more than the measurement noise."
    return f"{opening}: {rounded(ratio)} times the measurement noise."


def _describe_valid_time(last: ModelBehaviour) -> str:
    opening = "Time during which the error of a free run is below 40 % of the motion, median over starts"
    if last.valid_prediction_time.or_longer:
        return f"{opening}: longer than the runs that were computed."
    return f"{opening}."


def _describe_distance(entry: Distance, strobed: bool) -> str:
    where = "Poincaré sections (one point per drive period)" if strobed else "points of position and velocity"
    opening = f"Energy distance between {where} of recording and free run"
    if entry.status == TRANSIENT:
        return ""
    if entry.status == ABSENT:
        return f"{opening}: not measured, as no installed package does so."
    if entry.status == "too_short":
        return f"{opening}: the recording has too few points."
    if entry.status != "ok":
        return f"{opening}: the free run diverges."
    closing = "the noise floor is the distance between the halves of the recording"
    if entry.p < DIFFERENT:
        return f"{opening}: the difference is significant (p = {rounded(entry.p)}); {closing}."
    if entry.p < POSSIBLE:
        return f"{opening}: the difference may be significant (p = {rounded(entry.p)}); {closing}."
    return f"{opening}: the difference is not significant (p = {rounded(entry.p)}); {closing}."


def _describe_exponent(entry: ExponentInterval, *, driven: bool) -> str:
    opening = f"Of the model {'under the recorded drive' if driven else 'without a drive'}"
    if math.isnan(entry.low):
        return f"{opening}; the recording is too short for an interval."
    kind = "positive, chaos" if entry.low > 0.0 else "negative, no chaos" if entry.high < 0.0 else "its sign is open"
    return f"{opening}, with the scatter over ten blocks: {kind} ({rounded(entry.value, 3)} 1/s)."


def _describe_dimension(recorded: DimensionInterval, model: DimensionInterval) -> str:
    opening = "Of the recording (as noise floor) and of free runs without noise"
    if recorded.status == TRANSIENT:
        return ""
    for entry, whose in ((recorded, "the recording"), (model, "the free run")):
        if entry.status not in ("ok", "uncertain"):
            return f"{opening}; {whose}: {entry.says}"
    meet = recorded.low <= model.high and model.low <= recorded.high
    return f"{opening}: their intervals {'overlap' if meet else 'do not overlap'}."


def _describe_whiteness(p: float, certain: float) -> str:
    if p < certain:
        return "Ljung-Box test of one-step errors: they are autocorrelated, so a part of them can be predicted."
    if p < 5.0 * certain:
        return f"Ljung-Box test of one-step errors: they may be autocorrelated (p = {rounded(p)})."
    return "Ljung-Box test of one-step errors: they are not distinguishable from white noise."
