"""Detection of the header of a text file: the line of names, the line of units, and the separator of the cells.

Loggers often write other lines first. The names are in the first line of text that has as many cells as the rows below
and is followed by a row of numbers, with at most a line of units between them. Lines that begin with `#`, `%` or `//`
are comments, of which the last one above the numbers may hold the names.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from lostmotion.errors import DataError
from lostmotion.recording.cells import (
    SEPARATORS,
    Header,
    Line,
    cells_of,
    is_comment,
    is_filled,
    is_number,
    is_value,
    keep_units,
    separator_of,
    strip_comment,
)
from lostmotion.recording.instruments import read_instrument
from lostmotion.recording.numbers import is_missing
from lostmotion.recording.stamps import is_date, is_stamp
from lostmotion.recording.stated_rate import rates_in_lines
from lostmotion.recording.units import is_unit, split_name, unit_line

UNNAMED = "column 1"
"""The name of a first column of numbers that has none, as pandas and R write the index."""
HEAD = 1000
"""The number of lines among which the line of names is searched."""
TYPE = re.compile(r"u?int\d*|float\d*|double|single|real|number|numeric|decimal|datetime|timestamp|string|bool(ean)?")
"""A word in a line of types."""
LAST = 50
"""The most rows at the end of these lines from which the form of a row of numbers is taken."""

SUMMARY = 20
"""A table of fewer rows, with a blank line and another table below it, is a summary."""


def find_header(file: str, lines: list[str]) -> Header:
    """Return the header of a table from the first lines of its file; `DataError` if there is none."""
    lines = _join_quoted(lines)
    rows = [(i, line) for i, line in enumerate(lines) if line.strip() and not is_comment(line)]
    notes = [(i, line) for i, line in enumerate(lines) if is_comment(line)]
    if not rows:
        raise _no_numbers(file) if notes else DataError(f"{file} holds only blank lines: record or export it again")
    header = read_instrument(rows)
    if header is None and _has_only_values(rows[0][1]):
        header = _read_comment(file, [note for note in notes if note[0] < rows[0][0]], rows)
    elif header is None:
        found = _skip_summary(lines, [*_find_candidates(rows, whole=True)])
        header = found or next(_find_candidates(rows, whole=False), None) or _use_first_line(file, rows)
        header = _with_units_above(header, [line for line in enumerate(lines) if line[0] < header.first - 1])
    return replace(header, rates=rates_in_lines(lines[: header.first - 1]))


def _join_quoted(lines: list[str]) -> list[str]:
    """Return the lines with names that are broken over lines, in quotes, as one line; blank lines take their places."""
    found = list(lines)
    for i, line in enumerate(lines[:LAST]):
        end = next((j for j in range(i + 1, min(i + 6, len(lines))) if lines[j].count('"') % 2), 0)
        if found[i].strip() and line.count('"') % 2 and end:
            found[i] = " ".join(part.strip() for part in lines[i : end + 1])
            found[i + 1 : end + 1] = [""] * (end - i)
    return found


def _skip_summary(lines: list[str], found: list[Header]) -> Header | None:
    """Return the first header that is not followed by a few rows and the header of another table."""
    tables = [*{one.first: one for one in reversed(found)}.values()][::-1]  # not the units below the names
    for one, other in pairwise(tables):
        between = lines[one.first : other.first - 1]
        if other.names == one.names or len(between) > SUMMARY or all(line.strip() for line in between):
            return one
    return tables[-1] if tables else None


def _no_numbers(file: str) -> DataError:
    return DataError(f"{file} has a header line and no numbers below it: record or export it again")


def _find_candidates(rows: list[Line], *, whole: bool) -> Iterator[Header]:
    """Yield the possible headers with rows of numbers below them, in the order of the file.

    Where rows are not `whole`, they may lack their last cells.
    """
    for k, ((_, line), (_, below)) in enumerate(pairwise(rows)):
        filled = [cell for cell in _split_cells(line) if not is_missing(cell)]
        if any(is_value(cell) for cell in filled) and not (filled and _is_unit_line(below, len(filled))):
            continue
        header = _try_header(line, below, rows[k + 1 :], whole)
        if header is not None:
            yield header


def _is_unit_line(line: str, count: int) -> bool:
    """Return whether a line holds so many units and nothing else; the names above it may then be numbers."""
    cells = [cell.strip() for cell in _split_cells(line) if cell.strip()]
    return len(cells) == count > 1 and all(is_unit(cell) for cell in cells)


def _with_units_above(header: Header, above: list[Line]) -> Header:
    """Return the header with units that lines above the rows state, one for each column.

    Such a line is `Vertical Units,V,A` of an oscilloscope, `# units: s, N, mm`, or a line of units above the names.
    """
    units = dict(header.units)
    for cells in (cells_of(strip_comment(line), header.separator) for _, line in above):
        key, stated = cells[0].strip().lower() if cells else "", [cell.strip() for cell in cells[1:]]
        names = number_names(header.names)
        columns = {"horizontal units": names[:1], "vertical units": names[1:]}.get(key.rstrip(":"), [])
        units = keep_units(dict(zip(columns, stated, strict=False))) | units
        line = unit_line(cells) if len(cells) == len(header.names) > 1 else None
        if line and all(not unit or is_unit(unit) for unit in line):
            units = {name: unit for name, unit in zip(names, line, strict=True) if name and unit} | units
    return replace(header, units=units)


def _try_header(line: str, below: str, rows: list[Line], whole: bool) -> Header | None:
    """Return the header in a line of text, or None when no table with these names follows."""
    text = strip_comment(line)
    separator = separator_of(text, below)
    names = [name.strip() for name in cells_of(text, separator)]
    if _names_types(names):
        return None
    if _names_types(cells_of(below, separator)):
        rows, below = rows[1:], rows[1][1] if len(rows) > 1 else ""
    units = unit_line(cells_of(below, separator)) if len(cells_of(below, separator)) >= len(names) - 1 else None
    if units is not None and not any(is_number(cell) for cell in cells_of(below, separator)):
        rows = rows[1:]
        if len(rows) > 1 and not any(is_value(cell) for cell in cells_of(rows[0][1], separator) if cell.strip()):
            rows = rows[1:]  # a line of words below the units, as of Campbell
    else:
        units = None
    shape = _find_shape(rows, separator, names) if whole else _find_short_shape(rows, separator, names)
    if shape is None:
        return None
    width, numeric = shape
    first = cells_of(rows[0][1], separator)
    there = [first[j] for j in numeric if j < len(first)]
    if len(first) <= (max(numeric) if whole else 0) or not all(map(is_value, there)) or not any(map(is_filled, there)):
        return None
    return _make_header(names, units or [], separator, rows, width)


def _names_types(cells: list[str]) -> bool:
    """Return whether a line holds types of numbers, which some programs write below the names."""
    return len(cells) > 1 and all(TYPE.fullmatch(cell.strip()) for cell in cells)


def _find_shape(rows: list[Line], separator: str | None, names: list[str]) -> tuple[int, list[int]] | None:
    """Return the number of cells in a row and the columns of numbers, from the last rows; None if they do not fit.

    A separator after the last cell adds an empty cell to the row or to the line of names.
    """
    split = [cells_of(row, separator) for _, row in rows[-min(LAST, (len(rows) + 1) // 2) :]]
    if len(names) > 1 and names[0] and all(len(cells) == len(names) + 1 and cells[-1].strip() for cells in split):
        names.insert(0, "")  # the names of the rows, which have no name themselves
    for width in (len(names), len(names) + 1, len(names) - (not names[-1:] or not names[-1])):
        fit = [cells for cells in split if len(cells) == width]
        if width > len(names) and any(cells[-1].strip() for cells in fit):
            continue
        numeric = [j for j in range(width) if _is_numeric([cells[j] for cells in fit])]
        if 2 * len(fit) > len(split) and numeric:
            return width, numeric
    return None


def _find_short_shape(rows: list[Line], separator: str | None, names: list[str]) -> tuple[int, list[int]] | None:
    """Return the same for rows that lack their last cells, which are empty; some of them are complete."""
    width, split = len(names), [cells_of(row, separator) for _, row in rows[-LAST:]]
    fit = [cells + [""] * (width - len(cells)) for cells in split if 1 < len(cells) <= width]
    numeric = [j for j in range(width) if _is_numeric([cells[j] for cells in fit])]
    complete = any(len(cells) == width for cells in split)
    return (width, numeric) if separator and complete and 2 * len(fit) > len(split) and 0 in numeric else None


def _is_numeric(cells: list[str]) -> bool:
    """Return whether a column mostly holds numbers or time stamps."""
    filled = [is_filled(cell) for cell in cells if not is_missing(cell)]
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
    if names and not names[0] and any(is_value(cells[0]) and not is_missing(cells[0]) for cells in split[:1]):
        names = [UNNAMED, *names[1:]]
    stamped = {
        name
        for j, name in enumerate(names)
        if name and next((is_stamp(c[j]) for c in split if j < len(c) and not is_missing(c[j])), False)
    }
    dated = _find_dates(split, [names.index(name) for name in stamped])
    return Header(names, _collect_units(names, units), separator, rows[0][0] + 1, trailing, frozenset(stamped), dated)


def _find_dates(rows: list[list[str]], stamped: list[int]) -> int:
    """Return the only column of dates where one column holds times of day without a date; else -1."""
    width = min(map(len, rows), default=0)
    dates = [j for j in range(width) if all(is_date(cells[j]) for cells in rows)]
    bare = len(stamped) == 1 and stamped[0] < width and not any(_has_date(cells[stamped[0]]) for cells in rows)
    return dates[0] if len(dates) == 1 and bare else -1


def _has_date(cell: str) -> bool:
    return is_date(cell.strip().partition(" ")[0].partition("T")[0])


def _collect_units(names: list[str], line: Sequence[str]) -> dict[str, str]:
    below = [*line, *[""] * len(names)]
    found = zip(number_names(names), names, below, strict=False)
    return {key: unit for key, name, own in found if name and (unit := own or split_name(name)[1])}


def number_names(names: Sequence[str]) -> list[str]:
    """Return the names of columns, with a number behind each name that stands there more than once."""
    count: Counter[str] = Counter()
    twice = {name for name, times in Counter(names).items() if name and times > 1}
    found = []
    for name in names:
        count[name] += 1
        found.append(f"{name} {count[name]}" if name in twice else name)
    return found


def _read_comment(file: str, notes: list[Line], rows: list[Line]) -> Header:
    """Return the header from the last comment line, or from the line before it if the last one holds units."""
    if not notes:
        raise DataError(f"{file} starts with numbers: expected a header line that names the columns, as time,force,x")
    below, texts = rows[0][1], [strip_comment(line) for _, line in notes]
    separator = separator_of(texts[-1], below)
    names, units = [name.strip() for name in cells_of(texts[-1], separator)], None
    above = [name.strip() for name in cells_of(texts[-2], separator)] if len(texts) > 1 else []
    if len(above) == len(names) == len(cells_of(below, separator)):
        units = unit_line(names)
        names = names if units is None else above
    return _make_header(names, units or [], separator, rows, len(cells_of(below, separator)))


def _use_first_line(file: str, rows: list[Line]) -> Header:
    """Return the first line of text as the header; cells below it that do not fit are reported later."""
    text = strip_comment(rows[0][1])
    if len(rows) == 1:
        raise _no_numbers(file)
    separator = separator_of(text, rows[1][1])
    names = [name.strip() for name in cells_of(text, separator)]
    return _make_header(names, [], separator, rows[1:], len(names))


def _split_cells(line: str) -> list[str]:
    """Return the cells of a line with an unknown separator."""
    text = strip_comment(line)
    return cells_of(text, next((s for s in SEPARATORS if s in text), None))


def _has_only_values(line: str) -> bool:
    """Return whether a line holds only numbers and time stamps, with any separator."""
    ways = (_split_cells(line), line.replace(";", " ").replace(",", " ").split())
    return any(all(map(is_value, cells)) and any(map(is_filled, cells)) for cells in ways)
