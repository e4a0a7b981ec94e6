"""The time of a table: which column holds it, in which unit, and why; every command and the notebook ask here.

Time stamps are time, and so is a column with the name or the unit of a time. A counter of rows or pulses is none. What
was guessed is said with its reason, and a guess that makes no sense is asked about.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.column_names import COUNTER, names_other, names_time
from lostmotion.recording.table import Table
from lostmotion.recording.timing import EvenClock, GapError, check_step, even_clock, name_sample
from lostmotion.recording.units import TIME_UNITS, is_unit, seconds, time_unit

Array = NDArray[np.float64]
SLOWEST, FASTEST = 0.1, 1e7
"""The rates (Hz) between which a time without a unit is believed to be in seconds."""
SAME = 0.01
"""Two columns of time agree when their rates differ by less than this share."""
GUESSED = 3
"""The rank of a column of which only the name says time."""
_EPOCHS = (
    (9e17, 2e18, "ns", "ns since 1970"), (6e17, 7e17, "100ns", "steps of 100 ns since the year 1 (.NET)"),
    (1.2e17, 1.6e17, "100ns", "steps of 100 ns since 1601 (file times of Windows)"),
    (1e14, 2e15, "us", "us since 1970"), (1e11, 2e12, "ms", "ms since 1970"),
)  # fmt: skip
"""Ranges of numbers that are dates, with their unit and what they count."""
_DAYS = ((25_000.0, 80_000.0, "Excel"), (719_000.0, 780_000.0, "MATLAB"))
"""Numbers of days in these ranges are dates from about 1970 to 2100 in these programs."""
ROUNDING = 1e-12
"""The error of whole numbers that were computed, as a share of the largest one."""
_DAILY = 1e-5
"""Numbers in these ranges are days where they grow by less than this, so that the rate in s would be above 100 kHz."""


@dataclass(frozen=True, eq=False)
class FoundTime:
    """The time of a table: its column (None where a rate was given), unit, values (n,) in s, even grid, and the reason.

    `notes` are sentences on what was found or may be wrong; `guessed` tells that neither name nor unit says time.
    """

    column: str | None
    unit: str
    time: Array
    clock: EvenClock
    why: str
    notes: tuple[str, ...] = ()
    guessed: bool = False

    @property
    def says(self) -> str:
        """What is taken for time, and why."""
        if self.column is None:
            return f"time from the rate of {1.0 / self.clock.dt:.6g} Hz: {self.why}"
        return f"time in the column {self.column!r} ({self.unit}): {self.why}"


def find_time(
    table: Table,
    source: str,
    column: str | None = None,
    rate: float | None = None,
    units: Mapping[str, str] | None = None,
) -> FoundTime:
    """Return the time of a table, from the column or the rate (Hz) that is given, or else found in it.

    `units` are units by column, where they are given. `DataError` is raised where there is no time, where two
    columns contradict each other, and where the time is not even.
    """
    if rate is not None:
        if not 0.0 < rate < np.inf:
            raise DataError(f"the rate is {rate:g} Hz: give a positive number")
        clock = EvenClock(check_step(1.0 / rate, source), False, (), 0.0)
        notes = (*note_repeated_rows(table), *note_other_rate(table, source, rate))
        return FoundTime(None, "s", np.empty(0), clock, "it is given", notes)
    if column is not None:
        unit = (units or {}).get(column)
        time, found, notes = read_time(table, column, unit, source)
        clock = checked_clock(time, source, table, column, unit)
        return FoundTime(column, found, time, clock, "as given", (*notes, *clock.notes, *note_stated(table, clock)))
    return _choose_time(table, source, units or {})


def read_time(table: Table, column: str, unit: str | None, source: str) -> tuple[Array, str, tuple[str, ...]]:
    """Return a time column (n,) in s, its unit, and notes on the unit.

    Calendar times are in seconds already, whatever unit is given for them. Numbers as large as milliseconds since 1970
    are read as such.
    """
    values = table.column(column, source)
    if column in table.starts:
        odd = unit is not None and TIME_UNITS.get(unit.strip()) != "s"
        note = f"{column!r} holds dates or times of day, which need no unit: {unit!r} is not used"
        return values, "s", (note,) if odd else ()
    stated, notes = time_unit(column, table.units.get(column), unit)
    if not stated:
        stated, says = unit_by_size(values)
        notes = (f"the numbers of {column!r} are {says} by their size",) if stated else ()
    return seconds(values, stated or "s", source), stated or "s", notes


def unit_by_size(values: Array) -> tuple[str, str]:
    """Return the unit of dates that are numbers, and what they are; two empty texts for other numbers."""
    seen = values[np.isfinite(values)]
    size = float(np.median(seen)) if seen.size else 0.0
    if since := next((one[2:] for one in _EPOCHS if one[0] < size < one[1]), None):
        return since
    program = next((name for low, high, name in _DAYS if low < size < high), "")
    daily = program and seen.size > 1 and 0.0 < float(np.ptp(seen)) / (seen.size - 1) < _DAILY
    return ("d", f"dates of {program} in days") if daily else ("", "")


def _refuse_whole(time: Array, column: str, source: str) -> None:
    """Raise `DataError` for whole numbers without a unit: they may be ms, or count rows."""
    if time.size < 2 or not np.all(np.isfinite(time)) or time[1] == time[0]:
        return
    if np.abs(time - np.rint(time)).max() > ROUNDING * max(1.0, float(np.abs(time).max())):
        return
    shown = ", ".join(f"{value:.0f}" for value in time[:3])
    raise DataError(
        f"{source}: {column!r} holds whole numbers ({shown}, ...) and no unit, so it may be in ms or count rows: give"
        f" its unit (--unit {column}=s or {column}=ms of `init`; units in Python), or write it as '{column} [s]'; or"
        " give the rate"
    )


def checked_clock(
    time: Array, source: str, table: Table, column: str, unit: str | None = None, first: int = 0
) -> EvenClock:
    """Return the even grid of a time column (n,) in s, of which `first` samples were cut off at its beginning.

    A time without a stated unit is refused where it consists of whole numbers, or its rate makes no sense in seconds.
    """
    stated = unit or column in table.starts or time_unit(column, table.units.get(column), None)[0]
    stated = stated or unit_by_size(table.columns[column])[0]
    if not stated:
        _refuse_whole(time, column, source)
    try:
        clock = even_clock(time, source, table.line + first if table.line else 0)
    except GapError as err:
        raise GapError(str(err), err.time, err.stretches, column) from None
    rate = 1.0 / clock.dt
    if SLOWEST <= rate <= FASTEST or stated:
        return clock
    raise DataError(
        f"{source}: no unit is stated for the time column {column!r}, and in s the rate is {rate:.3g} Hz, which few"
        f" recorders have: give its unit (--unit {column}=ms, or time = {{ column, unit }} in a case), or the rate"
    )


def _choose_time(table: Table, source: str, units: Mapping[str, str]) -> FoundTime:
    """Return the time that is found in a table: the best candidate that is even, with its reason."""
    ranked, stated = sorted(_list_candidates(table, units), key=lambda one: one[0]), _find_stated(table, source)
    tried: list[FoundTime] = []
    posterior: DataError | None = None
    for _, name, why in ranked:
        try:
            found = find_time(table, source, name, None, units)
            found = replace(found, why=why if found.unit == "s" else why.partition(";")[0])
        except DataError as err:
            if stated is None or not _grows_evenly(table.columns.get(name, np.empty(0))):
                posterior = posterior or err
            continue
        tried.append(found)
    if tried:
        _check_agreement(tried, source)
        for note in note_stated(table, tried[0].clock):
            raise DataError(f"{source}: {note}: name the time with --time, or give --rate")
        return tried[0]
    if posterior is None and stated is not None:
        return stated
    if posterior:
        raise posterior
    return _choose_by_growth(table, source, units)


def _list_candidates(table: Table, units: Mapping[str, str]) -> list[tuple[int, str, str]]:
    """Return rank, name and reason of each column that may be time by what the file says of it."""
    found = []
    for name in (*table.full_names, *table.refused):
        unit = units.get(name) or table.units.get(name, "").partition(" since ")[0]
        if name in table.starts:
            found.append((0, name, f"it holds time stamps, the first one {table.starts[name]}"))
        elif names_time(name) and unit in TIME_UNITS:
            found.append((1, name, "its name and its unit are those of time"))
        elif unit in TIME_UNITS and not COUNTER.match(name):
            found.append((2, name, "its unit is one of time"))
        elif names_time(name) and unit and not is_unit(unit):
            found.append((GUESSED, name, f"its name is one of time; its unit {unit!r} is none that is known, so s"))
        elif names_time(name) and not unit:
            found.append((GUESSED, name, "its name is one of time; no unit is stated, so s"))
        elif not unit and not names_other(name) and (says := unit_by_size(table.columns.get(name, np.empty(0)))[1]):
            found.append((GUESSED, name, f"its numbers are {says} by their size"))
    return found


def _check_agreement(found: list[FoundTime], source: str) -> None:
    """Raise `DataError` where a second column of time has another rate than the first one."""
    first = found[0]
    for other in found[1:]:
        if abs(other.clock.dt / first.clock.dt - 1.0) > SAME:
            raise DataError(
                f"{source}: two columns may be time: {first.column!r} gives {1.0 / first.clock.dt:.4g} Hz and "
                f"{other.column!r} {1.0 / other.clock.dt:.4g} Hz: name one with --time (or time = in a case)"
            )


def _choose_by_growth(table: Table, source: str, units: Mapping[str, str]) -> FoundTime:
    """Return the only column that grows evenly without being a counter, where no name and no unit says time."""
    growing: list[str] = []
    counters: list[str] = []
    for name in table.full_names:
        values = table.columns[name]
        named = names_other(name) and not name.endswith("]")  # `X[0]` is a column of a matrix
        if table.units.get(name) or named or not _grows_evenly(values):
            continue
        (counters if _counts(name, values) else growing).append(name)
    listed = ", ".join((*table.full_names, *table.refused))
    if len(growing) == 1:
        found = find_time(table, source, growing[0], None, units)
        why = "it alone grows evenly; neither name nor unit says time, so s is a guess"
        return replace(found, why=why, guessed=True)
    rows = f"; {counters[0]!r} counts rows, and not seconds" if counters else ""
    several = f"; {', '.join(map(repr, growing))} grow evenly" if growing else ""
    raise DataError(
        f"no column of {source} has the name or the unit of a time or grows evenly as time does (there are {listed}"
        f"{rows}{several}): give --time COLUMN, or --rate HZ"
    )


def _grows_evenly(values: Array) -> bool:
    if values.size < 3 or not np.all(np.isfinite(values)):
        return False
    steps = np.diff(values)
    return bool(np.all(steps > 0.0) and np.max(steps) < 1.1 * np.median(steps))


def _counts(name: str, values: Array) -> bool:
    """Return whether a column counts rows or pulses: by its name, or because it holds whole numbers."""
    return COUNTER.match(name) is not None or bool(np.all(values == np.rint(values)))


def _find_stated(table: Table, source: str) -> FoundTime | None:
    """Return the time from the sampling rate that the file states; `DataError` where it states two, None for none."""
    for words, rate in table.rates.items():
        for other, another in table.rates.items():
            if abs(another / rate - 1.0) > SAME:
                raise DataError(
                    f"{source}: two sampling rates are stated: {words} ({rate:.6g} Hz), and {other} ({another:.6g} Hz):"
                    " give --rate HZ"
                )
    words, rate = next(iter(table.rates.items()), ("", 0.0))
    if not words:
        return None
    clock = EvenClock(check_step(1.0 / rate, source), False, (), 0.0)
    return FoundTime(None, "s", np.empty(0), clock, words, note_repeated_rows(table))


def note_stated(table: Table, clock: EvenClock) -> Iterator[str]:
    """Yield a note on a sampling rate that the file states and that is not that of its time."""
    for words, rate in table.rates.items():
        if abs(1.0 / (clock.dt * rate) - 1.0) > SAME:
            yield f"{words}, and the time has {1.0 / clock.dt:.6g} Hz: one of them is wrong"
            return


def note_other_rate(table: Table, source: str, rate: float) -> Iterator[str]:
    """Yield a note on a time, or on a stated rate, that is not the rate (Hz) that is given."""
    yield from note_stated(table, EvenClock(1.0 / rate, False, (), 0.0))
    try:
        found = _choose_time(replace(table, rates={}), source, {})
    except DataError:
        return
    other = 1.0 / found.clock.dt
    if not found.guessed and abs(other / rate - 1.0) > SAME:
        yield f"the rate that is given is {rate:.6g} Hz, and {found.column!r} has {other:.6g} Hz: one of them is wrong"


def note_repeated_rows(table: Table) -> tuple[str, ...]:
    """Return a note on rows that repeat the one before them, which a given rate would count as samples.

    Rows of a machine at rest repeat too: there must be two columns that hardly ever repeat a value elsewhere.
    """
    names = table.full_names
    size = max((table.columns[name].size for name in names), default=0)
    columns = [c for name in names if (c := table.columns[name]).size == size and size > 2 and np.ptp(c) > 0.0]
    same = [np.diff(column) == 0.0 for column in columns]
    sharp = [one for one in same if one.mean() < SAME]
    if len(sharp) < 2:
        return ()
    rows = np.flatnonzero(np.all(same, axis=0))
    if not rows.size:
        return ()
    where = name_sample(int(rows[0]) + 1, table.line)
    return (
        f"{rows.size} rows repeat the row before them (the first is {where}): a rate counts each of them as a sample: "
        "remove them",
    )
