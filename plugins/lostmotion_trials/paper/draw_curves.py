"""Mutual information, Cao's numbers, correlation dimensions and spectra over their axes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from lostmotion.contracts import Array
from lostmotion.report import style
from lostmotion_trials.paper.drawings import (
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
from lostmotion_trials.paper.style import COLOURS, MARKS, dots, letter, orbit, panels, whole_ticks


def fig17(data: JointDrawing) -> Figure:
    """Return output, input and output, spectra, and the output without the harmonics."""
    figure, axes = panels(2, 2, 6.6)
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
    letter(axes, ("output", "input and output", "spectra of the output", "output without the harmonics"))
    return figure


def fig18(data: InformationDrawing) -> Figure:
    """Return the mutual information over the lag."""
    figure, axes = panels(1, 1, 3.6)
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


def _cao(axes: Axes, dims: Array, values: Array, **options: Any) -> None:
    axes.plot(dims, values, **{"marker": "o", "ms": 5, **options})
    whole_ticks(axes)
    axes.set_xlabel("embedding dimension d")


def fig19(data: CaoDrawing) -> Figure:
    """Return Cao's E1 and E2 over dimension."""
    figure, axes = panels(1, 1, 3.6)
    _cao(axes[0], data.dim, data.e1, color=style.AFTER, label="E1")
    _cao(axes[0], data.dim, data.e2, color=style.QUIET, ls="--", marker="s", label="E2")
    axes[0].axhline(1.0, color="#444444", lw=0.8)
    axes[0].set_ylabel("Cao's numbers")
    axes[0].set_ylim(0.0, 1.1 * float(np.nanmax([data.e1, data.e2])))
    axes[0].legend(loc="lower right")
    return figure


def _delay_plots(axes: Sequence[Axes], data: DelayDrawing) -> None:
    for panel, x, lag, seconds in zip(axes, data.links, data.lags, data.seconds, strict=True):
        shown = x[: 120 * 60]
        orbit(panel, shown[:-lag], shown[lag:], width=0.3)
        panel.set_xlabel("q(t) (°)")
        panel.set_ylabel(f"q(t + {seconds:.3f} s) (°)")


def fig20(data: DelayDrawing) -> Figure:
    """Return delay plots at the eight levels."""
    figure, axes = panels(2, 4, 5.6)
    _delay_plots(axes, data)
    for panel in axes:
        style.few_ticks(panel, 4, 4)
        panel.set_aspect("equal")
    letter(axes, data.titles)
    return figure


def slopes(data: SlopesDrawing) -> Figure:
    """Return slopes of four recordings over dimension, with mean and three standard deviations of surrogates."""
    figure, axes = panels(2, 2, 6.6)
    for panel, one in zip(axes, data.slopes, strict=True):
        panel.errorbar(one.dims, one.mean, 3.0 * one.spread, color=style.QUIET, marker="s", ms=4, capsize=3, lw=1.0,
                       label="surrogates: mean, 3 standard deviations")  # fmt: skip
        panel.plot(one.dims, one.recorded, color=style.BEFORE, marker="o", ms=5, label="recording")
        whole_ticks(panel)
        panel.set_ylim(0.0, None)
        panel.set_xlabel("embedding dimension m")
        panel.set_ylabel("slope of the correlation sum")
    style.legend_above(figure, axes[0])
    letter(axes, data.titles)
    return figure


def fig22(data: DelayDrawing) -> Figure:
    """Return the delay plots before and after noise reduction."""
    figure, axes = panels(1, 2, 4.6, sharex=True, sharey=True)
    _delay_plots(axes, data)
    letter(axes, data.titles)
    return figure


def fig23(data: CleanedCaoDrawing) -> Figure:
    """Return Cao's E1 before and after noise reduction."""
    figure, axes = panels(1, 1, 3.6)
    _cao(axes[0], data.dim, data.before, color=style.BEFORE, label="as recorded")
    _cao(axes[0], data.dim_after, data.after, color=style.AFTER, ls="--", marker="s", label="cleaned")
    axes[0].axhline(1.0, color="#444444", lw=0.8)
    axes[0].set_ylabel("Cao's E1")
    axes[0].set_ylim(0.0, 1.1)
    axes[0].legend(loc="lower right")
    return figure


def fig11(data: NoisyInformationDrawing) -> Figure:
    """Return the motion of Case 3 and its mutual information at four noise levels."""
    figure, axes = panels(2, 1, 6.2)
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
    letter(axes, ("Case 3 without noise", "its mutual information"))
    return figure


def fig13(data: NoisyCaoDrawing) -> Figure:
    """Return Cao's E1 at four noise levels."""
    figure, axes = panels(1, 1, 4.0)
    for k, (name, dims, e1) in enumerate(zip(data.names, data.dims, data.e1, strict=True)):
        _cao(axes[0], dims, e1, color=COLOURS[k], marker=MARKS[k], label=name)
    axes[0].axhline(1.0, color="#444444", lw=0.8)
    axes[0].set_ylabel("Cao's E1")
    axes[0].set_ylim(0.0, 1.1)
    axes[0].legend(loc="lower right")
    return figure


def _maps(data: NoisyMapsDrawing, cleaned: Sequence[Array] = ()) -> tuple[Figure, list[Axes]]:
    figure, axes = panels(2, 2, 7.2)
    for k, panel in enumerate(axes):
        noisy = 1e3 * data.noisy[k]
        if cleaned and k:
            dots(panel, noisy[:, 0], noisy[:, 1], size=1.6, color="#c3ccd6", label="with noise")
        points = 1e3 * cleaned[k] if cleaned else noisy
        dots(panel, points[:, 0], points[:, 1], size=1.6, label="cleaned")
        panel.set_xlabel("x(t) (mm)")
        panel.set_ylabel("x(t + 0.08 s) (mm)")
        if cleaned and k:
            panel.legend(loc="best", markerscale=4.0)
    letter(axes, data.names)
    return figure, axes


def fig12(data: NoisyMapsDrawing) -> Figure:
    """Return Poincare maps at four noise levels."""
    return _maps(data)[0]


def cleaned_maps(data: CleanedMapsDrawing) -> Figure:
    """Return Poincare maps behind noise reduction over those with noise, or a window of them, enlarged."""
    figure, axes = _maps(data, data.cleaned)
    if data.window is not None:
        (left, right), (low, high) = (1e3 * data.window).tolist()
        for panel in axes:
            panel.set_xlim(left, right)
            panel.set_ylim(low, high)
    return figure


FIGURES: Mapping[str, Callable[..., Figure]] = {
    "fig11": fig11, "fig12": fig12, "fig13": fig13, "fig14": slopes, "fig15": cleaned_maps, "fig16": cleaned_maps,
    "fig17": fig17, "fig18": fig18, "fig19": fig19, "fig20": fig20, "fig21": slopes, "fig22": fig22, "fig23": fig23,
}  # fmt: skip
