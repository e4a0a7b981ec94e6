"""What an unknown table looks like: which column is time, what the others measure, which drives and which responds.

Units decide what a column measures, names where units do not. All of it is a guess that a person confirms: nothing
else in the framework uses it but the command that writes a first case.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError, nearest
from lostmotion.quantities import ROTATES, SI, si_factor
from lostmotion.recording.formats import read_table
from lostmotion.recording.table import Table
from lostmotion.recording.timing import even_clock
from lostmotion.recording.units import TIME_UNITS, seconds, time_unit

Array = NDArray[np.float64]
KINDS = ("force", "position", "velocity", "acceleration")
"""What a column may measure, in the order in which units are tried."""
NAMES: Mapping[str, re.Pattern[str]] = {
    "force": re.compile(r"force|load ?cell|torque|^f([_ \d]|$)|^tau|moment|^u\d*$|drive|excit|brake", re.IGNORECASE),
    "acceleration": re.compile(r"acc|^a([_ \d]|$)|accel", re.IGNORECASE),
    "velocity": re.compile(r"vel|speed|^v([_ \d]|$)|omega|rpm", re.IGNORECASE),
    "position": re.compile(r"pos|disp|angle|enc|travel|gauge|laser|^[xqy]([_ \d]|$)|theta|phi|stroke", re.IGNORECASE),
}
TIME = re.compile(r"^(t|time|zeit|seconds?|timestamp)([_ \[(.]|$)", re.IGNORECASE)
FOOT = re.compile(r"base|table|ground|foot|shaker|support|reference|(^|[_ ])ref", re.IGNORECASE)
READ = re.compile(r"cell|sensor|measured|reaction", re.IGNORECASE)
"""What a force is called that is measured and drives nothing."""
DRIVES = re.compile(r"drive|input|excit|motor|command|hammer|^u\d*$", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class OutlinedColumn:
    """A column of a table: its values (n,), the unit of the file ("" where it gives none), and what it measures.

    `kind` is one of `KINDS`, or "" where nothing tells; `sure` says that the unit has told.
    """

    name: str
    values: Array
    unit: str
    kind: str
    sure: bool

    @property
    def lost(self) -> int:
        """The number of readings that were not taken."""
        return int(np.count_nonzero(~np.isfinite(self.values)))

    @property
    def moves(self) -> bool:
        """Whether it ever changes."""
        seen = self.values[np.isfinite(self.values)]
        return seen.size > 1 and bool(np.ptp(seen) > 0.0)

    @property
    def said(self) -> str:
        """The unit that a case would state for it: that of the file, or the SI unit of what it seems to measure."""
        return self.unit if self.sure else SI[self.kind or "position"]

    @property
    def turns(self) -> bool:
        """Whether its unit is one of rotation."""
        return bool(self.kind) and ROTATES[si_factor(self.said, self.kind)[1]] == "rotation"


@dataclass(frozen=True, eq=False)
class Outline:
    """A table as it looks: the time column (None where the rate was given), the sampling step (s), all other columns.

    `drive` is None where nothing seems to drive the machine.
    """

    file: str
    time: str | None
    time_unit: str
    dt: float
    samples: int
    columns: tuple[OutlinedColumn, ...]
    drive: OutlinedColumn | None
    response: OutlinedColumn

    @property
    def based(self) -> bool:
        """Whether the drive is a motion of the base."""
        return self.drive is not None and self.drive.kind in ("position", "acceleration")


@dataclass(frozen=True)
class Wishes:
    """What a person says of a table: columns by their role, the rate (Hz), and units by column."""

    time: str | None = None
    rate: float | None = None
    drive: str | None = None
    response: str | None = None
    units: Mapping[str, str] | None = None


def outlined(path: Path, wishes: Wishes) -> Outline:
    """Return what the table in the file `path` looks like; `DataError` where a role cannot be told."""
    table, source = read_table(path), Path(path).name
    said = wishes.units or {}
    for name in filter(None, (wishes.time, wishes.drive, wishes.response, *said)):
        if name not in table.columns and not (name == wishes.drive == "none"):
            listed = ", ".join(table.full_names)
            raise DataError(f"{source} has no column {name!r}{nearest(name, table.columns)}: it has {listed}")
    time = None if wishes.rate else wishes.time or _time_of(table, source)
    unit = time_unit(time, table.units.get(time), None)[0] if time else "s"
    samples = table.columns[time].size if time else _usual_size(table)
    dt = even_clock(seconds(table.columns[time], unit, source), source).dt if time else 1.0 / (wishes.rate or 1.0)
    others = [name for name in table.full_names if time is None or table.columns[name] is not table.columns[time]]
    columns = tuple(_column(table, n, said.get(n)) for n in others if table.columns[n].size == samples)
    drive, response = _roles(columns, wishes, source)
    return Outline(source, time, unit, dt, samples, columns, drive, response)


def _usual_size(table: Table) -> int:
    sizes = [table.columns[name].size for name in table.full_names]
    return max(set(sizes), key=sizes.count)


def _time_of(table: Table, source: str) -> str:
    """Return the column that looks like time: by its name or its unit, and since it grows evenly."""
    grows = [name for name in table.full_names if _even(table.columns[name])]
    stamped = [name for name in grows if name in table.starts or table.units.get(name) in TIME_UNITS]
    called = [name for name in grows if TIME.match(name)]
    if not (stamped or called or grows):
        raise DataError(
            f"no column of {source} grows evenly as time does (there are {', '.join(table.full_names)}): give --time"
            " COLUMN, or --rate HZ"
        )
    return (called or stamped or grows)[0]


def _even(values: Array) -> bool:
    if values.size < 3 or not np.all(np.isfinite(values)):
        return False
    steps = np.diff(values)
    return bool(np.all(steps > 0.0) and np.max(steps) < 3.0 * np.median(steps))


def _column(table: Table, name: str, stated: str | None) -> OutlinedColumn:
    unit, values = stated or table.units.get(name, ""), table.columns[name]
    kind = next((kind for kind in KINDS if unit and _measures(unit, kind)), "")
    if kind:
        return OutlinedColumn(name, values, unit, kind, sure=True)
    if stated:
        raise DataError(f"the unit {stated!r} of {name!r} measures none of {', '.join(KINDS)}: write for instance 'mm'")
    called = next((kind for kind, pattern in NAMES.items() if pattern.search(name)), "")
    return OutlinedColumn(name, values, unit, called, sure=False)


def _measures(unit: str, kind: str) -> bool:
    try:
        si_factor(unit, kind)
    except DataError:
        return False
    return True


def _roles(
    columns: Sequence[OutlinedColumn], wishes: Wishes, source: str
) -> tuple[OutlinedColumn | None, OutlinedColumn]:
    """Return what drives the machine, if anything does, and what responds."""
    by_name = {one.name: one for one in columns}
    moving = [one for one in columns if one.moves]
    drive = by_name.get(wishes.drive or "") or (None if wishes.drive == "none" else _drive_of(moving, wishes.response))
    motions = [one for one in moving if one is not drive and one.kind in ("position", "velocity", "acceleration")]
    rest = [one for one in moving if one is not drive and one.kind in ("", "force")]
    response = by_name.get(wishes.response or "") or next(iter(motions or rest), None)
    if response is None:
        listed = ", ".join(f"{one.name} ({one.kind or 'unknown'})" for one in columns) or "none beside time"
        raise DataError(f"{source} has no column that may be a response (columns: {listed}): give --response COLUMN")
    if not response.kind:
        response = replace(response, kind="position")
    return (replace(drive, kind="force") if drive and not drive.kind else drive), response


def _drive_of(moving: Sequence[OutlinedColumn], response: str | None) -> OutlinedColumn | None:
    """Return what looks like a drive: a force that is called one, any other, the motion of a foot, what is called so.

    A force that a load cell reads comes behind the motion of a foot: there it is what the motion calls forth.
    """
    free = [one for one in moving if one.name != response]
    forces = [one for one in free if one.kind == "force"]
    feet = [one for one in free if one.kind in ("position", "acceleration") and FOOT.search(one.name)]
    called = [one for one in free if DRIVES.search(one.name)]
    applied = [one for one in forces if not READ.search(one.name)]
    return next(iter([*(one for one in applied if one in called), *applied, *feet, *forces, *called]), None)
