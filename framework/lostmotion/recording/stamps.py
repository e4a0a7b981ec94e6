"""Conversion of time stamps of data loggers to seconds from the first one.

Each distinct date is parsed only once. Times are integer nanoseconds until the first stamp has been subtracted, so
that microseconds are preserved.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import date

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError

Array = NDArray[np.float64]
Whole = NDArray[np.int64]
_DAY_FIRST = r"\d{1,2}[./-]\d{1,2}[./-](?:\d{4}|\d{2})|\d{1,2}\. \d{1,2}\. ?(?:\d{4}|\d{2})"
_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_NAMED = r"\d{1,2}[- .]+[A-Za-z]{3,9}[-, .]+(?:\d{4}|\d{2})|[A-Za-z]{3,9}\.? \d{1,2},? \d{4}"
_YEAR_FIRST = r"\d{4}-\d{1,2}-\d{1,2}|\d{4}/\d{1,2}/\d{1,2}|\d{4}\.\d{1,2}\.\d{1,2}|\d{8}"
_DATE = rf"({_YEAR_FIRST}|{_DAY_FIRST}|{_NAMED})"
_ZONES = {
    "WET": 0, "WEST": 1, "BST": 1, "CET": 1, "CEST": 2, "MEZ": 1, "MESZ": 2, "EET": 2, "EEST": 3, "MSK": 3, "JST": 9,
    "EST": -5, "EDT": -4, "CST": -6, "CDT": -5, "MST": -7, "MDT": -6, "PST": -8, "PDT": -7,
}  # fmt: skip
"""Names of time zones, with their hours ahead of UTC."""
_STAMP = re.compile(
    rf"(?:(?:Mon|Tue|Wed|Thu|Fri|Sat|Sun)[a-z]*[, ]+)?(?:{_DATE}[T ,_]\s*)?"
    rf"(\d{{1,2}}):([0-5]\d):([0-5]\d)(?:[.,](\d{{1,9}})|:(\d{{1,3}}))?\s*([AaPp]\.?[Mm]\.?)?\s*"
    rf"(?:(Z|[+-]\d\d:?\d\d|{'|'.join(_ZONES)}|(?:GMT|UTC)(?:[+-]\d\d?(?::?\d\d)?)?)(?:\[[\w/+-]+\])?)?"
)
_COMPACT = re.compile(
    r"((?:19|20)\d\d(?:0[1-9]|1[0-2])(?:0[1-9]|[12]\d|3[01]))[T_ -]?([01]\d|2[0-3])([0-5]\d)([0-5]\d)"
    r"(?:[.,](\d{1,9})|(\d{3}))?(Z|[+-]\d\d:?\d\d)?"
)
"""20250304T095850.125Z or 20250304095850125."""
_SINCE = re.compile(
    r"(?:(\d+) days?,? )?(\d{1,2}):([0-5]\d):([0-5]\d)(?:[.,](\d{1,9}))?|(\d{1,3}):([0-5]\d)[.,](\d{1,9})"
)
"""A duration: `0 days 00:00:01.125` of pandas, or minutes and seconds `00:01.125`."""
_ONLY_DATE = re.compile(_DATE)
_WRITTEN = str.maketrans({"年": "-", "月": "-", "日": " ", "時": ":", "分": ":", "秒": None})
"""The words of Japanese dates: 2025年03月04日 09時58分50秒."""
_SECOND, _DAY = 10**9, 86400 * 10**9
_Fields = tuple[str | None, str, str, str, str | None, str | None, str | None]
_NOTHING: _Fields = (None, "0", "0", "0", None, None, None)
SIMILAR = 1.5
"""Steps that differ by less than this factor do not decide in which order dates are written."""
EPOCH = date(1970, 1, 1).toordinal()


def is_stamp(cell: str) -> bool:
    """Return whether a cell holds a time of day, with or without a date before it."""
    return len(cell) < 64 and _read_fields(cell) is not None


def is_date(cell: str) -> bool:
    """Return whether a cell holds a date without a time of day."""
    word = cell.translate(_WRITTEN).strip()
    return len(word) < 32 and not word.isdigit() and _ONLY_DATE.fullmatch(word) is not None


def _read_fields(cell: str) -> _Fields | None:
    """Return date, hour, minute, second, fraction, half of the day and zone of a stamp; None where a cell is none."""
    text = cell.strip() if cell.isascii() else cell.translate(_WRITTEN).strip()
    if found := _STAMP.fullmatch(text):
        day, hour, minute, second, part, milli, half, zone = found.groups()
        return day, hour, minute, second, milli.zfill(3) if milli else part, half, zone
    if found := _COMPACT.fullmatch(text):
        day, hour, minute, second, part, milli, zone = found.groups()
        return day, hour, minute, second, milli or part, None, zone
    if found := _SINCE.fullmatch(text):
        days, hour, minute, second, part, minutes, seconds, rest = found.groups()
        if minutes:
            return None, str(int(minutes) // 60), str(int(minutes) % 60), seconds, rest, None, None
        return None, str(24 * int(days or 0) + int(hour)), minute, second, part, None, None
    return None


class Stamps:
    """A column of time stamps, to which cells are added block by block."""

    def __init__(self) -> None:
        self._dates: dict[str | None, int] = {}
        self._which: list[Whole] = []
        self._since: list[Whole] = []
        self._lost: list[NDArray[np.bool_]] = []
        self._offset = ""

    def add(self, cells: Sequence[str], lost: Sequence[bool]) -> int | None:
        """Add some cells; return the index of the first one that is neither a time stamp nor lost, or None."""
        fields, which = [], np.zeros(len(cells), dtype=np.int64)
        for k, cell in enumerate(cells):
            found = _NOTHING if lost[k] else _read_fields(cell)
            if found is None:
                return k
            fields.append(found[1:])
            which[k] = -1 if lost[k] else self._dates.setdefault(found[0], len(self._dates))
        if not self._which and fields:
            self._offset = next((f[5] or "" for f, gone in zip(fields, lost, strict=True) if not gone), "")
        self._which.append(which)
        self._lost.append(np.asarray(lost, dtype=bool))
        self._since.append(_since_midnight(fields))
        return None

    def finish(self, file: str, name: str) -> tuple[Array, str]:
        """Return seconds from the first stamp (n,), NaN for a lost one, and the first stamp in ISO format."""
        which, since = np.concatenate(self._which), np.concatenate(self._since)
        lost = np.concatenate(self._lost)
        there = np.flatnonzero(~lost)
        if None in self._dates and len(self._dates) > 1:
            raise DataError(
                f"{file}, column {name!r}: some time stamps have a date and some have none: export the file again"
            )
        if None in self._dates:
            total = since.copy()
            total[there] += _DAY * _count_midnights(since[there])
        else:
            days = _find_days(list(self._dates), which[there], since[there], f"{file}, column {name!r}")
            total = since + _DAY * (days - days[0])[np.maximum(which, 0)]
        times = (total - total[there[0]]) / 1e9
        times[lost] = np.nan
        day = None if None in self._dates else int(days[which[there[0]]])
        return times, _format_iso(int(since[there[0]]), day, self._offset)


def _since_midnight(fields: Sequence[Sequence[str | None]]) -> Whole:
    """Return nanoseconds since midnight (in UTC where an offset is given) from the fields of stamps."""
    hours, minutes, secs, parts, halves, offsets = zip(*fields, strict=True) if fields else ((),) * 6
    hour = np.array(hours, dtype=str).astype(np.int64)
    if any(halves):
        late = np.array([(half or "").lower().startswith("p") for half in halves])
        hour = np.where(np.array([half is None for half in halves]), hour, hour % 12 + 12 * late)
    whole = (
        3600 * hour + 60 * np.array(minutes, dtype=str).astype(np.int64) + np.array(secs, dtype=str).astype(np.int64)
    )
    fraction = np.array([(part or "").ljust(9, "0") for part in parts], dtype=str).astype(np.int64)
    ahead = np.array([_utc_offset(offset) for offset in offsets], dtype=np.int64) if any(offsets) else np.int64(0)
    return np.asarray(whole * _SECOND + fraction - ahead * _SECOND, dtype=np.int64)


def _utc_offset(offset: str | None) -> int:
    """Return the offset (s) of local time from UTC."""
    if offset in _ZONES:
        return 3600 * _ZONES[offset]
    found = re.fullmatch(r"(?:GMT|UTC)?([+-])(\d\d?):?(\d\d)?", offset or "")
    if not found:
        return 0
    return (1 if found[1] == "+" else -1) * (3600 * int(found[2]) + 60 * int(found[3] or 0))


def _count_midnights(since: Whole) -> Whole:
    """Return the number of midnights before each stamp (n,), for stamps without a date."""
    passed = np.diff(since) < -_DAY // 2
    return np.concatenate(([0], np.cumsum(passed))).astype(np.int64)


def _find_days(dates: list[str | None], which: Whole, since: Whole, what: str) -> Whole:
    """Return the day (since 1970) of each distinct date.

    With dots the day is first. Otherwise a number above 12 decides, then the order in which time never decreases and
    its longest step is the shortest; else the month is first, where that changes no difference. `DataError` is raised
    where two orders are possible and have steps of similar length.
    """
    texts = [text or "" for text in dates]
    found = [days for order in _possible_orders(texts[0]) if (days := _read_dates(texts, order)) is not None]
    if not found:
        raise DataError(f"{what}: {texts[0]!r} is no date in the format of all others: correct the dates")
    totals = [since + _DAY * (days - days[0])[which] for days in found]
    decrease, step = min(map(_rank_reading, totals))
    (days, total), *others = (pair for pair in zip(found, totals, strict=True) if _rank_reading(pair[1])[0] == decrease
                              and _rank_reading(pair[1])[1] <= SIMILAR * step)  # fmt: skip
    for other, another in others:
        if not np.array_equal(total, another):
            k = int(np.argmax(total != another))
            one, two = (date.fromordinal(int(read[which[k]]) + EPOCH).isoformat() for read in (days, other))
            raise DataError(
                f"{what}: {texts[which[k]]!r} is {one} or {two}, and {texts[which[0]]!r} allows both: write dates with"
                " the year first"
            )
    return days


def _possible_orders(text: str) -> tuple[tuple[int, int, int], ...]:
    """Return the possible positions of year, month and day in a date."""
    if re.match(r"\d{4}", text):
        return ((0, 1, 2),)
    if re.search(r"[A-Za-z]", text):
        return ((2, 0, 1),) if text[0].isalpha() else ((2, 1, 0),)
    if "." in text:
        return ((2, 1, 0),)
    return ((2, 0, 1), (2, 1, 0)) if re.search(r"\d{4}$", text) else ((2, 0, 1), (2, 1, 0), (0, 1, 2))


def _read_dates(texts: list[str], order: tuple[int, int, int]) -> Whole | None:
    try:
        parts = [[part[k] for k in order] for part in map(_split_date, texts)]
        return np.array([date(_whole_year(y), m, d).toordinal() - EPOCH for y, m, d in parts], dtype=np.int64)
    except (ValueError, IndexError):
        return None


def _whole_year(year: int) -> int:
    """Return a year of two digits as one from 1970 to 2069."""
    return year if year > 99 else year + (2000 if year < 70 else 1900)


def _split_date(text: str) -> list[int]:
    """Return the numbers in a date; the name of a month becomes its number."""
    if re.fullmatch(r"\d{8}", text):
        return [int(text[:4]), int(text[4:6]), int(text[6:])]
    words = [word for word in re.split(r"[./, -]+", text) if word]
    return [int(word) if word.isdigit() else _MONTHS.index(word[:3].lower()) + 1 for word in words]


def _rank_reading(total: Whole) -> tuple[bool, int]:
    """Return whether times (n,) decrease, and the longest step between them."""
    steps = np.diff(total)
    return bool(np.any(steps < 0)), int(steps.max(initial=0))


def _format_iso(since: int, day: int | None, offset: str) -> str:
    """Return the first stamp in ISO format: its local time, and its offset where it had one."""
    ahead = _utc_offset(offset)
    local = np.datetime64(since + _SECOND * ahead, "ns") + np.timedelta64(day or 0, "D")
    text = str(np.datetime_as_string(local, unit="ns")).rstrip("0").rstrip(".")
    sign, minutes = "-" if ahead < 0 else "+", abs(ahead) // 60
    zone = offset if not offset or offset == "Z" else f"{sign}{minutes // 60:02d}:{minutes % 60:02d}"
    return (text.partition("T")[2] if day is None else text) + zone
