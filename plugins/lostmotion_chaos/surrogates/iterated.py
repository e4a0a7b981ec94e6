"""Surrogates with both the values and the spectrum of the recording, which are imposed in turns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from lostmotion.contracts import Array, Series, Surrogate
from lostmotion.kernels.threads import spread
from lostmotion_chaos.surrogates._kernels import arrange, impose
from lostmotion_chaos.surrogates.ends import choose_piece


@dataclass(frozen=True)
class Iaaft(Surrogate):
    """Series with the values and the spectrum of the recording. Schreiber, Schmitz, PRL 77 (1996) 635-638.

    `exact` names the property that agrees exactly; the other agrees to about 3e-4 (relative rms of the amplitudes, or
    of the values). Iteration ends when that error falls by less than the share `tolerance` in one iteration, or when
    the order of the values no longer changes.
    """

    exact: Literal["amplitudes", "spectrum"] = "amplitudes"
    tolerance: float = 0.02
    most: int = 1000
    match_ends: bool = True
    name: ClassVar[str] = "iaaft"
    paper: ClassVar[str] = "Schreiber, Schmitz, Physical Review Letters 77 (1996) 635-638"
    null: ClassVar[str] = "a linear, stationary Gaussian process, seen through a monotone sensor that may be curved"
    preserves: ClassVar[frozenset[str]] = frozenset({"mean", "variance", "amplitudes", "spectrum"})

    def piece(self, series: Series) -> slice:
        """Return the piece of the series that the surrogates are drawn of."""
        return choose_piece(series, match_ends=self.match_ends)

    def draw(self, series: Series, *, draws: int, rng: np.random.Generator) -> Array:
        x = series.x[self.piece(series)]
        out = np.empty((draws, len(x)))
        target, streams = _Target.of(x), rng.spawn(draws)

        def work(begin: int, end: int) -> None:
            for k in range(begin, end):
                out[k] = self._one(target, streams[k])

        spread(work, draws, slices=draws)
        return out

    def _one(self, target: _Target, rng: np.random.Generator) -> Array:
        n = len(target.values)
        room = np.empty((2, n), dtype=np.int64)
        series = rng.permutation(target.single)
        before = np.inf
        for _ in range(self.most):
            spectrum = fft.rfft(series)
            off = impose(spectrum, target.sizes) ** 0.5
            smooth = fft.irfft(spectrum, n=n)
            if off >= (1.0 - self.tolerance) * before or arrange(smooth, target.single, room, series) == 0:
                break
            before = off
        return target.values_as(series, room) if self.exact == "amplitudes" else target.spectrum_as(series)


@dataclass(frozen=True, eq=False)
class _Target:
    """The properties that every surrogate gets: sorted values, and amplitudes of the Fourier spectrum.

    Values and amplitudes in single precision are scaled to a standard deviation of one, since squares of values in
    small units would underflow.
    """

    values: Array
    sizes: Array
    centre: float
    scale: float
    single: Array
    double: Array

    @classmethod
    def of(cls, x: Array) -> _Target:
        """Return the target for surrogates of the series `x` (n,)."""
        centre, scale = float(np.mean(x)), float(np.std(x)) or 1.0
        z = (x - centre) / scale
        lines = np.abs(fft.rfft(z))
        ordered = np.sort(z)
        return cls(np.sort(x), lines.astype(np.float32), centre, scale, ordered.astype(np.float32), lines)

    def values_as(self, series: Array, room: NDArray[np.int64]) -> Array:
        """Return the values, unrounded, in the order of `series`."""
        out = np.empty(len(series))
        arrange(series, self.values, room, out)
        return out

    def spectrum_as(self, series: Array) -> Array:
        """Return the series that has the phases of `series` and the spectrum of the recording, unrounded."""
        spectrum = fft.rfft(series.astype(np.float64))
        impose(spectrum, self.double)
        smooth: Array = fft.irfft(spectrum, n=len(series))
        return smooth * self.scale + self.centre
