"""The table of measures of the behaviour of the models: before, after, noise floor, and in words."""

from __future__ import annotations

import math
from dataclasses import astuple, fields

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.diagnosis.report.versions import list_versions
from lostmotion.report.pages import Grid
from lostmotion.report.words import DASH, chance, figures, format_unit, percent
from lostmotion.results.behaviour import (
    DimensionInterval,
    Distance,
    ExponentInterval,
    MeasureTexts,
    ModelBehaviour,
    NoiseFloor,
    ValidTime,
)

MEASURE_NAMES = MeasureTexts(
    heldout_log_score="Held-out log score per sample",
    free_run_error="Free-run error",
    valid_prediction_time="Valid prediction time",
    attractor_distance="Distance between attractors",
    largest_exponent="Largest exponent",
    d2="Correlation dimension",
    whiteness="Whiteness of innovations",
)


def make_table(evidence: Evidence) -> Grid:
    """Return a row for each measure: before, after, the noise floor, and a sentence."""
    show = evidence.result.show
    models = [version.select(show.before, show.after) for version in list_versions(evidence)]
    columns = [*(_make_model_cells(one) for one in models), _make_noise_cells(show.noise_floor)]
    entries = zip(
        astuple(MEASURE_NAMES), astuple(show.units), zip(*columns, strict=True), astuple(show.says), strict=True
    )
    rows = [[_make_heading(name, format_unit(unit)), *cells, says] for name, unit, cells, says in entries]
    kept = [row for row in rows if row[-1] or set(row[1:-1]) - {DASH}]
    heads = ["Before", "After"] if evidence.augmented else ["Nominal model"]
    return Grid(["", *heads, "Noise floor or recording", "In words"], kept)


def _make_heading(name: str, unit: str) -> str:
    return f"{name} ({unit})" if unit in ("1/s", "s") or unit.endswith(("times", "periods")) else name


def _make_model_cells(model: ModelBehaviour | None) -> list[str]:
    """Return the cells of a model, in the order of `MEASURE_NAMES`; dashes where its motion was not measured."""
    if model is None:
        return [DASH] * len(fields(MEASURE_NAMES))
    return [
        figures(model.heldout_log_score, 4),
        percent(model.free_run_error),
        _format_time(model.valid_prediction_time),
        _format_distance(model.attractor_distance),
        _format_interval(model.largest_exponent),
        _format_interval(model.d2),
        chance(model.whiteness.p),
    ]


def _make_noise_cells(floor: NoiseFloor) -> list[str]:
    """Return the cells of the noise floor, with dashes for measures that noise does not have."""
    score, error = figures(floor.heldout_log_score, 4), percent(floor.free_run_error)
    return [score, error, DASH, _format_distance(floor.attractor_distance), DASH, _format_interval(floor.d2), DASH]


def _format_time(time: ValidTime) -> str:
    return f"{'more than ' if time.or_longer else ''}{figures(time.value, 2)}"


def _format_distance(distance: Distance) -> str:
    if math.isnan(distance.p):
        return DASH
    return f"{figures(distance.value, 2)} {_keep_together(f'(p = {figures(distance.p, 2)})')}"


def _format_interval(found: ExponentInterval | DimensionInterval) -> str:
    """Return `value [low, high]`, with the number of decimals that matches the width of the interval."""
    if math.isnan(found.value) or not found.high > found.low:
        return figures(found.value, 3)
    decimals = max(0, 1 - math.floor(math.log10(found.high - found.low)))
    ends = _keep_together(f"[{found.low:.{decimals}f}, {found.high:.{decimals}f}]")
    text = f"{found.value:.{decimals}f} {ends}".replace("-", "−")
    return f"{text}, uncertain" if found.status == "uncertain" else text


def _keep_together(text: str) -> str:
    """Return a text with non-breaking spaces."""
    return text.replace(" ", "\N{NO-BREAK SPACE}")
