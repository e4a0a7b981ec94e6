"""Figures of the motion: time series, spectrum, phase portrait and section, before and after noise reduction."""

from __future__ import annotations

import math
import re

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.report import style
from lostmotion.report.words import Scale, figures, format_unit, shorten, with_unit
from lostmotion.results import Array
from lostmotion_chaos.analysis.report.view import (
    AnalysisView,
    choose_scale,
    find_versions,
    join_sentences,
    name_delay_axes,
    name_period_source,
    name_quantity,
    thin_rows,
    wrap_label,
)

CYCLES_SHOWN = 12
LAGS_SHOWN = 80
MAX_SAMPLES = 6000
MAX_ORBIT_SAMPLES = 8000
PORTRAIT_SAMPLES = 2500
MAX_BINS = 1200
HARMONICS_MARKED = 12


def draw_course(view: AnalysisView) -> Figure | None:
    """Return some periods of the recording, with its excitation below if there is one, beside its phase portrait."""
    if not view.has("x"):
        return None
    figure = style.make_figure(3.8)
    below = view.has("excitation", "time")
    grid = figure.add_gridspec(
        2 if below else 1, 2, width_ratios=(1.75, 1.0), height_ratios=(1.8, 1) if below else None
    )
    upper = figure.add_subplot(grid[0, 0])
    _draw_signal(upper, view, "x", style.RECORDED)
    if below:
        lower = figure.add_subplot(grid[1, 0], sharex=upper)
        _draw_signal(lower, view, "excitation", style.LAW)
        upper.set_xlabel("")
        upper.tick_params(labelbottom=False)
    shown = choose_scale(view)
    portrait = figure.add_subplot(grid[:, 1])
    draw_portrait(portrait, view, ("x", style.RECORDED), shown)
    portrait.set_title("phase portrait")
    return figure


def caption_course(view: AnalysisView) -> str:
    """Return what the figure of the course shows."""
    period = view.period
    marks = f"dotted: the same phase of each period ({figures(period, 5)} s)." if math.isfinite(period) else ""
    below = "below it the measured excitation." if view.has("excitation", "time") else ""
    return join_sentences(
        [
            "left, a section from the middle of the analysed recording, with its mean removed.",
            below,
            marks,
            "right, the phase portrait: the recording against itself one delay later.",
        ]
    )


def _get_times(view: AnalysisView) -> Array:
    time = view.arrays.get("time")
    return time if time is not None and time.size else np.arange(view.arrays["x"].size, dtype=float)


def _choose_window(view: AnalysisView) -> slice:
    """Return the samples that are shown: some periods, or so many delays, from the middle of the recording."""
    time, period = _get_times(view), view.period
    step = (time[-1] - time[0]) / max(1, time.size - 1)
    wanted = CYCLES_SHOWN * period / step if math.isfinite(period) and step > 0 else LAGS_SHOWN * view.lag
    length = int(min(time.size, max(50, wanted)))
    first = (time.size - length) // 2
    return slice(first, first + length)


