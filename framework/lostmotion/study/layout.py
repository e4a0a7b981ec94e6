"""What a map looks like in a file: dimensions, variables, chunks and their attributes, the same for zarr and netCDF."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.defaults import FLOW_EXPONENT
from lostmotion.provenance import provenance
from lostmotion.results import STATUSES
from lostmotion.study.cells import BEGINNING, CODES, LONGEST, WIDE, Study

SCHEMA = "lostmotion.map/1"
WORK = 200_000
"""Periods, over all cells and starts, that make one chunk: about half a second where the flow is exact."""
PIECES = 4
"""Chunks along an axis, at least: so small maps too are spread over the cores."""


@dataclass(frozen=True)
class Variable:
    """An array of a file without its numbers."""

    dims: tuple[str, ...]
    kind: str
    fill: float | int
    attrs: dict[str, Any]


@dataclass(frozen=True)
class Layout:
    """The grid (`shape`, with names `dims`) of a map, and how it is cut into chunks.

    A list of places has `cells` (many, axes) and the one dimension `cell`. A `refined` map has the level of each cell.
    """

    study: Study
    dims: tuple[str, ...]
    shape: tuple[int, ...]
    attrs: dict[str, str]
    cells: NDArray[np.int64] | None = None
    refined: bool = False

    @cached_property
    def block(self) -> tuple[int, ...]:
        """The cells of a chunk along each axis."""
        cells = max(1.0, WORK / (self.study.starts * (self.study.periods + self.study.transient)))
        side = max(1, round(cells ** (1.0 / len(self.shape))))
        return tuple(min(side, max(1, math.ceil(count / PIECES))) for count in self.shape)

    @property
    def chunks(self) -> Iterator[tuple[slice, ...]]:
        """The places of all chunks, in order."""
        cut = [
            [slice(a, min(a + step, n)) for a in range(0, n, step)]
            for n, step in zip(self.shape, self.block, strict=True)
        ]
        return itertools.product(*cut)

    def places(self, chunk: tuple[slice, ...]) -> NDArray[np.int64]:
        """Return the places (cells, axes) of the cells of a chunk, the last axis running fastest."""
        if self.cells is not None:
            return self.cells[chunk[0]]
        grid = np.meshgrid(*(np.arange(piece.start, piece.stop) for piece in chunk), indexing="ij")
        return np.stack(grid, axis=-1).reshape(-1, len(chunk))

    @cached_property
    def variables(self) -> dict[str, Variable]:
        """The arrays of the map; the one that is written last, `status`, stands last."""
        every, unit = (*self.dims, "start"), self.study.unit
        table = {
            FLOW_EXPONENT: Variable(every, "f8", math.nan, _said(unit, "largest Lyapunov exponent")),
            "lyapunov_stderr": Variable(every, "f8", math.nan, _said(unit, "standard error of lyapunov_max")),
        }
        for name, quantifier in self.study.further.items():
            own = unit if quantifier.unit == "1/s" else quantifier.unit
            table[name] = Variable(every, "f8", math.nan, _said(own, f"{name} of the motion"))
            table[f"{name}_stderr"] = Variable(every, "f8", math.nan, _said(own, f"standard error of {name}"))
            table[f"{name}_status"] = Variable(every, "i1", -1, _flags(f"what is wrong with {name}"))
        period = _said("1", f"period of the motion in periods of the drive, 0 when there is none up to {LONGEST}")
        table["period"] = Variable(every, "i2", -1, period)
        share = _said("1", "share of the starts whose exponent is significantly positive (95 %) and that do not repeat")
        table["chaotic_fraction"] = Variable(self.dims, "f8", math.nan, share)
        if self.refined:
            level = _said("1", "halving at which a cell was computed, -1 where it holds what its nearest cell has")
            table["level"] = Variable(self.dims, "i1", -1, level)
        table["status"] = Variable(every, "i1", -1, _flags("what is wrong with lyapunov_max"))
        return table

    @property
    def coords(self) -> dict[str, tuple[tuple[str, ...], NDArray[Any], dict[str, Any]]]:
        """The coordinates: dims, values and attributes."""
        rig, table = self.study.rig, {}
        for axis, values in zip(self.study.axes, self.study.points, strict=True):
            if axis.name in self.dims:
                attrs = {**_said(rig.unit(axis.name), rig.knob(axis.name).meaning), "spacing": axis.spacing}
                table[axis.name] = ((axis.name,), values, attrs)
        told = {
            **_said("1", "number of the initial condition"),
            "comment": f"drawn evenly from a box {WIDE:g} times as large as {BEGINNING} periods from rest reach",
        }
        return {**table, "start": (("start",), np.arange(self.study.starts), told)}


def layout_of(study: Study) -> Layout:
    """Return the layout of a map over a whole grid."""
    return Layout(study, tuple(axis.name for axis in study.axes), study.shape, attrs_of(study))


def listed(study: Study, cells: NDArray[np.int64], **more: object) -> Layout:
    """Return the layout of a list of places (many, axes) on the grid of a study; `more` says which list it is."""
    return Layout(study, ("cell",), (len(cells),), attrs_of(study, **more), cells)


def attrs_of(study: Study, **more: object) -> dict[str, str]:
    """Return the attributes of a map; `provenance` holds all that a number in it depends on."""
    rig, told = study.rig, {name: str(quantifier) for name, quantifier in study.further.items()}
    settings = {
        "model": rig.assembly.model.name,
        "terms": list(rig.system.keys),
        "fixed": dict(rig.fixed),
        "axes": [axis.as_text() for axis in study.axes],
        "exponent": str(study.exponent),
        "further": told,
        "embedder": str(study.embedder) if told else None,
        "starts": study.starts,
        "unit": study.unit,
        **more,
    }
    if rig.assembly.model.motion != type(rig.assembly.model).motion:
        settings["motion"] = rig.assembly.model.motion
    made = provenance("map", settings, study.seed, study.origins)
    return {
        "schema": SCHEMA,
        "Conventions": "CF-1.11",
        "title": f"Map of {rig.assembly.label} over {' and '.join(axis.name for axis in study.axes)}",
        "provenance": json.dumps(made, sort_keys=True),
    }


def _said(unit: str, long_name: str) -> dict[str, Any]:
    return {"units": unit, "long_name": long_name}


def _flags(long_name: str) -> dict[str, Any]:
    return {
        "long_name": long_name,
        "flag_values": list(CODES.values()),
        "flag_meanings": " ".join(CODES),
        "comment": "; ".join(f"{name}: {says}" for name, says in STATUSES.items()),
    }
