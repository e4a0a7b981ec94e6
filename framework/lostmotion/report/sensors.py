"""Figure and table of all sensors: held-out readings with the predictions of each, and the noise of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from lostmotion.report import prediction, style
from lostmotion.report.evidence import Evidence
from lostmotion.report.tables import Table
from lostmotion.report.words import DASH, figures, percent, pretty, readable, shortened, spoken

KINDS = {"white": "white", "ar1": "with a memory", "quantised": "rounded"}


def draw(evidence: Evidence) -> Figure | None:
    """Return prediction and error of each sensor one below the other, or None where there is one sensor or none."""
    shown = [entry for entry in each(evidence) if prediction.predicted(entry[1])]
    if len(shown) < 2:
        return None
    window = prediction.window_of(evidence)
    figure = style.blank(0.4 + 2.75 * len(shown))
    rows = figure.subplots(2 * len(shown), 1, sharex=True, height_ratios=[1.7, 1] * len(shown))
    for (name, one), upper, lower in zip(shown, rows[::2], rows[1::2], strict=True):
        prediction.draw_window(upper, one, window)
        prediction.draw_error(lower, one, window)
        upper.set_title(shortened(name))
        for axes in (upper, lower):
            axes.set_xlabel("")
    rows[-1].set_xlabel(f"time ({evidence.unit('time') or 's'})")
    figure.align_ylabels()
    style.legend_above(figure, rows[0])
    return figure


def caption(evidence: Evidence) -> str:
    """Return what to see in the figure."""
    return (
        "For each sensor: recording and free-running prediction of held-out data, and below it prediction minus "
        "recording. All predictions start anew together, from one filtered state at each triangle. A model that fits "
        "one sensor and misses another lacks something between the two."
    )


def table(evidence: Evidence) -> Table:
    """Return name, channel, noise and held-out errors of each sensor; no rows where there is one sensor or none."""
    models = ["Error before", "Error after"] if evidence.augmented else ["Error"]
    head = ["Sensor", "Channel", "Noise, s.d.", "Kind of noise", *models]
    sensors = _sensors(evidence)
    return Table(head, [_row(evidence, sensor) for sensor in sensors] if len(sensors) > 1 else [])


def _sensors(evidence: Evidence) -> list[Mapping[str, Any]]:
    return [entry for entry in evidence.fact("sensors") or [] if isinstance(entry, Mapping)]


def _row(evidence: Evidence, sensor: Mapping[str, Any]) -> list[str]:
    name, kind = str(sensor.get("name", "?")), str(sensor.get("kind", ""))
    errors = [
        percent(evidence.number("fit", when, "heldout_nrmse_by_sensor", name))
        for when in (("before", "after") if evidence.augmented else ("before",))
    ]
    return [name, spoken(str(sensor.get("channel", "?"))), _noise(sensor), KINDS.get(kind, kind or DASH), *errors]


def _noise(sensor: Mapping[str, Any]) -> str:
    size = sensor.get("noise_sd")
    if not isinstance(size, int | float):
        return DASH
    scale = readable(float(size), str(sensor.get("unit", "")))
    return f"{figures(scale.factor * size)} {pretty(scale.unit)}".rstrip()


def each(evidence: Evidence) -> list[tuple[str, Evidence]]:
    """Return the name of each sensor with the evidence as it would be if this sensor were the first one."""
    sensors = _sensors(evidence)
    return [(str(one.get("name", "?")), _seen_by(evidence, number, one)) for number, one in enumerate(sensors, 1)]


def _seen_by(evidence: Evidence, number: int, sensor: Mapping[str, Any]) -> Evidence:
    channel = str(sensor.get("channel", "response"))
    facts = {**evidence.facts, "response": {"quantity": spoken(channel)}}
    if number == 1:
        return replace(evidence, facts=facts)
    names = ("response", "forecast_before", "forecast_after")
    arrays = {**evidence.arrays, **{name: evidence.arrays.get(f"{name}_{number}", np.array([])) for name in names}}
    return replace(evidence, facts=facts, arrays=arrays, units={**evidence.units, "response": str(sensor.get("unit"))})
