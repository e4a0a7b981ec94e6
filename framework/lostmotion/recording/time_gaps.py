"""Stretches of a recording between gaps in its time: each is a recording of its own, cut by `t_start` and `t_end`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lostmotion.recording.table import Table
from lostmotion.recording.timing import GapError
from lostmotion.recording.value_checks import FEWEST

Array = NDArray[np.float64]
SHORTEST = 0.05
"""A stretch is used if it has at least this share of the samples of the longest one."""


@dataclass(frozen=True)
class Stretch:
    """A part of a recording between two gaps: its first row, the row after its last, and the keys of a case (s)."""

    first: int
    last: int
    keys: dict[str, float]


def describe_ends(keys: Mapping[str, float]) -> str:
    """Return where a stretch begins and ends (s), in words, by its keys in a case."""
    words = {"t_start": "from", "t_end": "until"}
    return " ".join(f"{words[key]} {value:.12g} s" for key, value in keys.items())


def cut_at_gaps(gaps: GapError, columns: Sequence[Array] = ()) -> tuple[Stretch, ...]:
    """Return the stretches between gaps that can be used, the longest first: the last recordings are held out.

    A stretch is left out if it is much shorter than the longest one, has too few samples, or if one of the `columns`
    (n,) does not move in it.
    """
    longest = max(last - first for first, last in gaps.stretches)
    least = max(FEWEST, SHORTEST * longest)
    kept = [
        (first, last)
        for first, last in gaps.stretches
        if last - first >= least and all(_moves(column[first:last]) for column in columns)
    ]
    kept.sort(key=lambda rows: rows[0] - rows[1])  # stable: equally long ones stay in their order
    return tuple(Stretch(first, last, _make_keys(gaps.time, first, last)) for first, last in kept)


def _moves(values: Array) -> bool:
    seen = values[np.isfinite(values)]
    return seen.size >= FEWEST and bool(np.ptp(seen) > 0.0)


def _make_keys(time: Array, first: int, last: int) -> dict[str, float]:
    """Return the ends of a stretch that are not those of the recording."""
    start = {"t_start": float(f"{time[first]:.15g}")} if first else {}
    end = {"t_end": float(f"{time[last - 1]:.15g}")} if last < time.size else {}
    return start | end


def cut_table(table: Table, stretch: Stretch, rows: int) -> Table:
    """Return a table with the rows of a stretch; columns that have not `rows` values stay as they are."""
    parts: dict[int, Array] = {}  # two names of one column stay one
    for column in table.columns.values():
        if column.size == rows:
            parts.setdefault(id(column), column[stretch.first : stretch.last])
    columns = {name: parts.get(id(column), column) for name, column in table.columns.items()}
    return replace(table, columns=columns, line=table.line + stretch.first if table.line else 0)


def describe_cut(gaps: GapError, stretches: Sequence[Stretch]) -> str:
    """Return a sentence on the gaps of a time, and on the stretches that are used."""
    count = len(gaps.stretches) - 1
    largest = max(gaps.time[first] - gaps.time[first - 1] for first, _ in gaps.stretches[1:])
    where = "; ".join(describe_ends(one.keys) for one in stretches)
    lost = gaps.time.size - sum(one.last - one.first for one in stretches)
    rest = f" ({lost} rows of other stretches are not used)" if lost else ""
    parts = f"cut into {len(stretches)} recordings, the longest first" if len(stretches) > 1 else "one stretch is used"
    return f"{count} {'gap' if count == 1 else 'gaps'} in the time, up to {largest:.4g} s: {parts}: {where}{rest}"
