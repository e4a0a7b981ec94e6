"""Columns of a text file: a header line, then numbers separated by commas, semicolons, tabs or blanks.

The file is read line by line, two or three times, so that little more memory is used than for the numbers.
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
"""Which commas below the header are decimal commas."""
MISSPELT = re.compile(r"[+-]?\d[\d.,' ]*([eE][+-]?\d+)?")
"""A cell that looks like a number, perhaps with thousands separators, and not like a word or a date."""
AT_ONCE = 4096
"""Lines that are processed at once where each cell is parsed separately."""
_BLOCK = 1 << 20
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_QUOTED = re.compile(r'"([^",]*),([^",]*)"')
"""A quoted cell with one comma."""
_DECIMAL = re.compile(r"\s*[+-]?\d*,\d+([eE][+-]?\d+)?\s*|.*\d:\d\d,\d+.*")
_THOUSANDS = re.compile(r"\s*[+-]?[1-9]\d{0,2},\d{3}\s*")
"""A number with one comma that may be a thousands separator."""


@dataclass(frozen=True)
class _Text:
    """A text file with its encoding, header and decimal commas."""

    path: Path
    encoding: str
    header: Header
    commas: Commas

    @contextmanager
    def rows(self) -> Iterator[Iterator[str]]:
        """Yield the lines below the header, with decimal commas replaced by points."""
        with self.path.open(encoding=self.encoding) as stream:
            below: Iterator[str] = islice(stream, self.header.first - 1, None)
            if self.commas == "all":
                below = (line.replace(",", ".") for line in below)
            elif self.commas == "quoted":
                below = (_QUOTED.sub(r"\1.\2", line) for line in below)
            yield below


@dataclass
class _Column:
    """One column while it is read: its values, and the first cell that is not a number.

    `meant` tells that such a cell looks like a number, `numbers` that the column holds any numbers.
    """

    name: str
    stamps: Stamps | None = None
    parts: list[Array] = field(default_factory=list)
    wrong: tuple[int, str] | None = None
    meant: bool = False
    numbers: bool = False

    def add(self, lines: list[int], cells: Sequence[str]) -> None:
        """Add the cells of some lines of the file."""
        if self.stamps is not None:
            self._add_stamps(self.stamps, lines, cells)
            return
        try:
            values = np.array(list(map(float, cells)))
        except ValueError:
            values = self._parse_cells(lines, cells)
        self.numbers = self.numbers or bool(np.isfinite(values).any() or np.isinf(values).any())
        self.parts.append(values)

    def _parse_cells(self, lines: list[int], cells: Sequence[str]) -> Array:
        values = np.empty(len(lines))
        for k, cell in enumerate(cells):
            value = _parse_number(cell)
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

    def finish(self, file: str) -> tuple[Array, str] | None:
        """Return the column (n,) and its first time stamp; None for a column of words, which is left out."""
        if self.wrong and not (self.stamps or self.meant or self.numbers):
            return None
        if self.wrong:
            line, cell = self.wrong
            hint = "write decimal points" if re.fullmatch(r"[+-]?\d+,\d+", cell) else "correct or empty it"
            kind = "time stamp like those above it" if self.stamps else "number"
            raise DataError(f"{file}, line {line}, column {self.name!r}: {cell[:40]!r} is not a {kind}: {hint}")
        return self.stamps.finish(file, self.name) if self.stamps else (np.concatenate(self.parts), "")


def read_text(path: Path) -> Table:
    """Return the columns of a text file by the names in its header line, each (n,); empty cells are NaN.

    Cells are separated by commas, semicolons, tabs or blanks. Decimal commas are read too; where commas separate the
    cells, only within quotes. Columns of time stamps are in seconds from the first stamp.
    """
    text = _open_text(path)
    found = _read_numbers(text)
    columns, starts = _read_cells(text) if found is None else (found, {})
    units = {name: unit for name, unit in text.header.units.items() if name in columns}
    return with_bare_names(columns, units | dict.fromkeys(starts, "s"), starts)


def _encoding(path: Path) -> str:
    """Return the encoding of a text: UTF-16 with a byte order mark, UTF-8 if it is valid, else Latin-1."""
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


def _open_text(path: Path) -> _Text:
    encoding = _encoding(path)
    with path.open(encoding=encoding) as stream:
        header = find_header(path.name, list(_check_lines(path.name, islice(stream, HEAD))))
    with path.open(encoding=encoding) as stream:
        below = _check_lines(path.name, islice(stream, header.first - 1, None))
        lines, commas = _scan_lines(below, header.separator)
    check_columns(len(header.names), path.name)
    check_numbers(lines * len(header.names), path.name)
    _check_names(path.name, header.names)
    return _Text(path, encoding, header, commas)


def _check_lines(file: str, lines: Iterator[str]) -> Iterator[str]:
    for line in lines:
        check_line(len(line), file)
        yield line


def _scan_lines(lines: Iterator[str], separator: str | None) -> tuple[int, Commas]:
    """Return the number of lines, and which commas in them are decimal commas.

    Where commas separate cells, `"1,234"` may be above a thousand: quoted commas are decimal only if a cell proves it.
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


def _parse_number(cell: str) -> float | None:
    word = cell.strip()
    try:
        return float("nan") if word.lower() in MISSING else float(word)
    except ValueError:
        return None


def _read_numbers(text: _Text) -> dict[str, Array] | None:
    """Return the columns of a file that holds only numbers, or None: then each cell must be parsed separately."""
    header = text.header
    if header.stamped or "" in header.names:
        return None
    try:
        with text.rows() as rows:
            lines = (_trim_row(row, header.separator) for row in rows) if header.trailing else rows
            numbers = np.loadtxt(lines, delimiter=header.separator, comments=None, ndmin=2, quotechar='"')
    except ValueError:
        return None
    if numbers.shape[1] != len(header.names):
        return None
    return {name: np.ascontiguousarray(column) for name, column in zip(header.names, numbers.T, strict=True)}


def _trim_row(row: str, separator: str | None) -> str:
    """Return a row without a separator after its last cell."""
    return row.rstrip("\r\n ").removesuffix(separator or "")


def _read_cells(text: _Text) -> tuple[dict[str, Array], dict[str, str]]:
    """Return the columns, and the first stamp of each column of time stamps; every cell is parsed separately."""
    columns = [_Column(name, Stamps() if name in text.header.stamped else None) for name in text.header.names]
    with text.rows() as rows:
        filled = ((text.header.first + i, row) for i, row in enumerate(rows) if row.strip())
        while block := list(islice(filled, AT_ONCE)):
            _add_rows(text, columns, block)
    found = {column.name: both for column in columns if column.name and (both := column.finish(text.path.name))}
    return {name: values for name, (values, _) in found.items()}, {
        name: start for name, (_, start) in found.items() if start
    }


def _add_rows(text: _Text, columns: list[_Column], block: list[tuple[int, str]]) -> None:
    """Add the cells of some lines to the columns."""
    numbers = [number for number, _ in block]
    rows = [_split_row(text, number, row) for number, row in block]
    for column, cells in zip(columns, zip(*rows, strict=True), strict=True):
        if column.name:
            column.add(numbers, cells)


def _split_row(text: _Text, number: int, line: str) -> list[str]:
    """Return the cells of a row, one for each column; `DataError` for another number of cells."""
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
