"""Figure of the disagreement of the models over time or hits, as a colour strip, and a table of recordings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.diagnosis.report.versions import Version, list_versions
from lostmotion.report import style
from lostmotion.report.pages import Grid
from lostmotion.report.words import DASH, figures, with_unit
from lostmotion.results import Array, percent
from lostmotion.results.mismatch import DisagreementOverTime

COLOUR_RANGE = 3.0
"""Smallest range of the colour scale, as a factor."""
AXIS_RANGE = 2.2
"""Smallest range of the axis, as a factor, so that half and twice the expected value have tick marks."""
SMALLEST_RATIO = 1e-3


def draw(evidence: Evidence) -> Figure | None:
    """Return a strip for each model over a step plot of both, or None without a comparison over time."""
    found = evidence.result.where.over_time
    if found is None or len(found.edges) < 3:
        return None
    rows = {
        version: np.maximum(version.select(found.before, found.after), SMALLEST_RATIO)
        for version in list_versions(evidence)
    }
    scale = style.scale_of(np.array(found.edges), "s")
    edges = scale.factor * np.array(found.edges)
    figure = style.make_figure(0.45 * len(rows) + 2.6)
    panels = figure.subplots(len(rows) + 1, 1, sharex=True, height_ratios=[*(0.32,) * len(rows), 1.6])
    _draw_strips(panels[:-1], edges, rows)
    below = panels[-1]
    _draw_steps(below, edges, rows)
    _mark_expected(below, found, scale.factor)
    below.set_xlabel(with_unit("time", scale.unit))
    style.legend_above(figure, below)
    return figure


def _draw_strips(panels: Sequence[Axes], edges: Array, rows: Mapping[Version, Array]) -> None:
    """Draw a row of colours for each model, with one colour bar."""
    values = np.concatenate(list(rows.values()))
    most = max(COLOUR_RANGE, float(np.nanmax(values)), 1.0 / float(np.nanmin(values)))
    for axes, (version, row) in zip(panels, rows.items(), strict=True):
        colours = LogNorm(1.0 / most, most)
        shown = axes.pcolormesh(edges, [0.0, 1.0], row[None], cmap="RdBu_r", norm=colours)
        axes.set_yticks([0.5], [version.word or "model"])
        axes.tick_params(length=0)
        axes.grid(visible=False)
        axes.spines[:].set_visible(False)
    bar = panels[0].figure.colorbar(shown, ax=panels, aspect=6, pad=0.01)
    style.log_ticks(bar.ax.yaxis, 3)


def _draw_steps(axes: Axes, edges: Array, rows: Mapping[Version, Array]) -> None:
    """Draw the disagreement of each model over time, as steps."""
    for version, row in rows.items():
        axes.stairs(
            row, edges, baseline=None, color=version.colour, linewidth=1.6, label=version.make_label("disagreement")
        )
    values = np.concatenate(list(rows.values()))
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    axes.set_yscale("log")
    axes.set_ylim(min(1.0 / AXIS_RANGE, 0.85 * low), max(AXIS_RANGE, 1.18 * high))
    style.log_ticks(axes.yaxis)
    axes.set_ylabel("one-step error variance\nover expected")
    axes.set_xlim(edges[0], edges[-1])


def _mark_expected(axes: Axes, found: DisagreementOverTime, factor: float) -> None:
    """Draw the expected value, and shade the window with a significant disagreement."""
    axes.axhline(found.expected, color=style.RECORDED, linewidth=0.8, label="expected")
    if found.worst.beyond_chance:
        axes.axvspan(factor * found.worst.begin, factor * found.worst.end, color=style.SHADE, zorder=0)


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure; empty without a comparison over time."""
    found, recordings = evidence.result.where.over_time, evidence.result.where.by_recording
    if found is None:
        return ""
    window = "hit, up to the next one" if found.windows == "hits" else "window"
    worst = found.says or "No section has a significant disagreement."
    shaded = " It is shaded." if found.worst.beyond_chance else ""
    level = evidence.settings.locate.level
    return (
        f"{worst}{shaded} For each {window}: the mean squared one-step prediction error over the variance that the"
        " model predicts for it, 1 for a correct model. Significance is tested by permutations of blocks of errors,"
        f" at {percent(level)} over all windows together. {recordings.says if recordings else ''}"
    ).rstrip()


def make_table(evidence: Evidence) -> Grid | None:
    """Return one row for each recording: its level, and the disagreement before and after; None with one recording."""
    found = evidence.result.where.by_recording
    if found is None:
        return None
    return Grid(
        ["Recording", f"{found.level_of.capitalize()} level (rms)", "Part", "Before", "After", "p"],
        [
            [
                row.name,
                f"{figures(row.level)} {row.unit}",
                "fitted" if row.fitted else "held out",
                figures(row.before),
                figures(row.after),
                DASH if row.p_after is None else figures(row.p_after, 2),
            ]
            for row in found.rows
        ],
    )
