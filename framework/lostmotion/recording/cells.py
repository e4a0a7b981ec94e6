"""The cells of the lines of a text file, and the header of its table."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lostmotion.recording.numbers import is_missing, read_number
from lostmotion.recording.stamps import is_date, is_stamp
from lostmotion.recording.units import is_unit, split_name

COMMENTS = ("#", "%", "//")
"""How a comment line begins."""
SEPARATORS = (";", "\t", ",", "|")
"""The separators of cells beside blanks, in the order in which they are tried."""
Columns = dict[str, NDArray[np.float64]]
Line = tuple[int, str]
"""A line: index in the file, and text."""


@dataclass(frozen=True)
class Header:
    """The names and units of the columns, the separator of cells (None: blanks), and the line of the first row.

    `trailing` tells that rows end with a separator after the last cell; `stamped` names the columns of time stamps.
    `dated` is the number of the column of dates that belong to the times of day in the column `stamped`, -1 for none.
    `finish` changes columns, units and reasons of columns that are refused, once all cells are read. `rates` are the
    rates (Hz) that lines above the table state, by the words that say so.
    """

    names: list[str]
    units: dict[str, str]
    separator: str | None
    first: int
    trailing: bool = False
    stamped: frozenset[str] = frozenset()
    dated: int = -1
    finish: Callable[[Columns, dict[str, str], dict[str, str]], None] | None = None
    rates: Mapping[str, float] = field(default_factory=dict)


def is_comment(line: str) -> bool:
    """Return whether a line of a file is a comment."""
    return line.lstrip().startswith(COMMENTS)


def strip_comment(line: str) -> str:
    """Return a line without the marks of a comment at its beginning."""
    text = line.strip("\r\n ")
    return text.lstrip("#%/ \t") if is_comment(text) else text


def separator_of(header: str, row: str) -> str | None:
    """Return the separator of the cells of a table; None means blanks."""
    found = [separator for separator in SEPARATORS if separator in header]
    for separator in (*(one for one in found if one in row), *found):
        if separator in row or len(_split_words(header)) != len(row.split()):
            return separator
    names = len(_split_words(header))  # the names of the rows may lack one themselves
    return None if names == len(row.split()) or names == len(row.split()) - 1 > 0 else ";"


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


def is_number(cell: str) -> bool:
    """Return whether a cell is a number with a decimal point or a decimal comma."""
    return not is_missing(cell) and (read_number(cell) is not None or read_number(cell, "comma") is not None)


def is_value(cell: str) -> bool:
    """Return whether a cell is a number, a time stamp, a date or empty."""
    return is_missing(cell) or is_filled(cell)


def is_filled(cell: str) -> bool:
    """Return whether a cell is a number, with or without a unit, a time stamp or a date."""
    text = cell.strip()
    if is_missing(text):
        return False
    number, _, unit = text.partition(" ")
    measured = is_unit(unit) and not unit.startswith(("(", "[")) and is_number(number)  # `101 (V)` is a name
    return is_number(text) or is_stamp(text) or is_date(text) or measured


def keep_units(stated: Mapping[str, str]) -> dict[str, str]:
    """Return the units of the columns that have a name and a unit."""
    return {name: unit for name, unit in stated.items() if name and is_unit(unit)}
