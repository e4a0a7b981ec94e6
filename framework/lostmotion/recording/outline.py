"""A guess at the roles of the columns of an unknown table: time, drive, response, and the quantity of each column.

The quantity follows from the unit of a column, or from its name where there is no unit. A user has to confirm the
result: only the command that writes a first case uses it.
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
"""The quantities of a column, in the order in which its unit is compared with them."""
NAMES: Mapping[str, re.Pattern[str]] = {
    "force": re.compile(r"force|load ?cell|torque|^f([_ \d]|$)|^tau|moment|^u\d*$|drive|excit|brake", re.IGNORECASE),
    "acceleration": re.compile(r"acc|^a([_ \d]|$)|accel", re.IGNORECASE),
    "velocity": re.compile(r"(?<!tra)(?<!le)vel|speed|^v([_ \d]|$)|omega|rpm", re.IGNORECASE),
    "position": re.compile(r"pos|disp|angle|enc|travel|gauge|laser|^[xqy]([_ \d]|$)|theta|phi|stroke", re.IGNORECASE),
}
TIME = re.compile(r"^(t|time|zeit|seconds?|timestamp)([_ \[(.]|$)", re.IGNORECASE)
FOOT = re.compile(r"base|table|ground|foot|shaker|support|reference|(^|[_ ])ref", re.IGNORECASE)
READ = re.compile(r"cell|sensor|measured|reaction", re.IGNORECASE)
"""Names of a force that is a reading and not a drive."""
DRIVES = re.compile(r"drive|input|excit|motor|command|hammer|^u\d*$", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class OutlinedColumn:
    """A column of a table: its values (n,), its unit in the file ("" where it has none), and its quantity.

    `kind` is one of `KINDS`, or "" where it is unknown; `sure` tells that it follows from the unit.
    """

    name: str
    values: Array
    unit: str
    kind: str
    sure: bool

    @property
    def lost(self) -> int:
        """The number of missing readings."""
        return int(np.count_nonzero(~np.isfinite(self.values)))

    @property
    def moves(self) -> bool:
        """Whether the values change at all."""
        seen = self.values[np.isfinite(self.values)]
        return seen.size > 1 and bool(np.ptp(seen) > 0.0)

    @property
    def stated_unit(self) -> str:
        """The unit for the case file: that of the file, or the SI unit of the supposed quantity."""
        return self.unit if self.sure else SI[self.kind or "position"]

    @property
    def turns(self) -> bool:
        """Whether the unit is one of rotation."""
        return bool(self.kind) and ROTATES[si_factor(self.stated_unit, self.kind)[1]] == "rotation"


@dataclass(frozen=True, eq=False)
class Outline:
    """The supposed roles in a table: time column (None where the rate was given), sampling step (s), other columns.

    `drive` is None where no column seems to be a drive.
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
    def base_driven(self) -> bool:
        """Whether the drive is a motion of the base."""
        return self.drive is not None and self.drive.kind in ("position", "acceleration")


@dataclass(frozen=True)
class GivenRoles:
    """The roles that a user gives: columns by role, the rate (Hz), and units by column."""

    time: str | None = None
    rate: float | None = None
    drive: str | None = None
    response: str | None = None
    units: Mapping[str, str] | None = None


def outline_table(path: Path, roles: GivenRoles) -> Outline:
    """Return the supposed roles of the columns in the file `path`; `DataError` where a role cannot be found."""
    table, source = read_table(path), Path(path).name
    units = roles.units or {}
    for name in filter(None, (roles.time, roles.drive, roles.response, *units)):
        if name not in table.columns and not (name == roles.drive == "none"):
            listed = ", ".join(table.full_names)
            raise DataError(f"{source} has no column {name!r}{nearest(name, table.columns)}: it has {listed}")
    time = None if roles.rate else roles.time or _find_time(table, source)
    unit = time_unit(time, table.units.get(time), None)[0] if time else "s"
    samples = table.columns[time].size if time else _most_common_size(table)
    dt = even_clock(seconds(table.columns[time], unit, source), source).dt if time else 1.0 / (roles.rate or 1.0)
    others = [name for name in table.full_names if time is None or table.columns[name] is not table.columns[time]]
    columns = tuple(_outline_column(table, n, units.get(n)) for n in others if table.columns[n].size == samples)
    drive, response = _find_roles(columns, roles, source)
    return Outline(source, time, unit, dt, samples, columns, drive, response)


