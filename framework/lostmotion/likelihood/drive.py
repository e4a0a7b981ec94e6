"""The inputs of a system: measured values and their interpolation between samples."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array

QUARTERS = np.array([0.125, 0.375, 0.625, 0.875])
"""The middles of the quarters of a sample: an input that is held is represented by its means over quarters."""
_THIRDS = np.array([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])
_CUBIC = np.linalg.inv(_THIRDS[:, None] ** np.arange(4))
_LINE = np.linalg.pinv(QUARTERS[:, None] ** np.arange(2))


class DriveHarmonic(NamedTuple):
    """The harmonic drive of a recording: angular frequency (rad/s; 0 where there is none) and amplitude."""

    omega: float = 0.0
    amplitude: float = 0.0


SILENT = DriveHarmonic()


@dataclass(frozen=True)
class Drive:
    """Measured inputs as a cubic for each sample: at the share s of sample k it is the sum of `cubics[k, j] * s**j`.

    `cubics` is (samples, 4, inputs). An input that jumps at the samples (`hold = "step"`) is integrated exactly, since
    each sample has a cubic of its own. `begin` is the time of the first sample, `dt` that between two (s).
    """

    cubics: Array
    dt: float
    begin: float = 0.0
    harmonic: DriveHarmonic = SILENT

    @property
    def samples(self) -> int:
        """The number of samples."""
        return len(self.cubics)

    @property
    def inputs(self) -> Array:
        """The inputs (samples, inputs) at the samples."""
        return self.cubics[:, 0]

    def pad_inputs(self, count: int) -> Drive:
        """Return the drive with `count` inputs: missing ones are zero."""
        return replace(self, cubics=pad_inputs(self.cubics, count)) if self.cubics.shape[2] < count else self

    @classmethod
    def smooth(cls, columns: Sequence[Callable[[Array], Array]], dt: float, samples: int, begin: float = 0.0) -> Drive:
        """Return the drive of functions of time (s), one to each input: cubics through four points of each sample."""
        t = begin + ((np.arange(samples)[:, None] + _THIRDS) * dt).ravel()
        values = np.stack([np.asarray(f(t), dtype=float).reshape(samples, 4) for f in columns], axis=2)
        return cls(_fit_polynomials(_CUBIC, values), dt, begin)

    @classmethod
    def held(cls, inputs: Array, dt: float) -> Drive:
        """Return the drive of inputs (samples, inputs) that are held between the samples."""
        cubics = np.zeros((len(inputs), 4, inputs.shape[1]))
        cubics[:, 0] = inputs
        return cls(cubics, dt)

    @classmethod
    def acting(cls, columns: Sequence[Callable[[Array], Array] | None], grid: Drive, held: bool) -> Drive:
        """Return a drive on the samples of another: from functions of time (s), or its own inputs where there is None.

        One that is `held` is a line over each sample, with the mean and the first moment of the input.
        """
        places = QUARTERS if held else _THIRDS
        t = grid.begin + ((np.arange(grid.samples)[:, None] + places) * grid.dt).ravel()
        cubics = grid.cubics.copy()
        for i, column in enumerate(columns):
            if column is not None:
                values = np.asarray(column(t), dtype=float).reshape(grid.samples, 4, 1)
                cubics[:, :, i] = 0.0
                cubics[:, : 2 if held else 4, i] = _fit_polynomials(_LINE if held else _CUBIC, values)[:, :, 0]
        return replace(grid, cubics=cubics)


def pad_inputs(columns: Array, count: int) -> Array:
    """Return columns (..., inputs) padded with zeros to `count` in all: an input that nothing drives is zero."""
    lacking = count - columns.shape[-1]
    return np.concatenate([columns, np.zeros((*columns.shape[:-1], lacking))], axis=-1) if lacking > 0 else columns


def _fit_polynomials(inverse: Array, values: Array) -> Array:
    """Return the coefficients (samples, powers, inputs) of polynomials through `values` (samples, places, inputs)."""
    return np.ascontiguousarray(np.einsum("jp,kpi->kji", inverse, values))


def count_substeps(rate: float, dt: float, *, accuracy: float = 0.06, most: int = 64) -> int:
    """Return the number of steps between samples for which `rate * step <= accuracy` (0.06: 105 steps a cycle)."""
    return math.ceil(min(max(rate * dt / accuracy, 1.0), most))
