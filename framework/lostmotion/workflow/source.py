"""What `analyse` is given: the one channel that is looked at, from a case or from a bare recording."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.case import load_case
from lostmotion.errors import CaseError, DataError, nearest
from lostmotion.provenance import digest
from lostmotion.recording import load_recording, read_columns
from lostmotion.recording.timing import check_time

Array = NDArray[np.float64]
TIMES = ("time", "t", "Time", "time_s")
"""Columns that are taken for time in a bare recording."""


@dataclass(frozen=True)
class Wanted:
    """Which channel is meant: a column or the name of a recording, and the sampling rate (Hz) where no time stands."""

    column: str | None = None
    rate: float | None = None


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


def source_of(path: Path, wanted: Wanted) -> Source:
    """Return the channel to look at: the response of a case file (.toml), or the column of a bare recording."""
    return _of_case(path, wanted) if path.suffix.lower() == ".toml" else _of_file(path, wanted)


def _of_case(path: Path, wanted: Wanted) -> Source:
    case = load_case(path)
    names = [spec.label for spec in case.recordings]
    if wanted.column is not None and wanted.column not in names:
        raise CaseError(
            f"{path.name} has no recording {wanted.column!r}{nearest(wanted.column, names)}: it has {', '.join(names)}"
        )
    chosen = case.recordings[names.index(wanted.column) if wanted.column else 0]
    recording = load_recording(chosen, case.folder)
    notes = list(recording.notes)
    if len(names) > 1 and wanted.column is None:
        notes.append(f"The first of {len(names)} recordings is analysed: name another one with --column.")
    response = recording.data["response"]
    keep = _whole_stretch(np.asarray(response), notes)
    return Source(
        title=case.title,
        x=np.asarray(response)[keep],
        dt=recording.dt,
        unit=str(response.attrs["units"]),
        label=str(response.attrs["quantity"]),
        excitation=np.asarray(recording.data["excitation"])[keep],
        inputs={"case": case.digest, recording.name: recording.digest},
        notes=tuple(notes),
    )


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


def _of_file(path: Path, wanted: Wanted) -> Source:
    columns = read_columns(path)
    clock = next((name for name in TIMES if name in columns), None)
    name = _column(columns, wanted.column, clock, path.name)
    x = columns[name]
    dt, told = _clocked(columns, clock, wanted, len(x), path.name)
    notes = list(told)
    return Source(
        title=path.stem,
        x=x[_whole_stretch(x, notes)],
        dt=dt,
        unit="",
        label=name,
        excitation=None,
        inputs={path.name: digest(path)},
        notes=tuple(notes),
    )


def _column(columns: dict[str, Array], asked: str | None, clock: str | None, source: str) -> str:
    others = [name for name in columns if name != clock]
    if asked is not None:
        if asked not in columns:
            raise DataError(f"{source} has no column {asked!r}{nearest(asked, columns)}: it has {', '.join(columns)}")
        return asked
    if len(others) != 1:
        raise DataError(
            f"{source} has {len(others)} columns besides time ({', '.join(others) or 'none'}): name one with --column"
        )
    return others[0]


def _clocked(
    columns: dict[str, Array], clock: str | None, wanted: Wanted, n: int, source: str
) -> tuple[float, tuple[str, ...]]:
    """Return the sampling step (s) and notes on it."""
    if wanted.rate is not None:
        if not 0.0 < wanted.rate < np.inf:
            raise DataError(f"the rate is {wanted.rate:g} Hz: give a positive number")
        return 1.0 / wanted.rate, ()
    if clock is None:
        raise DataError(f"{source} has no column 'time': add one in seconds, or give --rate HZ")
    if len(columns[clock]) != n:
        raise DataError(f"{source}: {clock!r} has {len(columns[clock])} values and the column {n}: cut them alike")
    return check_time(columns[clock], source)
