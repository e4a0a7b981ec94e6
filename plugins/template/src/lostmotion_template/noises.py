"""Measurement noise of a sensor: a small linear state-space block that the filter appends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Noise, NoiseBlock, NoiseParameter, SensorScales, Values
from lostmotion.results import rounded


@dataclass(frozen=True)
class FlickerNoise(Noise):
    """Noise whose spectrum falls as 1/f over three decades: a sum of slow noises of equal size, a decade apart."""

    name: ClassVar[str] = "flicker_noise"
    paper: ClassVar[str] = "van der Ziel, Physica 16 (1950) 359-372"
    states = ("fast", "slow", "slowest")

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        size = sensor.log_noise
        return (NoiseParameter("log_noise_flicker", size, size - 7.0, size + 5.0),)

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        kept = np.exp(-1.0 / np.array([3.0, 30.0, 300.0]))
        variance = np.diag(np.full(3, p[0] ** 2 / 3.0))
        return NoiseBlock(
            shown=np.ones(3), transition=np.diag(kept), driving=np.diag(1.0 - kept**2) @ variance, first=variance
        )

    def words(self, p: Values, share: float) -> str:
        return f"The sensor has 1/f noise of {rounded(math.sqrt(share) * 100.0)} % of the size of all its noise."
