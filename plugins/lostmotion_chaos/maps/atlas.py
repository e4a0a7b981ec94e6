"""A map prepared for fast interpolation at thousands of points of the dimensionless numbers at once.

Attractors coexist and periodic windows are narrow, so the motions of a cell are not averaged. A table over the cells of
the map, such as a likelihood, is interpolated linearly at a point from the cells around it. A small weight goes to the
ring of cells around those, because a periodic window may lie between cells.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.settings import DEFAULT, LevelSettings
from lostmotion_chaos.defaults import FLOW_EXPONENT, SECTION_DIMENSION
from lostmotion_chaos.maps.axes import scale_values
from lostmotion_chaos.maps.cells import CODES
from lostmotion_chaos.maps.layout import read_map_settings, read_origin
from lostmotion_chaos.maps.map import RING_WEIGHT, ROUGHNESS_FACTOR, Map

PERIODIC, CHAOTIC, UNSURE, MISSING = 0, 1, 2, -1
"""The kinds of motion: periodic; chaotic (positive exponent); undecided between the two; not computed."""
FREQUENCY_RATIO = "frequency_ratio"
_AXIS_TOLERANCE = 5e-3
"""Share of an axis by which a point may lie beyond its end: a measured amplitude differs a little from the nominal."""


@dataclass(frozen=True, eq=False)
class Places:
    """Positions of n points in a map.

    `cells` (corners, n) are the cells around each point, with their interpolation `weights` (corners, n); `square` (n,)
    is the lowest of these cells, and `inside` (n,) says whether the point lies in the map.
    """

    cells: NDArray[np.intp]
    weights: Array
    square: NDArray[np.intp]
    inside: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Atlas:
    """Motions over the dimensionless numbers `names`: kind, exponent and dimension of each cell and start.

    `points` are the points of each axis in the scale in which they are evenly spaced, in rising order. The arrays are
    (cells, starts), the last axis running fastest. Exponents are per radian of the drive (natural logarithm), so that
    they do not depend on the speed of the machine.
    """

    names: tuple[str, ...]
    spacings: tuple[str, ...]
    points: tuple[Array, ...]
    kind: NDArray[np.int8]
    exponent: Array
    exponent_sd: Array
    dimension: Array
    dimension_sd: Array
    provenance: str = ""

    @classmethod
    def of(cls, source: Map, limits: LevelSettings = DEFAULT.levels) -> Atlas:
        """Return the atlas of a map over `alpha`, `zeta` and optionally the frequency ratio."""
        data, names = source.dataset, source.axes
        ratio = _read_frequency_ratio(data, names)
        starts = data.sizes["start"]
        lyapunov, error, d2, d2_error, period, status = (
            np.asarray(_read_variable(data, name), dtype=float).reshape(-1, starts)
            for name in (
                FLOW_EXPONENT,
                "lyapunov_stderr",
                SECTION_DIMENSION,
                f"{SECTION_DIMENSION}_stderr",
                "period",
                "status",
            )
        )
        if (status == CODES["not_computed"]).any():
            raise DataError("the map is not finished: run the same command again to complete it")
        kind = np.where(period > 0, PERIODIC, np.where(lyapunov - limits.chaotic * error > 0.0, CHAOTIC, UNSURE))
        kind = np.where(np.isfinite(lyapunov), kind, MISSING).astype(np.int8)
        spacings = tuple(str(data[n].attrs.get("spacing", "linear")) for n in names)
        points = tuple(_scale_points(data[n].to_numpy(), s) for n, s in zip(names, spacings, strict=True))
        per = np.broadcast_to(ratio, source.share.shape).reshape(-1, 1)
        return cls(
            names,
            spacings,
            points,
            kind,
            lyapunov / per,
            error / per,
            d2,
            d2_error,
            str(data.attrs.get("provenance", "")),
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of points along each axis."""
        return tuple(len(p) for p in self.points)

    @cached_property
    def exponent_error(self) -> Array:
        """The error (cells, starts) of the exponents, their variation between neighbouring chaotic cells included."""
        return np.hypot(
            np.nan_to_num(self.exponent_sd), ROUGHNESS_FACTOR * self._measure_roughness(self.exponent)[:, None]
        )

    @cached_property
    def dimension_error(self) -> Array:
        """The error (cells, starts) of the dimensions, their variation between neighbouring chaotic cells included."""
        return np.hypot(
            np.nan_to_num(self.dimension_sd), ROUGHNESS_FACTOR * self._measure_roughness(self.dimension)[:, None]
        )

    def _measure_roughness(self, values: Array) -> Array:
        """Return the distance (cells,) of each cell's mean over chaotic starts from the line through its neighbours."""
        kept = (self.kind == CHAOTIC) & np.isfinite(values)
        many = kept.sum(axis=1)
        mean = np.where(many > 0, np.where(kept, values, 0.0).sum(axis=1) / np.maximum(many, 1), np.nan)
        grid, total = mean.reshape(self.shape), np.full(self.shape, np.nan)
        for axis in range(grid.ndim):
            if grid.shape[axis] >= 3:
                moved = np.moveaxis(grid, axis, 0)
                off = np.abs(moved[1:-1] - 0.5 * (moved[2:] + moved[:-2]))
                total = np.fmax(total, np.moveaxis(np.concatenate([off[:1], off, off[-1:]]), 0, axis))
        known = np.isfinite(total)
        usual = float(np.median(total[known])) if known.any() else 0.0
        return np.where(known, total, usual).ravel()

    def locate(self, numbers: Mapping[str, Array], sheet: NDArray[np.intp] | int = 0) -> Places:
        """Return the positions of points in the map; `numbers` holds one array (n,) for each axis.

        Several tables may be stacked one behind the other: `sheet` (n,) is the number of the table for each point.
        """
        lower, shares, inside = [], [], np.ones(1, dtype=bool)
        for name, spacing, points in zip(self.names, self.spacings, self.points, strict=True):
            here = _orient_values(scale_values(np.asarray(numbers[name], dtype=float), spacing), spacing)
            slack = _AXIS_TOLERANCE * (points[-1] - points[0]) + 1e-9 * abs(points[0])
            inside = inside & (here >= points[0] - slack) & (here <= points[-1] + slack)
            i = np.clip(np.searchsorted(points, here, side="right") - 1, 0, max(len(points) - 2, 0))
            step = points[i + 1] - points[i] if len(points) > 1 else np.ones(len(here))
            lower.append(i)
            shares.append(np.clip((here - points[i]) / step, 0.0, 1.0) if len(points) > 1 else np.zeros(len(here)))
        cells, weights = [], []
        for corner in itertools.product((0, 1), repeat=len(lower)):
            at = [np.minimum(i + c, n - 1) for i, c, n in zip(lower, corner, self.shape, strict=True)]
            cells.append(np.ravel_multi_index(at, self.shape))
            weights.append(np.prod([s if c else 1.0 - s for s, c in zip(shares, corner, strict=True)], axis=0))
        behind = np.asarray(sheet) * len(self.kind)
        square = behind + np.ravel_multi_index(lower, self.shape)
        return Places(behind + np.array(cells), np.array(weights), square, np.broadcast_to(inside, square.shape))

    def average_ring(self, table: Array) -> Array:
        """Return the mean (cells,) of a table over the ring around the square whose lowest cell is each cell."""
        outer, inner = self._sum_neighbourhood(table, 1), self._sum_neighbourhood(table, 0)
        many = self._sum_neighbourhood(np.ones_like(table), 1) - self._sum_neighbourhood(np.ones_like(table), 0)
        alone = inner / np.maximum(self._sum_neighbourhood(np.ones_like(table), 0), 1.0)
        return np.where(many > 0.5, np.maximum(outer - inner, 0.0) / np.maximum(many, 1.0), alone)

    def _sum_neighbourhood(self, table: Array, reach: int) -> Array:
        """Return sums (cells,) over the square that begins at each cell, widened by `reach` cells on each side."""
        grid = table.reshape(self.shape)
        for axis in range(grid.ndim):
            n = grid.shape[axis]
            total = np.concatenate([np.zeros_like(np.take(grid, [0], axis)), np.cumsum(grid, axis=axis)], axis=axis)
            at = np.arange(n)
            late, early = np.minimum(at + 2 + reach, n), np.maximum(at - reach, 0)
            grid = np.take(total, late, axis) - np.take(total, early, axis)
        return grid.ravel()

    def interpolate(self, table: Array, ring: Array, places: Places) -> Array:
        """Return a table (cells,) interpolated at places (n,); `ring` holds its means from `average_ring`."""
        near = (places.weights * table[places.cells]).sum(axis=0)
        return np.asarray((1.0 - RING_WEIGHT) * near + RING_WEIGHT * ring[places.square])

    def draw_cells(self, places: Places, rng: np.random.Generator) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return for each place one of the cells around it, drawn by the weights, and one start of that cell."""
        share = np.cumsum(places.weights, axis=0)
        corner = (rng.random(places.weights.shape[1]) * share[-1] >= share[:-1]).sum(axis=0)
        cell = places.cells[corner, np.arange(places.weights.shape[1])]
        return cell, rng.integers(self.kind.shape[1], size=len(cell))


def _read_variable(data: xr.Dataset, name: str) -> Array:
    if name not in data:
        raise DataError(f"the map has no {name}: make a map with --quantity {SECTION_DIMENSION}")
    return np.asarray(data[name].to_numpy())


def _read_frequency_ratio(data: xr.Dataset, names: tuple[str, ...]) -> Array:
    """Return the frequency ratio of each cell, or the one value that holds for all cells."""
    if not {"alpha", "zeta"} <= {*names} <= {"alpha", "zeta", FREQUENCY_RATIO}:
        raise DataError(
            f"the map is over {', '.join(names)}: one over alpha and zeta (and {FREQUENCY_RATIO}) is needed"
        )
    unit = str(data[FLOW_EXPONENT].attrs.get("units"))
    if unit != "1/t_bar":
        raise DataError(f"the exponents of the map are in {unit}: a map in dimensionless numbers (1/t_bar) is needed")
    if FREQUENCY_RATIO in names:
        shape = [-1 if name == FREQUENCY_RATIO else 1 for name in names]
        return np.asarray(data[FREQUENCY_RATIO].to_numpy(), dtype=float).reshape(shape)
    return np.array(read_map_settings(read_origin(data.attrs)).fixed.get(FREQUENCY_RATIO, np.nan))


def _orient_values(values: Array, spacing: str) -> Array:
    """Return scaled values with the sign that makes the points of an axis rise."""
    return -values if spacing == "inverse" else values


def _scale_points(values: Array, spacing: str) -> Array:
    """Return the points of an axis in the scale in which they are evenly spaced, in rising order."""
    return _orient_values(scale_values(np.asarray(values, dtype=float), spacing), spacing)
