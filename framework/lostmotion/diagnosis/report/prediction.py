"""Figure of the recording and the free-running predictions of held-out data, before and after."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.diagnosis.report.versions import list_versions
from lostmotion.report import style
from lostmotion.report.words import Scale, with_unit
from lostmotion.results import Array

PERIODS_SHOWN = 6
ENVELOPE_COLUMNS = 900


class Window(NamedTuple):
    """Samples of one recording, the samples of the enlarged window, and the restarts of the predictions."""

    record: NDArray[np.intp]
    shown: NDArray[np.intp]
    restarts: NDArray[np.intp]


def draw(evidence: Evidence) -> Figure | None:
    """Return overview, predictions and errors one below the other, or None without a recording."""
    if not evidence.has("time", "response"):
        return None
    window = choose_window(evidence)
    panels = 3 if has_prediction(evidence) else 2
    figure = style.make_figure(0.4 + 1.85 * panels)
    rows = figure.subplots(panels, 1, height_ratios=[0.55, 2, 1][:panels])
    draw_overview(rows[0], evidence, window)
    draw_window(rows[1], evidence, window)
    if panels == 3:
        rows[1].sharex(rows[2])
        rows[1].tick_params(labelbottom=False)
        rows[1].set_xlabel("")
        draw_error(rows[2], evidence, window)
    figure.align_ylabels()
    style.legend_above(figure, rows[1])
    return figure


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure."""
    if not has_prediction(evidence):
        return "The recording, with the held-out part shaded, and a few enlarged periods."
    closing = (
        " The vermillion curve deviates from the recording where the missing physics acts; the blue one should follow"
        " it."
        if len(_list_forecasts(evidence)) > 1
        else " Without missing physics, the prediction follows the recording until noise and chaos separate them."
    )
    names = [one.name for one in evidence.result.sensors]
    whose = f" of the first sensor, {names[0]}" if len(names) > 1 else ""
    return (
        f"Top: the whole recording{whose}, with the held-out part shaded and the enlarged window outlined. "
        "Middle: recording and free-running prediction, restarted from a filtered state at each triangle. "
        "Bottom: prediction minus recording." + closing
    )


def has_prediction(evidence: Evidence) -> bool:
    """Return whether there is a recording with a prediction."""
    return evidence.has("time", "response") and bool(_list_forecasts(evidence))


def choose_window(evidence: Evidence) -> Window:
    """Return the recording with the first held-out restart, and a few periods around this restart."""
    time = evidence.arrays["time"]
    held = evidence.arrays.get("heldout", np.zeros(time.size)) > 0
    starts = np.flatnonzero((evidence.arrays.get("restart", np.zeros(time.size)) > 0) & held)
    centre = int(starts[0]) if starts.size else int(np.argmax(held))
    number = evidence.arrays.get("record", np.zeros(time.size))
    record = np.flatnonzero(number == number[centre])
    return Window(record, _select_periods(evidence, record, centre), np.intersect1d(starts, record))


def _select_periods(evidence: Evidence, record: NDArray[np.intp], centre: int) -> NDArray[np.intp]:
    time = evidence.arrays["time"][record]
    frequency = evidence.result.drive.frequency
    whole = float(time[-1] - time[0])
    cycle = 1.0 / frequency if frequency else _get_natural_period(evidence)
    length = min(whole, PERIODS_SHOWN * cycle if cycle > 0 else whole / 8)
    start = min(max(float(evidence.arrays["time"][centre]) - length / 12, time[0]), time[-1] - length)
    shown: NDArray[np.intp] = record[(time >= start) & (time <= start + length)]
    return shown


def _get_natural_period(evidence: Evidence) -> float:
    """Return the natural period (s) where it is the unit of the prediction horizon, else NaN."""
    fit = evidence.result.fit
    return fit.horizon_unit_time if fit.horizon_unit == "natural periods" else float("nan")


def draw_overview(axes: Axes, evidence: Evidence, window: Window) -> None:
    """Draw the whole recording small, with the held-out part shaded and the window outlined."""
    time, values = evidence.arrays["time"][window.record], evidence.arrays["response"][window.record]
    scale = choose_scale(evidence)
    _draw_envelope(axes, time, scale.factor * values)
    held = evidence.arrays.get("heldout", np.zeros(evidence.arrays["time"].size))[window.record] > 0
    if held.any():
        axes.axvspan(time[held][0], time[held][-1], color=style.SHADE, zorder=0)
        axes.set_title("held out: shaded", loc="right", fontsize=8.5, color="#444444")
    shown = evidence.arrays["time"][window.shown]
    axes.axvspan(shown[0], shown[-1], facecolor="none", edgecolor=style.RECORDED, linewidth=1.2, zorder=3)
    axes.set_xlim(time[0], time[-1])
    style.few_ticks(axes, 10, 2)
    axes.set_ylabel(f"({scale.unit})")
    axes.grid(visible=False)


