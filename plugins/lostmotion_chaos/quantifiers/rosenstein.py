"""The largest Lyapunov exponent from the divergence of nearest neighbours."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from lostmotion.contracts import Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_chaos.quantifiers.divergence import Pairs, States, find_pairs
from lostmotion_chaos.quantifiers.divergence_classic import estimate_classically
from lostmotion_chaos.quantifiers.exponent import estimate_exponent

RANKS = (1, 2, 4, 6, 10)
"""Ranks of the neighbours that are followed; the farther ones show how growth changes with distance."""


@dataclass(frozen=True)
class Rosenstein(Quantifier[Series]):
    """Mean logarithmic divergence of neighbours: Rosenstein, Collins, De Luca, Physica D 65 (1993) 117-134.

    `recipe="refined"` follows neighbours of five ranks, measures distances perpendicular to the flow, and fits all
    ranks together with a term for the size of the distance; its interval includes systematic errors.
    `recipe="classical"` is the paper's: nearest neighbours, full distances, a straight line from `begin` to `end` (s);
    its interval is that of blocks of the record, without the bias of the method.
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
            return estimate_classically(data, self.begin, self.end)
        return estimate_exponent(data, self._gather_pairs)

    def _gather_pairs(self, made: States, steps: int, share: float) -> Pairs:
        found = find_pairs(made, steps, round(share * self.references), RANKS[-1])
        groups = np.ascontiguousarray(found.groups[:, [r - 1 for r in RANKS]])
        return Pairs(found.wanted, groups, found.limit, found.repeats)
