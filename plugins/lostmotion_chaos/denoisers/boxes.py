"""Windows of a series, sorted into boxes with the size of a neighbourhood."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Series
from lostmotion_chaos.denoisers._kernels import sort_points

Indices = NDArray[np.int64] | NDArray[np.int32]
MOST_BOXES = 1000
"""At most so many boxes on each side: with more boxes, visiting them costs more than they save."""
PHASE_RADIUS = 0.4
"""Neighbours of a driven machine have drive phases within this angle (rad): an eighth of a period in total. Chosen by
experience; no measurement recorded."""
SLICES = 64
"""Pieces of work for the threads: many, since boxes are filled unevenly."""


@dataclass(frozen=True, eq=False)
class Boxes:
    """Windows (rows, columns) in the order of their boxes: window `order[k]` of the series is row k.

    The windows of box b are offsets[b]:offsets[b + 1]; boxes lie in `shape` (2,) over the first and the last sample.
    """

    points: Array
    order: Indices
    offsets: Indices
    shape: Indices


def cut_windows(x: Array, dim: int, radius: float, series: Series) -> Array:
    """Return the windows (n - dim + 1, dim or dim + 2) of `x`, each with its drive phase where there is a drive.

    The phase is scaled such that phases that differ by more than `PHASE_RADIUS` are more than `radius` apart, so that
    the same comparison serves for all columns.
    """
    rows = np.lib.stride_tricks.sliding_window_view(x, dim)
    if series.period is None:
        return np.ascontiguousarray(rows)
    turns = (np.arange(len(rows)) + dim // 2) * (series.dt / series.period)
    phase = 2.0 * np.pi * (turns % 1.0)
    circle = radius / PHASE_RADIUS * np.stack([np.cos(phase), np.sin(phase)], axis=1)
    return np.hstack([rows, circle])


def sort_into_boxes(points: Array, dim: int, radius: float) -> Boxes:
    """Return the windows `points` (rows, columns), `dim` samples wide, sorted into boxes no smaller than `radius`."""
    ends = np.ascontiguousarray(points[:, [0, dim - 1]].T)
    low, high = ends.min(axis=1), ends.max(axis=1)
    size = max(radius, float((high - low).max()) / (MOST_BOXES - 1)) or 1.0
    shape: Any = ((high - low) / size).astype(np.int64) + 1
    order, offsets = sort_points(ends[0], ends[1], size, low, shape)
    return Boxes(np.ascontiguousarray(points[order]), order, offsets, shape)
