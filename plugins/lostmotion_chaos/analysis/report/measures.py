"""Figures of the measures: the divergence of neighbours, and the correlation sum over the radius."""

from __future__ import annotations

import math

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from lostmotion.report import style
from lostmotion.report.words import figures, format_unit, shorten
from lostmotion.results import STATUSES, Array
from lostmotion_chaos.analysis.report.view import AnalysisView, join_sentences
from lostmotion_chaos.results import Measure

DIMENSION_COLOURS = mpl.colormaps["viridis"]


def convert_to_natural(view: AnalysisView, value: float) -> float:
    """Return an exponent of the stated unit (1/s, bit/s, 1/period, bit/period) in 1/s, natural logarithm."""
    unit = view.result.lyapunov.unit
    per_second = value / view.period if unit.endswith("/period") else value
    return per_second * math.log(2.0) if unit.startswith("bit") else per_second


def draw_divergence_figure(view: AnalysisView) -> Figure | None:
    """Return the mean logarithm of the distance of neighbours over time with the fitted line, and its local slopes."""
    if not view.has("lyapunov_time", "lyapunov_divergence"):
        return None
    figure = style.make_figure(3.5)
    slopes = view.has("lyapunov_slope")
    panels = figure.subplots(1, 1 + slopes, squeeze=False, width_ratios=(1.5, 1.0)[: 1 + slopes])[0]
    draw_divergence(panels[0], view)
    style.legend_above(figure, panels[0])
    if slopes:
        _draw_slopes(panels[1], view)
    return figure


def caption_divergence(view: AnalysisView) -> str:
    """Return what the figure of the divergence shows."""
    members = (
        "thin: neighbours at other distances, as measured and shifted vertically; in the shaded range the thick curve "
        "is corrected for the growth that noise and the finite distances hide."
        if view.has("lyapunov_members")
        else ""
    )
    fit = "shaded: the range of the fit of the exponent." if _has_fit(view) else _explain_refusal(view.result.lyapunov)
    slopes = "right, the local slope; an exponent appears as a plateau." if view.has("lyapunov_slope") else ""
    return join_sentences(
        ["divergence of close states: mean natural logarithm of their distance, over time.", members, fit, slopes]
    )


def draw_divergence(axes: Axes, view: AnalysisView) -> None:
    """Draw the curve, its variants, and the fitted line."""
    time, curve = view.arrays["lyapunov_time"], view.arrays["lyapunov_divergence"]
    members = view.arrays.get("lyapunov_members")
    if members is not None and members.ndim == 2 and members.shape[1] == time.size:
        for k, member in enumerate(members):
            axes.plot(
                time,
                member + _compute_shift(member, curve),
                color="#b8b8b8",
                linewidth=0.7,
                label="as measured" if k == 0 else None,
            )
    axes.plot(time, curve, color=style.AFTER, linewidth=1.8, label="mean divergence")
    if _has_fit(view):
        begin, end, slope = _find_fit_line(view)
        axes.axvspan(begin, end, color=style.SHADE, zorder=0.3)
        window = np.linspace(begin - 0.15 * (end - begin), end + 0.15 * (end - begin), 2)
        value = shorten(f"{figures(view.result.lyapunov.value)} {format_unit(view.result.lyapunov.unit)}", 32)
        middle = 0.5 * (begin + end)
        line = np.interp(middle, time, curve) + slope * (window - middle)
        axes.plot(window, line, color=style.BEFORE, linewidth=2.0,
                  linestyle=(0, (5, 2)), label=f"fit: {value}")  # fmt: skip
    if time.size > 1:
        axes.set_xlim(float(time.min()), float(time.max()))
    axes.set_xlabel("time (s)")
    axes.set_ylabel("mean ln of distance")
    style.few_ticks(axes, 6, 6)


def _draw_slopes(axes: Axes, view: AnalysisView) -> None:
    time, slope = view.arrays["lyapunov_time"], view.arrays["lyapunov_slope"]
    if slope.shape != time.shape:
        return
    axes.plot(time, slope, color=style.AFTER, linewidth=1.2)
    low, high = (convert_to_natural(view, end) for end in (view.result.lyapunov.low, view.result.lyapunov.high))
    if math.isfinite(low) and math.isfinite(high):
        axes.axhspan(low, high, color=style.BEFORE, alpha=0.2, linewidth=0)
    if _has_fit(view):
        begin, end, value = _find_fit_line(view)
        axes.axvspan(begin, end, color=style.SHADE, zorder=0.3)
        axes.axhline(value, color=style.BEFORE, linestyle=(0, (5, 2)), linewidth=1.4)
        inside = slope[(time >= begin) & (time <= end)]
        axes.set_ylim(*_find_slope_limits(slope, inside, value))
    axes.axhline(0.0, color=style.QUIET, linewidth=0.8, zorder=0.6)
    if time.size > 1:
        axes.set_xlim(float(time.min()), float(time.max()))
    axes.set_xlabel("time (s)")
    axes.set_ylabel("local slope (1/s)")
    style.few_ticks(axes, 4, 5)


