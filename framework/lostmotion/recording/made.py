"""Recordings made in Python from arrays, data frames, datasets or the columns of a file."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from lostmotion.errors import DataError, nearest
from lostmotion.provenance import digest
from lostmotion.quantities import names_quantity, quantity_of, si_factor
from lostmotion.recording.formats import read_table
from lostmotion.recording.load import Recording, recording_of
from lostmotion.recording.spec import KINDS, Channel, Hold, RecordingSpec
from lostmotion.recording.table import Table
from lostmotion.settings import Settings, read

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Which = tuple[Mapping[str, str], Mapping[str, str]]
"""Columns keyed by the inputs of a model, and columns keyed by its channels."""
PANEL = (7.2, 1.5)
"""Width of a figure and height of one of its panels, in inches."""


@dataclass(frozen=True)
class RecordingLayout:
    """The roles of the columns of a recording: `which` are inputs and sensors, the other fields as in `Recording`."""

    which: Which
    units: Mapping[str, str]
    time: str | None = None
    rate: float | None = None
    noise: Mapping[str, str] = field(default_factory=dict)
    hold: Hold = "smooth"
    name: str = "recording"


def make_recording(
    columns: Mapping[str, ArrayLike],
    layout: RecordingLayout,
    settings: Settings | Mapping[str, float] | None = None,
) -> Recording:
    """Return a recording of columns (n,) in memory."""
    _check_names(columns, layout, layout.name)
    used = _used_columns(layout)
    arrays = {key: _to_numbers(key, value) for key, value in columns.items() if key in used}
    content = b"".join(key.encode() + array.tobytes() for key, array in sorted(arrays.items()))
    table = Table(arrays, {key: unit for key, unit in layout.units.items() if key in arrays})
    spec = _make_spec(replace(layout, units=table.units))
    return recording_of(spec, table, layout.name, hashlib.sha256(content).hexdigest(), read(settings).recording)


def read_recording(
    path: Path, layout: RecordingLayout, settings: Settings | Mapping[str, float] | None = None
) -> Recording:
    """Return a recording of a file; units default to those in the file, the name to the stem of the file."""
    table = read_table(path)
    _check_names(table.columns, layout, path.name)
    spec = _make_spec(replace(layout, units={**table.units, **layout.units}, name=layout.name or path.stem))
    return recording_of(spec, table, path.name, digest(path), read(settings).recording)


def _check_names(columns: Collection[str], layout: RecordingLayout, name: str) -> None:
    """Raise `DataError` for a column that does not exist."""
    inputs, sensors = layout.which
    time = [layout.time] if layout.time else []
    for role, wanted in (("inputs", inputs.values()), ("sensors", sensors.values()), ("time", time)):
        for column in wanted:
            if column not in columns:
                raise DataError(
                    f"{name} has no column {column!r}, which {role} asks for{nearest(str(column), columns)}:"
                    f" it has {', '.join(columns)}"
                )


def check_units(units: Mapping[str, str], columns: Collection[str], name: str) -> None:
    """Raise `DataError` for the unit of an array that is not given: the name may be misspelled."""
    known = [*columns, "time"]
    for key in units:
        if key not in known:
            raise DataError(f"units names {key!r}, which is no array of {name}{nearest(key, known)}")


def _used_columns(layout: RecordingLayout) -> set[str]:
    inputs, sensors = layout.which
    return {*inputs.values(), *sensors.values(), *([layout.time] if layout.time else [])}


def _to_numbers(name: str, value: ArrayLike) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Return a column as numbers (n,); calendar times become seconds from the first one."""
    array = np.asarray(value)
    if array.dtype.kind in "mM":
        array = (array - array[0]) / np.timedelta64(1, "s") if array.size else array.astype(float)
    try:
        numbers = np.asarray(array, dtype=float)
    except (TypeError, ValueError) as err:
        raise DataError(f"{name!r} holds {array.dtype} instead of numbers: give an array of floats") from err
    if numbers.ndim != 1:
        raise DataError(f"{name!r} has the shape {numbers.shape}: expected one number for each sample, (n,)")
    return numbers


def _make_spec(layout: RecordingLayout) -> RecordingSpec:
    name, units, time = layout.name, layout.units, layout.time
    if (time is None) == (layout.rate is None):
        raise DataError(f"{name} has {'both time and' if time else 'neither time nor'} rate: give one of them")
    if not layout.which[1]:
        raise DataError(f"{name} has no sensor: give sensors = {{channel of the model: data}}")
    inputs = tuple(_make_channel("input", key, column, units) for key, column in layout.which[0].items())
    sensors = tuple(
        _make_channel("sensor", key, column, units, layout.noise) for key, column in layout.which[1].items()
    )
    return RecordingSpec(
        name, time, layout.rate, inputs, sensors, layout.hold, name=name, time_unit=units.get(time or "")
    )


def _make_channel(
    role: str, key: str, column: str, units: Mapping[str, str], noise: Mapping[str, str] | None = None
) -> Channel:
    """Return an input or a sensor; raise `DataError` if it has no unit or an unknown kind of noise."""
    unit = units.get(column, units.get(key))
    if unit is None:
        raise DataError(f"the {role} {key!r} has no unit: add units = {{{column!r}: 'N'}} or the like")
    if role == "input" and not names_quantity(key):
        raise DataError(f"{key!r} is no input of a model: expected a name such as 'force' or 'base_acceleration'")
    asked = (noise or {}).get(key, "white")
    kind = next((known for known in KINDS if known == asked), None)
    if kind is None:
        raise DataError(f"the noise of {key!r} is {asked!r}{nearest(asked, KINDS)}: expected one of {', '.join(KINDS)}")
    quantity = "base_position" if key == "base_position" else quantity_of(key)
    si_factor(unit, quantity)
    of = f"{key.removesuffix('torque')}force" if key.endswith("torque") else key
    label = "" if role == "input" else key.replace(".", " ")
    return Channel(column, quantity, unit, of=of, name=label, noise=kind)


def plot_recording(recording: Recording) -> Figure:
    """Return a figure of a recording with one panel for each channel."""
    from matplotlib.figure import Figure

    channels = (*recording.inputs, *recording.sensors)
    figure = Figure(figsize=(PANEL[0], 0.7 + PANEL[1] * len(channels)), layout="constrained")
    panels = figure.subplots(len(channels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, array, i in zip(panels, channels, range(len(channels)), strict=True):
        colour = "#0072b2" if i < len(recording.inputs) else "black"
        axes.plot(array["time"], array, color=colour, linewidth=0.8)
        axes.set_ylabel(f"{array.attrs['sensor'] or array.attrs['of']}\n({array.attrs['units']})".replace("_", " "))
        axes.grid(alpha=0.3)
    panels[-1].set_xlabel("time (s)")
    panels[0].set_title(recording.name)
    return figure
