"""Windows of a series, sorted into boxes of the size of a neighbourhood."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Series
from lostmotion_plugins.denoisers._kernels import boxed

Indices = NDArray[np.int64] | NDArray[np.int32]
MOST = 1000
"""Boxes on a side at most: more of them cost more to walk through than they save."""
PHASE = 0.4
"""Neighbours of a driven machine lie within this phase (rad) of the drive: an eighth of a period in all."""


@dataclass(frozen=True, eq=False)
class Boxes:
    """Windows (rows, columns) in the order of their boxes: window `order[k]` of the series stands at place k.

    The windows of box b are offsets[b]:offsets[b + 1]; boxes lie in `shape` (2,) over the first and the last sample.
    """

    points: Array
    order: Indices
    offsets: Indices
    shape: Indices


def windows(x: Array, dim: int, radius: float, series: Series) -> Array:
    """Return the windows (n - dim + 1, dim or dim + 2) of `x`, each with its drive phase where there is a drive.

    Two phases further apart than `PHASE` stand more than `radius` apart, so that one comparison serves for all.
    """
    rows = np.lib.stride_tricks.sliding_window_view(x, dim)
    if series.period is None:
        return np.ascontiguousarray(rows)
    turns = (np.arange(len(rows)) + dim // 2) * (series.dt / series.period)
    phase = 2.0 * np.pi * (turns % 1.0)
    circle = radius / PHASE * np.stack([np.cos(phase), np.sin(phase)], axis=1)
    return np.hstack([rows, circle])


def sort_into_boxes(points: Array, dim: int, radius: float) -> Boxes:
    """Return the windows `points` (rows, columns), `dim` samples wide, in boxes no smaller than `radius`."""
    ends = np.ascontiguousarray(points[:, [0, dim - 1]].T)
    low, high = ends.min(axis=1), ends.max(axis=1)
    size = max(radius, float((high - low).max()) / (MOST - 1)) or 1.0
    shape: Any = ((high - low) / size).astype(np.int64) + 1
    order, offsets = boxed(ends[0], ends[1], size, low, shape)
    return Boxes(np.ascontiguousarray(points[order]), order, offsets, shape)
