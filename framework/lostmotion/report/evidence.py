"""What a report is drawn from: facts as JSON and arrays as netCDF, read once and never written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from lostmotion.results import Array
from lostmotion.storage import load_arrays, load_json, require_files


@dataclass(frozen=True)
class Evidence:
    """Facts of a result, its numeric arrays and text coordinates, and the units and long names of the arrays."""

    facts: Mapping[str, Any]
    arrays: Mapping[str, Array]
    labels: Mapping[str, tuple[str, ...]]
    units: Mapping[str, str]
    long_names: Mapping[str, str] = field(default_factory=dict)

    def has(self, *names: str) -> bool:
        """Return whether every array of `names` is there and holds at least one finite number."""
        return all(name in self.arrays and bool(np.isfinite(self.arrays[name]).any()) for name in names)

    def fact(self, *path: str) -> Any:
        """Return the fact at a path of keys, or None where any of them is absent."""
        found: Any = self.facts
        for key in path:
            found = found.get(key) if isinstance(found, Mapping) else None
        return found

    def number(self, *path: str) -> float:
        """Return the number at a path of keys, or NaN where there is none."""
        found = self.fact(*path)
        return float(found) if isinstance(found, int | float) else float("nan")

    def unit(self, quantity: str) -> str:
        """Return the unit of `position`, `velocity`, `force` or `time`: the diagnosis's own, or that of the array."""
        return str(self.fact("units", quantity) or self.units.get(quantity, ""))

    @property
    def augmented(self) -> bool:
        """Return whether something was found, so that there is a model after beside the one before."""
        return bool(self.fact("found"))

    @property
    def response(self) -> str:
        """Return the name of the quantity that was recorded."""
        return str(self.fact("response", "quantity") or "response")

    @property
    def response_unit(self) -> str:
        """Return the unit of the response."""
        return self.units.get("response") or self.unit(self.response)


def read_evidence(folder: Path) -> Evidence:
    """Return what is in a folder written by `lostmotion diagnose`; arrays may be absent, the diagnosis may not."""
    return gathered(folder, ("diagnosis.json", "arrays.nc"), "lostmotion diagnose CASE.toml")


def gathered(folder: Path, names: tuple[str, str], command: str) -> Evidence:
    """Return the facts and the arrays that a command left in a folder; the arrays may be absent, the facts may not."""
    page, arrays = folder / names[0], folder / names[1]
    require_files(folder, [page.name], command)
    again = f"run `{' '.join(command.split()[:2])}` again"
    facts = load_json(page, again)
    return evidence_with(facts, load_arrays(arrays, again) if arrays.is_file() else xr.Dataset())


def evidence_with(facts: Mapping[str, Any], data: xr.Dataset) -> Evidence:
    """Return facts and the arrays of a dataset as figures and pages take them."""
    numeric = {str(n): v for n, v in data.variables.items() if v.dtype.kind in "fiub"}
    text = {str(n): v for n, v in data.variables.items() if v.dtype.kind in "OSUT"}
    return Evidence(
        facts=facts,
        arrays={name: np.asarray(variable.values, dtype=float) for name, variable in numeric.items()},
        labels={name: tuple(_decoded(v) for v in variable.values.ravel()) for name, variable in text.items()},
        units={name: str(variable.attrs.get("units", "")) for name, variable in numeric.items()},
        long_names={name: str(variable.attrs.get("long_name", "")) for name, variable in numeric.items()},
    )


def _decoded(label: object) -> str:
    return label.decode("utf-8", "replace") if isinstance(label, bytes) else str(label)
