"""The largest Lyapunov exponent from the divergence of neighbourhoods."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Literal

import numpy as np

from lostmotion.contracts import Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_chaos.quantifiers.divergence import Pairs, States, find_pairs
from lostmotion_chaos.quantifiers.exponent import estimate_exponent

SHELLS = (2, 5, 12)
"""The rank of the last neighbour of each shell; the farther shells show how growth changes with distance."""


@dataclass(frozen=True)
class Kantz(Quantifier[Series]):
    """Mean logarithmic divergence of neighbourhoods: Kantz, Phys. Lett. A 185 (1994) 77-87.

    Neighbourhoods have the same number of points everywhere, so that dense and sparse parts of the motion have the
    same weight; with one radius for all, the error is 3 % larger. They are followed in shells, from the nearest to the
    twelfth point, and fitted together. `average="logarithm"` takes the mean of logarithms over the neighbours;
    `"distance"` takes the paper's logarithm of the mean distance, which saturates sooner because of distant pairs.
    """

    average: Literal["logarithm", "distance"] = "logarithm"
    references: int = 1800
    name: ClassVar[str] = "lyapunov_kantz"
    paper: ClassVar[str] = "Kantz, Phys. Lett. A 185 (1994) 77-87"
    unit: ClassVar[str] = "1/s"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        return estimate_exponent(data, self._gather_pairs, before=self.average == "distance")

    def _gather_pairs(self, made: States, steps: int, share: float) -> Pairs:
        """Return pairs whose groups are the shells, padded to the same size."""
        found = find_pairs(made, steps, round(share * self.references), SHELLS[-1])
        groups = np.full((len(found.wanted), len(SHELLS), SHELLS[-1]), -1)
        for g, (first, last) in enumerate(pairwise((0, *SHELLS))):
            groups[:, g, : last - first] = found.groups[:, first:last, 0]
        return Pairs(found.wanted, groups, found.limit, found.repeats)
