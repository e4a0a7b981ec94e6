"""Loading of one recording: read, checked and converted to SI units."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lostmotion.arguments import checked, describe, path
from lostmotion.errors import DataError
from lostmotion.quantities import si_factor
from lostmotion.recording.clock import checked_clock, note_other_rate, note_repeated_rows, note_stated, read_time
from lostmotion.recording.counts import centre_position, sum_changes
from lostmotion.recording.folders import digest_recording
from lostmotion.recording.formats import read_table
from lostmotion.recording.made import (
    COLUMNS,
    COMMON,
    UNITS,
    RecordingLayout,
    RecordingSource,
    check_units,
    collect_columns,
    collect_file,
    plot_channels,
    time_index,
)
from lostmotion.recording.spec import Channel, Hold, RecordingSpec
from lostmotion.recording.table import Table
from lostmotion.recording.timing import EvenClock, check_step, resample_channel
from lostmotion.recording.units import note_unit
from lostmotion.recording.value_checks import (
    check_finite,
    check_length,
    check_sensor,
    check_values,
    fill_input,
    note_stuck,
)
from lostmotion.recording.warnings import CheckedChannel, warnings_of
from lostmotion.settings import DEFAULT, RecordingSettings, Settings, read

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Recording:
    """Measured inputs and sensor readings in SI units on an even time grid.

    `inputs` (none in a free decay) and `sensors` are arrays (n,) over the dim `time` (s), with the attributes `units`,
    `quantity`, `long_name`, and `of`, the input or channel of a model. A sensor has the attributes `sensor`, its name,
    `noise`, and `zero`, "known" or "unknown". NaN in a sensor marks a missing reading; inputs contain none. `dt` is the
    sampling step (s), `digest` the SHA-256 of the file, `source` its name. `notes` are warnings in sentences; `start`
    is the time of the recording, where it is known.
    """

    name: str
    inputs: tuple[xr.DataArray, ...]
    sensors: tuple[xr.DataArray, ...]
    dt: float
    digest: str
    source: str
    hold: Hold = "smooth"
    notes: tuple[str, ...] = ()
    start: str | None = None

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
        """All channels as one dataset: `excitation` is the first input, `response` the first sensor.

        The others are called `input 2`, ... and `sensor 2`, ...
        """
        import xarray as xr

        table = _name_arrays("excitation", "input", self.inputs) | _name_arrays("response", "sensor", self.sensors)
        return xr.Dataset(table)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings about the recording, in sentences; it can be used all the same."""
        return self.notes

    def to_xarray(self) -> xr.Dataset:
        """Return inputs and sensors (n,) in SI units over `time` (s), by their names, with units as attributes."""
        import xarray as xr

        named = {str(a.attrs["of"]): a for a in self.inputs}
        named |= {str(a.attrs["sensor"] or a.attrs["of"]): a for a in self.sensors}
        return xr.Dataset(named, attrs={"title": self.name, "hold": self.hold})

    def plot(self) -> Figure:
        """Return a figure of all inputs and sensors over time, one below the other."""
        return plot_channels(self.name, self.inputs, self.sensors)

    def __repr__(self) -> str:
        channels = [f"{a.attrs['of']} ({a.attrs['units']})" for a in (*self.inputs, *self.sensors)]
        length = f"{self.n} samples at {self.rate:.6g} Hz, {self.n * self.dt:.4g} s"
        return f"<Recording {self.name!r}: {', '.join(channels)}; {length}{'; see .warnings' if self.notes else ''}>"

    @classmethod
    @checked(**{**COMMON, "units": UNITS})
    def from_arrays(
        cls,
        time: ArrayLike | None = None,
        *,
        sensors: Mapping[str, ArrayLike],
        inputs: Mapping[str, ArrayLike] | None = None,
        units: Mapping[str, str],
        rate: float | None = None,
        noise: Mapping[str, str] | None = None,
        hold: Hold = "smooth",
        name: str = "recording",
        settings: Settings | Mapping[str, float] | None = None,
    ) -> Recording:
        """Return a recording of arrays (n,), keyed by the names of the inputs and channels of the model.

        Give either `time` (n,) in s, or in the unit `units["time"]`, or the `rate` in Hz. `units` has one entry for
        each array, `noise` the kind of noise of a sensor ("white", "ar1", "quantised"). Without inputs it is a free
        decay. `settings` changes the thresholds of warnings, such as `{"recording.far": 30.0}`. `DataError` or
        `CaseError` is raised where the numbers cannot be used.
        """
        columns = {**(inputs or {}), **sensors}
        if sensors:
            check_units(units, columns, name)
        times = {} if time is None else {"time": time}
        which = ({name: name for name in inputs or {}}, {name: name for name in sensors})
        given = None if time is None else "time"
        layout = RecordingLayout(which, units, given, rate, noise or {}, hold, name)
        return make_recording(collect_columns({**times, **columns}, layout), settings)

    @classmethod
    @checked(**COLUMNS)
    def from_pandas(
        cls,
        frame: Any,
        *,
        sensors: Mapping[str, str],
        inputs: Mapping[str, str] | None = None,
        units: Mapping[str, str] | None = None,
        time: str | None = None,
        rate: float | None = None,
        noise: Mapping[str, str] | None = None,
        hold: Hold = "smooth",
        name: str = "recording",
        settings: Settings | Mapping[str, float] | None = None,
    ) -> Recording:
        """Return a recording of columns of a data frame; `inputs` and `sensors` map names of the model to columns.

        `frame` is of pandas or polars. `units` default to those in the names of the columns, `force_N`, or in
        `frame.attrs["units"]`. Without `time` and `rate` an index of dates, durations or numbers with a fraction is the
        time (s), or else the column that holds it; an index that counts rows is none. Missing readings become NaN.
        """
        lazy = isinstance(frame, type) or hasattr(frame, "collect")
        if lazy or not (hasattr(frame, "columns") and hasattr(frame, "__getitem__")):
            raise DataError(f"frame is {describe(frame)}: expected a data frame of pandas or polars (not a lazy one)")
        twice = {str(name) for name, count in Counter(frame.columns).items() if count > 1}
        for column in {*sensors.values(), *(inputs or {}).values(), time or ""} & twice:
            raise DataError(f"frame has several columns named {column!r}: rename all but one")
        columns = {str(column): frame[column] for column in frame.columns if str(column) not in twice}
        if time is None and (index := time_index(frame)) is not None:
            named = str(index.name or "index")
            columns[named] = index
            time = named if rate is None else None
        held = getattr(frame, "attrs", {})
        which = (inputs or {}, sensors)
        layout = RecordingLayout(
            which, units or {}, time, rate, noise or {}, hold, name, dict(held.get("units", {})), held
        )
        return make_recording(collect_columns(columns, layout), settings)

    @classmethod
    @checked(**COLUMNS)
    def from_xarray(
        cls,
        dataset: xr.Dataset,
        *,
        sensors: Mapping[str, str],
        inputs: Mapping[str, str] | None = None,
        time: str | None = None,
        units: Mapping[str, str] | None = None,
        noise: Mapping[str, str] | None = None,
        hold: Hold = "smooth",
        name: str = "recording",
        settings: Settings | Mapping[str, float] | None = None,
    ) -> Recording:
        """Return a recording of variables of a dataset; `units` default to the attributes of the variables.

        Fill values and missing values that the attributes name become NaN. Without `time` the time is found.
        """
        import xarray as xr

        if not isinstance(dataset, xr.Dataset):
            raise DataError(f"dataset is {describe(dataset)}: expected a Dataset of xarray")
        decoded = xr.decode_cf(dataset, decode_times=False)  # fill values become NaN, packed numbers are unpacked
        columns = {str(key): value.values for key, value in decoded.variables.items() if value.ndim}
        stated = {
            str(key): str(value.attrs["units"]) for key, value in decoded.variables.items() if "units" in value.attrs
        }
        held = {**dataset.attrs, **{str(k): v.values.item() for k, v in decoded.variables.items() if not v.ndim}}
        which = (inputs or {}, sensors)
        layout = RecordingLayout(which, units or {}, time, None, noise or {}, hold, name, stated, held)
        return make_recording(collect_columns(columns, layout), settings)

    @classmethod
    @checked(**COLUMNS, path=path)
    def read(
        cls,
        path: str | Path,
        *,
        sensors: Mapping[str, str],
        inputs: Mapping[str, str] | None = None,
        time: str | None = None,
        rate: float | None = None,
        units: Mapping[str, str] | None = None,
        noise: Mapping[str, str] | None = None,
        hold: Hold = "smooth",
        name: str = "",
        settings: Settings | Mapping[str, float] | None = None,
    ) -> Recording:
        """Return a recording from a file in one of the supported formats: .csv, .mat, .nc, .uff, ...

        `inputs` and `sensors` map names of the model to columns. `units` are needed for columns for which the file
        gives none. Without `time` and `rate` the time is found in the file, and a note says how.
        """
        which = (inputs or {}, sensors)
        layout = RecordingLayout(which, units or {}, time, rate, noise or {}, hold, name)
        return make_recording(collect_file(Path(path), layout), settings)


