"""Phase plots and Poincare maps as the paper has them."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.contracts import Array
from lostmotion.report import style
from lostmotion_trials.paper.drawings import ForceDrawing, PhaseDrawing, SectionsDrawing, UnfoldedDrawing
from lostmotion_trials.paper.style import dots, letter, orbit, panels


def _phase(axes: Axes, states: Array, title: str = "chaotic") -> None:
    orbit(axes, 1e3 * states[:, 0], states[:, 1], width=0.35 if "chaotic" in title else 1.1)
    axes.set_xlabel("displacement x (mm)")
    axes.set_ylabel("velocity ẋ (m/s)")


def fig3(data: PhaseDrawing) -> Figure:
    """Return the phase plots of Cases 1 and 2."""
    figure, axes = panels(1, 2, 4.2)
    for panel, states, title in zip(axes, data.states, data.titles, strict=True):
        _phase(panel, states, title)
    letter(axes, data.titles)
    return figure


def fig4(data: UnfoldedDrawing) -> Figure:
    """Return the phase plot of Case 3 and its reconstruction from a delay."""
    figure, axes = panels(1, 2, 4.2)
    states, lag = data.states, data.lag
    _phase(axes[0], states)
    x = 1e3 * states[:, 0]
    orbit(axes[1], x[:-lag], x[lag:])
    axes[1].set_xlabel("x(t) (mm)")
    axes[1].set_ylabel("x(t + 0.102 s) (mm)")
    letter(axes, ("velocity against displacement", "in delay coordinates"))
    return figure


def fig5(data: ForceDrawing) -> Figure:
    """Return the normalised force of the backlash."""
    figure, axes = panels(1, 1, 3.6)
    axes[0].axvspan(-1.0, 1.0, color=style.SHADE, lw=0)
    axes[0].plot(data.p, data.force, color=style.AFTER, lw=2.0)
    axes[0].text(0.0, 0.25, "the gap: no force", ha="center", color="#444444")
    axes[0].text(1.9, 1.25, "slope 1", ha="center", color="#444444")
    axes[0].set_xlabel("normalised displacement p = x/x₀")
    axes[0].set_ylabel("normalised force F̄(p) = F/(k₀x₀)")
    return figure


def fig8(data: PhaseDrawing) -> Figure:
    """Return phase plots at four values of 1/alpha."""
    figure, axes = panels(2, 2, 7.4)
    for panel, states, title in zip(axes, data.states, data.titles, strict=True):
        _phase(panel, states, title)
    letter(axes, [title.replace("alpha", "α") for title in data.titles])
    return figure


def fig9(data: SectionsDrawing) -> Figure:
    """Return Poincare maps at four values of 1/alpha."""
    figure, axes = panels(2, 2, 7.4, sharex=True, sharey=True)
    before = 1e3 * data.transient
    dots(axes[-1], before[:, 0], before[:, 1], size=1.1, color=style.QUIET, label="transients from other starts")
    axes[-1].legend(loc="lower right", markerscale=4.0)
    for panel, points in zip(axes, data.points, strict=True):
        few = len(np.unique(np.round(points, 7), axis=0)) < 50
        dots(panel, 1e3 * points[:, 0], 1e3 * points[:, 1], size=6.0 if few else 1.1)
        panel.tick_params(labelbottom=True, labelleft=True)
        panel.set_xlabel("x(t) (mm)")
        panel.set_ylabel("x(t + 0.01 s) (mm)")
    letter(axes, [title.replace("alpha", "α") for title in data.titles])
    return figure


FIGURES: Mapping[str, Callable[..., Figure]] = {"fig3": fig3, "fig4": fig4, "fig5": fig5, "fig8": fig8, "fig9": fig9}
