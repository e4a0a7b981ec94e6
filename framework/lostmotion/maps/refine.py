"""A map that is fine where the boundary of chaos is: squares whose corners differ are halved, again and again."""

from __future__ import annotations

import itertools
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from lostmotion.contracts import Array
from lostmotion.maps.cells import Columns, Study, blank_columns
from lostmotion.maps.layout import MapLayout, listed, map_origin
from lostmotion.maps.store import load
from lostmotion.maps.sweep import Cells, Crew, Say, sweep

DIFFERENT = 0.3
"""How far the shares of chaos at the corners of a square must lie apart for it to be halved."""
MOST = 8
"""Halvings at most."""


def refined(study: Study, levels: int, folder: Path, *, crew: Crew, say: Say) -> tuple[MapLayout, Columns]:
    """Return the layout and columns of a map on the grid of `study` halved `levels` times, fine at the boundary.

    Each level is a store in `folder`, so that what was computed is not lost. A cell that was not computed holds the
    numbers of the nearest one that was, and `level` -1.
    """
    folder.mkdir(exist_ok=True)
    fine = replace(study, axes=tuple(axis.finer(levels) for axis in study.axes))
    level = np.full(fine.shape, -1, np.int8)
    columns = blank_columns(fine, int(np.prod(fine.shape)))
    share = columns["chaotic_fraction"].reshape(fine.shape)
    for stage in range(levels + 1):
        step = 2 ** (levels - stage)
        cells = _coarse(fine.shape, step) if stage == 0 else _split(share, level, 2 * step)
        if len(cells):
            _compute(listed(fine, cells, level=stage), folder / f"{stage}.zarr", (crew, say), columns)
            level[tuple(cells.T)] = stage
    return _whole(study, fine, levels, (level, columns))


def _compute(layout: MapLayout, path: Path, how: tuple[Crew, Say], columns: Columns) -> None:
    """Compute a list of cells, and put it into the columns of the whole grid."""
    sweep(path, layout, *how)
    found = load(path)
    rows = np.ravel_multi_index(tuple(np.asarray(layout.cells).T), layout.study.shape)
    for name in columns:
        columns[name][rows] = found[name].to_numpy()


def finished_layout(study: Study, levels: int) -> MapLayout:
    """Return the layout of the map that `refined` returns."""
    fine = replace(study, axes=tuple(axis.finer(levels) for axis in study.axes))
    dims = tuple(axis.name for axis in study.axes)
    return MapLayout(fine, dims, fine.shape, map_origin(study, levels=levels), refined=True)


def _whole(
    study: Study, fine: Study, levels: int, found: tuple[NDArray[np.int8], Columns]
) -> tuple[MapLayout, Columns]:
    """Return the map on the whole fine grid, each cell that was not computed taking the numbers of its nearest."""
    level, columns = found
    nearest = distance_transform_edt(level < 0, return_distances=False, return_indices=True)
    rows = np.ravel_multi_index(tuple(nearest), fine.shape).ravel()
    told: Columns = {name: values[rows].reshape(*fine.shape, *values.shape[1:]) for name, values in columns.items()}
    return finished_layout(study, levels), {**told, "level": level}


def _coarse(shape: tuple[int, ...], step: int) -> Cells:
    """Return the places of every `step`-th cell."""
    return np.array(list(itertools.product(*(range(0, n, step) for n in shape))), dtype=np.int64)


def _split(share: Array, level: NDArray[np.int8], side: int) -> Cells:
    """Return the places that halve the squares of this side whose corners are known and differ."""
    corners = [_corner(np.where(level >= 0, share, np.nan), c, side) for c in _corners(share.ndim, 1)]
    stack = np.stack(corners)
    # NaN where a corner is not known: the comparison is false there.
    different = stack.max(axis=0) - stack.min(axis=0) > DIFFERENT
    begin = np.argwhere(different) * side
    added = np.array(list(_corners(share.ndim, 2))) * (side // 2)
    cells = np.unique((begin[:, None, :] + added).reshape(-1, share.ndim), axis=0)
    new: Cells = cells[level[tuple(cells.T)] < 0]
    return new


def _corners(many: int, last: int) -> itertools.product[tuple[int, ...]]:
    return itertools.product(range(last + 1), repeat=many)


def _corner(values: Array, corner: tuple[int, ...], side: int) -> Array:
    """Return the values at one corner of every square of the coarse grid of this side."""
    coarse = values[(slice(None, None, side),) * values.ndim]
    return coarse[tuple(slice(c, n - 1 + c) for c, n in zip(corner, coarse.shape, strict=True))]


def cleared(folder: Path) -> None:
    """Remove stores that served to make a file."""
    shutil.rmtree(folder, ignore_errors=True)
