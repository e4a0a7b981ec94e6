"""Figure of dry friction that changes during a recording: its level over the time."""

from __future__ import annotations

from matplotlib.figure import Figure

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report import style
from lostmotion.report.words import with_unit


def draw(evidence: Evidence) -> Figure | None:
    """Return the figure of the level over the time, or None where no changing friction was found."""
    if not evidence.has("friction_level"):
        return None
    arrays = evidence.arrays
    scale = style.scale_of(arrays["friction_level"], evidence.units["friction_level"])
    figure = style.make_figure(2.8)
    axes = figure.subplots()
    time = arrays["level_time"]
    low, high = (scale.factor * arrays[f"friction_level_{end}"] for end in ("low", "high"))
    axes.fill_between(time, low, high, color=style.LAW, alpha=0.25, linewidth=0.0, label="95 % band")
    axes.plot(time, scale.factor * arrays["friction_level"], color=style.LAW, linewidth=1.8, label="dry friction")
    axes.set_xlim(float(time[0]), float(time[-1]))
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel("time (s)")
    axes.set_ylabel(with_unit("friction", scale.unit))
    style.legend_above(figure, axes)
    return figure


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure."""
    return (
        "Level of the dry friction during the recording, as the found term gives it, with its 95 % band. Where the"
        " change is complete before the end of the fitted part, the level is constant from there on."
    )
