"""Figure: phase portrait and Poincaré section of recording, baseline and augmented model, on the same axes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.cast import versions
from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style
from lostmotion.report.words import Scale, figures, sentence, with_unit
from lostmotion.results import Array

KINDS = ("portrait", "section")


class Frame(NamedTuple):
    """Scales and limits that all panels of a kind share."""

    position: Scale
    velocity: Scale
    across: tuple[float, float]
    up: tuple[float, float]


def draw(evidence: Evidence) -> Figure | None:
    """Return portraits above sections, one column each for recording, before and after, or None without any."""
    kinds = [kind for kind in KINDS if _columns(evidence, kind)]
    if not kinds:
        return None
    columns = [who for who in _who(evidence) if any(who in _columns(evidence, kind) for kind in kinds)]
    figure = style.blank(2.75 * len(kinds) + 0.2)
    panels = figure.subplots(len(kinds), len(columns), squeeze=False, sharey="row", sharex="row")
    for row, kind in zip(panels, kinds, strict=True):
        frame = frame_of(evidence, kind)
        for axes, who in zip(row, columns, strict=True):
            draw_panel(axes, evidence, (kind, who), frame)
        row[0].set_ylabel(with_unit("velocity", frame.velocity.unit))
    return figure


def title(evidence: Evidence) -> str:
    """Return the heading: without a drive period there are no sections."""
    return "Phase portrait and Poincaré section" if _columns(evidence, "section") else "Phase portrait"


def caption(evidence: Evidence) -> str:
    """Return what to see in the figure."""
    parts = []
    if evidence.has("portrait_recorded_x"):
        parts.append("phase portraits")
    if evidence.has("section_recorded_x"):
        parts.append("Poincaré sections, one point for each drive period (pale dots: the recording)")
    opening = sentence(" and ".join(parts))
    if evidence.result.drive.free:
        return (
            f"{opening}. All panels share their axes. A model with the right physics winds inwards along the same turns"
            " as the recording, and comes to rest at the same place."
        )
    return opening + (
        ". All panels of a row share their axes. A model with the right physics fills the same region with the same "
        "folds; in chaos the orbits themselves need not agree point by point."
    )


def draw_panel(axes: Axes, evidence: Evidence, what: tuple[str, tuple[str, str, str]], frame: Frame) -> None:
    """Draw one orbit or section in the frame it shares with its neighbours."""
    kind, (key, words, colour) = what
    axes.set_xlim(frame.across)
    axes.set_ylim(frame.up)
    axes.set_title(words if kind == "portrait" else f"{words}: section{_distance(evidence, key)}", color=colour)
    axes.set_xlabel(with_unit("position", frame.position.unit))
    style.few_ticks(axes, 4, 5)
    if kind == "portrait":
        axes.plot(*_scaled(evidence, (kind, key), frame), color=colour, linewidth=0.55)
        return
    if key != "recorded":
        axes.plot(*_scaled(evidence, (kind, "recorded"), frame), ".", color="#bdbdbd", markersize=4, markeredgewidth=0)
    axes.plot(*_scaled(evidence, (kind, key), frame), ".", color=colour, markersize=5, markeredgewidth=0)


def _distance(evidence: Evidence, key: str) -> str:
    """Return how far the section of a model lies from the recorded one, or of that one's halves from each other."""
    show = evidence.result.show
    column = show.noise_floor if key == "recorded" else show.before if key == "before" else show.after
    value = column.attractor_distance.value if column else np.nan
    return "" if np.isnan(value) else f", {'halves ' if key == 'recorded' else ''}{figures(value, 2)} apart"


def frame_of(evidence: Evidence, kind: str) -> Frame:
    """Return the frame that holds the recording and the models, unless a model runs away."""
    keys = [key for key, _, _ in _columns(evidence, kind)]
    x, v = ([evidence.arrays[f"{kind}_{key}_{axis}"] for key in keys] for axis in "xv")
    position = style.scale_of(np.concatenate(x), evidence.result.units.position)
    velocity = style.scale_of(np.concatenate(v), evidence.result.units.velocity)
    return Frame(position, velocity, _limits(position.factor, x), _limits(velocity.factor, v))


def _limits(factor: float, values: list[Array]) -> tuple[float, float]:
    return style.framed(factor * values[0], [factor * other for other in values[1:]], 0.5)


def _who(evidence: Evidence) -> list[tuple[str, str, str]]:
    models = [(who.key, who.named("model"), who.colour) for who in versions(evidence)]
    return [("recorded", "recording", style.RECORDED), *models]


def _columns(evidence: Evidence, kind: str) -> list[tuple[str, str, str]]:
    return [who for who in _who(evidence) if evidence.has(f"{kind}_{who[0]}_x", f"{kind}_{who[0]}_v")]


def _scaled(evidence: Evidence, what: tuple[str, str], frame: Frame) -> tuple[Array, Array]:
    if not evidence.has(*(f"{what[0]}_{what[1]}_{axis}" for axis in "xv")):
        return np.array([]), np.array([])
    x, v = (evidence.arrays[f"{what[0]}_{what[1]}_{axis}"] for axis in "xv")
    return frame.position.factor * x, frame.velocity.factor * v
