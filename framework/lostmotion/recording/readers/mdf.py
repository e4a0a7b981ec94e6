"""Measurements of vehicles and test rigs in MDF files. This is the only module that uses asammdf."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.recording.arrays import table_of_arrays
from lostmotion.recording.limits import check_count
from lostmotion.recording.table import Table


def read_mdf(path: Path) -> Table:
    """Return the channels by name with their units; channels of one group share the column of its times.

    That column is `time` if there is one group, else `time 1`, `time 2`, ... A name that occurs in several groups has
    the number of its group behind it.
    """
    from asammdf import MDF

    columns: dict[str, Any] = {}
    units: dict[str, str] = {}
    with MDF(path) as file:
        groups = {number: signals for number in range(len(file.groups)) if (signals := _read_group(file, number))}
    check_count(sum(map(len, groups.values())), "channels", path.name)
    names = [one.name for signals in groups.values() for one in signals]
    for number, signals in groups.items():
        clock = "time" if len(groups) == 1 else f"time {number + 1}"
        columns[clock], units[clock] = np.asarray(signals[0].timestamps, dtype=float), "s"
        for one in signals:
            name = one.name if names.count(one.name) == 1 else f"{one.name} {number + 1}"
            columns[name], units[name] = one.samples, str(one.unit or "")
    return table_of_arrays(columns, units)


def _read_group(file: Any, number: int) -> list[Any]:
    """Return the signals of a group without that of its times."""
    group = file.groups[number]
    clock = file.masters_db.get(number)
    wanted = [(None, number, index) for index in range(len(group.channels)) if index != clock]
    return list(file.select(wanted)) if wanted else []
