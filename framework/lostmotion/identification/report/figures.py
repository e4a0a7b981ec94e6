"""Figures of an identification: traces with rank plots, and the corner plot of the joint posterior."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from scipy.ndimage import gaussian_filter

from lostmotion.identification.report.view import IdentificationView
from lostmotion.report import style
from lostmotion.report.words import with_unit
from lostmotion.results import Array

GROUP_COLOURS = (style.AFTER, style.BEFORE, style.LAW, style.QUIET)
"""The colours of the four groups of walkers that R-hat compares."""
RANK_BINS = 20
HISTOGRAM_BINS = 28
MAX_DOTS = 1500
CONTOUR_SHARES = (0.95, 0.5)

TRACE_CAPTION = (
    "Left: every walker over its steps, without burn-in. Right: the distribution of the ranks of four groups of"
    " walkers; it is uniform when all groups sample the same posterior."
)
CORNER_CAPTION = "Posterior of each parameter and of each pair; the lines enclose half and 95 % of the draws."


def draw_trace(view: IdentificationView) -> Figure:
    """Return one row for each parameter: its walkers over the steps, and the ranks of four groups of them."""
    names = view.names
    figure = style.make_figure(1.35 * len(names) + 0.5)
    panels = figure.subplots(len(names), 2, squeeze=False, width_ratios=(2.4, 1.0))
    for (left, right), name in zip(panels, names, strict=True):
        scale = view.scale(name)
        _draw_walkers(left, scale.factor * view.draws[name])
        left.set_ylabel(_wrap_label(view.describe_name(name), scale.unit), rotation=0, ha="right", va="center")
        _draw_ranks(right, view.draws[name])
    panels[-1, 0].set_xlabel("step")
    panels[-1, 1].set_xlabel("rank among all draws")
    return figure


def _draw_walkers(axes: Axes, walks: Array) -> None:
    for k, walk in enumerate(walks):
        axes.plot(walk, color=GROUP_COLOURS[k % len(GROUP_COLOURS)], linewidth=0.5, alpha=0.6)
    axes.set_xlim(0, max(walks.shape[1] - 1, 1))
    style.few_ticks(axes, 6, 3)


def _draw_ranks(axes: Axes, walks: Array) -> None:
    """Draw a histogram of ranks for each group, one above the other, each relative to the uniform distribution."""
    ranks = np.argsort(np.argsort(walks, axis=None)).reshape(walks.shape)
    for k, colour in enumerate(GROUP_COLOURS):
        counts, edges = np.histogram(ranks[k :: len(GROUP_COLOURS)], bins=RANK_BINS, range=(0, walks.size))
        tall = counts / max(float(counts.mean()), 1e-300)
        axes.stairs(1.9 * k + tall, edges, baseline=1.9 * k, fill=True, color=colour, alpha=0.45)
        axes.axhline(1.9 * k + 1.0, color="#555555", linewidth=0.7, linestyle=(0, (3, 2)))
    axes.set_yticks([])
    axes.set_xlim(0, walks.size)
    axes.xaxis.set_major_locator(MaxNLocator(3, integer=True))
    axes.spines["left"].set_visible(False)


def draw_corner(view: IdentificationView) -> Figure:
    """Return the densities of all parameters on the diagonal and of all pairs below it; known values are dashed."""
    names = view.joint
    figure = style.make_figure(min(1.55 * len(names) + 0.6, 11.0))
    panels = figure.subplots(len(names), len(names), squeeze=False, sharex="col")
    for row, across in enumerate(names):
        for column, along in enumerate(names):
            axes = panels[row, column]
            if column > row:
                axes.remove()
            elif column == row:
                _draw_density(axes, view, along)
            else:
                _draw_pair(axes, view, along, across)
    _label_axes(panels, view)
    return figure


def _draw_density(axes: Axes, view: IdentificationView, name: str) -> None:
    values = view.scale(name).factor * view.draws[name].ravel()
    counts, edges = np.histogram(values, bins=HISTOGRAM_BINS, range=_find_limits(values))
    axes.stairs(counts, edges, fill=True, color=style.AFTER, alpha=0.3)
    axes.stairs(counts, edges, color=style.AFTER, linewidth=1.1)
    _mark_truth(axes.axvline, view, name)
    axes.set_xlim(*_find_limits(values))
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)


def _draw_pair(axes: Axes, view: IdentificationView, along: str, across: str) -> None:
    x, y = (view.scale(n).factor * view.draws[n].ravel() for n in (along, across))
    every = max(1, len(x) // MAX_DOTS)
    axes.plot(x[::every], y[::every], ".", color=style.AFTER, markersize=1.6, alpha=0.25, rasterized=True)
    counts, right, up = np.histogram2d(x, y, bins=HISTOGRAM_BINS, range=(_find_limits(x), _find_limits(y)))
    smooth = gaussian_filter(counts, 1.2)
    middles = [0.5 * (edges[1:] + edges[:-1]) for edges in (right, up)]
    levels = sorted({_find_level(smooth, share) for share in CONTOUR_SHARES})
    axes.contour(*middles, smooth.T, levels=levels, colors=style.AFTER, linewidths=1.1)
    _mark_truth(axes.axvline, view, along)
    _mark_truth(axes.axhline, view, across)
    axes.set_xlim(*_find_limits(x))
    axes.set_ylim(*_find_limits(y))


def _find_limits(values: Array) -> tuple[float, float]:
    """Return axis limits that leave out half a draw in a thousand at each end, with some margin."""
    return style.span_of(np.quantile(values, [0.0005, 0.9995]), 0.08)


def _find_level(density: Array, share: float) -> float:
    """Return the density level above which `share` of the mass on a grid lies."""
    falling = np.sort(density, axis=None)[::-1]
    return float(falling[np.searchsorted(np.cumsum(falling), share * falling.sum())])


def _mark_truth(draw: Callable[..., object], view: IdentificationView, name: str) -> None:
    truth = view.truth(name)
    if np.isfinite(truth):
        draw(view.scale(name).factor * truth, color=style.RECORDED, linestyle=(0, (4, 2)), linewidth=1.1)


def _label_axes(panels: Any, view: IdentificationView) -> None:
    last = len(view.joint) - 1
    for k, name in enumerate(view.joint):
        words = _wrap_label(view.describe_name(name), view.scale(name).unit)
        panels[last, k].set_xlabel(words)
        if k:
            panels[k, 0].set_ylabel(words)
        for column in range(k + 1):
            axes = panels[k, column]
            axes.xaxis.set_major_locator(MaxNLocator(3))
            axes.tick_params(axis="x", labelbottom=k == last, rotation=30)
            if column < k:
                axes.yaxis.set_major_locator(MaxNLocator(3))
                axes.ticklabel_format(useOffset=False)
                axes.tick_params(axis="y", labelleft=column == 0)


def _wrap_label(words: str, unit: str) -> str:
    """Return the name of a parameter with its unit, on lines short enough for a small panel."""
    words = words.replace(": ", ":\n").replace("measurement ", "measurement\n")
    return with_unit(words, unit).replace(" (", "\n(", 1)
