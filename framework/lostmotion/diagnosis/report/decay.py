"""Figure: damping and frequency of a free decay over its amplitude, of the recording and of models."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.report import style
from lostmotion.report.words import Scale, with_unit
from lostmotion.results import Array
from lostmotion.results.behaviour import DecayCycles

WIDE = 8.0
"""Ratio of amplitudes from which on their axis is logarithmic."""
OUTER = (2.0, 98.0)
"""Percentiles of the measured values between which they are shown at least: the last cycles scatter widely."""
ROOM = 0.6
FEW = 80
"""Cycles of a decay up to which its dots are drawn large."""


def draw(evidence: Evidence) -> Figure | None:
    """Return the figure of the decays of a diagnosis, or None where none was measured."""
    decays = evidence.result.decay
    if decays is None:
        return None
    measured, before, after = (_whole(one) for one in (decays.measured, decays.before, decays.after))
    quantity, unit = f"{evidence.result.response.quantity} amplitude", decays.unit or evidence.response_unit
    return draw_cycles(measured, before, after, quantity=quantity, unit=unit)


def caption(evidence: Evidence) -> str:
    """Return what to see in the figure of the decays of a diagnosis."""
    decays = evidence.result.decay
    return caption_of(len(_whole(decays.measured)) if decays else 0, struck=not evidence.result.drive.free)


def words(evidence: Evidence) -> str:
    """Return what a diagnosis says of free decays, or why it measured none; an empty string where it says nothing."""
    return evidence.result.decay.says if evidence.result.decay else ""


def _whole(decays: Sequence[DecayCycles] | None) -> list[DecayCycles]:
    """Return the decays that have cycles, and lists of one length."""
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

    There is a curve for each hit; `unit` is that of the amplitudes, whose name on the axis is `quantity`.
    """
    if not measured:
        return None
    scale = style.scale_of(np.concatenate([curve.amplitude for curve in measured]), unit)
    figure = style.blank(3.2)
    left, right = figure.subplots(1, 2)
    groups = (
        ("recording", style.RECORDED, measured),
        ("model" if not after else "model before", style.BEFORE if after else style.AFTER, before),
        ("model after", style.AFTER, after),
    )
    for axes, field, name in ((left, "decrement", "logarithmic decrement"), (right, "frequency", "frequency (Hz)")):
        for words, colour, curves in groups:
            _draw(axes, curves, field, scale, colour=colour, words=words)
        shown = np.concatenate([getattr(curve, field) for curve in measured])
        _limit(axes, shown, [np.array(getattr(curve, field)) for curve in (*before, *after)])
        _finish(axes, scale.factor * np.concatenate([curve.amplitude for curve in measured]))
        axes.set_xlabel(with_unit(quantity, scale.unit))
        axes.set_ylabel(name)
    style.legend_above(figure, left)
    return figure


def caption_of(decays: int = 1, *, struck: bool = True) -> str:
    """Return what to see in the figure of so many decays, after hits of a hammer if the machine was `struck`."""
    which = f"of {decays} decays" if decays > 1 else "of the decay"
    after = (", one after each hit" if decays > 1 else " after the hit") if struck else ""
    return (
        f"Each dot is a cycle {which}{after}, lines are free runs of the model from the same start: time runs from "
        "right to left. Viscous damping and a linear spring give level lines. A decrement that rises to the left is "
        "dry friction, or viscous damping under a spring that hardens; one that rises to the right, drag or a joint "
        "that slips. A frequency that rises to the right is a spring that hardens with the amplitude, one that falls "
        "there a spring that softens. Where the motion dies within a few cycles, frequencies are blurred."
    )


def _draw(axes: Axes, curves: Sequence[DecayCycles], field: str, scale: Scale, *, colour: str, words: str) -> None:
    """Draw measured cycles as dots and those of models as lines."""
    is_measured = colour == style.RECORDED
    for count, curve in enumerate(curves):
        axes.plot(
            scale.factor * np.array(curve.amplitude),
            getattr(curve, field),
            "." if is_measured else "-",
            color=colour,
            markersize=6.0 if len(curve.amplitude) < FEW else 3.5,
            alpha=0.55 if is_measured else 1.0,
            linewidth=1.8,
            label=None if count else words,
        )


def _limit(axes: Axes, measured: Array, models: list[Array]) -> None:
    """Leave out cycles far from all others, and models that run away."""
    low, high = np.nanpercentile(measured, OUTER)
    kept = measured[(measured >= low - ROOM * (high - low)) & (measured <= high + ROOM * (high - low))]
    axes.set_ylim(style.framed(kept if kept.size else measured, models, ROOM))


def _finish(axes: Axes, amplitude: Array) -> None:
    style.few_ticks(axes)
    low, high = float(np.nanmin(amplitude)), float(np.nanmax(amplitude))
    if low > 0.0 and high > WIDE * low:
        axes.set_xscale("log")
        axes.set_xlim(low / 1.15, high * 1.15)
        style.log_ticks(axes.xaxis)
