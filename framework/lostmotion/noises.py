"""The kind of plugin `Noise`: measurement noise of a sensor, a small linear state-space block that the filter appends.

A reading is the value of the channel, plus `shown` times the states of the noise, plus white noise of the variance
`white`. The states begin with the covariance `first`; from sample to sample they are multiplied by `transition`, and
noise of the covariance `driving` is added. Stamps that jitter by the variance `clock` (s^2) add white noise of the
variance `clock` times the square of the modelled speed of the channel. All noises of a sensor add up.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple

import numpy as np

from lostmotion.errors import CaseError, nearest
from lostmotion.parts import Array, Values
from lostmotion.results import percent, rounded

SHORTEST, LONGEST = 0.7, 0.5
"""Bounds on the memory of noise: at least this many samples, and at most this share of the natural time of the motion.
Slower noise cannot be distinguished from motion of the machine, or from drift."""
LASTING = 3.0
"""A memory of this many samples is allowed at any sampling rate."""
NOISE, AR1_LEVEL, AR1_MEMORY = "log_noise", "log_slow_noise", "log_noise_memory"
"""The logarithms of the size of white noise, and of size and correlation time (s) of AR(1) noise."""


class SensorScales(NamedTuple):
    """What a sensor shows: log of the standard deviation of its white noise, deviation and rms speed of its readings.

    In the unit of the channel, and per second. `dt` is the time between samples, `time` the natural time of the motion,
    `span` the length of the recording (s).
    """

    log_noise: float
    size: float
    speed: float
    dt: float
    time: float
    span: float


class NoiseParameter(NamedTuple):
    """A parameter of a noise: `name` begins with `log_noise` and an underscore; all numbers are natural logarithms.

    `low` and `high` are bounds. The prior is uniform between them, or normal with `mean` and `sd`. `unit` is that of
    the number itself, empty for the unit of the channel.
    """

    name: str
    start: float
    low: float
    high: float
    mean: float = 0.0
    sd: float = math.inf
    unit: str = ""


def _no_states() -> Array:
    return np.zeros((0, 0))


@dataclass(frozen=True)
class NoiseBlock:
    """A noise of m states at some parameters: variances of white noise and of stamps (s^2), and its matrices (m, m).

    `shown` (m,) is what each state adds to the reading.
    """

    white: float = 0.0
    clock: float = 0.0
    shown: Array = field(default_factory=lambda: np.zeros(0))
    transition: Array = field(default_factory=_no_states)
    driving: Array = field(default_factory=_no_states)
    first: Array = field(default_factory=_no_states)

    @classmethod
    def join(cls, blocks: Sequence[NoiseBlock]) -> NoiseBlock:
        """Return the sum of independent noises."""
        if len(blocks) == 1:
            return blocks[0]
        shown = np.concatenate([b.shown for b in blocks])
        square = np.zeros((3, len(shown), len(shown)))
        end = 0
        for block in blocks:
            begin, end = end, end + len(block.shown)
            square[:, begin:end, begin:end] = block.transition, block.driving, block.first
        return cls(sum(b.white for b in blocks), sum(b.clock for b in blocks), shown, *square)

    def variance_after(self, samples: int) -> float:
        """Return the variance that the states add to a reading some samples after the first."""
        covariance, power, added = self.first, self.transition, self.driving
        while samples > 0:
            if samples % 2:
                covariance = power @ covariance @ power.T + added
            added = power @ added @ power.T + added
            power, samples = power @ power, samples // 2
        return float(self.shown @ covariance @ self.shown)

    def draw(self, speed: Array, rng: np.random.Generator) -> Array:
        """Return noise (samples,) of a sensor whose channel moves with a `speed` (samples,)."""
        count, states = len(speed), len(self.shown)
        noise = math.sqrt(self.white) * rng.standard_normal(count)
        if self.clock:
            noise += math.sqrt(self.clock) * speed * rng.standard_normal(count)
        if not states:
            return noise
        fresh = rng.multivariate_normal(np.zeros(states), self.driving, count, method="svd")
        state = rng.multivariate_normal(np.zeros(states), self.first, method="svd")
        for k in range(count):
            noise[k] += self.shown @ state
            state = self.transition @ state + fresh[k]
        return noise


class Noise(ABC):
    """Noise of a sensor, in addition to the white noise that every sensor has, named in a case: `noise = "ar1"`.

    `states` names the states of its block. `plugins/template` has a complete example.
    """

    name: ClassVar[str]
    paper: ClassVar[str]
    states: ClassVar[tuple[str, ...]] = ()

    @abstractmethod
    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return the parameters that are estimated; all are positive and estimated as logarithms."""

    @abstractmethod
    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return the block at the values `p` of the parameters, for samples `dt` s apart."""

    def words(self, p: Values, share: float) -> str:
        """Return a sentence for the report, or nothing; `share` of the variance of all noise of the sensor is this one.

        Where there are several sensors, it stands behind the name of the sensor and a colon.
        """
        return ""


@dataclass(frozen=True)
class White(Noise):
    """Noise that is independent from sample to sample."""

    name = "white"
    paper = "Wiener, Extrapolation, Interpolation and Smoothing of Stationary Time Series, MIT Press (1949)"

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return its size; the estimate from differences of readings is exceeded by a factor of 20 at most."""
        size = sensor.log_noise
        return (NoiseParameter(NOISE, size, size - 7.0, size + 3.0),)

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return a block without states."""
        return NoiseBlock(white=p[0] ** 2)


@dataclass(frozen=True)
class Quantised(White):
    """White noise of a sensor whose values are whole steps, which are found from the stored values."""

    name = "quantised"
    paper = "Bennett, Bell System Technical Journal 27 (1948) 446-472"


@dataclass(frozen=True)
class AR1(Noise):
    """Noise that is correlated in time: an autoregressive process of first order, as behind a filter."""

    name = "ar1"
    paper = "Uhlenbeck, Ornstein, Physical Review 36 (1930) 823-841"
    states = ("slow",)

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return size and correlation time (s)."""
        noise, dt = sensor.log_noise, sensor.dt
        low, high = math.log(SHORTEST * dt), math.log(max(LONGEST * sensor.time, LASTING * dt))
        middle = min(math.log(3.0 * dt), high)
        return (
            NoiseParameter(AR1_LEVEL, noise - 0.5, noise - 5.0, noise + 3.0),
            NoiseParameter(AR1_MEMORY, middle, low, high, mean=middle, sd=1.0, unit="s"),
        )

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return a stationary block of one state."""
        variance, kept = np.array([[p[0] ** 2]]), math.exp(-dt / p[1])
        return NoiseBlock(
            shown=np.ones(1), transition=np.array([[kept]]), driving=(1.0 - kept**2) * variance, first=variance
        )

    def words(self, p: Values, share: float) -> str:
        """Return share and time constant."""
        return (
            f"{percent(share)} of the variance of the measurement noise is autocorrelated, with a time constant of"
            f" {rounded(p[1])} s; the fit includes this."
        )


BASIC: dict[str, type[Noise]] = {noise.name: noise for noise in (White, AR1, Quantised)}
"""The noises that need no plugin."""


def make_basic(name: str) -> Noise:
    """Return a noise that needs no plugin; `CaseError` for an unknown name."""
    if name not in BASIC:
        raise CaseError(f"there is no noise {name!r}{nearest(name, BASIC)}: expected one of {', '.join(BASIC)}")
    return BASIC[name]()
