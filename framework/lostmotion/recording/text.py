"""Columns of a text file: a header line, then numbers between commas, semicolons, tabs or blanks.

The file is read line by line, twice or three times, so that memory is spent on its numbers and on little else.
"""

from __future__ import annotations

import codecs
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.header import HEAD, MISSING, Header, cells_of, find_header
from lostmotion.recording.limits import check_columns, check_line, check_numbers
from lostmotion.recording.stamps import Stamps
from lostmotion.recording.table import Table, with_bare_names

Array = NDArray[np.float64]
Commas = Literal["none", "all", "quoted"]
"""Which commas below the header are decimal ones."""
MISSPELT = re.compile(r"[+-]?\d[\d.,' ]*([eE][+-]?\d+)?")
"""A cell that was meant to be a number, with separators of thousands perhaps, and not a word or a date."""
AT_ONCE = 4096
"""Lines that are held as text at one time, where each cell is looked at."""
_BLOCK = 1 << 20
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_QUOTED = re.compile(r'"([^",]*),([^",]*)"')
"""A quoted cell with one comma."""
_DECIMAL = re.compile(r"\s*[+-]?\d*,\d+([eE][+-]?\d+)?\s*|.*\d:\d\d,\d+.*")
_THOUSANDS = re.compile(r"\s*[+-]?[1-9]\d{0,2},\d{3}\s*")
"""A number with one comma that may separate thousands as well."""


@dataclass(frozen=True)
class _Text:
    """A text file taken apart."""

    path: Path
    encoding: str
    header: Header
    commas: Commas

    @contextmanager
    def rows(self) -> Iterator[Iterator[str]]:
        """Yield the lines below the header, with decimal points."""
        with self.path.open(encoding=self.encoding) as stream:
            below: Iterator[str] = islice(stream, self.header.first - 1, None)
            if self.commas == "all":
                below = (line.replace(",", ".") for line in below)
            elif self.commas == "quoted":
                below = (_QUOTED.sub(r"\1.\2", line) for line in below)
            yield below


@dataclass
class _Column:
    """What is known of one column so far: its values, the first cell that is no number, whether one was meant."""

    name: str
    stamps: Stamps | None = None
    parts: list[Array] = field(default_factory=list)
    wrong: tuple[int, str] | None = None
    meant: bool = False
    numbers: bool = False

    def add(self, lines: list[int], cells: Sequence[str]) -> None:
        """Take in the cells that stand in some lines of the file."""
        if self.stamps is not None:
            self._add_stamps(self.stamps, lines, cells)
            return
        try:
            values = np.array(list(map(float, cells)))
        except ValueError:
            values = self._each(lines, cells)
        self.numbers = self.numbers or bool(np.isfinite(values).any() or np.isinf(values).any())
        self.parts.append(values)

    def _each(self, lines: list[int], cells: Sequence[str]) -> Array:
        values = np.empty(len(lines))
        for k, cell in enumerate(cells):
            value = _number(cell)
            values[k] = np.nan if value is None else value
            if value is None:
                self.wrong = self.wrong or (lines[k], cell.strip())
                self.meant = self.meant or bool(MISSPELT.fullmatch(cell.strip()))
        return values

    def _add_stamps(self, stamps: Stamps, lines: list[int], cells: Sequence[str]) -> None:
        lost = [cell.strip().lower() in MISSING for cell in cells]
        wrong = stamps.add(cells, lost)
        if wrong is not None and self.wrong is None:
            self.wrong = lines[wrong], cells[wrong].strip()

    def settled(self, file: str) -> tuple[Array, str] | None:
        """Return the column (n,) and its first time stamp; None when it is a column of words, which is left out."""
        if self.wrong and not (self.stamps or self.meant or self.numbers):
            return None
        if self.wrong:
            line, cell = self.wrong
            hint = "write decimal points" if re.fullmatch(r"[+-]?\d+,\d+", cell) else "correct or empty it"
            kind = "time stamp like those above it" if self.stamps else "number"
            raise DataError(f"{file}, line {line}, column {self.name!r}: {cell[:40]!r} is not a {kind}: {hint}")
        return self.stamps.settled(file, self.name) if self.stamps else (np.concatenate(self.parts), "")


