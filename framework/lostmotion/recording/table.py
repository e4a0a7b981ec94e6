"""What a file of columns holds: numbers, the units that stand beside them, and when time stamps begin."""

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

    `units` holds the unit of a column as the file writes it, where it does. A column of time stamps is in seconds
    from its first stamp, and `starts` holds that stamp (ISO date and time; the time alone where there is no date).
    A name with a unit in brackets, `Force [N]`, is known by its bare name `Force` as well, unless another column has
    that name: both lead to the same array. Full names come first.
    """

    columns: Mapping[str, Array]
    units: Mapping[str, str] = field(default_factory=dict)
    starts: Mapping[str, str] = field(default_factory=dict)

    @property
    def full_names(self) -> tuple[str, ...]:
        """The name of each column as the file has it, without the second names of columns."""
        seen: dict[int, str] = {}
        for name, column in self.columns.items():
            seen.setdefault(id(column), name)
        return tuple(seen.values())


def with_bare_names(columns: Mapping[str, Array], units: Mapping[str, str], starts: Mapping[str, str]) -> Table:
    """Return a table in which columns with a unit in their name are known without it as well."""
    bare = {name: split_name(name)[0] for name in columns}
    count = Counter([*columns, *(short for name, short in bare.items() if short != name)])
    also = {short: name for name, short in bare.items() if short != name and count[short] == 1}
    return Table(
        {**columns, **{short: columns[name] for short, name in also.items()}},
        {**units, **{short: units[name] for short, name in also.items() if name in units}},
        {**starts, **{short: starts[name] for short, name in also.items() if name in starts}},
    )
