"""What a page of an identification is drawn from: its JSON and its draws, read once and never written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lostmotion.report.posteriors import words_of
from lostmotion.report.words import Scale, readable, spoken
from lostmotion.results import Array
from lostmotion.storage import load_arrays, load_json, require_files

if TYPE_CHECKING:
    import xarray as xr

AGAIN = "run `lostmotion identify` again"
MOST = 8
"""Parameters that a figure of all pairs can hold."""


@dataclass(frozen=True)
class Sampled:
    """What an identification wrote: the facts of its JSON, and draws (walkers, steps) with their unit by name."""

    facts: Mapping[str, Any]
    draws: Mapping[str, Array]
    units: Mapping[str, str]

    @property
    def rows(self) -> dict[str, Mapping[str, Any]]:
        """What is said of each parameter, noise levels last."""
        return {**self.facts["parameters"], **self.facts.get("noise", {})}

    def word(self, name: str) -> str:
        """Return the name of a parameter as a reader meets it: symbols of the model as they are, the rest in words."""
        return spoken(name) if name in self.facts.get("noise", {}) else words_of(name)

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters that were drawn, noise levels last."""
        return tuple(name for name in self.rows if name in self.draws)

    @property
    def joint(self) -> tuple[str, ...]:
        """The parameters that are drawn against one another: all, or those of the machine where all are too many."""
        own = tuple(name for name in self.names if name in self.facts["parameters"])
        return (self.names if len(self.names) <= MOST else own)[:MOST]

    @property
    def converged(self) -> bool:
        """Whether the chain may be believed."""
        return bool(self.facts["converged"])

    def truth(self, name: str) -> float:
        """Return the known value of a parameter, or NaN."""
        known = self.facts.get("truth", {}).get(name)
        return float(known) if isinstance(known, int | float) else float("nan")

    def scale(self, name: str) -> Scale:
        """Return the scale in which a parameter is easy to read."""
        return readable(float(np.median(np.abs(self.draws[name]))), self.units[name])


def read_sampled(folder: Path) -> Sampled:
    """Return what `lostmotion identify` wrote into a folder."""
    require_files(folder, ["identification.json", "posterior.nc"], "lostmotion identify CASE.toml")
    facts = load_json(folder / "identification.json", AGAIN)
    return sampled_of(facts, load_arrays(folder / "posterior.nc", AGAIN, group="posterior"))


def sampled_of(facts: Mapping[str, Any], data: xr.Dataset) -> Sampled:
    """Return facts and draws, the group `posterior`, as figures and page take them."""
    draws = {str(name): np.asarray(v.values, dtype=float) for name, v in data.data_vars.items()}
    return Sampled(facts, draws, {str(n): str(v.attrs.get("units", "1")) for n, v in data.data_vars.items()})
