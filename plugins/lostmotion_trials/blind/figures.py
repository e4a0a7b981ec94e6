"""Figures of a blind trial: detection against effect size, stated probabilities, and held-out errors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from lostmotion.contracts import Array
from lostmotion.report import style
from lostmotion_trials.blind.results import ProofSummary, SizeBin
from lostmotion_trials.rates import Rate

EDGE = "#555555"
SMALLEST, LARGEST, WIDE = 0.5, 2000.0, 1.5
"""Gains beyond these are drawn at the edge; errors beyond this ratio need a logarithmic axis."""
CAPTIONS = {
    "detection": (
        "Share of hidden effects that were named, over the gain in log-likelihood of their true terms, with exact 95 %"
        " bands. Small marks: single effects, named above and not named below. Lines: the likelihood-ratio test at 2 %"
        " false alarms for the true effect (dashed), and for one of as many candidates (dotted); no test is more"
        " powerful than the first. Open squares: the targets."
    ),
    "reliability": (
        "Share of mechanisms that were present, over the probability that the diagnosis stated for them, with exact 95"
        " % bands. Correct probabilities lie on the line."
    ),
    "heldout": (
        "Errors of the found model on held-out data, divided by those of the true model in the same free runs. Shaded:"
        " within 5 %."
    ),
}


def draw_detection(summary: ProofSummary) -> Figure:
    """Return the share of effects that were named, over their size, with the limit of the likelihood-ratio test."""
    figure = style.make_figure(3.6)
    axes = figure.subplots()
    limit = summary.limit
    axes.plot(limit.gain, limit.informed, color=EDGE, linestyle=(0, (5, 3)), label="likelihood-ratio limit")
    many = f"the same, one of {limit.candidates} candidates"
    axes.plot(limit.gain, limit.one_of_many, color=EDGE, linestyle=(0, (1, 2)), label=many)
    bins = [row for row in summary.detection if row.counts.rate.of]
    centres = np.array([_find_centre(row, summary.sizes) for row in bins])
    _draw_banded(axes, centres, [row.counts.rate for row in bins])
    sizes = np.clip(np.array(summary.sizes, dtype=float).reshape(-1, 2), SMALLEST, None)
    hit = np.array([named for _, named in summary.sizes], dtype=bool)
    for chosen, at, colour in ((hit, 1.06, style.AFTER), (~hit, -0.06, style.BEFORE)):
        axes.plot(np.minimum(sizes[chosen, 0], LARGEST), np.full(int(chosen.sum()), at), "|", color=colour, alpha=0.7)
    axes.plot([27.0, 150.0], [0.80, 0.95], "s", color=EDGE, markerfacecolor="none", markersize=7, label="targets")
    axes.set_xscale("log")
    axes.set_xlim(0.8 * SMALLEST, 1.2 * LARGEST)
    axes.set_ylim(-0.12, 1.12)
    style.log_ticks(axes.xaxis)
    axes.set_xlabel("gain of the true terms in log-likelihood")
    axes.set_ylabel("share named")
    style.legend_above(figure, axes)
    return figure


def _find_centre(row: SizeBin, sizes: Sequence[tuple[float, float]]) -> float:
    """Return the middle of the gains in a bin, on a logarithmic axis."""
    own = [max(gain, SMALLEST) for gain, _ in sizes if row.low <= gain and not gain >= row.high]
    return float(np.clip(np.exp(np.mean(np.log(own))), SMALLEST, LARGEST))


def _draw_banded(axes: Axes, places: Array, rows: Sequence[Rate]) -> None:
    """Draw shares with their bands."""
    share, low, high = np.array([(row.share, row.low, row.high) for row in rows]).reshape(-1, 3).T
    axes.vlines(places, low, high, color=style.AFTER, linewidth=5, alpha=0.25)
    axes.plot(places, share, "o", color=style.AFTER, label="named, with 95 % band")
    for x, y, row in zip(places, share, rows, strict=True):
        axes.annotate(f"{row.hits}/{row.of}", (x, y), (6, -3), textcoords="offset points", fontsize=8)


def draw_reliability(summary: ProofSummary) -> Figure:
    """Return the share of mechanisms that were present, over the probability that was stated."""
    figure = style.make_figure(3.6)
    axes = figure.subplots()
    rows = [row for row in summary.reliability if row.rate.of]
    axes.plot([0.0, 1.0], [0.0, 1.0], color=EDGE, linewidth=0.8, linestyle=(0, (3, 2)))
    _draw_banded(axes, np.array([row.stated for row in rows]), [row.rate for row in rows])
    axes.set_xlim(-0.04, 1.12)
    axes.set_ylim(-0.04, 1.04)
    axes.set_xlabel("stated probability")
    axes.set_ylabel("share present")
    return figure


def draw_heldout(summary: ProofSummary) -> Figure:
    """Return the errors of found models over those of the true ones, in order."""
    figure = style.make_figure(2.6)
    axes = figure.subplots()
    ratios = np.array(summary.heldout.ratios)
    axes.axhspan(1.0 / 1.05, 1.05, color=style.SHADE, zorder=0)
    axes.plot(np.arange(1, len(ratios) + 1), ratios, "o", color=style.AFTER, markersize=3.5)
    if max(ratios.max(), 1.0 / ratios.min()) > WIDE:
        axes.set_yscale("log")
        style.log_ticks(axes.yaxis)
    else:
        style.few_ticks(axes)
    axes.xaxis.set_major_locator(MaxNLocator(8, integer=True))
    axes.set_xlabel("case, in order")
    axes.set_ylabel("error, found / true")
    return figure
