"""Text files of LabVIEW, with a header for each segment. This is the only module that uses lvm_read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.errors import DataError
from lostmotion.recording.arrays import table_of_arrays
from lostmotion.recording.limits import TEXT, check_bytes
from lostmotion.recording.table import Table


def read_lvm(path: Path) -> Table:
    """Return the columns of the only segment by the names of its channels, with their units, and `time` (s).

    Without a column `X_Value`, the time follows from `X0` and `Delta_X`.
    """
    import lvm_read

    check_bytes(path.stat().st_size, path.name, TEXT)
    raw = path.read_bytes()
    text = raw.decode("utf-8-sig") if _is_utf8(raw) else raw.decode("latin-1")
    content = lvm_read.read_str(text)  # `lvm_read.read` would unpickle a file that lies beside the recording
    if content["Segments"] != 1:
        raise DataError(
            f"{path.name} has {content['Segments']} segments, one was expected: export the one with the recording"
        )
    segment = content[0]
    values, names = np.atleast_2d(segment["data"]), list(segment["Channel names"])
    clocked = names[0] == "X_Value"
    columns: dict[str, Any] = {"time": values[:, 0]} if clocked else _clock(segment, len(values))
    units = {"time": "s"}
    labels = segment.get("Y_Unit_Label", [])
    for place, name in enumerate(names[clocked:]):
        if name and name != "Comment" and place + clocked < values.shape[1]:
            columns[name] = values[:, place + clocked]
            units[name] = labels[place] if place < len(labels) else ""
    return table_of_arrays(columns, units)


def _is_utf8(raw: bytes) -> bool:
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        return False
    return True


def _clock(segment: dict[str, Any], size: int) -> dict[str, Any]:
    """Return the times that follow from the step of the first channel, if it is given."""
    step = float(next(iter(segment.get("Delta_X", [])), 0.0))
    begin = float(next(iter(segment.get("X0", [])), 0.0))
    return {"time": begin + step * np.arange(size)} if step > 0.0 else {}
