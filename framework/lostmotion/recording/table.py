"""The content of a file: columns of numbers, their units, and the first stamps of columns of time stamps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError, nearest
from lostmotion.quantities import spell_unit
from lostmotion.recording.joined import join_times
from lostmotion.recording.units import name_and_unit

Array = NDArray[np.float64]
SHOWN = 12


@dataclass(frozen=True, eq=False)
class Table:
    """Numeric columns by name, each (n,); lengths may differ between columns.

    `units` holds the unit of a column, where there is one. A column of time stamps is in seconds from its first stamp,
    and `starts` holds that stamp (ISO date and time, or the time alone where there is no date). `refused` holds the
    reason of each column that cannot be read, which matters only where this column is needed. `line` is the line of the
    first row in its file, 0 where that is unknown; `rates` are sampling rates (Hz) that the file states beside its
    columns, by the words that say so. A column with a unit in its name, `Force [N]`, is also available as
    `Force`, unless another column has that name: both refer to the same array. Full names come first.
    """

    columns: Mapping[str, Array]
    units: Mapping[str, str] = field(default_factory=dict)
    starts: Mapping[str, str] = field(default_factory=dict)
    refused: Mapping[str, str] = field(default_factory=dict)
    line: int = 0
    rates: Mapping[str, float] = field(default_factory=dict)

    @property
    def full_names(self) -> tuple[str, ...]:
        """The name of each column as written in the file, without its second name."""
        seen: dict[int, str] = {}
        for name, column in self.columns.items():
            seen.setdefault(id(column), name)
        return tuple(seen.values())

    @property
    def unread(self) -> tuple[str, ...]:
        """The reasons of the columns that cannot be read, each once."""
        return tuple(dict.fromkeys(self.refused.values()))

    def column(self, name: str, source: str) -> Array:
        """Return a column (n,); raise `DataError` with the reason where there is none; `source` is the file."""
        if name in self.columns:
            return self.columns[name]
        if name in self.refused:
            raise DataError(self.refused[name])
        listed = [*self.columns][:SHOWN]
        more = f" and {len(self.columns) - SHOWN} more" if len(self.columns) > SHOWN else ""
        raise DataError(
            f"{source} has no column of numbers named {name!r}: it has {', '.join(listed)}{more}"
            f"{nearest(name, self.columns)}; name one of these"
        )


def make_table(
    columns: Mapping[str, Array],
    units: Mapping[str, str] | None = None,
    starts: Mapping[str, str] | None = None,
    refused: Mapping[str, str] | None = None,
    line: int = 0,
) -> Table:
    """Return a table in which each column has the unit that is stated for it, or else the one in its name.

    This is the one rule for units, for files of every format and for data frames. Columns with a unit in their name are
    available without it too. Times in several columns are joined to one.
    """
    begun, why, joined = starts or {}, refused or {}, join_times(columns)
    columns = {**columns, **{name: time for name, time in joined.items() if name not in columns}}
    parted = {name: name_and_unit(name) for name in (*columns, *why)}
    known = {name: spell_unit((units or {}).get(name, "")) or spell_unit(parted[name][1]) for name in columns}
    known |= dict.fromkeys((*begun, *joined), "s")
    count = Counter([*parted, *(short for name, (short, _) in parted.items() if short != name)])
    also = {short: name for name, (short, _) in parted.items() if short != name and count[short] == 1}
    return Table(
        {**columns, **{short: columns[name] for short, name in also.items() if name in columns}},
        {name: unit for name, unit in (known | {s: known.get(n, "") for s, n in also.items()}).items() if unit},
        {**begun, **{short: begun[name] for short, name in also.items() if name in begun}},
        {**why, **{short: why[name] for short, name in also.items() if name in why}},
        line,
    )
