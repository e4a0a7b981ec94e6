"""Columns of a text file: a header line, then numbers or time stamps between commas, semicolons, tabs or blanks.

The file is read line by line, two or three times, so that little more memory is used than for the numbers.
"""

from __future__ import annotations

import codecs
import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.cells import Header, cells_of, is_comment
from lostmotion.recording.column_names import has_foreign_name
from lostmotion.recording.footer import drop_footer
from lostmotion.recording.header import HEAD, find_header, number_names
from lostmotion.recording.joined import PARTS
from lostmotion.recording.limits import check_columns, check_line, check_numbers
from lostmotion.recording.lvm import FIRST, read_lvm
from lostmotion.recording.numbers import RAW, Mark, NumberColumn, choose_mark, is_missing
from lostmotion.recording.stamps import Stamps
from lostmotion.recording.table import Table, make_table
from lostmotion.recording.units import name_and_unit

Array = NDArray[np.float64]
AT_ONCE = 4096
"""Lines that are processed at once where each cell is parsed separately."""
ENCODINGS = ("cp932", "cp1251", "euc_jp", "koi8-r", "cp866", "gbk", "cp949", "big5")
"""Encodings of Japanese, Russian, Chinese and Korean, in the order in which they are tried."""
_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f]")
_BLOCK = 1 << 20
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_UTF_32 = (b"\xff\xfe\x00\x00", b"\x00\x00\xfe\xff")
_DOS = re.compile(rb"[\[(/_ ]\xe6[msgNAV][\])\s,;_]|[\[(]\xf8[CF]?[\])]|[sm]\xfd[\])]")
"""Units with a micro sign, a degree sign or a square in the encodings of DOS."""


@dataclass(frozen=True)
class _Text:
    """A text file with its encoding and header, the number of filled lines below the header, and its decimal mark.

    `whole` tells that no blank line lies between the rows. `mark` is the decimal mark where the cells are plain numbers
    with it; None where each cell has to be looked at. `broken` is that of a last row that is shorter than all others.
    """

    path: Path
    encoding: str
    header: Header
    lines: int
    whole: bool
    mark: Mark | None
    broken: int

    @contextmanager
    def rows(self) -> Iterator[Iterator[str]]:
        """Yield the lines below the header."""
        with self.path.open(encoding=self.encoding) as stream:
            yield islice(stream, self.header.first - 1, None)


@dataclass
class _StampColumn:
    """A column of time stamps while it is read, and the first cell that is none."""

    name: str
    stamps: Stamps = field(default_factory=Stamps)
    wrong: tuple[int, str] | None = None

    def add(self, lines: Sequence[int], cells: Sequence[str]) -> None:
        """Add the cells of some lines of the file."""
        wrong = self.stamps.add(cells, [is_missing(cell) for cell in cells]) if self.wrong is None else None
        if wrong is not None:
            self.wrong = lines[wrong], cells[wrong].strip()

    def finish(self, file: str) -> tuple[Array, str]:
        """Return the column (n,) in seconds and its first stamp; `DataError` for a cell that is no stamp."""
        if self.wrong:
            line, cell = self.wrong
            raise DataError(
                f"{file}, line {line}, column {self.name!r}: {cell[:40]!r} is not a time stamp like those above it:"
                " correct or empty it"
            )
        return self.stamps.finish(file, self.name)


def read_text(path: Path) -> Table:
    """Return the columns of a text file by the names in its header line, each (n,); empty cells are NaN.

    Cells are separated by commas, semicolons, tabs or blanks. Decimal commas and separators of thousands are read where
    the cells of the file leave no doubt. Columns of time stamps are in seconds from the first stamp. A column that
    cannot be read is kept with the reason.
    """
    encoding = _encoding(path)
    with path.open(encoding=encoding) as stream:
        if stream.readline().startswith(FIRST):
            return read_lvm(path.name, _check_lines(path.name, stream))
    text = _open_text(path, encoding)
    found, line = _read_plain(text), text.header.first if text.whole else 0
    table = _read_cells(text) if found is None else make_table(found, text.header.units, line=line)
    return replace(table, rates=text.header.rates)


