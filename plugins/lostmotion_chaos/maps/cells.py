"""Compute the cells of a map: the machine at one set of parameters, simulated from several initial states.

All random numbers of a cell are derived from the seed and the position of the cell on the axes, so that results do not
depend on chunks, workers or order.
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

from lostmotion.contracts import Array, Embedder, Flow, Orbit, Quantifier
from lostmotion.errors import ContractError, DataError, LostMotionError, PluginWarning
from lostmotion.results import STATUSES, Estimate
from lostmotion_chaos.analysis.embed import embed
from lostmotion_chaos.analysis.quantify import quantify
from lostmotion_chaos.defaults import FLOW_EXPONENT
from lostmotion_chaos.maps.axes import MapAxis
from lostmotion_chaos.maps.rig import SweptMachine, measure_extent
from lostmotion_chaos.rates import exponent_in

Columns = dict[str, NDArray[Any]]

STATES = (*STATUSES, "not_computed")
CODES: Mapping[str, int] = {**{name: code for code, name in enumerate(STATUSES)}, "not_computed": -1}
"""The code of each status in a file."""
MAX_PERIOD = 32
"""Longest period, in periods of the drive, at which a motion is recognised as periodic."""
RETURN_TOLERANCE = 1e-5
"""Two strobe points are the same when their distance is below this share of the size of the motion."""
START_BOX, START_PERIODS = 2.0, 40
"""Initial states are drawn uniformly from a box: `START_BOX` times the extent of `START_PERIODS` periods from rest."""
SAMPLES_PER_PERIOD = 32
"""Samples in a period for quantifiers that read a series."""


@dataclass(frozen=True)
class Study:
    """A machine, the axes of its map, the length and number of the simulations in each cell, and the quantifiers.

    `exponent` reads the flow. `further` are more quantifiers by their name in the file; those that read a series get
    the first state, embedded by `embedder`. `bits` gives exponents in bit instead of nat. `origins` are the digests or
    versions of the third-party plugins that are used.
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
        """The number of points along each axis."""
        return tuple(axis.count for axis in self.axes)

    @cached_property
    def points(self) -> tuple[Array, ...]:
        """The values of the points on each axis."""
        return tuple(axis.values for axis in self.axes)

    @property
    def unit(self) -> str:
        """The unit of an exponent."""
        return f"{'bit' if self.bits else '1'}/{self.rig.time_unit}"

    def point(self, cell: Array | tuple[int, ...]) -> dict[str, float]:
        """Return the values of the swept quantities in the cell with these indices (axes,)."""
        indexed = zip(self.axes, self.points, cell, strict=True)
        return {axis.name: float(values[int(i)]) for axis, values, i in indexed}


class CachedFlow:
    """A flow from one initial state that stores its orbit, so that several quantifiers read the same orbit."""

    def __init__(self, flow: Flow, start: Array, tangents: int) -> None:
        self._flow, self.start, self._tangents = flow, start, tangents
        self.period, self.driven, self.states = flow.period, flow.driven, flow.states
        self._orbits: dict[int, Orbit] = {}

    def strobe(self, start: Array, *, periods: int, tangents: int) -> Orbit:
        """Return the orbit from the initial state of this flow, with the first `tangents` of its tangent vectors."""
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


def compute_cells(study: Study, cells: NDArray[np.int64]) -> Columns:
    """Return the columns (cells, starts) of cells given by their indices (cells, axes).

    The column `chaotic_fraction` is (cells,).
    """
    columns = make_blank_columns(study, len(cells))
    for row, cell in enumerate(cells):
        _fill_row(study, cell, columns, row)
    return columns


def make_blank_columns(study: Study, many: int) -> Columns:
    """Return columns for `many` cells in which every value is marked as not computed."""
    shape = (many, study.starts)
    columns: Columns = {FLOW_EXPONENT: np.full(shape, np.nan), "lyapunov_stderr": np.full(shape, np.nan)}
    for name in study.further:
        columns[name], columns[f"{name}_stderr"] = np.full(shape, np.nan), np.full(shape, np.nan)
        columns[f"{name}_status"] = np.full(shape, CODES["not_computed"], np.int8)
    columns["period"] = np.full(shape, -1, np.int16)
    columns["chaotic_fraction"] = np.full(many, np.nan)
    columns["status"] = np.full(shape, CODES["not_computed"], np.int8)
    return columns


