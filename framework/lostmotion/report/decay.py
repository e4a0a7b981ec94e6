"""Figure: damping and frequency of a free decay over its amplitude, of the recording and of models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lostmotion.report import style
from lostmotion.report.evidence import Evidence
from lostmotion.report.words import Scale, with_unit
from lostmotion.results import Array

WIDE = 8.0
"""Ratio of amplitudes from which on their axis is logarithmic."""
OUTER = (2.0, 98.0)
"""Percentiles of the measured values between which they are shown at least: the last cycles scatter widely."""
ROOM = 0.6
FEW = 80
"""Cycles of a decay up to which its dots are drawn large."""


class Curve(NamedTuple):
    """A decay, cycle by cycle: amplitude (unit of the signal), frequency (Hz) and logarithmic decrement, (cycles,)."""

    amplitude: Array
    frequency: Array
    decrement: Array


def figure_of(evidence: Evidence) -> Figure | None:
    """Return the figure of the decays of a diagnosis, or None where none was measured."""
    measured, before, after = (curves_of(evidence, name) for name in ("measured", "before", "after"))
    unit = str(evidence.fact("decay", "unit") or evidence.response_unit)
    return draw(measured, before, after, quantity=f"{evidence.response} amplitude", unit=unit)


def caption_of(evidence: Evidence) -> str:
    """Return what to see in the figure of the decays of a diagnosis."""
    return caption(len(curves_of(evidence, "measured")), struck=not evidence.fact("drive", "free"))


def words(evidence: Evidence) -> str:
    """Return what a diagnosis says of free decays, or why it measured none; an empty string where it says nothing."""
    return str(evidence.fact("decay", "says") or "")


def curves_of(evidence: Evidence, name: str) -> list[Curve]:
    """Return the decays of the recording ("measured") or of a model ("before", "after"), those of equal lists only."""
    found = []
    for entry in evidence.fact("decay", name) or []:
        lists = [entry.get(field) for field in Curve._fields] if isinstance(entry, Mapping) else []
        lengths = {len(one) if isinstance(one, list) else 0 for one in lists}
        if len(lengths) == 1 and lengths != {0}:
            found.append(Curve(*(np.array(one, dtype=float) for one in lists)))
    return found


def draw(
    measured: Sequence[Curve],
    before: Sequence[Curve] = (),
    after: Sequence[Curve] = (),
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
        _limit(axes, shown, [getattr(curve, field) for curve in (*before, *after)])
        _finish(axes, scale.factor * np.concatenate([curve.amplitude for curve in measured]))
        axes.set_xlabel(with_unit(quantity, scale.unit))
        axes.set_ylabel(name)
    style.legend_above(figure, left)
    return figure


def caption(decays: int = 1, *, struck: bool = True) -> str:
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


def _draw(axes: Axes, curves: Sequence[Curve], field: str, scale: Scale, *, colour: str, words: str) -> None:
    """Draw measured cycles as dots and those of models as lines."""
    is_measured = colour == style.RECORDED
    for count, curve in enumerate(curves):
        axes.plot(
            scale.factor * curve.amplitude,
            getattr(curve, field),
            "." if is_measured else "-",
            color=colour,
            markersize=6.0 if curve.amplitude.size < FEW else 3.5,
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
