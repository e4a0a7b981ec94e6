"""The base frequency of a motion, and its description by two frequencies and their combinations."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from lostmotion.signals.spectra import Line, fundamental, line_at

Array = NDArray[np.float64]
ORDER = 6
"""Combinations m f1 + n f2 up to this order are fitted."""
FAINTEST = 1e-3
"""A line with a smaller share of the variance is not accepted as the base of a stronger one."""
LONGEST = 6000
"""The greatest number of samples that are used: they give sufficient resolution, and the effort grows as its square."""


def base_line(x: Array, dt: float) -> Line | None:
    """Return the line of which the strongest one in `x` (n,) is a harmonic, up to the sixth; None where there is none.

    In a machine with impacts a harmonic of the drive may be stronger than the drive.
    """
    strongest = fundamental(x, dt)
    if strongest is None:
        return None
    centred = x - x.mean()
    longer = [line_at(centred, dt, 1.0 / (k * strongest.period)) for k in range(2, 7)]
    found = [line for line in longer if line is not None and line.share > FAINTEST]
    return found[-1] if found else strongest


class TwoTones(NamedTuple):
    """The second frequency (Hz), and the share of the standard deviation that two tones do not explain."""

    second: float
    left: float


def two_tones(x: Array, dt: float, first: float) -> TwoTones:
    """Return how well combinations of the frequency `first` (Hz) and of a second one explain the series `x` (n,).

    The residual is corrected for the number of fitted lines. Lines up to the Nyquist frequency are used.
    """
    piece = x[: min(len(x), LONGEST)] - x[: min(len(x), LONGEST)].mean()
    t: Array = dt * np.arange(len(piece), dtype=float)
    rest = piece - _fit_lines(piece, t, _combine_tones(first, 0.0, ORDER, 0, 0.5 / dt))
    second = _find_strongest(rest, dt, first)
    bin_width = 1.0 / t[-1]
    for order, reach in ((1, 1.0), (3, 0.2), (ORDER, 0.05)):
        second = _refine_second(piece, t, (first, second), order, reach * bin_width)
    lines = _combine_tones(first, second, ORDER, ORDER, 0.5 / dt)
    left = piece - _fit_lines(piece, t, lines)
    freedom = max(len(piece) - 2 * len(lines), 1)
    return TwoTones(second, float(np.sqrt(np.sum(left**2) / freedom) / np.std(piece)))


def _combine_tones(first: float, second: float, most_first: int, most_second: int, highest: float) -> Array:
    """Return the frequencies |m f1 + n f2| up to `highest`, each once, nothing at zero."""
    m, n = np.meshgrid(np.arange(-most_first, most_first + 1), np.arange(most_second + 1))
    lines = np.unique(np.round(np.abs(m * first + n * second).ravel(), 12))
    apart = np.concatenate([[True], np.diff(lines) > 1e-6 * first])
    return np.asarray(lines[apart & (lines > 1e-3 * first) & (lines < highest)])


def _fit_lines(x: Array, t: Array, lines: Array) -> Array:
    """Return the least-squares sum of sines at the `lines` (Hz)."""
    if not len(lines):
        return np.zeros_like(x)
    angle = 2.0 * np.pi * np.outer(t, lines)
    basis = np.concatenate([np.cos(angle), np.sin(angle)], axis=1)
    gram = basis.T @ basis
    gram[np.diag_indices_from(gram)] += 1e-9 * len(t)
    return np.asarray(basis @ np.linalg.solve(gram, basis.T @ x))


def _find_strongest(rest: Array, dt: float, first: float) -> float:
    """Return the frequency (Hz) of the strongest line of `rest`, by a padded and tapered transform."""
    size = 8 * len(rest)
    power = np.abs(np.fft.rfft(rest * np.hanning(len(rest)), size))
    frequency = np.fft.rfftfreq(size, dt)
    power[frequency < 2.0 / (dt * len(rest))] = 0.0
    return float(frequency[int(np.argmax(power))])


def _refine_second(x: Array, t: Array, tones: tuple[float, float], order: int, reach: float) -> float:
    """Return the second frequency with the least residual of combinations up to `order`."""
    first, second = tones
    highest = 0.5 / (t[1] - t[0])

    def left(f: float) -> float:
        return float(np.sum((x - _fit_lines(x, t, _combine_tones(first, f, order, order, highest))) ** 2))

    found = minimize_scalar(left, bounds=(second - reach, second + reach), method="bounded", options={"maxiter": 25})
    return float(found.x)
