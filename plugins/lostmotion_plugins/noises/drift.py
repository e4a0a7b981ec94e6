"""A sensor whose zero drifts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Noise, NoiseBlock, NoiseParameter, SensorScales, Values
from lostmotion.results import rounded


@dataclass(frozen=True)
class DriftingZero(Noise):
    """A zero that drifts as a random walk, for instance with temperature."""

    name = "drift"
    paper = "Allan, IEEE Transactions on Ultrasonics, Ferroelectrics and Frequency Control 34 (1987) 647-654"
    states = ("zero",)

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return the drift within a second: at most the deviation of the readings within the recording."""
        high = math.log(max(sensor.size, 1e-300)) - 0.5 * math.log(sensor.span)
        return (NoiseParameter("log_noise_drift", high - 4.0, high - 14.0, high, mean=high - 5.0, sd=3.0),)

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return a random walk from zero."""
        one = np.ones((1, 1))
        return NoiseBlock(shown=np.ones(1), transition=one, driving=p[0] ** 2 * dt * one, first=0.0 * one)

    def words(self, p: Values, share: float) -> str:
        """Return the drift within a minute."""
        return f"The zero of the sensor drifts by {rounded(p[0] * math.sqrt(60.0))} (sd) within a minute."
