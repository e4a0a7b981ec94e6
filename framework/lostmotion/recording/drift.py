"""Detection of drift between the clocks of two devices, from the delay between input and response over time.

The recording is cut into segments. A drift turns the phase of the response at each frequency in proportion to the
frequency and to time. It is first estimated from neighbouring segments, between which it is small. After its removal
the transfer function is averaged over all segments, and the delay of each segment is the shift with which the mean
transfer function explains it best (maximum likelihood for Gaussian noise; Knapp and Carter 1976). A line is fitted to
the delays; their scatter about it gives its standard error, so any other change of the phase counts as noise.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.settings import DEFAULT, RecordingSettings

Array = NDArray[np.float64]
Spectra = NDArray[np.complex128]
SEGMENTS, FEWEST, SHORTEST = 16, 10, 64
"""Segments of a recording, the least number to which a line is fitted, and the least number of samples in one."""
HEARD = 1e-3
"""Frequencies with at least this share of the strongest power of the input are used: below it lies leakage."""
HELD = 0.25
"""The least share of the segments in which the input must have its power at a frequency, in the mean over all
frequencies: in a sweep, which has each of them once, a resonance looks like a delay that grows."""
MOST = 5e-3
"""The largest drift (s per s) of two clocks: a larger one has another cause."""
FLOOR = 1e-12
"""Share of the power of the response that counts as noise in every case."""
ROUNDS = 8


@dataclass(frozen=True)
class Drift:
    """The drift between two clocks (s per s), its standard error, and the time (s) over which it was seen."""

    rate: float
    error: float
    span: float

    def is_significant(self, errors: float = DEFAULT.recording.drift) -> bool:
        """Return whether the drift exceeds so many standard errors, and is possible for two clocks."""
        return abs(self.rate) > errors * self.error and abs(self.rate) < MOST


def note_drift(
    excitation: Array, response: Array, dt: float, limits: RecordingSettings = DEFAULT.recording
) -> Iterator[str]:
    """Yield a note when the delay of the response (n,) behind the input (n,) grows or shrinks steadily.

    False alarms are rarer than 1 in 1000: none of 3000 recordings of gap oscillators gave one, chaotic ones among
    them.
    """
    drift = clock_drift(excitation, response, dt)
    if drift is None or not drift.is_significant(limits.drift):
        return
    if abs(drift.rate) * drift.span < limits.drift_samples * dt:
        return
    which = "later and later" if drift.rate > 0 else "earlier and earlier"
    yield (
        f"the response comes {which} after the excitation, by {1e6 * drift.rate:.3g} +- {1e6 * drift.error:.1g} ppm, "
        f"{1e3 * drift.rate * drift.span:.3g} ms over the record: either two devices recorded them whose clocks differ "
        f"(then multiply the time of the response by {1.0 - drift.rate:.8g} and resample it), or the machine changed "
        "while it was recorded (then cut the record into pieces with t_start and t_end)"
    )


def clock_drift(excitation: Array, response: Array, dt: float) -> Drift | None:
    """Return the drift of the response (n,) against the input (n,), sampled every `dt` s; None if it cannot be seen."""
    size = excitation.size // SEGMENTS
    count = SEGMENTS if size >= SHORTEST else excitation.size // SHORTEST
    if count < FEWEST:
        return None
    size = excitation.size // count
    drive, seen = _spectra(excitation, count, size), _spectra(response, count, size)
    loud = np.mean(np.abs(drive) ** 2, axis=0)
    loud[:2] = 0.0
    heard = loud > HEARD * loud.max()
    omega = 2.0 * math.pi * np.fft.rfftfreq(size, dt)[heard]
    if not omega.size or not loud.max():
        return None
    drive, seen = drive[:, heard], seen[:, heard]
    power = np.abs(drive) ** 2
    alike = np.sum(power, axis=0) ** 2 / np.sum(power**2, axis=0)
    if np.average(alike, weights=loud[heard]) < HELD * count:
        return None
    at = np.asarray((np.arange(count) - 0.5 * (count - 1)) * size * dt)
    pair = _Pair(drive, seen, omega, at)
    # A periodic motion fits many drifts: the one with the least residual is taken.
    found = [pair.fit_drift(start) for start in (0.0, _guess_drift(drive, seen, omega, size * dt))]
    rate, error, _ = min(found, key=lambda one: one[2])
    return Drift(rate, error, excitation.size * dt)


@dataclass(frozen=True, eq=False)
class _Pair:
    """Spectra (segments, frequencies) of input and response at `omega` (rad/s), and the times `at` (s) of segments."""

    drive: Spectra
    seen: Spectra
    omega: Array
    at: Array

    def fit_drift(self, rate: float) -> tuple[float, float, float]:
        """Return the drift (s per s) fitted from a first guess, its standard error, and the log residual power."""
        error, left = math.inf, math.inf
        for _ in range(ROUNDS):
            delay, weight, left = self._fit_delays(rate)
            slope, error = _fit_line(self.at, delay, weight)
            rate += slope
            if not math.isfinite(error) or abs(rate) > MOST:
                return rate, math.inf, math.inf
            if abs(slope) < 0.01 * error:
                break
        return rate, error, left

    def _fit_delays(self, rate: float) -> tuple[Array, Array, float]:
        """Return for a given drift the delay (s) of each segment, its weight (1/s^2), and the log residual power."""
        seen = self.seen * np.exp(1j * self.omega * rate * self.at[:, None])
        transfer = np.sum(seen * np.conj(self.drive), axis=0) / np.sum(np.abs(self.drive) ** 2, axis=0)
        clean = transfer * self.drive
        rest = seen - clean
        noise = np.mean(np.abs(rest) ** 2, axis=0) + FLOOR * np.mean(np.abs(seen) ** 2, axis=0) + 1e-300
        weight = np.maximum(np.sum(self.omega**2 * np.abs(clean) ** 2 / noise, axis=1), 1e-300)
        delay = np.sum((np.conj(-1j * self.omega * clean) * rest).real / noise, axis=1) / weight
        return delay, weight, float(np.sum(np.log(noise)))


def _spectra(values: Array, count: int, size: int) -> Spectra:
    """Return the spectra (segments, frequencies) of tapered segments after removal of mean and trend."""
    from scipy.signal import detrend

    there = np.flatnonzero(np.isfinite(values))
    whole = np.interp(np.arange(count * size), there, values[there]) / (np.abs(values[there]).max() or 1.0)
    return np.asarray(np.fft.rfft(detrend(whole.reshape(count, size), axis=1) * np.hanning(size), axis=1))


def _guess_drift(drive: Spectra, seen: Spectra, omega: Array, step: float) -> float:
    """Return the drift (s per s) from the phase between neighbouring segments, `step` s apart."""
    cross = seen * np.conj(drive)
    turn = np.sum(cross[1:] * np.conj(cross[:-1]), axis=0)
    weight = np.abs(turn) ** 2 / np.maximum(np.sum(np.abs(cross[1:] * cross[:-1]), axis=0), 1e-300)
    share = weight * omega**2
    return float(-np.sum(share * np.angle(turn) / omega) / (step * max(np.sum(share), 1e-300)))


def _fit_line(at: Array, delay: Array, weight: Array) -> tuple[float, float]:
    """Return the slope of a weighted line through the delays, and its standard error from their scatter."""
    share = weight / weight.sum()
    away = at - share @ at
    spread = float(share @ away**2)
    slope = float(share @ (away * delay)) / spread
    rest = delay - share @ delay - slope * away
    return slope, math.sqrt(float(share @ rest**2) / spread / (at.size - 2))
