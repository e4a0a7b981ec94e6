"""Surrogates with random Fourier phases: of the series, and of the series transformed to Gaussian values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy import fft
from scipy.special import ndtri

from lostmotion.contracts import Array, Series, Surrogate
from lostmotion_chaos.surrogates.ends import choose_piece


@dataclass(frozen=True)
class Fourier(Surrogate):
    """Series with the spectrum of the recording and random phases. Theiler et al., Physica D 58 (1992) 77-94.

    `match_ends` cuts the series to the piece whose ends match best.
    """

    match_ends: bool = True
    name: ClassVar[str] = "fourier"
    paper: ClassVar[str] = "Theiler, Eubank, Longtin, Galdrikian, Farmer, Physica D 58 (1992) 77-94"
    null: ClassVar[str] = "a linear, stationary process driven by Gaussian noise"
    preserves: ClassVar[frozenset[str]] = frozenset({"mean", "variance", "spectrum"})

    def piece(self, series: Series) -> slice:
        """Return the piece of the series that the surrogates are drawn of."""
        return choose_piece(series, match_ends=self.match_ends)

    def draw(self, series: Series, *, draws: int, rng: np.random.Generator) -> Array:
        return _draw_each(series.x[self.piece(series)], draws, rng, randomise_phases)


@dataclass(frozen=True)
class Aaft(Surrogate):
    """Series with the values of the recording in a new order. Theiler et al., Physica D 58 (1992) 77-94.

    The spectrum is whiter than that of the recording, the more so the shorter the recording is; `iaaft` avoids that.
    """

    match_ends: bool = True
    name: ClassVar[str] = "aaft"
    paper: ClassVar[str] = "Theiler, Eubank, Longtin, Galdrikian, Farmer, Physica D 58 (1992) 77-94"
    null: ClassVar[str] = "a linear, stationary Gaussian process, seen through a monotone sensor that may be curved"
    preserves: ClassVar[frozenset[str]] = frozenset({"mean", "variance", "amplitudes"})

    def piece(self, series: Series) -> slice:
        """Return the piece of the series that the surrogates are drawn of."""
        return choose_piece(series, match_ends=self.match_ends)

    def draw(self, series: Series, *, draws: int, rng: np.random.Generator) -> Array:
        return _draw_each(series.x[self.piece(series)], draws, rng, _reorder_values)


def _draw_each(
    x: Array, draws: int, rng: np.random.Generator, draw: Callable[[Array, np.random.Generator], Array]
) -> Array:
    """Return surrogates (draws, n) of `x` (n,), each drawn with a random stream of its own."""
    return np.array([draw(x, stream) for stream in rng.spawn(draws)]).reshape(draws, len(x))


def randomise_phases(x: Array, rng: np.random.Generator) -> Array:
    """Return a series (n,) with the spectrum of `x` (n,) and random phases."""
    spectrum = fft.rfft(x)
    turns = np.exp(2j * np.pi * rng.random(len(spectrum)))
    turns[0] = 1.0
    if len(x) % 2 == 0:
        turns[-1] = 1.0 if turns[-1].real > 0.0 else -1.0
    turned: Array = fft.irfft(spectrum * turns, n=len(x))
    return turned


def _reorder_values(x: Array, rng: np.random.Generator) -> Array:
    """Return the values of `x` in the order of a phase-randomised Gaussian series with the ranks of `x`.

    Equal values are ranked at random: in the order of time, a stretch of equal values would become a ramp.
    """
    n = len(x)
    order = np.lexsort((rng.random(n), x))
    gaussian = np.empty(n)
    gaussian[order] = ndtri((np.arange(n) + 0.5) / n)
    out = np.empty(n)
    out[np.argsort(randomise_phases(gaussian, rng))] = x[order]
    return out