def _most_common_size(table: Table) -> int:
    sizes = [table.columns[name].size for name in table.full_names]
    return max(set(sizes), key=sizes.count)


def _find_time(table: Table, source: str) -> str:
    """Return the time column: it grows evenly, and has the name or the unit of a time where one of them has."""
    grows = [name for name in table.full_names if _grows_evenly(table.columns[name])]
    stamped = [name for name in grows if name in table.starts or table.units.get(name) in TIME_UNITS]
    called = [name for name in grows if TIME.match(name)]
    if not (stamped or called or grows):
        raise DataError(
            f"no column of {source} grows evenly as time does (there are {', '.join(table.full_names)}): give --time"
            " COLUMN, or --rate HZ"
        )
    return (called or stamped or grows)[0]


def _grows_evenly(values: Array) -> bool:
    if values.size < 3 or not np.all(np.isfinite(values)):
        return False
    steps = np.diff(values)
    return bool(np.all(steps > 0.0) and np.max(steps) < 3.0 * np.median(steps))


def _outline_column(table: Table, name: str, stated: str | None) -> OutlinedColumn:
    unit, values = stated or table.units.get(name, ""), table.columns[name]
    kind = next((kind for kind in KINDS if unit and _has_quantity(unit, kind)), "")
    if kind:
        return OutlinedColumn(name, values, unit, kind, sure=True)
    if stated:
        raise DataError(f"the unit {stated!r} of {name!r} measures none of {', '.join(KINDS)}: write for instance 'mm'")
    called = next((kind for kind, pattern in NAMES.items() if pattern.search(name)), "")
    return OutlinedColumn(name, values, unit, called, sure=False)


def _has_quantity(unit: str, kind: str) -> bool:
    try:
        si_factor(unit, kind)
    except DataError:
        return False
    return True


def _find_roles(
    columns: Sequence[OutlinedColumn], roles: GivenRoles, source: str
) -> tuple[OutlinedColumn | None, OutlinedColumn]:
    """Return the column of the drive, or None, and the column of the response."""
    by_name = {one.name: one for one in columns}
    moving = [one for one in columns if one.moves]
    drive = by_name.get(roles.drive or "") or (None if roles.drive == "none" else _find_drive(moving, roles.response))
    motions = [one for one in moving if one is not drive and one.kind in ("position", "velocity", "acceleration")]
    rest = [one for one in moving if one is not drive and one.kind in ("", "force")]
    response = by_name.get(roles.response or "") or next(iter(motions or rest), None)
    if response is None:
        listed = ", ".join(f"{one.name} ({one.kind or 'unknown'})" for one in columns) or "none besides time"
        raise DataError(f"{source} has no column that may be a response (columns: {listed}): give --response COLUMN")
    if not response.kind:
        response = replace(response, kind="position")
    return (replace(drive, kind="force") if drive and not drive.kind else drive), response


def _find_drive(moving: Sequence[OutlinedColumn], response: str | None) -> OutlinedColumn | None:
    """Return the most likely drive: a force named as a drive, another force, a base motion, a column named as a drive.

    A force from a load cell is considered after a base motion, since it is then a response to that motion.
    """
    free = [one for one in moving if one.name != response]
    forces = [one for one in free if one.kind == "force"]
    feet = [one for one in free if one.kind in ("position", "acceleration") and FOOT.search(one.name)]
    called = [one for one in free if DRIVES.search(one.name)]
    applied = [one for one in forces if not READ.search(one.name)]
    return next(iter([*(one for one in applied if one in called), *applied, *feet, *forces, *called]), None)
