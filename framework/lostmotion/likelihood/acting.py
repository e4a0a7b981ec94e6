"""What acts in place of a recorded input, once terms of the drive and delays of a sensor have had their way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array, DriveTerm, Input, SensorTerm
from lostmotion.likelihood.layout import ALWAYS

Column = Callable[[Array], Array]
"""An input as a function of time (s)."""


@dataclass(frozen=True)
class Recorded:
    """A recorded input as terms see it: its value (order 0) and its derivative (order 1) at times (s)."""

    columns: tuple[Column, ...]

    def __call__(self, t: Array, order: int) -> Array:
        """Return the value (order 0) or the derivative (order 1) at times (s)."""
        return self.columns[order](t)


def of_order(u: Input, order: int, t: Array) -> Array:
    """Return the input of some order at times (s)."""
    return u(t, order)


def through(term: DriveTerm | SensorTerm, u: Input, p: tuple[float, ...], since: float) -> Input:
    """Return an input after one term, from a time (s) on; a sensor that is late sees what an earlier input has done."""
    if isinstance(term, DriveTerm):
        if since <= ALWAYS:
            return lambda t, order: term.true(u, t, p, order)
        return lambda t, order: np.where(t < since, u(t, order), term.true(u, t, p, order))
    late = term.delay(p)
    return (lambda t, order: u(t - late, order)) if late else u
