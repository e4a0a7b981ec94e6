"""Free parameters with their priors, and the coordinates of each recording."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import betaln, stdtr, stdtrit

from lostmotion.contracts import Array
from lostmotion.noises import AR1_LEVEL, NOISE

RANDOM = "log_random_force"
PACE = "log_random_pace"
OFFSET = "offset"
LEVELS = (RANDOM, PACE, OFFSET, AR1_LEVEL)
"""Free parameters that are no physics, beside those of noise: intensity and decay rate of a random force, the offset of
the response sensor."""
_UNIT = NormalDist()


def split_key(key: str) -> tuple[str, str | None]:
    """Return the parameter and the recording of a key such as `c[run 1]`; no recording where all share it."""
    parameter, bracket, recording = key.partition("[")
    return (parameter, recording[:-1]) if bracket else (key, None)


def make_level_name(level: str, sensor: str, many: bool) -> str:
    """Return the name of a noise level of a sensor: `log_noise`, or `log_noise:name` where there are several."""
    return f"{level}:{sensor}" if many else level


def list_keys(parameter: str, recordings: Sequence[str]) -> tuple[str, ...]:
    """Return the keys of a parameter with a value for each recording: `c[run 1]`, or `c` if there is only one."""
    return tuple(f"{parameter}[{name}]" for name in recordings) if len(recordings) > 1 else (parameter,)


def _compute_fall(away: Any, tail: Any) -> Any:
    """Return the fall of a log density from its mean: `away` in units of its scale, `tail` degrees of freedom."""
    square = np.square(away)
    thick = np.isfinite(tail)
    degrees = np.where(thick, tail, 1.0)
    return np.where(thick, 0.5 * (degrees + 1.0) * np.log1p(square / degrees), 0.5 * square)


@dataclass(frozen=True)
class FreeParameter:
    """A parameter to be estimated, in the coordinate in which its prior is simple.

    `log` says that the coordinate is the logarithm. The prior is uniform between `low` and `high` (coordinate), or
    normal with `mean` and `sd` and truncated there. With a finite `tail` it is Student's t with so many degrees of
    freedom and the scale `sd`. `linear` says that the innovations are almost linear in it.
    """

    key: str
    unit: str
    start: float
    low: float
    high: float
    log: bool = False
    mean: float = 0.0
    sd: float = math.inf
    linear: bool = False
    tail: float = math.inf

    def prior_information(self, coordinate: float) -> float:
        """Return the information that the prior adds about the coordinate: zero if it is uniform.

        It is the slope of the log density over the distance from the mean, which is positive for Student's t, too.
        """
        if math.isinf(self.sd):
            return 0.0
        if math.isinf(self.tail):
            return 1.0 / self.sd**2
        return (self.tail + 1.0) / (self.tail * self.sd**2 + (coordinate - self.mean) ** 2)

    def evidence_information(self, coordinate: float) -> float:
        """Return the information of the prior in the evidence: that of a uniform one is one over its variance."""
        if math.isfinite(self.sd) or not self.high > self.low:
            return self.prior_information(coordinate)
        return 12.0 / (self.high - self.low) ** 2

    @property
    def parameter(self) -> str:
        """The key without the recording."""
        return split_key(self.key)[0]

    @property
    def recording(self) -> str | None:
        """The name of the recording that has this parameter to itself; None where all share it."""
        return split_key(self.key)[1]

    @property
    def physical(self) -> bool:
        """Whether it belongs to the machine: not to noise, to the random force or to the zero of a sensor."""
        return self.level not in LEVELS and not self.level.startswith(NOISE)

    @property
    def level(self) -> str:
        """The parameter without the sensor: `log_noise` of `log_noise:load encoder`."""
        return self.parameter.partition(":")[0]

    @property
    def sensor(self) -> str:
        """The sensor of a level, by its label; empty where it is the only one."""
        return self.parameter.partition(":")[2]

    def value(self, coordinate: Any) -> Any:
        """Return the parameter at a coordinate, or at an array of them."""
        if not self.log:
            return coordinate
        return np.exp(coordinate) if isinstance(coordinate, np.ndarray) else math.exp(coordinate)

    def coordinate(self, value: float) -> float:
        """Return the coordinate of a parameter, clipped into the bounds."""
        raw = math.log(max(value, 1e-300)) if self.log else value
        return min(max(raw, self.low), self.high)

    @cached_property
    def log_top(self) -> float:
        """The log prior density where it is uniform, or at the mean of a normal one, normalised within the bounds."""
        if math.isinf(self.sd):
            return -math.log(self.high - self.low)
        first, last = self._below
        top = 0.5 * math.log(2.0 * math.pi)
        if math.isfinite(self.tail):
            top = 0.5 * math.log(self.tail) + float(betaln(0.5, 0.5 * self.tail))
        return -top - math.log(self.sd * max(abs(last - first), 1e-300))

    def log_prior(self, coordinate: float) -> float:
        """Return the normalised log prior density of the coordinate."""
        if not self.low <= coordinate <= self.high:
            return -math.inf
        if math.isinf(self.sd):
            return self.log_top
        return self.log_top - float(_compute_fall((coordinate - self.mean) / self.sd, self.tail))

    def quantile(self, share: float) -> float:
        """Return the coordinate below which the given share (0 to 1) of the truncated prior lies."""
        if math.isinf(self.sd):
            return self.low + share * (self.high - self.low)
        first, last = self._below
        below = first + share * (last - first)
        if not 0.0 < below < 1.0:
            return self.low if share < 0.5 else self.high
        away = float(stdtrit(self.tail, below)) if math.isfinite(self.tail) else _UNIT.inv_cdf(below)
        return min(max(self.mean + self._side * self.sd * away, self.low), self.high)

    @property
    def _side(self) -> float:
        """The tail from which the shares of the prior are counted: the lower, or the upper where only that is left."""
        return 1.0 if self.low <= self.mean else -1.0

    @property
    def _below(self) -> tuple[float, float]:
        """The shares of the whole distribution below `low` and `high`, counted from `_side`."""
        first, last = (self._side * (end - self.mean) / self.sd for end in (self.low, self.high))
        if math.isfinite(self.tail):
            return float(stdtr(self.tail, first)), float(stdtr(self.tail, last))
        return 0.5 * math.erfc(-first / math.sqrt(2)), 0.5 * math.erfc(-last / math.sqrt(2))


@dataclass(frozen=True)
class Scales:
    """The natural sizes of a recorded motion, as amplitudes: generalised force, length, time.

    `usual` is the log intensity (N^2 s) of the random force that the usual noise of a measured excitation makes; `span`
    is the length of the recording, in s, and `nyquist` half its sampling rate, in Hz.
    """

    force: float
    length: float
    time: float
    usual: float = 0.0
    span: float = 1.0
    nyquist: float = math.inf

    @property
    def velocity(self) -> float:
        """The amplitude of the velocity."""
        return self.length / self.time


@dataclass(frozen=True)
class ParameterSpace:
    """The free parameters in order; coordinates are vectors, (count,), or many of them, (points, count)."""

    free: tuple[FreeParameter, ...]

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The keys of the free parameters."""
        return tuple(f.key for f in self.free)

    @cached_property
    def start(self) -> Array:
        """The coordinates to start from."""
        return np.array([f.start for f in self.free])

    @cached_property
    def low(self) -> Array:
        """The lower bounds of the coordinates."""
        return np.array([f.low for f in self.free])

    @cached_property
    def high(self) -> Array:
        """The upper bounds of the coordinates."""
        return np.array([f.high for f in self.free])

    @cached_property
    def widths(self) -> Array:
        """The width of each prior: its standard deviation, or the distance between its bounds."""
        return np.array([min(f.sd, f.high - f.low) for f in self.free])

    def clip(self, theta: Array) -> Array:
        """Return coordinates moved into their bounds."""
        return np.clip(theta, self.low, self.high)

    def values(self, theta: Array) -> dict[str, Any]:
        """Return the parameters by key at coordinates."""
        return {f.key: f.value(theta[..., i]) for i, f in enumerate(self.free)}

    def log_prior(self, theta: Array) -> Any:
        """Return the log prior density at one point, or at many (points,)."""
        found = np.where(np.all((theta >= self.low) & (theta <= self.high), axis=-1), self._height, -math.inf)
        if len(self._bells):
            away = (theta[..., self._bells] - self._means) / self._sds
            found = found - np.sum(_compute_fall(away, self._tails), axis=-1)
        return found if found.ndim else float(found)

    @cached_property
    def _bells(self) -> NDArray[np.intp]:
        return np.array([i for i, f in enumerate(self.free) if math.isfinite(f.sd)], dtype=np.intp)

    @cached_property
    def _means(self) -> Array:
        return np.array([self.free[i].mean for i in self._bells])

    @cached_property
    def _sds(self) -> Array:
        return np.array([self.free[i].sd for i in self._bells])

    @cached_property
    def _tails(self) -> Array:
        return np.array([self.free[i].tail for i in self._bells])

    @cached_property
    def _height(self) -> float:
        """The log density of all priors together, each normal one at its mean."""
        return math.fsum(f.log_top for f in self.free)


