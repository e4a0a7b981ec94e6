"""A sensor that picks up the mains."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Noise, NoiseBlock, NoiseParameter, SensorScales, Values
from lostmotion.results import rounded


@dataclass(frozen=True)
class Hum(Noise):
    """A sine of the mains whose amplitude and phase change within `lasting` seconds; two states rotate."""

    frequency: float = 50.0
    lasting: float = 100.0
    name = "hum"
    paper = "Harvey, Forecasting, Structural Time Series Models and the Kalman Filter, Cambridge (1989), section 2.3"
    states = ("sine", "cosine")

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return the rms amplitude."""
        high = math.log(max(sensor.size, 1e-300))
        return (NoiseParameter("log_noise_hum", sensor.log_noise, sensor.log_noise - 8.0, max(high, sensor.log_noise)),)

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return a rotation by the phase of a sample, stationary."""
        angle, kept = 2.0 * math.pi * self.frequency * dt, math.exp(-dt / self.lasting)
        turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        whole = p[0] ** 2 * np.eye(2)
        return NoiseBlock(
            shown=np.array([1.0, 0.0]), transition=kept * turn, driving=(1.0 - kept**2) * whole, first=whole
        )

    def words(self, p: Values, share: float) -> str:
        """Return amplitude and share."""
        return f"The sensor picks up the mains ({rounded(self.frequency)} Hz) with {rounded(p[0])} rms."


@dataclass(frozen=True)
class Hum60(Hum):
    """The same at 60 Hz."""

    frequency: float = 60.0
    name = "hum60"
