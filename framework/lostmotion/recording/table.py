"""The content of a file: columns of numbers, their units, and the first stamps of columns of time stamps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lostmotion.recording.units import split_name

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Table:
    """Numeric columns by name, each (n,); lengths may differ between columns.

    `units` holds the unit of a column as written in the file, where there is one. A column of time stamps is in seconds
    from its first stamp, and `starts` holds that stamp (ISO date and time, or the time alone where there is no date).
    A column with a unit in its name, `Force [N]`, is also available as `Force`, unless another column has that name:
    both refer to the same array. Full names come first.
    """

    columns: Mapping[str, Array]
    units: Mapping[str, str] = field(default_factory=dict)
    starts: Mapping[str, str] = field(default_factory=dict)

    @property
    def full_names(self) -> tuple[str, ...]:
        """The name of each column as written in the file, without its second name."""
        seen: dict[int, str] = {}
        for name, column in self.columns.items():
            seen.setdefault(id(column), name)
        return tuple(seen.values())


def with_bare_names(columns: Mapping[str, Array], units: Mapping[str, str], starts: Mapping[str, str]) -> Table:
    """Return a table in which columns with a unit in their name are available without it too."""
    bare = {name: split_name(name)[0] for name in columns}
    count = Counter([*columns, *(short for name, short in bare.items() if short != name)])
    also = {short: name for name, short in bare.items() if short != name and count[short] == 1}
    return Table(
        {**columns, **{short: columns[name] for short, name in also.items()}},
        {**units, **{short: units[name] for short, name in also.items() if name in units}},
        {**starts, **{short: starts[name] for short, name in also.items() if name in starts}},
    )
