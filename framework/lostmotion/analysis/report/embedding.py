"""Figures of the embedding: how the delay and the dimension were chosen."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from lostmotion.analysis.report.view import AnalysisView, Variant, listed, versions
from lostmotion.report import style
from lostmotion.report.words import DASH, figures, shortened, spoken

CLEAN, RAW = "embedding_", "embedding_raw_"
DELAYS = 14.0
CAO = (("e1", "E1", "o", "-"), ("e2", "E2", "s", (0, (4, 2))))
UNITS = {"nat": "nat", "bit": "bit"}


def delay(view: AnalysisView) -> Figure | None:
    """Return mutual information and autocorrelation over the lag, with the chosen one marked."""
    names = [name for name in ("ami", "autocorrelation") if _able(view, name, "lag")]
    if not names:
        return None
    figure = style.blank(3.3)
    panels = figure.subplots(1, len(names), squeeze=False)[0]
    for axes, name in zip(panels, names, strict=True):
        _draw_over(axes, view, name, "lag")
        _mark_delay(axes, view)
        axes.set_xlabel("lag (s)")
        axes.set_xlim(0.0, _longest(view))
        _lower_start(axes, view, name)
        style.few_ticks(axes, 6, 5)
    unit = shortened(view.units.get(CLEAN + "ami", "") or view.units.get(RAW + "ami", ""), 12)
    words = {"ami": f"mutual information ({UNITS.get(unit, 'nat')})", "autocorrelation": "autocorrelation"}
    for axes, name in zip(panels, names, strict=True):
        axes.set_ylabel(words[name])
        _draw_floor(axes, view, name)
    style.legend_above(figure, panels[0])
    return figure


def delay_caption(view: AnalysisView) -> str:
    """Return what the figure of the delay shows."""
    seconds, method = view.result.delay.seconds, view.result.delay.method
    chosen = (
        f"dashed upright: the chosen delay, {figures(seconds)} s" if math.isfinite(seconds) else "no delay was chosen"
    )
    how = f" (by {shortened(spoken(method))})." if method and math.isfinite(seconds) else "."
    floor = "dotted: what independent values would show." if view.has(CLEAN + "ami_floor") else ""
    return listed(
        [
            "what the recording tells about itself after a lag: average mutual information, and autocorrelation.",
            chosen + how,
            floor,
        ]
    )


def dimension(view: AnalysisView) -> Figure | None:
    """Return Cao's E1 and E2 and the share of false neighbours over the dimension, raw and cleaned."""
    able = [name for name, axis in (("e1", "dim"), ("fnn", "dim_fnn")) if _able(view, name, axis)]
    if not able:
        return None
    figure = style.blank(3.4)
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


def dimension_caption(view: AnalysisView) -> str:
    """Return what the figure of the dimension shows."""
    value = figures(view.result.dimension.value)
    chosen = f"dashed upright: the chosen dimension, {value}." if value != DASH else "no dimension was chosen."
    cao = (
        "Cao's E1 levels off where the motion is unfolded; E2 stays at 1 for all dimensions if the values are"
        " independent random numbers, and leaves it somewhere if they are not."
    )
    false = "False neighbours are states that look alike only because there are too few dimensions."
    both = len(_versions(view, "e1")) > 1 or len(_versions(view, "fnn")) > 1
    noise = "Noise asks for more dimensions than the motion does." if both else ""
    return listed(
        [
            cao if _able(view, "e1", "dim") else "",
            false if _able(view, "fnn", "dim_fnn") else "",
            noise,
            chosen,
        ]
    )


def _able(view: AnalysisView, name: str, axis: str) -> bool:
    return any(view.has(prefix + name, prefix + axis) for prefix in (CLEAN, RAW))


def _versions(view: AnalysisView, name: str) -> list[Variant]:
    return versions(view, RAW + name, CLEAN + name)


def _draw_over(axes: Axes, view: AnalysisView, name: str, axis: str) -> None:
    for key, words, colour in _versions(view, name):
        prefix = key.removesuffix(name)
        if view.has(prefix + axis):
            label = words if len(_versions(view, name)) > 1 else None
            axes.plot(view.arrays[prefix + axis], view.arrays[key], color=colour, label=label)


def _longest(view: AnalysisView) -> float:
    """Return the lag (s) up to which curves are drawn: some delays, so that the chosen one can be seen."""
    lags = np.concatenate([view.arrays[p + "lag"] for p in (CLEAN, RAW) if view.has(p + "lag")])
    seconds, last = view.result.delay.seconds, float(np.nanmax(lags))
    return min(last, DELAYS * seconds) if seconds > 0 else last or 1.0


def _lower_start(axes: Axes, view: AnalysisView, name: str) -> None:
    """Cut off what a value tells about itself at lag 0, which would dwarf the rest."""
    keys = [shown.key for shown in _versions(view, name)]
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
    elif view.has(CLEAN + "ami_floor", CLEAN + "lag"):
        floor = np.broadcast_to(view.arrays[CLEAN + "ami_floor"], view.arrays[CLEAN + "lag"].shape)
        axes.plot(view.arrays[CLEAN + "lag"], floor, color=style.QUIET, linestyle=(0, (1, 2)),
                  label="independent values")  # fmt: skip


def _draw_cao(axes: Axes, view: AnalysisView) -> None:
    for name, words, marker, line in CAO:
        found = _versions(view, name)
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
    found = _versions(view, "fnn")
    for key, words, colour in found:
        prefix = key.removesuffix("fnn")
        if view.has(prefix + "dim_fnn"):
            axes.plot(view.arrays[prefix + "dim_fnn"], 100.0 * view.arrays[key], color=colour, marker="o",
                      markersize=4.5, label=words if len(found) > 1 else None)  # fmt: skip
    axes.set_ylabel("false neighbours (%)")
    axes.set_title("false nearest neighbours")
    if len(found) > 1:
        axes.legend(loc="upper right")
