"""Free decays: frequency, amplitude and logarithmic decrement of one mode, cycle by cycle."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import signal

from lostmotion.errors import DataError

Array = NDArray[np.float64]
FEWEST_CYCLES = 4
FEWEST_SAMPLES = 32
LOUD = 3.0
"""A cycle is used while its amplitude exceeds this multiple of the noise."""
FALL, CLIMB = 0.1, 0.25
"""The least fall of the log amplitude of a decay, and the share of this fall by which it may rise again."""
SURE = 5.0
"""The amplitude must fall by this many standard errors."""
REACH = 2.0
"""Half the width (periods) of the windows in which sines are fitted."""
FIRST = 16.0
"""The number of periods at the start in which other modes are searched: most of them decay early."""
OTHER = 0.05
"""A line with at least this share of the height of the dominating one is another mode."""
CLOSEST = 0.1
"""The least distance of a mode from its neighbours, as a share of its frequency."""
FINEST = 1e-9
"""Values below this share of the largest amplitude are rounding errors."""
STARTS = (1.0, 1.15, 0.87, 1.3, 0.75, 1.5, 0.65)
"""Multiples of the overall frequency at which the first cycle is fitted: the stiffness may change strongly."""
SAME = 0.3
"""The largest log ratio of two frequencies that may belong to the same mode at two amplitudes."""
HARMONICS = 3
UNEXPLAINED = 0.1
"""The largest residual of a single mode, as a share of the amplitude."""
ONSET = 3
"""The number of cycles before the largest one whose windows may contain part of it."""
MOST = 2000
"""The greatest number of cycles that are fitted; of more cycles, every second one or fewer."""
STEPS, PRECISION = 30, 1e-8


@dataclass(frozen=True)
class Decay:
    """A free decay of one mode: arrays (cycles,), one entry for each cycle, at the middle of the cycle.

    `time` is in s from the first sample, `amplitude` in the unit of the readings, `frequency` in Hz, `decrement` the
    natural logarithm of the ratio of successive amplitudes. All come from windows of some four periods, so entries of
    neighbouring cycles share their noise. Standard errors are those of white noise of standard deviation `noise`.
    """

    time: Array
    amplitude: Array
    frequency: Array
    decrement: Array
    amplitude_error: Array
    frequency_error: Array
    decrement_error: Array
    noise: float

    @property
    def damping_ratio(self) -> Array:
        """The damping ratio (cycles,) of a viscous oscillator with these decrements."""
        return np.asarray(self.decrement / np.sqrt(4.0 * math.pi**2 + self.decrement**2))


class _Window(NamedTuple):
    """The window of a fitted sine: middle and half width (s), and the power of the cosine of its weights."""

    middle: float
    reach: float
    power: int


class _Cycle(NamedTuple):
    """A sine fitted to a window: middle (s), amplitude, exponent (1/s), rest (rms), and errors for noise of one.

    The errors are of amplitude, of the real and of the imaginary part of the exponent.
    """

    time: float
    amplitude: float
    exponent: complex
    rest: float
    errors: Array


def decay_of(
    values: ArrayLike, dt: float, *, noise: float | None = None, near: float | None = None, most: int = MOST
) -> Decay | None:
    """Return the decay of the dominating mode in the readings (n,), sampled every `dt` s, or None where there is none.

    Readings may be position, velocity or acceleration; samples that are NaN are left out. They should begin with the
    decay; cycles before the largest one are dropped. The conditions of a decay are: four cycles or more with an
    amplitude above three times the `noise` (standard deviation, in the unit of the readings; estimated from the
    spectrum about the mode in the second half of the readings where it is not given), whose amplitude falls by 10 % or
    more and by 5 standard errors, and never rises again by more than a quarter of that fall (logarithms). The decay
    must begin suddenly, and remain within the noise at its end. Of more than `most` cycles some are skipped. So noise,
    a steady vibration and the beat of two modes are no decays. A resonance under random excitation may decrease for a
    while by chance, and is then taken for a decay. `near` (Hz) selects the mode next to a frequency in place of the
    dominating one.

    Method: a sine with an exponential envelope and an offset is fitted by least squares to windows of four periods
    about the middle of each cycle (Gauss-Newton, Hann weights), so neither an offset nor the end of the motion has an
    effect; harmonics are fitted too, so the amplitude is that of the fundamental. Residuals above the noise indicate
    other modes; then windows are symmetric and longer, so that their taper separates the modes, and the first and last
    cycles are lost. A Hilbert transform, averaged over as many periods, is less accurate: its decrements scatter twice
    as much in the middle of a noisy decay, and are useless within two cycles of the ends, where its amplitude has
    errors of several per cent (Feldman, Mech. Syst. Signal Process. 25, 2011, 735, on these end effects). Standard
    errors do not include the effect of other modes. Readings of velocity and acceleration of a nonlinear oscillator
    have other decrements than its position, since the factor between the amplitudes is the frequency, which changes.
    """
    readings = _check_readings(values, dt)
    there = np.isfinite(readings)
    if np.count_nonzero(there) < FEWEST_SAMPLES or not np.ptp(readings[there]) > 0.0:
        return None
    rest = float(np.mean(readings[there][-(np.count_nonzero(there) // 4) :]))
    filled = np.interp(np.arange(readings.size), np.flatnonzero(there), readings[there]) - rest
    lines = _find_lines(*_padded_spectrum(filled * _make_weights(filled.size, 0), dt), 1.5 / (filled.size * dt))
    overall = _find_dominating(lines, near)
    if overall is None:
        return None
    level = _estimate_noise(filled, dt, overall) if noise is None else float(noise)
    end = _find_end(filled, level, max(2, round(1.0 / (overall * dt))))
    hop = math.ceil(end * dt * overall / max(most, 1))
    cycles = _fit_single_mode((readings - rest)[:end], dt, overall, hop)
    if not _is_explained(cycles, level):
        cycles = list(
            _fit_separated_mode((readings - rest)[:end], dt, *_find_neighbours(filled, dt, overall, lines), hop=hop)
        )
    return _accept_decay(cycles, level)


def decays_of(values: ArrayLike, dt: float, starts: Sequence[int], *, near: float | None = None) -> tuple[Decay, ...]:
    """Return the decays that begin at the sample numbers `starts` and end where the next one begins.

    Times count from the first sample of the readings (n,). A part without a decay is left out.
    """
    readings = _check_readings(values, dt)
    ends = [*starts[1:], readings.size]
    found = []
    for start, end in zip(starts, ends, strict=True):
        if not 0 <= start < end <= readings.size:
            raise DataError(
                f"a decay is given from sample {start} to {end} of {readings.size}: give rising numbers in range"
            )
        decay = decay_of(readings[start:end], dt, near=near)
        if decay is not None:
            found.append(_shift_times(decay, start * dt))
    return tuple(found)


def _shift_times(decay: Decay, by: float) -> Decay:
    return Decay(**{**decay.__dict__, "time": decay.time + by})


def _check_readings(values: ArrayLike, dt: float) -> Array:
    readings = np.array(values, dtype=np.float64)
    if readings.ndim != 1:
        raise DataError(f"the readings have {readings.ndim} dimensions {readings.shape}: give one channel, shape (n,)")
    if not (math.isfinite(dt) and dt > 0.0):
        raise DataError(f"the sampling step is {dt:g} s: give a positive one")
    readings[~np.isfinite(readings)] = np.nan
    return readings


def _make_weights(size: int, rise: int) -> Array:
    """Return weights (size,) that rise over some samples and then fall to zero."""
    up, down = np.arange(rise) / max(rise, 1), np.arange(size - rise) / (size - rise)
    return np.concatenate([np.sin(0.5 * np.pi * up) ** 2, np.cos(0.5 * np.pi * down) ** 2])


def _padded_spectrum(x: Array, dt: float) -> tuple[Array, Array]:
    """Return frequencies (Hz) and heights of the spectrum of `x`, padded to four times its length."""
    size = 4 * x.size
    return np.asarray(np.fft.rfftfreq(size, dt)), np.asarray(np.abs(np.fft.rfft(x, size)))


def _find_lines(frequency: Array, height: Array, lowest: float) -> Array:
    """Return frequency and height (lines, 2) of the peaks above a frequency, without side lobes of higher ones."""
    peaks, _ = signal.find_peaks(height, prominence=0.5 * OTHER * float(height[frequency >= lowest].max(initial=0.0)))
    peaks = peaks[frequency[peaks] >= lowest]
    return np.column_stack([frequency[peaks], height[peaks]])


def _find_dominating(lines: Array, near: float | None) -> float | None:
    """Return the frequency (Hz) of the highest line, of all lines or of those near a frequency, or None."""
    asked = lines if near is None else lines[(lines[:, 0] > 0.8 * near) & (lines[:, 0] < 1.25 * near)]
    return float(asked[np.argmax(asked[:, 1]), 0]) if len(asked) else None


def _find_neighbours(x: Array, dt: float, overall: float, lines: Array) -> tuple[float, float, float]:
    """Return the frequency (Hz) of a mode in the first periods of `x`, the distance (Hz) and height of other modes.

    Distant modes are found in the whole spectrum; close ones only in the first periods, in which a frequency that
    changes with the amplitude causes no second line.
    """
    strength = lines[np.argmin(np.abs(lines[:, 0] - overall)), 1]
    far = lines[np.abs(np.log2(lines[:, 0] / overall)) > 1.0] / np.array([1.0, strength])
    piece = x[: max(FEWEST_SAMPLES, round(FIRST / (overall * dt)))]
    weights = _make_weights(piece.size, piece.size // 5)
    centred = piece - np.average(piece, weights=weights)
    early = _find_lines(*_padded_spectrum(centred * weights, dt), 1.5 / (piece.size * dt))
    own = early[np.abs(np.log(early[:, 0] / overall)) < SAME]
    if not len(own):
        return overall, CLOSEST * overall, 1.0
    loud = own[own[:, 1] > 0.3 * own[:, 1].max()]
    first, strength = loud[np.argmin(np.abs(loud[:, 0] - overall))]
    others = np.concatenate([far, early[early[:, 0] != first] / np.array([1.0, strength])])
    others = others[others[:, 1] > OTHER]
    apart = float(np.min(np.abs(others[:, 0] - first), initial=first))
    return float(first), max(apart, CLOSEST * first), float(np.max(others[:, 1], initial=1.0))


def _estimate_noise(x: Array, dt: float, about: float) -> float:
    """Return the standard deviation of white noise with the spectral density beside a frequency, late in `x`.

    The median is robust against lines of other modes.
    """
    late = x[x.size // 2 :]
    frequency, density = signal.periodogram(late, 1.0 / dt, window="hann", detrend="linear")
    beside = (frequency > about / 3.0) & (frequency < 3.0 * about) & (np.abs(frequency / about - 1.0) > 0.2)
    if not beside.any():
        return 0.0
    # The median of exponentially distributed densities is ln 2 of their mean.
    return math.sqrt(float(np.median(density[beside])) / math.log(2.0) * 0.5 / dt)


def _find_end(x: Array, noise: float, period: int) -> int:
    """Return the sample at which the motion ends: later, the motion in a period never exceeds the noise."""
    if x.size <= period:
        return x.size
    windows = np.lib.stride_tricks.sliding_window_view(x, period)
    moving = windows.std(axis=1) > noise * (1.0 + 4.0 / math.sqrt(2.0 * period)) + FINEST * float(np.abs(x).max())
    last = int(np.flatnonzero(moving)[-1]) + 1 if moving.any() else 0
    return x.size if last == moving.size else last + 1


def _fit_single_mode(x: Array, dt: float, overall: float, hop: int) -> list[_Cycle]:
    """Return the sines fitted around the middle of every `hop`-th cycle of `x` (n,) for a single mode.

    NaN marks lost samples.
    """
    window = _Window(0.5 / overall, REACH / overall, 2)
    tried = (_fit_cycle(x, dt, window, complex(0.0, 2.0 * math.pi * overall * factor)) for factor in STARTS)
    firsts = [cycle for cycle in tried if cycle is not None]
    if not firsts:
        return []
    exponent = min(firsts, key=lambda cycle: cycle.rest).exponent
    found, centre = [], math.pi / exponent.imag
    while centre < x.size * dt:
        period = 2.0 * math.pi / exponent.imag
        cycle = _fit_cycle(x, dt, _Window(centre, REACH * period, 2), exponent)
        if cycle is not None and 0.7 < cycle.exponent.imag / exponent.imag < 1.4:
            exponent = cycle.exponent
            found.append(cycle)
        centre += hop * 2.0 * math.pi / exponent.imag
    return found


def _is_explained(cycles: list[_Cycle], noise: float) -> bool:
    """Return whether a single mode explains the cycles above the noise."""
    loud = [cycle for cycle in cycles if cycle.amplitude > LOUD * noise]
    left = [cycle.rest < max(UNEXPLAINED * cycle.amplitude, 2.0 * noise) for cycle in loud]
    return len(left) >= FEWEST_CYCLES and float(np.mean(left)) > 0.75


def _fit_separated_mode(
    x: Array, dt: float, first: float, apart: float, height: float, *, hop: int
) -> Iterator[_Cycle]:
    """Yield the sines fitted around the middle of every `hop`-th cycle of `x` (n,), with other modes `apart` (Hz).

    The windows are symmetric, and long enough for their taper to separate the modes: longer for higher other modes.
    """
    wanted = 3.0 * height**0.3 / apart
    exponent, centre = complex(0.0, 2.0 * math.pi * first), 0.5 / first
    while centre < x.size * dt:
        period = 2.0 * math.pi / exponent.imag
        reach = min(max(REACH * period, wanted), centre, x.size * dt - centre)
        if reach >= 0.999 * max(period, 2.0 / apart):
            cycle = _fit_cycle(x, dt, _Window(centre, reach, 4), exponent)
            if cycle is not None and abs(cycle.exponent.imag / (2.0 * math.pi) - first) > 0.5 * apart:
                return  # another mode dominates from here on
            if cycle is not None:
                exponent = cycle.exponent
                yield cycle
        centre += hop * 2.0 * math.pi / exponent.imag


def _fit_cycle(x: Array, dt: float, window: _Window, exponent: complex) -> _Cycle | None:
    """Return the damped sine with the best fit in a window, or None where the fit fails."""
    low = max(0, math.ceil((window.middle - window.reach) / dt))
    high = min(x.size, math.floor((window.middle + window.reach) / dt) + 1)
    seen = low + np.flatnonzero(np.isfinite(x[low:high]))
    period = 2.0 * math.pi / exponent.imag
    if seen.size < max(12, 0.6 * period / dt) or (seen[-1] - seen[0]) * dt < 0.9 * period:
        return None
    s = np.asarray((seen * dt - window.middle) / period, dtype=np.float64)
    weights = np.cos(0.5 * np.pi * s * period / window.reach) ** window.power
    count = min(HARMONICS, math.ceil(0.5 * period / dt) - 1)
    turn = exponent * period
    for _ in range(STEPS):
        table = _make_columns(s, turn, count)
        weighted = table * weights[:, None]
        found = np.linalg.lstsq(weighted.T @ table, weighted.T @ x[seen], rcond=1e-13)[0]
        amplitude, slope = complex(*found[:2]), complex(*found[2:4])
        step = slope / amplitude if amplitude else math.inf
        turn += step
        if not (abs(step) < 3.0 and turn.imag > 0.0 and abs(turn.real) < 0.5 * turn.imag):
            return None
        if abs(step) < PRECISION:
            break
    rest = math.sqrt(float(np.average((x[seen] - table @ found) ** 2, weights=weights)))
    errors = _standard_errors(table, weights, amplitude) / np.array([1.0, period, period])
    return _Cycle(window.middle, abs(amplitude), turn / period, rest, errors)


def _make_columns(s: Array, turn: complex, count: int) -> Array:
    """Return the real part of (1, i, s, i s) exp(turn s), one, and the same of harmonics: columns (n, 3 + 2 count)."""
    wave = np.exp(turn * s)
    parts = [wave.real, -wave.imag, s * wave.real, -s * wave.imag, np.ones_like(s)]
    for order in range(2, count + 1):
        parts += [(wave**order).real, (wave**order).imag]
    return np.column_stack(parts)


def _standard_errors(table: Array, weights: Array, amplitude: complex) -> Array:
    """Return the standard errors (3,) of amplitude, growth and frequency for white noise of standard deviation one."""
    inverse = np.linalg.pinv((table * weights[:, None]).T @ table)
    covariance = inverse @ ((table * weights[:, None] ** 2).T @ table) @ inverse
    along, across = amplitude / abs(amplitude), 1j * amplitude / abs(amplitude)
    rows = np.zeros((3, table.shape[1]))
    rows[0, :2] = along.real, along.imag
    rows[1, 2:4] = along.real / abs(amplitude), along.imag / abs(amplitude)
    rows[2, 2:4] = across.real / abs(amplitude), across.imag / abs(amplitude)
    return np.asarray(np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", rows, covariance, rows), 0.0)))


def _accept_decay(cycles: list[_Cycle], noise: float) -> Decay | None:
    """Return the decay from the largest cycle to the last one above the noise, or None where it is not a decay."""
    if len(cycles) < FEWEST_CYCLES:
        return None
    sizes = np.array([cycle.amplitude for cycle in cycles])
    first = int(np.argmax(sizes))
    quiet = np.flatnonzero(sizes[first:] <= max(LOUD * noise, FINEST * sizes[first]))
    kept = cycles[first : first + int(quiet[0]) if quiet.size else None]
    if len(kept) < max(FEWEST_CYCLES, first) or not _is_single_decay(
        sizes / sizes[first], first, len(kept), noise / sizes[first]
    ):
        return None
    decay = _collect_cycles(kept, noise)
    size = np.log(decay.amplitude)
    error = math.hypot(*(decay.amplitude_error / decay.amplitude)[[0, -1]])
    fall = float(size[0] - size[-1])
    climb = float(np.max(size - np.minimum.accumulate(size)))
    falls = fall > max(FALL, SURE * error) and climb < CLIMB * fall + SURE * error
    return decay if falls else None


def _is_single_decay(sizes: Array, first: int, count: int, noise: float) -> bool:
    """Return whether amplitudes (over the largest one) rise suddenly, and remain small after the decay."""
    early, later = sizes[: max(0, first - ONSET)], sizes[first + count :]
    sudden = bool(np.all(early < 0.3) or np.all(early > 0.8))
    return sudden and float(np.mean(later > max(2.0 * LOUD * noise, 1e-6))) < 0.1 if later.size else sudden


def _collect_cycles(cycles: list[_Cycle], noise: float) -> Decay:
    exponents = np.array([cycle.exponent for cycle in cycles])
    errors = noise * np.array([cycle.errors for cycle in cycles])
    decrement = -2.0 * np.pi * exponents.real / exponents.imag
    return Decay(
        np.array([cycle.time for cycle in cycles]),
        np.array([cycle.amplitude for cycle in cycles]),
        exponents.imag / (2.0 * np.pi),
        decrement,
        errors[:, 0],
        errors[:, 2] / (2.0 * np.pi),
        np.hypot(2.0 * np.pi * errors[:, 1], decrement * errors[:, 2]) / exponents.imag,
        noise,
    )
