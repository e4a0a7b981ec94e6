"""Encoders without an absolute position: counts since the row before, and positions from an arbitrary zero."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.column_names import COUNTER
from lostmotion.recording.timing import name_sample

Array = NDArray[np.float64]
COUNTED = re.compile(
    r"(^|[_ .])(counts?|cnt|ticks?|pulses?|enc(oder)?|adc|raw|lsb|quad(rature)?)(?=$|[_ .\d])", re.IGNORECASE
)
"""Names of columns of counts."""
COUNTS = {"count", "counts", "digit", "digits", "LSB", "lsb", "ticks", "pulses"}
"""Units of a number that an encoder counts: its size is unknown."""


def sum_changes(changes: Array, what: str, source: str, line: int = 0) -> Array:
    """Return the position (n,) from its changes since the row before, in their unit; zero is at the first row.

    `DataError` for a change that is missing: the position behind it would be unknown.
    """
    lost = np.flatnonzero(~np.isfinite(changes))
    if lost.size:
        raise DataError(
            f"{source}: {name_sample(int(lost[0]), line)}: {what} has no change since the row before, so the position"
            " behind it is unknown: cut the recording there with t_end or t_start"
        )
    return np.asarray(np.cumsum(changes) - changes[0], dtype=float)


def centre_position(position: Array) -> Array:
    """Return a position (n,) of an arbitrary zero about its mean, which then is the first guess of the zero."""
    return np.asarray(position - np.nanmean(position), dtype=float)


def holds_counts(name: str, unit: str, values: Array) -> bool:
    """Return whether a column holds counts of unknown size: by its unit, or by its name if all are whole numbers."""
    seen = values[np.isfinite(values)]
    named = COUNTER.match(name) is not None or COUNTED.search(name) is not None
    return unit in COUNTS or (not unit and named and bool(np.all(seen == np.rint(seen))))
