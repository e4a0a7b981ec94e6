"""Draws exponents and bifurcation diagrams over 1/alpha and damping."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from lostmotion.contracts import Array
from lostmotion.report import style
from lostmotion_chaos.paper.drawings import (
    BranchesDrawing,
    DiagramsDrawing,
    LineDrawing,
    PlaneDrawing,
    SharedPlaneDrawing,
)
from lostmotion_chaos.paper.style import (
    CALM_TO_CHAOS,
    COLOURS,
    draw_dots,
    letter_panels,
    make_exponent_norm,
    make_panels,
)

ACROSS = "1/α = k₀x₀/A"
EXPONENT = "largest exponent (bit per unit of ω₀t)"


def _draw_exponents(axes: Axes, inverse: Array, exponents: Array) -> None:
    """Draw the exponents (cells, starts) as points: above zero coloured, far below zero not shown."""
    across = np.repeat(inverse, exponents.shape[1])
    values = exponents.ravel()
    high = float(np.nanmax(values))
    axes.axhline(0.0, color="#444444", lw=0.8)
    draw_dots(axes, across[values <= 0], values[values <= 0], size=2.0, color=style.QUIET, label="not chaotic")
    draw_dots(axes, across[values > 0], values[values > 0], size=2.6, color=style.BEFORE, label="above zero")
    axes.set_ylim(-0.6 * high, 1.12 * high)
    axes.set_xlim(float(inverse[0]), float(inverse[-1]))


def draw_fig6(data: LineDrawing) -> Figure:
    """Return the figure with the exponent of every start over 1/alpha, and the share of chaotic starts."""
    figure, axes = make_panels(2, 1, 5.6, sharex=True, height_ratios=[3, 1])
    for low, high in data.known:
        axes[0].axvspan(low, high, color=style.SHADE, lw=0)
    _draw_exponents(axes[0], data.inverse, data.exponents)
    axes[0].plot(data.inverse, np.maximum(data.exponents.max(axis=1), 0.0), color=style.AFTER, lw=1.0,
                 label="highest of all starts, or zero")  # fmt: skip
    axes[0].set_ylabel(EXPONENT)
    axes[0].legend(loc="upper right", ncols=3, markerscale=2.5)
    low, high = axes[0].get_ylim()
    axes[0].set_ylim(low, high + 0.12 * (high - low))
    axes[1].fill_between(data.inverse, data.share, step="mid", color=style.BEFORE, alpha=0.75, lw=0)
    axes[1].set_ylim(0.0, 1.03)
    axes[1].set_ylabel("share of starts\nin chaos")
    axes[1].set_xlabel(ACROSS)
    letter_panels(axes, ("Case 1, each dot one start; shaded: the windows of chaos of a careful integration",
                  "coexisting attractors and long transients: where the share is neither 0 nor 1"))  # fmt: skip
    return figure


def _draw_diagram(axes: Axes, inverse: Array, places: Array, size: float) -> None:
    """Draw stroboscopic positions (cells, starts, kept) over 1/alpha, one colour for each start."""
    for start in range(places.shape[1]):
        x = np.repeat(inverse, places.shape[2])
        draw_dots(axes, x, places[:, start].ravel(), size=size, color=COLOURS[start % len(COLOURS)])
    axes.set_xlim(float(inverse[0]), float(inverse[-1]))


def draw_fig7(data: DiagramsDrawing) -> Figure:
    """Return the figure with the bifurcation diagrams, and the share of chaos over damping."""
    figure, axes = make_panels(4, 2, 10.4)
    for panel, places in zip(axes, data.places, strict=False):
        _draw_diagram(panel, data.inverse, places, 0.7)
        panel.set_ylabel("x/x₀ once a period")
        panel.set_xlabel(ACROSS)
    last = axes[-1]
    last.semilogx(data.dampings, 100 * data.shares, color=style.BEFORE, marker="o")
    last.set_ylim(0.0, None)
    last.set_ylabel("motions in chaos (%)")
    last.set_xlabel("2ζ = c/√(k₀m)")
    last.xaxis.set_major_locator(FixedLocator(list(data.dampings)))
    last.xaxis.set_minor_locator(NullLocator())
    last.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    letter_panels(axes, [*(f"2ζ = {d:g}" for d in data.dampings), "chaos over damping"])
    return figure


def _draw_plane(figure: Figure, axes: Axes, data: PlaneDrawing, values: Array, **options: Any) -> None:
    """Draw values (zeta, inverse) as colours over 1/alpha and the damping ratio, with a colour bar."""
    drawn = axes.pcolormesh(data.inverse, data.zeta, values, shading="nearest", rasterized=True, **options)
    axes.set_xlabel(ACROSS)
    axes.set_ylabel("damping ratio ζ")
    axes.grid(visible=False)
    figure.colorbar(drawn, ax=axes, pad=0.02, extend="min" if "norm" in options else "neither").set_label(
        EXPONENT if "norm" in options else "share of starts in chaos"
    )


def draw_fig10(data: SharedPlaneDrawing) -> Figure:
    """Return the figure with the exponent and the share of chaotic starts over 1/alpha and zeta."""
    figure, axes = make_panels(2, 1, 7.6)
    _draw_plane(figure, axes[0], data, data.exponent, cmap=CALM_TO_CHAOS, norm=make_exponent_norm(data.exponent))
    axes[0].contour(data.inverse, data.zeta, data.exponent, levels=[0.0], colors="#1a1a1a", linewidths=0.5)
    _draw_plane(figure, axes[1], data, data.share, cmap="cividis", vmin=0.0, vmax=1.0)
    titles = ("highest exponent of all starts; the line is where it is zero", "share of starts that end in chaos")
    letter_panels(axes, titles)
    return figure


def draw_bifurcation(data: BranchesDrawing) -> Figure:
    """Return the figure with the bifurcation diagram and the exponents below it."""
    figure, axes = make_panels(2, 1, 7.2, sharex=True, height_ratios=[2, 1])
    _draw_diagram(axes[0], data.inverse, data.places, 0.6)
    axes[0].set_ylabel("x/x₀ once a period")
    _draw_exponents(axes[1], data.inverse, data.exponents)
    axes[1].set_ylabel("exponent\n(bit per unit of ω₀t)")
    axes[1].set_xlabel(ACROSS)
    letter_panels(axes, ("Case 1, 2ζ = 0.04: one colour for each start", "the exponents of the same motions"))
    return figure


def draw_plane_map(data: PlaneDrawing) -> Figure:
    """Return the figure with the map of the largest exponent; the damping axis is logarithmic."""
    figure, axes = make_panels(1, 1, 5.6)
    _draw_plane(figure, axes[0], data, data.exponent, cmap=CALM_TO_CHAOS, norm=make_exponent_norm(data.exponent))
    axes[0].set_yscale("log")
    style.log_ticks(axes[0].yaxis)
    return figure


FIGURES: Mapping[str, Callable[..., Figure]] = {
    "fig6": draw_fig6,
    "fig7": draw_fig7,
    "fig10": draw_fig10,
    "bifurcation": draw_bifurcation,
    "map": draw_plane_map,
}
