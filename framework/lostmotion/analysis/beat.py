"""The beat of a motion, what is weighed about it, and whether it comes back to itself after some periods."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.analysis.denoise import Denoised
from lostmotion.analysis.source import Source
from lostmotion.analysis.surrogates import SurrogateTest
from lostmotion.contracts import Array, Series
from lostmotion.results import Estimate
from lostmotion.results.analysis import DriveSource
from lostmotion.settings import DEFAULT, MotionSettings
from lostmotion.signals import base_line, refined_period, return_spread

SLACK, FLOOR, LOUDEST = 1.4, 0.01, 0.2
"""What repeats to within so many times its noise, and a hundredth of its size, is taken to repeat."""
MOST_PERIODS, DRIFT, DRIFT_FLOOR = 16, 1.15, 0.002


@dataclass(frozen=True)
class Beat:
    """The period (s) of a motion and where it comes from; a line that keeps its phase is taken for that of a drive."""

    period: float | None
    source: DriveSource
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class MotionEvidence:
    """What the verdict is made of."""

    beat: Beat
    raw: Series
    denoised: Denoised
    exponent: Estimate
    dimension: Estimate
    entropy: Estimate
    tests: tuple[SurrogateTest, ...]
    limits: MotionSettings = DEFAULT.motion

    @property
    def noise(self) -> float:
        """The upper end of the noise level, as a share of the standard deviation, no more than can pass for noise."""
        high = self.denoised.before.high
        return min(high, LOUDEST) if math.isfinite(high) else 0.0


def beat_of(x: Array, source: Source, given: float | None) -> Beat:
    """Return the period of the drive: as given, as measured going in, or as the strongest line of the response."""
    if given is not None:
        return Beat(given, "given")
    if source.excitation is not None:
        period = refined_period(source.excitation, source.dt)
        if period is not None and _fits(period, x, source.dt):
            return Beat(period, "excitation")
        return Beat(None, "none", ("The excitation is not periodic: nothing is said about periods.",))
    line = base_line(x, source.dt)
    if line is None or not _fits(line.period, x, source.dt):
        return Beat(None, "none")
    note = f"The period of {line.period:.6g} s was read from the spectrum: give --period if the drive has another one."
    return Beat(line.period, "spectrum", (note,))


def _fits(period: float, x: Array, dt: float) -> bool:
    return 2.0 * dt < period < 0.2 * len(x) * dt


def returns(series: Series, period: float, most: int = MOST_PERIODS) -> Array:
    """Return by how much x(t + k period) misses x(t), k = 1 ... `most`, as a share of the standard deviation."""
    return np.asarray(return_spread(series.x, series.dt, period, most=most) / math.sqrt(2.0))


def returned(raw: Series, period: float, noise: float) -> tuple[int, float]:
    """Return after how many periods a motion comes back, to within its noise, and by how much it misses; 0 for never.

    `noise` and the miss are shares of the standard deviation.
    """
    spread = returns(raw, period, 2 * MOST_PERIODS)
    limit = SLACK * noise + FLOOR
    once, twice = spread[:MOST_PERIODS], spread[1::2]
    # Two frequencies nearly return after some periods, and miss by twice as much after twice as many.
    back = np.flatnonzero((once <= limit) & ~(twice > DRIFT * once + DRIFT_FLOOR))
    return (int(back[0]) + 1, float(spread[back[0]])) if len(back) else (0, float(np.nanmin(once)))
