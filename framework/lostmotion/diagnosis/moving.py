"""Where nothing moves: the end of a recording that is left out, and a sensor from which nothing can be diagnosed."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.inference.setup import count_lasting_samples
from lostmotion.likelihood.observation import Observation
from lostmotion.quantities import unit_of
from lostmotion.results import rounded
from lostmotion.settings import HeldOutSettings

LAGS, REACH = 20, 50
"""The lags (samples) at which readings of a motion are correlated, and at which an input may act on them."""
CHANCE = 1e-3
"""The probability that noise alone passes for motion, for each of the two tests."""
FEWEST = 200
"""Readings below which motion and noise are not told apart."""


def cut_rest(observations: Sequence[Observation], limits: HeldOutSettings) -> tuple[Observation, ...]:
    """Return a single recording until its motion has ended; several recordings are not changed.

    Held-out data in which nothing moves neither confirm nor refute a model.
    """
    if len(observations) != 1:
        return tuple(observations)
    return (observations[0].part(0, count_lasting_samples(observations[0], limits)),)


def note_rest(whole: Sequence[Observation], used: Sequence[Observation]) -> list[str]:
    """Return a note on the end of a recording that is not used, because nothing moves there."""
    return [
        f"{one.name} is at rest from {rounded(cut.samples * cut.dt, 3)} s on: this part is not used."
        for one, cut in zip(whole, used, strict=True)
        if cut.samples < one.samples
    ]


def check_motion(observations: Sequence[Observation], motion: str) -> None:
    """Raise `DataError` for a sensor that shows nothing but white noise in all recordings; `motion` gives its unit.

    Readings of a motion are correlated with each other or with an input. Where neither is the case, the model would be
    fitted to noise, and some term of the library always fits noise.
    """
    for number, sensor in enumerate(observations[0].sensors):
        if any(_moves(one, number) for one in observations):
            continue
        sizes = [float(np.nanstd(one.readings[:, number])) for one in observations]
        raise DataError(
            f"the sensor {sensor.label!r} shows no motion above its noise ({rounded(max(sizes), 2)}"
            f" {unit_of(sensor.channel, motion)} rms): its readings are correlated neither with each other nor with an"
            " input, so nothing can be diagnosed; check its column and its cable, or drive the machine harder"
        )


def _moves(observation: Observation, number: int) -> bool:
    """Return whether the readings of a sensor hold more than white noise, or are too few to tell."""
    readings = observation.readings[:, number]
    taken = np.isfinite(readings)
    if int(taken.sum()) < FEWEST:
        return True
    x = np.where(taken, readings - readings[taken].mean(), 0.0)
    if not np.any(x):
        return False
    return _is_coloured(x) or any(_acts(column, x) for column in observation.inputs.T)


def _is_coloured(x: Array) -> bool:
    """Return whether readings (n,) are correlated over time (the test of Ljung and Box, 1978)."""
    from scipy.stats import chi2

    n, lags = len(x), np.arange(1, LAGS + 1)
    shares = np.array([x[lag:] @ x[:-lag] for lag in lags]) / (x @ x)
    return bool(chi2.sf(n * (n + 2.0) * np.sum(shares**2 / (n - lags)), LAGS) < CHANCE)


def _acts(u: Array, x: Array) -> bool:
    """Return whether white readings (n,) are correlated with an input (n,), at the same time or later."""
    from scipy.stats import norm

    moved = u - u.mean()
    size = math.sqrt(float(moved @ moved) * float(x @ x))
    if not size > 0.0:
        return False
    shares = [float(moved[: len(x) - lag] @ x[lag:]) / size for lag in range(min(REACH, len(x) - 1))]
    return bool(np.max(np.abs(shares)) * math.sqrt(len(x)) > norm.isf(0.5 * CHANCE / len(shares)))