@dataclass(frozen=True)
class RecordingCoordinates:
    """The coordinates of each parameter in one recording; where there are several, their mean is used.

    There are several where a recording without values of its own is predicted from the other recordings.
    """

    columns: Mapping[str, tuple[int, ...]]
    count: int

    @classmethod
    def of(cls, keys: Sequence[str], recording: str) -> RecordingCoordinates:
        """Return the coordinates of the recording with that name."""
        own: dict[str, tuple[int, ...]] = {}
        others: dict[str, tuple[int, ...]] = {}
        for i, key in enumerate(keys):
            parameter, name = split_key(key)
            table = own if name in (None, recording) else others
            table[parameter] = (*table.get(parameter, ()), i)
        return cls({**others, **own}, len(keys))

    def at(self, theta: Array, parameter: str) -> Any:
        """Return the coordinate of a parameter at one point (count,), or at many (points, count).

        `KeyError` where it is not free.
        """
        columns = self.columns[parameter]
        if len(columns) == 1:
            return theta[..., columns[0]]
        return np.mean(theta[..., list(columns)], axis=-1)

    @cached_property
    def used(self) -> NDArray[np.bool_]:
        """Which coordinates (count,) the recording depends on."""
        used = np.zeros(self.count, dtype=np.bool_)
        used[[i for columns in self.columns.values() for i in columns]] = True
        return used
