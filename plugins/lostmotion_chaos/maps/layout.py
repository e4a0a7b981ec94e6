"""The file layout of a map: dimensions, variables, chunks and attributes, the same for zarr and netCDF."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.codec import described, from_plain, to_plain
from lostmotion.errors import DataError
from lostmotion.provenance import origin_of
from lostmotion.results import STATUSES
from lostmotion.results.background import Origin
from lostmotion_chaos.defaults import FLOW_EXPONENT
from lostmotion_chaos.maps.cells import CODES, MAX_PERIOD, START_BOX, START_PERIODS, Study

SCHEMA = "lostmotion.map/1"
PERIODS_PER_CHUNK = 200_000
"""Simulated periods, over all cells and starts, in one chunk: about half a second where the flow is exact."""
MIN_CHUNKS_PER_AXIS = 4
"""Smallest number of chunks along an axis, so that small maps are distributed over the cores too."""


@dataclass(frozen=True)
class Attributes:
    """The attributes of one array in a file."""

    units: str | None = described("unit of the numbers", default=None)
    long_name: str = described("what the numbers are", default="")
    spacing: str | None = described("the scale in which the points of an axis are even", default=None)
    flag_values: tuple[int, ...] | None = described("the codes that an array of flags holds", default=None)
    flag_meanings: str | None = described("a word for each code", default=None)
    comment: str | None = described("what else is to be known", default=None)


@dataclass(frozen=True)
class Variable:
    """The description of an array in a file, without its values."""

    dims: tuple[str, ...]
    kind: str
    fill: float | int
    attrs: Attributes


@dataclass(frozen=True)
class Coordinate:
    """The points along a dimension of a file, or along one of several."""

    dims: tuple[str, ...]
    values: NDArray[Any]
    attrs: Attributes


@dataclass(frozen=True, kw_only=True)
class MapSettings:
    """The settings of a map, as stored in the provenance of its file."""

    model: str = described("name of the model")
    terms: tuple[str, ...] = described("the terms that were added to it", default=())
    fixed: Mapping[str, float] = described("what was held at a value, by name", default={})
    axes: tuple[str, ...] = described("the axes, as the command line has them", default=())
    exponent: str = described("the quantifier of the exponent with its settings", default="")
    further: Mapping[str, str] = described("further quantifiers with their settings, by name", default={})
    embedder: str | None = described("the embedder; null where no quantifier reads a series")
    starts: int = described("starts in each cell", default=1)
    unit: str = described("nat or bit, of exponents", default="nat")
    level: int | None = described("the halving of which this is the list of cells", default=None)
    levels: int | None = described("how often squares were halved", default=None)
    motion: str | None = described("translation or rotation, where the model can be either", default=None)


@dataclass(frozen=True)
class MapLayout:
    """The grid of a map (`shape`, with dimension names `dims`) and its division into chunks.

    A list of cells has their indices `cells` (many, axes) and the one dimension `cell`. A `refined` map stores the
    level of each cell.
    """

    study: Study
    dims: tuple[str, ...]
    shape: tuple[int, ...]
    origin: Origin
    cells: NDArray[np.int64] | None = None
    refined: bool = False

    @property
    def attrs(self) -> dict[str, str]:
        """The attributes of the file; `provenance` holds everything that its values depend on."""
        study = self.study
        return {
            "schema": SCHEMA,
            "Conventions": "CF-1.11",
            "title": f"Map of {study.rig.assembly.label} over {' and '.join(axis.name for axis in study.axes)}",
            "provenance": json.dumps(to_plain(self.origin), sort_keys=True),
        }

    @cached_property
    def block(self) -> tuple[int, ...]:
        """The number of cells of a chunk along each axis."""
        cells = max(1.0, PERIODS_PER_CHUNK / (self.study.starts * (self.study.periods + self.study.transient)))
        side = max(1, round(cells ** (1.0 / len(self.shape))))
        return tuple(min(side, max(1, math.ceil(count / MIN_CHUNKS_PER_AXIS))) for count in self.shape)

    @property
    def chunks(self) -> Iterator[tuple[slice, ...]]:
        """The index ranges of all chunks, in order."""
        cut = [
            [slice(a, min(a + step, n)) for a in range(0, n, step)]
            for n, step in zip(self.shape, self.block, strict=True)
        ]
        return itertools.product(*cut)

    def list_cells(self, chunk: tuple[slice, ...]) -> NDArray[np.int64]:
        """Return the indices (cells, axes) of the cells of a chunk, the last axis running fastest."""
        if self.cells is not None:
            return self.cells[chunk[0]]
        grid = np.meshgrid(*(np.arange(piece.start, piece.stop) for piece in chunk), indexing="ij")
        return np.stack(grid, axis=-1).reshape(-1, len(chunk))

    @cached_property
    def variables(self) -> dict[str, Variable]:
        """The arrays of the map; `status`, which is written last, is the last one."""
        every, unit = (*self.dims, "start"), self.study.unit
        table = {
            FLOW_EXPONENT: Variable(every, "f8", math.nan, Attributes(unit, "largest Lyapunov exponent")),
            "lyapunov_stderr": Variable(every, "f8", math.nan, Attributes(unit, "standard error of lyapunov_max")),
        }
        for name, quantifier in self.study.further.items():
            own = unit if quantifier.unit == "1/s" else quantifier.unit
            table[name] = Variable(every, "f8", math.nan, Attributes(own, f"{name} of the motion"))
            table[f"{name}_stderr"] = Variable(every, "f8", math.nan, Attributes(own, f"standard error of {name}"))
            table[f"{name}_status"] = Variable(every, "i1", -1, _make_flag_attributes(f"what is wrong with {name}"))
        period = Attributes("1", f"period of the motion in periods of the drive, 0 if none up to {MAX_PERIOD}")
        table["period"] = Variable(every, "i2", -1, period)
        share = Attributes(
            "1", "share of the starts whose exponent is significantly positive (95 %) and that do not repeat"
        )
        table["chaotic_fraction"] = Variable(self.dims, "f8", math.nan, share)
        if self.refined:
            level = Attributes("1", "refinement level of a computed cell, -1 where the nearest cell was copied")
            table["level"] = Variable(self.dims, "i1", -1, level)
        table["status"] = Variable(every, "i1", -1, _make_flag_attributes("what is wrong with lyapunov_max"))
        return table

    @property
    def coords(self) -> dict[str, Coordinate]:
        """The coordinates by name."""
        rig, table = self.study.rig, {}
        for axis, values in zip(self.study.axes, self.study.points, strict=True):
            if axis.name in self.dims:
                attrs = Attributes(rig.get_unit(axis.name), rig.find_knob(axis.name).meaning, axis.spacing)
                table[axis.name] = Coordinate((axis.name,), values, attrs)
        drawn = (
            f"drawn uniformly from a box {START_BOX:g} times the extent of the first {START_PERIODS} periods from rest"
        )
        start = Attributes("1", "number of the initial condition", comment=drawn)
        return {**table, "start": Coordinate(("start",), np.arange(self.study.starts), start)}


def make_grid_layout(study: Study) -> MapLayout:
    """Return the layout of a map over a whole grid."""
    return MapLayout(study, tuple(axis.name for axis in study.axes), study.shape, make_map_origin(study))


def make_list_layout(study: Study, cells: NDArray[np.int64], *, level: int) -> MapLayout:
    """Return the layout of a list of cells (many, axes) on the grid of a study, computed at refinement `level`."""
    return MapLayout(study, ("cell",), (len(cells),), make_map_origin(study, level=level), cells)


def make_map_origin(study: Study, *, level: int | None = None, levels: int | None = None) -> Origin:
    """Return everything that the values of a map depend on; a list has a `level`, a refined map has `levels`."""
    rig, further = study.rig, {name: str(quantifier) for name, quantifier in study.further.items()}
    model = rig.assembly.model
    settings = MapSettings(
        model=model.name,
        terms=rig.system.keys,
        fixed=rig.fixed,
        axes=tuple(axis.as_text() for axis in study.axes),
        exponent=str(study.exponent),
        further=further,
        embedder=str(study.embedder) if further else None,
        starts=study.starts,
        unit=study.unit,
        level=level,
        levels=levels,
        motion=model.motion if model.motion != type(model).motion else None,
    )
    return origin_of("map", to_plain(settings), study.seed, study.origins)


def read_origin(attrs: Mapping[str, object], path: str = "the map") -> Origin:
    """Return the origin from the attributes of a map; raise `DataError` where there is none."""
    try:
        plain = json.loads(str(attrs.get("provenance")))
    except ValueError as err:
        raise DataError(f"{path} does not say how it was made: make it again") from err
    return from_plain(Origin, plain, f"the provenance of {path}")


def read_map_settings(origin: Origin) -> MapSettings:
    """Return the settings with which a map was made."""
    return from_plain(MapSettings, origin.settings, "the provenance of the map")


def _make_flag_attributes(long_name: str) -> Attributes:
    """Return the attributes of an array of status flags."""
    comment = "; ".join(f"{name}: {says}" for name, says in STATUSES.items())
    return Attributes(None, long_name, None, tuple(CODES.values()), " ".join(CODES), comment)
