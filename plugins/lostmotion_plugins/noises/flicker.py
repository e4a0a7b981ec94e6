"""A sensor with 1/f noise."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Noise, NoiseBlock, NoiseParameter, SensorScales, Values
from lostmotion.results import rounded

APART = 8.0
"""The ratio of neighbouring time constants, of which the shortest is one sample: with five, the spectrum is that of 1/f
noise within 10 % from 0.0002 to 0.05 of the sampling rate."""


@dataclass(frozen=True)
class Flicker(Noise):
    """1/f noise, as of amplifiers and of strain gauges: a sum of AR(1) noises of equal size.

    Its power in each decade of frequency is the same.
    """

    name = "flicker"
    paper = "Keshner, Proceedings of the IEEE 70 (1982) 212-218"
    states = ("first", "second", "third", "fourth", "fifth")

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return the standard deviation of the noise within a decade of frequency."""
        high = math.log(max(sensor.size, 1e-300))
        start = sensor.log_noise - 1.0
        return (NoiseParameter("log_noise_flicker", start, sensor.log_noise - 8.0, max(high, sensor.log_noise)),)

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return stationary states with time constants of 1 to 4,096 samples."""
        count = len(self.states)
        kept = np.exp(-(APART ** -np.arange(count)))
        variance = p[0] ** 2 * math.log(APART) / math.log(10.0) * np.eye(count)
        return NoiseBlock(
            shown=np.ones(count), transition=np.diag(kept), driving=(1.0 - kept**2) * variance, first=variance
        )

    def words(self, p: Values, share: float) -> str:
        """Return the size."""
        return f"The sensor has 1/f noise of {rounded(p[0])} rms in each decade of frequency; the fit includes this."
