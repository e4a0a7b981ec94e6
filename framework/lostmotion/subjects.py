"""The data that a method receives: a recorded series, or a model as a flow. Import them from `lostmotion.contracts`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from lostmotion.results import Embedding
from lostmotion.results.behaviour import DimensionInterval, Distance

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Series:
    """One recorded channel: `x` (n,) sampled every `dt` s, its `embedding`, and the `period` (s) of its drive.

    `period` is None where nothing drives the machine or the period is unknown. The framework has checked that `x` is
    finite, not constant, centred and in double precision. Exact repeats do occur, since encoders produce them.
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
    """An orbit of a model over some periods: states (periods + 1, n) in SI units, and tangent growth (periods, k).

    A row of `growth` holds the natural logarithms of the growth factors in one period, the fastest direction first.
    `status` is "ok" or another of `results.STATUSES`. The rows after a divergence are NaN.
    """

    states: Array
    growth: Array
    status: str = "ok"


@dataclass(frozen=True, eq=False)
class Motions:
    """The motions of a diagnosis: "recorded", and free runs "before" and, with an augmented model, "after".

    `states` (samples, n) begin with position and velocity; `responses` (samples,) are readings of the first sensor, NaN
    where one was lost. `exponents` (1/s) are the largest ones of the models. `dt` is in s; `period` is in samples, or
    None without a drive. `noise` is the standard deviation of the noise of the recorded response.
    """

    states: Mapping[str, Array]
    responses: Mapping[str, Array]
    exponents: Mapping[str, float]
    dt: float
    period: float | None
    noise: float


@dataclass(frozen=True)
class Attractors:
    """Distances and dimensions by name: "before", and "after" if there is an augmented model.

    The distance "noise_floor" is that between the halves of the recording; the dimension "recorded" is that of the
    recording. `stroboscopic` states whether sections are compared, one point for each period of the drive.
    """

    distances: Mapping[str, Distance]
    dimensions: Mapping[str, DimensionInterval]
    stroboscopic: bool

    @classmethod
    def refused(cls, status: str, says: str) -> Attractors:
        """Return measures without values, with the reason."""
        nothing = math.nan
        distance, dimension = (
            Distance(nothing, nothing, status),
            DimensionInterval(nothing, nothing, nothing, status, says),
        )
        names = ("before", "after")
        return cls(
            dict.fromkeys((*names, "noise_floor"), distance), dict.fromkeys((*names, "recorded"), dimension), False
        )


class Flow(Protocol):
    """A model with fixed parameters under a periodic drive: its stroboscopic map with tangent vectors.

    Without a drive, `period` is a time chosen by the caller. `driven` tells that the phase of a drive is one more
    direction of the flow, with the exponent zero.
    """

    @property
    def period(self) -> float:
        """The time (s) between two stroboscopic samples: the period of the drive, or a chosen time without one."""

    @property
    def driven(self) -> bool:
        """Whether a periodic drive acts on the machine."""

    @property
    def states(self) -> tuple[str, ...]:
        """The names of the states, (n,)."""

    @property
    def start(self) -> Array:
        """The state (n,) in which an orbit begins by default, in SI units."""

    def strobe(self, start: Array, *, periods: int, tangents: int) -> Orbit:
        """Return the orbit from `start` (n,) at drive phase 0, with `tangents` tangent vectors kept orthogonal.

        Nothing is raised where the orbit diverges: `Orbit.status` tells it.
        """


Data = TypeVar("Data", Series, Flow)
"""The data that a quantifier reads: a `Series`, or a `Flow`."""
