"""Recordings that are put together in Python: of arrays, data frames, datasets or the columns of a file."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Mapping
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

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Which = tuple[Mapping[str, str], Mapping[str, str]]
"""Columns by the names that a model has for its inputs, and for its channels."""
PANEL = (7.2, 1.5)
"""Width of a figure and height of one of its panels, in inches."""


def made(
    columns: Mapping[str, ArrayLike],
    which: Which,
    units: Mapping[str, str],
    time: str | None,
    rate: float | None,
    noise: Mapping[str, str],
    hold: Hold,
    name: str,
) -> Recording:
    """Return a recording of columns (n,) in memory."""
    _check_names(columns, which, time, name)
    arrays = {key: _numbers(key, value) for key, value in columns.items() if key in _used(which, time)}
    told = hashlib.sha256(b"".join(key.encode() + array.tobytes() for key, array in sorted(arrays.items()))).hexdigest()
    table = Table(arrays, {key: unit for key, unit in units.items() if key in arrays})
    return recording_of(_spec(which, table.units, time, rate, noise, hold, name), table, name, told)


def read(
    path: Path,
    which: Which,
    units: Mapping[str, str],
    time: str | None,
    rate: float | None,
    noise: Mapping[str, str],
    hold: Hold,
    name: str,
) -> Recording:
    """Return a recording of a file; units that are not given are those that the file tells."""
    table = read_table(path)
    _check_names(table.columns, which, time, path.name)
    told = {**table.units, **units}
    return recording_of(_spec(which, told, time, rate, noise, hold, name or path.stem), table, path.name, digest(path))


def _check_names(columns: Collection[str], which: Which, time: str | None, name: str) -> None:
    """Refuse columns that are not there."""
    for role, wanted in (("inputs", which[0].values()), ("sensors", which[1].values()), ("time", [time] * bool(time))):
        for column in wanted:
            if column not in columns:
                raise DataError(
                    f"{name} has no column {column!r}, which {role} asks for{nearest(str(column), columns)}:"
                    f" it has {', '.join(columns)}"
                )


def check_units(units: Mapping[str, str], columns: Collection[str], name: str) -> None:
    """Refuse the unit of an array that was not given: a misspelled name would otherwise pass unnoticed."""
    known = [*columns, "time"]
    for key in units:
        if key not in known:
            raise DataError(f"units names {key!r}, which is no array of {name}{nearest(key, known)}")


def _used(which: Which, time: str | None) -> set[str]:
    return {*which[0].values(), *which[1].values(), *([time] if time else [])}


def _numbers(name: str, value: ArrayLike) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Return a column as numbers; times of a calendar are seconds from the first one."""
    array = np.asarray(value)
    if array.dtype.kind in "mM":
        array = (array - array[0]) / np.timedelta64(1, "s") if array.size else array.astype(float)
    try:
        numbers = np.asarray(array, dtype=float)
    except (TypeError, ValueError) as err:
        raise DataError(f"{name!r} holds {array.dtype} and no numbers: give an array of floats") from err
    if numbers.ndim != 1:
        raise DataError(f"{name!r} has the shape {numbers.shape}: wanted one number for each sample, (n,)")
    return numbers


def _spec(
    which: Which,
    units: Mapping[str, str],
    time: str | None,
    rate: float | None,
    noise: Mapping[str, str],
    hold: Hold,
    name: str,
) -> RecordingSpec:
    if (time is None) == (rate is None):
        raise DataError(f"{name} has {'both time and' if time else 'neither time nor'} rate: give one of them")
    if not which[1]:
        raise DataError(f"{name} has no sensor: give sensors = {{channel of the model: data}}")
    inputs = tuple(_channel("input", key, column, units) for key, column in which[0].items())
    sensors = tuple(_channel("sensor", key, column, units, noise) for key, column in which[1].items())
    return RecordingSpec(name, time, rate, inputs, sensors, hold, name=name, time_unit=units.get(time or ""))


def _channel(
    role: str, key: str, column: str, units: Mapping[str, str], noise: Mapping[str, str] | None = None
) -> Channel:
    """Return an input or a sensor; one without a unit, or with noise of an unknown kind, is refused."""
    unit = units.get(column, units.get(key))
    if unit is None:
        raise DataError(f"the {role} {key!r} has no unit: add units = {{{column!r}: 'N'}} or the like")
    if role == "input" and not names_quantity(key):
        raise DataError(f"{key!r} is no input of a model: wanted a name such as 'force' or 'base_acceleration'")
    asked = (noise or {}).get(key, "white")
    kind = next((known for known in KINDS if known == asked), None)
    if kind is None:
        raise DataError(f"the noise of {key!r} is {asked!r}{nearest(asked, KINDS)}: wanted one of {', '.join(KINDS)}")
    quantity = "base_position" if key == "base_position" else quantity_of(key)
    si_factor(unit, quantity)
    of = f"{key.removesuffix('torque')}force" if key.endswith("torque") else key
    told = "" if role == "input" else key.replace(".", " ")
    return Channel(column, quantity, unit, of=of, name=told, noise=kind)


def drawn(recording: Recording) -> Figure:
    """Return a figure of a recording, one panel for each channel."""
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
