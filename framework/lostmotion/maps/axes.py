"""The axes of a map: a name, two ends, a number of points, and how these are spaced."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import CaseError, nearest

SPACINGS = ("linear", "log", "inverse")
"""Evenly in the value, in its logarithm, or in one over it."""
MOST = 100_000
"""Points of one axis."""


@dataclass(frozen=True)
class MapAxis:
    """`count` points of the knob `name` from `low` to `high`."""

    name: str
    low: float
    high: float
    count: int
    spacing: str = "linear"

    @property
    def values(self) -> Array:
        """The points (count,)."""
        low, high = warped(np.array([self.low, self.high]), self.spacing).tolist()
        even = np.linspace(low, high, self.count)
        points = np.exp(even) if self.spacing == "log" else warped(even, self.spacing)
        points[0], points[-1] = self.low, self.high
        return points

    def finer(self, levels: int) -> MapAxis:
        """Return the axis with each interval halved `levels` times; its old points are among the new ones."""
        return replace(self, count=(self.count - 1) * 2**levels + 1)

    def as_text(self) -> str:
        """Return the axis as it is written on the command line."""
        return f"{self.name}={self.low!r}:{self.high!r}:{self.count}:{self.spacing}"


def warped(values: Array, spacing: str) -> Array:
    """Return the values in the scale in which an axis of this spacing is even."""
    if spacing == "log":
        return np.log(values)
    return 1.0 / values if spacing == "inverse" else values


def axis_of(text: str) -> MapAxis:
    """Return the axis that `NAME=LOW:HIGH:N[:log|inverse]` stands for; the ends are values of the knob itself."""
    name, equals, rest = (part.strip() for part in text.partition("="))
    parts = [part.strip() for part in rest.split(":")]
    if not equals or not name or len(parts) not in (3, 4):
        raise CaseError(f"the axis {text!r} is not understood: write NAME=LOW:HIGH:N, or NAME=LOW:HIGH:N:inverse")
    spacing = parts[3] if len(parts) == 4 else "linear"
    if spacing not in SPACINGS:
        raise CaseError(f"axis {name} has the spacing {spacing!r}{nearest(spacing, SPACINGS)}: it is log or inverse")
    return checked(MapAxis(name, _number(parts[0], name), _number(parts[1], name), _count(parts[2], name), spacing))


def checked(axis: MapAxis) -> MapAxis:
    """Return the axis, or raise `CaseError` when its ends or its count make no axis."""
    alone = axis.count == 1 and axis.low == axis.high
    if not (alone or (axis.low < axis.high and 2 <= axis.count <= MOST)):
        raise CaseError(
            f"axis {axis.name} has {axis.count} points from {axis.low:g} to {axis.high:g}: wanted 2 to {MOST} points, "
            "the lower end first"
        )
    if axis.spacing != "linear" and axis.low <= 0.0:
        raise CaseError(f"axis {axis.name} begins at {axis.low:g}: spaced by {axis.spacing} it must lie above zero")
    return axis


def _number(text: str, name: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise CaseError(f"an end of axis {name} is {text!r}: wanted a finite number")
    return value


def _count(text: str, name: str) -> int:
    if not text.isdecimal():
        raise CaseError(f"the number of points of axis {name} is {text!r}: wanted a whole number, such as 64")
    return int(text)