def read_text(path: Path) -> Table:
    """Return the columns of a text file by the names in its header line, each (n,); empty cells are NaN.

    Comma, semicolon, tab or blank separate the cells; with any but the comma, a decimal comma is understood, and
    with the comma one within quotes. Columns of time stamps are in seconds from the first one.
    """
    text = _opened(path)
    found = _fast(text)
    columns, starts = _careful(text) if found is None else (found, {})
    units = {name: unit for name, unit in text.header.units.items() if name in columns}
    return with_bare_names(columns, units | dict.fromkeys(starts, "s"), starts)


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


def _opened(path: Path) -> _Text:
    encoding = _encoding(path)
    with path.open(encoding=encoding) as stream:
        header = find_header(path.name, list(_checked(path.name, islice(stream, HEAD))))
    with path.open(encoding=encoding) as stream:
        below = _checked(path.name, islice(stream, header.first - 1, None))
        lines, commas = _scanned(below, header.separator)
    check_columns(len(header.names), path.name)
    check_numbers(lines * len(header.names), path.name)
    _check_names(path.name, header.names)
    return _Text(path, encoding, header, commas)


def _checked(file: str, lines: Iterator[str]) -> Iterator[str]:
    for line in lines:
        check_line(len(line), file)
        yield line


def _scanned(lines: Iterator[str], separator: str | None) -> tuple[int, Commas]:
    """Return how many lines there are, and which commas in them are decimal ones.

    Between commas, `"1,234"` may be a thousand and more: quoted commas are decimal ones only where some cell shows it.
    """
    count, commas, shown, spoilt = 0, False, False, False
    for line in lines:
        count += 1
        commas = commas or "," in line
        if separator == "," and '"' in line and not spoilt:
            cells = [f"{left},{right}" for left, right in _QUOTED.findall(line)]
            shown = shown or any(_DECIMAL.fullmatch(cell) and not _THOUSANDS.fullmatch(cell) for cell in cells)
            spoilt = any("." in cell and _THOUSANDS.match(cell) for cell in cells)
    if separator != ",":
        return count, "all" if commas else "none"
    return count, "quoted" if shown and not spoilt else "none"


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


def _fast(text: _Text) -> dict[str, Array] | None:
    """Return the columns of a file with nothing but numbers, or None: then each cell is looked at."""
    header = text.header
    if header.stamped or "" in header.names:
        return None
    try:
        with text.rows() as rows:
            lines = (_trimmed(row, header.separator) for row in rows) if header.trailing else rows
            numbers = np.loadtxt(lines, delimiter=header.separator, comments=None, ndmin=2, quotechar='"')
    except ValueError:
        return None
    if numbers.shape[1] != len(header.names):
        return None
    return {name: np.ascontiguousarray(column) for name, column in zip(header.names, numbers.T, strict=True)}


def _trimmed(row: str, separator: str | None) -> str:
    """Return a row without the separator behind its last cell."""
    return row.rstrip("\r\n ").removesuffix(separator or "")


def _careful(text: _Text) -> tuple[dict[str, Array], dict[str, str]]:
    """Return the columns, and the first time stamp of those that hold time stamps."""
    columns = [_Column(name, Stamps() if name in text.header.stamped else None) for name in text.header.names]
    with text.rows() as rows:
        filled = ((text.header.first + i, row) for i, row in enumerate(rows) if row.strip())
        while block := list(islice(filled, AT_ONCE)):
            _take(text, columns, block)
    found = {column.name: both for column in columns if column.name and (both := column.settled(text.path.name))}
    return {name: values for name, (values, _) in found.items()}, {
        name: start for name, (_, start) in found.items() if start
    }


def _take(text: _Text, columns: list[_Column], block: list[tuple[int, str]]) -> None:
    """Share the cells of some lines out among the columns."""
    numbers = [number for number, _ in block]
    rows = [_row(text, number, row) for number, row in block]
    for column, cells in zip(columns, zip(*rows, strict=True), strict=True):
        if column.name:
            column.add(numbers, cells)


def _row(text: _Text, number: int, line: str) -> list[str]:
    """Return the cells of a row, one for each column; `DataError` if it has more or fewer."""
    header, cells = text.header, cells_of(line, text.header.separator)
    wanted, got = len(header.names), len(cells)
    if wanted == got:
        return cells
    if header.trailing and got == wanted + 1 and not cells[-1].strip():
        return cells[:-1]
    hint = "complete or remove the line"
    if header.separator == "," and got > wanted and all(re.fullmatch(r"[+-]?\d+", cell.strip()) for cell in cells):
        hint = "these look like decimal commas; separate the columns by ';' or write decimal points"
    name = text.path.name
    raise DataError(f"{name}, line {number}: {got} cells where the header names {wanted} columns: {hint}")
