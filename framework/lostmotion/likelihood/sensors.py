"""Sensors: each sees one channel of the model, with noise of its own."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array
from lostmotion.noises import Noise, Quantised, White


@dataclass(frozen=True)
class Sensor:
    """A sensor: a `channel` of the model, under a `name`, with noises that add up, white noise first.

    Gain, offset and delay of a sensor are parameters like others, and no fields. The zero of a `loose` one is unknown.
    """

    channel: str
    name: str = ""
    noises: tuple[Noise, ...] = (White(),)
    loose: bool = False

    @property
    def noise_states(self) -> int:
        """The number of states of all its noises."""
        return sum(len(noise.states) for noise in self.noises)

    @property
    def quantised(self) -> bool:
        """Whether its readings are known to be whole steps."""
        return any(isinstance(noise, Quantised) for noise in self.noises)

    @property
    def place(self) -> str:
        """Where terms of this sensor act: at its name, or at "sensor" where it is the only one and has none."""
        return self.name or "sensor"

    @property
    def label(self) -> str:
        """The name, or the channel where it has none."""
        return self.name or self.channel


FLATTEST = 0.1
"""A sensor shows at least this share of a change of the value: a reading that folds back cannot be undone."""


class SensorChange(NamedTuple):
    """A sensor that shows `gain` times the value plus `offset` (unit of the channel) from a time `since` (s) on."""

    gain: float
    offset: float
    since: float

    def apply(self, shown: Array, time: Array) -> Array:
        """Return what the sensor shows (samples,) in place of `shown` at these times (samples,)."""
        return np.where(time < self.since, shown, self.gain * shown + self.offset)

    def undo(self, readings: Array, time: Array) -> tuple[Array, Array]:
        """Return the readings (samples,) without the change, and their slope with respect to those with it."""
        gain = max(abs(self.gain), FLATTEST) * (-1.0 if self.gain < 0.0 else 1.0)
        before = time < self.since
        return np.where(before, readings, (readings - self.offset) / gain), np.where(before, 1.0, 1.0 / abs(gain))


def measure_white_noise(z: Array) -> float:
    """Return the standard deviation of white noise in readings (samples,), from fourth differences."""
    fourth = np.diff(z[np.isfinite(z)], 4)
    return float(np.median(np.abs(fourth)) / 0.6745 / math.sqrt(70.0)) if len(fourth) else 0.0
