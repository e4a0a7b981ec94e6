"""Text files of LabVIEW (`.lvm`): a header of the file, then one or more segments, each with a header and a table.

A header consists of lines of a key and values, and ends with `***End_of_Header***`. The first column of a table is the
time from the beginning of its segment, unless the header says that there is none. Source: National Instruments,
"Specification for the LabVIEW Measurement File (.lvm)".
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.limits import check_numbers
from lostmotion.recording.numbers import Mark, is_missing, read_number
from lostmotion.recording.stamps import Stamps
from lostmotion.recording.table import Table, make_table

Array = NDArray[np.float64]
FIRST = "LabVIEW Measurement"
"""The first words of the file."""
_END = "***End_of_Header***"
_SEPARATORS = {"tab": "\t", "comma": ","}
TIME = "time"
"""The name of the time of a file that names it `X_Value`."""


@dataclass
class _Segment:
    """A segment: its header, the names of its columns, and its rows with their line numbers."""

    header: Mapping[str, list[str]]
    names: list[str]
    rows: list[tuple[int, list[str]]] = field(default_factory=list)


def read_lvm(file: str, lines: Iterator[str]) -> Table:
    """Return the columns (n,) of a file of LabVIEW from the lines below the first, with `time` in s and units.

    Segments follow each other. `DataError` is raised where they have different columns, or where a cell is no number.
    """
    numbered = enumerate((line.rstrip("\r\n") for line in lines), start=2)
    settings, _ = _read_header(file, numbered, "\t")
    separator = _SEPARATORS.get(_value(settings, "Separator", "Tab").lower(), "\t")
    mark: Mark = "comma" if _value(settings, "Decimal_Separator", ".") == "," else "point"
    segments = _read_segments(file, numbered, separator)
    if not segments or not any(segment.rows for segment in segments):
        raise DataError(f"{file} holds no rows below its headers: record or export it again")
    first = segments[0]
    if any(segment.names != first.names for segment in segments):
        raise DataError(f"{file} has segments with different columns: export each segment into a file of its own")
    check_numbers(sum(len(segment.rows) for segment in segments) * len(first.names), file)
    kept = [j for j, name in enumerate(first.names) if name and name != "Comment"]
    columns = {
        first.names[j]: np.array([_read_cell(file, first.names[j], row, j, mark) for s in segments for row in s.rows])
        for j in kept
        if first.names[j] != "X_Value"
    }
    times = [_read_time(file, segment, mark) for segment in segments]
    begun = [_read_start(file, segment, settings) for segment in segments]
    since = [0.0 if start is None or begun[0] is None else start - begun[0] for start in begun]
    if len(segments) > 1 and not all(np.diff(since) > 0.0):
        raise DataError(f"{file} has segments whose times do not follow each other: export each into a file of its own")
    joined = np.concatenate([start + time for start, time in zip(since, times, strict=True)])
    line = first.rows[0][0] if len(segments) == 1 else 0
    return make_table({TIME: joined, **columns}, {TIME: "s", **_find_units(first, kept)}, line=line)


def _value(header: Mapping[str, list[str]], key: str, usual: str) -> str:
    return (header.get(key) or [usual])[0].strip()


def _read_header(
    file: str, lines: Iterator[tuple[int, str]], separator: str
) -> tuple[dict[str, list[str]], tuple[int, str] | None]:
    """Return the entries of a header, and the line of its end; None where the file ends before it."""
    found: dict[str, list[str]] = {}
    for number, line in lines:
        if line.startswith(_END):
            return found, (number, line)
        cells = line.split(separator if separator in line else "\t")
        if cells[0].strip():
            found[cells[0].strip()] = cells[1:]
    if any(name in found for name in ("Channels", "Writer_Version")):
        raise DataError(f"{file} ends within a header, before {_END}: record or export it again")
    return found, None


def _read_segments(file: str, lines: Iterator[tuple[int, str]], separator: str) -> list[_Segment]:
    """Return the segments below the header of the file."""
    segments: list[_Segment] = []
    header, end = _read_header(file, lines, separator)
    while end is not None:
        _, names = next(lines, (0, ""))
        segment = _Segment(header, [name.strip() for name in names.split(separator)])
        segments.append(segment)
        end = None
        for number, line in lines:
            if line.split(separator)[0].strip() == "Channels":
                header, end = _read_header(file, lines, separator)
                break
            if line.strip():
                segment.rows.append((number, line.split(separator)))
    return segments


def _read_cell(file: str, name: str, row: tuple[int, list[str]], column: int, mark: Mark) -> float:
    """Return the number in a cell, NaN where it is empty or lies behind the end of its row."""
    number, cells = row
    cell = cells[column] if column < len(cells) else ""
    value = np.nan if is_missing(cell) else read_number(cell, mark)
    if value is None:
        raise DataError(
            f"{file}, line {number}, column {name!r}: {cell.strip()[:40]!r} is not a number: correct or empty it"
        )
    return float(value)


def _read_time(file: str, segment: _Segment, mark: Mark) -> Array:
    """Return the time (n,) in s from the beginning of a segment: its first column, or the step in its header."""
    if segment.names[0] == "X_Value":
        read = np.array([_read_cell(file, "X_Value", row, 0, mark) for row in segment.rows])
        if np.isfinite(read).all():
            return read
    known = [read_number(_value(segment.header, key, ""), mark) for key in ("X0", "Delta_X")]
    if None in known or not np.isfinite(np.array(known, dtype=float)).all():
        raise DataError(f"{file} has neither a column X_Value nor X0 and Delta_X: export it with its times")
    begin, step = (float(value or 0.0) for value in known)
    return np.asarray(begin + step * np.arange(len(segment.rows)))


def _read_start(file: str, segment: _Segment, settings: Mapping[str, list[str]]) -> float | None:
    """Return the date and the time of day (s) of a segment since 1970; None where there is none."""
    day, clock = (_value(segment.header, key, _value(settings, key, "")).replace(",", ".") for key in ("Date", "Time"))
    whole, _, part = clock.partition(".")
    stamps = Stamps()
    wrong = stamps.add(["1970/01/01 00:00:00", f"{day} {whole}.{(part or '0')[:9]}"], [False, False])
    return None if wrong is not None else float(stamps.finish(file, "Time")[0][1])


def _find_units(segment: _Segment, kept: Sequence[int]) -> dict[str, str]:
    """Return the units of the columns, each of which stands above its column in the header."""
    stated = ["", *(unit.strip() for unit in segment.header.get("Y_Unit_Label", []))]
    return {segment.names[j]: stated[j] for j in kept if j < len(stated) and stated[j]}
