"""Figure of the levels: measured values and predictions of the posterior at each level of the drive."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.report import style
from lostmotion.report.words import choose_scale, with_unit
from lostmotion.results.identification import DriveLevel, ExpectedRange, MeasuredRange

CAPTION = (
    "Dots with bars: measured values with 95 % intervals; squares: no chaos observed. Blue bars: 95 % range that the"
    " posterior predicts for a chaotic motion. Below: the predicted probability of chaos at each level; a dot at one"
    " marks an observed chaotic motion, a square at zero an observed periodic one."
)
Quantity = Literal["lyapunov", "d2"]
QUANTITIES: dict[Quantity, str] = {"lyapunov": "exponent", "d2": "correlation dimension"}


def draw(levels: Sequence[DriveLevel]) -> Figure:
    """Return the figure: a panel for each measured quantity over the levels, and one for the probability of chaos."""
    shown = [key for key in QUANTITIES if any(_get_measured(level, key) for level in levels)]
    figure = style.make_figure(2.1 * len(shown) + 1.9)
    panels = figure.subplots(
        len(shown) + 1, 1, sharex=True, squeeze=False, height_ratios=[1.4] * len(shown) + [1.0]
    ).ravel()
    for axes, key in zip(panels, shown, strict=False):
        _draw_quantity(axes, levels, key)
    _draw_share(panels[-1], levels)
    ticks, unit = _format_amplitudes(levels)
    panels[-1].set_xticks(range(len(levels)), ticks)
    panels[-1].set_xlim(-0.6, len(levels) - 0.4)
    panels[-1].set_xlabel(with_unit("amplitude of the drive", unit))
    style.legend_above(figure, panels[0])
    return figure


def _format_amplitudes(levels: Sequence[DriveLevel]) -> tuple[list[str], str]:
    """Return the amplitudes as texts in one unit, and that unit."""
    sizes = [level.amplitude for level in levels]
    scale = choose_scale(max(sizes), levels[0].unit)
    return [f"{scale.factor * size:.4g}" for size in sizes], scale.unit


def _draw_quantity(axes: Axes, levels: Sequence[DriveLevel], key: Quantity) -> None:
    unit = ""
    for place, level in enumerate(levels):
        share, seen = level.predicted.chaotic_share, _get_measured(level, key)
        expected = level.predicted.lyapunov if key == "lyapunov" else level.predicted.d2
        if expected and share > 0.0:
            _draw_expected(axes, place, expected, share)
        if seen:
            unit = seen.unit
            _draw_measured(axes, place, seen)
        elif level.motion == "periodic" and key == "lyapunov":
            axes.plot([place], [0.0], "s", color=style.RECORDED, markersize=6, fillstyle="none")
    axes.plot([], [], "o", color=style.RECORDED, label="measured")
    axes.plot([], [], color=style.AFTER, linewidth=7, alpha=0.5, label="expected by the posterior")
    axes.set_ylabel(with_unit(QUANTITIES[key], unit))
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]) if key == "lyapunov" else None)


def _get_measured(level: DriveLevel, key: Quantity) -> MeasuredRange | None:
    return level.lyapunov if key == "lyapunov" else level.d2


def _draw_expected(axes: Axes, place: int, expected: ExpectedRange, share: float) -> None:
    """Draw a bar that is fainter where chaos is less probable."""
    low, median, high = expected.low, expected.median, expected.high
    alpha = 0.12 + 0.4 * share
    axes.bar(place, high - low, bottom=low, width=0.42, color=style.AFTER, alpha=alpha, linewidth=0)
    axes.plot([place - 0.21, place + 0.21], [median, median], color=style.AFTER, linewidth=1.6, alpha=0.3 + 0.7 * share)


def _draw_measured(axes: Axes, place: int, seen: MeasuredRange) -> None:
    room = np.maximum([[seen.value - seen.low], [seen.high - seen.value]], 0.0)
    axes.errorbar(
        [place], [seen.value], yerr=room, fmt="o", color=style.RECORDED, markersize=5, capsize=3, linewidth=1.2
    )


def _draw_share(axes: Axes, levels: Sequence[DriveLevel]) -> None:
    shares = [level.predicted.chaotic_share for level in levels]
    axes.bar(range(len(levels)), shares, width=0.42, color=style.AFTER, alpha=0.5)
    for place, level in enumerate(levels):
        if level.motion == "chaotic":
            axes.plot([place], [1.0], "o", color=style.RECORDED, markersize=6, clip_on=False)
        elif level.motion == "periodic":
            axes.plot([place], [0.0], "s", color=style.RECORDED, markersize=6, fillstyle="none", clip_on=False)
    axes.set_ylim(0.0, 1.05)
    axes.set_ylabel("share of chaos")