def make_recording(source: RecordingSource, settings: Settings | Mapping[str, float] | None = None) -> Recording:
    """Return the recording of a table that was given in Python; `settings` are the thresholds of its warnings."""
    made = recording_of(source.spec, source.table, source.name, source.digest, read(settings).recording)
    return replace(made, notes=(*source.notes, *made.notes))


def _name_arrays(first: str, more: str, arrays: Sequence[xr.DataArray]) -> dict[str, xr.DataArray]:
    return {f"{more} {i + 1}" if i else first: array for i, array in enumerate(arrays)}


def load_recording(spec: RecordingSpec, folder: Path, limits: RecordingSettings = DEFAULT.recording) -> Recording:
    """Return the recording that `spec` describes, its file relative to `folder`; `DataError` if it is unusable."""
    path = Path(folder) / spec.file
    return recording_of(spec, read_table(path), path.name, digest_recording(path), limits)


def recording_of(
    spec: RecordingSpec, table: Table, source: str, sha256: str, limits: RecordingSettings = DEFAULT.recording
) -> Recording:
    """Return the recording that `spec` describes in a table of columns; `source` is its name in messages."""
    time, values, notes = _pick_samples(spec, table, source)
    check_length(time.size, source)
    inside = _find_inside(spec, time)
    time, values = time[inside], [column[inside] for column in values]
    check_length(time.size, source)
    if spec.time:
        clock = checked_clock(time, source, table, spec.time, spec.time_unit, int(np.argmax(inside)))
        notes = (*notes, *note_stated(table, clock))
    else:
        clock = EvenClock(1.0 / _require_rate(spec), False, (), float(time[0]))
    roles = [("excitation", c) for c in spec.inputs] + [("response", c) for c in spec.sensors]
    channels = [_ChannelReader(role, c, spec, source, limits.stuck) for role, c in roles]
    read = [channel.on(clock, time, raw) for channel, raw in zip(channels, values, strict=True)]
    count, grid = len(spec.inputs), np.asarray(clock.start + clock.dt * np.arange(time.size))
    arrays = [channel.array(si, grid) for channel, (si, _) in zip(channels, read, strict=True)]
    signals = [channel.signal(si) for channel, (si, _) in zip(channels, read, strict=True)]
    units = [n for c in channels for n in note_unit(c.channel, table.units.get(c.channel.column), c.what)]
    warnings = warnings_of(signals[:count], signals[count:], clock.dt, limits)
    all_notes = dict.fromkeys((*notes, *clock.notes, *(n for _, own in read for n in own), *units, *warnings))
    inputs, sensors, start = (
        tuple(arrays[:count]),
        tuple(arrays[count:]),
        spec.start or table.starts.get(spec.time or ""),
    )
    return Recording(spec.label, inputs, sensors, clock.dt, sha256, source, spec.hold, tuple(all_notes), start)


