"""The largest Lyapunov exponent from how nearest neighbours part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from lostmotion.contracts import Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_plugins.quantifiers.divergence import Pairs, States, sought
from lostmotion_plugins.quantifiers.divergence_classic import classical
from lostmotion_plugins.quantifiers.exponent import exponent

RANKS = (1, 2, 4, 6, 10)
"""Which neighbours are followed, by closeness: the farther ones say how growth changes with distance."""


@dataclass(frozen=True)
class Rosenstein(Quantifier[Series]):
    """Mean logarithmic divergence of neighbours: Rosenstein, Collins, De Luca, Physica D 65 (1993) 117-134.

    `recipe="refined"` follows the neighbours of five ranks across the flow, fits them together with a term for their
    size, and states an interval. `recipe="classical"` is the paper's: nearest neighbours, their whole distance, a
    straight line from `begin` to `end` (s); its interval is that of blocks of the record, and knows no bias.
    """

    recipe: Literal["refined", "classical"] = "refined"
    references: int = 1800
    begin: float = 0.0
    end: float = 0.0
    name: ClassVar[str] = "lyapunov_rosenstein"
    paper: ClassVar[str] = "Rosenstein, Collins, De Luca, Physica D 65 (1993) 117-134"
    unit: ClassVar[str] = "1/s"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        if self.recipe == "classical":
            return classical(data, self.begin, self.end)
        return exponent(data, self._pairs)

    def _pairs(self, made: States, steps: int, share: float) -> Pairs:
        found = sought(made, steps, round(share * self.references), RANKS[-1])
        groups = np.ascontiguousarray(found.groups[:, [r - 1 for r in RANKS]])
        return Pairs(found.wanted, groups, found.limit, found.repeats)
