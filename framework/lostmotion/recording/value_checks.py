"""Whether the values of a channel can be used: refusals as errors, oddities as notes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.spec import Hold
from lostmotion.results import percent
from lostmotion.settings import DEFAULT

Array = NDArray[np.float64]
FEWEST = 100
"""The least number of samples of a recording."""
LOST = 0.05
"""The share of the response that may be missing; the filter bridges it."""
BRIDGE, BRIDGED = 3, 0.01
"""Lost samples of an input are interpolated up to this number in a row, and below this share of all samples."""
REGULAR = 0.95
"""A sensor counts as slower than the others when at least this share of its readings is on every k-th row."""
LARGEST = 1e30
"""The largest reading of a sensor that is accepted, in any unit."""


def check_length(n: int, source: str) -> None:
    """Raise `DataError` for fewer than `FEWEST` samples."""
    if n < FEWEST:
        raise DataError(
            f"{source} has {n} samples, at least {FEWEST} are needed: record longer, or widen t_start and t_end"
        )


def check_values(values: Array, what: str, source: str, *, may_miss: bool) -> tuple[str, ...]:
    """Return notes on the samples (n,) of a channel; raise `DataError` where they cannot be used."""
    check_finite(values, what, source)
    notes = _check_missing(np.isnan(values), what, source, may_miss)
    _check_moves(values, what, source)
    return notes


def check_finite(values: Array, what: str, source: str) -> None:
    """Raise `DataError` for samples (n,) that are infinite or beyond any sensor; NaN is accepted here."""
    if np.isinf(values).any():
        where = int(np.argmax(np.isinf(values)))
        raise DataError(
            f"{source}: {what} is infinite at sample {where}: correct it, or cut it out with t_start, t_end"
        )
    if (np.abs(values) > LARGEST).any():
        where = int(np.nanargmax(np.abs(values)))
        raise DataError(
            f"{source}: {what} is {values[where]:.3g} at sample {where}, which no sensor can show: correct or "
            "empty it, or cut it out with t_start, t_end"
        )


def _check_moves(values: Array, what: str, source: str) -> None:
    """Raise `DataError` for a constant channel."""
    seen = values[~np.isnan(values)]
    if np.ptp(seen) <= 1e-12 * np.max(np.abs(seen)):
        raise DataError(
            f"{source}: {what} is constant ({seen[0]:.6g}) over {values.size} samples: check the sensor and the column"
        )


def check_sensor(values: Array, what: str, source: str, *, dt: float | None = None) -> tuple[str, ...]:
    """Return notes on the readings (n,) of a sensor; any share of them may be missing (NaN).

    At least `FEWEST` readings are needed. The note on a sensor that is read in every k-th row contains its rate where
    the step `dt` (s) of the rows is given. `DataError` is raised for too few or unusable readings.
    """
    check_finite(values, what, source)
    taken = np.flatnonzero(~np.isnan(values))
    if not taken.size:
        raise DataError(f"{source}: {what} has no reading at all: check the sensor, or leave it out of the case")
    if taken.size < FEWEST:
        raise DataError(
            f"{source}: {what} has {taken.size} readings in {values.size} rows, at least {FEWEST} are needed: record "
            "longer, or leave the sensor out of the case"
        )
    _check_moves(values, what, source)
    return _note_missing(taken, values.size, what, dt)


def _note_missing(taken: NDArray[np.intp], n: int, what: str, dt: float | None) -> tuple[str, ...]:
    every = int(np.median(np.diff(taken)))
    held = np.bincount(taken % every).max()
    if every > 1 and held >= REGULAR * taken.size and held >= REGULAR * (np.ptp(taken) // every + 1):
        rate = f" ({1.0 / (every * dt):.6g} Hz)" if dt else ""
        return (f"{what} has a reading in every {_format_ordinal(every)} row{rate}",)
    lost = n - taken.size
    if not lost:
        return ()
    share = f"{lost} of {n} samples ({lost / n:.2g} of all) are NaN"
    if lost < LOST * n:
        missing = np.ones(n, dtype=bool)
        missing[taken] = False
        return (f"{what}: {share}, at most {longest_run(missing)} in a row; they are bridged, not filled",)
    return (f"{what}: {share}, at irregular distances; the filter continues without a reading there",)


def _format_ordinal(number: int) -> str:
    ending = "th" if number % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(number % 10, "th")
    return f"{number}{ending}"


def fill_input(values: Array, what: str, source: str, hold: Hold) -> tuple[Array, tuple[str, ...]]:
    """Return an input (n,) with isolated lost samples filled, and notes; the model needs a value at each sample.

    A smooth input is interpolated by a cubic spline (de Boor 1978), a held one keeps its previous value. At the ends
    the nearest value is used. `DataError` is raised for more than `BRIDGE` lost samples in a row, or `BRIDGED` of all.
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
    how = "interpolated" if hold == "smooth" else "given the previous value"
    found = f"{what}: {_format_count(missing)}, at most {longest_run(missing)} in a row"
    return filled, (f"{found}; they are {how}, since the model is driven by them",)


def _format_count(missing: NDArray[np.bool_]) -> str:
    count = int(missing.sum())
    return f"{count} of {missing.size} samples ({count / missing.size:.2g} of all) are NaN"


def _refuse_lost(missing: NDArray[np.bool_], what: str, source: str) -> None:
    raise DataError(
        f"{source}: {what}: {_format_count(missing)}, the first at sample {int(np.argmax(missing))}, "
        f"{longest_run(missing)} in a row; all are needed, since the model is driven by them; "
        f"up to {BRIDGE} in a row, and fewer than {percent(BRIDGED)} of all, are interpolated: fill them, "
        "or cut them out with t_start and t_end"
    )


def _check_missing(missing: NDArray[np.bool_], what: str, source: str, may_miss: bool) -> tuple[str, ...]:
    count = int(missing.sum())
    if not count:
        return ()
    if not may_miss:
        _refuse_lost(missing, what, source)
    found, first = _format_count(missing), int(np.argmax(missing))
    if count >= LOST * missing.size:
        raise DataError(
            f"{source}: {what}: {found}, the first at sample {first}; fewer than {percent(LOST)} are allowed: "
            "cut them out with t_start and t_end, or record again"
        )
    return (f"{what}: {found}, at most {longest_run(missing)} in a row; they are bridged, not filled",)


def fill_lost(values: Array) -> Array:
    """Return the samples (n,) with lost ones (NaN) replaced by linear interpolation."""
    there = np.flatnonzero(np.isfinite(values))
    return np.asarray(np.interp(np.arange(values.size), there, values[there]), dtype=float)


def longest_run(flags: NDArray[np.bool_]) -> int:
    """Return the length (samples) of the longest run of true flags (n,)."""
    return int(np.diff(runs_of(flags), axis=1).max(initial=0))


def runs_of(flags: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Return the first sample and the sample after the last of each run of true flags (n,), (runs, 2)."""
    return np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8))).reshape(-1, 2)


def note_stuck(values: Array, what: str, share: float = DEFAULT.recording.stuck) -> Iterator[str]:
    """Yield a note when the samples (n,) stay at their largest or smallest value in runs of three or more.

    These runs must hold more than a `share` of all samples.
    """
    for word, edge in (("largest", np.nanmax(values)), ("smallest", np.nanmin(values))):
        lengths = np.diff(runs_of(values == edge), axis=1)
        stuck = int(lengths[lengths >= 3].sum())
        if stuck > share * values.size:
            yield (
                f"{what} stays at its {word} value {edge:.6g} for {stuck} of {values.size} samples: "
                "the sensor may be clipped or stuck, or the machine rests there"
            )
