"""Parquet files, as data frames and data sets of robots are stored. This is the only module that uses pyarrow."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.recording.arrays import table_of_arrays
from lostmotion.recording.limits import check_numbers
from lostmotion.recording.table import Table


def read_parquet(path: Path) -> Table:
    """Return the columns by name; a column of lists `a` of equal length becomes `a[0]`, `a[1]`, ...

    The unit of a column is `unit` or `units` in the metadata of its field.
    """
    import pyarrow.parquet as parquet

    with parquet.ParquetFile(path) as file:
        check_numbers(file.metadata.num_rows * file.metadata.num_columns, path.name)
        table = file.read(use_threads=False)
    columns: dict[str, Any] = {}
    units: dict[str, str] = {}
    for name, column in zip(table.column_names, table.columns, strict=True):
        parts = _split_lists(name, column)
        told = table.schema.field(name).metadata or {}
        columns |= parts
        units |= dict.fromkeys(parts, (told.get(b"unit") or told.get(b"units") or b"").decode("utf-8", "replace"))
    return table_of_arrays(columns, units)


def _split_lists(name: str, column: Any) -> dict[str, Any]:
    """Return the column by its name, or one column for each place in its lists."""
    if not hasattr(column.type, "value_type"):
        return {name: column.to_pandas()}
    rows = column.to_pylist()
    sizes = {len(row) for row in rows if row is not None}
    if len(sizes) != 1:
        return {}
    (size,) = sizes
    filled = [row if row is not None else [None] * size for row in rows]
    return {f"{name}[{i}]": np.array([row[i] for row in filled], dtype=object) for i in range(size)}
