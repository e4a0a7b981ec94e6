"""Whether the values of a channel can be used: refusals as errors, oddities as notes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.spec import Hold
from lostmotion.results import percent

Array = NDArray[np.float64]
FEWEST = 100
"""Samples below which nothing can be said."""
LOST = 0.05
"""Share of the response that may be missing: the filter bridges it."""
BRIDGE, BRIDGED = 3, 0.01
"""Lost samples of an input in a row, and their share of all, up to which (below which) they are interpolated."""
REGULAR = 0.95
"""Share of the readings that must lie on every k-th row for a sensor to be called slower."""
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
    check_finite(values, what, source)
    notes = _check_missing(np.isnan(values), what, source, may_miss)
    _check_seen(values, what, source)
    return notes


def check_finite(values: Array, what: str, source: str) -> None:
    """Refuse samples (n,) that are infinite; NaN is another matter."""
    if np.isinf(values).any():
        where = int(np.argmax(np.isinf(values)))
        raise DataError(
            f"{source}: {what} is infinite at sample {where}: correct it, or cut it out with t_start, t_end"
        )


def _check_seen(values: Array, what: str, source: str) -> None:
    """Refuse readings that no sensor shows, and such as never change."""
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


def check_sensor(values: Array, what: str, source: str, *, dt: float | None = None) -> tuple[str, ...]:
    """Return notes on the readings (n,) of a sensor, NaN where none was taken, of which there may be any share.

    At least `FEWEST` readings are wanted. A sensor that is read in every k-th row is called so, with its rate where the
    step `dt` (s) of the rows is given. `DataError` for too few readings and for such as cannot be used.
    """
    check_finite(values, what, source)
    taken = np.flatnonzero(~np.isnan(values))
    if not taken.size:
        raise DataError(f"{source}: {what} has no reading at all: check the sensor, or leave it out of the case")
    if taken.size < FEWEST:
        raise DataError(
            f"{source}: {what} has {taken.size} readings in {values.size} rows, at least {FEWEST} are wanted: record "
            "longer, or leave the sensor out of the case"
        )
    _check_seen(values, what, source)
    return _note_taken(taken, values.size, what, dt)


def _note_taken(taken: NDArray[np.intp], n: int, what: str, dt: float | None) -> tuple[str, ...]:
    every = int(np.median(np.diff(taken)))
    held = np.bincount(taken % every).max()
    if every > 1 and held >= REGULAR * taken.size and held >= REGULAR * (np.ptp(taken) // every + 1):
        rate = f" ({1.0 / (every * dt):.6g} Hz)" if dt else ""
        return (f"{what} has a reading in every {_ordinal(every)} row{rate}",)
    lost = n - taken.size
    if not lost:
        return ()
    share = f"{lost} of {n} samples ({lost / n:.2g} of all) are NaN"
    if lost < LOST * n:
        missing = np.ones(n, dtype=bool)
        missing[taken] = False
        return (f"{what}: {share}, at most {longest_run(missing)} in a row; they are bridged, not filled",)
    return (f"{what}: {share}, at no regular distance; the filter goes without a reading there",)


def _ordinal(number: int) -> str:
    ending = "th" if number % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(number % 10, "th")
    return f"{number}{ending}"


def bridged(values: Array, what: str, source: str, hold: Hold) -> tuple[Array, tuple[str, ...]]:
    """Return an input (n,) with its single lost samples filled, and notes: the model is driven by all of them.

    A smooth input is interpolated by a cubic spline (de Boor 1978), a held one keeps its previous value. At the ends
    the nearest value is kept. `DataError` for more than `BRIDGE` lost samples in a row, or `BRIDGED` of all.
    """
    missing = np.isnan(values)
    if not missing.any():
        return values, ()
    if longest_run(missing) > BRIDGE or missing.sum() >= BRIDGED * values.size:
        _refuse_lost(missing, what, source)
    there = np.flatnonzero(~missing)
    filled, lost = values.copy(), np.flatnonzero(missing)
    before = there[np.clip(np.searchsorted(there, lost) - 1, 0, there.size - 1)]
    filled[lost] = values[before]
    inside = lost[(lost > there[0]) & (lost < there[-1])]
    if hold == "smooth" and inside.size:
        from scipy.interpolate import CubicSpline

        filled[inside] = CubicSpline(there, values[there])(inside)
    how = "interpolated" if hold == "smooth" else "given the value before"
    found = f"{what}: {_found(missing)}, at most {longest_run(missing)} in a row"
    return filled, (f"{found}; they are {how}, since the model is driven by them",)


def _found(missing: NDArray[np.bool_]) -> str:
    count = int(missing.sum())
    return f"{count} of {missing.size} samples ({count / missing.size:.2g} of all) are NaN"


def _refuse_lost(missing: NDArray[np.bool_], what: str, source: str) -> None:
    raise DataError(
        f"{source}: {what}: {_found(missing)}, the first at sample {int(np.argmax(missing))}, {longest_run(missing)} "
        f"in a row; all are wanted, since the model is driven by them; up to {BRIDGE} in a row, and fewer than "
        f"{percent(BRIDGED)} of all, are interpolated: fill them, or cut them out with t_start and t_end"
    )


def _check_missing(missing: NDArray[np.bool_], what: str, source: str, may_miss: bool) -> tuple[str, ...]:
    count = int(missing.sum())
    if not count:
        return ()
    if not may_miss:
        _refuse_lost(missing, what, source)
    found, first = _found(missing), int(np.argmax(missing))
    if count >= LOST * missing.size:
        raise DataError(
            f"{source}: {what}: {found}, the first at sample {first}; fewer than {percent(LOST)} are wanted: "
            "cut them out with t_start and t_end, or record again"
        )
    return (f"{what}: {found}, at most {longest_run(missing)} in a row; they are bridged, not filled",)


def filled(values: Array) -> Array:
    """Return the samples (n,) with straight lines over the lost ones, which are NaN."""
    there = np.flatnonzero(np.isfinite(values))
    return np.asarray(np.interp(np.arange(values.size), there, values[there]), dtype=float)


def longest_run(flags: NDArray[np.bool_]) -> int:
    """Return the length (samples) of the longest unbroken run of true flags (n,)."""
    return int(np.diff(runs_of(flags), axis=1).max(initial=0))


def runs_of(flags: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Return where unbroken runs of true flags (n,) begin and end, (runs, 2): from the first sample up to the last."""
    return np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8))).reshape(-1, 2)


def note_stuck(values: Array, what: str) -> Iterator[str]:
    """Yield a note when the samples (n,) sit at their largest or smallest value in runs of three or more."""
    for word, edge in (("largest", np.nanmax(values)), ("smallest", np.nanmin(values))):
        lengths = np.diff(runs_of(values == edge), axis=1)
        stuck = int(lengths[lengths >= 3].sum())
        if stuck > CLIPPED * values.size:
            yield (
                f"{what} sits at its {word} value {edge:.6g} for {stuck} of {values.size} samples: "
                "the sensor may be clipped or stuck, or the machine rests there"
            )
