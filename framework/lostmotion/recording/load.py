"""One recording, read, checked and in SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError, nearest
from lostmotion.provenance import digest
from lostmotion.quantities import si_factor
from lostmotion.recording.checks import bridged, check_finite, check_length, check_values, note_stuck
from lostmotion.recording.doubts import Signal, doubts
from lostmotion.recording.formats import read_table
from lostmotion.recording.spec import Channel, Hold, RecordingSpec
from lostmotion.recording.table import Table
from lostmotion.recording.timing import Clock, check_step, even_clock, resampled
from lostmotion.recording.units import note_unit, seconds, time_unit

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
SHOWN = 12


@dataclass(frozen=True, eq=False)
class Recording:
    """What went in and what came out, in SI units on an even time grid.

    `data` has the dim `time` (s) and the variables `excitation` and `response` (n,), with `units`, `quantity` and
    `long_name`. NaN in the response marks a lost sample; the excitation has none. `dt` is the sampling step (s),
    `digest` the SHA-256 of the file, `source` its name. `notes` are sentences on what looks odd and was accepted.
    """

    name: str
    data: xr.Dataset
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
        return int(self.data.sizes["time"])


def load_recording(spec: RecordingSpec, folder: Path) -> Recording:
    """Return the recording that `spec` describes, its file taken relative to `folder`; `DataError` if unusable."""
    path = Path(folder) / spec.file
    table = read_table(path)
    time, pair, told = _samples(spec, table, path.name)
    check_length(time.size, path.name)
    time, pair = _cut(spec, time, pair)
    check_length(time.size, path.name)
    clock = even_clock(time, path.name) if spec.time else Clock(1.0 / _rate(spec), False, (), float(time[0]))
    roles = (("excitation", spec.excitation), ("response", spec.response))
    even = [_even(role, spec, time, v, clock) for (role, _), v in zip(roles, pair, strict=True)]
    checked = [_checked(r, c, v, path.name) for (r, c), (v, _) in zip(roles, even, strict=True)]
    dt = clock.dt
    data = _dataset(np.asarray(clock.start + dt * np.arange(time.size)), [si for si, _ in checked])
    both = [_signal(channel, si) for (_, channel), (si, _) in zip(roles, checked, strict=True)]
    notes = (
        *told,
        *clock.notes,
        *(note for _, own in (*even, *checked) for note in own),
        *(n for r, c in roles for n in note_unit(c, table.units.get(c.column), f"the {r} {c.column!r}")),
        *doubts(both[0], both[1], dt),
    )
    return Recording(spec.label, data, dt, digest(path), path.name, spec.hold, notes)


def _samples(spec: RecordingSpec, table: Table, source: str) -> tuple[Array, list[Array], tuple[str, ...]]:
    """Return the time (s) and both channels (n,), and notes on the unit of the time column."""
    columns = table.columns
    told: tuple[str, ...] = ()
    names = [spec.excitation.column, spec.response.column]
    found = {name: _pick(columns, name, source) for name in [*names, *([spec.time] if spec.time else [])]}
    sizes = {name: column.size for name, column in found.items()}
    if len(set(sizes.values())) > 1:
        listed = ", ".join(f"{name!r} {size}" for name, size in sizes.items())
        raise DataError(f"{source}: the columns differ in length ({listed}): name columns recorded together")
    if spec.time:
        unit, told = time_unit(spec.time, table.units.get(spec.time), None)
        time = seconds(found[spec.time], unit, source)
    else:
        time = np.arange(found[names[0]].size) / _rate(spec)
    return time, [found[name] for name in names], told


def _even(role: str, spec: RecordingSpec, time: Array, values: Array, clock: Clock) -> tuple[Array, tuple[str, ...]]:
    """Return a channel (n,) on the even grid of its recording, without the lost samples of an input, and notes."""
    channel = spec.response if role == "response" else spec.excitation
    what, source = f"the {role} {channel.column!r}", PurePath(spec.file).name
    notes: tuple[str, ...] = ()
    check_finite(values, what, source)
    if role == "excitation":
        values, notes = bridged(values, what, source, spec.hold)
    hold: Hold = "smooth" if role == "response" else spec.hold
    return (resampled(time, values, clock, hold=hold) if clock.uneven else values), notes


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


def _cut(spec: RecordingSpec, time: Array, pair: list[Array]) -> tuple[Array, list[Array]]:
    """Return the samples from `t_start` to `t_end`, both included; half a rounding error does not lose the last one."""
    if spec.t_start is None and spec.t_end is None:
        return time, pair
    low = -np.inf if spec.t_start is None else spec.t_start - 1e-9 * (1 + abs(spec.t_start))
    high = np.inf if spec.t_end is None else spec.t_end + 1e-9 * (1 + abs(spec.t_end))
    inside = (time >= low) & (time <= high)
    if not inside.any():
        raise DataError(
            f"{spec.file} has no samples from t_start to t_end: its time runs from {time[0]:.6g} s "
            f"to {time[-1]:.6g} s; choose both in there"
        )
    return time[inside], [values[inside] for values in pair]


def _checked(role: str, channel: Channel, values: Array, source: str) -> tuple[xr.DataArray, tuple[str, ...]]:
    import xarray as xr

    response = role == "response"
    what = f"the {role} {channel.column!r}"
    notes = [*check_values(values, what, source, may_miss=response)]
    if response:
        notes += note_stuck(values, what)
    factor, unit = si_factor(channel.unit, channel.quantity)
    si = values * (channel.factor * factor)
    check_values(si, f"{what} in {unit}", source, may_miss=response)
    name = f"{channel.quantity.replace('_', ' ')} (column {channel.column!r})"
    return xr.DataArray(si, dims="time", attrs={"units": unit, "quantity": channel.quantity, "long_name": name}), tuple(
        notes
    )


def _signal(channel: Channel, si: xr.DataArray) -> Signal:
    factor, _ = si_factor(channel.unit, channel.quantity)
    return Signal(si.to_numpy(), channel.column, channel.quantity, channel.unit, factor * channel.factor)


def _dataset(time: Array, channels: list[xr.DataArray]) -> xr.Dataset:
    import xarray as xr

    data = xr.Dataset(dict(zip(("excitation", "response"), channels, strict=True)))
    return data.assign_coords(time=("time", time, {"units": "s", "long_name": "time"}))
