"""Columns of a text file: a header line, then numbers between commas, semicolons, tabs or blanks.

The file is read line by line, twice or three times, so that memory is spent on its numbers and on little else.
"""

from __future__ import annotations

import codecs
import csv
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.limits import check_columns, check_line, check_numbers

Array = NDArray[np.float64]
MISSPELT = re.compile(r"[+-]?\d[\d.,' ]*([eE][+-]?\d+)?")
"""A cell that was meant to be a number, with separators of thousands perhaps, and not a word or a date."""
MISSING = {"", "nan", "na", "n/a", "null", "none", "-"}
AT_ONCE = 4096
"""Lines that are held as text at one time, where each cell is looked at."""
_BLOCK = 1 << 20
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")


@dataclass(frozen=True)
class _Table:
    """A text file taken apart: the numbers begin at line `first`; `commas` are decimal ones."""

    path: Path
    encoding: str
    names: list[str]
    separator: str | None
    commas: bool
    first: int

    @contextmanager
    def rows(self) -> Iterator[Iterator[str]]:
        """Yield the lines below the header, with decimal points."""
        with self.path.open(encoding=self.encoding) as stream:
            below = islice(stream, self.first - 1, None)
            yield (line.replace(",", ".") for line in below) if self.commas else below


@dataclass
class _Column:
    """What is known of one column so far: its values, the first cell that is no number, whether one was meant."""

    name: str
    parts: list[Array] = field(default_factory=list)
    wrong: tuple[int, str] | None = None
    meant: bool = False
    numbers: bool = False

    def add(self, lines: list[int], cells: Iterable[str]) -> None:
        """Take in the cells that stand in some lines of the file."""
        values = np.empty(len(lines))
        for k, cell in enumerate(cells):
            value = _number(cell)
            values[k] = np.nan if value is None else value
            if value is None:
                self.wrong = self.wrong or (lines[k], cell.strip())
                self.meant = self.meant or bool(MISSPELT.fullmatch(cell.strip()))
        self.numbers = self.numbers or bool(np.isfinite(values).any() or np.isinf(values).any())
        self.parts.append(values)

    def rounded(self, file: str) -> Array | None:
        """Return the column (n,), or None when none of its cells is a number: a column of words is left out."""
        if self.wrong and not self.meant and not self.numbers:
            return None
        if self.wrong:
            line, cell = self.wrong
            hint = "write decimal points" if re.fullmatch(r"[+-]?\d+,\d+", cell) else "correct or empty it"
            raise DataError(f"{file}, line {line}, column {self.name!r}: {cell[:40]!r} is not a number: {hint}")
        return np.concatenate(self.parts)


def read_text(path: Path) -> dict[str, Array]:
    """Return the columns of a text file by the names in its header line, each (n,); empty cells are NaN.

    Comma, semicolon, tab or blank separate the cells; with any but the comma, a decimal comma is understood.
    """
    table = _table(path)
    found = _fast(table)
    return _careful(table) if found is None else found


def _encoding(path: Path) -> str:
    """Return the encoding of a text: UTF-16 with its mark, UTF-8 if it is valid, else Latin-1."""
    with path.open("rb") as raw:
        head = raw.read(4096)
        if head.startswith(_UTF_16):
            return "utf-16"
        if any(byte < 32 and byte not in b"\t\n\r\f" for byte in head):
            raise DataError(f"{path.name} is not text: give the file its true ending, or export the recording as csv")
        raw.seek(0)
        decoder = codecs.getincrementaldecoder("utf-8")()
        try:
            while block := raw.read(_BLOCK):
                decoder.decode(block)
            decoder.decode(b"", final=True)
        except UnicodeDecodeError:
            return "latin-1"
    return "utf-8-sig"


