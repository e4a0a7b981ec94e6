"""Figure: the recording and the free-running predictions of held-out data, before and after."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from lostmotion.diagnosis.report.cast import versions
from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style
from lostmotion.report.words import Scale, with_unit
from lostmotion.results import Array

PERIODS_SHOWN = 6
COLUMNS = 900


class Window(NamedTuple):
    """Samples of one recording, those of them to be drawn large, and where the predictions start anew."""

    record: NDArray[np.intp]
    shown: NDArray[np.intp]
    restarts: NDArray[np.intp]


def draw(evidence: Evidence) -> Figure | None:
    """Return overview, predictions and their errors one below the other, or None without a recording."""
    if not evidence.has("time", "response"):
        return None
    window = window_of(evidence)
    panels = 3 if predicted(evidence) else 2
    figure = style.blank(0.4 + 1.85 * panels)
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
    """Return what to see in the figure."""
    if not predicted(evidence):
        return "The recording; held-out part shaded, and a few periods of it drawn large."
    closing = (
        " The vermillion curve leaves the recording where the missing physics acts; the blue one should stay on it."
        if len(_forecasts(evidence)) > 1
        else " Where nothing is missing, the prediction stays on the recording until noise and chaos part them."
    )
    names = [one.name for one in evidence.result.sensors]
    whose = f" of the first sensor, {names[0]}" if len(names) > 1 else ""
    return (
        f"Top: the whole recording{whose}, with the part that no fit has seen shaded and the enlarged window outlined. "
        "Middle: recording and free-running prediction, started anew from a filtered state at each triangle. "
        "Bottom: prediction minus recording." + closing
    )


def predicted(evidence: Evidence) -> bool:
    """Return whether there is a recording with a prediction of it."""
    return evidence.has("time", "response") and bool(_forecasts(evidence))


def window_of(evidence: Evidence) -> Window:
    """Return the recording that holds the first held-out restart, and a few periods around that restart."""
    time = evidence.arrays["time"]
    held = evidence.arrays.get("heldout", np.zeros(time.size)) > 0
    starts = np.flatnonzero((evidence.arrays.get("restart", np.zeros(time.size)) > 0) & held)
    centre = int(starts[0]) if starts.size else int(np.argmax(held))
    number = evidence.arrays.get("record", np.zeros(time.size))
    record = np.flatnonzero(number == number[centre])
    return Window(record, _around(evidence, record, centre), np.intersect1d(starts, record))


def _around(evidence: Evidence, record: NDArray[np.intp], centre: int) -> NDArray[np.intp]:
    time = evidence.arrays["time"][record]
    frequency = evidence.result.drive.frequency
    whole = float(time[-1] - time[0])
    cycle = 1.0 / frequency if frequency else _natural_period(evidence)
    length = min(whole, PERIODS_SHOWN * cycle if cycle > 0 else whole / 8)
    start = min(max(float(evidence.arrays["time"][centre]) - length / 12, time[0]), time[-1] - length)
    shown: NDArray[np.intp] = record[(time >= start) & (time <= start + length)]
    return shown


def _natural_period(evidence: Evidence) -> float:
    """Return the natural period (s) where predictions are judged over so many of them, else NaN."""
    fit = evidence.result.fit
    return fit.horizon_unit_time if fit.horizon_unit == "natural periods" else float("nan")


def draw_overview(axes: Axes, evidence: Evidence, window: Window) -> None:
    """Draw the whole recording small, with the held-out part shaded and the window outlined."""
    time, values = evidence.arrays["time"][window.record], evidence.arrays["response"][window.record]
    scale = scale_used(evidence)
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
    """Draw a curve, or lowest and highest values of its columns where it has more samples than the page has dots."""
    if values.size < 3 * COLUMNS:
        axes.plot(time, values, color=style.QUIET, linewidth=0.8)
        return
    firsts = np.linspace(0, values.size, COLUMNS, endpoint=False).astype(int)
    low, high = np.fmin.reduceat(values, firsts), np.fmax.reduceat(values, firsts)
    axes.fill_between(time[firsts], low, high, color=style.QUIET, linewidth=0.4)


def draw_window(axes: Axes, evidence: Evidence, window: Window) -> None:
    """Draw the recording and the predictions of a few periods."""
    seen = evidence.arrays["response"][window.shown]
    scale = scale_used(evidence)
    time = evidence.arrays["time"]
    there = _there(seen)
    axes.plot(
        time[window.shown][there], scale.factor * seen[there], color=style.RECORDED, linewidth=3, label="recording"
    )
    for name, colour, words in _forecasts(evidence):
        at, values = _broken(time, evidence.arrays[name], window)
        axes.plot(at, scale.factor * values, color=colour, label=words)
    others = [scale.factor * evidence.arrays[name][window.shown] for name, _, _ in _forecasts(evidence)]
    axes.set_ylim(style.framed(scale.factor * seen, others, 0.5))
    _finish(axes, evidence, window, with_unit(evidence.result.response.quantity, scale.unit))


def draw_error(axes: Axes, evidence: Evidence, window: Window) -> None:
    """Draw prediction minus recording for a few periods."""
    time, seen = evidence.arrays["time"], evidence.arrays["response"]
    errors = {name: evidence.arrays[name] - seen for name, _, _ in _forecasts(evidence)}
    most = 1.5 * float(np.nanmax(seen) - np.nanmin(seen))
    shown = np.clip(np.concatenate([error[window.shown] for error in errors.values()]), -most, most)
    scale = style.scale_of(shown, evidence.response_unit)
    axes.axhline(0, color=style.RECORDED, linewidth=0.8)
    for name, colour, _ in _forecasts(evidence):
        at, values = _broken(time, errors[name], window)
        there = _there(values)
        axes.plot(at[there], scale.factor * values[there], color=colour)
    axes.set_ylim(style.span_of(scale.factor * shown, 0.08))
    _finish(axes, evidence, window, with_unit("error", scale.unit))


def _there(values: Array) -> NDArray[np.bool_]:
    """Return what to draw of values (n,): all, with gaps at NaN, or finite ones alone of a sensor read more rarely."""
    finite = np.isfinite(values)
    return finite if np.mean(finite) < 0.6 else np.ones_like(finite)


def _forecasts(evidence: Evidence) -> list[tuple[str, str, str]]:
    known = [(f"forecast_{who.key}", who.colour, who.named("prediction")) for who in versions(evidence)]
    return [entry for entry in known if evidence.has(entry[0])]


def _broken(time: Array, values: Array, window: Window) -> tuple[Array, Array]:
    """Return the curve in the window with a gap at each restart, where the prediction jumps."""
    gaps = np.searchsorted(window.shown, np.intersect1d(window.restarts, window.shown))
    at, curve = time[window.shown], values[window.shown]
    return np.insert(at, gaps, at[gaps]), np.insert(curve, gaps, np.nan)


def _finish(axes: Axes, evidence: Evidence, window: Window, name: str) -> None:
    time = evidence.arrays["time"]
    at = time[np.intersect1d(window.restarts, window.shown)]
    foot = axes.get_xaxis_transform()
    axes.plot(at, np.zeros(at.size), "^", color=style.RECORDED, markersize=5, transform=foot, clip_on=False)
    axes.set_xlim(time[window.shown[0]], time[window.shown[-1]])
    style.few_ticks(axes, 8)
    axes.set_xlabel(with_unit("time", evidence.result.units.time))
    axes.set_ylabel(name)


def scale_used(evidence: Evidence) -> Scale:
    """Return the scale in which the response is shown."""
    return style.scale_of(evidence.arrays["response"], evidence.response_unit)
