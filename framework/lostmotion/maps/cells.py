"""What one cell of a map is: a machine with its knobs set, followed from several starts, and what is read off it.

Everything random in a cell comes from the seed and the place of the cell on its axes, so that numbers do not depend on
chunks, workers or order.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.analysis.embed import embed
from lostmotion.analysis.quantify import quantify
from lostmotion.contracts import Array, Embedder, Flow, Orbit, Quantifier
from lostmotion.defaults import FLOW_EXPONENT
from lostmotion.errors import ContractError, DataError, LostMotionError, PluginWarning
from lostmotion.maps.axes import MapAxis
from lostmotion.maps.rig import SweptMachine, reach
from lostmotion.rates import exponent_in
from lostmotion.results import STATUSES, Estimate

Columns = dict[str, NDArray[Any]]

STATES = (*STATUSES, "not_computed")
CODES: Mapping[str, int] = {**{name: code for code, name in enumerate(STATUSES)}, "not_computed": -1}
"""The number that stands for each status in a file."""
LONGEST = 32
"""Periods of the drive beyond which a periodic motion is not told from any other."""
CLOSE = 1e-5
"""Distance, over the size of the motion, within which two looks at it show the same point."""
WIDE, BEGINNING = 2.0, 40
"""Starts are drawn evenly from a box so many times as large as the motion from rest reaches in so many periods."""
LOOKS = 32
"""Samples in a period for methods that read a series."""


@dataclass(frozen=True)
class Study:
    """A rig, its axes, how long each motion is followed from how many starts, and what is read off it.

    `exponent` reads the flow. `further` are more quantifiers by the name they have in the file; those that read a
    series are handed the first state, embedded by `embedder`. `bits` gives exponents in bit in place of nat. `origins`
    are the digests or versions of the plugins of other people that take part.
    """

    rig: SweptMachine
    axes: tuple[MapAxis, ...]
    exponent: Quantifier[Flow]
    further: Mapping[str, Quantifier[Any]]
    embedder: Embedder | None = None
    periods: int = 600
    transient: int = 200
    starts: int = 4
    seed: int = 0
    bits: bool = False
    origins: Mapping[str, str] = field(default_factory=dict)

    @property
    def shape(self) -> tuple[int, ...]:
        """The points of each axis."""
        return tuple(axis.count for axis in self.axes)

    @cached_property
    def points(self) -> tuple[Array, ...]:
        """The points on each axis."""
        return tuple(axis.values for axis in self.axes)

    @property
    def unit(self) -> str:
        """The unit of an exponent."""
        return f"{'bit' if self.bits else '1'}/{self.rig.time_unit}"

    def point(self, cell: Array | tuple[int, ...]) -> dict[str, float]:
        """Return the knobs at the place (axes,) of a cell."""
        told = zip(self.axes, self.points, cell, strict=True)
        return {axis.name: float(values[int(i)]) for axis, values, i in told}


class FollowedFlow:
    """A flow from one start that remembers its orbit, so that several methods read the same one."""

    def __init__(self, flow: Flow, start: Array, tangents: int) -> None:
        self._flow, self.start, self._tangents = flow, start, tangents
        self.period, self.driven, self.states = flow.period, flow.driven, flow.states
        self._orbits: dict[int, Orbit] = {}

    def strobe(self, start: Array, *, periods: int, tangents: int) -> Orbit:
        """Return the orbit from the start of this flow, with the first `tangents` of the vectors it follows."""
        if start is not self.start or tangents > self._tangents:
            return self._flow.strobe(start, periods=periods, tangents=tangents)
        if periods not in self._orbits:
            self._orbits[periods] = self._flow.strobe(start, periods=periods, tangents=self._tangents)
        whole = self._orbits[periods]
        return whole if tangents == self._tangents else Orbit(whole.states, whole.growth[:, :tangents], whole.status)

    def sample(self, start: Array, *, periods: int, looks: int) -> Array:
        """Return states (periods * looks + 1, n) from `start` on."""
        seen: Array = self._flow.sample(start, periods=periods, looks=looks)  # type: ignore[attr-defined]
        return seen


def computed(study: Study, cells: NDArray[np.int64]) -> Columns:
    """Return the columns (cells, starts) of the cells at the places (cells, axes); the share of chaos is (cells,)."""
    columns = blank_columns(study, len(cells))
    for row, cell in enumerate(cells):
        _fill(study, cell, columns, row)
    return columns


def blank_columns(study: Study, many: int) -> Columns:
    """Return columns in which nothing is computed."""
    shape = (many, study.starts)
    columns: Columns = {FLOW_EXPONENT: np.full(shape, np.nan), "lyapunov_stderr": np.full(shape, np.nan)}
    for name in study.further:
        columns[name], columns[f"{name}_stderr"] = np.full(shape, np.nan), np.full(shape, np.nan)
        columns[f"{name}_status"] = np.full(shape, CODES["not_computed"], np.int8)
    columns["period"] = np.full(shape, -1, np.int16)
    columns["chaotic_fraction"] = np.full(many, np.nan)
    columns["status"] = np.full(shape, CODES["not_computed"], np.int8)
    return columns


def _fill(study: Study, cell: Array, columns: Columns, row: int) -> None:
    """Write one row of the columns."""
    try:
        flow, told = study.rig.flow(study.point(cell))
    except LostMotionError:
        columns["status"][row] = CODES["failed"]
        return
    box, chaotic = WIDE * reach(flow, BEGINNING), 0
    for k in range(study.starts):
        rng = np.random.default_rng([study.seed, k, *(int(i) for i in cell)])
        start = rng.uniform(-box, box)
        for state, value in told.items():
            start[state] = value
        chaotic += _follow(study, FollowedFlow(flow, start, _tangents(study, flow)), rng, (columns, (row, k)))
    columns["chaotic_fraction"][row] = chaotic / study.starts


def _tangents(study: Study, flow: Flow) -> int:
    return len(flow.states) if any(q.reads == "flow" for q in study.further.values()) else 1


def _follow(study: Study, flow: FollowedFlow, rng: np.random.Generator, into: tuple[Columns, tuple[int, int]]) -> bool:
    """Write what is read off the motion from one start; return whether it is chaotic."""
    columns, at = into
    estimate = quantify(flow, study.exponent, rng=rng)
    scaled = _scaled(study, estimate)
    orbit = flow.strobe(flow.start, periods=study.transient + study.periods, tangents=1)
    period = period_of(orbit.states)
    columns[FLOW_EXPONENT][at], columns["lyapunov_stderr"][at] = scaled
    columns["status"][at], columns["period"][at] = CODES[estimate.status], period
    for name, quantifier in study.further.items():
        further = _further(study, flow, quantifier, rng)
        columns[name][at], columns[f"{name}_stderr"][at] = _scaled(study, further)
        columns[f"{name}_status"][at] = CODES[further.status]
    return period == 0 and estimate.low > 0.0


def _further(study: Study, flow: FollowedFlow, quantifier: Quantifier[Any], rng: np.random.Generator) -> Estimate:
    """Return what one more quantifier says; one that breaks down takes no other number with it."""
    try:
        return _read(study, flow, quantifier, rng)
    except DataError as err:
        return Estimate.refused("failed", str(err), unit=quantifier.unit)
    except Exception as err:
        _warn(quantifier.name, err)
        return Estimate.refused("failed", str(err), unit=quantifier.unit)


def _warn(name: str, err: Exception) -> None:
    """Warn in words that do not change from cell to cell, so that they are shown once."""
    what = "it broke its contract" if isinstance(err, ContractError) else f"{type(err).__name__}: {err}"
    says = f"quantifier {name!r} broke down in a cell of the map ({what}) and is left out there"
    warnings.warn(f"{says}: `lostmotion plugins check {name}` tells what to mend", PluginWarning, stacklevel=2)


def _read(study: Study, flow: FollowedFlow, quantifier: Quantifier[Any], rng: np.random.Generator) -> Estimate:
    if quantifier.reads == "flow":
        return quantify(flow, quantifier, rng=rng)
    settled = flow.strobe(flow.start, periods=study.transient + study.periods, tangents=1).states[study.transient]
    x = flow.sample(settled, periods=study.periods, looks=LOOKS)[:-1, 0]
    assert study.embedder is not None  # noqa: S101 - `study_of` gives one wherever a series is read
    return quantify(embed(x, study.embedder, dt=flow.period / LOOKS, period=flow.period), quantifier, rng=rng)


def _scaled(study: Study, estimate: Estimate) -> tuple[float, float]:
    """Return value and standard error in the units of the file."""
    if estimate.unit == "1/s" and study.bits:
        factor = 1.0 / math.log(2.0)
        told = exponent_in(estimate, "bit/s")
    else:
        factor, told = 1.0, estimate
    stderr = estimate.details.get("stderr", (estimate.high - estimate.low) / 3.92)
    return told.value, factor * stderr


def period_of(states: Array) -> int:
    """Return the period of a motion, in looks, from its last states (looks, n); 0 when there is none up to 32."""
    tail = states[-3 * LONGEST :]
    if len(tail) < 3 * LONGEST or not np.isfinite(tail).all():
        return 0
    scale = CLOSE * np.maximum(np.abs(tail).max(axis=0), 1e-300)
    off = np.abs(tail[-1] - tail[-1 - LONGEST : -1][::-1]) <= scale
    for k in np.flatnonzero(off.all(axis=1)) + 1:
        if (np.abs(tail[k:] - tail[:-k]) <= scale).all():
            return int(k)
    return 0
