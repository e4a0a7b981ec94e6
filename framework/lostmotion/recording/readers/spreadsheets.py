"""Spreadsheets of Excel and LibreOffice. This is the only module that uses calamine."""

from __future__ import annotations

import csv
import tempfile
from datetime import date, datetime, time, timedelta
from pathlib import Path
from typing import Any

from lostmotion.errors import DataError
from lostmotion.recording.cells import is_filled
from lostmotion.recording.table import Table
from lostmotion.recording.text import read_text


def read_sheet(path: Path) -> Table:
    """Return the table of the only sheet that holds numbers; its rows are read as the lines of a text table are."""
    import python_calamine as calamine

    book = calamine.CalamineWorkbook.from_path(str(path))
    sheets = {name: book.get_sheet_by_name(name).to_python(skip_empty_area=False) for name in book.sheet_names}
    for holds in (_is_number, lambda cell: isinstance(cell, str) and is_filled(cell)):  # numbers, or texts of numbers
        filled = {name: rows for name, rows in sheets.items() if any(holds(cell) for row in rows for cell in row)}
        if filled:
            break
    if len(filled) > 1:
        raise DataError(
            f"{path.name} has {len(filled)} sheets with numbers ({', '.join(filled)}): save the one with the recording"
            " by itself, as xlsx or csv"
        )
    rows: list[list[Any]] = next(iter(filled.values()), [])
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / path.name
        with copy.open("w", encoding="utf-8", newline="") as stream:
            csv.writer(stream, delimiter=";").writerows([_write_cell(cell) for cell in row] for row in rows)
        return read_text(copy)


def _is_number(cell: Any) -> bool:
    return isinstance(cell, (int, float)) and not isinstance(cell, bool)


def _write_cell(cell: Any) -> str:
    """Return a cell as a text table has it."""
    if isinstance(cell, timedelta):
        return repr(cell.total_seconds())
    if isinstance(cell, (date, time, datetime)):
        return cell.isoformat(" ") if isinstance(cell, datetime) else cell.isoformat()
    return repr(float(cell)) if _is_number(cell) else " ".join(str(cell).split())