def _find_slope_limits(slope: Array, inside: Array, value: float) -> tuple[float, float]:
    """Return axis limits that show the fitted range, independent of large slopes at the beginning."""
    finite = inside[np.isfinite(inside)]
    top = max(float(finite.max()) if finite.size else value, value, 0.0)
    low = min(float(np.nanquantile(slope, 0.05)), 0.0)
    return (low - 0.15 * (top - low) if low < 0 else -0.1 * top, top + 0.6 * abs(top) + 1e-12)


def _has_fit(view: AnalysisView) -> bool:
    return all(map(math.isfinite, _find_fit_line(view)))


def _find_fit_line(view: AnalysisView) -> tuple[float, float, float]:
    """Return both ends (s) of the fitted range, and its slope (1/s)."""
    exponent = view.result.lyapunov
    begin, end = (exponent.details.get(key, math.nan) for key in ("fit_begin", "fit_end"))
    return begin, end, convert_to_natural(view, exponent.value)


def _compute_shift(member: Array, curve: Array) -> float:
    """Return the vertical shift of a curve onto another one; only slopes are compared."""
    both = np.isfinite(member) & np.isfinite(curve)
    return float(np.mean(curve[both] - member[both])) if both.any() else 0.0


def _explain_refusal(found: Measure) -> str:
    status = found.status
    return "" if status == "ok" else f"it gives no value: {STATUSES.get(status, status)}."


def draw_correlation(view: AnalysisView) -> Figure | None:
    """Return correlation sums and slopes over the radius, one curve for each dimension, and D2 over the dimension."""
    sums = view.has("d2_radius", "d2_log_correlation")
    slopes = view.has("d2_radius", "d2_slope")
    values = view.has("d2_dim", "d2_dimension_by_dim")
    draws = [draw for draw, can in ((_draw_sums, sums), (_draw_local_slopes, slopes), (draw_dimensions, values)) if can]
    if not draws:
        return None
    figure = style.make_figure(3.5)
    panels = figure.subplots(1, len(draws), squeeze=False)[0]
    for axes, draw in zip(panels, draws, strict=True):
        draw(axes, view)
    return figure


def caption_correlation(view: AnalysisView) -> str:
    """Return what the figure of the correlation dimension shows."""
    sums = "the share of pairs of states closer than a radius, one curve for each embedding dimension, and its slope."
    low, _, value = _find_plateau(view)
    plateau = (
        "shaded: the radii and the interval of the plateau." if math.isfinite(low) and math.isfinite(value) else ""
    )
    noise = "noise fills every embedding dimension (dotted); a deterministic motion levels off"
    surrogates = "; grey: the surrogates." if view.has("surrogate_d2_by_dim") else "."
    return join_sentences(
        [
            sums if view.has("d2_log_correlation") or view.has("d2_slope") else "",
            plateau,
            noise + surrogates if view.has("d2_dimension_by_dim") else "",
            _explain_refusal(view.result.d2) if not math.isfinite(value) else "",
        ]
    )


def _find_plateau(view: AnalysisView) -> tuple[float, float, float]:
    dimension = view.result.d2
    low, high = (dimension.details.get(key, math.nan) for key in ("r_low", "r_high"))
    return low, high, dimension.value


def _list_curves(view: AnalysisView, name: str) -> list[tuple[Array, str, tuple[float, ...]]]:
    """Return the curve of each dimension with its name and colour."""
    curves = np.atleast_2d(view.arrays[name])
    dims = view.arrays.get("d2_dim")
    dims = dims if dims is not None and dims.size == len(curves) else np.arange(1.0, len(curves) + 1)
    shades = np.linspace(0.08, 0.88, max(2, len(curves)))
    return [
        (curve, f"{dim:g}", DIMENSION_COLOURS(shade)) for curve, dim, shade in zip(curves, dims, shades, strict=False)
    ]


def _draw_sums(axes: Axes, view: AnalysisView) -> None:
    for curve, name, colour in _list_curves(view, "d2_log_correlation"):
        axes.plot(view.arrays["d2_radius"], curve, color=colour, linewidth=1.1, label=name)
    _format_radius_axis(axes, view)
    inside = np.atleast_2d(view.arrays["d2_log_correlation"])[:, view.arrays["d2_radius"] >= axes.get_xlim()[0]]
    axes.set_ylim(*style.span_of(inside, 0.04))
    axes.set_ylabel("ln of correlation sum")
    axes.legend(title="dimension", loc="lower right", fontsize=8, title_fontsize=8, ncols=2, labelspacing=0.2,
                handlelength=1.2, columnspacing=0.8, frameon=True, framealpha=0.85, edgecolor="none")  # fmt: skip