@dataclass(frozen=True)
class _ChannelReader:
    """A channel while it is read: its role (excitation, response), its entry in the case, and the file.

    `stuck` is the share of samples at the extreme value above which a sensor is called stuck.
    """

    role: str
    channel: Channel
    spec: RecordingSpec
    source: str
    stuck: float

    @property
    def what(self) -> str:
        """The name of the channel in messages."""
        return f"the {self.role} {self.channel.column!r}"

    def on(self, clock: EvenClock, time: Array, raw: Array) -> tuple[Array, tuple[str, ...]]:
        """Return the channel (n,) in SI units on the even grid, with lost samples of an input filled, and notes.

        `raw` (n,) holds the values at the times `time` (n,) in s.
        """
        check_finite(raw, self.what, self.source)
        if self.role == "excitation":
            values, notes = fill_input(raw, self.what, self.source, self.spec.hold)
            even = resample_channel(time, values, clock, hold=self.spec.hold) if clock.uneven else values
            notes = (*notes, *check_values(even, self.what, self.source, may_miss=False))
            return self._to_si(even), notes
        if self.channel.differences:
            raw = sum_changes(raw, self.what, self.source)
        if self.channel.loose:
            raw = centre_position(raw)
        even = resample_channel(time, raw, clock) if clock.uneven else raw
        notes = check_sensor(even, self.what, self.source, dt=clock.dt)
        return self._to_si(even), (*notes, *note_stuck(even, self.what, self.stuck))

    def _to_si(self, values: Array) -> Array:
        factor, unit = si_factor(self.channel.unit, self.channel.quantity)
        si = np.asarray(values * (self.channel.factor * factor))
        check_values(si[np.isfinite(si)], f"{self.what} in {unit}", self.source, may_miss=False)
        return si

    def array(self, si: Array, time: Array) -> xr.DataArray:
        """Return the channel (n,) over the times (n,) in s, with its attributes."""
        import xarray as xr

        channel, (_, unit) = self.channel, si_factor(self.channel.unit, self.channel.quantity)
        words = channel.name or channel.quantity.replace("_", " ")
        attrs = {"units": unit, "quantity": channel.quantity, "of": channel.target, "sensor": channel.name}
        more = {
            "noise": channel.noise,
            "zero": "unknown" if channel.loose else "known",
            "long_name": f"{words} (column {channel.column!r})",
        }
        clock = ("time", time, {"units": "s", "long_name": "time"})
        return xr.DataArray(si, dims="time", coords={"time": clock}, attrs=attrs | more)

    def signal(self, si: Array) -> CheckedChannel:
        """Return the channel in the form in which warnings are computed."""
        channel, (factor, _) = self.channel, si_factor(self.channel.unit, self.channel.quantity)
        return CheckedChannel(si, channel.column, channel.quantity, channel.unit, factor * channel.factor)


