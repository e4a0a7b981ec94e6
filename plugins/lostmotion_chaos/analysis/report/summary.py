"""The summary figure of an analysis, for a README or a talk: portrait, section, divergence, dimension."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.report import style
from lostmotion_chaos.analysis.report.measures import draw_dimensions, draw_divergence
from lostmotion_chaos.analysis.report.motion import draw_portrait, draw_section
from lostmotion_chaos.analysis.report.view import AnalysisView, choose_scale, read_analysis

Panel = Callable[[Axes, AnalysisView], None]


def save_summary(folder: Path) -> Path:
    """Write `summary.png` into the folder (portrait, section, divergence, dimension) and return its path."""
    with style.use_style():
        return style.save(draw(read_analysis(folder)), folder / "summary.png")


def draw(view: AnalysisView) -> Figure:
    """Return the panels side by side; a panel whose arrays are absent is left out."""
    panels = _list_panels(view)
    figure = style.make_figure(3.5, width=3.5 * max(1, len(panels)))
    row = figure.subplots(1, max(1, len(panels)), squeeze=False)[0]
    for axes, (title, panel) in zip(row, panels, strict=False):
        panel(axes, view)
        axes.set_title(title)
    if not panels:
        row[0].set_axis_off()
        row[0].text(0.5, 0.5, "no arrays", ha="center")
    return figure


def _list_panels(view: AnalysisView) -> list[tuple[str, Panel]]:
    able: tuple[tuple[str, Panel, bool], ...] = (
        ("Phase portrait", _draw_portrait_panel, view.has("x")),
        ("Poincaré section", _draw_section_panel, view.has("section")),
        ("Divergence of neighbours", _draw_divergence_panel, view.has("lyapunov_time", "lyapunov_divergence")),
        ("Correlation dimension", draw_dimensions, view.has("d2_dim", "d2_dimension_by_dim")),
    )
    return [(title, panel) for title, panel, can in able if can]


def _choose_cleanest(view: AnalysisView, name: str, cleaned: str) -> str:
    return cleaned if view.has(cleaned) else name


def _draw_portrait_panel(axes: Axes, view: AnalysisView) -> None:
    draw_portrait(axes, view, (_choose_cleanest(view, "x", "cleaned"), style.AFTER), choose_scale(view))


def _draw_section_panel(axes: Axes, view: AnalysisView) -> None:
    draw_section(axes, view, (_choose_cleanest(view, "section", "section_cleaned"), style.AFTER), choose_scale(view))


def _draw_divergence_panel(axes: Axes, view: AnalysisView) -> None:
    draw_divergence(axes, view)
    axes.legend(loc="lower right", fontsize=8)