def _encoding(path: Path) -> str:
    """Return the encoding of a text: UTF-16 with a byte order mark, UTF-8 if it is valid, else one of Windows."""
    with path.open("rb") as raw:
        head = raw.read(4096)
        if head.startswith((*_UTF_32, *_UTF_16)):
            return "utf-32" if head.startswith(_UTF_32) else "utf-16"
        for other, zeros, encoding in ((head[::2], head[1::2], "utf-16-le"), (head[1::2], head[::2], "utf-16-be")):
            if 0 not in other and zeros.count(0) > len(head) // 4:
                return encoding
        if len(control := _CONTROL.findall(head)) in range(1, len(head) // 100):
            line = head[: head.index(control[0])].count(b"\n") + 1
            raise DataError(
                f"{path.name}, line {line}: there is the control character {control[0]!r}, as after an error of the"
                " connection: remove the line"
            )
        if control:
            raise DataError(f"{path.name} is not text: give the file its true ending, or export the recording as csv")
        raw.seek(0)
        decoder = codecs.getincrementaldecoder("utf-8")()
        try:
            while block := raw.read(_BLOCK):
                decoder.decode(block)
            decoder.decode(b"", final=True)
        except UnicodeDecodeError:
            return _guess_encoding(head)
    return "utf-8-sig"


def _guess_encoding(head: bytes) -> str:
    """Return the encoding of a text in one of the older encodings: Japanese, Russian, else that of Western Europe.

    The one in which a column has a known name is taken. Else, Japanese characters begin with a byte that is no letter
    elsewhere, and Russian words consist of high bytes only.
    """
    lines = head[: head.rfind(b"\n") + 1]
    for encoding in ENCODINGS:
        with suppress(UnicodeDecodeError):
            if has_foreign_name(lines.decode(encoding)):
                return encoding
    if _DOS.search(head):
        return "cp850"
    if re.search(rb"[\x81-\x84\x88-\x9f][\x40-\xfc]", head):
        with suppress(UnicodeDecodeError):
            head[: head.rfind(b"\n") + 1].decode("cp932")
            return "cp932"
    return "cp1251" if re.search(rb"[\xc0-\xff]{3}", head) else "latin-1"


def _open_text(path: Path, encoding: str) -> _Text:
    with path.open(encoding=encoding, errors="strict") as stream:
        header = find_header(path.name, list(_check_lines(path.name, islice(stream, HEAD))))
    with path.open(encoding=encoding) as stream:
        below = _check_lines(path.name, islice(stream, header.first - 1, None))
        lines, whole, mark, broken = _scan_lines(below, header.separator)
    check_columns(len(header.names), path.name)
    check_numbers(lines * len(header.names), path.name)
    if header.stamped or header.finish or "" in header.names or _find_twice(header.names):
        mark = None
    return _Text(path, encoding, header, lines, whole, mark, header.first + broken if broken else 0)


def _check_lines(file: str, lines: Iterator[str]) -> Iterator[str]:
    for line in lines:
        check_line(len(line), file)
        yield line


def _scan_lines(lines: Iterator[str], separator: str | None) -> tuple[int, bool, Mark | None, int]:
    """Return the number of filled lines, whether they follow each other, and the only decimal mark they allow.

    The mark is None where each cell has to be looked at. Where commas separate the cells, it is a point; cells with
    commas in quotes are found later. The last number is the index of a last line with fewer separators than any other.
    """
    count, last, points, commas, proven = 0, -1, False, False, False
    fewest, here = math.inf, math.inf
    for number, line in enumerate(lines):
        if line.isspace():
            continue
        fewest, here = min(fewest, here), line.count(separator or " ")
        count, last = count + 1, number
        points, commas = points or "." in line, commas or "," in line
        proven = proven or bool(RAW["comma" if commas else "point"].search(line))
    whole, broken = last + 1 == count, last if here < fewest else 0
    if separator == ",":
        return count, whole, "point", broken
    if points and commas:
        return count, whole, None, broken
    mark: Mark | None = ("comma" if commas else "point") if proven or not (points or commas) else None
    return count, whole, mark, broken


def _find_twice(names: list[str]) -> list[str]:
    return sorted(name for name, count in Counter(names).items() if name and count > 1)


def _read_plain(text: _Text) -> dict[str, Array] | None:
    """Return the columns of a file that holds only plain numbers, or None: then each cell must be parsed separately."""
    header = text.header
    if text.mark is None:
        return None
    try:
        with text.rows() as rows:
            lines = (_trim_row(row, header.separator) for row in rows) if header.trailing else rows
            marked = (line.replace(",", ".") for line in lines) if text.mark == "comma" else lines
            numbers = np.loadtxt(marked, delimiter=header.separator, comments=None, ndmin=2, quotechar='"')
    except ValueError:
        return None
    if numbers.shape != (text.lines, len(header.names)):  # a blank line, or another number of cells
        return None
    return {name: np.ascontiguousarray(column) for name, column in zip(header.names, numbers.T, strict=True)}


def _trim_row(row: str, separator: str | None) -> str:
    """Return a row without a separator after its last cell."""
    return row.rstrip("\r\n ").removesuffix(separator or "")


def _read_cells(text: _Text) -> Table:
    """Return the table of a file in which every cell is parsed separately."""
    header, names = text.header, number_names(text.header.names)
    columns: list[NumberColumn | _StampColumn | None] = []
    for place, given in enumerate(header.names):
        kind = _StampColumn if given in header.stamped else NumberColumn
        columns.append(kind(names[place]) if given and place != header.dated else None)
    rows_read, last = 0, 0
    with text.rows() as rows:
        filled = drop_footer(
            ((header.first + i, row) for i, row in enumerate(rows) if row.strip() and not is_comment(row)),
            header.separator,
        )
        while block := list(islice(filled, AT_ONCE)):
            _add_rows(text, columns, block)
            rows_read, last = rows_read + len(block), block[-1][0]
    kept = [one for one in columns if one]
    units = {one.name: header.units.get(one.name, "") for one in kept}
    return _collect(text, kept, units, header.first if last - header.first + 1 == rows_read else 0)


def _collect(text: _Text, columns: list[NumberColumn | _StampColumn], units: dict[str, str], line: int) -> Table:
    """Return the table of all columns that can be read, with the reasons of the others."""
    file, numbers = text.path.name, [one for one in columns if isinstance(one, NumberColumn)]
    mark = choose_mark(numbers)
    found: dict[str, Array] = {}
    starts: dict[str, str] = {}
    refused = {
        name: f"{file} has two columns named {name!r}: they are called '{name} 1', '{name} 2': name one of these"
        for name in _find_twice(text.header.names)
    }
    for one in columns:
        if isinstance(one, _StampColumn):
            try:
                found[one.name], starts[one.name] = one.finish(file)
            except DataError as err:
                refused[one.name], starts[one.name] = str(err), ""
            continue
        own = mark or (next(iter(one.proof)) if len(one.proof) == 1 else None)
        if why := one.refusal(own, units[one.name] or name_and_unit(one.name)[1]):
            refused[one.name] = f"{file}, {why}"
        else:
            found[one.name] = one.finish(own or "point")
            units[one.name] = units[one.name] or next(iter(one.units), "")
    _add_fractions(found, starts)
    if text.header.finish:
        text.header.finish(found, units, refused)
    if refused and not found:
        raise DataError(next(iter(refused.values())))
    return make_table(found, units, starts, refused, line)


def _add_fractions(found: dict[str, Array], starts: dict[str, str]) -> None:
    """Add a column of the parts of a second, such as milliseconds, to the only column of time stamps if it has none."""
    named = ((size, name, form.fullmatch(name.strip())) for size, form in PARTS.items() for name in found)
    parts = [(size, name) for size, name, word in named if word and not word[1] and name not in starts]
    if len(parts) != 1 or len(starts) != 1:
        return
    ((stamped, first),), ((size, name),) = starts.items(), parts
    if stamped not in found:  # its dates have two readings
        return
    whole, rest = found[stamped], found[name]
    if not (np.all((rest >= 0.0) & (rest * size < 1.0)) and np.array_equal(whole, np.rint(whole)) and "." not in first):
        return
    found[stamped] = whole + (rest - rest[0]) * size
    starts[stamped] = f"{first}.{rest[0] * size:.9f}".replace(".0.", ".").rstrip("0").ljust(len(first) + 4, "0")
    del found[name]


def _add_rows(text: _Text, columns: Sequence[NumberColumn | _StampColumn | None], block: list[tuple[int, str]]) -> None:
    """Add the cells of some lines to the columns."""
    numbers, header = [number for number, _ in block], text.header
    split = list(zip(*(_split_row(text, number, row) for number, row in block), strict=True))
    for column, cells in zip(columns, split, strict=True):
        if isinstance(column, NumberColumn):
            column.add(numbers, cells, dots_decide=header.separator == ",")
        elif column is not None and header.dated >= 0:
            column.add(
                numbers, [f"{day.strip()} {cell.strip()}" for day, cell in zip(split[header.dated], cells, strict=True)]
            )
        elif column is not None:
            column.add(numbers, cells)


def _split_row(text: _Text, number: int, line: str) -> list[str]:
    """Return the cells of a row, one for each column; `DataError` for another number of cells."""
    header, cells = text.header, cells_of(line, text.header.separator)
    wanted, got = len(header.names), len(cells)
    if wanted == got:
        return cells
    if 1 < got < wanted and header.separator is not None and number != text.broken:
        return cells + [""] * (wanted - got)
    if header.trailing and got == wanted + 1 and not cells[-1].strip():
        return cells[:-1]
    hint = "complete or remove the line"
    if header.separator == "," and got > wanted and all(re.fullmatch(r"[+-]?\d+", cell.strip()) for cell in cells):
        hint = "these look like decimal commas; separate the columns by ';' or write decimal points"
    name = text.path.name
    raise DataError(f"{name}, line {number}: {got} cells where the header names {wanted} columns: {hint}")
