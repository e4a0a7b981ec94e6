"""The one wide picture that tells the whole story, for a README or a talk."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.report import missing, prediction, ranking, style
from lostmotion.report.evidence import Evidence, read_evidence

CANDIDATES = 7
Panel = Callable[[Axes, Evidence], None]


def figure_hero(folder: Path) -> Path:
    """Return the path of `hero.png` in the folder: held-out prediction, missing force with its law, and ranking."""
    evidence = read_evidence(folder)
    with style.applied():
        return style.save(draw(evidence), folder / "hero.png")


def draw(evidence: Evidence) -> Figure:
    """Return the three panels side by side; one whose arrays are absent stays out."""
    panels = _panels(evidence)
    figure = style.blank(3.5, width=4.8 * max(1, len(panels)))
    for axes, panel in zip(figure.subplots(1, max(1, len(panels)), squeeze=False)[0], panels, strict=False):
        panel(axes, evidence)
    return figure


def _panels(evidence: Evidence) -> list[Panel]:
    able = (
        (_draw_prediction, evidence.has("time", "response")),
        (_draw_force, bool(missing.curve_of(evidence, "before_mean", "velocity").size)),
        (_draw_ranking, bool(evidence.fact("ranking"))),
    )
    return [panel for panel, can in able if can]


def _draw_prediction(axes: Axes, evidence: Evidence) -> None:
    prediction.draw_window(axes, evidence, prediction.window_of(evidence))
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.16 * (high - low))
    axes.legend(loc="upper center", ncols=3, fontsize=8, handlelength=1.4, columnspacing=1.2)
    axes.set_title("Held-out data, predicted free-running")


def _draw_force(axes: Axes, evidence: Evidence) -> None:
    missing.draw_curve(axes, evidence, "velocity")
    axes.legend(loc="best", fontsize=8)
    axes.set_title("The force that was missing", color="black")


def _draw_ranking(axes: Axes, evidence: Evidence) -> None:
    ranking.draw_bars(axes, evidence, ranking.ranked(evidence, CANDIDATES))
    axes.set_title("Which physics it is")
    axes.set_xlabel("log evidence gain")
