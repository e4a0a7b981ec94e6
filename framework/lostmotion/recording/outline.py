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
from lostmotion.recording.clock import FoundTime, find_time
from lostmotion.recording.column_names import KINDS, kind_named
from lostmotion.recording.counts import centre_position, holds_counts, sum_changes
from lostmotion.recording.formats import read_table
from lostmotion.recording.table import Table
from lostmotion.recording.time_gaps import Stretch, cut_at_gaps, cut_table, describe_cut
from lostmotion.recording.timing import GapError
from lostmotion.recording.units import check_name, kinds_of, name_and_unit

Array = NDArray[np.float64]
FOOT = re.compile(r"base|table|ground|foot|shaker|support|reference|(^|[_ ])ref", re.IGNORECASE)
READ = re.compile(r"cell|sensor|measured|reaction", re.IGNORECASE)
"""Names of a force that is a reading and not a drive."""
DRIVES = re.compile(r"drive|input|excit|motor|command|hammer|^u\d*$", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class OutlinedColumn:
    """A column of a table: its values (n,), its unit in the file ("" where it has none), and its quantity.

    `kind` is one of `KINDS`, or "" where it is unknown; `sure` tells that it follows from the unit. `summed` tells that
    the values are sums of the changes in the file.
    """

    name: str
    values: Array
    unit: str
    kind: str
    sure: bool
    summed: bool = False

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

    `drive` is None where no column seems to be a drive; `unread` are the reasons of columns that cannot be read. Where
    the time has gaps, ``stretches` are the parts that are used, and `cut` says so; columns are of the longest part.
    """

    file: str
    time: str | None
    time_unit: str
    dt: float
    samples: int
    columns: tuple[OutlinedColumn, ...]
    drive: OutlinedColumn | None
    response: OutlinedColumn
    clock: FoundTime
    unread: tuple[str, ...] = ()
    stretches: tuple[Stretch, ...] = ()
    cut: str = ""

    @property
    def base_driven(self) -> bool:
        """Whether the drive is a motion of the base."""
        return self.drive is not None and self.drive.kind in ("position", "acceleration")


@dataclass(frozen=True)
class GivenRoles:
    """The roles that a user gives: columns by role, the rate (Hz), units by column, and columns of `differences`."""

    time: str | None = None
    rate: float | None = None
    drive: str | None = None
    response: str | None = None
    units: Mapping[str, str] | None = None
    differences: tuple[str, ...] = ()


def outline_table(path: Path, roles: GivenRoles) -> Outline:
    """Return the supposed roles of the columns in the file `path`; `DataError` where a role cannot be found.

    A recording with gaps in its time is cut there.
    """
    table, source = read_table(path), Path(path).name
    units = roles.units or {}
    for name in filter(None, (roles.time, roles.drive, roles.response, *units, *roles.differences)):
        if name in table.refused:
            raise DataError(table.refused[name])
        if name not in table.columns and not (name == roles.drive == "none"):
            listed = ", ".join(table.full_names)
            raise DataError(f"{source} has no column {name!r}{nearest(name, table.columns)}: it has {listed}")
    given = None if roles.rate else roles.time
    try:
        return _outline(table, source, roles, find_time(table, source, given, roles.rate, units))
    except GapError as gaps:
        return _outline_stretches(table, source, roles, gaps)


def _outline_stretches(table: Table, source: str, roles: GivenRoles, gaps: GapError) -> Outline:
    """Return the roles of the columns of a table whose time has gaps, from its longest stretch between them."""
    longest = next(iter(cut_at_gaps(gaps)), None)
    if longest is None:
        raise gaps
    part = cut_table(table, longest, gaps.time.size)
    made = _outline(part, source, roles, find_time(part, source, roles.time, None, roles.units))
    moving = [table.columns[one.name] for one in (made.drive, made.response) if one is not None]
    stretches = cut_at_gaps(gaps, moving)
    if not stretches:
        raise gaps
    return replace(made, samples=gaps.time.size, stretches=stretches, cut=describe_cut(gaps, stretches))


def _outline(table: Table, source: str, roles: GivenRoles, found: FoundTime) -> Outline:
    """Return the roles of the columns of a table with its time."""
    units, time = roles.units or {}, found.column
    samples = found.time.size if time else _most_common_size(table)
    others = [name for name in table.full_names if time is None or table.columns[name] is not table.columns[time]]
    columns = tuple(
        _outline_column(table, n, units.get(n), n in roles.differences)
        for n in others
        if table.columns[n].size == samples
    )
    drive, response = _find_roles(columns, roles, source, table.unread)
    for column in filter(None, (drive, response)):
        if column.name not in units:
            check_name(column.name, column.unit)
    if drive is None and roles.drive != "none":
        _refuse_unread_drive(table)
    return Outline(source, time, found.unit, found.clock.dt, samples, columns, drive, response, found, table.unread)


def _refuse_unread_drive(table: Table) -> None:
    """Raise `DataError` for a column that is a force by its name or unit, and cannot be read."""
    for name, why in table.refused.items():
        if kind_named(name) == "force" or "force" in kinds_of(name_and_unit(name)[1]):
            raise DataError(f"{why}; or give --drive COLUMN, or --drive none if nothing drives the machine")


def _most_common_size(table: Table) -> int:
    sizes = [table.columns[name].size for name in table.full_names]
    return max(set(sizes), key=sizes.count)


def _outline_column(table: Table, name: str, stated: str | None, summed: bool) -> OutlinedColumn:
    unit, values = stated or table.units.get(name, ""), table.columns[name]
    if summed:
        values = centre_position(sum_changes(values, repr(name), "the recording", table.line))
    kind = next(iter(kinds_of(unit)), "")
    if kind:
        return OutlinedColumn(name, values, unit, kind, True, summed)
    if stated:
        raise DataError(f"the unit {stated!r} of {name!r} measures none of {', '.join(KINDS)}: write for instance 'mm'")
    return OutlinedColumn(name, values, unit, kind_named(name), False, summed)


def _find_roles(
    columns: Sequence[OutlinedColumn], roles: GivenRoles, source: str, unread: Sequence[str]
) -> tuple[OutlinedColumn | None, OutlinedColumn]:
    """Return the column of the drive, or None, and the column of the response."""
    by_name = {one.name: one for one in columns}
    moving = [one for one in columns if one.moves]
    drive = by_name.get(roles.drive or "") or (None if roles.drive == "none" else _find_drive(moving, roles.response))
    motions = [one for one in moving if one is not drive and one.kind in ("position", "velocity", "acceleration")]
    rest = [one for one in moving if one is not drive and one.kind in ("", "force")]
    rest.sort(key=lambda one: holds_counts(one.name, one.unit, one.values))
    response = by_name.get(roles.response or "") or next(iter(motions or rest), None)
    if response is None:
        listed = ", ".join(f"{one.name} ({one.kind or 'unknown'})" for one in columns) or "none besides time"
        why = f"; not read: {unread[0]}" if unread else ""
        raise DataError(
            f"{source} has no column that may be a response (columns: {listed}{why}): give --response COLUMN"
        )
    _refuse_counts(response, source)
    if not response.kind:
        response = replace(response, kind="position")
    return (replace(drive, kind="force") if drive and not drive.kind else drive), response


def _refuse_counts(column: OutlinedColumn, source: str) -> None:
    """Raise `DataError` for counts of unknown size."""
    name = column.name
    if not column.sure and holds_counts(name, column.unit, column.values):
        raise DataError(
            f"{source}: {name!r} holds counts, whose size is unknown: give it, for instance --unit {name!r}=turn"
            f" --factor {name!r}=0.000244140625 for 4096 counts a turn; and --differences {name!r} if each row has the"
            " counts since the row before"
        )


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