def _draw_envelope(axes: Axes, time: Array, values: Array) -> None:
    """Draw a curve, or for many samples the lowest and highest values in each column of the figure."""
    if values.size < 3 * ENVELOPE_COLUMNS:
        axes.plot(time, values, color=style.QUIET, linewidth=0.8)
        return
    firsts = np.linspace(0, values.size, ENVELOPE_COLUMNS, endpoint=False).astype(int)
    low, high = np.fmin.reduceat(values, firsts), np.fmax.reduceat(values, firsts)
    axes.fill_between(time[firsts], low, high, color=style.QUIET, linewidth=0.4)


def draw_window(axes: Axes, evidence: Evidence, window: Window) -> None:
    """Draw the recording and the predictions of a few periods."""
    seen = evidence.arrays["response"][window.shown]
    scale = choose_scale(evidence)
    time = evidence.arrays["time"]
    there = _select_drawn(seen)
    axes.plot(
        time[window.shown][there], scale.factor * seen[there], color=style.RECORDED, linewidth=3, label="recording"
    )
    for name, colour, words in _list_forecasts(evidence):
        at, values = _insert_gaps(time, evidence.arrays[name], window)
        axes.plot(at, scale.factor * values, color=colour, label=words)
    others = [scale.factor * evidence.arrays[name][window.shown] for name, _, _ in _list_forecasts(evidence)]
    axes.set_ylim(style.limits_around(scale.factor * seen, others, 0.5))
    _format_axes(axes, evidence, window, with_unit(evidence.result.response.quantity, scale.unit))


def draw_error(axes: Axes, evidence: Evidence, window: Window) -> None:
    """Draw prediction minus recording for a few periods."""
    time, seen = evidence.arrays["time"], evidence.arrays["response"]
    errors = {name: evidence.arrays[name] - seen for name, _, _ in _list_forecasts(evidence)}
    most = 1.5 * float(np.nanmax(seen) - np.nanmin(seen))
    shown = np.clip(np.concatenate([error[window.shown] for error in errors.values()]), -most, most)
    scale = style.scale_of(shown, evidence.response_unit)
    axes.axhline(0, color=style.RECORDED, linewidth=0.8)
    for name, colour, _ in _list_forecasts(evidence):
        at, values = _insert_gaps(time, errors[name], window)
        there = _select_drawn(values)
        axes.plot(at[there], scale.factor * values[there], color=colour)
    axes.set_ylim(style.span_of(scale.factor * shown, 0.08))
    _format_axes(axes, evidence, window, with_unit("error", scale.unit))


def _select_drawn(values: Array) -> NDArray[np.bool_]:
    """Return which values (n,) to draw: all, with gaps at NaN, or only the finite ones of a slower sensor."""
    finite = np.isfinite(values)
    return finite if np.mean(finite) < 0.6 else np.ones_like(finite)


def _list_forecasts(evidence: Evidence) -> list[tuple[str, str, str]]:
    known = [
        (f"forecast_{version.key}", version.colour, version.make_label("prediction"))
        for version in list_versions(evidence)
    ]
    return [entry for entry in known if evidence.has(entry[0])]


def _insert_gaps(time: Array, values: Array, window: Window) -> tuple[Array, Array]:
    """Return the curve in the window with a gap at each restart, where the prediction jumps."""
    gaps = np.searchsorted(window.shown, np.intersect1d(window.restarts, window.shown))
    at, curve = time[window.shown], values[window.shown]
    return np.insert(at, gaps, at[gaps]), np.insert(curve, gaps, np.nan)


def _format_axes(axes: Axes, evidence: Evidence, window: Window, name: str) -> None:
    time = evidence.arrays["time"]
    at = time[np.intersect1d(window.restarts, window.shown)]
    foot = axes.get_xaxis_transform()
    axes.plot(at, np.zeros(at.size), "^", color=style.RECORDED, markersize=5, transform=foot, clip_on=False)
    axes.set_xlim(time[window.shown[0]], time[window.shown[-1]])
    style.few_ticks(axes, 8)
    axes.set_xlabel(with_unit("time", evidence.result.units.time))
    axes.set_ylabel(name)


def choose_scale(evidence: Evidence) -> Scale:
    """Return the scale in which the response is shown."""
    return style.scale_of(evidence.arrays["response"], evidence.response_unit)
