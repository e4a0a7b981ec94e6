"""One recording, read, checked and in SI units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lostmotion.errors import DataError, nearest
from lostmotion.provenance import digest
from lostmotion.quantities import si_factor
from lostmotion.recording.checks import bridged, check_finite, check_length, check_sensor, check_values, note_stuck
from lostmotion.recording.formats import read_table
from lostmotion.recording.spec import Channel, Hold, RecordingSpec
from lostmotion.recording.table import Table
from lostmotion.recording.timing import EvenClock, check_step, even_clock, resampled
from lostmotion.recording.units import note_unit, seconds, time_unit
from lostmotion.recording.warnings import DoubtedChannel, warnings_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
SHOWN = 12


@dataclass(frozen=True, eq=False)
class Recording:
    """What went in and what came out, in SI units on an even time grid.

    `inputs` (none in a free decay) and `sensors` are arrays (n,) over the dim `time` (s), with the attributes `units`,
    `quantity`, `long_name`, and `of`, the input or channel of a model; those of a sensor have `sensor`, its name, and
    `noise` beside them. NaN in a sensor marks a reading that was not taken; an input has none. `dt` is the sampling
    step (s), `digest` the SHA-256 of the file, `source` its name. `notes` are sentences on what looks odd and was
    accepted; `start` is when it was recorded, where that is known.
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
        """All channels as one dataset: `excitation`, the first input, `response`, the first sensor, and the others.

        Those are called `input 2`, ... and `sensor 2`, ...
        """
        import xarray as xr

        table = _numbered("excitation", "input", self.inputs) | _numbered("response", "sensor", self.sensors)
        return xr.Dataset(table)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what looks odd in the recording and was accepted."""
        return self.notes

    def to_xarray(self) -> xr.Dataset:
        """Return inputs and sensors (n,) in SI units over `time` (s), by their names, with units as attributes."""
        import xarray as xr

        named = {str(a.attrs["of"]): a for a in self.inputs}
        named |= {str(a.attrs["sensor"] or a.attrs["of"]): a for a in self.sensors}
        return xr.Dataset(named, attrs={"title": self.name, "hold": self.hold})

    def plot(self) -> Figure:
        """Return a figure of all inputs and sensors over time, one below the other."""
        from lostmotion.recording.made import drawn

        return drawn(self)

    def __repr__(self) -> str:
        told = [f"{a.attrs['of']} ({a.attrs['units']})" for a in (*self.inputs, *self.sensors)]
        length = f"{self.n} samples at {self.rate:.6g} Hz, {self.n * self.dt:.4g} s"
        return f"<Recording {self.name!r}: {', '.join(told)}; {length}{'; look at .warnings' if self.notes else ''}>"

    @classmethod
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
    ) -> Recording:
        """Return a recording of arrays (n,), by the names that the model has for inputs and channels.

        Give `time` (n,) in s, or in the unit `units["time"]`, or else the `rate` in Hz. `units` has one entry for each
        array, `noise` the kind of noise of a sensor ("white", "ar1", "quantised"). Without inputs it is a free decay.
        Raises `DataError` or `CaseError` where the numbers cannot be used.
        """
        from lostmotion.recording.made import check_units, made

        columns = {**(inputs or {}), **sensors}
        if sensors:
            check_units(units, columns, name)
        times = {} if time is None else {"time": time}
        which = ({name: name for name in inputs or {}}, {name: name for name in sensors})
        return made({**times, **columns}, which, units, None if time is None else "time", rate, noise or {}, hold, name)

    @classmethod
    def from_pandas(
        cls,
        frame: Any,
        *,
        sensors: Mapping[str, str],
        inputs: Mapping[str, str] | None = None,
        units: Mapping[str, str],
        time: str | None = None,
        rate: float | None = None,
        noise: Mapping[str, str] | None = None,
        hold: Hold = "smooth",
        name: str = "recording",
    ) -> Recording:
        """Return a recording of columns of a data frame: `inputs` and `sensors` map names of the model to columns.

        `units` has one entry for each column; that of the time column is s where none is given. Without `time` and
        `rate` the index is the time, in s.
        """
        from lostmotion.recording.made import made

        columns = {str(column): frame[column].to_numpy() for column in frame.columns}
        if time is None and rate is None:
            time = str(frame.index.name or "index")
            columns[time] = frame.index.to_numpy()
        return made(columns, (inputs or {}, sensors), units, time, rate, noise or {}, hold, name)

    @classmethod
    def from_xarray(
        cls,
        dataset: xr.Dataset,
        *,
        sensors: Mapping[str, str],
        inputs: Mapping[str, str] | None = None,
        time: str = "time",
        units: Mapping[str, str] | None = None,
        noise: Mapping[str, str] | None = None,
        hold: Hold = "smooth",
        name: str = "recording",
    ) -> Recording:
        """Return a recording of variables of a dataset, with the units of their attributes where none are given."""
        from lostmotion.recording.made import made

        columns = {str(key): np.asarray(value) for key, value in dataset.variables.items() if value.ndim == 1}
        told = {
            str(key): str(value.attrs["units"]) for key, value in dataset.variables.items() if "units" in value.attrs
        }
        return made(columns, (inputs or {}, sensors), {**told, **(units or {})}, time, None, noise or {}, hold, name)

    @classmethod
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
    ) -> Recording:
        """Return a recording from a file that the command line reads: .csv, .mat, .nc, .uff, ...

        `inputs` and `sensors` map names of the model to columns; `units` are needed for those that the file does not
        tell.
        """
        from lostmotion.recording.made import read

        which = (inputs or {}, sensors)
        return read(Path(path), which, units or {}, time, rate, noise or {}, hold, name)


def _numbered(first: str, more: str, arrays: Sequence[xr.DataArray]) -> dict[str, xr.DataArray]:
    return {f"{more} {i + 1}" if i else first: array for i, array in enumerate(arrays)}


def load_recording(spec: RecordingSpec, folder: Path) -> Recording:
    """Return the recording that `spec` describes, its file taken relative to `folder`; `DataError` if unusable."""
    path = Path(folder) / spec.file
    return recording_of(spec, read_table(path), path.name, digest(path))


def recording_of(spec: RecordingSpec, table: Table, source: str, told_by: str) -> Recording:
    """Return the recording that `spec` describes in a table of columns; `source` names it, `told_by` is its digest."""
    time, values, told = _samples(spec, table, source)
    check_length(time.size, source)
    time, values = _cut(spec, time, values)
    check_length(time.size, source)
    clock = even_clock(time, source) if spec.time else EvenClock(1.0 / _rate(spec), False, (), float(time[0]))
    roles = [("excitation", c) for c in spec.inputs] + [("response", c) for c in spec.sensors]
    channels = [_Read(role, c, spec, source) for role, c in roles]
    read = [channel.on(clock, time, raw) for channel, raw in zip(channels, values, strict=True)]
    count, grid = len(spec.inputs), np.asarray(clock.start + clock.dt * np.arange(time.size))
    arrays = [channel.array(si, grid) for channel, (si, _) in zip(channels, read, strict=True)]
    signals = [channel.signal(si) for channel, (si, _) in zip(channels, read, strict=True)]
    units = [n for c in channels for n in note_unit(c.channel, table.units.get(c.channel.column), c.what)]
    odd = warnings_of(signals[:count], signals[count:], clock.dt)
    notes = dict.fromkeys((*told, *clock.notes, *(n for _, own in read for n in own), *units, *odd))
    inputs, sensors, start = (
        tuple(arrays[:count]),
        tuple(arrays[count:]),
        spec.start or table.starts.get(spec.time or ""),
    )
    return Recording(spec.label, inputs, sensors, clock.dt, told_by, source, spec.hold, tuple(notes), start)


@dataclass(frozen=True)
class _Read:
    """A channel that is read: its role (excitation, response), what a case says of it, and the file."""

    role: str
    channel: Channel
    spec: RecordingSpec
    source: str

    @property
    def what(self) -> str:
        """The channel as messages call it."""
        return f"the {self.role} {self.channel.column!r}"

    def on(self, clock: EvenClock, time: Array, raw: Array) -> tuple[Array, tuple[str, ...]]:
        """Return the channel (n,) in SI units on the even grid of the clock, without lost samples of an input; notes.

        `raw` (n,) was read at `time` (n,) in s.
        """
        check_finite(raw, self.what, self.source)
        if self.role == "excitation":
            values, notes = bridged(raw, self.what, self.source, self.spec.hold)
            even = resampled(time, values, clock, hold=self.spec.hold) if clock.uneven else values
            notes = (*notes, *check_values(even, self.what, self.source, may_miss=False))
            return self._si(even), notes
        even = resampled(time, raw, clock) if clock.uneven else raw
        notes = check_sensor(even, self.what, self.source, dt=clock.dt)
        return self._si(even), (*notes, *note_stuck(even, self.what))

    def _si(self, values: Array) -> Array:
        factor, unit = si_factor(self.channel.unit, self.channel.quantity)
        si = np.asarray(values * (self.channel.factor * factor))
        check_values(si[np.isfinite(si)], f"{self.what} in {unit}", self.source, may_miss=False)
        return si

    def array(self, si: Array, time: Array) -> xr.DataArray:
        """Return the channel (n,) at the times (n,) in s, with what is known of it."""
        import xarray as xr

        channel, (_, unit) = self.channel, si_factor(self.channel.unit, self.channel.quantity)
        words = channel.name or channel.quantity.replace("_", " ")
        attrs = {"units": unit, "quantity": channel.quantity, "of": channel.target, "sensor": channel.name}
        more = {"noise": channel.noise, "long_name": f"{words} (column {channel.column!r})"}
        clock = ("time", time, {"units": "s", "long_name": "time"})
        return xr.DataArray(si, dims="time", coords={"time": clock}, attrs=attrs | more)

    def signal(self, si: Array) -> DoubtedChannel:
        """Return the channel as those see it who doubt it."""
        channel, (factor, _) = self.channel, si_factor(self.channel.unit, self.channel.quantity)
        return DoubtedChannel(si, channel.column, channel.quantity, channel.unit, factor * channel.factor)


def _samples(spec: RecordingSpec, table: Table, source: str) -> tuple[Array, list[Array], tuple[str, ...]]:
    """Return the time (s) and all channels (n,), and notes on the unit of the time column."""
    columns = table.columns
    told: tuple[str, ...] = ()
    names = [channel.column for channel in (*spec.inputs, *spec.sensors)]
    found = {name: _pick(columns, name, source) for name in [*names, *([spec.time] if spec.time else [])]}
    sizes = {name: column.size for name, column in found.items()}
    if len(set(sizes.values())) > 1:
        listed = ", ".join(f"{name!r} {size}" for name, size in sizes.items())
        raise DataError(f"{source}: the columns differ in length ({listed}): name columns recorded together")
    if spec.time:
        unit, told = time_unit(spec.time, table.units.get(spec.time), spec.time_unit)
        time = seconds(found[spec.time], unit, source)
    else:
        time = np.arange(found[names[0]].size) / _rate(spec)
    return time, [found[name] for name in names], told


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
