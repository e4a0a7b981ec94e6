"""Surrogates with random Fourier phases: of the series, and of the series made Gaussian."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy import fft
from scipy.special import ndtri

from lostmotion.contracts import Array, Series, Surrogate
from lostmotion_plugins.surrogates.ends import piece


@dataclass(frozen=True)
class Fourier(Surrogate):
    """Series with the spectrum of the recording and random phases. Theiler et al., Physica D 58 (1992) 77-94.

    `match_ends` cuts the series to the piece whose ends meet best.
    """

    match_ends: bool = True
    name: ClassVar[str] = "fourier"
    paper: ClassVar[str] = "Theiler, Eubank, Longtin, Galdrikian, Farmer, Physica D 58 (1992) 77-94"
    null: ClassVar[str] = "a linear, stationary process driven by Gaussian noise"
    preserves: ClassVar[frozenset[str]] = frozenset({"mean", "variance", "spectrum"})

    def piece(self, series: Series) -> slice:
        """Return the piece of the series that the surrogates are drawn of."""
        return piece(series.x) if self.match_ends else slice(0, series.n)

    def draw(self, series: Series, *, draws: int, rng: np.random.Generator) -> Array:
        x = series.x[self.piece(series)]
        return np.array([randomised(x, stream) for stream in rng.spawn(draws)]).reshape(draws, len(x))


@dataclass(frozen=True)
class Aaft(Surrogate):
    """Series with the values of the recording in a new order. Theiler et al., Physica D 58 (1992) 77-94.

    The spectrum comes out whiter than that of the recording, the more so the shorter it is: `iaaft` mends that.
    """

    match_ends: bool = True
    name: ClassVar[str] = "aaft"
    paper: ClassVar[str] = "Theiler, Eubank, Longtin, Galdrikian, Farmer, Physica D 58 (1992) 77-94"
    null: ClassVar[str] = "a linear, stationary Gaussian process, seen through a monotone sensor that may be curved"
    preserves: ClassVar[frozenset[str]] = frozenset({"mean", "variance", "amplitudes"})

    def piece(self, series: Series) -> slice:
        """Return the piece of the series that the surrogates are drawn of."""
        return piece(series.x) if self.match_ends else slice(0, series.n)

    def draw(self, series: Series, *, draws: int, rng: np.random.Generator) -> Array:
        x = series.x[self.piece(series)]
        return np.array([_reordered(x, stream) for stream in rng.spawn(draws)]).reshape(draws, len(x))


def randomised(x: Array, rng: np.random.Generator) -> Array:
    """Return a series (n,) with the spectrum of `x` (n,) and random phases."""
    spectrum = fft.rfft(x)
    turns = np.exp(2j * np.pi * rng.random(len(spectrum)))
    turns[0] = 1.0
    if len(x) % 2 == 0:
        turns[-1] = 1.0 if turns[-1].real > 0.0 else -1.0
    turned: Array = fft.irfft(spectrum * turns, n=len(x))
    return turned


def _reordered(x: Array, rng: np.random.Generator) -> Array:
    """Return the values of `x` in the order of a phase-randomised Gaussian series that was ordered as `x` is.

    Equal values are ranked at random: in the order of time they would make a ramp of each stretch of them.
    """
    n = len(x)
    order = np.lexsort((rng.random(n), x))
    gaussian = np.empty(n)
    gaussian[order] = ndtri((np.arange(n) + 0.5) / n)
    out = np.empty(n)
    out[np.argsort(randomised(gaussian, rng))] = x[order]
    return out
