"""Spectra, the period of the dominant line, and a series without the lines of its drive."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from lostmotion.errors import DataError

Array = NDArray[np.float64]
SEGMENTS = 16
"""The number of pieces whose phases are compared: the phase of a line is continuous between them, noise is not."""
FALSE_ALARM = 1e-3
CHANCE_MEMORY = 0.3
"""The correlation of successive amplitudes that 16 independent ones may have by chance."""
CANDIDATES = 8
FITTED = 10.0
"""A peak is fitted when its chance probability is at most this many times that of a line."""
SKIRT, AROUND = 2.5, (6.0, 24.0)
"""The distance (bins) of residuals beside a line, and the range (bins) of the background."""
STANDS_OUT = 3.0
"""Residuals beside a line may exceed the background by this factor, as in one record of 400 for a line with noise."""
WANDERS = 3e-4
"""The share of the power of a line (rad^2 of its phase) that is allowed beside it, as from the wow of a drive."""
FEWEST_CYCLES = 3.0
STEPS = 12
CHUNK = 4096
PRECISION = 1e-8
"""The accuracy of the frequency of a line, as a share of its width."""
UNEXPLAINED = 0.2
MOST_DIVISIONS = 6


class Spectrum(NamedTuple):
    """One-sided power spectral density (unit^2/Hz) over frequency (Hz), both (k,)."""

    frequency: Array
    density: Array


class Line(NamedTuple):
    """A periodic component: its period and standard error (s), its share of the variance, and its coherence.

    `coherence` is 1 when all segments agree in amplitude and phase; `chance` is the probability of such agreement at
    any frequency for noise with a smooth spectrum.
    """

    period: float
    spread: float
    share: float
    coherence: float
    chance: float


def spectrum(x: Array, dt: float, *, segments: int = 1) -> Spectrum:
    """Return the power spectral density of `x` (n,) under a Hann taper: of the whole series, or Welch's mean.

    The segments overlap by half (Welch, IEEE Trans. Audio Electroacoust. 15, 1967, 70): with more of them, scatter and
    resolution are lower.
    """
    if segments < 1:
        raise DataError(f"{segments} segments give no spectrum: ask for 1 or more")
    length = max(8, 2 * len(x) // (segments + 1))
    frequency, density = signal.welch(x, 1.0 / dt, window="hann", nperseg=min(length, len(x)), detrend="constant")
    return Spectrum(frequency, density)


def fundamental(x: Array, dt: float) -> Line | None:
    """Return the strongest line in the spectrum of `x` (n,), or None where no component has a constant phase.

    A peak is a line if its complex amplitudes in 16 successive pieces agree better than those of noise at the best of
    all frequencies in one series of a thousand, and if it is no wider than the taper: after subtraction of a sinusoid,
    the residuals beside it must be as small as the background, which they are not where the phase drifts. A subharmonic
    or harmonic may be the strongest line. A motion whose phase drifts by less than a tenth of a radian over the series,
    as that of Roessler's equations may in a hundred cycles, cannot be distinguished from a line.
    """
    centred = x - x.mean()
    if len(x) < 4 * SEGMENTS or not centred.any():
        return None
    for guess in _find_peaks(centred, dt):
        if _chance(_align_pieces(_piece_amplitudes(centred, guess * dt)), len(x)) > FITTED * FALSE_ALARM:
            continue
        line = line_at(centred, dt, _refine_frequency(centred, dt, guess, harmonics=1))
        if line is not None:
            return line
    return None


def refined_period(u: Array, dt: float) -> float | None:
    """Return the period (s) of a measured excitation `u` (n,), or None where it is not periodic.

    It is found by nonlinear least squares on the fundamental and its harmonics together. A line that explains too
    little is tried as a harmonic of a longer period, up to six times its own.
    """
    centred = u - u.mean()
    line = fundamental(u, dt)
    if line is None:
        return None
    for divisions in range(1, MOST_DIVISIONS + 1):
        frequency = 1.0 / (line.period * divisions)
        if frequency * len(u) * dt < FEWEST_CYCLES:
            return None
        if _unexplained_share(centred, frequency * dt) > 2.0 * UNEXPLAINED:
            continue
        frequency = _refine_frequency(centred, dt, frequency, harmonics=_count_harmonics(frequency, dt, 3 * divisions))
        if _unexplained_share(centred, frequency * dt) <= UNEXPLAINED:
            return 1.0 / frequency
    return None


def _unexplained_share(x: Array, turns: float) -> float:
    """Return the share of the standard deviation of `x` (n,) that twelve harmonics do not explain."""
    return float(np.std(x - _fit_harmonics(x, turns, _count_harmonics(turns, 1.0, 12))) / np.std(x))


def without_harmonics(
    x: Array, dt: float, period: float, *, harmonics: int = 40, divisions: int = 1
) -> tuple[Array, Array]:
    """Return `x` (n,) without the components at the multiples of 1/`period`, and what was removed (n,).

    Sine and cosine at each multiple are fitted by least squares under a Hann taper, so that a strong subharmonic does
    not leak into them. `divisions` = 2 removes the subharmonics at halves too, 3 those at thirds. A short series of p
    periods loses a share of about 1.5/p of whatever else there is.
    """
    if not (math.isfinite(period) and period > 2.0 * dt):
        raise DataError(f"the period is {period:g} s and the sampling step {dt:g} s: give one of more than two steps")
    if len(x) * dt < 2.0 * period * divisions:
        raise DataError(
            f"{len(x) * dt:g} s contain fewer than two periods of {divisions * period:g} s: record longer, or keep the "
            "harmonics in"
        )
    base = 1.0 / (period * divisions)
    number = _count_harmonics(base, dt, harmonics * divisions)
    removed = _fit_harmonics(x, base * dt, number)
    return x - removed, removed


def _count_harmonics(frequency: float, dt: float, most: int) -> int:
    """Return how many multiples of a frequency (Hz) lie below the Nyquist frequency, at most `most`."""
    return max(1, min(most, math.ceil(0.5 / (frequency * dt) - 1e-9) - 1))


def _find_peaks(x: Array, dt: float) -> list[float]:
    """Return the frequencies (Hz) of the highest peaks with at least three cycles, the highest first."""
    frequency, density = spectrum(x, dt)
    bins = np.arange(1, len(density) - 1)
    tops = bins[(density[1:-1] >= density[:-2]) & (density[1:-1] > density[2:])]
    tops = tops[tops >= FEWEST_CYCLES]
    found = tops[np.argsort(density[tops])[::-1][:CANDIDATES]]
    return [float((k + _peak_offset(density[k - 1 : k + 2])) * frequency[1]) for k in found]


def _peak_offset(three: Array) -> float:
    """Return the position of a peak between bins, from a parabola through the logarithms of three densities."""
    low, middle, high = np.log(np.maximum(three, 1e-300))
    bend = low - 2.0 * middle + high
    return float(0.5 * (low - high) / bend) if bend < 0.0 else 0.0


def line_at(x: Array, dt: float, frequency: float) -> Line | None:
    """Return the line at a frequency (Hz), or None where the phases of the pieces do not agree."""
    pieces = _piece_amplitudes(x, frequency * dt)
    chance = _chance(pieces, len(x))
    if chance > FALSE_ALARM:
        return None
    part = _fit_harmonics(x, frequency * dt, 1)
    if _has_phase_drift(x - part, frequency * dt, float(part @ part) / len(x)):
        return None
    share, spread = float(part @ part) / float(x @ x), _phase_error(pieces, len(x) * dt) / frequency**2
    return Line(1.0 / frequency, spread, share, _coherence(pieces), chance)


def _coherence(pieces: NDArray[np.complex128]) -> float:
    """Return the coherence: 1 for equal complex amplitudes, about 1/16 for independent ones."""
    squares = float(np.sum(np.abs(pieces) ** 2))
    return float(np.abs(pieces.sum()) ** 2 / (SEGMENTS * squares)) if squares > 0.0 else 0.0


def _chance(pieces: NDArray[np.complex128], n: int) -> float:
    """Return the probability of such agreement for `n` samples of noise at the best of all frequencies."""
    # The agreement of independent Gaussian amplitudes has the distribution Beta(1, number - 1).
    return float(min(1.0, 0.5 * n * max(0.0, 1.0 - _coherence(pieces)) ** (_count_independent(pieces) - 1.0)))


def _align_pieces(pieces: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return the amplitudes at the frequency within a bin of the guess at which they agree best."""
    turns = np.linspace(-1.0, 1.0, 41)[:, None] * (np.arange(SEGMENTS) / SEGMENTS)
    turned = pieces * np.exp(-2j * np.pi * turns)
    return np.asarray(turned[int(np.argmax(np.abs(turned.sum(axis=1))))])


