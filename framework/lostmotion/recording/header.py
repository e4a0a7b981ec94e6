"""Where the table begins in a text file: the line of names, the line of units, and what separates the cells.

Loggers write lines about themselves first. The names stand in the first line of text that has as many cells as the
rows below and has a row of numbers under it, with a line of units between them at most.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from lostmotion.errors import DataError
from lostmotion.recording.stamps import is_stamp
from lostmotion.recording.units import split_name, unit_line

MISSING = {"", "nan", "na", "n/a", "null", "none", "-"}
HEAD = 1000
"""Lines among which the names are sought."""
LAST = 50
"""Rows at the end of these lines, at most, that show what a row of numbers looks like."""

Line = tuple[int, str]
"""Index in the file, and text."""


@dataclass(frozen=True)
class Header:
    """The names and units of the columns, what separates the cells (None: blanks), and the line of the first row.

    `trailing` says that rows end with a separator behind the last cell; `stamped` names columns of time stamps.
    """

    names: list[str]
    units: dict[str, str]
    separator: str | None
    first: int
    trailing: bool
    stamped: frozenset[str]


def find_header(file: str, lines: list[str]) -> Header:
    """Return the header of a table by the first lines of its file; `DataError` if there is none."""
    rows = [(i, line) for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("#")]
    notes = [(i, line) for i, line in enumerate(lines) if line.lstrip().startswith("#")]
    if rows and _all_values(rows[0][1]):
        return _in_comment(file, [note for note in notes if note[0] < rows[0][0]], rows)
    if not rows:
        if not notes:
            raise DataError(f"{file} holds only blank lines: record or export it again")
        raise _no_numbers(file)
    return next(_candidates(rows), None) or _first_line(file, rows)


def _no_numbers(file: str) -> DataError:
    return DataError(f"{file} has a header line and no numbers below it: record or export it again")


def _candidates(rows: list[Line]) -> Iterator[Header]:
    """Yield the headers that have rows of numbers below them, the first one first."""
    for k, ((_, line), (_, below)) in enumerate(pairwise(rows)):
        if any(_is_value(cell) for cell in _loose(line) if cell.strip().lower() not in MISSING):
            continue
        header = _taken(line, below, rows[k + 1 :])
        if header is not None:
            yield header


def _taken(line: str, below: str, rows: list[Line]) -> Header | None:
    """Return the header in a line of text, or None when what follows is no table with its names."""
    text = line.lstrip("# \t")
    separator = separator_of(text, below)
    names = [name.strip() for name in cells_of(text, separator)]
    units = unit_line(cells_of(below, separator)) if len(cells_of(below, separator)) >= len(names) - 1 else None
    if units is not None and not any(_is_number(cell) for cell in cells_of(below, separator)):
        rows = rows[1:]
    else:
        units = None
    shape = _shape(rows, separator, names)
    if shape is None:
        return None
    width, numeric = shape
    first = cells_of(rows[0][1], separator)
    if len(first) < max(numeric) + 1 or not all(_is_value(first[j]) for j in numeric):
        return None
    return _header(names, units or [], separator, rows, width)


def _shape(rows: list[Line], separator: str | None, names: list[str]) -> tuple[int, list[int]] | None:
    """Return the cells in a row and the columns that hold numbers, as the last rows show them; None if they do not fit.

    A separator behind the last cell gives the row, or the line of names, one empty cell more.
    """
    split = [cells_of(row, separator) for _, row in rows[-min(LAST, (len(rows) + 1) // 2) :]]
    for width in (len(names), len(names) + 1, len(names) - (not names[-1:] or not names[-1])):
        fit = [cells for cells in split if len(cells) == width]
        if width > len(names) and any(cells[-1].strip() for cells in fit):
            continue
        numeric = [j for j in range(width) if _is_numeric([cells[j] for cells in fit])]
        if 2 * len(fit) > len(split) and numeric:
            return width, numeric
    return None


def _is_numeric(cells: list[str]) -> bool:
    """Return whether a column holds numbers, or time stamps, rather than words."""
    filled = [_is_filled(cell) for cell in cells if not _is_missing(cell)]
    return bool(filled) and 2 * sum(filled) > len(filled)


def _header(names: list[str], units: Sequence[str], separator: str | None, rows: list[Line], width: int) -> Header:
    """Return the header, without an unnamed last column that is empty in the first rows."""
    split = [cells_of(row, separator) for _, row in rows[:LAST]]
    trailing = separator is not None and width == len(names) + 1
    if separator is not None and len(names) > 1 and not names[-1]:
        if width == len(names) - 1:
            names = names[:-1]
        elif all(len(cells) == len(names) and not cells[-1].strip() for cells in split):
            names, trailing = names[:-1], True
    stamped = {
        name
        for j, name in enumerate(names)
        if name and next((is_stamp(c[j]) for c in split if j < len(c) and not _is_missing(c[j])), False)
    }
    return Header(names, _units(names, units), separator, rows[0][0] + 1, trailing, frozenset(stamped))


def _units(names: list[str], line: Sequence[str]) -> dict[str, str]:
    beside = {name: split_name(name)[1] for name in names}
    below = dict(zip(names, line, strict=False))
    return {name: below.get(name) or beside[name] for name in names if name and (below.get(name) or beside[name])}


def _in_comment(file: str, notes: list[Line], rows: list[Line]) -> Header:
    """Return the header in the last comment, or in the one before where the last one holds units."""
    if not notes:
        raise DataError(f"{file} starts with numbers: wanted a header line that names the columns, as time,force,x")
    below, texts = rows[0][1], [line.lstrip("# \t") for _, line in notes]
    separator = separator_of(texts[-1], below)
    names, units = [name.strip() for name in cells_of(texts[-1], separator)], None
    above = [name.strip() for name in cells_of(texts[-2], separator)] if len(texts) > 1 else []
    if len(above) == len(names) == len(cells_of(below, separator)):
        units = unit_line(names)
        names = names if units is None else above
    return _header(names, units or [], separator, rows, len(cells_of(below, separator)))


def _first_line(file: str, rows: list[Line]) -> Header:
    """Return the first line of text as the header: what does not fit below it is told cell by cell."""
    text = rows[0][1].lstrip("# \t")
    if len(rows) == 1:
        raise _no_numbers(file)
    separator = separator_of(text, rows[1][1])
    names = [name.strip() for name in cells_of(text, separator)]
    return _header(names, [], separator, rows[1:], len(names))


def separator_of(header: str, row: str) -> str | None:
    """Return what separates the cells of a table: None stands for blanks."""
    for separator in (";", "\t", ","):
        if separator in header:
            return separator
    return None if len(_words(header)) == len(row.split()) else ";"


def cells_of(line: str, separator: str | None) -> list[str]:
    """Return the cells of a line; between blanks, a unit in brackets belongs to the name before it."""
    if separator is None:
        return [cell.strip('"') for cell in _words(line)]
    return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])


def _words(line: str) -> list[str]:
    words: list[str] = []
    for word in line.split():
        if words and word[0] in "[(" and split_name(f"{words[-1]} {word}")[1]:
            words[-1] += f" {word}"
        else:
            words.append(word)
    return words


def _loose(line: str) -> list[str]:
    """Return the cells of a line of which nothing is known yet."""
    text = line.lstrip("# \t")
    return cells_of(text, next((s for s in (";", "\t", ",") if s in text), None))


def _all_values(line: str) -> bool:
    """Return whether a line holds numbers and time stamps only, whatever separates them."""
    if all(_is_value(cell) for cell in _loose(line)):
        return True
    return all(_is_value(cell) for cell in line.replace(";", " ").replace(",", " ").split())


def _is_missing(cell: str) -> bool:
    return cell.strip().lower() in MISSING


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _is_value(cell: str) -> bool:
    """Return whether a cell is a number, a time stamp or empty."""
    return _is_missing(cell) or _is_filled(cell)


def _is_filled(cell: str) -> bool:
    text = cell.strip().replace(",", ".", 1)
    return not _is_missing(cell) and (_is_number(text) or is_stamp(text))
