"""The largest Lyapunov exponent from how whole neighbourhoods part."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Literal

import numpy as np

from lostmotion.contracts import Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_plugins.quantifiers.divergence import Pairs, States, sought
from lostmotion_plugins.quantifiers.exponent import exponent

SHELLS = (2, 5, 12)
"""The last neighbour of each shell, by closeness: the farther ones say how growth changes with distance."""


@dataclass(frozen=True)
class Kantz(Quantifier[Series]):
    """Mean logarithmic divergence of neighbourhoods: Kantz, Phys. Lett. A 185 (1994) 77-87.

    Neighbourhoods hold the same number of points everywhere, so that dense and sparse parts of the motion weigh
    alike: with one radius for all, what is read is 3 % farther off. They are followed in shells, from the nearest to
    the twelfth point, and fitted together. `average="logarithm"` takes the mean of logarithms over the neighbours;
    `"distance"` is the paper's logarithm of the mean distance, which large pairs saturate sooner.
    """

    average: Literal["logarithm", "distance"] = "logarithm"
    references: int = 1800
    name: ClassVar[str] = "lyapunov_kantz"
    paper: ClassVar[str] = "Kantz, Phys. Lett. A 185 (1994) 77-87"
    unit: ClassVar[str] = "1/s"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        return exponent(data, self._pairs, before=self.average == "distance")

    def _pairs(self, made: States, steps: int, share: float) -> Pairs:
        """Return shells as groups, padded to the same size."""
        found = sought(made, steps, round(share * self.references), SHELLS[-1])
        groups = np.full((len(found.wanted), len(SHELLS), SHELLS[-1]), -1)
        for g, (first, last) in enumerate(pairwise((0, *SHELLS))):
            groups[:, g, : last - first] = found.groups[:, first:last, 0]
        return Pairs(found.wanted, groups, found.limit, found.repeats)
