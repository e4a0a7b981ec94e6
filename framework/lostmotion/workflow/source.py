"""What `analyse` is given: the one channel that is looked at, from a case or from a bare recording."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.case import Case
from lostmotion.errors import CaseError, DataError, nearest
from lostmotion.provenance import digest
from lostmotion.recording import load_recording, read_columns
from lostmotion.recording.timing import check_step, check_time
from lostmotion.registry import Registry
from lostmotion.workflow.prepare import case_of

Array = NDArray[np.float64]
TIMES = ("time", "t", "Time", "time_s")
"""Columns that are taken for time in a bare recording."""


@dataclass(frozen=True)
class Wanted:
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


def source_of(path: Path, wanted: Wanted, registry: Registry) -> Source:
    """Return the channel to look at: the response of a case file (.toml), or the column of a bare recording."""
    source = _of_case(case_of(path, registry), wanted) if path.suffix.lower() == ".toml" else _of_file(path, wanted)
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


def _of_case(case: Case, wanted: Wanted) -> Source:
    if not case.recordings:
        raise CaseError(f"{case.title!r} has no [[recordings]]: add one, or analyse a recording by itself")
    names = [spec.label for spec in case.recordings]
    asked = wanted.column
    if asked is not None and asked not in names:
        raise CaseError(f"{case.title!r} has no recording {asked!r}{nearest(asked, names)}: it has {', '.join(names)}")
    chosen = case.recordings[names.index(asked) if asked else 0]
    recording = load_recording(chosen, case.folder)
    notes = list(recording.notes)
    if len(names) > 1 and asked is None:
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
    names = _named(columns, wanted.columns, clock, path.name)
    dt, told = _clocked(columns, clock, wanted, len(columns[names[0]]), path.name)
    notes = list(told)
    pieces = [columns[name][_whole_stretch(columns[name], notes)] for name in names]
    if len(pieces) > 1:
        notes.append(
            f"{len(pieces)} pieces are joined, {', '.join(map(str, sorted({len(p) for p in pieces})))} samples long: "
            "they are taken for one motion whose drive keeps its phase, and what spans a joint is wrong."
        )
    return Source(
        title=path.stem,
        x=np.concatenate(pieces),
        dt=dt,
        unit="",
        label=names[0] if len(names) == 1 else names[0].partition("[")[0],
        excitation=None,
        inputs={path.name: digest(path)},
        notes=tuple(notes),
    )


def _named(columns: dict[str, Array], asked: tuple[str, ...], clock: str | None, source: str) -> tuple[str, ...]:
    """Return the columns that are meant; `name[*]` stands for name[0], name[1], ..."""
    if asked:
        return tuple(found for name in asked for found in _matching(columns, name, source))
    others = [name for name in columns if name != clock]
    if len(others) != 1:
        raise DataError(f"{source} has {len(others)} columns besides time ({_listed(others)}): name one with --column")
    return (others[0],)


def _matching(columns: dict[str, Array], name: str, source: str) -> list[str]:
    stem = name.removesuffix("[*]")
    found = [c for c in columns if c == name or (stem != name and c.startswith(f"{stem}["))]
    if not found:
        raise DataError(f"{source} has no column {name!r}{nearest(name, columns)}: it has {_listed(list(columns))}")
    return found


def _listed(names: list[str], most: int = 12) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return (", ".join(names[:most]) or "none") + more


def _clocked(
    columns: dict[str, Array], clock: str | None, wanted: Wanted, n: int, source: str
) -> tuple[float, tuple[str, ...]]:
    """Return the sampling step (s) and notes on it."""
    if wanted.rate is not None:
        if not 0.0 < wanted.rate < np.inf:
            raise DataError(f"the rate is {wanted.rate:g} Hz: give a positive number")
        return check_step(1.0 / wanted.rate, source), ()
    if clock is None:
        raise DataError(f"{source} has no column 'time': add one in seconds, or give --rate HZ")
    if len(columns[clock]) != n:
        raise DataError(f"{source}: {clock!r} has {len(columns[clock])} values and the column {n}: cut them alike")
    return check_time(columns[clock], source)
