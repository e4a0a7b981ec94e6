"""What a method is handed: a recorded series, or a model as a flow. Plugins import them from `lostmotion.contracts`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from lostmotion.results import Embedding

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Series:
    """One recorded channel: `x` (n,) sampled every `dt` s, how it is embedded, and the period (s) of its drive.

    `period` is None where nothing drives the machine, or nobody knows. The host has checked `x`: finite, not
    constant, centred, double precision. Exact repeats do occur, as every encoder gives them.
    """

    x: Array
    dt: float
    embedding: Embedding
    period: float | None = None

    @property
    def n(self) -> int:
        """The number of samples."""
        return len(self.x)


@dataclass(frozen=True, eq=False)
class Orbit:
    """A model followed for some periods: states (periods + 1, n), logarithms of tangent growth (periods, k).

    `growth` holds natural logarithms, the fastest direction first, one row to each period. `status` is "ok", or one
    of `results.STATUSES`, and what lies behind the end of a diverged orbit is NaN.
    """

    states: Array
    growth: Array
    status: str = "ok"


class Flow(Protocol):
    """A model with fixed parameters under a periodic drive, as its stroboscopic map with tangent vectors.

    `period` is the time (s) between two looks: that of the drive, or for a machine without one the time to be told.
    `states` names the entries of a state; `start` (n,) is where an orbit begins unless told otherwise. `driven` says
    that the phase of a drive is one more direction of the flow, whose exponent is zero.
    """

    @property
    def period(self) -> float:
        """The time (s) between two looks."""

    @property
    def driven(self) -> bool:
        """Whether a drive keeps the time."""

    @property
    def states(self) -> tuple[str, ...]:
        """The names of the states."""

    @property
    def start(self) -> Array:
        """The state (n,) in which an orbit begins."""

    def strobe(self, start: Array, *, periods: int, tangents: int) -> Orbit:
        """Return the orbit from `start` (n,) at drive phase 0, with `tangents` tangent vectors kept orthogonal."""


Data = TypeVar("Data", Series, Flow)
"""What a quantifier reads: a `Series`, or a `Flow`."""
