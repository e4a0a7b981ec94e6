"""The input of `analyse`: one channel, from a case or from a recording file."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.case import CaseFile
from lostmotion.errors import CaseError, DataError, nearest
from lostmotion.preparation.prepare import case_of
from lostmotion.recording import Recording, Table, load_recording, read_table
from lostmotion.recording.clock import FoundTime, find_time
from lostmotion.recording.folders import digest_recording
from lostmotion.recording.time_gaps import cut_at_gaps, cut_table
from lostmotion.recording.timing import GapError, resample_channel
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT, RecordingSettings
from lostmotion_chaos.signals.series import LEAST

Array = NDArray[np.float64]


@dataclass(frozen=True)
class WantedChannel:
    """The requested channel: columns or the name of a recording; the column of time or the rate (Hz), where given.

    Several columns are pieces of one motion and are joined in this order; one sample of `every` is kept.
    """

    columns: tuple[str, ...] = ()
    rate: float | None = None
    every: int = 1
    time: str | None = None

    @property
    def column(self) -> str | None:
        """The one column or recording that was named, or None."""
        if len(self.columns) > 1:
            raise CaseError(f"one recording of a case can be analysed, and {len(self.columns)} were named: name one")
        return self.columns[0] if self.columns else None


@dataclass(frozen=True, eq=False)
class Source:
    """A channel `x` (n,) in `unit`, sampled every `dt` s, and the excitation of the machine, if it was recorded."""

    title: str
    x: Array
    dt: float
    unit: str
    label: str
    excitation: Array | None
    inputs: dict[str, str]
    notes: tuple[str, ...] = ()


def load_source(
    path: Path, wanted: WantedChannel, registry: Registry, limits: RecordingSettings = DEFAULT.recording
) -> Source:
    """Return the channel to analyse: a response of a case file (.toml), or a column of a recording file."""
    is_case = path.suffix.lower() == ".toml"
    source = _load_from_case(case_of(path, registry), wanted, limits) if is_case else _load_from_file(path, wanted)
    if wanted.every == 1:
        return source
    note = f"One sample of {wanted.every} is kept, as requested: higher frequencies are aliased."
    drive = None if source.excitation is None else source.excitation[:: wanted.every]
    return replace(
        source,
        x=source.x[:: wanted.every],
        dt=source.dt * wanted.every,
        excitation=drive,
        notes=(*source.notes, note),
    )


def _load_from_case(case: CaseFile, wanted: WantedChannel, limits: RecordingSettings) -> Source:
    """Return the requested recording and sensor of a case, else the first ones, with a note."""
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
    found = extract_source(recording, sensors.index(asked) if asked in sensors else 0)
    inputs = {"case": case.digest, **found.inputs}
    return replace(found, title=case.title, inputs=inputs, notes=(*found.notes, *notes))


def extract_source(recording: Recording, sensor: int = 0) -> Source:
    """Return one sensor of a recording, by its number, as the channel to analyse: its longest section without gaps."""
    notes, response = list(recording.notes), recording.sensors[sensor]
    every = _find_sampled_rows(np.asarray(response))
    x = np.asarray(response)[every]
    keep = _find_longest_stretch(x, notes)
    _check_missing(x, len(x[keep]))
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


def _find_sampled_rows(x: Array) -> slice:
    """Return the rows of a sensor that has a reading in every k-th row only."""
    taken = np.flatnonzero(np.isfinite(x))
    step = int(np.median(np.diff(taken))) if len(taken) > 1 else 1
    return slice(int(taken[0]), None, step) if step > 1 else slice(None)


def _find_longest_stretch(x: Array, notes: list[str]) -> slice:
    """Return the longest section without a lost sample, and add a note about the rest."""
    lost = ~np.isfinite(x)
    if not lost.any():
        return slice(None)
    edges = np.concatenate([[-1], np.flatnonzero(lost), [len(lost)]])
    longest = int(np.argmax(np.diff(edges)))
    keep = slice(int(edges[longest]) + 1, int(edges[longest + 1]))
    notes.append(
        f"{int(lost.sum())} samples are missing: the longest section without gaps is analysed, "
        f"{keep.stop - keep.start} of {len(x)} samples."
    )
    return keep


def _check_missing(x: Array, kept: int) -> None:
    """Refuse a channel (n,) of which too few samples are kept, because of missing ones."""
    if kept < min(LEAST, len(x)):
        raise DataError(
            f"{len(x) - int(np.isfinite(x).sum())} of {len(x)} samples are missing, and the longest section without"
            f" gaps has {kept} samples: at least {LEAST} are needed; fill short gaps by interpolation first, or record"
            " again"
        )


def _load_from_file(path: Path, wanted: WantedChannel) -> Source:
    """Return the requested columns of a recording file as one channel."""
    table, gaps = read_table(path), list[str]()
    given = None if wanted.rate else wanted.time
    try:
        found = find_time(table, path.name, given, wanted.rate)
    except GapError as err:
        longest = next(iter(cut_at_gaps(err)), None)
        if longest is None:
            raise
        gaps = [
            f"The time has gaps: the longest section without gaps is analysed, {longest.last - longest.first} of"
            f" {err.time.size} samples."
        ]
        table = cut_table(table, longest, err.time.size)
        found = find_time(table, path.name, given)
    names = _choose_columns(table, wanted.columns, found.column, path.name)
    if found.column and table.columns[names[0]].size != found.time.size:
        raise DataError(
            f"{path.name}: {found.column!r} has {found.time.size} values and the column {names[0]!r} "
            f"{table.columns[names[0]].size}: make them equally long"
        )
    unit = table.units.get(names[0], "")
    first = f"{path.name}: {table.columns[names[0]].size} rows at {1.0 / found.clock.dt:.6g} Hz, {found.says}"
    notes = [first, *gaps, *found.notes]
    series = [_resample(table.columns[name], found) for name in names]
    pieces = [values[_find_longest_stretch(values, notes)] for values in series]
    if len(pieces) == 1:
        _check_missing(series[0], len(pieces[0]))
    else:
        notes.append(
            f"{len(pieces)} pieces are joined, {', '.join(map(str, sorted({len(p) for p in pieces})))} samples long: "
            "they are treated as one motion whose drive keeps its phase, and results across a joint are wrong."
        )
    return Source(
        title=path.stem,
        x=np.concatenate(pieces),
        dt=found.clock.dt,
        unit=unit,
        label=names[0] if len(names) == 1 else names[0].partition("[")[0],
        excitation=None,
        inputs={path.name: digest_recording(path)},
        notes=tuple(notes),
    )


def _resample(values: Array, found: FoundTime) -> Array:
    """Return a channel (n,) on the uniform time grid of its recording; infinite values count as missing."""
    uneven = found.clock.uneven and values.size == found.time.size
    return resample_channel(found.time, values, found.clock) if uneven else values


def _choose_columns(table: Table, asked: tuple[str, ...], clock: str | None, source: str) -> tuple[str, ...]:
    """Return the names of the requested columns; `name[*]` means name[0], name[1], ..."""
    if asked:
        return tuple(found for name in asked for found in _match_columns(table, name, source))
    time = table.columns[clock] if clock else None
    others = [name for name in table.full_names if table.columns[name] is not time]
    if len(others) != 1:
        raise DataError(
            f"{source} has {len(others)} columns besides time ({_list_names(others)}): name one with --column"
        )
    return (others[0],)


def _match_columns(table: Table, name: str, source: str) -> list[str]:
    stem = name.removesuffix("[*]")
    found = [c for c in table.columns if c == name or (stem != name and c.startswith(f"{stem}["))]
    if not found and name in table.refused:
        raise DataError(table.refused[name])
    if not found:
        listed = _list_names(list(table.columns))
        raise DataError(f"{source} has no column {name!r}{nearest(name, table.columns)}: it has {listed}")
    return found


def _list_names(names: list[str], most: int = 12) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return (", ".join(names[:most]) or "none") + more
