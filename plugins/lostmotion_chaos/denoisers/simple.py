"""Noise reduction by the mean over similar pieces of the series."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Denoiser, Series
from lostmotion.kernels.threads import spread
from lostmotion_chaos.denoisers._kernels import average_neighbours
from lostmotion_chaos.denoisers.boxes import SLICES, cut_windows, sort_into_boxes


@dataclass(frozen=True)
class SimpleNonlinear(Denoiser):
    """The middle of each window of `dim` samples is replaced by its mean over similar windows. Schreiber (1993).

    Similar windows differ by at most `radius` times the noise in every sample; in each further one of the `iterations`
    the neighbourhood shrinks to the rms of the last correction. For a driven machine their drive phases must be
    similar, too (`phase`), which reduces the remaining noise by up to a tenth.
    """

    dim: int = 7
    radius: float = 3.0
    iterations: int = 2
    phase: bool = True
    name: ClassVar[str] = "simple_nonlinear"
    paper: ClassVar[str] = "Schreiber, Physical Review E 47 (1993) 2401-2404"

    def clean(self, series: Series, *, noise: float, rng: np.random.Generator) -> Array:
        x, radius = series.x.copy(), self.radius * noise
        driven = series if self.phase else Series(series.x, series.dt, series.embedding)
        for _ in range(self.iterations):
            if not (radius > 0.0 and series.n >= 4 * self.dim):
                break
            cleaner = _average_windows(x, self.dim, radius, driven)
            radius = float(np.sqrt(np.mean((cleaner - x) ** 2)))
            x = cleaner
        return x


def _average_windows(x: Array, dim: int, radius: float, series: Series) -> Array:
    """Return `x` (n,) with the middle of each window averaged over its neighbours; the ends stay as they are."""
    boxes = sort_into_boxes(cut_windows(x, dim, radius, series), dim, radius)
    columns = np.ascontiguousarray(boxes.points.T)
    middle = columns[dim // 2].copy()
    means = np.empty(len(middle))

    def work(begin: int, end: int) -> None:
        average_neighbours(columns, middle, radius, boxes.offsets, boxes.shape, (begin, end), means)

    spread(work, int(boxes.shape[0]), slices=SLICES)
    out = x.copy()
    out[boxes.order + dim // 2] = means
    return out
