"""Draws mutual information, Cao's numbers, correlation dimensions, spectra, delay plots and Poincare maps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from lostmotion.contracts import Array
from lostmotion.report import style
from lostmotion_chaos.paper.drawings import (
    CaoDrawing,
    CleanedCaoDrawing,
    CleanedMapsDrawing,
    DelayDrawing,
    InformationDrawing,
    JointDrawing,
    NoisyCaoDrawing,
    NoisyInformationDrawing,
    NoisyMapsDrawing,
    SlopesDrawing,
)
from lostmotion_chaos.paper.style import (
    COLOURS,
    MARKS,
    draw_dots,
    draw_orbit,
    letter_panels,
    make_panels,
    set_whole_ticks,
)


def draw_fig17(data: JointDrawing) -> Figure:
    """Return the figure with the output, input and output, spectra, and the output without the harmonics."""
    figure, axes = make_panels(2, 2, 6.6)
    time, few = data.time, data.time < 6.0
    early = time < 60.0
    axes[0].plot(time[early], data.link[early], color=style.AFTER, lw=0.4, rasterized=True)
    axes[1].plot(time[few], data.base[few], color=style.QUIET, ls="--", label="input")
    axes[1].plot(time[few], data.link[few], color=style.AFTER, label="output")
    low, high = axes[1].get_ylim()
    axes[1].set_ylim(low, high + 0.22 * (high - low))
    axes[1].legend(loc="upper right", ncols=2)
    axes[2].semilogy(data.frequency, data.density, color=style.QUIET, lw=0.7, label="removed: drive, harmonics")
    axes[2].semilogy(data.frequency, data.rest, color=style.AFTER, lw=0.7, label="what is left")
    axes[2].set_xlim(0.0, 16.0)
    axes[2].set_ylim(1e-7, 10.0 * float(data.density.max()) * 5.0)
    style.log_ticks(axes[2].yaxis)
    axes[2].legend(loc="upper right")
    axes[3].plot(time[early], data.left[early], color=style.AFTER, lw=0.4, rasterized=True)
    for panel in (axes[0], axes[1], axes[3]):
        panel.set_xlabel("time (s)")
    for panel in axes[:2]:
        panel.set_ylabel("angle (°)")
    axes[2].set_xlabel("frequency (Hz)")
    axes[2].set_ylabel("power spectral density (°²/Hz)")
    axes[3].set_ylabel("angle without harmonics (°)")
    letter_panels(axes, ("output", "input and output", "spectra of the output", "output without the harmonics"))
    return figure


def draw_fig18(data: InformationDrawing) -> Figure:
    """Return the figure with the mutual information over the lag."""
    figure, axes = make_panels(1, 1, 3.6)
    axes[0].plot(data.lag, data.ami, color=style.AFTER)
    at = float(np.interp(data.first, data.lag, data.ami))
    axes[0].plot([data.first], [at], ls="", marker="o", color=style.BEFORE, ms=7,
                 label=f"first minimum, {data.first:.3f} s")  # fmt: skip
    axes[0].axvline(0.174, color=style.QUIET, ls="--", lw=1.0, label="0.174 s, the paper's")
    axes[0].set_xlabel("lag (s)")
    axes[0].set_ylabel("average mutual information (bit)")
    axes[0].set_ylim(0.0, None)
    axes[0].legend(loc="upper right")
    return figure


def _draw_cao(axes: Axes, dims: Array, values: Array, **options: Any) -> None:
    """Draw one curve of Cao's numbers over the embedding dimension."""
    axes.plot(dims, values, **{"marker": "o", "ms": 5, **options})
    set_whole_ticks(axes)
    axes.set_xlabel("embedding dimension d")


def _finish_e1(axes: Axes) -> None:
    """Draw the line at 1, labels and limits of a plot of Cao's E1 alone."""
    axes.axhline(1.0, color="#444444", lw=0.8)
    axes.set_ylabel("Cao's E1")
    axes.set_ylim(0.0, 1.1)
    axes.legend(loc="lower right")


def draw_fig19(data: CaoDrawing) -> Figure:
    """Return the figure with Cao's E1 and E2 over the dimension."""
    figure, axes = make_panels(1, 1, 3.6)
    _draw_cao(axes[0], data.dim, data.e1, color=style.AFTER, label="E1")
    _draw_cao(axes[0], data.dim, data.e2, color=style.QUIET, ls="--", marker="s", label="E2")
    axes[0].axhline(1.0, color="#444444", lw=0.8)
    axes[0].set_ylabel("Cao's numbers")
    axes[0].set_ylim(0.0, 1.1 * float(np.nanmax([data.e1, data.e2])))
    axes[0].legend(loc="lower right")
    return figure


def _draw_delays(axes: Sequence[Axes], data: DelayDrawing) -> None:
    """Draw one delay plot in each panel."""
    for panel, x, lag, seconds in zip(axes, data.links, data.lags, data.seconds, strict=True):
        shown = x[: 120 * 60]
        draw_orbit(panel, shown[:-lag], shown[lag:], width=0.3)
        panel.set_xlabel("q(t) (°)")
        panel.set_ylabel(f"q(t + {seconds:.3f} s) (°)")


def draw_fig20(data: DelayDrawing) -> Figure:
    """Return the figure with delay plots at the eight levels."""
    figure, axes = make_panels(2, 4, 5.6)
    _draw_delays(axes, data)
    for panel in axes:
        style.few_ticks(panel, 4, 4)
        panel.set_aspect("equal")
    letter_panels(axes, data.titles)
    return figure


