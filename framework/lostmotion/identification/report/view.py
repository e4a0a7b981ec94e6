"""The data of the page of an identification: its JSON file and its draws, read once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.report.words import Scale, choose_scale, to_words, words_of
from lostmotion.results import Array
from lostmotion.results.identification import Identification
from lostmotion.storage import load_arrays, load_result, require_files

if TYPE_CHECKING:
    import xarray as xr

RERUN_HINT = "run `lostmotion identify` again"
RESULT, DRAWS = "identification.json", "posterior.nc"
MAX_CORNER_PARAMETERS = 8
"""Largest number of parameters in the figure of all pairs."""


@dataclass(frozen=True)
class IdentificationView:
    """The data of figures and page: the result, and draws (walkers, steps) with their units by name."""

    result: Identification
    draws: Mapping[str, Array]
    units: Mapping[str, str]

    def describe_name(self, name: str) -> str:
        """Return the displayed name of a parameter: symbols of the model unchanged, other names in words."""
        return to_words(name) if name in self.result.noise else words_of(name)

    @property
    def names(self) -> tuple[str, ...]:
        """The sampled parameters, noise levels last."""
        return tuple(name for name in self.result.rows if name in self.draws)

    @property
    def joint(self) -> tuple[str, ...]:
        """The parameters in the figure of all pairs: all, or only those of the machine where there are too many."""
        own = tuple(name for name in self.names if name in self.result.parameters)
        return (self.names if len(self.names) <= MAX_CORNER_PARAMETERS else own)[:MAX_CORNER_PARAMETERS]

    @property
    def converged(self) -> bool:
        """Whether the chain meets all convergence criteria."""
        return self.result.converged

    def truth(self, name: str) -> float:
        """Return the known value of a parameter, or NaN."""
        return self.result.truth.get(name, float("nan"))

    def scale(self, name: str) -> Scale:
        """Return the unit scale in which the values of a parameter are easy to read."""
        return choose_scale(float(np.median(np.abs(self.draws[name]))), self.units[name])


def read_identification(folder: Path) -> IdentificationView:
    """Return the data that `lostmotion identify` wrote into a folder."""
    require_files(folder, [RESULT, DRAWS], "lostmotion identify CASE.toml")
    result = load_result(Identification, folder / RESULT, RERUN_HINT)
    return make_view(result, load_arrays(folder / DRAWS, RERUN_HINT, group="posterior"))


def make_view(result: Identification, data: xr.Dataset) -> IdentificationView:
    """Return the data of figures and page from a result and its draws, the group `posterior`."""
    draws = {str(name): np.asarray(v.values, dtype=float) for name, v in data.data_vars.items()}
    units = {str(n): str(v.attrs.get("units", "1")) for n, v in data.data_vars.items()}
    return IdentificationView(result, draws, units)