def _has_phase_drift(rest: Array, turns: float, power: float) -> bool:
    """Return whether the residuals beside a subtracted line of a given power exceed the background."""
    frequency, density = spectrum(rest, 1.0)
    bins = np.arange(1, len(density))
    away = np.abs(bins - turns * len(rest))
    near, around = density[bins[away <= SKIRT]], density[bins[(away > AROUND[0]) & (away <= AROUND[1])]]
    # The median of exponentially distributed densities is ln 2 times their mean, and is robust against other lines.
    background = float(np.median(around)) / math.log(2.0) if len(around) else math.inf
    over = float(np.sum(near - background) * frequency[1])
    return over > WANDERS * power and float(np.mean(near)) > STANDS_OUT * background


def _piece_amplitudes(x: Array, turns: float) -> NDArray[np.complex128]:
    """Return the complex amplitude of the component with `turns` cycles per sample in each of 16 pieces of `x`."""
    length = len(x) // SEGMENTS
    pieces = x[: length * SEGMENTS].reshape(SEGMENTS, length)
    taper = signal.windows.hann(length, sym=False) if turns * length > 3.0 else np.ones(length)
    wave = np.exp(-2j * np.pi * turns * np.arange(length)) * taper / taper.sum()
    begins = np.exp(-2j * np.pi * np.modf(turns * length * np.arange(SEGMENTS))[0])
    return np.asarray(begins * (pieces @ wave.real + 1j * (pieces @ wave.imag)))


