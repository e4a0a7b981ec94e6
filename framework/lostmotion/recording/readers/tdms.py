"""Recordings of LabVIEW in TDMS files. This is the only module that uses npTDMS."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.recording.arrays import table_of_arrays
from lostmotion.recording.table import Table


def read_tdms(path: Path) -> Table:
    """Return the channels, each by its own name where that is unique, else as `group/channel`.

    A channel is a column with the unit in `unit_string`. Channels with a step `wf_increment` get a column `time`, or
    one for each channel if their times differ.
    """
    from nptdms import TdmsFile

    held = [one for group in TdmsFile.read(path).groups() for one in group.channels()]
    names = [one.name for one in held]
    columns: dict[str, Any] = {}
    units: dict[str, str] = {}
    times: dict[str, Any] = {}
    for one in held:
        name = one.name if names.count(one.name) == 1 else f"{one.group_name}/{one.name}"
        columns[name], units[name] = one[:], str(one.properties.get("unit_string") or "")
        step, size = float(one.properties.get("wf_increment") or 0.0), len(one)
        if step > 0.0 and size:
            times[name] = float(one.properties.get("wf_start_offset") or 0.0) + step * np.arange(size)
    columns |= _merge_times(times, columns)
    return table_of_arrays(columns, units | dict.fromkeys((name for name in columns if name not in units), "s"))


def _merge_times(times: dict[str, Any], columns: dict[str, Any]) -> dict[str, Any]:
    """Return one column `time` if all channels have the same times, else a column `NAME.time` for each channel."""
    first = next(iter(times.values()), None)
    if first is None:
        return {}
    if "time" not in columns and all(np.array_equal(one, first) for one in times.values()):
        return {"time": first}
    return {f"{name}.time": one for name, one in times.items()}
