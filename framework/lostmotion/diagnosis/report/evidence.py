"""What the page of a diagnosis is drawn from: the result and its arrays, read once and never written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import xarray as xr

from lostmotion.codec import from_plain
from lostmotion.results import Array
from lostmotion.results.diagnosis import Diagnosis
from lostmotion.storage import load_arrays, load_json, require_files

AGAIN = "run `lostmotion diagnose` again"


@dataclass(frozen=True, eq=False)
class Drawable:
    """The dataset behind a result, as figures take it: arrays of numbers and labels by the name of the variable."""

    data: xr.Dataset

    @cached_property
    def arrays(self) -> Mapping[str, Array]:
        """The numeric variables."""
        return {str(n): np.asarray(v.values, dtype=float) for n, v in self._of("fiub")}

    @cached_property
    def labels(self) -> Mapping[str, tuple[str, ...]]:
        """The variables of text."""
        return {str(n): tuple(_decoded(one) for one in v.values.ravel()) for n, v in self._of("OSUT")}

    @cached_property
    def units(self) -> Mapping[str, str]:
        """The units of the numeric variables; an empty string where a variable has none."""
        return {str(n): str(v.attrs.get("units", "")) for n, v in self._of("fiub")}

    @cached_property
    def long_names(self) -> Mapping[str, str]:
        """The long names of the numeric variables."""
        return {str(n): str(v.attrs.get("long_name", "")) for n, v in self._of("fiub")}

    def has(self, *names: str) -> bool:
        """Return whether every array of `names` is there and holds at least one finite number."""
        return all(name in self.arrays and bool(np.isfinite(self.arrays[name]).any()) for name in names)

    def _of(self, kinds: str) -> list[tuple[object, xr.Variable]]:
        return [(name, one) for name, one in self.data.variables.items() if one.dtype.kind in kinds]


@dataclass(frozen=True, eq=False)
class Evidence(Drawable):
    """A diagnosis, and the dataset behind it."""

    result: Diagnosis

    @property
    def augmented(self) -> bool:
        """Whether something was found, so that there is a model after beside the one before."""
        return bool(self.result.found)

    @property
    def response_unit(self) -> str:
        """The unit of the response."""
        return self.units.get("response", "")

    def truth(self, name: str) -> float:
        """Return the known value of a parameter, or NaN where it is not known."""
        known = self.result.truth.get(name)
        return float(known) if isinstance(known, int | float) else float("nan")


def read_evidence(folder: Path) -> Evidence:
    """Return what is in a folder written by `lostmotion diagnose`; arrays may be absent, the diagnosis may not.

    `DataError` says which key of `diagnosis.json` is not what this program writes.
    """
    page = folder / "diagnosis.json"
    require_files(folder, [page.name], "lostmotion diagnose CASE.toml")
    result = from_plain(Diagnosis, load_json(page, AGAIN), str(page))
    return evidence_with(result, arrays_of(folder / "arrays.nc", AGAIN))


def arrays_of(path: Path, again: str) -> xr.Dataset:
    """Return the dataset of a file, empty where there is no such file; `again` ends the sentence on a damaged one."""
    return load_arrays(path, again) if path.is_file() else xr.Dataset()


def evidence_with(result: Diagnosis, data: xr.Dataset) -> Evidence:
    """Return a diagnosis and the arrays of a dataset as figures and pages take them."""
    return Evidence(data, result)


def _decoded(label: object) -> str:
    return label.decode("utf-8", "replace") if isinstance(label, bytes) else str(label)