def _draw_signal(axes: Axes, view: AnalysisView, name: str, colour: str) -> None:
    window, period = _choose_window(view), view.period
    time, values = _get_times(view)[window], view.arrays[name][window]
    shown = style.scale_of(values, shorten(view.units.get(name, ""), 12))
    keep = slice(None, None, max(1, len(time) // MAX_SAMPLES))
    axes.plot(time[keep], shown.factor * values[keep], color=colour, linewidth=1.0)
    if math.isfinite(period):
        first, last = math.ceil(time[0] / period), math.floor(time[-1] / period)
        for k in range(first, min(last, first + 5 * CYCLES_SHOWN) + 1):
            axes.axvline(k * period, color=style.QUIET, linewidth=0.8, linestyle=(0, (1, 2)), zorder=0.5)
    axes.set_xlim(time[0], time[-1])
    axes.set_xlabel("time (s)" if "time" in view.arrays else "sample")
    words = with_unit(name_quantity(view) if name == "x" else "excitation", shown.unit)
    axes.set_ylabel(wrap_label(words, 26 if name == "x" else 15))
    style.few_ticks(axes, 7, 4 if name == "x" else 3)
    axes.grid(visible=False, axis="x")


def draw_portrait(
    axes: Axes, view: AnalysisView, what: tuple[str, str], shown: Scale, *, most: int = MAX_ORBIT_SAMPLES
) -> None:
    """Draw a series against itself one delay later, from the middle of the recording."""
    key, colour = what
    values, lag = view.arrays[key], view.lag
    first = max(0, (values.size - lag - most) // 2)
    x, y = values[: values.size - lag][first : first + most], values[lag:][first : first + most]
    axes.plot(shown.factor * x, shown.factor * y, color=colour, linewidth=0.4)
    across, up = name_delay_axes(view, shown)
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    style.few_ticks(axes, 4, 5)


def draw_portraits(view: AnalysisView) -> Figure | None:
    """Return the phase portrait before and after noise reduction on the same axes, or None without both."""
    both = find_versions(view, "x", "cleaned")
    if len(both) < 2:
        return None
    figure = style.make_figure(4.2)
    shown = choose_scale(view)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for axes, (key, words, colour) in zip(panels, both, strict=True):
        draw_portrait(axes, view, (key, colour), shown, most=PORTRAIT_SAMPLES)
        axes.set_title(words, color=colour)
    panels[1].set_ylabel("")
    return figure


PORTRAITS_CAPTION = (
    "The same section of the recording before and after noise reduction. The reduction is good if orbits become smooth"
    " and stay in place; it is bad if corners are cut off or gaps are closed."
)


def draw_spectra(view: AnalysisView) -> Figure | None:
    """Return the spectral density with marked harmonics of the drive, and the density without them."""
    if not view.has("frequency", "density"):
        return None
    frequency, density = view.arrays["frequency"], view.arrays["density"]
    rest = view.has("density_rest")
    kept = frequency <= _find_highest_frequency(frequency, density, view.period)
    whole = bool(kept.all())
    figure = style.make_figure(3.4 if whole else 5.0)
    rows = 1 if whole else 2
    axes, *below = figure.subplots(rows, 1, squeeze=False, height_ratios=[2.2, 1][:rows])[:, 0]
    for panel in below:
        _draw_full_spectrum(panel, frequency, density, float(frequency[kept][-1]))
    words = "as recorded" if rest else None
    axes.plot(*_reduce_bins(frequency[kept], density[kept]), color=style.BEFORE if rest else style.RECORDED,
              linewidth=0.8, label=words)  # fmt: skip
    if rest:
        left = view.arrays["density_rest"][kept]
        axes.plot(*_reduce_bins(frequency[kept], left), color=style.AFTER, linewidth=0.9, label="without the harmonics")
    axes.set_yscale("log")
    axes.set_xlim(0.0, float(frequency[kept][-1]))
    axes.set_ylim(*_find_density_limits(density[kept]))
    _mark_harmonics(axes, view, float(frequency[kept][-1]))
    style.log_ticks(axes.yaxis)
    axes.set_xlabel("frequency (Hz)")
    unit = re.sub(r"^\((\w+)\)\^2", r"\1^2", shorten(view.units.get("density", ""), 18)).replace("1^2/", "1/")
    axes.set_ylabel(f"spectral density ({format_unit(unit) or '1/Hz'})")
    if rest:
        style.legend_above(figure, axes)
    return figure


def _draw_full_spectrum(axes: Axes, frequency: Array, density: Array, edge: float) -> None:
    """Draw the spectrum up to half the sampling rate; the range of the panel above is shaded."""
    axes.plot(*_reduce_bins(frequency, density), color=style.QUIET, linewidth=0.7)
    axes.axvspan(0.0, edge, color=style.SHADE, zorder=0)
    axes.set_yscale("log")
    axes.set_xlim(0.0, float(frequency[-1]))
    style.log_ticks(axes.yaxis, 4)
    axes.set_xlabel("frequency (Hz), up to half the sampling rate; shaded: the part above")


def caption_spectra(view: AnalysisView) -> str:
    """Return what the figure of the spectrum shows."""
    parts = ["one-sided power spectral density of the recording."]
    if math.isfinite(view.period):
        first = figures(1.0 / view.period, 5)
        parts.append(f"triangles: the {name_period_source(view)} ({first} Hz) and its harmonics.")
    if view.has("density_rest"):
        parts.append(
            "orange: the lines that are removed; blue: the rest. Lines between the harmonics are subharmonics; a broad"
            " floor well above that of the sensor is either chaos or noise; the tests below distinguish these."
        )
    return join_sentences(parts)


def _reduce_bins(frequency: Array, density: Array) -> tuple[Array, Array]:
    """Return the median and the highest density of each group of bins, so that no line is lost in a small figure."""
    size = max(1, math.ceil(len(density) / MAX_BINS))
    if size == 1:
        return frequency, density
    rows = len(density) // size
    groups = density[: rows * size].reshape(rows, size)
    ends = np.stack([np.median(groups, axis=1), groups.max(axis=1)], axis=1).ravel()
    return np.repeat(frequency[: rows * size : size], 2), ends


def _find_highest_frequency(frequency: Array, density: Array, period: float) -> float:
    """Return the upper frequency (Hz) of the main panel: it contains 99 % of the power and eight harmonics."""
    power = np.cumsum(np.nan_to_num(density))
    most = frequency[min(int(np.searchsorted(power, 0.99 * power[-1])), len(frequency) - 1)]
    lines = 8.5 / period if math.isfinite(period) else 0.0
    return float(min(frequency[-1], max(1.5 * most, lines, frequency[min(20, len(frequency) - 1)])))


def _find_density_limits(density: Array) -> tuple[float, float]:
    """Return limits of the logarithmic axis that leave out the lowest 0.2 % of the densities."""
    positive = density[np.isfinite(density) & (density > 0)]
    if not positive.size:
        return 0.1, 10.0
    top = float(positive.max())
    return max(float(np.quantile(positive, 0.002)) / 3.0, 1e-14 * top), 6.0 * top


def _mark_harmonics(axes: Axes, view: AnalysisView, highest: float) -> None:
    period, label = view.period, f"harmonics of the {name_period_source(view)}"
    if not math.isfinite(period):
        return
    lines = np.arange(1, HARMONICS_MARKED + 1) / period
    lines = lines[lines <= highest]
    axes.plot(lines, np.full(lines.size, 0.97), "v", color=style.RECORDED, markersize=5, clip_on=False,
              transform=axes.get_xaxis_transform(), label=label)  # fmt: skip


def draw_sections(view: AnalysisView) -> Figure | None:
    """Return the section before and after noise reduction on the same axes, or the only one available."""
    both = find_versions(view, "section", "section_cleaned")
    if not both:
        return None
    figure = style.make_figure(4.2)
    shown = choose_scale(view, "section", "section_cleaned")
    panels = figure.subplots(1, len(both), squeeze=False, sharex=True, sharey=True)[0]
    for axes, (key, words, colour) in zip(panels, both, strict=True):
        if key != both[0].key:
            draw_section(axes, view, ("section", "#d3d3d3"), shown)
        draw_section(axes, view, (key, colour), shown)
        axes.set_title(words, color=colour)
    if len(panels) > 1:
        panels[1].set_ylabel("")
    return figure


def draw_section(axes: Axes, view: AnalysisView, what: tuple[str, str], shown: Scale) -> None:
    """Draw the points (hits, 2) of one section."""
    key, colour = what
    points = thin_rows(shown.factor * view.arrays[key].reshape(-1, 2), MAX_ORBIT_SAMPLES)
    size = float(np.clip(60.0 / math.sqrt(max(1, len(points))), 1.8, 5.0))
    axes.plot(points[:, 0], points[:, 1], ".", color=colour, markersize=size, markeredgewidth=0)
    across, up = name_delay_axes(view, shown) if math.isfinite(view.period) else _name_delayed_axes(view, shown)
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    style.few_ticks(axes, 5, 5)


def _name_delayed_axes(view: AnalysisView, shown: Scale) -> tuple[str, str]:
    """Return the axis labels of a section at a level that the recording crosses."""
    name = name_quantity(view)
    return with_unit(f"{name}, one delay later", shown.unit), with_unit(f"{name}, two delays later", shown.unit)


def caption_sections(view: AnalysisView) -> str:
    """Return what the figure of the section shows."""
    hits = len(view.arrays["section" if view.has("section") else "section_cleaned"])
    driven = math.isfinite(view.period)
    where = "one point for each period, at the same phase" if driven else "one point for each upward crossing"
    pale = " pale on the right: as recorded." if len(find_versions(view, "section", "section_cleaned")) > 1 else ""
    return join_sentences(
        [
            f"Poincaré section, {where} ({hits} points).{pale.replace(' pale', ' Pale')}",
            "A periodic motion appears as a few points, two independent frequencies as a closed curve, chaos as a"
            " folded figure, and noise as a cloud.",
        ]
    )
