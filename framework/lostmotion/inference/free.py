"""What is free: a parameter with its prior, and which coordinate stands for what in which recording."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array

RANDOM = "log_random_force"
NOISE = "log_noise"
PACE = "log_random_pace"
OFFSET = "offset"
SLOW = "log_slow_noise"
FADE = "log_noise_memory"
LEVELS = (RANDOM, NOISE, PACE, OFFSET, SLOW, FADE)
"""The free parameters that are no physics: intensity and pace of a random force, the measurement noise, the zero of
the response sensor, and measurement noise with a memory: its size and how long it lasts (s)."""
_UNIT = NormalDist()


def parted(key: str) -> tuple[str, str | None]:
    """Return the parameter and the recording of a key such as `c[run 1]`; no recording where all share it."""
    parameter, bracket, recording = key.partition("[")
    return (parameter, recording[:-1]) if bracket else (key, None)


def keys_of(parameter: str, recordings: Sequence[str]) -> tuple[str, ...]:
    """Return the keys of a parameter that each recording has for itself: `c[run 1]`, or `c` if there is only one."""
    return tuple(f"{parameter}[{name}]" for name in recordings) if len(recordings) > 1 else (parameter,)


@dataclass(frozen=True)
class Free:
    """A parameter to be estimated, in the coordinate in which its prior is simple.

    `log` says that the coordinate is the logarithm. The prior is uniform between `low` and `high` (coordinate), or
    normal with `mean` and `sd` and cut there. `straight` says that one-step errors are close to linear in it.
    """

    key: str
    unit: str
    start: float
    low: float
    high: float
    log: bool = False
    mean: float = 0.0
    sd: float = math.inf
    straight: bool = False

    @property
    def pull(self) -> float:
        """The information that the prior adds about the coordinate: none if it is uniform."""
        return 1.0 / self.sd**2 if math.isfinite(self.sd) else 0.0

    @property
    def parameter(self) -> str:
        """The key without the recording."""
        return parted(self.key)[0]

    @property
    def recording(self) -> str | None:
        """The name of the recording that has this parameter for itself; None where all share it."""
        return parted(self.key)[1]

    def value(self, coordinate: float) -> float:
        """Return the parameter at a coordinate."""
        return math.exp(coordinate) if self.log else coordinate

    def coordinate(self, value: float) -> float:
        """Return the coordinate of a parameter, clipped into the bounds."""
        raw = math.log(max(value, 1e-300)) if self.log else value
        return min(max(raw, self.low), self.high)

    def log_prior(self, coordinate: float) -> float:
        """Return the normalised log prior density of the coordinate."""
        if not self.low <= coordinate <= self.high:
            return -math.inf
        if math.isinf(self.sd):
            return -math.log(self.high - self.low)
        first, last = self._below
        z = (coordinate - self.mean) / self.sd
        return -0.5 * z * z - math.log(self.sd * math.sqrt(2.0 * math.pi) * max(abs(last - first), 1e-300))

    def quantile(self, share: float) -> float:
        """Return the coordinate below which lies the given share (0 to 1) of the prior, its cut included."""
        if math.isinf(self.sd):
            return self.low + share * (self.high - self.low)
        first, last = self._below
        below = first + share * (last - first)
        if not 0.0 < below < 1.0:
            return self.low if share < 0.5 else self.high
        return min(max(self.mean + self._side * self.sd * _UNIT.inv_cdf(below), self.low), self.high)

    @property
    def _side(self) -> float:
        """Where the shares of the prior are counted from: below, or above where only the upper tail is left."""
        return 1.0 if self.low <= self.mean else -1.0

    @property
    def _below(self) -> tuple[float, float]:
        """The shares of the whole normal distribution that lie beyond `low` and `high`, seen from `_side`."""
        first, last = (self._side * (end - self.mean) / self.sd / math.sqrt(2) for end in (self.low, self.high))
        return 0.5 * math.erfc(-first), 0.5 * math.erfc(-last)


@dataclass(frozen=True)
class Scales:
    """The natural sizes of a recorded motion, as amplitudes: generalised force, length, time.

    `usual` is the log intensity (N^2 s) of the random force that the usual noise of a measured excitation makes;
    `span` is the length of the recording, in s.
    """

    force: float
    length: float
    time: float
    usual: float = 0.0
    span: float = 1.0

    @property
    def velocity(self) -> float:
        """The amplitude of the velocity."""
        return self.length / self.time


@dataclass(frozen=True)
class Route:
    """Which coordinates stand for each parameter in one recording; several stand for it by their mean.

    They are several where a recording is predicted that has no value of its own: the others stand in for it.
    """

    columns: Mapping[str, tuple[int, ...]]
    count: int

    @classmethod
    def of(cls, keys: Sequence[str], recording: str) -> Route:
        """Return the route of the recording with that name."""
        own: dict[str, tuple[int, ...]] = {}
        others: dict[str, tuple[int, ...]] = {}
        for i, key in enumerate(keys):
            parameter, name = parted(key)
            table = own if name in (None, recording) else others
            table[parameter] = (*table.get(parameter, ()), i)
        return cls({**others, **own}, len(keys))

    def at(self, theta: Array, parameter: str) -> float:
        """Return the coordinate of a parameter; `KeyError` where it is not free."""
        columns = self.columns[parameter]
        return float(theta[columns[0]]) if len(columns) == 1 else float(np.mean(theta[list(columns)]))

    @cached_property
    def used(self) -> NDArray[np.bool_]:
        """Which coordinates (count,) matter to the recording."""
        used = np.zeros(self.count, dtype=np.bool_)
        used[[i for columns in self.columns.values() for i in columns]] = True
        return used
