"""Arrays in structures, groups and lists, as MAT, HDF5 and UFF files hold them, as one table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.recording.arrays import table_of_arrays
from lostmotion.recording.stated_rate import rates_in
from lostmotion.recording.table import Table, make_table

KINDS = "fiub"
"""NumPy kinds of numbers in a column: real, integer, boolean."""
TIMES = "mMc"
"""Kinds that are converted, or refused with a reason where they are asked for: durations, dates, complex numbers."""


def table_of_nested(
    content: Mapping[str, object],
    units: Mapping[str, str] | None = None,
    attributes: Mapping[str, object] | None = None,
) -> Table:
    """Return the table of some arrays; the unit of a two-dimensional array is that of its columns.

    A sampling rate may be a single number in the content, or one of the attributes.
    """
    flat = dict(_flatten_all(content))
    columns = {name: array for name, array in flat.items() if array.dtype.kind in KINDS}
    other = table_of_arrays({name: array for name, array in flat.items() if name not in columns}, {})
    columns = {name: array.astype(np.float64) for name, array in columns.items()} | dict(other.columns)
    told = rates_in(dict(_list_single("", attributes or {})))
    single = dict(_list_single("", content))
    known = {name: (units or {}).get(name) or (units or {}).get(name.rpartition("[")[0], "") for name in columns}
    return replace(make_table(columns, known, other.starts, other.refused), rates=rates_in(single, "number") | told)


def _list_single(name: str, value: Any) -> Iterator[tuple[str, object]]:
    """Yield the single numbers and texts in a value, with their names."""
    if isinstance(value, Mapping):
        for key, item in value.items():
            yield from _list_single(f"{name}.{key}", item)
    elif isinstance(value, (str, int, float)) or (np.size(value) == 1 and np.asarray(value).dtype.kind in "fiuU"):
        yield name, value if isinstance(value, str) else np.asarray(value).reshape(-1)[0].item()


def _flatten_all(content: Mapping[str, object]) -> Iterator[tuple[str, NDArray[Any]]]:
    for name, value in content.items():
        yield from _flatten(name, value)


def _flatten(name: str, value: Any) -> Iterator[tuple[str, NDArray[Any]]]:
    if isinstance(value, Mapping):
        yield from _flatten_all({f"{name}.{key}": item for key, item in value.items()})
    elif isinstance(value, (list, tuple)) and any(np.ndim(item) for item in value if not isinstance(item, Mapping)):
        yield from _flatten_all({f"{name}[{i}]": item for i, item in enumerate(value)})
    elif not isinstance(value, (str, bytes)):
        yield from _list_series(name, np.squeeze(np.asarray(value)))


def _list_series(name: str, array: NDArray[Any]) -> Iterator[tuple[str, NDArray[Any]]]:
    """Yield the series in an array, with the fields of a table by their names: numbers, times, and complex numbers."""
    if array.dtype.names:
        for key in array.dtype.names:
            yield from _list_series(f"{name}.{key}", array[key])
    elif array.dtype.kind in KINDS + TIMES and array.ndim == 1:
        yield name, array
    elif array.dtype.kind in KINDS and array.ndim == 2:
        rows = array if array.shape[0] < array.shape[1] else array.T
        yield from ((f"{name}[{i}]", row) for i, row in enumerate(rows))