def _pick_samples(spec: RecordingSpec, table: Table, source: str) -> tuple[Array, list[Array], tuple[str, ...]]:
    """Return the time (s) and all channels (n,), and notes on the unit of the time column."""
    names = [channel.column for channel in (*spec.inputs, *spec.sensors)]
    found = {name: table.column(name, source) for name in [*names, *([spec.time] if spec.time else [])]}
    sizes = {name: column.size for name, column in found.items()}
    if len(set(sizes.values())) > 1:
        listed = ", ".join(f"{name!r} {size}" for name, size in sizes.items())
        raise DataError(f"{source}: the columns differ in length ({listed}): name columns recorded together")
    if spec.time:
        time, _, notes = read_time(table, spec.time, spec.time_unit, source)
    else:
        time = np.arange(found[names[0]].size) / _require_rate(spec)
        notes = (*note_repeated_rows(table), *note_other_rate(table, source, _require_rate(spec)))
    return time, [found[name] for name in names], notes


def _require_rate(spec: RecordingSpec) -> float:
    if spec.rate is None or not 0 < spec.rate < np.inf:
        raise DataError(f"{spec.file} has neither time nor a positive rate: give time = 'column' or rate = 1000.0 (Hz)")
    check_step(1.0 / spec.rate, spec.file)
    return spec.rate


def _find_inside(spec: RecordingSpec, time: Array) -> NDArray[np.bool_]:
    """Return which samples lie from `t_start` to `t_end`, both included, with a tolerance for rounding errors."""
    if spec.t_start is None and spec.t_end is None:
        return np.ones(time.size, dtype=bool)
    step = float(np.median(np.diff(time)))  # a date in s is so large that 1e-9 of it may be many steps
    low = -np.inf if spec.t_start is None else spec.t_start - min(1e-9 * (1 + abs(spec.t_start)), 0.4 * step)
    high = np.inf if spec.t_end is None else spec.t_end + min(1e-9 * (1 + abs(spec.t_end)), 0.4 * step)
    inside = (time >= low) & (time <= high)
    if not inside.any():
        raise DataError(
            f"{spec.file} has no samples from t_start to t_end: its time runs from {time[0]:.6g} s "
            f"to {time[-1]:.6g} s; choose both in that range"
        )
    return inside
