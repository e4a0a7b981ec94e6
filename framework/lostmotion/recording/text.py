"""Columns of a text file: a header line, then numbers between commas, semicolons, tabs or blanks."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError

Array = NDArray[np.float64]
MISSPELT = re.compile(r"[+-]?\d[\d.,' ]*([eE][+-]?\d+)?")
"""A cell that was meant to be a number, with separators of thousands perhaps, and not a word or a date."""
MISSING = {"", "nan", "na", "n/a", "null", "none", "-"}


@dataclass(frozen=True)
class _Table:
    """A text file taken apart: `rows` are the lines below the header, the first of them is line `first`."""

    file: str
    names: list[str]
    separator: str | None
    rows: list[str]
    first: int


def read_text(path: Path) -> dict[str, Array]:
    """Return the columns of a text file by the names in its header line, each (n,); empty cells are NaN.

    Comma, semicolon, tab or blank separate the cells; with any but the comma, a decimal comma is understood.
    """
    table = _table(path.name, _decode(path).splitlines())
    return _fast(table) or _careful(table)


def _decode(path: Path) -> str:
    raw = path.read_bytes()
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        return raw.decode("utf-16")
    if any(byte < 32 and byte not in b"\t\n\r\f" for byte in raw[:4096]):
        raise DataError(f"{path.name} is not text: give the file its true ending, or export the recording as csv")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def _table(file: str, lines: list[str]) -> _Table:
    top = _header_line(file, lines)
    below = lines[top + 1 :]
    header = lines[top].lstrip("# \t")
    separator = _separator(header, next((line for line in below if line.strip()), ""))
    names = [name.strip() for name in _cells(header, separator)]
    if not any(line.strip() for line in below):
        raise DataError(f"{file} has a header line and no numbers below it: record or export it again")
    _check_names(file, names)
    if separator != "," and any("," in line for line in below):
        below = [line.replace(",", ".") for line in below]
    return _Table(file, names, separator, below, top + 2)


def _header_line(file: str, lines: list[str]) -> int:
    """Return the index of the header: the first line, or after comments the last of them if numbers follow."""
    filled = [i for i, line in enumerate(lines) if line.strip()]
    plain = [i for i in filled if not lines[i].lstrip().startswith("#")]
    if not filled:
        raise DataError(f"{file} holds only blank lines: record or export it again")
    if not plain or (plain[0] != filled[0] and _all_numbers(lines[plain[0]])):
        return max(i for i in filled if not plain or i < plain[0])
    if _all_numbers(lines[plain[0]]):
        raise DataError(f"{file} starts with numbers: wanted a header line that names the columns, as time,force,x")
    return plain[0]


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
    twice = sorted({name for name in names if name and names.count(name) > 1})
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
        numbers = np.loadtxt(table.rows, delimiter=table.separator, comments=None, ndmin=2, quotechar='"')
    except ValueError:
        return None
    if numbers.shape[1] != len(table.names) or "" in table.names:
        return None
    return {name: np.ascontiguousarray(column) for name, column in zip(table.names, numbers.T, strict=True)}


def _careful(table: _Table) -> dict[str, Array]:
    lines = [(table.first + i, row) for i, row in enumerate(table.rows) if row.strip()]
    rows = [(number, _cells(row, table.separator)) for number, row in lines]
    for number, cells in rows:
        _check_width(table, number, cells)
    columns = {name: [(number, cells[k]) for number, cells in rows] for k, name in enumerate(table.names) if name}
    return {name: found for name, cells in columns.items() if (found := _column(table.file, name, cells)) is not None}


def _check_width(table: _Table, number: int, cells: list[str]) -> None:
    wanted, got = len(table.names), len(cells)
    if wanted == got:
        return
    hint = "complete or remove the line"
    if table.separator == "," and got == 2 * wanted:
        hint = "these look like decimal commas; separate the columns by ';' or write decimal points"
    raise DataError(f"{table.file}, line {number}: {got} cells where the header names {wanted} columns: {hint}")


def _column(file: str, name: str, cells: list[tuple[int, str]]) -> Array | None:
    """Return one column (n,), or None when none of its cells is a number: a column of words is left out."""
    values = [_number(cell) for _, cell in cells]
    wrong = [k for k, value in enumerate(values) if value is None]
    meant = any(MISSPELT.fullmatch(cells[k][1].strip()) for k in wrong)
    if wrong and not meant and all(v is None or np.isnan(v) for v in values):
        return None
    if wrong:
        number, cell = cells[wrong[0]]
        raise DataError(
            f"{file}, line {number}, column {name!r}: {cell.strip()!r} is not a number: correct or empty it"
        )
    return np.array(values, dtype=np.float64)
