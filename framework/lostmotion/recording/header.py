"""Detection of the header of a text file: the line of names, the line of units, and the separator of the cells.

Loggers often write other lines first. The names are in the first line of text that has as many cells as the rows below
and is followed by a row of numbers, with at most a line of units between them.
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
"""The number of lines among which the line of names is searched."""
LAST = 50
"""The most rows at the end of these lines from which the form of a row of numbers is taken."""

Line = tuple[int, str]
"""A line: index in the file, and text."""


@dataclass(frozen=True)
class Header:
    """The names and units of the columns, the separator of cells (None: blanks), and the line of the first row.

    `trailing` tells that rows end with a separator after the last cell; `stamped` names the columns of time stamps.
    """

    names: list[str]
    units: dict[str, str]
    separator: str | None
    first: int
    trailing: bool
    stamped: frozenset[str]


def find_header(file: str, lines: list[str]) -> Header:
    """Return the header of a table from the first lines of its file; `DataError` if there is none."""
    rows = [(i, line) for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("#")]
    notes = [(i, line) for i, line in enumerate(lines) if line.lstrip().startswith("#")]
    if rows and _has_only_values(rows[0][1]):
        return _read_comment(file, [note for note in notes if note[0] < rows[0][0]], rows)
    if not rows:
        if not notes:
            raise DataError(f"{file} holds only blank lines: record or export it again")
        raise _no_numbers(file)
    return next(_find_candidates(rows), None) or _use_first_line(file, rows)


def _no_numbers(file: str) -> DataError:
    return DataError(f"{file} has a header line and no numbers below it: record or export it again")


def _find_candidates(rows: list[Line]) -> Iterator[Header]:
    """Yield the possible headers with rows of numbers below them, in the order of the file."""
    for k, ((_, line), (_, below)) in enumerate(pairwise(rows)):
        if any(_is_value(cell) for cell in _split_cells(line) if cell.strip().lower() not in MISSING):
            continue
        header = _try_header(line, below, rows[k + 1 :])
        if header is not None:
            yield header


def _try_header(line: str, below: str, rows: list[Line]) -> Header | None:
    """Return the header in a line of text, or None when no table with these names follows."""
    text = line.lstrip("# \t")
    separator = separator_of(text, below)
    names = [name.strip() for name in cells_of(text, separator)]
    units = unit_line(cells_of(below, separator)) if len(cells_of(below, separator)) >= len(names) - 1 else None
    if units is not None and not any(_is_number(cell) for cell in cells_of(below, separator)):
        rows = rows[1:]
    else:
        units = None
    shape = _find_shape(rows, separator, names)
    if shape is None:
        return None
    width, numeric = shape
    first = cells_of(rows[0][1], separator)
    if len(first) < max(numeric) + 1 or not all(_is_value(first[j]) for j in numeric):
        return None
    return _make_header(names, units or [], separator, rows, width)


def _find_shape(rows: list[Line], separator: str | None, names: list[str]) -> tuple[int, list[int]] | None:
    """Return the number of cells in a row and the columns of numbers, from the last rows; None if they do not fit.

    A separator after the last cell adds an empty cell to the row or to the line of names.
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
    """Return whether a column mostly holds numbers or time stamps."""
    filled = [_is_filled(cell) for cell in cells if not _is_missing(cell)]
    return bool(filled) and 2 * sum(filled) > len(filled)


def _make_header(names: list[str], units: Sequence[str], separator: str | None, rows: list[Line], width: int) -> Header:
    """Return the header without an unnamed last column that is empty in the first rows."""
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
    return Header(names, _collect_units(names, units), separator, rows[0][0] + 1, trailing, frozenset(stamped))


def _collect_units(names: list[str], line: Sequence[str]) -> dict[str, str]:
    beside = {name: split_name(name)[1] for name in names}
    below = dict(zip(names, line, strict=False))
    return {name: below.get(name) or beside[name] for name in names if name and (below.get(name) or beside[name])}


def _read_comment(file: str, notes: list[Line], rows: list[Line]) -> Header:
    """Return the header from the last comment line, or from the line before it if the last one holds units."""
    if not notes:
        raise DataError(f"{file} starts with numbers: expected a header line that names the columns, as time,force,x")
    below, texts = rows[0][1], [line.lstrip("# \t") for _, line in notes]
    separator = separator_of(texts[-1], below)
    names, units = [name.strip() for name in cells_of(texts[-1], separator)], None
    above = [name.strip() for name in cells_of(texts[-2], separator)] if len(texts) > 1 else []
    if len(above) == len(names) == len(cells_of(below, separator)):
        units = unit_line(names)
        names = names if units is None else above
    return _make_header(names, units or [], separator, rows, len(cells_of(below, separator)))


def _use_first_line(file: str, rows: list[Line]) -> Header:
    """Return the first line of text as the header; cells below it that do not fit are reported later."""
    text = rows[0][1].lstrip("# \t")
    if len(rows) == 1:
        raise _no_numbers(file)
    separator = separator_of(text, rows[1][1])
    names = [name.strip() for name in cells_of(text, separator)]
    return _make_header(names, [], separator, rows[1:], len(names))


def separator_of(header: str, row: str) -> str | None:
    """Return the separator of the cells of a table; None means blanks."""
    for separator in (";", "\t", ","):
        if separator in header:
            return separator
    return None if len(_split_words(header)) == len(row.split()) else ";"


def cells_of(line: str, separator: str | None) -> list[str]:
    """Return the cells of a line; where blanks separate them, a unit in brackets belongs to the name before it."""
    if separator is None:
        return [cell.strip('"') for cell in _split_words(line)]
    return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])


def _split_words(line: str) -> list[str]:
    words: list[str] = []
    for word in line.split():
        if words and word[0] in "[(" and split_name(f"{words[-1]} {word}")[1]:
            words[-1] += f" {word}"
        else:
            words.append(word)
    return words


def _split_cells(line: str) -> list[str]:
    """Return the cells of a line with an unknown separator."""
    text = line.lstrip("# \t")
    return cells_of(text, next((s for s in (";", "\t", ",") if s in text), None))


def _has_only_values(line: str) -> bool:
    """Return whether a line holds only numbers and time stamps, with any separator."""
    if all(_is_value(cell) for cell in _split_cells(line)):
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
