"""Whether the values of a channel can be used: refusals as errors, oddities as notes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError

Array = NDArray[np.float64]
FEWEST = 100
"""Samples below which nothing can be said."""
LOST = 0.05
"""Share of the response that may be missing: the filter bridges it."""
CLIPPED = 0.01
LARGEST = 1e30
"""No sensor shows more, in whatever unit."""


def check_length(n: int, source: str) -> None:
    """Refuse a recording of fewer than `FEWEST` samples."""
    if n < FEWEST:
        raise DataError(
            f"{source} has {n} samples, at least {FEWEST} are wanted: record longer, or widen t_start and t_end"
        )


def check_values(values: Array, what: str, source: str, *, may_miss: bool) -> tuple[str, ...]:
    """Return notes on the samples (n,) of a channel; values that cannot be used are refused."""
    if np.isinf(values).any():
        where = int(np.argmax(np.isinf(values)))
        raise DataError(
            f"{source}: {what} is infinite at sample {where}: correct it, or cut it out with t_start, t_end"
        )
    notes = _check_missing(np.isnan(values), what, source, may_miss)
    seen = values[~np.isnan(values)]
    if np.abs(seen).max() > LARGEST:
        where = int(np.nanargmax(np.abs(values)))
        raise DataError(
            f"{source}: {what} is {values[where]:.3g} at sample {where}, and no sensor shows that: correct or "
            "empty it, or cut it out with t_start, t_end"
        )
    if np.ptp(seen) <= 1e-12 * np.max(np.abs(seen)):
        raise DataError(
            f"{source}: {what} is constant ({seen[0]:.6g}) over {values.size} samples: check the sensor and the column"
        )
    return notes


def _check_missing(missing: NDArray[np.bool_], what: str, source: str, may_miss: bool) -> tuple[str, ...]:
    count = int(missing.sum())
    if not count:
        return ()
    found = f"{count} of {missing.size} samples ({count / missing.size:.2g} of all) are NaN"
    first = int(np.argmax(missing))
    if not may_miss:
        raise DataError(
            f"{source}: {what}: {found}, the first at sample {first}; all are wanted, since the model is driven by "
            "them: fill them, or cut them out with t_start and t_end"
        )
    if count >= LOST * missing.size:
        raise DataError(
            f"{source}: {what}: {found}, the first at sample {first}; fewer than {LOST:.0%} are wanted: "
            "cut them out with t_start and t_end, or record again"
        )
    return (f"{what}: {found}, at most {longest_run(missing)} in a row; they are bridged, not filled",)


def longest_run(flags: NDArray[np.bool_]) -> int:
    """Return the length (samples) of the longest unbroken run of true flags (n,)."""
    return max(_runs(flags), default=0)


def _runs(flags: NDArray[np.bool_]) -> list[int]:
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8)))
    return [int(n) for n in edges[1::2] - edges[::2]]


def note_stuck(values: Array, what: str) -> Iterator[str]:
    """Yield a note when the samples (n,) sit at their largest or smallest value in runs of three or more."""
    for word, edge in (("largest", np.nanmax(values)), ("smallest", np.nanmin(values))):
        stuck = sum(run for run in _runs(values == edge) if run >= 3)
        if stuck > CLIPPED * values.size:
            yield (
                f"{what} sits at its {word} value {edge:.6g} for {stuck} of {values.size} samples: "
                "the sensor may be clipped or stuck, or the machine rests there"
            )
