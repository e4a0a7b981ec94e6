"""One recording, read, checked and in SI units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError, nearest
from lostmotion.provenance import digest
from lostmotion.quantities import si_factor
from lostmotion.recording.checks import check_length, check_values, note_stuck
from lostmotion.recording.doubts import Signal, doubts
from lostmotion.recording.formats import read_columns
from lostmotion.recording.spec import Channel, Hold, RecordingSpec
from lostmotion.recording.timing import check_step, check_time

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
SHOWN = 12


@dataclass(frozen=True, eq=False)
class Recording:
    """What went in and what came out, in SI units on an even time grid.

    `inputs` (none in a free decay) and `sensors` are arrays (n,) over the dim `time` (s), with the attributes `units`,
    `quantity`, `long_name`, and `of`, the input or channel of a model; those of a sensor have `sensor`, its name, and
    `noise` beside them. NaN in a sensor marks a reading that was not taken; an input has none. `dt` is the sampling
    step (s), `digest` the SHA-256 of the file, `source` its name. `notes` are sentences on what looks odd and was
    accepted.
    """

    name: str
    inputs: tuple[xr.DataArray, ...]
    sensors: tuple[xr.DataArray, ...]
    dt: float
    digest: str
    source: str
    hold: Hold = "smooth"
    notes: tuple[str, ...] = ()

    @property
    def rate(self) -> float:
        """The sampling rate in Hz."""
        return 1.0 / self.dt

    @property
    def n(self) -> int:
        """The number of samples."""
        return int(self.sensors[0].sizes["time"])

    @property
    def data(self) -> xr.Dataset:
        """All channels as one dataset: `excitation`, the first input, `response`, the first sensor, and the others.

        Those are called `input 2`, ... and `sensor 2`, ...
        """
        import xarray as xr

        table = _numbered("excitation", "input", self.inputs) | _numbered("response", "sensor", self.sensors)
        return xr.Dataset(table)


def _numbered(first: str, more: str, arrays: Sequence[xr.DataArray]) -> dict[str, xr.DataArray]:
    return {f"{more} {i + 1}" if i else first: array for i, array in enumerate(arrays)}


def load_recording(spec: RecordingSpec, folder: Path) -> Recording:
    """Return the recording that `spec` describes, its file taken relative to `folder`; `DataError` if unusable."""
    path = Path(folder) / spec.file
    columns = read_columns(path)
    time, values = _samples(spec, columns, path.name)
    check_length(time.size, path.name)
    time, values = _cut(spec, time, values)
    check_length(time.size, path.name)
    dt, notes = check_time(time, path.name) if spec.time else (1.0 / _rate(spec), ())
    even = time[0] + dt * np.arange(time.size)
    roles = [("excitation", c) for c in spec.inputs] + [("response", c) for c in spec.sensors]
    checked = [_checked(role, c, v, path.name) for (role, c), v in zip(roles, values, strict=True)]
    arrays = [_array(c, si, even) for (_, c), (si, _) in zip(roles, checked, strict=True)]
    count = len(spec.inputs)
    signals = [_signal(channel, si) for (_, channel), (si, _) in zip(roles, checked, strict=True)]
    told = (*notes, *(note for _, own in checked for note in own), *doubts(signals[:count], signals[count:], dt))
    inputs, sensors = tuple(arrays[:count]), tuple(arrays[count:])
    return Recording(spec.label, inputs, sensors, dt, digest(path), path.name, spec.hold, tuple(dict.fromkeys(told)))


def _samples(spec: RecordingSpec, columns: Mapping[str, Array], source: str) -> tuple[Array, list[Array]]:
    names = [channel.column for channel in (*spec.inputs, *spec.sensors)]
    found = {name: _pick(columns, name, source) for name in [*names, *([spec.time] if spec.time else [])]}
    sizes = {name: column.size for name, column in found.items()}
    if len(set(sizes.values())) > 1:
        listed = ", ".join(f"{name!r} {size}" for name, size in sizes.items())
        raise DataError(f"{source}: the columns differ in length ({listed}): name columns recorded together")
    time = found[spec.time] if spec.time else np.arange(found[names[0]].size) / _rate(spec)
    return time, [found[name] for name in names]


def _rate(spec: RecordingSpec) -> float:
    if spec.rate is None or not 0 < spec.rate < np.inf:
        raise DataError(f"{spec.file} has neither time nor a positive rate: give time = 'column' or rate = 1000.0 (Hz)")
    check_step(1.0 / spec.rate, spec.file)
    return spec.rate


def _pick(columns: Mapping[str, Array], name: str, source: str) -> Array:
    if name in columns:
        return columns[name]
    listed = [*columns][:SHOWN]
    more = f" and {len(columns) - SHOWN} more" if len(columns) > SHOWN else ""
    raise DataError(
        f"{source} has no column of numbers named {name!r}: it has {', '.join(listed)}{more}{nearest(name, columns)}; "
        "name one of these"
    )


def _cut(spec: RecordingSpec, time: Array, columns: list[Array]) -> tuple[Array, list[Array]]:
    """Return the samples from `t_start` to `t_end`, both included; half a rounding error does not lose the last one."""
    if spec.t_start is None and spec.t_end is None:
        return time, columns
    low = -np.inf if spec.t_start is None else spec.t_start - 1e-9 * (1 + abs(spec.t_start))
    high = np.inf if spec.t_end is None else spec.t_end + 1e-9 * (1 + abs(spec.t_end))
    inside = (time >= low) & (time <= high)
    if not inside.any():
        raise DataError(
            f"{spec.file} has no samples from t_start to t_end: its time runs from {time[0]:.6g} s "
            f"to {time[-1]:.6g} s; choose both in there"
        )
    return time[inside], [values[inside] for values in columns]


def _checked(role: str, channel: Channel, values: Array, source: str) -> tuple[Array, tuple[str, ...]]:
    """Return a channel (n,) in SI units, and notes on it."""
    response = role == "response"
    what = f"the {role} {channel.column!r}"
    notes = [*check_values(values, what, source, may_miss=response)]
    if response:
        notes += note_stuck(values, what)
    factor, unit = si_factor(channel.unit, channel.quantity)
    si = values * (channel.factor * factor)
    check_values(si, f"{what} in {unit}", source, may_miss=response)
    return si, tuple(notes)


def _array(channel: Channel, si: Array, time: Array) -> xr.DataArray:
    import xarray as xr

    _, unit = si_factor(channel.unit, channel.quantity)
    words = channel.name or channel.quantity.replace("_", " ")
    attrs = {"units": unit, "quantity": channel.quantity, "of": channel.target, "sensor": channel.name}
    more = {"noise": channel.noise, "long_name": f"{words} (column {channel.column!r})"}
    clock = ("time", time, {"units": "s", "long_name": "time"})
    return xr.DataArray(si, dims="time", coords={"time": clock}, attrs=attrs | more)


def _signal(channel: Channel, si: Array) -> Signal:
    factor, _ = si_factor(channel.unit, channel.quantity)
    return Signal(si, channel.column, channel.quantity, channel.unit, factor * channel.factor)
