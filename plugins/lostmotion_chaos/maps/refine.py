"""Adaptive refinement of a map along the boundary of chaos: squares whose corners differ are halved repeatedly."""

from __future__ import annotations

import itertools
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from lostmotion.contracts import Array
from lostmotion_chaos.maps.cells import Columns, Study, make_blank_columns
from lostmotion_chaos.maps.layout import MapLayout, make_list_layout, make_map_origin
from lostmotion_chaos.maps.store import load
from lostmotion_chaos.maps.sweep import Cells, ProgressCallback, Workers, sweep

SPLIT_DIFFERENCE = 0.3
"""A square is halved when the shares of chaotic starts at its corners differ by more than this."""
MAX_LEVELS = 8
"""Largest number of halvings."""


def compute_refined_map(
    study: Study, levels: int, folder: Path, *, workers: Workers, say: ProgressCallback
) -> tuple[MapLayout, Columns]:
    """Return the layout and columns of a map on the grid of `study` halved `levels` times, refined at the boundary.

    Each level is a store in `folder`, so that an interrupted run can continue. A cell that was not computed holds the
    values of the nearest computed cell, and `level` -1.
    """
    folder.mkdir(exist_ok=True)
    fine = replace(study, axes=tuple(axis.refine(levels) for axis in study.axes))
    level = np.full(fine.shape, -1, np.int8)
    columns = make_blank_columns(fine, int(np.prod(fine.shape)))
    share = columns["chaotic_fraction"].reshape(fine.shape)
    for stage in range(levels + 1):
        step = 2 ** (levels - stage)
        cells = _list_coarse_cells(fine.shape, step) if stage == 0 else _list_split_cells(share, level, 2 * step)
        if len(cells):
            _compute_list(make_list_layout(fine, cells, level=stage), folder / f"{stage}.zarr", (workers, say), columns)
            level[tuple(cells.T)] = stage
    return _fill_grid(study, fine, levels, (level, columns))


def _compute_list(layout: MapLayout, path: Path, run: tuple[Workers, ProgressCallback], columns: Columns) -> None:
    """Compute a list of cells and write it into the columns of the whole grid."""
    sweep(path, layout, *run)
    found = load(path)
    rows = np.ravel_multi_index(tuple(np.asarray(layout.cells).T), layout.study.shape)
    for name in columns:
        columns[name][rows] = found[name].to_numpy()


def make_refined_layout(study: Study, levels: int) -> MapLayout:
    """Return the layout of the map that `compute_refined_map` returns."""
    fine = replace(study, axes=tuple(axis.refine(levels) for axis in study.axes))
    dims = tuple(axis.name for axis in study.axes)
    return MapLayout(fine, dims, fine.shape, make_map_origin(study, levels=levels), refined=True)


def _fill_grid(
    study: Study, fine: Study, levels: int, found: tuple[NDArray[np.int8], Columns]
) -> tuple[MapLayout, Columns]:
    """Return the map on the whole fine grid; a cell that was not computed gets the values of its nearest neighbour."""
    level, columns = found
    nearest = distance_transform_edt(level < 0, return_distances=False, return_indices=True)
    rows = np.ravel_multi_index(tuple(nearest), fine.shape).ravel()
    filled: Columns = {name: values[rows].reshape(*fine.shape, *values.shape[1:]) for name, values in columns.items()}
    return make_refined_layout(study, levels), {**filled, "level": level}


def _list_coarse_cells(shape: tuple[int, ...], step: int) -> Cells:
    """Return the indices of every `step`-th cell."""
    return np.array(list(itertools.product(*(range(0, n, step) for n in shape))), dtype=np.int64)


def _list_split_cells(share: Array, level: NDArray[np.int8], side: int) -> Cells:
    """Return the indices of the new cells that halve squares of this side whose corners are known and differ."""
    corners = [_take_corner(np.where(level >= 0, share, np.nan), c, side) for c in _list_corners(share.ndim, 1)]
    stack = np.stack(corners)
    # NaN where a corner is not known: the comparison is false there.
    different = stack.max(axis=0) - stack.min(axis=0) > SPLIT_DIFFERENCE
    begin = np.argwhere(different) * side
    added = np.array(list(_list_corners(share.ndim, 2))) * (side // 2)
    cells = np.unique((begin[:, None, :] + added).reshape(-1, share.ndim), axis=0)
    new: Cells = cells[level[tuple(cells.T)] < 0]
    return new


def _list_corners(many: int, last: int) -> itertools.product[tuple[int, ...]]:
    return itertools.product(range(last + 1), repeat=many)


def _take_corner(values: Array, corner: tuple[int, ...], side: int) -> Array:
    """Return the values at one corner of every square of the coarse grid of this side."""
    coarse = values[(slice(None, None, side),) * values.ndim]
    return coarse[tuple(slice(c, n - 1 + c) for c, n in zip(corner, coarse.shape, strict=True))]


def remove_stores(folder: Path) -> None:
    """Remove the temporary stores from which a file was made."""
    shutil.rmtree(folder, ignore_errors=True)
