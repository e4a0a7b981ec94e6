"""SysIdentPy for `benchmarks/beside_peers.py`: polynomial NARX models by forward regression (FROLS).

Readings are smoothed and taken at every `stride`-th sample. All settings are compared by free runs over a part of the
fitted data. The terms of such a model are products of delayed samples: none is physics with a name.
"""

from __future__ import annotations

import itertools

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import savgol_filter

from peer_tracks import Model, Track, choose_simplest, measure_error

STRIDES, SHAPES, TERMS, RUNS = (2, 3, 4), ((3, 4), (5, 2), (5, 3), (7, 2)), (20, 50, 100, 160), 40
"""Samples of a step, degree and lags of a model, its number of terms, and free runs of a comparison."""
WINDOW, FAR, FEW, MANY = 5, 1e6, 20, 1500


class Narx:
    """A NARX model of the fitted part; a free run begins at the smoothed readings before its start."""

    def __init__(self, track: Track, stride: int, shape: tuple[int, int], terms: int) -> None:
        from sysidentpy.basis_function import Polynomial
        from sysidentpy.model_structure_selection import FROLS
        from sysidentpy.parameter_estimation import LeastSquares

        degree, self.lag = shape
        self.stride, self.size = stride, float(np.std(track.position))
        smooth = track.position if count_unit(track) < FEW else savgol_filter(track.position, WINDOW, 3)
        self.seen = smooth[:, None] / self.size
        self.drive = None if track.free else track.drive[:, None] / float(np.std(track.drive))
        basis, model = Polynomial(degree=degree), "NAR" if track.free else "NARMAX"
        self.model = FROLS(
            ylag=self.lag, xlag=self.lag, basis_function=basis, model_type=model, n_terms=terms,
            order_selection=False, estimator=LeastSquares(),
        )  # fmt: skip
        cut = slice(0, track.begin, stride)
        self.model.fit(X=None if self.drive is None else self.drive[cut], y=self.seen[cut])

    def __call__(self, starts: np.ndarray, samples: int) -> np.ndarray:
        """Return positions (runs, samples) in the unit of the recording; infinite where a run diverges."""
        at = self.stride * np.arange(1 - self.lag, -(-samples // self.stride) + 1)
        found = np.full((len(starts), samples), np.inf)
        for row, start in enumerate(starts):
            used = start + at[start + at < len(self.seen)]
            drive = None if self.drive is None else self.drive[used]
            path = self.model.predict(X=drive, y=self.seen[used[: self.lag]], forecast_horizon=len(used) - self.lag)
            if np.all(np.abs(path) < FAR):
                found[row] = self.size * CubicSpline(used, path[: len(used), 0])(start + np.arange(samples))
        return found


def count_unit(track: Track) -> float:
    """Return the number of samples of a unit of time; readings are not smoothed where they are few."""
    return min(track.horizon[1] / track.dt, len(track.position) / 4)


def list_strides(track: Track) -> list[int]:
    """Return the strides: the usual ones, longer where many samples make a unit of time, and 1 where there are few."""
    unit = count_unit(track)
    return [1] if unit < FEW else [one * max(1, round(unit / MANY)) for one in STRIDES]


def fit(track: Track) -> Model:
    """Return the NARX model of the fitted part of a recording."""
    test = track.hold_out_more()
    tried = [
        (measure_error(test, Narx(test, *one), RUNS)[0], one[2], one)
        for one in itertools.product(list_strides(test), SHAPES, TERMS)
    ]
    stride, shape, terms = choose_simplest(tried)
    says = f"degree {shape[0]}, {shape[1]} lags of {stride} samples, {terms} terms"
    return Model((), Narx(track, stride, shape, terms), says)
