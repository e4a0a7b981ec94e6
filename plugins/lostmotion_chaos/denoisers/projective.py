"""Noise reduction by projection onto the local tangent of the attractor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Denoiser, Series
from lostmotion.kernels.threads import spread
from lostmotion_chaos.denoisers._kernels_projection import fill_neighbourhoods, project, remove_means
from lostmotion_chaos.denoisers.boxes import SLICES, Indices, cut_windows, sort_into_boxes

RADIUS_GROWTH = 2.0**0.5
"""The radius of a neighbourhood grows by this factor until it holds enough windows."""
LEAST_RADIUS = 1e-6
"""The smallest radius of a neighbourhood, as a share of the range of the series."""


@dataclass(frozen=True)
class LocalProjective(Denoiser):
    """Each window of `dim` samples is projected onto the `keep` widest axes of its neighbours, corrected for curvature.

    Grassberger, Hegger, Kantz, Schaffrath, Schreiber, Chaos 3 (1993) 127-141. Two of the axes are the ends of the
    window, which are not changed by the projection. The radius of a neighbourhood is `radius` times the noise, or
    larger where it would hold fewer than `least` windows; of more than `most` windows only a part is used. An iteration
    that would make the total correction larger than the noise is not made: it would distort the attractor.
    """

    dim: int = 15
    keep: int = 4
    least: int = 30
    most: int = 100
    radius: float = 2.0
    iterations: int = 2
    phase: bool = True
    name: ClassVar[str] = "local_projective"
    paper: ClassVar[str] = "Grassberger, Hegger, Kantz, Schaffrath, Schreiber, Chaos 3 (1993) 127-141"

    def clean(self, series: Series, *, noise: float, rng: np.random.Generator) -> Array:
        x = series.x.copy()
        if not (noise > 0.0 and series.n - self.dim >= 2 * self.least):
            return x
        driven = series if self.phase else Series(series.x, series.dt, series.embedding)
        for _ in range(self.iterations):
            cleaner = self._project(x, self.radius * noise, driven)
            if np.sqrt(np.mean((cleaner - series.x) ** 2)) > noise:
                break
            x = cleaner
        return x

    def _project(self, x: Array, radius: float, series: Series) -> Array:
        """Return `x` (n,) after one projection: a sample moves by the mean over the windows that contain it inside."""
        members, sizes = self._find_neighbourhoods(x, radius, series)
        rows, inner = len(sizes), self.dim - 2
        raw, bare = np.empty((rows, inner)), np.empty((rows, inner))
        axes = max(self.keep - 2, 0)
        spread(lambda a, b: project(x, self.dim, axes, members, sizes, (a, b), raw), rows)
        spread(lambda a, b: remove_means(members, sizes, raw, (a, b), bare), rows)
        total, windows_of = np.zeros(len(x)), np.zeros(len(x))
        for k in range(inner):
            total[k + 1 : k + 1 + rows] += bare[:, k]
            windows_of[k + 1 : k + 1 + rows] += 1.0
        moved: Array = x - total / np.maximum(windows_of, 1.0)
        return moved

    def _find_neighbourhoods(self, x: Array, radius: float, series: Series) -> tuple[Indices, Indices]:
        """Return the indices (rows, most) of the neighbours of each window and their numbers (rows,)."""
        rows = len(x) - self.dim + 1
        members = np.zeros((rows, self.most), dtype=np.int32)
        sizes = np.zeros(rows, dtype=np.int32)
        radius = max(radius, LEAST_RADIUS * float(np.ptp(x)))
        points = cut_windows(x, self.dim, radius, series)
        while not sizes.all():
            self._add_neighbourhoods(points, radius, members, sizes)
            radius *= RADIUS_GROWTH
        return members, sizes

    def _add_neighbourhoods(self, points: Array, radius: float, members: Indices, sizes: Indices) -> None:
        """Add the neighbours of those `points` that have enough of them within `radius`."""
        boxes = sort_into_boxes(points, self.dim, radius)

        def work(a: int, b: int) -> None:
            fill_neighbourhoods(
                boxes.points, boxes.order, radius, boxes.offsets, boxes.shape, (a, b), self.least, members, sizes
            )

        spread(work, int(boxes.shape[0]), slices=SLICES)
