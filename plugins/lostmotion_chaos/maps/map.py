"""A stored map, interpolated at any point with an uncertainty."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import xarray as xr
from scipy.special import ndtr

from lostmotion.contracts import Array
from lostmotion.errors import DataError, nearest
from lostmotion_chaos.defaults import FLOW_EXPONENT
from lostmotion_chaos.maps.axes import scale_values
from lostmotion_chaos.maps.store import load

ROUGHNESS_FACTOR = 0.25
"""Standard deviation of a cell, relative to its distance from the straight line through its neighbours."""
RING_WEIGHT = 0.05
"""Total weight of the ring of cells around those next to the point: a narrow window may lie between cells."""


@dataclass(frozen=True)
class Reading:
    """A quantity at a point: mean `value` over attractors, its central 95 % interval, and the share of chaos there.

    The interval covers the value of one motion from a random start. It includes the differences between attractors,
    the variation from cell to cell, and the errors of the values. `settled` is the share of the values with status ok.
    """

    value: float
    low: float
    high: float
    sd: float
    chaotic_share: float
    settled: float
    unit: str


@dataclass(frozen=True, eq=False)
class Map:
    """A map over one or more axes; `at` interpolates it."""

    dataset: xr.Dataset

    @classmethod
    def open(cls, path: str | Path) -> Map:
        """Return the map stored at `path` (.zarr or .nc)."""
        return cls(load(Path(path)))

    @property
    def axes(self) -> tuple[str, ...]:
        """The names of the axes."""
        return tuple(str(d) for d in self.dataset["chaotic_fraction"].dims)

    @property
    def share(self) -> Array:
        """The share of chaotic starts in each cell, over the axes."""
        return np.asarray(self.dataset["chaotic_fraction"].to_numpy(), dtype=float)

    @cached_property
    def _scaled_points(self) -> tuple[Array, ...]:
        """The points of each axis in the scale in which they are evenly spaced."""
        axes = (self.dataset[name] for name in self.axes)
        return tuple(scale_values(axis.to_numpy(), axis.attrs.get("spacing", "linear")) for axis in axes)

    def at(
        self, point: Mapping[str, float] | None = None, /, *, quantity: str = FLOW_EXPONENT, **more: float
    ) -> Reading:
        """Return a quantity at a point, given as `at(alpha=0.5, zeta=0.02)` or as a dictionary.

        Raises `DataError` for a point outside of the map, or where nothing has been computed.
        """
        corners = self._find_corners({**(point or {}), **more})
        stderr = {FLOW_EXPONENT: "lyapunov_stderr"}.get(quantity, f"{quantity}_stderr")
        fields = (self._read_numbers(quantity), self._read_numbers(stderr), self._get_roughness(quantity))
        means, spreads, weights = _collect_mixture(corners, fields)
        if not len(means):
            raise DataError(
                f"the map has no value of {quantity} around this point: compute it first, or choose another point"
            )
        value = float(weights @ means)
        sd = math.sqrt(float(weights @ (spreads**2 + (means - value) ** 2)))
        low, high = (_find_quantile(q, means, spreads, weights) for q in (0.025, 0.975))
        flags = self._read_numbers("status" if quantity == FLOW_EXPONENT else f"{quantity}_status")
        share = self._read_numbers("chaotic_fraction")
        chaotic = sum(w * float(share[place]) for place, w in corners)
        settled = sum(w * float((flags[place] == 0).mean()) for place, w in corners)
        unit = str(self.dataset[quantity].attrs.get("units", "1"))
        return Reading(value, min(low, value), max(high, value), sd, chaotic, settled, unit)

    @cached_property
    def _cache(self) -> dict[str, Array]:
        """Arrays that have been read or computed so far, by name."""
        return {}

    def _read_numbers(self, name: str) -> Array:
        """Return the values (..., starts) of a variable."""
        if name not in self.dataset:
            known = [str(v) for v in self.dataset.data_vars]
            raise DataError(f"the map has no {name!r}{nearest(name, known)}: it has {', '.join(known)}")
        if name not in self._cache:
            self._cache[name] = np.asarray(self.dataset[name].to_numpy(), dtype=float)
        return self._cache[name]

    def _get_roughness(self, name: str) -> Array:
        """Return the distance of each cell (...) of a variable from the straight line through its neighbours."""
        if f"rough {name}" not in self._cache:
            values = self._read_numbers(name)
            good = np.isfinite(values)
            mean = np.where(good, values, 0.0).sum(axis=-1) / np.where(good.any(axis=-1), good.sum(axis=-1), np.nan)
            self._cache[f"rough {name}"] = _measure_roughness(mean)
        return self._cache[f"rough {name}"]

    def _find_corners(self, point: Mapping[str, float]) -> list[tuple[tuple[int, ...], float]]:
        """Return the cells around a point with the weights of linear interpolation."""
        if set(point) != set(self.axes):
            raise DataError(
                f"a point of this map has {', '.join(self.axes)}, and {', '.join(point) or 'none'} was given"
            )
        sides = [self._find_neighbours(k, name, float(point[name])) for k, name in enumerate(self.axes)]
        found = []
        for corner in itertools.product(*sides):
            weight = math.prod(w for _, w in corner)
            if weight > 0.0:
                found.append((tuple(i for i, _ in corner), weight))
        return found

    def _find_neighbours(self, k: int, name: str, value: float) -> list[tuple[int, float]]:
        """Return the two points of an axis on either side of a value, with their weights."""
        axis = self.dataset[name]
        points = axis.to_numpy()
        if not points[0] <= value <= points[-1]:
            raise DataError(
                f"{name} = {value:g} lies outside of the map, which goes from {points[0]:g} to {points[-1]:g}"
            )
        if len(points) == 1:
            return [(0, 1.0)]
        i = min(int(np.searchsorted(points, value, side="right")) - 1, len(points) - 2)
        even = self._scaled_points[k]
        here = float(scale_values(np.array([value]), axis.attrs.get("spacing", "linear"))[0])
        share = float((here - even[i]) / (even[i + 1] - even[i]))
        return [(i, 1.0 - share), (i + 1, share)]


def _measure_roughness(mean: Array) -> Array:
    """Return the distance of each cell from the straight line through its neighbours along the axes."""
    total = np.zeros_like(mean)
    for axis in range(mean.ndim):
        if mean.shape[axis] < 3:
            continue
        moved = np.moveaxis(mean, axis, 0)
        off = np.abs(moved[1:-1] - 0.5 * (moved[2:] + moved[:-2]))
        total = np.fmax(total, np.moveaxis(np.concatenate([off[:1], off, off[-1:]]), 0, axis))
    return total


def _collect_mixture(
    corners: list[tuple[tuple[int, ...], float]], fields: tuple[Array, Array, Array]
) -> tuple[Array, Array, Array]:
    """Return means, standard deviations and weights of the values in the cells around a point and in their ring."""
    values, errors, rough = fields
    ring = _find_ring([place for place, _ in corners], rough.shape)
    at = tuple(np.array([*(place for place, _ in corners), *ring]).T)
    shares = np.array([*((1.0 - RING_WEIGHT) * w for _, w in corners), *[RING_WEIGHT / len(ring)] * len(ring)])
    good = np.isfinite(values[at])
    spreads = np.hypot(np.nan_to_num(errors[at]), ROUGHNESS_FACTOR * np.nan_to_num(rough[at])[:, None])
    weights = np.broadcast_to((shares / np.maximum(good.sum(axis=1), 1))[:, None], good.shape)[good]
    return values[at][good], np.maximum(spreads[good], 1e-12), weights / max(float(weights.sum()), 1e-300)


def _find_ring(places: list[tuple[int, ...]], shape: tuple[int, ...]) -> list[tuple[int, ...]]:
    """Return the cells within one step of the given ones, without these; the given ones where there are no others."""
    steps = list(itertools.product((-1, 0, 1), repeat=len(shape)))
    around = {tuple(i + s for i, s in zip(place, step, strict=True)) for place in places for step in steps}
    inside = {cell for cell in around if all(0 <= i < n for i, n in zip(cell, shape, strict=True))}
    return sorted(inside - set(places)) or sorted(places)


def _find_quantile(q: float, means: Array, spreads: Array, weights: Array) -> float:
    """Return the quantile of a mixture of normal distributions, by bisection."""
    low, high = float((means - 6.0 * spreads).min()), float((means + 6.0 * spreads).max())
    for _ in range(60):
        middle = 0.5 * (low + high)
        if float(weights @ ndtr((middle - means) / spreads)) < q:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