def _table(path: Path) -> _Table:
    encoding = _encoding(path)
    with path.open(encoding=encoding) as stream:
        top, line, held = _header_line(path.name, stream)
        below = held or next((row for row in stream if row.strip()), "")
        check_line(len(below), path.name)
        lines, commas = 1, "," in below
        for row in stream:
            check_line(len(row), path.name)
            lines += 1
            commas = commas or "," in row
    header = line.lstrip("# \t")
    separator = _separator(header, below)
    names = [name.strip() for name in _cells(header, separator)]
    if not below:
        raise DataError(f"{path.name} has a header line and no numbers below it: record or export it again")
    check_columns(len(names), path.name)
    check_numbers(lines * len(names), path.name)
    _check_names(path.name, names)
    return _Table(path, encoding, names, separator, commas and separator != ",", top + 2)


def _header_line(file: str, lines: Iterable[str]) -> tuple[int, str, str]:
    """Return index and text of the header, and the line of numbers where one had to be read to know.

    The header is the first line that is no comment, or the last comment if numbers follow it.
    """
    comment: tuple[int, str] | None = None
    for i, line in enumerate(lines):
        check_line(len(line), file)
        if line.lstrip().startswith("#"):
            comment = i, line
        elif line.strip():
            if not _all_numbers(line):
                return i, line, ""
            if comment is None:
                raise DataError(
                    f"{file} starts with numbers: wanted a header line that names the columns, as time,force,x"
                )
            return *comment, line
    if comment is None:
        raise DataError(f"{file} holds only blank lines: record or export it again")
    return *comment, ""


def _separator(header: str, row: str) -> str | None:
    for separator in (";", "\t", ","):
        if separator in header:
            return separator
    return None if len(header.split()) == len(row.split()) else ";"


def _cells(line: str, separator: str | None) -> list[str]:
    if separator is None:
        return [cell.strip('"') for cell in line.split()]
    return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])


def _all_numbers(line: str) -> bool:
    return all(_number(cell) is not None for cell in line.replace(";", " ").replace(",", " ").split())


def _check_names(file: str, names: list[str]) -> None:
    twice = sorted(name for name, count in Counter(names).items() if name and count > 1)
    if twice:
        raise DataError(f"{file} has two columns named {twice[0]!r}: give each column its own name")


def _number(cell: str) -> float | None:
    word = cell.strip()
    try:
        return float("nan") if word.lower() in MISSING else float(word)
    except ValueError:
        return None


def _fast(table: _Table) -> dict[str, Array] | None:
    """Return the columns of a file with nothing but numbers, or None: then each cell is looked at."""
    try:
        with table.rows() as rows:
            numbers = np.loadtxt(rows, delimiter=table.separator, comments=None, ndmin=2, quotechar='"')
    except ValueError:
        return None
    if numbers.shape[1] != len(table.names) or "" in table.names:
        return None
    return {name: np.ascontiguousarray(column) for name, column in zip(table.names, numbers.T, strict=True)}


def _careful(table: _Table) -> dict[str, Array]:
    columns = [_Column(name) for name in table.names]
    with table.rows() as rows:
        filled = ((table.first + i, row) for i, row in enumerate(rows) if row.strip())
        while block := list(islice(filled, AT_ONCE)):
            _take(table, columns, block)
    settled = ((c.name, c.rounded(table.path.name)) for c in columns if c.name)
    return {name: found for name, found in settled if found is not None}


def _take(table: _Table, columns: list[_Column], block: list[tuple[int, str]]) -> None:
    """Share the cells of some lines out among the columns."""
    rows = [_cells(row, table.separator) for _, row in block]
    numbers = [number for number, _ in block]
    for number, cells in zip(numbers, rows, strict=True):
        _check_width(table, number, cells)
    for column, cells_of in zip(columns, zip(*rows, strict=True), strict=True):
        if column.name:
            column.add(numbers, cells_of)


def _check_width(table: _Table, number: int, cells: list[str]) -> None:
    wanted, got = len(table.names), len(cells)
    if wanted == got:
        return
    hint = "complete or remove the line"
    if table.separator == "," and got > wanted and all(re.fullmatch(r"[+-]?\d+", cell.strip()) for cell in cells):
        hint = "these look like decimal commas; separate the columns by ';' or write decimal points"
    name = table.path.name
    raise DataError(f"{name}, line {number}: {got} cells where the header names {wanted} columns: {hint}")
