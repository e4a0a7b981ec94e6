"""A sensor whose stamps jitter."""

from __future__ import annotations

import math
from dataclasses import dataclass

from lostmotion.contracts import Noise, NoiseBlock, NoiseParameter, SensorScales, Values
from lostmotion.results import rounded


@dataclass(frozen=True)
class Jitter(Noise):
    """Readings that are taken a little before or after their stamps: an error of the speed times that time.

    The variance is v^2 s^2, with v the modelled speed of the channel at the filtered state.
    """

    name = "jitter"
    paper = "Da Dalt, Harteneck, Sandner, Wiesbauer, IEEE Transactions on Circuits and Systems I 49 (2002) 1354-1360"

    def parameters(self, sensor: SensorScales) -> tuple[NoiseParameter, ...]:
        """Return the standard deviation (s) of the stamps: about 3 % of a sample, at most a sample."""
        middle = math.log(0.03 * sensor.dt)
        return (NoiseParameter("log_noise_jitter", middle, middle - 7.0, math.log(sensor.dt), middle, 2.0, "s"),)

    def covariance(self, p: Values, dt: float) -> NoiseBlock:
        """Return a block without states."""
        return NoiseBlock(clock=p[0] ** 2)

    def words(self, p: Values, share: float) -> str:
        """Return the jitter."""
        return f"The stamps of the sensor jitter by {rounded(1e6 * p[0])} us (sd)."
