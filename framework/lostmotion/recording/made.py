"""What a recording made in Python consists of: a table of arrays, frames, datasets or files, and its specification."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from lostmotion.arguments import Rule, anything, choice, mapping, maybe, positive, text
from lostmotion.errors import DataError, nearest
from lostmotion.quantities import names_quantity, quantity_of, si_factor
from lostmotion.recording.arrays import table_of_arrays
from lostmotion.recording.clock import find_time, unit_by_size
from lostmotion.recording.column_names import names_time
from lostmotion.recording.folders import digest_recording
from lostmotion.recording.formats import read_table
from lostmotion.recording.spec import Channel, Hold, RecordingSpec
from lostmotion.recording.stamps import is_stamp
from lostmotion.recording.stated_rate import rates_in
from lostmotion.recording.table import Table
from lostmotion.recording.units import check_name

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Which = tuple[Mapping[str, str], Mapping[str, str]]
"""Columns keyed by the inputs of a model, and columns keyed by its channels."""
PANEL = (7.2, 1.5)
"""Width of a figure and height of one of its panels, in inches."""

UNITS = mapping(text, "{'force': 'N', 'position': 'mm'}")
"""The rule of the units of arrays: each of them needs one."""
COMMON: Mapping[str, Rule] = {
    "inputs": maybe(mapping(anything, "{'force': ...}")),
    "sensors": mapping(anything, "{'position': ...}"),
    "units": maybe(UNITS),
    "rate": maybe(positive),
    "noise": maybe(mapping(text, "{'position': 'white'}")),
    "hold": choice("smooth", "step"),
    "name": text,
}
"""The rules of the arguments of all constructors of `Recording`."""
COLUMNS: Mapping[str, Rule] = {
    **COMMON,
    "inputs": maybe(mapping(text, "{'force': column}")),
    "sensors": mapping(text, "{'position': column}"),
    "time": maybe(text),
}
"""The rules of those that take the names of columns."""


@dataclass(frozen=True)
class RecordingLayout:
    """The roles of the columns of a recording: `which` are inputs and sensors, the other fields as in `Recording`.

    `units` are those that the user gives, `stated` those in the attributes of the data, and `attributes` the others;
    `notes` say what was found.
    """

    which: Which
    units: Mapping[str, str]
    time: str | None = None
    rate: float | None = None
    noise: Mapping[str, str] = field(default_factory=dict)
    hold: Hold = "smooth"
    name: str = "recording"
    stated: Mapping[str, str] = field(default_factory=dict)
    attributes: Mapping[str, object] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


class RecordingSource(NamedTuple):
    """A table, what it holds, its name in messages, the SHA-256 of its content, and how its time was found."""

    spec: RecordingSpec
    table: Table
    name: str
    digest: str
    notes: tuple[str, ...]


def collect_columns(columns: Mapping[str, Any], layout: RecordingLayout) -> RecordingSource:
    """Return the source of a recording of columns (n,) in memory."""
    table = replace(table_of_arrays(columns, layout.stated), rates=rates_in(layout.attributes))
    _check_names(table, layout, layout.name)
    layout = _with_time(table, layout, layout.name)
    content = b"".join(key.encode() + table.column(key, layout.name).tobytes() for key in sorted(_used_columns(layout)))
    return _make_source(table, layout, layout.name, hashlib.sha256(content).hexdigest())


def collect_file(path: Path, layout: RecordingLayout) -> RecordingSource:
    """Return the source of a recording in a file; units default to those in the file, the name to its stem."""
    table = read_table(path)
    _check_names(table, layout, path.name)
    layout = _with_time(table, replace(layout, name=layout.name or path.stem), path.name)
    return _make_source(table, layout, path.name, digest_recording(path))


def time_index(frame: Any) -> Any:
    """Return the index of a data frame that is time: dates, stamps, durations, or numbers with a fraction; else None.

    Whole numbers are time where their name or their size says so.
    """
    index: Any = getattr(frame, "index", None)
    if not hasattr(index, "to_numpy") or getattr(index, "nlevels", 1) > 1:
        return None
    if hasattr(index, "to_timestamp"):  # periods
        index = index.to_timestamp()
    held = np.asarray(index.to_numpy())
    dates = held.dtype.kind in "mM" or (
        held.dtype.kind == "O"
        and all(isinstance(one, datetime) or (isinstance(one, str) and is_stamp(one)) for one in held)
    )
    if held.dtype.kind in "iu" and unit_by_size(held.astype(float))[0]:
        return index
    named = names_time(str(getattr(index, "name", None) or "")) and held.dtype.kind in "iu"
    counts = held.dtype.kind in "iuf" and held.size > 1 and bool(np.all(np.diff(held) == 1))
    return index if held.size and not counts and (dates or named or held.dtype.kind == "f") else None


def _with_time(table: Table, layout: RecordingLayout, source: str) -> RecordingLayout:
    """Return the layout with the time that is found in the table, where neither a column nor a rate is given."""
    if layout.time is not None or layout.rate is not None:
        return layout
    found = find_time(table, source, units=layout.units)
    rate = None if found.column else 1.0 / found.clock.dt
    return replace(layout, time=found.column, rate=rate, notes=(found.says,))


def _make_source(table: Table, layout: RecordingLayout, name: str, digest: str) -> RecordingSource:
    for key, column in (*layout.which[0].items(), *layout.which[1].items()):
        if not {key, column} & layout.units.keys():
            check_name(column, table.units.get(column, ""))
    spec = _make_spec(replace(layout, units={**table.units, **layout.units}), layout.units.get(layout.time or ""))
    return RecordingSource(spec, table, name, digest, layout.notes)


def _check_names(table: Table, layout: RecordingLayout, name: str) -> None:
    """Raise `DataError` for a column that does not exist, or that cannot be read."""
    columns = [*table.columns, *table.refused]
    inputs, sensors = layout.which
    time = [layout.time] if layout.time else []
    for role, wanted in (("inputs", inputs.values()), ("sensors", sensors.values()), ("time", time)):
        for column in wanted:
            if column not in columns:
                raise DataError(
                    f"{name} has no column {column!r}, which {role} asks for{nearest(str(column), columns)}:"
                    f" it has {', '.join((*table.full_names, *table.refused))}"
                )
            table.column(column, name)


def check_units(units: Mapping[str, str], columns: Collection[str], name: str) -> None:
    """Raise `DataError` for the unit of an array that is not given: the name may be misspelled."""
    known = [*columns, "time"]
    for key in units:
        if key not in known:
            raise DataError(f"units names {key!r}, which is no array of {name}{nearest(key, known)}")


def _used_columns(layout: RecordingLayout) -> set[str]:
    inputs, sensors = layout.which
    return {*inputs.values(), *sensors.values(), *([layout.time] if layout.time else [])}


def _make_spec(layout: RecordingLayout, time_unit: str | None) -> RecordingSpec:
    name, units, time = layout.name, layout.units, layout.time
    if (time is None) == (layout.rate is None):
        raise DataError(f"{name} has {'both time and' if time else 'neither time nor'} rate: give one of them")
    if not layout.which[1]:
        raise DataError(f"{name} has no sensor: give sensors = {{channel of the model: data}}")
    inputs = tuple(_make_channel("input", key, column, units) for key, column in layout.which[0].items())
    sensors = tuple(
        _make_channel("sensor", key, column, units, layout.noise) for key, column in layout.which[1].items()
    )
    return RecordingSpec(name, time, layout.rate, inputs, sensors, layout.hold, name=name, time_unit=time_unit)


def _make_channel(
    role: str, key: str, column: str, units: Mapping[str, str], noise: Mapping[str, str] | None = None
) -> Channel:
    """Return an input or a sensor; raise `DataError` if it has no unit."""
    unit = units.get(column, units.get(key))
    if unit is None:
        raise DataError(f"the {role} {key!r} has no unit: add units = {{{column!r}: 'N'}} or the like")
    if role == "input" and not names_quantity(key):
        raise DataError(f"{key!r} is no input of a model: expected a name such as 'force' or 'base_acceleration'")
    quantity = "base_position" if key == "base_position" else quantity_of(key)
    si_factor(unit, quantity)
    of = f"{key.removesuffix('torque')}force" if key.endswith("torque") else key
    label = "" if role == "input" else key.replace(".", " ")
    return Channel(column, quantity, unit, of=of, name=label, noise=(noise or {}).get(key, "white"))


def plot_channels(name: str, inputs: Sequence[xr.DataArray], sensors: Sequence[xr.DataArray]) -> Figure:
    """Return a figure of a recording with one panel for each channel, below its name."""
    from matplotlib.figure import Figure

    channels = (*inputs, *sensors)
    figure = Figure(figsize=(PANEL[0], 0.7 + PANEL[1] * len(channels)), layout="constrained")
    panels = figure.subplots(len(channels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, array, i in zip(panels, channels, range(len(channels)), strict=True):
        colour = "#0072b2" if i < len(inputs) else "black"
        axes.plot(array["time"], array, color=colour, linewidth=0.8)
        axes.set_ylabel(f"{array.attrs['sensor'] or array.attrs['of']}\n({array.attrs['units']})".replace("_", " "))
        axes.grid(alpha=0.3)
    panels[-1].set_xlabel("time (s)")
    panels[0].set_title(name)
    return figure
