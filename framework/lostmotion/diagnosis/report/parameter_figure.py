"""Figure and table of the parameters before and after, with known values where there are any."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.diagnosis.report.versions import list_versions
from lostmotion.report import style
from lostmotion.report.pages import Grid, trim_table
from lostmotion.report.words import DASH, Scale, choose_scale, figures, format_unit, with_unit, words_of
from lostmotion.report.words import interval as in_words
from lostmotion.results import Array, Interval

MAX_BINS = 45
DIMENSION_NAMES = {"before": "parameter", "after": "parameter_after"}
PANELS_PER_ROW = 3


def draw(evidence: Evidence) -> Figure | None:
    """Return one panel of densities for each parameter, or None without posterior samples."""
    names = [
        name
        for name in list_parameters(evidence)
        if any(get_samples(evidence, version.key, name).size for version in list_versions(evidence))
    ]
    if not names:
        return None
    across = min(PANELS_PER_ROW, len(names))
    rows = -(-len(names) // across)
    figure = style.make_figure(2.1 * rows + 0.35)
    panels = figure.subplots(rows, across, squeeze=False)
    for axes, name in zip(panels.flat, names, strict=False):
        draw_density(axes, evidence, name)
    for axes in panels.flat[len(names) :]:
        axes.remove()
    _add_legend(figure, evidence)
    return figure


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure."""
    known = " The dashed line is the known value." if evidence.result.truth else ""
    both = (
        " A parameter that changes had compensated for missing physics; its interval before is then narrow and wrong."
        if evidence.augmented and evidence.has("posterior_after")
        else ""
    )
    return "Posterior densities, each scaled to its own peak; the bars below are central 95 % intervals." + known + both


def list_parameters(evidence: Evidence) -> list[str]:
    """Return the names of all parameters, those of the nominal model first."""
    keys = [version.key for version in list_versions(evidence)]
    sets = evidence.result.parameters
    listed = [name for version in list_versions(evidence) for name in version.select(sets.before, sets.after)]
    drawn = [name for key in keys for name in evidence.labels.get(DIMENSION_NAMES[key], ())]
    return list(dict.fromkeys(listed + drawn))


def get_samples(evidence: Evidence, when: str, name: str) -> Array:
    """Return the finite posterior samples of a parameter; empty where there are none."""
    names = evidence.labels.get(DIMENSION_NAMES[when], ())
    if name not in names or not evidence.has(f"posterior_{when}"):
        return np.array([])
    column = evidence.arrays[f"posterior_{when}"][:, names.index(name)]
    return column[np.isfinite(column)]


def draw_density(axes: Axes, evidence: Evidence, name: str) -> None:
    """Draw the densities of one parameter before and after, their intervals, and the known value."""
    drawn = [(version, get_samples(evidence, version.key, name)) for version in list_versions(evidence)]
    last, truth, sets = get_last_interval(evidence, name), evidence.truth(name), evidence.result.parameters
    scale = style.scale_of(np.concatenate([values for _, values in drawn]), last.unit if last else "")
    for row, (version, values) in enumerate(drawn):
        if values.size:
            _draw_histogram(axes, scale.factor * values, version.colour)
            look = version.colour, -0.1 - 0.12 * row
            _draw_interval(axes, version.select(sets.before, sets.after).get(name), scale, look)
    if np.isfinite(truth):
        axes.axvline(scale.factor * truth, color=style.RECORDED, linestyle=(0, (4, 2)), linewidth=1.3)
    style.few_ticks(axes, 4)
    axes.set_ylim(-0.32, 1.08)
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.set_xlabel(with_unit(words_of(name), scale.unit))


def _draw_histogram(axes: Axes, values: Array, colour: str) -> None:
    if np.ptp(values) < 1e-9 * np.abs(values).max():  # a parameter at its bound
        axes.axvline(float(values[0]), color=colour, linewidth=1.2)
        return
    counts, edges = np.histogram(values, bins=min(MAX_BINS, 8 + values.size // 40))
    axes.stairs(counts / counts.max(), edges, fill=True, color=colour, alpha=0.3)
    axes.stairs(counts / counts.max(), edges, color=colour, linewidth=1.2)


def _draw_interval(axes: Axes, interval: Interval | None, scale: Scale, look: tuple[str, float]) -> None:
    if interval is None or interval.withheld:
        return
    colour, height = look
    low, median, high = (scale.factor * end for end in (interval.low, interval.median, interval.high))
    axes.plot([low, high], [height, height], color=colour, linewidth=2.2, solid_capstyle="butt")
    axes.plot([median], [height], "o", color=colour, markersize=4.5)


def _add_legend(figure: Figure, evidence: Evidence) -> None:
    axes = figure.axes[0]
    for version in list_versions(evidence):
        if evidence.has(f"posterior_{version.key}"):
            axes.plot([], [], color=version.colour, linewidth=5, alpha=0.6, label=version.make_label("posterior"))
    if evidence.result.truth:
        axes.plot([], [], color=style.RECORDED, linestyle=(0, (4, 2)), label="known value")
    style.legend_above(figure, axes)


def get_last_interval(evidence: Evidence, name: str) -> Interval | None:
    """Return the interval of a parameter in the last version of the model that has it."""
    sets = evidence.result.parameters
    intervals = [version.select(sets.before, sets.after).get(name) for version in list_versions(evidence)]
    return next((one for one in reversed(intervals) if one), None)


def make_table(evidence: Evidence) -> Grid:
    """Return each parameter before and after, its known value, and whether the last interval contains it."""
    first = "Before" if evidence.augmented else "Median [95 %]"
    head = ["Parameter", first, "After", "Known value", "In the last interval"]
    rows = [
        _make_row(evidence, name, last)
        for name in list_parameters(evidence)
        if (last := get_last_interval(evidence, name))
    ]
    return trim_table(head, rows if evidence.augmented else [[*row[:2], DASH, *row[3:]] for row in rows])


def _make_row(evidence: Evidence, name: str, last: Interval) -> list[str]:
    scale, truth, sets = choose_scale(last.median, last.unit), evidence.truth(name), evidence.result.parameters
    row = [words_of(name), *(in_words(one.get(name), scale) for one in (sets.before, sets.after))]
    if not np.isfinite(truth):
        return [*row, DASH, DASH]
    known = f"{figures(scale.factor * truth, 4)} {format_unit(scale.unit)}".rstrip()
    if last.withheld:
        return [*row, known, DASH]
    return [*row, known, "inside" if truth in last else "outside"]
