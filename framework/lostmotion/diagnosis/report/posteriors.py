"""Figure and table: the parameters before and after, beside the known values where there are any."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.cast import versions
from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style
from lostmotion.report.pages import Grid, trimmed
from lostmotion.report.words import DASH, Scale, figures, pretty, readable, with_unit, words_of
from lostmotion.report.words import interval as in_words
from lostmotion.results import Array, Interval

BINS = 45
DIMENSION = {"before": "parameter", "after": "parameter_after"}
MOST_ACROSS = 3


def draw(evidence: Evidence) -> Figure | None:
    """Return one panel of densities for each parameter, or None without posterior samples."""
    names = [
        name
        for name in parameters(evidence)
        if any(samples(evidence, who.key, name).size for who in versions(evidence))
    ]
    if not names:
        return None
    across = min(MOST_ACROSS, len(names))
    rows = -(-len(names) // across)
    figure = style.blank(2.1 * rows + 0.35)
    panels = figure.subplots(rows, across, squeeze=False)
    for axes, name in zip(panels.flat, names, strict=False):
        draw_density(axes, evidence, name)
    for axes in panels.flat[len(names) :]:
        axes.remove()
    _add_legend(figure, evidence)
    return figure


def caption(evidence: Evidence) -> str:
    """Return what to see in the figure."""
    known = " The dashed line is the known value." if evidence.result.truth else ""
    both = (
        " A parameter that moves had stood in for what was left out; its interval before is then narrow and wrong."
        if evidence.augmented and evidence.has("posterior_after")
        else ""
    )
    return "Posterior densities, each scaled to its own peak; the bars below are central 95 % intervals." + known + both


def parameters(evidence: Evidence) -> list[str]:
    """Return all names of parameters, those of the model as it stands first."""
    keys = [who.key for who in versions(evidence)]
    sets = evidence.result.parameters
    listed = [name for who in versions(evidence) for name in who.of(sets.before, sets.after)]
    drawn = [name for key in keys for name in evidence.labels.get(DIMENSION[key], ())]
    return list(dict.fromkeys(listed + drawn))


def samples(evidence: Evidence, when: str, name: str) -> Array:
    """Return the finite posterior samples of a parameter; empty where there are none."""
    names = evidence.labels.get(DIMENSION[when], ())
    if name not in names or not evidence.has(f"posterior_{when}"):
        return np.array([])
    column = evidence.arrays[f"posterior_{when}"][:, names.index(name)]
    return column[np.isfinite(column)]


def draw_density(axes: Axes, evidence: Evidence, name: str) -> None:
    """Draw the densities of one parameter before and after, their intervals, and the known value."""
    drawn = [(who, samples(evidence, who.key, name)) for who in versions(evidence)]
    last, truth, sets = last_of(evidence, name), evidence.truth(name), evidence.result.parameters
    scale = style.scale_of(np.concatenate([values for _, values in drawn]), last.unit if last else "")
    for row, (who, values) in enumerate(drawn):
        if values.size:
            _draw_histogram(axes, scale.factor * values, who.colour)
            look = who.colour, -0.1 - 0.12 * row
            _draw_interval(axes, who.of(sets.before, sets.after).get(name), scale, look)
    if np.isfinite(truth):
        axes.axvline(scale.factor * truth, color=style.RECORDED, linestyle=(0, (4, 2)), linewidth=1.3)
    style.few_ticks(axes, 4)
    axes.set_ylim(-0.32, 1.08)
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.set_xlabel(with_unit(words_of(name), scale.unit))


def _draw_histogram(axes: Axes, values: Array, colour: str) -> None:
    if np.ptp(values) < 1e-9 * np.abs(values).max():  # a parameter that presses against its bound
        axes.axvline(float(values[0]), color=colour, linewidth=1.2)
        return
    counts, edges = np.histogram(values, bins=min(BINS, 8 + values.size // 40))
    axes.stairs(counts / counts.max(), edges, fill=True, color=colour, alpha=0.3)
    axes.stairs(counts / counts.max(), edges, color=colour, linewidth=1.2)


def _draw_interval(axes: Axes, told: Interval | None, scale: Scale, look: tuple[str, float]) -> None:
    if told is None or told.withheld:
        return
    colour, height = look
    low, median, high = (scale.factor * end for end in (told.low, told.median, told.high))
    axes.plot([low, high], [height, height], color=colour, linewidth=2.2, solid_capstyle="butt")
    axes.plot([median], [height], "o", color=colour, markersize=4.5)


def _add_legend(figure: Figure, evidence: Evidence) -> None:
    axes = figure.axes[0]
    for who in versions(evidence):
        if evidence.has(f"posterior_{who.key}"):
            axes.plot([], [], color=who.colour, linewidth=5, alpha=0.6, label=who.named("posterior"))
    if evidence.result.truth:
        axes.plot([], [], color=style.RECORDED, linestyle=(0, (4, 2)), label="known value")
    style.legend_above(figure, axes)


def last_of(evidence: Evidence, name: str) -> Interval | None:
    """Return the interval of a parameter in the last version of the model that has it."""
    sets = evidence.result.parameters
    told = [who.of(sets.before, sets.after).get(name) for who in versions(evidence)]
    return next((one for one in reversed(told) if one), None)


def table(evidence: Evidence) -> Grid:
    """Return each parameter before and after, its known value, and whether the last interval holds it."""
    first = "Before" if evidence.augmented else "Median [95 %]"
    head = ["Parameter", first, "After", "Known value", "In the last interval"]
    rows = [_row(evidence, name, last) for name in parameters(evidence) if (last := last_of(evidence, name))]
    return trimmed(head, rows if evidence.augmented else [[*row[:2], DASH, *row[3:]] for row in rows])


def _row(evidence: Evidence, name: str, last: Interval) -> list[str]:
    scale, truth, sets = readable(last.median, last.unit), evidence.truth(name), evidence.result.parameters
    row = [words_of(name), *(in_words(told.get(name), scale) for told in (sets.before, sets.after))]
    if not np.isfinite(truth):
        return [*row, DASH, DASH]
    known = f"{figures(scale.factor * truth, 4)} {pretty(scale.unit)}".rstrip()
    if last.withheld:
        return [*row, known, DASH]
    return [*row, known, "inside" if truth in last else "outside"]
