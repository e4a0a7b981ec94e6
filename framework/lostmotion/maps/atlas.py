"""What motions do at any dimensionless numbers: a map made ready to be asked at thousands of points at once.

Attractors coexist and windows are narrow, so nothing is averaged. A table over the cells of the map, such as the
likelihood of what was seen, is blended at a point from the cells around it by the weights of linear interpolation, and
a little from the ring of cells around those: a window may lie between cells.
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
from lostmotion.defaults import FLOW_EXPONENT, SECTION_DIMENSION
from lostmotion.errors import DataError
from lostmotion.maps.axes import warped
from lostmotion.maps.cells import CODES
from lostmotion.maps.layout import origin_in, settings_in
from lostmotion.maps.map import RING, ROUGH, Map

PERIODIC, CHAOTIC, UNSURE, MISSING = 0, 1, 2, -1
"""What a motion is: it repeats itself; its exponent is positive; neither can be told; nothing was computed."""
SURE = 2.0
"""Standard errors by which an exponent must lie above zero."""
RATIO = "frequency_ratio"
_EDGE = 5e-3
"""Share of an axis by which a point may lie beyond its end: an amplitude that was read is not quite the nominal one."""


@dataclass(frozen=True, eq=False)
class Places:
    """Points in a map: `cells` (corners, n) around each, their `weights`, the `square` (n,), and what lies `inside`."""

    cells: NDArray[np.intp]
    weights: Array
    square: NDArray[np.intp]
    inside: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Atlas:
    """Motions over the numbers `names`: for each cell and start its `kind`, exponent and dimension with their errors.

    `points` are those of each axis in the scale in which they are even, rising. The arrays are (cells, starts), the
    last axis running fastest. Exponents are per radian of the drive (natural logarithm), so that they are the same for
    a machine of any speed.
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
    def of(cls, source: Map) -> Atlas:
        """Return the atlas of a map over `alpha`, `zeta` and perhaps the frequency ratio."""
        data, names = source.dataset, source.axes
        ratio = _ratio(data, names)
        starts = data.sizes["start"]
        lyapunov, error, d2, d2_error, period, status = (
            np.asarray(_found(data, name), dtype=float).reshape(-1, starts)
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
            raise DataError("the map is not finished: make it again with the same settings, and it goes on")
        kind = np.where(period > 0, PERIODIC, np.where(lyapunov - SURE * error > 0.0, CHAOTIC, UNSURE))
        kind = np.where(np.isfinite(lyapunov), kind, MISSING).astype(np.int8)
        spacings = tuple(str(data[n].attrs.get("spacing", "linear")) for n in names)
        points = tuple(_rising(data[n].to_numpy(), s) for n, s in zip(names, spacings, strict=True))
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
        """The points of each axis."""
        return tuple(len(p) for p in self.points)

    @cached_property
    def exponent_error(self) -> Array:
        """The error (cells, starts) of the exponents, and of what changes from one chaotic cell to the next."""
        return np.hypot(np.nan_to_num(self.exponent_sd), ROUGH * self._rough(self.exponent)[:, None])

    @cached_property
    def dimension_error(self) -> Array:
        """The error (cells, starts) of the dimensions, and of what changes from one chaotic cell to the next."""
        return np.hypot(np.nan_to_num(self.dimension_sd), ROUGH * self._rough(self.dimension)[:, None])

    def _rough(self, values: Array) -> Array:
        """Return how far the mean over chaotic starts of each cell (cells,) lies off the line through those around."""
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

    def places(self, numbers: Mapping[str, Array], sheet: NDArray[np.intp] | int = 0) -> Places:
        """Return where points with these `numbers` (n,), one array for each axis, lie.

        Tables may be stacked one behind the other: `sheet` (n,) says in which of them each point is looked up.
        """
        lower, shares, inside = [], [], np.ones(1, dtype=bool)
        for name, spacing, points in zip(self.names, self.spacings, self.points, strict=True):
            here = _turned(warped(np.asarray(numbers[name], dtype=float), spacing), spacing)
            slack = _EDGE * (points[-1] - points[0]) + 1e-9 * abs(points[0])
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

    def around(self, table: Array) -> Array:
        """Return the mean (cells,) of a table over the ring about the square that begins at each cell."""
        outer, inner = self._summed(table, 1), self._summed(table, 0)
        many = self._summed(np.ones_like(table), 1) - self._summed(np.ones_like(table), 0)
        alone = inner / np.maximum(self._summed(np.ones_like(table), 0), 1.0)
        return np.where(many > 0.5, np.maximum(outer - inner, 0.0) / np.maximum(many, 1.0), alone)

    def _summed(self, table: Array, reach: int) -> Array:
        """Return sums (cells,) over the square that begins at each cell, and `reach` cells more on each side."""
        grid = table.reshape(self.shape)
        for axis in range(grid.ndim):
            n = grid.shape[axis]
            total = np.concatenate([np.zeros_like(np.take(grid, [0], axis)), np.cumsum(grid, axis=axis)], axis=axis)
            at = np.arange(n)
            late, early = np.minimum(at + 2 + reach, n), np.maximum(at - reach, 0)
            grid = np.take(total, late, axis) - np.take(total, early, axis)
        return grid.ravel()

    def blended(self, table: Array, ring: Array, places: Places) -> Array:
        """Return a table (cells,) with its `around` at places (n,)."""
        near = (places.weights * table[places.cells]).sum(axis=0)
        return np.asarray((1.0 - RING) * near + RING * ring[places.square])

    def drawn(self, places: Places, rng: np.random.Generator) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return for each place a cell around it, drawn by the weights, and one of its starts."""
        share = np.cumsum(places.weights, axis=0)
        corner = (rng.random(places.weights.shape[1]) * share[-1] >= share[:-1]).sum(axis=0)
        cell = places.cells[corner, np.arange(places.weights.shape[1])]
        return cell, rng.integers(self.kind.shape[1], size=len(cell))


def _found(data: xr.Dataset, name: str) -> Array:
    if name not in data:
        raise DataError(f"the map has no {name}: make one with --quantity {SECTION_DIMENSION} beside lyapunov_max")
    return np.asarray(data[name].to_numpy())


def _ratio(data: xr.Dataset, names: tuple[str, ...]) -> Array:
    """Return the frequency ratio of each cell, or of all of them."""
    if not {"alpha", "zeta"} <= {*names} <= {"alpha", "zeta", RATIO}:
        raise DataError(f"the map is over {', '.join(names)}: one over alpha and zeta (and {RATIO}) is wanted")
    unit = str(data[FLOW_EXPONENT].attrs.get("units"))
    if unit != "1/t_bar":
        raise DataError(f"the exponents of the map are in {unit}: wanted 1/t_bar, of a map in dimensionless numbers")
    if RATIO in names:
        shape = [-1 if name == RATIO else 1 for name in names]
        return np.asarray(data[RATIO].to_numpy(), dtype=float).reshape(shape)
    return np.array(settings_in(origin_in(data.attrs)).fixed.get(RATIO, np.nan))


def _turned(values: Array, spacing: str) -> Array:
    """Return values in the scale of an axis, rising with its points."""
    return -values if spacing == "inverse" else values


def _rising(values: Array, spacing: str) -> Array:
    return _turned(warped(np.asarray(values, dtype=float), spacing), spacing)
