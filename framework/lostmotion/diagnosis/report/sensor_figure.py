"""Figure and table of all sensors: held-out readings with predictions, and the noise of each sensor."""

from __future__ import annotations

import math
from dataclasses import replace

from matplotlib.figure import Figure

from lostmotion.diagnosis.report import prediction
from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.diagnosis.report.versions import list_versions
from lostmotion.report import style
from lostmotion.report.pages import Grid
from lostmotion.report.words import DASH, choose_scale, figures, format_unit, percent, shorten, to_words
from lostmotion.results.diagnosis import Response, SensorFacts

NOISE_NAMES = {"white": "white", "ar1": "autocorrelated", "quantised": "quantised"}


def draw(evidence: Evidence) -> Figure | None:
    """Return prediction and error of each sensor one below the other, or None with fewer than two sensors."""
    shown = [entry for entry in split_by_sensor(evidence) if prediction.has_prediction(entry[1])]
    if len(shown) < 2:
        return None
    window = prediction.choose_window(evidence)
    figure = style.make_figure(0.4 + 2.75 * len(shown))
    rows = figure.subplots(2 * len(shown), 1, sharex=True, height_ratios=[1.7, 1] * len(shown))
    for (name, one), upper, lower in zip(shown, rows[::2], rows[1::2], strict=True):
        prediction.draw_window(upper, one, window)
        prediction.draw_error(lower, one, window)
        upper.set_title(shorten(name))
        for axes in (upper, lower):
            axes.set_xlabel("")
    rows[-1].set_xlabel(f"time ({evidence.result.units.time})")
    figure.align_ylabels()
    style.legend_above(figure, rows[0])
    return figure


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure."""
    return (
        "For each sensor: recording and free-running prediction of held-out data, and below it prediction minus "
        "recording. All predictions restart together from one filtered state at each triangle. If a model fits one "
        "sensor and not another, physics between the two is missing."
    )


def make_table(evidence: Evidence) -> Grid | None:
    """Return name, channel, noise and held-out errors of each sensor; None with one sensor."""
    models = ["Error before", "Error after"] if evidence.augmented else ["Error"]
    head = ["Sensor", "Channel", "Noise, s.d.", "Kind of noise", *models]
    rows = [_make_row(evidence, sensor) for sensor in evidence.result.sensors]
    return Grid(head, rows) if len(rows) > 1 else None


def _make_row(evidence: Evidence, sensor: SensorFacts) -> list[str]:
    fit = evidence.result.fit
    scores = [version.select(fit.before, fit.after) for version in list_versions(evidence)]
    errors = [percent(score.nrmse_by_sensor.get(sensor.name)) for score in scores]
    return [
        sensor.name,
        to_words(sensor.channel),
        _format_noise(sensor),
        NOISE_NAMES.get(sensor.kind, sensor.kind),
        *errors,
    ]


def _format_noise(sensor: SensorFacts) -> str:
    if math.isnan(sensor.noise_sd):
        return DASH
    scale = choose_scale(sensor.noise_sd, sensor.unit)
    return f"{figures(scale.factor * sensor.noise_sd)} {format_unit(scale.unit)}".rstrip()


def split_by_sensor(evidence: Evidence) -> list[tuple[str, Evidence]]:
    """Return the name of each sensor, and the evidence with this sensor in the place of the first one."""
    return [(one.name, _select_sensor(evidence, number, one)) for number, one in enumerate(evidence.result.sensors, 1)]


def _select_sensor(evidence: Evidence, number: int, sensor: SensorFacts) -> Evidence:
    result, data = replace(evidence.result, response=Response(to_words(sensor.channel))), evidence.data
    if number > 1:
        firsts = ("response", "forecast_before", "forecast_after")
        its_own = {f"{name}_{number}": name for name in firsts if f"{name}_{number}" in data}
        data = data.drop_vars(firsts, errors="ignore").rename(its_own)
    return Evidence(data, result)
