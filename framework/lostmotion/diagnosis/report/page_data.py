"""The data of the page of a diagnosis: the result and its arrays, read once."""

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
from lostmotion.settings import Settings, restore
from lostmotion.storage import load_arrays, load_json, require_files

RERUN_HINT = "run `lostmotion diagnose` again"


@dataclass(frozen=True, eq=False)
class Drawable:
    """The dataset of a result in the form that figures use: numeric arrays and text labels by variable name."""

    data: xr.Dataset

    @cached_property
    def arrays(self) -> Mapping[str, Array]:
        """The numeric variables."""
        return {str(n): np.asarray(v.values, dtype=float) for n, v in self._select_variables("fiub")}

    @cached_property
    def labels(self) -> Mapping[str, tuple[str, ...]]:
        """The text variables."""
        return {
            str(n): tuple(_decode_label(one) for one in v.values.ravel()) for n, v in self._select_variables("OSUT")
        }

    @cached_property
    def units(self) -> Mapping[str, str]:
        """The units of the numeric variables; an empty string where a variable has none."""
        return {str(n): str(v.attrs.get("units", "")) for n, v in self._select_variables("fiub")}

    @cached_property
    def long_names(self) -> Mapping[str, str]:
        """The long names of the numeric variables."""
        return {str(n): str(v.attrs.get("long_name", "")) for n, v in self._select_variables("fiub")}

    def has(self, *names: str) -> bool:
        """Return whether every array of `names` exists and has at least one finite value."""
        return all(name in self.arrays and bool(np.isfinite(self.arrays[name]).any()) for name in names)

    def _select_variables(self, kinds: str) -> list[tuple[object, xr.Variable]]:
        return [(name, one) for name, one in self.data.variables.items() if one.dtype.kind in kinds]


@dataclass(frozen=True, eq=False)
class Evidence(Drawable):
    """A diagnosis and its dataset."""

    result: Diagnosis

    def provides(self, name: str) -> bool:
        """Return whether a key of the result, or an array, of this name exists and is not empty."""
        return bool(getattr(self.result, name, None)) or self.has(name)

    @property
    def augmented(self) -> bool:
        """Whether something was found, so that there are a model before and a model after."""
        return bool(self.result.found)

    @cached_property
    def settings(self) -> Settings:
        """The settings with which the diagnosis was made."""
        return restore(self.result.provenance.settings.get("thresholds"))

    @property
    def response_unit(self) -> str:
        """The unit of the response."""
        return self.units.get("response", "")

    def truth(self, name: str) -> float:
        """Return the true value of a parameter, or NaN where it is not known."""
        known = self.result.truth.get(name)
        return float(known) if isinstance(known, int | float) else float("nan")


def read_evidence(folder: Path) -> Evidence:
    """Return the data in a folder written by `lostmotion diagnose`; the arrays may be absent.

    Raises `DataError` with the key of `diagnosis.json` that does not have the expected form.
    """
    page = folder / "diagnosis.json"
    require_files(folder, [page.name], "lostmotion diagnose CASE.toml")
    result = from_plain(Diagnosis, load_json(page, RERUN_HINT), str(page))
    return make_evidence(result, load_optional_arrays(folder / "arrays.nc", RERUN_HINT))


def load_optional_arrays(path: Path, again: str) -> xr.Dataset:
    """Return the dataset of a file, empty where there is none; `again` ends the message about a damaged file."""
    return load_arrays(path, again) if path.is_file() else xr.Dataset()


def make_evidence(result: Diagnosis, data: xr.Dataset) -> Evidence:
    """Return a diagnosis and its dataset in the form that figures and pages use."""
    return Evidence(data, result)


def _decode_label(label: object) -> str:
    return label.decode("utf-8", "replace") if isinstance(label, bytes) else str(label)
