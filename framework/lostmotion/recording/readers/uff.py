"""Functions in Universal files (data set 58). This is the only module that uses pyuff."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lostmotion.errors import DataError
from lostmotion.recording.limits import TEXT, check_bytes
from lostmotion.recording.nested import table_of_nested
from lostmotion.recording.table import Table


def read_uff(path: Path) -> Table:
    """Return the functions by their first id line, where that is unique, and by their number: `58[0]`."""
    import pyuff

    check_bytes(path.stat().st_size, path.name, TEXT)
    with path.open("rb") as raw:
        if sum(line.rstrip() == b"    -1" for line in raw) % 2:  # pyuff skips a set without an end silently
            raise DataError(f"{path.name}: the last data set has no end: the file is incomplete, export it again")
    file = pyuff.UFF(str(path))
    numbers = [i for i, kind in enumerate(file.get_set_types()) if int(kind) == 58]
    sets = [file.read_sets(i) for i in numbers]
    found = {f"58[{k}]": s["data"] for k, s in enumerate(sets)}
    ids = [str(s.get("id1") or "").strip() for s in sets]
    units = {f"58[{k}]": str(s.get("ordinate_axis_units_lab") or "").strip() for k, s in enumerate(sets)}
    for k, (name, s) in enumerate(zip(ids, sets, strict=True)):
        if name and ids.count(name) == 1:
            found[name], units[name] = s["data"], units[f"58[{k}]"]
    if sets and "time" not in found and all(np.array_equal(s["x"], sets[0]["x"]) for s in sets):
        found["time"] = sets[0]["x"]
        units["time"] = str(sets[0].get("abscissa_axis_units_lab") or "").strip()
    return table_of_nested(found, {name: unit for name, unit in units.items() if unit.upper() != "NONE"})
