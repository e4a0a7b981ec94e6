"""A map read again: what it says at a point between its cells, and how sure that is."""

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
from lostmotion.defaults import FLOW_EXPONENT
from lostmotion.errors import DataError, nearest
from lostmotion.maps.axes import warped
from lostmotion.maps.store import load

ROUGH = 0.25
"""Spread of a cell, over how far it lies off the straight line through its neighbours."""
RING = 0.05
"""Weight, together, of the cells around those next to the point: a narrow window may lie between cells."""


@dataclass(frozen=True)
class Reading:
    """A quantity at a point: mean `value` over attractors, its central 95 % interval, and the share of chaos there.

    The interval holds what one motion from a random start may show: it is as wide as attractors lie apart, as the map
    changes from cell to cell, and as its numbers are uncertain. `settled` is the share of the numbers with status ok.
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
    """A map over some axes, read with `at`."""

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
        """The share of starts that end in chaos, over the axes."""
        return np.asarray(self.dataset["chaotic_fraction"].to_numpy(), dtype=float)

    @cached_property
    def _even(self) -> tuple[Array, ...]:
        """The points of each axis in the scale in which they are even."""
        axes = (self.dataset[name] for name in self.axes)
        return tuple(warped(axis.to_numpy(), axis.attrs.get("spacing", "linear")) for axis in axes)

    def at(
        self, point: Mapping[str, float] | None = None, /, *, quantity: str = FLOW_EXPONENT, **more: float
    ) -> Reading:
        """Return what the map says at a point, given as `at(alpha=0.5, zeta=0.02)` or as a dictionary.

        Raises `DataError` for a point that is not inside the map, or where nothing has been computed.
        """
        corners = self._corners({**(point or {}), **more})
        stderr = {FLOW_EXPONENT: "lyapunov_stderr"}.get(quantity, f"{quantity}_stderr")
        fields = (self._numbers(quantity), self._numbers(stderr), self._rough(quantity))
        means, spreads, weights = _mixture(corners, fields)
        if not len(means):
            raise DataError(f"the map holds no {quantity} around this point: compute it first, or ask elsewhere")
        value = float(weights @ means)
        sd = math.sqrt(float(weights @ (spreads**2 + (means - value) ** 2)))
        low, high = (_quantile(q, means, spreads, weights) for q in (0.025, 0.975))
        flags = self._numbers("status" if quantity == FLOW_EXPONENT else f"{quantity}_status")
        share = self._numbers("chaotic_fraction")
        chaotic = sum(w * float(share[place]) for place, w in corners)
        settled = sum(w * float((flags[place] == 0).mean()) for place, w in corners)
        unit = str(self.dataset[quantity].attrs.get("units", "1"))
        return Reading(value, min(low, value), max(high, value), sd, chaotic, settled, unit)

    @cached_property
    def _read(self) -> dict[str, Array]:
        """What has been read out so far."""
        return {}

    def _numbers(self, name: str) -> Array:
        """Return a variable (..., starts) as numbers."""
        if name not in self.dataset:
            known = [str(v) for v in self.dataset.data_vars]
            raise DataError(f"the map has no {name!r}{nearest(name, known)}: it has {', '.join(known)}")
        if name not in self._read:
            self._read[name] = np.asarray(self.dataset[name].to_numpy(), dtype=float)
        return self._read[name]

    def _rough(self, name: str) -> Array:
        """Return how far each cell (...) of a variable lies off the straight line through its neighbours."""
        if f"rough {name}" not in self._read:
            values = self._numbers(name)
            good = np.isfinite(values)
            mean = np.where(good, values, 0.0).sum(axis=-1) / np.where(good.any(axis=-1), good.sum(axis=-1), np.nan)
            self._read[f"rough {name}"] = _rough(mean)
        return self._read[f"rough {name}"]

    def _corners(self, point: Mapping[str, float]) -> list[tuple[tuple[int, ...], float]]:
        """Return the cells around a point with the weights of linear interpolation."""
        if set(point) != set(self.axes):
            raise DataError(
                f"a point of this map has {', '.join(self.axes)}, and {', '.join(point) or 'none'} was given"
            )
        sides = [self._side(k, name, float(point[name])) for k, name in enumerate(self.axes)]
        found = []
        for corner in itertools.product(*sides):
            weight = math.prod(w for _, w in corner)
            if weight > 0.0:
                found.append((tuple(i for i, _ in corner), weight))
        return found

    def _side(self, k: int, name: str, value: float) -> list[tuple[int, float]]:
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
        even = self._even[k]
        here = float(warped(np.array([value]), axis.attrs.get("spacing", "linear"))[0])
        share = float((here - even[i]) / (even[i + 1] - even[i]))
        return [(i, 1.0 - share), (i + 1, share)]


def _rough(mean: Array) -> Array:
    """Return how far each cell lies off the straight line through its neighbours along the axes."""
    total = np.zeros_like(mean)
    for axis in range(mean.ndim):
        if mean.shape[axis] < 3:
            continue
        moved = np.moveaxis(mean, axis, 0)
        off = np.abs(moved[1:-1] - 0.5 * (moved[2:] + moved[:-2]))
        total = np.fmax(total, np.moveaxis(np.concatenate([off[:1], off, off[-1:]]), 0, axis))
    return total


def _mixture(
    corners: list[tuple[tuple[int, ...], float]], fields: tuple[Array, Array, Array]
) -> tuple[Array, Array, Array]:
    """Return means, spreads and weights of what the cells around a point, and those around them, show."""
    values, errors, rough = fields
    ring = _ring([place for place, _ in corners], rough.shape)
    at = tuple(np.array([*(place for place, _ in corners), *ring]).T)
    shares = np.array([*((1.0 - RING) * w for _, w in corners), *[RING / len(ring)] * len(ring)])
    good = np.isfinite(values[at])
    spreads = np.hypot(np.nan_to_num(errors[at]), ROUGH * np.nan_to_num(rough[at])[:, None])
    weights = np.broadcast_to((shares / np.maximum(good.sum(axis=1), 1))[:, None], good.shape)[good]
    return values[at][good], np.maximum(spreads[good], 1e-12), weights / max(float(weights.sum()), 1e-300)


def _ring(places: list[tuple[int, ...]], shape: tuple[int, ...]) -> list[tuple[int, ...]]:
    """Return the cells within one step of some, without these, or these where there are no others."""
    steps = list(itertools.product((-1, 0, 1), repeat=len(shape)))
    around = {tuple(i + s for i, s in zip(place, step, strict=True)) for place in places for step in steps}
    inside = {cell for cell in around if all(0 <= i < n for i, n in zip(cell, shape, strict=True))}
    return sorted(inside - set(places)) or sorted(places)


def _quantile(q: float, means: Array, spreads: Array, weights: Array) -> float:
    """Return the quantile of a mixture of normal laws, by bisection."""
    low, high = float((means - 6.0 * spreads).min()), float((means + 6.0 * spreads).max())
    for _ in range(60):
        middle = 0.5 * (low + high)
        if float(weights @ ndtr((middle - means) / spreads)) < q:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
