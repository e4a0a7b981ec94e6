"""Draws basins of attraction and sections coloured by density."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from lostmotion.report import style
from lostmotion_chaos.paper.drawings import Basin, BasinsDrawing, VisitsDrawing
from lostmotion_chaos.paper.style import letter_panels, make_panels

BASINS = ("#0b3954", "#e0a458", "#5f9ea0", "#b23a48", "#c9d6df", "#6a4c93", "#8ab17d", "#f4e285")
CHAOS = "#1a1a1a"


def _draw_basin(axes: Axes, data: Basin) -> None:
    """Draw the attractor of each start as a colour, with a legend."""
    labels = data.labels
    most = len(BASINS)
    chaos = [name.startswith("chaos") for name in labels[:most]]
    colours = [CHAOS if is_chaos else BASINS[k % most] for k, is_chaos in enumerate(chaos)]
    index = np.minimum(data.index, len(colours) - 1)
    axes.pcolormesh(
        data.across, data.up, index, cmap=ListedColormap(colours), vmin=-0.5, vmax=len(colours) - 0.5,
        shading="nearest", rasterized=True,
    )  # fmt: skip
    axes.grid(visible=False)
    axes.set_xlabel("initial position x/x₀")
    axes.set_ylabel("initial velocity ẋ/(x₀ω₀)")
    handles = [Patch(color=c, label=n) for c, n in zip(colours, labels, strict=False)]
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, fontsize=8.5)


def draw_basins(data: BasinsDrawing) -> Figure:
    """Return the figure with the basins of Cases 2 and 3."""
    figure, axes = make_panels(1, 2, 5.6)
    for panel, one in zip(axes, data.cases, strict=True):
        _draw_basin(panel, one)
    letter_panels(axes, ("Case 2, A = 240 N", "Case 3, A = 108 N"))
    return figure


def draw_section(data: VisitsDrawing) -> Figure:
    """Return the figure with the sections of Cases 1 and 3; cells with more visits are brighter."""
    figure, axes = make_panels(1, 2, 4.6)
    for panel, one in zip(axes, data.cases, strict=True):
        panel.set_facecolor("#0d0d12")
        shown = np.where(one.counts > 0, one.counts, np.nan).T
        drawn = panel.pcolormesh(
            one.x, one.v, shown, cmap="inferno", norm=LogNorm(0.5, float(np.nanmax(shown))), rasterized=True
        )
        panel.grid(visible=False)
        panel.set_xlabel("x/x₀ at phase 0 of the drive")
        panel.set_ylabel("ẋ/(x₀ω₀)")
        bar = figure.colorbar(drawn, ax=panel, pad=0.02)
        bar.set_label("visits of a cell")
        style.log_ticks(bar.ax.yaxis)
    letter_panels(axes, [f"Case {k}, {one.periods:,} periods" for k, one in zip((1, 3), data.cases, strict=True)])
    return figure


FIGURES: Mapping[str, Callable[..., Figure]] = {"basins": draw_basins, "section": draw_section}