def draw_slopes(data: SlopesDrawing) -> Figure:
    """Return the figure with slopes of four recordings over the dimension, and mean and 3 sd of their surrogates."""
    figure, axes = make_panels(2, 2, 6.6)
    for panel, one in zip(axes, data.slopes, strict=True):
        panel.errorbar(one.dims, one.mean, 3.0 * one.spread, color=style.QUIET, marker="s", ms=4, capsize=3, lw=1.0,
                       label="surrogates: mean, 3 standard deviations")  # fmt: skip
        panel.plot(one.dims, one.recorded, color=style.BEFORE, marker="o", ms=5, label="recording")
        set_whole_ticks(panel)
        panel.set_ylim(0.0, None)
        panel.set_xlabel("embedding dimension m")
        panel.set_ylabel("slope of the correlation sum")
    style.legend_above(figure, axes[0])
    letter_panels(axes, data.titles)
    return figure


def draw_fig22(data: DelayDrawing) -> Figure:
    """Return the figure with delay plots before and after noise reduction."""
    figure, axes = make_panels(1, 2, 4.6, sharex=True, sharey=True)
    _draw_delays(axes, data)
    letter_panels(axes, data.titles)
    return figure


def draw_fig23(data: CleanedCaoDrawing) -> Figure:
    """Return the figure with Cao's E1 before and after noise reduction."""
    figure, axes = make_panels(1, 1, 3.6)
    _draw_cao(axes[0], data.dim, data.before, color=style.BEFORE, label="as recorded")
    _draw_cao(axes[0], data.dim_after, data.after, color=style.AFTER, ls="--", marker="s", label="cleaned")
    _finish_e1(axes[0])
    return figure


def draw_fig11(data: NoisyInformationDrawing) -> Figure:
    """Return the figure with the motion of Case 3 and its mutual information at four noise levels."""
    figure, axes = make_panels(2, 1, 6.2)
    axes[0].plot(data.time, 1e3 * data.x, color=style.AFTER)
    axes[0].set_xlabel("time (s)")
    axes[0].set_ylabel("displacement x (mm)")
    for k, (name, lag, ami) in enumerate(zip(data.names, data.lags, data.amis, strict=True)):
        axes[1].plot(lag, ami, color=COLOURS[k], label=name)
    axes[1].axvline(0.102, color=style.QUIET, ls="--", lw=1.0, label="0.102 s, the paper's")
    axes[1].set_xlabel("lag (s)")
    axes[1].set_ylabel("mutual information (bit)")
    axes[1].set_ylim(0.0, None)
    axes[1].set_xlim(0.0, 0.65)
    low, high = axes[1].get_ylim()
    axes[1].set_ylim(low, 1.2 * high)
    axes[1].legend(loc="upper right", ncols=5)
    axes[1].xaxis.set_major_locator(MultipleLocator(0.1))
    letter_panels(axes, ("Case 3 without noise", "its mutual information"))
    return figure


def draw_fig13(data: NoisyCaoDrawing) -> Figure:
    """Return the figure with Cao's E1 at four noise levels."""
    figure, axes = make_panels(1, 1, 4.0)
    for k, (name, dims, e1) in enumerate(zip(data.names, data.dims, data.e1, strict=True)):
        _draw_cao(axes[0], dims, e1, color=COLOURS[k], marker=MARKS[k], label=name)
    _finish_e1(axes[0])
    return figure


def _draw_maps(data: NoisyMapsDrawing, cleaned: Sequence[Array] = ()) -> tuple[Figure, list[Axes]]:
    """Return the figure with Poincare maps at four noise levels, after noise reduction where given, and its panels."""
    figure, axes = make_panels(2, 2, 7.2)
    for k, panel in enumerate(axes):
        noisy = 1e3 * data.noisy[k]
        if cleaned and k:
            draw_dots(panel, noisy[:, 0], noisy[:, 1], size=1.6, color="#c3ccd6", label="with noise")
        points = 1e3 * cleaned[k] if cleaned else noisy
        draw_dots(panel, points[:, 0], points[:, 1], size=1.6, label="cleaned")
        panel.set_xlabel("x(t) (mm)")
        panel.set_ylabel("x(t + 0.08 s) (mm)")
        if cleaned and k:
            panel.legend(loc="best", markerscale=4.0)
    letter_panels(axes, data.names)
    return figure, axes


def draw_fig12(data: NoisyMapsDrawing) -> Figure:
    """Return the figure with Poincare maps at four noise levels."""
    return _draw_maps(data)[0]


def draw_cleaned_maps(data: CleanedMapsDrawing) -> Figure:
    """Return the figure with Poincare maps before and after noise reduction, or with an enlarged window of them."""
    figure, axes = _draw_maps(data, data.cleaned)
    if data.window is not None:
        (left, right), (low, high) = (1e3 * data.window).tolist()
        for panel in axes:
            panel.set_xlim(left, right)
            panel.set_ylim(low, high)
    return figure


FIGURES: Mapping[str, Callable[..., Figure]] = {
    "fig11": draw_fig11, "fig12": draw_fig12, "fig13": draw_fig13, "fig14": draw_slopes, "fig15": draw_cleaned_maps,
    "fig16": draw_cleaned_maps, "fig17": draw_fig17, "fig18": draw_fig18, "fig19": draw_fig19, "fig20": draw_fig20,
    "fig21": draw_slopes, "fig22": draw_fig22, "fig23": draw_fig23,
}  # fmt: skip
