"""Preparation of a recording for correlation sums: dither over sensor steps, resampling out of step with the drive."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion.signals.spectra import fundamental
from lostmotion_chaos.quantifiers.noise import find_quantisation
from lostmotion_chaos.signals.sampling import FEWEST, Locked, unlocked


@dataclass(frozen=True, eq=False)
class PreparedSeries:
    """The series `x` (n,) every `dt` s with its delay `lag`, the `step` of the sensor, and a sentence `says`."""

    x: Array
    dt: float
    lag: int
    step: float
    says: str
    details: Mapping[str, float]


def prepare_series(data: Series, rng: np.random.Generator, *, guess: bool = True) -> PreparedSeries:
    """Return the recording with a dither over the steps of its sensor, resampled if it is in step with its drive.

    Where no period is given, that of the strongest spectral line is used, if there is one and `guess` allows it.
    """
    step = find_quantisation(data.x)
    x = data.x + step * (rng.random(data.n) - 0.5) if step > 0.0 else data.x
    period = data.period or (_find_period(data) if guess else None)
    if period is None:
        return PreparedSeries(x, data.dt, data.embedding.lag, step, "", {})
    moved, dt, locked = unlocked(x, data.dt, period)
    if locked is None:
        return PreparedSeries(x, data.dt, data.embedding.lag, step, "", {})
    lag = max(1, round(data.embedding.lag * data.dt / dt))
    details = {"samples_per_period": period / dt, "resampled": float(dt != data.dt)}
    return PreparedSeries(moved, dt, lag, step, _describe_locking(locked, period / data.dt, period / dt), details)


def _find_period(data: Series) -> float | None:
    """Return the period (s) of the strongest spectral line, or None."""
    found = fundamental(data.x, data.dt)
    return None if found is None else found.period


def _describe_locking(locked: Locked, before: float, after: float) -> str:
    """Return the sentence about a recording that is sampled in step with its drive."""
    if before < FEWEST:
        return (
            f"The recording has {locked}, too few to interpolate: it is a Poincare section, and the dimension of the "
            "flow is larger by one than the value given here."
        )
    return (
        f"The recording has {locked}, so that at small radii it shows the dimension of a Poincare section, one less "
        f"than that of the flow: it was resampled at {after:.4g} samples a period."
    )
