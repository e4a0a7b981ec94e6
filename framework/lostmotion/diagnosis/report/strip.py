"""Figure: when the models disagree with a recording, as a strip over time or hits; a table of recordings by level."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.cast import Version, versions
from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style
from lostmotion.report.pages import Grid
from lostmotion.report.words import DASH, figures, with_unit
from lostmotion.results import Array, percent
from lostmotion.results.mismatch import DisagreementOverTime

SPAN = 3.0
"""Colours reach over a factor of three at least: less is no disagreement worth a colour."""
TWICE = 2.2
"""The axis holds a half and twice what is expected at least, so that both have a mark."""
LEVEL = 0.05
LEAST = 1e-3


def draw(evidence: Evidence) -> Figure | None:
    """Return a strip for each model over a step plot of both, or None where nothing was told over time."""
    told = evidence.result.where.over_time
    if told is None or len(told.edges) < 3:
        return None
    rows = {who: np.maximum(who.of(told.before, told.after), LEAST) for who in versions(evidence)}
    scale = style.scale_of(np.array(told.edges), "s")
    edges = scale.factor * np.array(told.edges)
    figure = style.blank(0.45 * len(rows) + 2.6)
    panels = figure.subplots(len(rows) + 1, 1, sharex=True, height_ratios=[*(0.32,) * len(rows), 1.6])
    _draw_strips(panels[:-1], edges, rows)
    below = panels[-1]
    _draw_steps(below, edges, rows)
    _mark(below, told, scale.factor)
    below.set_xlabel(with_unit("time", scale.unit))
    style.legend_above(figure, below)
    return figure


def _draw_strips(panels: Sequence[Axes], edges: Array, rows: Mapping[Version, Array]) -> None:
    """Draw a row of colours for each model, with one bar that says what they mean."""
    values = np.concatenate(list(rows.values()))
    most = max(SPAN, float(np.nanmax(values)), 1.0 / float(np.nanmin(values)))
    for axes, (who, row) in zip(panels, rows.items(), strict=True):
        colours = LogNorm(1.0 / most, most)
        shown = axes.pcolormesh(edges, [0.0, 1.0], row[None], cmap="RdBu_r", norm=colours)
        axes.set_yticks([0.5], [who.word or "model"])
        axes.tick_params(length=0)
        axes.grid(visible=False)
        axes.spines[:].set_visible(False)
    bar = panels[0].figure.colorbar(shown, ax=panels, aspect=6, pad=0.01)
    style.log_ticks(bar.ax.yaxis, 3)


def _draw_steps(axes: Axes, edges: Array, rows: Mapping[Version, Array]) -> None:
    """Draw the disagreement of each model over time, as steps."""
    for who, row in rows.items():
        axes.stairs(row, edges, baseline=None, color=who.colour, linewidth=1.6, label=who.named("disagreement"))
    values = np.concatenate(list(rows.values()))
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    axes.set_yscale("log")
    axes.set_ylim(min(1.0 / TWICE, 0.85 * low), max(TWICE, 1.18 * high))
    style.log_ticks(axes.yaxis)
    axes.set_ylabel("one-step error variance\nover expected")
    axes.set_xlim(edges[0], edges[-1])


def _mark(axes: Axes, told: DisagreementOverTime, factor: float) -> None:
    """Draw what is expected, and shade the window that stands out beyond chance."""
    axes.axhline(told.expected, color=style.RECORDED, linewidth=0.8, label="expected")
    if told.worst.beyond_chance:
        axes.axvspan(factor * told.worst.begin, factor * told.worst.end, color=style.SHADE, zorder=0)


def caption(evidence: Evidence) -> str:
    """Return what to see in the figure; empty where nothing was told over time."""
    told, recordings = evidence.result.where.over_time, evidence.result.where.by_recording
    if told is None:
        return ""
    window = "hit, up to the next one" if told.windows == "hits" else "window"
    said = told.says or "No stretch stands out beyond chance."
    shaded = " It is shaded." if told.worst.beyond_chance else ""
    return (
        f"{said}{shaded} For each {window}: the mean squared one-step prediction error over the variance that the model"
        " states for it, 1 where the model holds. Chance is what remains when blocks of errors change places; it is"
        f" {percent(LEVEL)} over all windows together. {recordings.says if recordings else ''}"
    ).rstrip()


def table(evidence: Evidence) -> Grid | None:
    """Return one row for each recording: its level, and the disagreement before and after; None where there is one."""
    told = evidence.result.where.by_recording
    if told is None:
        return None
    return Grid(
        ["Recording", f"{told.level_of.capitalize()} level (rms)", "Part", "Before", "After", "p"],
        [
            [
                row.name,
                f"{figures(row.level)} {row.unit}",
                "fitted" if row.fitted else "held out",
                figures(row.before),
                figures(row.after),
                DASH if row.p_after is None else figures(row.p_after, 2),
            ]
            for row in told.rows
        ],
    )
