"""Arrays in structures, groups and lists, as MAT, HDF5 and UFF files hold them, as one table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.recording.table import Table, make_table

Array = NDArray[np.float64]
KINDS = "fiub"
"""NumPy kinds of numbers in a column: real, integer, boolean."""


def table_of_nested(content: Mapping[str, object], units: Mapping[str, str] | None = None) -> Table:
    """Return the table of some arrays; the unit of a two-dimensional array is that of its columns."""
    columns = dict(_flatten_all(content))
    known = {name: (units or {}).get(name) or (units or {}).get(name.rpartition("[")[0], "") for name in columns}
    return make_table(columns, known)


def _flatten_all(content: Mapping[str, object]) -> Iterator[tuple[str, Array]]:
    for name, value in content.items():
        yield from _flatten(name, value)


def _flatten(name: str, value: Any) -> Iterator[tuple[str, Array]]:
    if isinstance(value, Mapping):
        yield from _flatten_all({f"{name}.{key}": item for key, item in value.items()})
    elif isinstance(value, (list, tuple)) and any(np.ndim(item) for item in value if not isinstance(item, Mapping)):
        yield from _flatten_all({f"{name}[{i}]": item for i, item in enumerate(value)})
    elif not isinstance(value, (str, bytes)):
        yield from _list_series(name, np.squeeze(np.asarray(value)))


def _list_series(name: str, array: NDArray[Any]) -> Iterator[tuple[str, Array]]:
    if array.dtype.kind not in KINDS:
        return
    if array.ndim == 1:
        yield name, array.astype(np.float64)
    elif array.ndim == 2:
        rows = array if array.shape[0] < array.shape[1] else array.T
        yield from ((f"{name}[{i}]", row.astype(np.float64)) for i, row in enumerate(rows))
