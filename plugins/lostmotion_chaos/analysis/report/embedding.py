"""Figures of the embedding: how the delay and the dimension were chosen."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from lostmotion.report import style
from lostmotion.report.words import DASH, figures, shorten, to_words
from lostmotion_chaos.analysis.report.view import AnalysisView, Variant, find_versions, join_sentences

CLEAN_PREFIX, RAW_PREFIX = "embedding_", "embedding_raw_"
DELAYS_SHOWN = 14.0
CAO_CURVES = (("e1", "E1", "o", "-"), ("e2", "E2", "s", (0, (4, 2))))
UNIT_NAMES = {"nat": "nat", "bit": "bit"}


def draw_delay(view: AnalysisView) -> Figure | None:
    """Return mutual information and autocorrelation over the lag, with the chosen one marked."""
    names = [name for name in ("ami", "autocorrelation") if _has_curve(view, name, "lag")]
    if not names:
        return None
    figure = style.make_figure(3.3)
    panels = figure.subplots(1, len(names), squeeze=False)[0]
    for axes, name in zip(panels, names, strict=True):
        _draw_curves(axes, view, name, "lag")
        _mark_delay(axes, view)
        axes.set_xlabel("lag (s)")
        axes.set_xlim(0.0, _find_longest_lag(view))
        _limit_start(axes, view, name)
        style.few_ticks(axes, 6, 5)
    unit = shorten(view.units.get(CLEAN_PREFIX + "ami", "") or view.units.get(RAW_PREFIX + "ami", ""), 12)
    words = {"ami": f"mutual information ({UNIT_NAMES.get(unit, 'nat')})", "autocorrelation": "autocorrelation"}
    for axes, name in zip(panels, names, strict=True):
        axes.set_ylabel(words[name])
        _draw_floor(axes, view, name)
    style.legend_above(figure, panels[0])
    return figure


def caption_delay(view: AnalysisView) -> str:
    """Return what the figure of the delay shows."""
    seconds, method = view.result.delay.seconds, view.result.delay.method
    chosen = (
        f"dashed vertical line: the chosen delay, {figures(seconds)} s"
        if math.isfinite(seconds)
        else "no delay was chosen"
    )
    how = f" (by {shorten(to_words(method))})." if method and math.isfinite(seconds) else "."
    floor = "dotted: the value for independent samples." if view.has(CLEAN_PREFIX + "ami_floor") else ""
    return join_sentences(
        [
            "dependence of the recording on itself after a lag: average mutual information, and autocorrelation.",
            chosen + how,
            floor,
        ]
    )


def draw_dimension(view: AnalysisView) -> Figure | None:
    """Return Cao's E1 and E2 and the share of false neighbours over the dimension, raw and cleaned."""
    able = [name for name, axis in (("e1", "dim"), ("fnn", "dim_fnn")) if _has_curve(view, name, axis)]
    if not able:
        return None
    figure = style.make_figure(3.4)
    panels = figure.subplots(1, len(able), squeeze=False)[0]
    for axes, name in zip(panels, able, strict=True):
        (_draw_cao if name == "e1" else _draw_false)(axes, view)
        chosen = view.result.dimension.value
        if math.isfinite(chosen):
            axes.axvline(chosen, color=style.LAW, linewidth=1.2, linestyle=(0, (4, 2)), zorder=0.8)
        axes.set_xlabel("embedding dimension")
        axes.xaxis.set_major_locator(MaxNLocator(9, integer=True))
        axes.set_ylim(bottom=0.0)
    return figure


def caption_dimension(view: AnalysisView) -> str:
    """Return what the figure of the dimension shows."""
    value = figures(view.result.dimension.value)
    chosen = f"dashed vertical line: the chosen dimension, {value}." if value != DASH else "no dimension was chosen."
    cao = (
        "Cao's E1 levels off at the dimension in which the motion is unfolded; E2 is 1 for all dimensions if the values"
        " are independent random numbers, and differs from 1 for some dimension if they are not."
    )
    false = "False neighbours are states that are close only because the dimension is too low."
    both = len(_find_versions(view, "e1")) > 1 or len(_find_versions(view, "fnn")) > 1
    noise = "Noise needs more dimensions than the motion." if both else ""
    return join_sentences(
        [
            cao if _has_curve(view, "e1", "dim") else "",
            false if _has_curve(view, "fnn", "dim_fnn") else "",
            noise,
            chosen,
        ]
    )


