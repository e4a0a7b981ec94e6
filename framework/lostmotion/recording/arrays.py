"""Columns in memory as numbers: of NumPy, its masked arrays, pandas, polars, xarray, and lists.

A reading that is masked or missing becomes NaN, and never the number that lies under a mask. Calendar times become
seconds from the first one.
"""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime, time, timedelta
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.arguments import describe
from lostmotion.errors import DataError
from lostmotion.recording.numbers import read_number
from lostmotion.recording.stamps import Stamps, is_stamp
from lostmotion.recording.table import Table, make_table

Array = NDArray[np.float64]


def table_of_arrays(columns: Mapping[str, Any], units: Mapping[str, str]) -> Table:
    """Return the table of columns (n,) in memory with their stated units; the reason is kept of each unusable one."""
    found: dict[str, Array] = {}
    starts: dict[str, str] = {}
    refused: dict[str, str] = {}
    for name, value in columns.items():
        try:
            found[name], start = to_numbers(name, value)
        except DataError as err:
            refused[name] = str(err)
            continue
        starts |= {name: start} if start else {}
    return make_table(found, units, starts, refused)


def to_numbers(name: str, value: Any) -> tuple[Array, str]:
    """Return a column as numbers (n,), and its first calendar time in ISO format, "" for a column of numbers."""
    try:
        array = _to_array(value)
    except TypeError as err:  # a container that is no array, as a Dataset of xarray
        raise DataError(f"{name!r} is {describe(value)}: give an array of floats") from err
    if array.dtype.kind in "OTU":
        array = _unwrap(name, array)
    if array.dtype.kind == "U":
        return _read_stamps(name, [str(cell) for cell in array.ravel().tolist()])
    if array.dtype.kind in "mM":
        return _since_first(name, array)
    if array.dtype.kind not in "fiub":
        raise DataError(f"{name!r} holds {array.dtype} instead of numbers: give an array of floats")
    numbers = np.array(np.ma.filled(np.ma.asarray(array).astype(float), np.nan))
    if numbers.ndim == 2 and 1 in numbers.shape:  # a column of MATLAB
        numbers = numbers.ravel()
    if numbers.ndim != 1:
        raise DataError(f"{name!r} has the shape {numbers.shape}: expected one number for each sample, (n,)")
    return numbers, ""


def _to_array(value: Any) -> NDArray[Any]:
    """Return an array, with its mask where it has one."""
    if isinstance(value, np.ma.MaskedArray):
        return value
    if isinstance(value, (list, tuple)) and any(isinstance(item, datetime) for item in value):
        return np.array([*value, None], dtype=object)[:-1]
    try:
        return np.asarray(value.to_numpy() if hasattr(value, "to_numpy") else value)
    except ValueError:  # rows of different lengths
        return np.empty(0, dtype=complex)


def _unwrap(name: str, array: NDArray[Any]) -> NDArray[Any]:
    """Return an array of objects (None, pandas.NA, numbers, words, times of any zone) as one of a plain type."""
    import pandas as pd

    cells = np.ma.getdata(array).astype(object)
    if cells.ndim != 1:
        raise DataError(f"{name!r} has the shape {cells.shape}: expected one number for each sample, (n,)")
    cells[np.ma.getmaskarray(array)] = None
    series = pd.Series(cells.tolist(), dtype=object)
    there = series[series.notna()]
    if len(there) and there.map(lambda cell: isinstance(cell, datetime)).all():
        zoned = pd.to_datetime(series, utc=True)
        return np.asarray(zoned.dt.tz_localize(None).to_numpy())
    if len(there) and there.map(lambda cell: isinstance(cell, timedelta)).all():
        return np.asarray(pd.to_timedelta(series).to_numpy())
    if len(there) and there.map(lambda cell: isinstance(cell, time)).all():
        series = series.map(lambda cell: cell.isoformat(), na_action="ignore")
        there = series[series.notna()]
    if len(there) and there.map(lambda cell: isinstance(cell, str)).all():
        return np.array(["" if gone else cell for cell, gone in zip(series, series.isna(), strict=True)], dtype=str)
    try:
        return np.asarray(series.to_numpy(dtype=float, na_value=np.nan))
    except (TypeError, ValueError) as err:
        kinds = ", ".join(sorted({type(cell).__name__ for cell in there}))
        raise DataError(f"{name!r} holds {kinds} instead of numbers: give an array of floats") from err


def _read_stamps(name: str, cells: list[str]) -> tuple[Array, str]:
    lost = [not cell.strip() for cell in cells]
    wrong = next((cell for cell, gone in zip(cells, lost, strict=True) if not gone and not is_stamp(cell)), None)
    if wrong is not None or all(lost):
        shown = "empty words" if wrong is None else f"the word {wrong[:40]!r}"
        hint = "" if wrong is None or read_number(wrong, "comma") is None else ", in pandas with decimal=',' or '.'"
        raise DataError(f"{name!r} holds {shown} instead of numbers: give an array of floats{hint}")
    stamps = Stamps()
    stamps.add(cells, lost)
    return stamps.finish("the data", name)


def _since_first(name: str, array: NDArray[Any]) -> tuple[Array, str]:
    """Return calendar times or durations as seconds from the first one, NaN where one is missing."""
    if array.ndim != 1:
        raise DataError(f"{name!r} has the shape {array.shape}: expected one time for each sample, (n,)")
    lost = np.isnat(np.ma.getdata(array)) | np.ma.getmaskarray(array)
    if lost.all():
        raise DataError(f"{name!r} holds no time: give one for each sample")
    plain = np.ma.getdata(array)
    first = plain[int(np.argmin(lost))]
    seconds = np.asarray((plain - first) / np.timedelta64(1, "s"), dtype=float)
    seconds[lost] = np.nan
    start = str(np.datetime_as_string(first, unit="auto")) if array.dtype.kind == "M" else "0"
    return seconds, start
