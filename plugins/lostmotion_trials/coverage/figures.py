"""Figures of a calibration: rank histograms, ECDF differences in their band, and where intervals miss the truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from lostmotion.report import style
from lostmotion.report.words import choose_scale, with_unit
from lostmotion.results import Array
from lostmotion_trials.coverage.results import BarBand, CurveBand, ParameterCheck

PANELS_ACROSS = 3
"""Panels in a row of a figure."""
DECADE = 4.0
"""Ratio of largest to smallest truth from which the axis is logarithmic."""
FRAME_SDS = 5.0
"""Standard deviations beyond which an interval is drawn at the rim."""
CAPTIONS = {
    "ranks": (
        "Ranks of the true value among 99 draws of its posterior. A correct posterior gives equal bars; one that is too"
        " narrow gives a U shape, one that is too wide a hump, a biased one a slope. Shaded: the band that a single bar"
        " leaves with probability 1 %."
    ),
    "ecdf": (
        "Share of ranks below each value, minus the expected share. With a correct posterior the curve leaves the"
        " shaded band somewhere in one of a hundred campaigns (Säilynoja, Bürkner, Vehtari 2022)."
    ),
    "intervals": (
        "Central 95 % intervals minus the truth, in standard deviations of each posterior, over the true value."
        " Intervals that miss the truth are coloured; one in twenty is expected. Triangles mark machines beyond the"
        " frame."
    ),
}


class Found(NamedTuple):
    """A parameter in words, what is said of it, and its columns (machines,): truth, low, median, high, sd."""

    words: str
    row: ParameterCheck
    columns: Mapping[str, Array]


def _make_panels(found: Sequence[Found], height: float, across: int = PANELS_ACROSS) -> tuple[Figure, list[Axes]]:
    """Return a figure with a panel for each parameter, titled with its name."""
    wide = min(across, len(found))
    rows = -(-len(found) // wide)
    figure = style.make_figure(height * rows + 0.2)
    panels = list(figure.subplots(rows, wide, squeeze=False).flat)
    for axes in panels[len(found) :]:
        axes.remove()
    for axes, one in zip(panels, found, strict=False):
        axes.set_title(one.words)
    return figure, panels[: len(found)]


def draw_histograms(found: Sequence[Found], band: BarBand) -> Figure:
    """Return one histogram of ranks for each parameter, with the band of a single bar."""
    figure, panels = _make_panels(found, 2.2)
    for axes, one in zip(panels, found, strict=True):
        counts = np.array(one.row.histogram)
        edges = np.linspace(0.0, 100.0, len(counts) + 1)
        axes.axhspan(band.low, band.high, color=style.SHADE, zorder=0)
        axes.axhline(band.expected, color="#555555", linewidth=0.8, linestyle=(0, (3, 2)))
        axes.stairs(counts, edges, fill=True, color=style.AFTER, alpha=0.25)
        for end in (band.low, band.high):
            axes.axhline(end, color=style.QUIET, linewidth=0.7)
        axes.stairs(counts, edges, color=style.AFTER, linewidth=1.1)
        axes.set_xlim(0, 100)
        axes.set_ylim(0, 1.08 * max(counts.max(), band.high))
        style.few_ticks(axes, 5, 4)
        axes.yaxis.set_major_locator(MaxNLocator(4, integer=True))
        axes.set_xlabel("rank of the truth")
    panels[0].set_ylabel("machines")
    return figure


def draw_ecdf(found: Sequence[Found], band: CurveBand) -> Figure:
    """Return the differences of the empirical distribution functions of ranks to the uniform one, in their band."""
    figure, panels = _make_panels(found, 2.4)
    at, middle, low, high = map(np.array, (band.at, band.middle, band.low, band.high))
    for axes, one in zip(panels, found, strict=True):
        machines = sum(one.row.histogram)
        curves = [_close_curve(x, middle, machines) for x in (low, high, np.array(one.row.ecdf))]
        places = np.concatenate([[0.0], at, [1.0]])
        axes.fill_between(places, curves[0], curves[1], color=style.SHADE, zorder=0, step="mid")
        axes.axhline(0.0, color="#555555", linewidth=0.8, linestyle=(0, (3, 2)))
        axes.step(places, curves[2], where="mid", color=style.AFTER, linewidth=1.4)
        axes.set_xlim(0.0, 1.0)
        style.few_ticks(axes, 5, 5)
        axes.set_xlabel("rank / 100")
    panels[0].set_ylabel("difference to uniform")
    return figure


def _close_curve(counts: Array, middle: Array, machines: int) -> Array:
    """Return counts as shares less what is expected, with nothing at both ends."""
    return np.concatenate([[0.0], (counts - middle) / machines, [0.0]])


def draw_intervals(found: Sequence[Found]) -> Figure:
    """Return one panel for each parameter: its intervals about the truth, over the true values."""
    figure, panels = _make_panels(found, 2.5)
    for axes, one in zip(panels, found, strict=True):
        _draw_intervals(axes, one)
    panels[0].set_ylabel("(interval − truth) / sd")
    return figure


def _draw_intervals(axes: Axes, one: Found) -> None:
    kept = np.isfinite(one.columns["median"])
    truth, low, median, high, sd = (one.columns[k][kept] for k in ("truth", "low", "median", "high", "sd"))
    scale = choose_scale(float(np.median(np.abs(truth))), one.row.unit)
    down, middle, up = ((x - truth) / sd for x in (low, median, high))
    missed = (down > 0.0) | (up < 0.0)
    place = scale.factor * truth if np.ptp(truth) else np.arange(len(truth), dtype=float)
    for chosen, colour in ((~missed, style.AFTER), (missed, style.BEFORE)):
        axes.vlines(place[chosen], down[chosen], up[chosen], color=colour, linewidth=0.9, alpha=0.7)
        axes.plot(place[chosen], middle[chosen], "o", color=colour, markersize=2.4)
    axes.axhline(0.0, color="#555555", linewidth=0.8)
    _draw_beyond(axes, place, middle)
    axes.set_ylim(-FRAME_SDS - 0.6, FRAME_SDS + 0.6)
    if np.ptp(truth) and truth.min() > 0.0 and truth.max() > DECADE * truth.min():
        axes.set_xscale("log")
        style.log_ticks(axes.xaxis)
    else:
        style.few_ticks(axes, 5, 5)
    axes.set_xlabel(with_unit("true value", scale.unit) if np.ptp(truth) else "machine")


def _draw_beyond(axes: Axes, place: Array, middle: Array) -> None:
    """Mark the machines whose posterior lies beyond the frame by a triangle at its rim."""
    for side, marker in ((1.0, "^"), (-1.0, "v")):
        beyond = side * middle > FRAME_SDS
        axes.plot(
            place[beyond],
            np.full(int(beyond.sum()), side * (FRAME_SDS + 0.3)),
            marker,
            color=style.BEFORE,
            markersize=4,
        )
