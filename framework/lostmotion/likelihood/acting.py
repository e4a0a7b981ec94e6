"""The input that acts in place of a recorded one, after terms of the drive and delays of a sensor are applied."""

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


def evaluate_order(u: Input, order: int, t: Array) -> Array:
    """Return the input of an order (0 value, 1 derivative) at times (s)."""
    return u(t, order)


def apply_term(term: DriveTerm | SensorTerm, u: Input, p: tuple[float, ...], since: float) -> Input:
    """Return an input after one term that acts from `since` (s) on; a late sensor shows the effect of earlier input."""
    if isinstance(term, DriveTerm):
        if since <= ALWAYS:
            return lambda t, order: term.true(u, t, p, order)
        return lambda t, order: np.where(t < since, u(t, order), term.true(u, t, p, order))
    late = term.delay(p)
    return (lambda t, order: u(t - late, order)) if late else u
