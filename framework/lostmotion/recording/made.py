"""Recordings made in Python from arrays, data frames, datasets or the columns of a file."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
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
"""Columns keyed by the inputs of a model, and columns keyed by its channels."""
PANEL = (7.2, 1.5)
"""Width of a figure and height of one of its panels, in inches."""


def make_recording(
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
    arrays = {key: _to_numbers(key, value) for key, value in columns.items() if key in _used_columns(which, time)}
    checksum = hashlib.sha256(
        b"".join(key.encode() + array.tobytes() for key, array in sorted(arrays.items()))
    ).hexdigest()
    table = Table(arrays, {key: unit for key, unit in units.items() if key in arrays})
    return recording_of(_make_spec(which, table.units, time, rate, noise, hold, name), table, name, checksum)


def read_recording(
    path: Path,
    which: Which,
    units: Mapping[str, str],
    time: str | None,
    rate: float | None,
    noise: Mapping[str, str],
    hold: Hold,
    name: str,
) -> Recording:
    """Return a recording of a file; units default to those in the file."""
    table = read_table(path)
    note = {**table.units, **units}
    return recording_of(
        _make_spec(which, note, time, rate, noise, hold, name or path.stem), table, path.name, digest(path)
    )


def _used_columns(which: Which, time: str | None) -> set[str]:
    return {*which[0].values(), *which[1].values(), *([time] if time else [])}


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
        raise DataError(f"{name!r} has the shape {numbers.shape}: wanted one number for each sample, (n,)")
    return numbers


def _make_spec(
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
    inputs = tuple(_make_channel("input", key, column, units) for key, column in which[0].items())
    sensors = tuple(_make_channel("sensor", key, column, units, noise) for key, column in which[1].items())
    return RecordingSpec(name, time, rate, inputs, sensors, hold, name=name, time_unit=units.get(time or ""))


def _make_channel(
    role: str, key: str, column: str, units: Mapping[str, str], noise: Mapping[str, str] | None = None
) -> Channel:
    """Return an input or a sensor; raise `DataError` if it has no unit or an unknown kind of noise."""
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
