"""The columns of numbers of a text file, where a cell may have a decimal point or a decimal comma.

`1.530` is 1.53 in one country and 1530 in another. Each cell is therefore read in both ways, and all cells of a file
decide together: the way that every cell allows is taken. Where cells allow both ways, the columns that hold them are
refused, and one cell is shown. A cell may carry a unit, `4.5 N`, which has to be the same in its whole column.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lostmotion.quantities import spell_unit
from lostmotion.recording.column_names import names_time
from lostmotion.recording.units import is_unit

Array = NDArray[np.float64]
Mark = Literal["point", "comma"]
"""The decimal mark."""
MISSING = {
    "", "nan", "-nan", "na", "n/a", "#n/a", "#na", "#nv", "null", "none", "-", "--", "---", "nan(ind)", "-nan(ind)",
    "1.#qnan", "-1.#ind", "<na>", "nat", "\\n", "#value!", "#div/0!", "#num!", "#ref!", "#wert!", "#zahl!", "#bezug!",
    "#valeur!", "#nombre!", "ovld", "ol", "+ol", "-ol", "overload", "overrange", "over range", "underrange", "over",
    "under", "invalid", "欠測", "no data", "nodata", "missing", "burn out", "burnout", "ofl", "n.a.", "k.a.", "--.--",
    "+over", "-over", "overflow", "underflow", "1.#ind", "error", "err", "bad", "fault", "fail", "open", "s/d", ".",
    "sensor error", "open circuit", "fehler", "erreur",
}  # fmt: skip
"""Cells without a reading, in lower case."""
_GROUPS = "'’ \u00a0\u2009\u202f"
_POINT = re.compile(
    rf"[+-]?(?:[1-9]\d{{0,2}}(?:([,{_GROUPS}])\d{{3}})(?:\1\d{{3}})*(?:\.\d*)?|(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?)"
)
"""A number with a decimal point, perhaps with one separator of thousands."""
_WITH_UNIT = re.compile(r"([+-]?[\d.,' ]*\d(?:[eE][+-]?\d+)?)\s*([^\d\s.,+-].*)")
_SWAP = str.maketrans(".,", ",.")
_GROUP = re.compile(rf"[,{_GROUPS}]")
_SIGNS = str.maketrans({"\u2212": "-", "\u2013": "-"})
MISSPELT = re.compile(r"[+-]?\d[\d.,' ]*([eE][+-]?\d+)?")
"""A cell that looks like a number and not like a word or a date."""
RAW: dict[Mark, re.Pattern[str]] = {
    "point": re.compile(r"(?<![\d.])0?\.\d|(?<=\d)\.(?:\d{1,2}(?!\d)|\d{4})|\d{4}\.\d"),
    "comma": re.compile(r"(?<![\d,])0?,\d|(?<=\d),(?:\d{1,2}(?!\d)|\d{4})|\d{4},\d"),
}
"""Parts of a line of numbers that only one decimal mark allows."""

Place = tuple[int, str]
"""The line of a cell in its file, and its text."""


def is_missing(cell: str) -> bool:
    """Return whether a cell has no reading; stars stand for a number that did not fit."""
    word = cell.strip().lower()
    return word in MISSING or (word[:2] in ("**", "##") and not word.strip("*#"))


def read_number(cell: str, mark: Mark = "point") -> float | None:
    """Return the number in a cell with this decimal mark, NaN where it has no reading; None where it is no number."""
    word = cell.strip()
    if not word.isascii():
        word = unicodedata.normalize("NFKC", word)
    if word.startswith('="') and word.endswith('"'):  # a text cell of Excel
        word = word[2:-1]
    if is_missing(word):
        return math.nan
    word = word.translate(_SIGNS)
    if mark == "comma":
        word = word.translate(_SWAP)
    if _POINT.fullmatch(word):
        return float(_GROUP.sub("", word).replace("d", "e").replace("D", "e"))
    return float(word) if word.lower().lstrip("+-") in ("inf", "infinity") else None


@dataclass
class NumberColumn:
    """One column while it is read: its values in both ways of reading, and cells that decide between them.

    `proof` holds the first cell that only one decimal mark allows, `twofold` the first one that is a different number
    with each, `wrong` the first one that is no number; `meant` tells that a wrong cell looks like a number.
    `prefixed` is the first one such as `12.3m`, which may be 12.3 m or 12.3 thousandths.
    """

    name: str
    values: dict[Mark, list[Array]] = field(default_factory=lambda: {"point": [], "comma": []})
    proof: dict[Mark, Place] = field(default_factory=dict)
    twofold: Place | None = None
    wrong: Place | None = None
    meant: bool = False
    numbers: bool = False
    units: dict[str, Place] = field(default_factory=dict)
    prefixed: Place | None = None

    def add(self, lines: Sequence[int], cells: Sequence[str], *, dots_decide: bool) -> None:
        """Add the cells of some lines; with `dots_decide`, a point in a cell without a comma is a decimal point."""
        if not self.units and len(self.proof) == 1 and self._add_plain(cells, next(iter(self.proof))):
            return
        both = np.empty((2, len(cells)))
        for k, cell in enumerate(cells):
            both[:, k] = self._read(lines[k], cell, dots_decide)
        for mark, row in zip(self.values, both, strict=True):
            self.values[mark].append(row)
        self.numbers = self.numbers or bool(np.isfinite(both).any() or np.isinf(both).any())

    def _add_plain(self, cells: Sequence[str], mark: Mark) -> bool:
        """Add cells of which all are plain numbers with the decimal mark that is proven; return whether they are."""
        text = "".join(cells)
        if "_" in text or (mark == "comma" and "." in text):
            return False
        try:
            numbers = np.array([float(c) for c in (text_of(cells) if mark == "comma" else cells)])
        except ValueError:
            return False
        self.numbers = True
        for each in self.values.values():
            each.append(numbers)  # the other way of reading has no use any more
        return True

    def _read(self, line: int, cell: str, dots_decide: bool) -> tuple[float, float]:
        """Return the number of a cell with a decimal point, and with a decimal comma; NaN for none."""
        text = cell
        point, comma = read_number(text), read_number(text, "comma")
        if point is None and comma is None and (found := _WITH_UNIT.fullmatch(cell.strip())) and is_unit(found[2]):
            text = found[1]
            self.units.setdefault(found[2].strip(), (line, cell.strip()))
            self.prefixed = self.prefixed or ((line, cell.strip()) if re.search(r"\dm$", cell.strip()) else None)
            point, comma = read_number(text), read_number(text, "comma")
        place = line, cell.strip()
        if dots_decide and "." in text and "," not in text:
            comma = None
        if point is None and comma is None:
            self.wrong = self.wrong or place
            self.meant = self.meant or bool(MISSPELT.fullmatch(place[1]))
            return math.nan, math.nan
        if point is None or comma is None:
            self.proof.setdefault("comma" if point is None else "point", place)
            return (math.nan, comma or 0.0) if point is None else (point, math.nan)
        if point != comma and not math.isnan(point):
            self.twofold = self.twofold or place
        return point, comma

    def finish(self, mark: Mark) -> Array:
        """Return the column (n,) with this decimal mark."""
        return np.concatenate(self.values[mark]) if self.values[mark] else np.empty(0)

    def refusal(self, mark: Mark | None, unit: str) -> str:
        """Return why the column cannot be read with this decimal mark, None where none is known; "" where it can.

        `unit` is the one in the header, "" for none.
        """
        if self.wrong:
            line, cell = self.wrong
            if names_time(self.name):
                return (
                    f"line {line}, column {self.name!r}: {cell[:40]!r} is neither a number nor a known time stamp, such"
                    " as 2025-03-04 09:58:50.125: correct it, or give the rate"
                )
            return f"line {line}, column {self.name!r}: {cell[:40]!r} is not a number: correct or empty it"
        if len(self.proof) == 2:
            (first, one), (second, other) = self.proof["point"], self.proof["comma"]
            return (
                f"line {max(first, second)}, column {self.name!r}: {one[:40]!r} (line {first}) has a decimal point and "
                f"{other[:40]!r} (line {second}) a decimal comma, so one of them is not a number: write decimal points"
            )
        if unit and self.units and spell_unit(unit) not in map(spell_unit, self.units):
            other, (line, _) = next(iter(self.units.items()))
            return (
                f"line {line}, column {self.name!r}: the cell is in {other} and the header says {unit}: write one unit"
            )
        if self.prefixed:
            line, cell = self.prefixed
            return (
                f"line {line}, column {self.name!r}: {cell[:40]!r} may be in metres or in thousandths: write plain"
                " numbers and the unit in the header"
            )
        if len(self.units) > 1:
            (one, (first, _)), (other, (second, _)) = list(self.units.items())[:2]
            return (
                f"line {max(first, second)}, column {self.name!r}: the cells are in {one} (line {first}) and in {other}"
                f" (line {second}): write one unit"
            )
        if mark is None and self.twofold:
            line, cell = self.twofold
            point, comma = read_number(cell), read_number(cell, "comma")
            return (
                f"line {line}, column {self.name!r}: {cell[:40]!r} is {point:g} with a decimal point and {comma:g} with"
                " a decimal comma, and the other cells allow both: write decimal points, no separator of thousands, and"
                " four decimals at least"
            )
        return ""


def text_of(cells: Sequence[str]) -> Iterable[str]:
    """Return cells with decimal points in place of decimal commas."""
    return (cell.replace(",", ".") for cell in cells)


def choose_mark(columns: Iterable[NumberColumn]) -> Mark | None:
    """Return the decimal mark of a file, which every cell of its columns allows.

    None is returned where cells contradict each other, or where some cells are different numbers with each mark and
    none decides: then each column decides by its own cells.
    """
    several = [one for one in columns if one.numbers]
    proven = {mark for one in several for mark in one.proof}
    if len(proven) == 1:
        return proven.pop()
    return None if proven or any(one.twofold for one in several) else "point"