def _fill_row(study: Study, cell: Array, columns: Columns, row: int) -> None:
    """Compute one cell and write it into one row of the columns."""
    try:
        flow, fixed_states = study.rig.flow(study.point(cell))
    except LostMotionError:
        columns["status"][row] = CODES["failed"]
        return
    box, chaotic = START_BOX * measure_extent(flow, START_PERIODS), 0
    for k in range(study.starts):
        rng = np.random.default_rng([study.seed, k, *(int(i) for i in cell)])
        start = rng.uniform(-box, box)
        for state, value in fixed_states.items():
            start[state] = value
        chaotic += _follow_start(study, CachedFlow(flow, start, _count_tangents(study, flow)), rng, (columns, (row, k)))
    columns["chaotic_fraction"][row] = chaotic / study.starts


def _count_tangents(study: Study, flow: Flow) -> int:
    """Return how many tangent vectors are needed: all where a further quantifier reads the flow, else one."""
    return len(flow.states) if any(q.reads == "flow" for q in study.further.values()) else 1


def _follow_start(
    study: Study, flow: CachedFlow, rng: np.random.Generator, into: tuple[Columns, tuple[int, int]]
) -> bool:
    """Write the quantities of the motion from one initial state; return whether it is chaotic."""
    columns, at = into
    estimate = quantify(flow, study.exponent, rng=rng)
    scaled = _convert_units(study, estimate)
    orbit = flow.strobe(flow.start, periods=study.transient + study.periods, tangents=1)
    period = find_period(orbit.states)
    columns[FLOW_EXPONENT][at], columns["lyapunov_stderr"][at] = scaled
    columns["status"][at], columns["period"][at] = CODES[estimate.status], period
    for name, quantifier in study.further.items():
        further = _estimate_further(study, flow, quantifier, rng)
        columns[name][at], columns[f"{name}_stderr"][at] = _convert_units(study, further)
        columns[f"{name}_status"][at] = CODES[further.status]
    return period == 0 and estimate.low > 0.0


def _estimate_further(
    study: Study, flow: CachedFlow, quantifier: Quantifier[Any], rng: np.random.Generator
) -> Estimate:
    """Return the estimate of one further quantifier; an exception in it becomes the status "failed"."""
    try:
        return _estimate_quantity(study, flow, quantifier, rng)
    except DataError as err:
        return Estimate.refused("failed", str(err), unit=quantifier.unit)
    except Exception as err:
        _warn_of_failure(quantifier.name, err)
        return Estimate.refused("failed", str(err), unit=quantifier.unit)


def _warn_of_failure(name: str, err: Exception) -> None:
    """Warn with a text that is the same for every cell, so that it is shown once."""
    what = "it broke its contract" if isinstance(err, ContractError) else f"{type(err).__name__}: {err}"
    says = f"quantifier {name!r} failed in a cell of the map ({what}) and is left out there"
    warnings.warn(f"{says}: `lostmotion plugins check {name}` shows what to correct", PluginWarning, stacklevel=2)


def _estimate_quantity(
    study: Study, flow: CachedFlow, quantifier: Quantifier[Any], rng: np.random.Generator
) -> Estimate:
    """Return the estimate of a quantifier from the flow, or from the sampled and embedded first state."""
    if quantifier.reads == "flow":
        return quantify(flow, quantifier, rng=rng)
    settled = flow.strobe(flow.start, periods=study.transient + study.periods, tangents=1).states[study.transient]
    x = flow.sample(settled, periods=study.periods, looks=SAMPLES_PER_PERIOD)[:-1, 0]
    assert study.embedder is not None  # noqa: S101 - `make_study` gives one wherever a series is read
    return quantify(
        embed(x, study.embedder, dt=flow.period / SAMPLES_PER_PERIOD, period=flow.period), quantifier, rng=rng
    )


def _convert_units(study: Study, estimate: Estimate) -> tuple[float, float]:
    """Return value and standard error in the units of the file."""
    if estimate.unit == "1/s" and study.bits:
        factor = 1.0 / math.log(2.0)
        converted = exponent_in(estimate, "bit/s")
    else:
        factor, converted = 1.0, estimate
    stderr = estimate.details.get("stderr", (estimate.high - estimate.low) / 3.92)
    return converted.value, factor * stderr


def find_period(states: Array) -> int:
    """Return the period of a motion in drive periods from its strobe states (periods, n); 0 if none up to 32 fits."""
    tail = states[-3 * MAX_PERIOD :]
    if len(tail) < 3 * MAX_PERIOD or not np.isfinite(tail).all():
        return 0
    scale = RETURN_TOLERANCE * np.maximum(np.abs(tail).max(axis=0), 1e-300)
    off = np.abs(tail[-1] - tail[-1 - MAX_PERIOD : -1][::-1]) <= scale
    for k in np.flatnonzero(off.all(axis=1)) + 1:
        if (np.abs(tail[k:] - tail[:-k]) <= scale).all():
            return int(k)
    return 0
