"""The base period of a motion, the evidence for its verdict, and whether it repeats after some periods."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion.errors import DataError
from lostmotion.results import Estimate
from lostmotion.settings import DEFAULT, MotionSettings
from lostmotion.signals import refined_period
from lostmotion_chaos.analysis.denoise import Denoised
from lostmotion_chaos.analysis.motion_options import OPTIONS
from lostmotion_chaos.analysis.source import Source
from lostmotion_chaos.analysis.surrogates import SurrogateTest
from lostmotion_chaos.results import DriveSource
from lostmotion_chaos.signals.sections import return_spread
from lostmotion_chaos.signals.tones import base_line

MAX_RETURN_PERIODS = 16
"""Largest number of periods after which a return is searched for."""


@dataclass(frozen=True)
class BasePeriod:
    """The base period (s) of a motion and its source; a spectral line with constant phase is taken for a drive."""

    period: float | None
    source: DriveSource
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class MotionEvidence:
    """The evidence on which the verdict is based."""

    base: BasePeriod
    raw: Series
    denoised: Denoised
    exponent: Estimate
    dimension: Estimate
    entropy: Estimate
    tests: tuple[SurrogateTest, ...]
    limits: MotionSettings = DEFAULT.motion

    @property
    def noise(self) -> float:
        """The upper end of the noise level, as a share of the standard deviation, limited to `limits.loudest`."""
        high = self.denoised.before.high
        return min(high, self.limits.loudest) if math.isfinite(high) else 0.0


def find_base_period(x: Array, source: Source, given: float | None) -> BasePeriod:
    """Return the base period: as given, from the measured excitation, or from the strongest line of the response."""
    if given is not None:
        if not 2.0 * source.dt < given < 0.5 * len(x) * source.dt:
            raise DataError(
                f"the period of {given:g} s does not fit {len(x) * source.dt:.4g} s at {1.0 / source.dt:.4g} Hz: give"
                " one longer than two samples, of which the recording has two at least, or none"
            )
        return BasePeriod(given, "given")
    if source.excitation is not None:
        period = refined_period(source.excitation, source.dt)
        if period is not None and _is_measurable(period, x, source.dt):
            return BasePeriod(period, "excitation")
        return BasePeriod(None, "none", ("The excitation is not periodic: periods are not analysed.",))
    line = base_line(x, source.dt)
    if line is None or not _is_measurable(line.period, x, source.dt):
        return BasePeriod(None, "none")
    note = (
        f"The period of {line.period:.6g} s was read from the spectrum: give --period if the drive has another period."
    )
    return BasePeriod(line.period, "spectrum", (note,))


def _is_measurable(period: float, x: Array, dt: float) -> bool:
    """Return whether a period is longer than two samples and fits five times into the recording."""
    return 2.0 * dt < period < 0.2 * len(x) * dt


def measure_returns(series: Series, period: float, most: int = MAX_RETURN_PERIODS) -> Array:
    """Return the difference of x(t + k period) and x(t), k = 1 ... `most`, as a share of the standard deviation."""
    return np.asarray(return_spread(series.x, series.dt, period, most=most) / math.sqrt(2.0))


def find_return(raw: Series, period: float, noise: float) -> tuple[int, float]:
    """Return after how many periods a motion repeats to within its noise (0: never), and the remaining difference.

    `noise` and the difference are shares of the standard deviation.
    """
    spread = measure_returns(raw, period, 2 * MAX_RETURN_PERIODS)
    limit = OPTIONS.slack * noise + OPTIONS.floor
    once, twice = spread[:MAX_RETURN_PERIODS], spread[1::2]
    # A motion of two frequencies nearly returns after some periods, and misses by twice as much after twice as many.
    back = np.flatnonzero((once <= limit) & ~(twice > OPTIONS.drift * once + OPTIONS.drift_floor))
    return (int(back[0]) + 1, float(spread[back[0]])) if len(back) else (0, float(np.nanmin(once)))
