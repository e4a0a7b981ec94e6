"""The sentences beside the numbers of a `show`."""

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
from lostmotion.settings import DEFAULT

LUCK, DOUBTFUL = 0.01, 0.05
TRANSIENT = "transient"
"""The status of a measure of attractors where the motion dies away: nothing is said of it."""


def describe_behaviour(
    last: ModelBehaviour,
    floor: NoiseFloor,
    horizon: HorizonLength,
    strobed: bool,
    *,
    driven: bool = True,
    white: float = DEFAULT.name.white,
) -> MeasureTexts:
    """Return a sentence on each measure of the last model; `driven` says whether an input was recorded.

    A p-value of whiteness below `white` is told as a finding, and below five times that as a doubt.
    """
    return MeasureTexts(
        heldout_log_score=_describe_score(last, floor),
        free_run_error=_describe_error(last, floor, horizon),
        valid_prediction_time=_describe_valid_time(last),
        attractor_distance=_describe_distance(last.attractor_distance, strobed),
        largest_exponent=_describe_exponent(last.largest_exponent, driven=driven),
        d2=_describe_dimension(floor.d2, last.d2),
        whiteness=_describe_whiteness(last.whiteness.p, white),
    )


def _describe_score(last: ModelBehaviour, floor: NoiseFloor) -> str:
    short = floor.heldout_log_score - last.heldout_log_score
    opening = "Log density of held-out samples, one step ahead"
    if short < 0.02:
        return f"{opening}: as high as the last model itself expects."
    return f"{opening}: {rounded(short)} per sample below what the last model itself expects."


def _describe_error(last: ModelBehaviour, floor: NoiseFloor, horizon: HorizonLength) -> str:
    ratio = last.free_run_error / max(floor.free_run_error, 1e-300)
    opening = f"Free runs over {span(horizon.value, horizon.unit)}, over the deviation of the response"
    if ratio < 1.2:
        return f"{opening}: no more than the measurement noise."
    return f"{opening}: {rounded(ratio)} times the measurement noise."


def _describe_valid_time(last: ModelBehaviour) -> str:
    opening = "How long a free run errs by less than 40 % of the motion, median over starts"
    if last.valid_prediction_time.or_longer:
        return f"{opening}: longer than it was followed."
    return f"{opening}."


def _describe_distance(entry: Distance, strobed: bool) -> str:
    where = "Poincaré sections once each drive period" if strobed else "looks at position and velocity"
    opening = f"Energy distance between {where} of recording and free run"
    if entry.status == TRANSIENT:
        return ""
    if entry.status == "too_short":
        return f"{opening}: the recording holds too few points."
    if entry.status != "ok":
        return f"{opening}: the free run leaves all bounds."
    closing = "the floor is that between the halves of the recording"
    if entry.p < LUCK:
        return f"{opening}: farther apart than chance would have it (p = {rounded(entry.p)}); {closing}."
    if entry.p < DOUBTFUL:
        return f"{opening}: perhaps farther apart than chance would have it (p = {rounded(entry.p)}); {closing}."
    return f"{opening}: no farther apart than chance would have it (p = {rounded(entry.p)}); {closing}."


def _describe_exponent(entry: ExponentInterval, *, driven: bool) -> str:
    opening = f"Of the model {'under the recorded drive' if driven else 'left to itself'}"
    if math.isnan(entry.low):
        return f"{opening}; the recording is too short for an interval."
    kind = (
        "near runs part: chaos" if entry.low > 0.0 else "near runs close up" if entry.high < 0.0 else "its sign is open"
    )
    return f"{opening}, with the scatter over ten blocks: {kind} ({rounded(entry.value, 3)} 1/s)."


def _describe_dimension(recorded: DimensionInterval, model: DimensionInterval) -> str:
    opening = "Of the recording (as noise floor) and of free runs without noise"
    if recorded.status == TRANSIENT:
        return ""
    for entry, whose in ((recorded, "the recording"), (model, "the free run")):
        if entry.status not in ("ok", "uncertain"):
            return f"{opening}; {whose}: {entry.says}"
    meet = recorded.low <= model.high and model.low <= recorded.high
    return f"{opening}: their intervals {'meet' if meet else 'do not meet'}."


def _describe_whiteness(p: float, certain: float) -> str:
    if p < certain:
        return "Ljung-Box test of one-step errors: they still hold something that can be predicted."
    if p < 5.0 * certain:
        return f"Ljung-Box test of one-step errors: they may hold something that can be predicted (p = {rounded(p)})."
    return "Ljung-Box test of one-step errors: they cannot be told from white noise."
