"""Draws phase plots and Poincare maps in the form used by the paper."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.contracts import Array
from lostmotion.report import style
from lostmotion_chaos.paper.drawings import ForceDrawing, PhaseDrawing, SectionsDrawing, UnfoldedDrawing
from lostmotion_chaos.paper.style import draw_dots, draw_orbit, letter_panels, make_panels


def _draw_phase(axes: Axes, states: Array, title: str = "chaotic") -> None:
    """Draw the velocity over the displacement; a periodic motion has a thicker line."""
    draw_orbit(axes, 1e3 * states[:, 0], states[:, 1], width=0.35 if "chaotic" in title else 1.1)
    axes.set_xlabel("displacement x (mm)")
    axes.set_ylabel("velocity ẋ (m/s)")


def draw_fig3(data: PhaseDrawing) -> Figure:
    """Return the figure with the phase plots of Cases 1 and 2."""
    figure, axes = make_panels(1, 2, 4.2)
    for panel, states, title in zip(axes, data.states, data.titles, strict=True):
        _draw_phase(panel, states, title)
    letter_panels(axes, data.titles)
    return figure


def draw_fig4(data: UnfoldedDrawing) -> Figure:
    """Return the figure with the phase plot of Case 3 and its reconstruction in delay coordinates."""
    figure, axes = make_panels(1, 2, 4.2)
    states, lag = data.states, data.lag
    _draw_phase(axes[0], states)
    x = 1e3 * states[:, 0]
    draw_orbit(axes[1], x[:-lag], x[lag:])
    axes[1].set_xlabel("x(t) (mm)")
    axes[1].set_ylabel("x(t + 0.102 s) (mm)")
    letter_panels(axes, ("velocity against displacement", "in delay coordinates"))
    return figure


def draw_fig5(data: ForceDrawing) -> Figure:
    """Return the figure with the normalised force of the backlash."""
    figure, axes = make_panels(1, 1, 3.6)
    axes[0].axvspan(-1.0, 1.0, color=style.SHADE, lw=0)
    axes[0].plot(data.p, data.force, color=style.AFTER, lw=2.0)
    axes[0].text(0.0, 0.25, "the gap: no force", ha="center", color="#444444")
    axes[0].text(1.9, 1.25, "slope 1", ha="center", color="#444444")
    axes[0].set_xlabel("normalised displacement p = x/x₀")
    axes[0].set_ylabel("normalised force F̄(p) = F/(k₀x₀)")
    return figure


def draw_fig8(data: PhaseDrawing) -> Figure:
    """Return the figure with phase plots at four values of 1/alpha."""
    figure, axes = make_panels(2, 2, 7.4)
    for panel, states, title in zip(axes, data.states, data.titles, strict=True):
        _draw_phase(panel, states, title)
    letter_panels(axes, [title.replace("alpha", "α") for title in data.titles])
    return figure


def draw_fig9(data: SectionsDrawing) -> Figure:
    """Return the figure with Poincare maps at four values of 1/alpha."""
    figure, axes = make_panels(2, 2, 7.4, sharex=True, sharey=True)
    before = 1e3 * data.transient
    draw_dots(axes[-1], before[:, 0], before[:, 1], size=1.1, color=style.QUIET, label="transients from other starts")
    axes[-1].legend(loc="lower right", markerscale=4.0)
    for panel, points in zip(axes, data.points, strict=True):
        few = len(np.unique(np.round(points, 7), axis=0)) < 50
        draw_dots(panel, 1e3 * points[:, 0], 1e3 * points[:, 1], size=6.0 if few else 1.1)
        panel.tick_params(labelbottom=True, labelleft=True)
        panel.set_xlabel("x(t) (mm)")
        panel.set_ylabel("x(t + 0.01 s) (mm)")
    letter_panels(axes, [title.replace("alpha", "α") for title in data.titles])
    return figure


FIGURES: Mapping[str, Callable[..., Figure]] = {
    "fig3": draw_fig3,
    "fig4": draw_fig4,
    "fig5": draw_fig5,
    "fig8": draw_fig8,
    "fig9": draw_fig9,
}
