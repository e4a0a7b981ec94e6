"""Hum of a sensor: a single line in the spectrum of what one-step predictions leave of its readings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.observation import Observation

FALSE_HUM = 0.01
"""The rate at which a line is found in a recording without hum."""
MOST_LINES = 2
"""The largest number of lines of one sensor in a recording."""
SURROUNDINGS, NEAR = 101, 2.0
"""Over how many frequencies the median is taken, and how many belong to a line of the drive (steps of 1/duration)."""


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
        return replace(observation, readings=readings)


def list_hums(sensor: int, nominal: Fit) -> Iterator[SensorHum]:
    """Yield the two waves of the hum of one sensor in each recording that shows one."""
    for observation in nominal.problem.observations:
        seen = nominal.problem.on((observation,)).innovations(nominal.theta)
        errors, variances = (
            np.reshape(part, observation.readings.shape)[:, sensor] for part in (seen.errors, seen.variances)
        )
        noise = float(np.sqrt(np.nanmedian(variances)))
        for pace in find_lines(np.nan_to_num(errors / np.sqrt(variances)), observation.dt, observation.harmonic.omega):
            for turn in (0.0, 0.5 * np.pi):
                yield SensorHum(sensor, observation.name, pace, turn, noise)


def find_lines(errors: Array, dt: float, harmonic: float = 0.0) -> Iterator[float]:
    """Yield the angular frequencies (rad/s) of the strongest single lines in standardised errors (samples,).

    A line stands out of the median of its surroundings with a false-alarm rate of `FALSE_HUM` for a whole recording
    (Fisher, Proc. R. Soc. A 125 (1929) 54-59); each is subtracted before the next one is looked for. Multiples of the
    angular frequency `harmonic` of the drive are no hum: missing physics makes them.
    """
    left, places = errors - np.mean(errors), np.arange(len(errors))
    for _ in range(MOST_LINES):
        near = _find_line(left, harmonic * dt * len(errors) / (2.0 * math.pi))
        if near is None:
            return
        pace = _refine_line(left, near)
        yield pace / dt
        waves = np.column_stack([np.cos(pace * places), np.sin(pace * places)])
        left = left - waves @ np.linalg.lstsq(waves, left, rcond=None)[0]


def _find_line(errors: Array, driven: float) -> int | None:
    """Return the place in the spectrum of the strongest significant line; `driven` is that of the drive, 0 without."""
    import pandas as pd

    power = np.abs(np.fft.rfft(errors)) ** 2
    bins = np.arange(len(power))
    if driven:
        power[np.abs(bins - driven * np.round(bins / driven)) < NEAR] = np.nan
    power[: math.ceil(NEAR)] = np.nan
    around = pd.Series(power).rolling(SURROUNDINGS, center=True, min_periods=SURROUNDINGS // 4).median().to_numpy()
    told = np.nan_to_num(power / around) * math.log(2.0)
    level = math.log(len(power) / FALSE_HUM)
    level += 0.5 * (level / math.log(2.0)) ** 2 / SURROUNDINGS  # the median of exponential numbers scatters as well
    best = int(np.argmax(told))
    return best if told[best] > level else None


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
