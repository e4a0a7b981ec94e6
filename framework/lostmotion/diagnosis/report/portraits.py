"""Figure of phase portraits and Poincaré sections of recording, nominal model and augmented model, on common axes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.diagnosis.report.versions import list_versions
from lostmotion.report import style
from lostmotion.report.words import Scale, figures, sentence, with_unit
from lostmotion.results import Array

KINDS = ("portrait", "section")


class Frame(NamedTuple):
    """Scales and limits common to all panels of a kind."""

    position: Scale
    velocity: Scale
    across: tuple[float, float]
    up: tuple[float, float]


def draw(evidence: Evidence) -> Figure | None:
    """Return portraits above sections, one column each for recording, before and after, or None without any."""
    kinds = [kind for kind in KINDS if _list_columns(evidence, kind)]
    if not kinds:
        return None
    columns = [
        version for version in _list_models(evidence) if any(version in _list_columns(evidence, kind) for kind in kinds)
    ]
    figure = style.make_figure(2.75 * len(kinds) + 0.2)
    panels = figure.subplots(len(kinds), len(columns), squeeze=False, sharey="row", sharex="row")
    for row, kind in zip(panels, kinds, strict=True):
        frame = make_frame(evidence, kind)
        for axes, version in zip(row, columns, strict=True):
            draw_panel(axes, evidence, (kind, version), frame)
        row[0].set_ylabel(with_unit("velocity", frame.velocity.unit))
    return figure


def make_title(evidence: Evidence) -> str:
    """Return the heading; without a drive period there are no sections."""
    return "Phase portrait and Poincaré section" if _list_columns(evidence, "section") else "Phase portrait"


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure."""
    parts = []
    if evidence.has("portrait_recorded_x"):
        parts.append("phase portraits")
    if evidence.has("section_recorded_x"):
        parts.append("Poincaré sections, one point for each drive period (pale dots: the recording)")
    opening = sentence(" and ".join(parts))
    if evidence.result.drive.free:
        return (
            f"{opening}. All panels have the same axes. A model with the correct physics follows the same spiral as the"
            " recording, and comes to rest at the same position."
        )
    return opening + (
        ". All panels of a row have the same axes. A model with the correct physics fills the same region with the "
        "same structure; for chaotic motion the orbits themselves do not agree point by point."
    )


def draw_panel(axes: Axes, evidence: Evidence, what: tuple[str, tuple[str, str, str]], frame: Frame) -> None:
    """Draw one orbit or section in the common frame."""
    kind, (key, words, colour) = what
    axes.set_xlim(frame.across)
    axes.set_ylim(frame.up)
    axes.set_title(words if kind == "portrait" else f"{words}: section{_format_distance(evidence, key)}", color=colour)
    axes.set_xlabel(with_unit("position", frame.position.unit))
    style.few_ticks(axes, 4, 5)
    if kind == "portrait":
        axes.plot(*_get_scaled(evidence, (kind, key), frame), color=colour, linewidth=0.55)
        return
    if key != "recorded":
        axes.plot(
            *_get_scaled(evidence, (kind, "recorded"), frame), ".", color="#bdbdbd", markersize=4, markeredgewidth=0
        )
    axes.plot(*_get_scaled(evidence, (kind, key), frame), ".", color=colour, markersize=5, markeredgewidth=0)


def _format_distance(evidence: Evidence, key: str) -> str:
    """Return the distance of a model's section from the recorded one, or between the halves of the recorded one."""
    show = evidence.result.show
    column = show.noise_floor if key == "recorded" else show.before if key == "before" else show.after
    value = column.attractor_distance.value if column else np.nan
    return "" if np.isnan(value) else f", {'halves ' if key == 'recorded' else ''}{figures(value, 2)} apart"


def make_frame(evidence: Evidence, kind: str) -> Frame:
    """Return a frame that contains the recording and the models, unless a model diverges."""
    keys = [key for key, _, _ in _list_columns(evidence, kind)]
    x, v = ([evidence.arrays[f"{kind}_{key}_{axis}"] for key in keys] for axis in "xv")
    position = style.scale_of(np.concatenate(x), evidence.result.units.position)
    velocity = style.scale_of(np.concatenate(v), evidence.result.units.velocity)
    return Frame(position, velocity, _find_limits(position.factor, x), _find_limits(velocity.factor, v))


def _find_limits(factor: float, values: list[Array]) -> tuple[float, float]:
    return style.limits_around(factor * values[0], [factor * other for other in values[1:]], 0.5)


def _list_models(evidence: Evidence) -> list[tuple[str, str, str]]:
    models = [(version.key, version.make_label("model"), version.colour) for version in list_versions(evidence)]
    return [("recorded", "recording", style.RECORDED), *models]


def _list_columns(evidence: Evidence, kind: str) -> list[tuple[str, str, str]]:
    return [
        version
        for version in _list_models(evidence)
        if evidence.has(f"{kind}_{version[0]}_x", f"{kind}_{version[0]}_v")
    ]


def _get_scaled(evidence: Evidence, what: tuple[str, str], frame: Frame) -> tuple[Array, Array]:
    if not evidence.has(*(f"{what[0]}_{what[1]}_{axis}" for axis in "xv")):
        return np.array([]), np.array([])
    x, v = (evidence.arrays[f"{what[0]}_{what[1]}_{axis}"] for axis in "xv")
    return frame.position.factor * x, frame.velocity.factor * v
