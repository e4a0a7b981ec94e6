"""What `analyse` is given: the one channel that is looked at, from a case or from a bare recording."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.case import CaseFile
from lostmotion.errors import CaseError, DataError, nearest
from lostmotion.preparation.prepare import case_of
from lostmotion.provenance import digest
from lostmotion.recording import Recording, Table, load_recording, read_table
from lostmotion.recording.timing import EvenClock, check_step, even_clock, resample_channel
from lostmotion.recording.units import seconds, time_unit
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT, RecordingSettings

Array = NDArray[np.float64]
TIMES = ("time", "t", "Time", "time_s")
"""Columns that are taken for time in a bare recording."""


@dataclass(frozen=True)
class WantedChannel:
    """Which channel is meant: columns or the name of a recording; the rate (Hz) where there is no time; one in `every`.

    Several columns are pieces of one motion, and joined in their order; one sample in `every` is kept.
    """

    columns: tuple[str, ...] = ()
    rate: float | None = None
    every: int = 1

    @property
    def column(self) -> str | None:
        """The one column or recording that was named, if one was."""
        if len(self.columns) > 1:
            raise CaseError(f"a case gives one recording at a time, and {len(self.columns)} were named: name one")
        return self.columns[0] if self.columns else None


@dataclass(frozen=True, eq=False)
class Source:
    """A channel `x` (n,) in `unit`, sampled every `dt` s, and what drove the machine, if that was recorded."""

    title: str
    x: Array
    dt: float
    unit: str
    label: str
    excitation: Array | None
    inputs: dict[str, str]
    notes: tuple[str, ...] = ()


def source_of(
    path: Path, wanted: WantedChannel, registry: Registry, limits: RecordingSettings = DEFAULT.recording
) -> Source:
    """Return the channel to look at: the response of a case file (.toml), or the column of a bare recording."""
    is_case = path.suffix.lower() == ".toml"
    source = _of_case(case_of(path, registry), wanted, limits) if is_case else _of_file(path, wanted)
    if wanted.every == 1:
        return source
    note = f"One sample of {wanted.every} is kept, as asked: what is faster than that folds back."
    drive = None if source.excitation is None else source.excitation[:: wanted.every]
    return replace(
        source,
        x=source.x[:: wanted.every],
        dt=source.dt * wanted.every,
        excitation=drive,
        notes=(*source.notes, note),
    )


def _of_case(case: CaseFile, wanted: WantedChannel, limits: RecordingSettings) -> Source:
    if not case.recordings:
        raise CaseError(f"{case.title!r} has no [[recordings]]: add one, or analyse a recording by itself")
    names, asked = [spec.label for spec in case.recordings], wanted.column
    sensors = [sensor.name for sensor in case.recordings[0].sensors if sensor.name]
    if asked is not None and asked not in (*names, *sensors):
        known = [*names, *sensors]
        raise CaseError(
            f"{case.title!r} has no recording or sensor {asked!r}{nearest(asked, known)}: it has {', '.join(known)}"
        )
    chosen = case.recordings[names.index(asked) if asked in names else 0]
    notes = []
    if len(names) > 1 and asked not in names:
        notes.append(f"The first of {len(names)} recordings is analysed: name another one with --column.")
    if len(sensors) > 1 and asked not in sensors:
        notes.append(f"The first of {len(sensors)} sensors is analysed: name another one with --column.")
    recording = load_recording(chosen, case.folder, limits)
    found = source_in(recording, sensors.index(asked) if asked in sensors else 0)
    inputs = {"case": case.digest, **found.inputs}
    return replace(found, title=case.title, inputs=inputs, notes=(*found.notes, *notes))


def source_in(recording: Recording, sensor: int = 0) -> Source:
    """Return one sensor of a recording, by its number, as the channel to look at: its longest stretch without a gap."""
    notes, response = list(recording.notes), recording.sensors[sensor]
    every = _paced(np.asarray(response))
    x = np.asarray(response)[every]
    keep = _whole_stretch(x, notes)
    return Source(
        title=recording.name,
        x=x[keep],
        dt=recording.dt * (every.step or 1),
        unit=str(response.attrs["units"]),
        label=str(response.attrs["quantity"]),
        excitation=np.asarray(recording.inputs[0])[every][keep] if recording.inputs else None,
        inputs={recording.name: recording.digest},
        notes=tuple(notes),
    )


def _paced(x: Array) -> slice:
    """Return which samples are those of a sensor that is read in every k-th row."""
    taken = np.flatnonzero(np.isfinite(x))
    step = int(np.median(np.diff(taken))) if len(taken) > 1 else 1
    return slice(int(taken[0]), None, step) if step > 1 else slice(None)


def _whole_stretch(x: Array, notes: list[str]) -> slice:
    """Return the longest stretch without a lost sample; a note says what was left aside."""
    lost = ~np.isfinite(x)
    if not lost.any():
        return slice(None)
    edges = np.concatenate([[-1], np.flatnonzero(lost), [len(lost)]])
    longest = int(np.argmax(np.diff(edges)))
    keep = slice(int(edges[longest]) + 1, int(edges[longest + 1]))
    notes.append(
        f"{int(lost.sum())} samples were lost: the longest stretch without a gap is analysed, "
        f"{keep.stop - keep.start} of {len(x)} samples."
    )
    return keep


def _of_file(path: Path, wanted: WantedChannel) -> Source:
    table = read_table(path)
    column = next((name for name in TIMES if name in table.columns), None)
    names = _named(table, wanted.columns, column, path.name)
    clock, time = _clocked(table, column, wanted, len(table.columns[names[0]]), path.name)
    notes = list(clock.notes)
    series = [_even(table.columns[name], clock, time) for name in names]
    pieces = [values[_whole_stretch(values, notes)] for values in series]
    if len(pieces) > 1:
        notes.append(
            f"{len(pieces)} pieces are joined, {', '.join(map(str, sorted({len(p) for p in pieces})))} samples long: "
            "they are taken for one motion whose drive keeps its phase, and what spans a joint is wrong."
        )
    return Source(
        title=path.stem,
        x=np.concatenate(pieces),
        dt=clock.dt,
        unit="",
        label=names[0] if len(names) == 1 else names[0].partition("[")[0],
        excitation=None,
        inputs={path.name: digest(path)},
        notes=tuple(notes),
    )


def _even(values: Array, clock: EvenClock, time: Array) -> Array:
    """Return a channel (n,) on the even grid of its recording; values that are infinite count as lost."""
    return resample_channel(time, values, clock) if clock.uneven and values.size == time.size else values


def _named(table: Table, asked: tuple[str, ...], clock: str | None, source: str) -> tuple[str, ...]:
    """Return the columns that are meant; `name[*]` stands for name[0], name[1], ..."""
    if asked:
        return tuple(found for name in asked for found in _matching(table.columns, name, source))
    time = table.columns[clock] if clock else None
    others = [name for name in table.full_names if table.columns[name] is not time]
    if len(others) != 1:
        raise DataError(f"{source} has {len(others)} columns besides time ({_listed(others)}): name one with --column")
    return (others[0],)


def _matching(columns: Mapping[str, Array], name: str, source: str) -> list[str]:
    stem = name.removesuffix("[*]")
    found = [c for c in columns if c == name or (stem != name and c.startswith(f"{stem}["))]
    if not found:
        raise DataError(f"{source} has no column {name!r}{nearest(name, columns)}: it has {_listed(list(columns))}")
    return found


def _listed(names: list[str], most: int = 12) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return (", ".join(names[:most]) or "none") + more


def _clocked(table: Table, column: str | None, wanted: WantedChannel, n: int, source: str) -> tuple[EvenClock, Array]:
    """Return the even grid of the recording and its time column (s), which is empty where a rate was given."""
    if wanted.rate is not None:
        if not 0.0 < wanted.rate < np.inf:
            raise DataError(f"the rate is {wanted.rate:g} Hz: give a positive number")
        return EvenClock(check_step(1.0 / wanted.rate, source), False, (), 0.0), np.empty(0)
    if column is None:
        raise DataError(f"{source} has no column 'time': add one in seconds, or give --rate HZ")
    if len(table.columns[column]) != n:
        found = len(table.columns[column])
        raise DataError(f"{source}: {column!r} has {found} values and the column {n}: cut them alike")
    unit, told = time_unit(column, table.units.get(column), None)
    time = seconds(table.columns[column], unit, source)
    clock = even_clock(time, source)
    return replace(clock, notes=(*told, *clock.notes)), time
