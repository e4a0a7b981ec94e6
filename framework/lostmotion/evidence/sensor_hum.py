"""Hum of a sensor: a single line in the spectrum of what one-step predictions leave of its readings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.observation import Observation

T = TypeVar("T")
FALSE_HUM = 0.01
"""The rate at which a line is found in a recording without hum."""
BAND, FLOOR = 0.9995, 10.0
"""The share of the variance of the motion within its band, above the noise: some medians of its spectrum."""
MOST_LINES = 2
"""The largest number of lines of one sensor in a recording."""
SURROUNDINGS, NEAR, TOLD = 101, 1.5, 0.35
"""In steps of 1/duration: over how many frequencies the median is taken, how far a line reaches (one, and half a one by
rounding), and from what distance on two frequencies are told apart: three standard deviations of a line that is just
significant (Rife, Boorstyn, IEEE Trans. Inf. Theory 20 (1974) 591-598)."""


@dataclass(frozen=True, eq=False)
class SensorHum:
    """A wave of unit size in the readings of one sensor in one recording: mains hum, or what a cable picks up.

    `pace` is its angular frequency (rad/s), `turn` its phase at time zero (rad), `noise` the size of the unit.
    """

    sensor: int
    recording: str
    pace: float
    turn: float
    noise: float
    width: float = 1.0

    def correct(self, observation: Observation, size: float) -> Observation:
        """Return the recording with the readings corrected for a wave of this size."""
        if observation.name != self.recording:
            return observation
        readings = observation.readings.copy()
        readings[:, self.sensor] += size * self.noise * np.cos(self.pace * observation.time + self.turn)
        return observation.read_again(readings=readings)


def list_hums(fit: Fit) -> Iterator[SensorHum]:
    """Yield the two waves of each line of hum that the one-step errors of a fit show, by recording and sensor."""
    for observation in fit.posterior.observations:
        seen = fit.posterior.on((observation,)).innovations(fit.theta)
        errors, variances = (np.reshape(part, observation.readings.shape) for part in (seen.errors, seen.variances))
        standard = np.nan_to_num(errors / np.sqrt(variances))
        motion = np.nan_to_num(observation.readings - errors)
        for sensor, noise in enumerate(np.sqrt(np.nanmedian(variances, axis=0)).tolist()):
            lines = find_lines(
                standard[:, sensor],
                observation.dt,
                observation.harmonic.omega,
                observation.inputs,
                _find_band(motion[:, sensor]) / observation.dt,
            )
            for pace in lines:
                for turn in (0.0, 0.5 * np.pi):
                    yield SensorHum(sensor, observation.name, pace, turn, noise)


def renew_hums(
    errors: Sequence[T | SensorHum], fit: Fit, recordings: Sequence[Observation]
) -> tuple[T | SensorHum, ...]:
    """Return errors of channels with the hums that a better fit shows: missing physics makes lines and hides others."""
    other = [one for one in errors if not isinstance(one, SensorHum)]
    return (*other, *list_hums(replace(fit, posterior=fit.posterior.on(tuple(recordings)))))


def find_lines(
    errors: Array, dt: float, harmonic: float = 0.0, drives: Array | None = None, edge: float = 0.0
) -> Iterator[float]:
    """Yield the angular frequencies (rad/s) of the strongest single lines in standardised errors (samples,).

    A line stands out of the median of its surroundings with a false-alarm rate of `FALSE_HUM` for a whole recording
    (Fisher, Proc. R. Soc. A 125 (1929) 54-59); each is subtracted before the next one is looked for. Lines of the
    `drives` (samples, count), those that cannot be told from a multiple of the angular frequency `harmonic` of a drive,
    and those below the angular frequency `edge` of the band of the motion are no hum: missing physics makes them.
    """
    places, bins = np.arange(len(errors)), np.arange(len(errors) // 2 + 1)
    per_pace = dt * len(errors) / (2.0 * math.pi)
    taken = bins < NEAR + edge * per_pace
    for drive in [] if drives is None else drives.T:
        for line in np.flatnonzero(_measure_lines(drive - np.mean(drive), taken) > 1.0):
            taken |= np.abs(bins - line) < NEAR
    left, lines = errors - np.mean(errors), 0
    while lines < MOST_LINES and np.max(told := _measure_lines(left, taken)) >= 1.0:
        strongest = int(np.argmax(told))
        pace = _refine_line(left, strongest)
        if not harmonic or abs(math.remainder(pace / dt, harmonic)) * per_pace > TOLD:
            lines += 1
            yield pace / dt
        taken[strongest] = True
        waves = np.column_stack([np.cos(pace * places), np.sin(pace * places)])
        left = left - waves @ np.linalg.lstsq(waves, left, rcond=None)[0]


def _find_band(motion: Array) -> float:
    """Return the angular frequency (rad per sample) below which nearly all of the variance of a motion lies."""
    power = np.abs(np.fft.rfft((motion - np.mean(motion)) * np.hanning(len(motion)))) ** 2
    below = np.cumsum(np.maximum(power - FLOOR * np.median(power), 0.0))
    return 2.0 * math.pi * int(np.searchsorted(below, BAND * below[-1])) / len(motion)


def _measure_lines(signal: Array, taken: NDArray[np.bool_]) -> Array:
    """Return the power of each line of a spectrum over that of a significant one; zero for those `taken`."""
    import pandas as pd

    power = np.where(taken, np.nan, np.abs(np.fft.rfft(signal)) ** 2)
    around = pd.Series(power).rolling(SURROUNDINGS, center=True, min_periods=SURROUNDINGS // 4).median().to_numpy()
    level = math.log(len(power) / FALSE_HUM)
    level += 0.5 * (level / math.log(2.0)) ** 2 / SURROUNDINGS  # the median of exponential numbers scatters as well
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.nan_to_num(power / around) * math.log(2.0) / level)


def _refine_line(errors: Array, near: int) -> float:
    """Return the angular frequency (rad per sample) of the strongest wave near a line of the spectrum."""
    step, places = 2.0 * math.pi / len(errors), np.arange(len(errors))
    found = minimize_scalar(
        lambda pace: -abs(np.exp(-1j * pace * places) @ errors),
        bounds=((near - 1) * step, (near + 1) * step),
        method="bounded",
        options={"xatol": 1e-3 / len(errors)},
    )
    return float(found.x)
