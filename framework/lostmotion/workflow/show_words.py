"""The sentences beside the numbers of a `show`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from lostmotion.report.words import span
from lostmotion.settings import DEFAULT

LUCK, DOUBTFUL = 0.01, 0.05
TRANSIENT = "transient"
"""The status of a measure of attractors where the motion dies away: nothing is said of it."""
Table = Mapping[str, Any]


def said(table: Table, strobed: bool, *, driven: bool = True, white: float = DEFAULT.name.white) -> dict[str, str]:
    """Return a sentence for each measure that stands in the table; `driven` says whether an input was recorded.

    A p-value of whiteness below `white` is told as a finding, and below five times that as a doubt.
    """
    last = "after" if "after" in table else "before"
    return {
        "heldout_log_score": _score(table, last),
        "free_run_error": _error(table, last),
        "valid_prediction_time": _valid(table, last),
        "attractor_distance": _apart(table, last, strobed),
        "largest_exponent": _exponent(table, last, driven=driven),
        "d2": _dimension(table, last),
        "whiteness": _white(table, last, white),
    }


def _number(table: Table, *path: str) -> float:
    found: Any = table
    for key in path:
        found = found.get(key) if isinstance(found, Mapping) else None
    return float(found) if isinstance(found, int | float) else math.nan


def _score(table: Table, last: str) -> str:
    short = _number(table, "noise_floor", "heldout_log_score") - _number(table, last, "heldout_log_score")
    opening = "Log density of held-out samples, one step ahead"
    if short < 0.02:
        return f"{opening}: as high as the last model itself expects."
    return f"{opening}: {short:.2g} per sample below what the last model itself expects."


def _error(table: Table, last: str) -> str:
    ratio = _number(table, last, "free_run_error") / max(_number(table, "noise_floor", "free_run_error"), 1e-300)
    horizon = table["horizon"]
    opening = f"Free runs over {span(horizon['value'], horizon['unit'])}, over the deviation of the response"
    if ratio < 1.2:
        return f"{opening}: no more than the measurement noise."
    return f"{opening}: {ratio:.2g} times the measurement noise."


def _valid(table: Table, last: str) -> str:
    opening = "How long a free run errs by less than 40 % of the motion, median over starts"
    if table[last]["valid_prediction_time"]["or_longer"]:
        return f"{opening}: longer than it was followed."
    return f"{opening}."


def _apart(table: Table, last: str, strobed: bool) -> str:
    where = "Poincaré sections once each drive period" if strobed else "looks at position and velocity"
    opening = f"Energy distance between {where} of recording and free run"
    entry = table[last]["attractor_distance"]
    if entry["status"] == TRANSIENT:
        return ""
    if entry["status"] == "too_short":
        return f"{opening}: the recording holds too few points."
    if entry["status"] != "ok":
        return f"{opening}: the free run leaves all bounds."
    closing = "the floor is that between the halves of the recording"
    if entry["p"] < LUCK:
        return f"{opening}: farther apart than chance would have it (p = {entry['p']:.2g}); {closing}."
    if entry["p"] < DOUBTFUL:
        return f"{opening}: perhaps farther apart than chance would have it (p = {entry['p']:.2g}); {closing}."
    return f"{opening}: no farther apart than chance would have it (p = {entry['p']:.2g}); {closing}."


def _exponent(table: Table, last: str, *, driven: bool) -> str:
    value, low, high = (_number(table, last, "largest_exponent", k) for k in ("value", "low", "high"))
    opening = f"Of the model {'under the recorded drive' if driven else 'left to itself'}"
    if math.isnan(low):
        return f"{opening}; the recording is too short for an interval."
    kind = "near runs part: chaos" if low > 0.0 else "near runs close up" if high < 0.0 else "its sign is open"
    return f"{opening}, with the scatter over ten blocks: {kind} ({value:.3g} 1/s)."


def _dimension(table: Table, last: str) -> str:
    recorded, model = table["noise_floor"]["d2"], table[last]["d2"]
    opening = "Of the recording (as noise floor) and of free runs without noise"
    if recorded["status"] == TRANSIENT:
        return ""
    for entry, whose in ((recorded, "the recording"), (model, "the free run")):
        if entry["status"] not in ("ok", "uncertain"):
            return f"{opening}; {whose}: {entry['says']}"
    meet = recorded["low"] <= model["high"] and model["low"] <= recorded["high"]
    return f"{opening}: their intervals {'meet' if meet else 'do not meet'}."


def _white(table: Table, last: str, certain: float) -> str:
    p = _number(table, last, "whiteness", "p")
    if p < certain:
        return "Ljung-Box test of one-step errors: they still hold something that can be predicted."
    if p < 5.0 * certain:
        return f"Ljung-Box test of one-step errors: they may hold something that can be predicted (p = {p:.2g})."
    return "Ljung-Box test of one-step errors: they cannot be told from white noise."
