"""What a page of an identification is drawn from: its JSON and its draws, read once and never written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.report.words import Scale, readable, spoken, words_of
from lostmotion.results import Array
from lostmotion.results.identification import Identification
from lostmotion.storage import load_arrays, load_result, require_files

if TYPE_CHECKING:
    import xarray as xr

AGAIN = "run `lostmotion identify` again"
RESULT, DRAWS = "identification.json", "posterior.nc"
MOST = 8
"""Parameters that a figure of all pairs can hold."""


@dataclass(frozen=True)
class IdentificationView:
    """An identification as figures and page take it: the result, and draws (walkers, steps) with their unit by name."""

    result: Identification
    draws: Mapping[str, Array]
    units: Mapping[str, str]

    def word(self, name: str) -> str:
        """Return the name of a parameter as a reader meets it: symbols of the model as they are, the rest in words."""
        return spoken(name) if name in self.result.noise else words_of(name)

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters that were drawn, noise levels last."""
        return tuple(name for name in self.result.rows if name in self.draws)

    @property
    def joint(self) -> tuple[str, ...]:
        """The parameters that are drawn against one another: all, or those of the machine where all are too many."""
        own = tuple(name for name in self.names if name in self.result.parameters)
        return (self.names if len(self.names) <= MOST else own)[:MOST]

    @property
    def converged(self) -> bool:
        """Whether the chain may be believed."""
        return self.result.converged

    def truth(self, name: str) -> float:
        """Return the known value of a parameter, or NaN."""
        return self.result.truth.get(name, float("nan"))

    def scale(self, name: str) -> Scale:
        """Return the scale in which a parameter is easy to read."""
        return readable(float(np.median(np.abs(self.draws[name]))), self.units[name])


def read_identification(folder: Path) -> IdentificationView:
    """Return what `lostmotion identify` wrote into a folder."""
    require_files(folder, [RESULT, DRAWS], "lostmotion identify CASE.toml")
    result = load_result(Identification, folder / RESULT, AGAIN)
    return view_of(result, load_arrays(folder / DRAWS, AGAIN, group="posterior"))


def view_of(result: Identification, data: xr.Dataset) -> IdentificationView:
    """Return a result and its draws, the group `posterior`, as figures and page take them."""
    draws = {str(name): np.asarray(v.values, dtype=float) for name, v in data.data_vars.items()}
    units = {str(n): str(v.attrs.get("units", "1")) for n, v in data.data_vars.items()}
    return IdentificationView(result, draws, units)
