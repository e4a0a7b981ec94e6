"""The table of all that shows whether a model behaves as its machine does: before, after, the noise floor, in words."""

from __future__ import annotations

import math
from dataclasses import astuple, fields

from lostmotion.diagnosis.report.cast import versions
from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report.pages import Grid
from lostmotion.report.words import DASH, chance, figures, percent, pretty
from lostmotion.results.behaviour import (
    DimensionInterval,
    Distance,
    ExponentInterval,
    MeasureTexts,
    ModelBehaviour,
    NoiseFloor,
    ValidTime,
)

NAMES = MeasureTexts(
    heldout_log_score="Held-out log score per sample",
    free_run_error="Free-run error",
    valid_prediction_time="Valid prediction time",
    attractor_distance="Distance between attractors",
    largest_exponent="Largest exponent",
    d2="Correlation dimension",
    whiteness="Whiteness of innovations",
)


def table(evidence: Evidence) -> Grid:
    """Return a row for each measure: before, after, the noise floor, and what it says."""
    show = evidence.result.show
    models = [who.of(show.before, show.after) for who in versions(evidence)]
    columns = [*(_of_model(one) for one in models), _of_noise(show.noise_floor)]
    told = zip(astuple(NAMES), astuple(show.units), zip(*columns, strict=True), astuple(show.says), strict=True)
    rows = [[_headed(name, pretty(unit)), *cells, says] for name, unit, cells, says in told]
    kept = [row for row in rows if row[-1] or set(row[1:-1]) - {DASH}]
    heads = ["Before", "After"] if evidence.augmented else ["Model as it stands"]
    return Grid(["", *heads, "Noise floor or recording", "In words"], kept)


def _headed(name: str, unit: str) -> str:
    return f"{name} ({unit})" if unit in ("1/s", "s") or unit.endswith(("times", "periods")) else name


def _of_model(model: ModelBehaviour | None) -> list[str]:
    """Return the cells of a model, in the order of the names; dashes where its motion was not measured."""
    if model is None:
        return [DASH] * len(fields(NAMES))
    return [
        figures(model.heldout_log_score, 4),
        percent(model.free_run_error),
        _followed(model.valid_prediction_time),
        _apart(model.attractor_distance),
        _between(model.largest_exponent),
        _between(model.d2),
        chance(model.whiteness.p),
    ]


def _of_noise(floor: NoiseFloor) -> list[str]:
    """Return the cells of the noise floor, with dashes for what noise has not."""
    score, error = figures(floor.heldout_log_score, 4), percent(floor.free_run_error)
    return [score, error, DASH, _apart(floor.attractor_distance), DASH, _between(floor.d2), DASH]


def _followed(time: ValidTime) -> str:
    return f"{'more than ' if time.or_longer else ''}{figures(time.value, 2)}"


def _apart(distance: Distance) -> str:
    if math.isnan(distance.p):
        return DASH
    return f"{figures(distance.value, 2)} {_whole(f'(p = {figures(distance.p, 2)})')}"


def _between(told: ExponentInterval | DimensionInterval) -> str:
    """Return `value [low, high]`, with as many decimals as the width of the interval deserves."""
    if math.isnan(told.value) or not told.high > told.low:
        return figures(told.value, 3)
    decimals = max(0, 1 - math.floor(math.log10(told.high - told.low)))
    ends = _whole(f"[{told.low:.{decimals}f}, {told.high:.{decimals}f}]")
    text = f"{told.value:.{decimals}f} {ends}".replace("-", "−")
    return f"{text}, uncertain" if told.status == "uncertain" else text


def _whole(text: str) -> str:
    """Return a text that no line break divides."""
    return text.replace(" ", "\N{NO-BREAK SPACE}")
