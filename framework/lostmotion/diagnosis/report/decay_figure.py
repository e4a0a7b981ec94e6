"""Figure of free decays: damping and frequency over the amplitude, for the recording and the models."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report import style
from lostmotion.report.words import Scale, with_unit
from lostmotion.results import Array
from lostmotion.results.behaviour import DecayCycles

LOG_AXIS_RATIO = 8.0
"""The axis of amplitudes is logarithmic from this ratio of largest to smallest amplitude on."""
SHOWN_PERCENTILES = (2.0, 98.0)
"""Percentiles of the measured values that the axis always shows: the last cycles scatter widely."""
MARGIN = 0.6
LARGE_DOT_CYCLES = 80
"""The dots of a decay are large when it has fewer cycles than this."""


def draw(evidence: Evidence) -> Figure | None:
    """Return the figure of the free decays of a diagnosis, or None where none was measured."""
    decays = evidence.result.decay
    if decays is None:
        return None
    measured, before, after = (_select_complete(one) for one in (decays.measured, decays.before, decays.after))
    quantity, unit = f"{evidence.result.response.quantity} amplitude", decays.unit or evidence.response_unit
    return draw_cycles(measured, before, after, quantity=quantity, unit=unit)


def caption(evidence: Evidence) -> str:
    """Return the caption of the figure of free decays."""
    decays = evidence.result.decay
    return caption_cycles(
        len(_select_complete(decays.measured)) if decays else 0, struck=not evidence.result.drive.free
    )


def write_words(evidence: Evidence) -> str:
    """Return the sentences of a diagnosis about free decays, or an empty text."""
    return evidence.result.decay.says if evidence.result.decay else ""


def _select_complete(decays: Sequence[DecayCycles] | None) -> list[DecayCycles]:
    """Return the decays that have cycles and lists of equal length."""
    return [one for one in decays or () if len(one.amplitude) == len(one.frequency) == len(one.decrement) > 0]


def draw_cycles(
    measured: Sequence[DecayCycles],
    before: Sequence[DecayCycles] = (),
    after: Sequence[DecayCycles] = (),
    *,
    quantity: str = "amplitude",
    unit: str,
) -> Figure | None:
    """Return logarithmic decrement (left) and frequency (right) over the amplitude, or None without a decay.

    There is one curve for each decay; `unit` is the unit of the amplitudes and `quantity` their name on the axis.
    """
    if not measured:
        return None
    scale = style.scale_of(np.concatenate([curve.amplitude for curve in measured]), unit)
    figure = style.make_figure(3.2)
    left, right = figure.subplots(1, 2)
    groups = (
        ("recording", style.RECORDED, measured),
        ("model" if not after else "model before", style.BEFORE if after else style.AFTER, before),
        ("model after", style.AFTER, after),
    )
    for axes, field, name in ((left, "decrement", "logarithmic decrement"), (right, "frequency", "frequency (Hz)")):
        for words, colour, curves in groups:
            _draw_curves(axes, curves, field, scale, colour=colour, words=words)
        shown = np.concatenate([getattr(curve, field) for curve in measured])
        _limit_axis(axes, shown, [np.array(getattr(curve, field)) for curve in (*before, *after)])
        _format_axes(axes, scale.factor * np.concatenate([curve.amplitude for curve in measured]))
        axes.set_xlabel(with_unit(quantity, scale.unit))
        axes.set_ylabel(name)
    style.legend_above(figure, left)
    return figure


def caption_cycles(decays: int = 1, *, struck: bool = True) -> str:
    """Return the caption for this number of decays, after hits of a hammer if the machine was `struck`."""
    which = f"of {decays} decays" if decays > 1 else "of the decay"
    after = (", one after each hit" if decays > 1 else " after the hit") if struck else ""
    return (
        f"Each dot is a cycle {which}{after}; lines are free runs of the model from the same state. Time runs from "
        "right to left. Viscous damping and a linear spring give horizontal lines. A decrement that rises to the left "
        "indicates dry friction, or viscous damping with a hardening spring; one that rises to the right indicates "
        "drag or a slipping joint. A frequency that rises to the right indicates a hardening spring, one that falls to "
        "the right a softening spring. Where the motion decays within a few cycles, frequencies are inaccurate."
    )


def _draw_curves(
    axes: Axes, curves: Sequence[DecayCycles], field: str, scale: Scale, *, colour: str, words: str
) -> None:
    """Draw measured cycles as dots and those of the models as lines."""
    is_measured = colour == style.RECORDED
    for count, curve in enumerate(curves):
        axes.plot(
            scale.factor * np.array(curve.amplitude),
            getattr(curve, field),
            "." if is_measured else "-",
            color=colour,
            markersize=6.0 if len(curve.amplitude) < LARGE_DOT_CYCLES else 3.5,
            alpha=0.55 if is_measured else 1.0,
            linewidth=1.8,
            label=None if count else words,
        )


def _limit_axis(axes: Axes, measured: Array, models: list[Array]) -> None:
    """Set limits that leave out outlying cycles and diverging models."""
    low, high = np.nanpercentile(measured, SHOWN_PERCENTILES)
    kept = measured[(measured >= low - MARGIN * (high - low)) & (measured <= high + MARGIN * (high - low))]
    axes.set_ylim(style.limits_around(kept if kept.size else measured, models, MARGIN))


def _format_axes(axes: Axes, amplitude: Array) -> None:
    style.few_ticks(axes)
    low, high = float(np.nanmin(amplitude)), float(np.nanmax(amplitude))
    if low > 0.0 and high > LOG_AXIS_RATIO * low:
        axes.set_xscale("log")
        axes.set_xlim(low / 1.15, high * 1.15)
        style.log_ticks(axes.xaxis)