def _has_curve(view: AnalysisView, name: str, axis: str) -> bool:
    return any(view.has(prefix + name, prefix + axis) for prefix in (CLEAN_PREFIX, RAW_PREFIX))


def _find_versions(view: AnalysisView, name: str) -> list[Variant]:
    return find_versions(view, RAW_PREFIX + name, CLEAN_PREFIX + name)


def _draw_curves(axes: Axes, view: AnalysisView, name: str, axis: str) -> None:
    for key, words, colour in _find_versions(view, name):
        prefix = key.removesuffix(name)
        if view.has(prefix + axis):
            label = words if len(_find_versions(view, name)) > 1 else None
            axes.plot(view.arrays[prefix + axis], view.arrays[key], color=colour, label=label)


def _find_longest_lag(view: AnalysisView) -> float:
    """Return the lag (s) up to which curves are drawn: some delays, so that the chosen one is visible."""
    lags = np.concatenate([view.arrays[p + "lag"] for p in (CLEAN_PREFIX, RAW_PREFIX) if view.has(p + "lag")])
    seconds, last = view.result.delay.seconds, float(np.nanmax(lags))
    return min(last, DELAYS_SHOWN * seconds) if seconds > 0 else last or 1.0


def _limit_start(axes: Axes, view: AnalysisView, name: str) -> None:
    """Limit the vertical axis to lags above 0, since the mutual information at lag 0 is much larger."""
    keys = [shown.key for shown in _find_versions(view, name)]
    later = [np.nanmax(view.arrays[key][1:]) for key in keys if np.isfinite(view.arrays[key][1:]).any()]
    if name == "ami" and later:
        axes.set_ylim(0.0, 1.08 * float(max(later)))


def _mark_delay(axes: Axes, view: AnalysisView) -> None:
    seconds = view.result.delay.seconds
    if math.isfinite(seconds):
        axes.axvline(seconds, color=style.LAW, linewidth=1.2, linestyle=(0, (4, 2)), zorder=0.8, label="chosen")


def _draw_floor(axes: Axes, view: AnalysisView, name: str) -> None:
    if name == "autocorrelation":
        for level in (0.0, 1.0 / math.e):
            axes.axhline(level, color=style.QUIET, linewidth=0.8, linestyle=(0, (1, 2)), zorder=0.8)
        axes.annotate("1/e", (1.0, 1.0 / math.e), xycoords=axes.get_yaxis_transform(), xytext=(-2, 2),
                      textcoords="offset points", ha="right", color=style.QUIET, fontsize=8.5)  # fmt: skip
    elif view.has(CLEAN_PREFIX + "ami_floor", CLEAN_PREFIX + "lag"):
        floor = np.broadcast_to(view.arrays[CLEAN_PREFIX + "ami_floor"], view.arrays[CLEAN_PREFIX + "lag"].shape)
        axes.plot(view.arrays[CLEAN_PREFIX + "lag"], floor, color=style.QUIET, linestyle=(0, (1, 2)),
                  label="independent values")  # fmt: skip


def _draw_cao(axes: Axes, view: AnalysisView) -> None:
    for name, words, marker, line in CAO_CURVES:
        found = _find_versions(view, name)
        for key, version, colour in found:
            prefix = key.removesuffix(name)
            label = f"{words}, {version}" if len(found) > 1 else words
            if view.has(prefix + "dim"):
                axes.plot(view.arrays[prefix + "dim"], view.arrays[key], color=colour, marker=marker,
                          linestyle=line, markersize=4.5, label=label)  # fmt: skip
    axes.axhline(1.0, color=style.QUIET, linewidth=0.8, linestyle=(0, (1, 2)), zorder=0.8)
    axes.set_ylabel("E1, E2")
    axes.set_title("Cao")
    axes.legend(loc="lower right")


def _draw_false(axes: Axes, view: AnalysisView) -> None:
    found = _find_versions(view, "fnn")
    for key, words, colour in found:
        prefix = key.removesuffix("fnn")
        if view.has(prefix + "dim_fnn"):
            axes.plot(view.arrays[prefix + "dim_fnn"], 100.0 * view.arrays[key], color=colour, marker="o",
                      markersize=4.5, label=words if len(found) > 1 else None)  # fmt: skip
    axes.set_ylabel("false neighbours (%)")
    axes.set_title("false nearest neighbours")
    if len(found) > 1:
        axes.legend(loc="upper right")
