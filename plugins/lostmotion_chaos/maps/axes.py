"""The axes of a map: name, two ends, number of points, and spacing."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import CaseError, nearest

SPACINGS = ("linear", "log", "inverse")
"""Points are evenly spaced in the value, in its logarithm, or in its reciprocal."""
MAX_POINTS = 100_000
"""Largest number of points of one axis."""


@dataclass(frozen=True)
class MapAxis:
    """`count` points of the swept quantity `name` from `low` to `high`."""

    name: str
    low: float
    high: float
    count: int
    spacing: str = "linear"

    @property
    def values(self) -> Array:
        """The points (count,)."""
        low, high = scale_values(np.array([self.low, self.high]), self.spacing).tolist()
        even = np.linspace(low, high, self.count)
        points = np.exp(even) if self.spacing == "log" else scale_values(even, self.spacing)
        points[0], points[-1] = self.low, self.high
        return points

    def refine(self, levels: int) -> MapAxis:
        """Return the axis with each interval halved `levels` times; the old points are among the new ones."""
        return replace(self, count=(self.count - 1) * 2**levels + 1)

    def as_text(self) -> str:
        """Return the axis in the form of the command line."""
        return f"{self.name}={self.low!r}:{self.high!r}:{self.count}:{self.spacing}"


def scale_values(values: Array, spacing: str) -> Array:
    """Return the values in the scale in which an axis with this spacing has evenly spaced points."""
    if spacing == "log":
        return np.log(values)
    return 1.0 / values if spacing == "inverse" else values


def parse_axis(text: str) -> MapAxis:
    """Return the axis that `NAME=LOW:HIGH:N[:log|inverse]` describes; the ends are values of the quantity itself."""
    name, equals, rest = (part.strip() for part in text.partition("="))
    parts = [part.strip() for part in rest.split(":")]
    if not equals or not name or len(parts) not in (3, 4):
        raise CaseError(f"the axis {text!r} is not understood: write NAME=LOW:HIGH:N, or NAME=LOW:HIGH:N:inverse")
    spacing = parts[3] if len(parts) == 4 else "linear"
    if spacing not in SPACINGS:
        raise CaseError(f"axis {name} has the spacing {spacing!r}{nearest(spacing, SPACINGS)}: it is log or inverse")
    return check_axis(
        MapAxis(
            name, _parse_number(parts[0], name), _parse_number(parts[1], name), _parse_count(parts[2], name), spacing
        )
    )


def check_axis(axis: MapAxis) -> MapAxis:
    """Return the axis, or raise `CaseError` when its ends or its number of points are not usable."""
    alone = axis.count == 1 and axis.low == axis.high
    if not (alone or (axis.low < axis.high and 2 <= axis.count <= MAX_POINTS)):
        raise CaseError(
            f"axis {axis.name} has {axis.count} points from {axis.low:g} to {axis.high:g}: expected 2 to {MAX_POINTS} "
            "points, the lower end first"
        )
    if axis.spacing != "linear" and axis.low <= 0.0:
        raise CaseError(f"axis {axis.name} begins at {axis.low:g}: with {axis.spacing} spacing it must lie above zero")
    return axis


def _parse_number(text: str, name: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise CaseError(f"an end of axis {name} is {text!r}: expected a finite number")
    return value


def _parse_count(text: str, name: str) -> int:
    if not text.isdecimal():
        raise CaseError(f"the number of points of axis {name} is {text!r}: expected a whole number, such as 64")
    return int(text)