def _draw_local_slopes(axes: Axes, view: AnalysisView) -> None:
    tallest, least = 1.0, _find_smallest_radius(view, view.arrays["d2_radius"])
    for curve, _, colour in _list_curves(view, "d2_slope"):
        axes.plot(view.arrays["d2_radius"], curve, color=colour, linewidth=1.1)
        finite = curve[np.isfinite(curve) & (view.arrays["d2_radius"] >= least)]
        tallest = max(tallest, float(np.quantile(finite, 0.97)) if finite.size else 0.0)
    _format_radius_axis(axes, view)
    _draw_interval(axes, view)
    axes.set_ylim(0.0, 1.15 * tallest)
    axes.set_ylabel("local slope")


def _draw_interval(axes: Axes, view: AnalysisView) -> None:
    low, high, value = view.result.d2.low, view.result.d2.high, view.result.d2.value
    if math.isfinite(low) and math.isfinite(high):
        axes.axhspan(low, high, color=style.BEFORE, alpha=0.22, linewidth=0, zorder=0.7)
    if math.isfinite(value):
        axes.axhline(value, color=style.BEFORE, linewidth=1.4, linestyle=(0, (5, 2)))


def _format_radius_axis(axes: Axes, view: AnalysisView) -> None:
    radius = view.arrays["d2_radius"]
    unit = view.units.get("d2_radius") or view.units.get("x", "")
    axes.set_xscale("log")
    if radius.size > 1:
        axes.set_xlim(_find_smallest_radius(view, radius), float(radius.max()))
    style.log_ticks(axes.xaxis, 5)
    low, high, value = _find_plateau(view)
    if math.isfinite(low) and math.isfinite(high) and math.isfinite(value):
        axes.axvspan(low, high, color=style.SHADE, zorder=0.3)
    label = format_unit(shorten(unit, 16))
    axes.set_xlabel(f"radius ({label})" if label else "radius")


def _find_smallest_radius(view: AnalysisView, radius: Array) -> float:
    """Return the smallest radius to draw, a little below the smallest one with a value in the highest dimension."""
    name = "d2_log_correlation" if view.has("d2_log_correlation") else "d2_slope"
    last = np.atleast_2d(view.arrays[name])[-1]
    seen = radius[np.isfinite(last) & (radius > 0)] if last.shape == radius.shape else radius[:0]
    low, _, _ = _find_plateau(view)
    wanted = min(0.3 * float(seen.min()) if seen.size else math.inf, 0.5 * low if low > 0 else math.inf)
    least = float(radius[radius > 0].min())
    return max(least, wanted) if math.isfinite(wanted) else least


def draw_dimensions(axes: Axes, view: AnalysisView) -> None:
    """Draw D2 with its interval over the embedding dimension, and that of surrogates."""
    dims, values = view.arrays["d2_dim"], view.arrays["d2_dimension_by_dim"]
    top = float(np.nanmax(dims)) + 0.5
    axes.plot([0.0, top], [0.0, top], color=style.QUIET, linewidth=1.0, linestyle=(0, (1, 2)), label="noise")
    drawn = view.arrays.get("surrogate_d2_by_dim")
    if drawn is not None and drawn.ndim == 2 and drawn.shape[1] == dims.size:
        for k, row in enumerate(drawn):
            axes.plot(dims, row, color="#b8b8b8", linewidth=0.6, label="surrogates" if k == 0 else None)
    errors = _compute_errors(view, values)
    axes.errorbar(dims, values, yerr=errors, color=style.AFTER, marker="o", markersize=4.5, capsize=2.5,
                  elinewidth=1.0, label="recording")  # fmt: skip
    _draw_interval(axes, view)
    seen = [values, drawn.ravel()] if drawn is not None else [values]
    finite = np.concatenate(seen)[np.isfinite(np.concatenate(seen))]
    axes.set_ylim(0.0, min(top, 1.35 * float(finite.max()) + 0.5) if finite.size else top)
    axes.set_xlim(min(0.5, float(np.nanmin(dims)) - 0.5), top)
    axes.xaxis.set_major_locator(MaxNLocator(8, integer=True))
    axes.set_xlabel("embedding dimension")
    axes.set_ylabel("correlation dimension")
    axes.legend(loc="upper left", fontsize=8)


def _compute_errors(view: AnalysisView, values: Array) -> Array | None:
    if not view.has("d2_low_by_dim", "d2_high_by_dim"):
        return None
    low, high = view.arrays["d2_low_by_dim"], view.arrays["d2_high_by_dim"]
    if low.shape != values.shape or high.shape != values.shape:
        return None
    return np.maximum(np.nan_to_num(np.stack([values - low, high - values])), 0.0)