def _count_independent(pieces: NDArray[np.complex128]) -> float:
    """Return the effective number of independent amplitudes, which is smaller for a narrow resonance."""
    left = pieces - pieces.mean()
    power = float(np.sum(np.abs(left) ** 2))
    memory = float(np.real(np.vdot(left[:-1], left[1:]))) / power if power > 0.0 else 0.0
    if memory < CHANCE_MEMORY:
        return float(SEGMENTS)
    return max(3.0, SEGMENTS * (1.0 - memory) / (1.0 + memory))


def _phase_error(pieces: NDArray[np.complex128], duration: float) -> float:
    """Return the standard error (Hz) of a frequency from the scatter of the phases of its pieces."""
    phases = np.angle(pieces / pieces.sum())
    times = duration * ((np.arange(SEGMENTS) + 0.5) / SEGMENTS - 0.5)
    rest = phases - phases.mean() - times * float(times @ phases) / float(times @ times)
    scatter = math.sqrt(float(rest @ rest) / (SEGMENTS - 2))
    return scatter / (2.0 * math.pi * math.sqrt(float(times @ times)))


def _refine_frequency(x: Array, dt: float, guess: float, *, harmonics: int) -> float:
    """Return the frequency (Hz) near a guess at which harmonics fit best: Gauss-Newton, amplitudes projected out."""
    turns, width = guess * dt, 0.5 / len(x)
    for number in dict.fromkeys((1, harmonics)):
        for _ in range(STEPS):
            step = _newton_step(x, turns, number)
            turns += float(np.clip(step, -width, width))
            if abs(step) < PRECISION * width:
                break
    lost = abs(turns - guess * dt) > 4.0 * width or not 0.0 < turns < 0.5
    return guess if lost else turns / dt


def _newton_step(x: Array, turns: float, number: int) -> float:
    """Return the Gauss-Newton step of `turns` (cycles per sample) for a fit of harmonics."""
    coefficients = _fit_coefficients(x, turns, number)
    size = len(coefficients)
    gram, right = np.zeros((size + 1, size + 1)), np.zeros(size + 1)
    centre = 0.5 * (len(x) - 1)
    for first in range(0, len(x), CHUNK):
        waves = _make_waves(first, min(first + CHUNK, len(x)), turns, number)
        slope = _phase_derivative(waves, coefficients, number) * (np.arange(first, first + len(waves)) - centre)
        table = np.column_stack([waves, slope])
        gram += table.T @ table
        right += table.T @ (x[first : first + CHUNK] - waves @ coefficients)
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    solved = np.linalg.lstsq(gram / np.outer(scale, scale), right / scale, rcond=1e-13)[0]
    return float(solved[-1] / scale[-1])


def _phase_derivative(waves: Array, coefficients: Array, number: int) -> Array:
    """Return the derivative by phase of the fitted waves, (rows,)."""
    order = 2.0 * np.pi * np.arange(1, number + 1)
    cosines, sines = coefficients[1 : number + 1], coefficients[number + 1 :]
    return np.asarray(waves[:, number + 1 :] @ (-order * cosines) + waves[:, 1 : number + 1] @ (order * sines))


def _make_waves(first: int, last: int, turns: float, number: int) -> Array:
    """Return one, cosines and sines (rows, 2 number + 1) of the multiples of `turns` cycles per sample."""
    once = np.exp(2j * np.pi * turns * np.arange(first, last))
    powers = np.cumprod(np.broadcast_to(once[:, None], (len(once), number)), axis=1)
    return np.hstack([np.ones((len(once), 1)), powers.real, powers.imag])


def _fit_coefficients(x: Array, turns: float, number: int, weights: Array | None = None) -> Array:
    """Return mean, cosine and sine amplitudes (2 number + 1,) of a fit to `x`, with optional weights."""
    size = 2 * number + 1
    gram, right = np.zeros((size, size)), np.zeros(size)
    for first in range(0, len(x), CHUNK):
        waves = _make_waves(first, min(first + CHUNK, len(x)), turns, number)
        weighted = waves if weights is None else waves * weights[first : first + CHUNK, None]
        gram += weighted.T @ waves
        right += weighted.T @ x[first : first + CHUNK]
    solved = np.linalg.lstsq(gram / len(x), right / len(x), rcond=1e-13)[0]
    return np.asarray(solved, dtype=np.float64)


def _fit_harmonics(x: Array, turns: float, number: int) -> Array:
    """Return the sum (n,) of the harmonics of `turns` cycles per sample in `x`, without the mean."""
    coefficients = _fit_coefficients(x, turns, number, signal.windows.hann(len(x) + 2)[1:-1])
    coefficients[0] = 0.0
    chunks = range(0, len(x), CHUNK)
    return np.concatenate([_make_waves(k, min(k + CHUNK, len(x)), turns, number) @ coefficients for k in chunks])
