"""The summary figure of a diagnosis, for a README or a talk."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec

from lostmotion.diagnosis.report import missing, prediction, ranking
from lostmotion.diagnosis.report.page_data import Evidence, read_evidence
from lostmotion.report import style

CANDIDATES_SHOWN = 7
Place = tuple[GridSpec, int]
Panel = Callable[[Figure, Evidence, Place], None]


def save_hero(folder: Path) -> Path:
    """Write `hero.png` into the folder (held-out prediction, missing force, ranking) and return its path."""
    evidence = read_evidence(folder)
    with style.use_style(evidence.result.units.angle):
        return style.save(draw(evidence), folder / "hero.png")


def draw(evidence: Evidence) -> Figure:
    """Return the three panels side by side; a panel whose arrays are absent is left out."""
    panels = _list_panels(evidence)
    figure = style.make_figure(3.7, width=4.8 * max(1, len(panels)))
    grid = figure.add_gridspec(2, max(1, len(panels)), height_ratios=[2.2, 1])
    for column, panel in enumerate(panels):
        panel(figure, evidence, (grid, column))
    return figure


def _list_panels(evidence: Evidence) -> list[Panel]:
    able = (
        (_draw_prediction, prediction.has_prediction(evidence)),
        (_draw_force, bool(missing.get_curve(evidence, "before_mean", "velocity").size)),
        (_draw_ranking, bool(evidence.result.ranking)),
    )
    return [panel for panel, can in able if can]


def _draw_prediction(figure: Figure, evidence: Evidence, place: Place) -> None:
    grid, column = place
    below = figure.add_subplot(grid[1, column])
    axes = figure.add_subplot(grid[0, column], sharex=below)
    window = prediction.choose_window(evidence)
    prediction.draw_window(axes, evidence, window)
    prediction.draw_error(below, evidence, window)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.2 * (high - low))
    axes.tick_params(labelbottom=False)
    axes.set_xlabel("")
    axes.legend(loc="upper center", ncols=3, fontsize=8, handlelength=1.4, columnspacing=1.2)
    axes.set_title("Held-out data, predicted free-running")


def _draw_force(figure: Figure, evidence: Evidence, place: Place) -> None:
    axes = figure.add_subplot(place[0][:, place[1]])
    shares = evidence.result.where.explained_by
    names = [n for n in evidence.labels.get("covariate", ()) if n.startswith("velocity")]
    missing.draw_curve(axes, evidence, max(names, key=lambda n: shares.get(n, 0.0)))
    axes.legend(loc="best", fontsize=8)
    axes.set_title("Missing force" if evidence.augmented else "No force is missing", color="black")


def _draw_ranking(figure: Figure, evidence: Evidence, place: Place) -> None:
    axes = figure.add_subplot(place[0][:, place[1]])
    ranking.draw_bars(axes, evidence, ranking.rank_candidates(evidence, CANDIDATES_SHOWN))
    axes.set_title("Ranking of the candidates" if evidence.augmented else "Tested candidates")
    axes.set_xlabel("log evidence gain")
