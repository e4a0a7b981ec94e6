"""The largest Lyapunov exponent from how whole neighbourhoods part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from lostmotion.contracts import Quantifier, Series
from lostmotion.results import Estimate
from lostmotion_plugins.quantifiers.divergence import Pairs, States, sought
from lostmotion_plugins.quantifiers.exponent import exponent

MOST = 8
"""Neighbours looked at for each reference."""
QUANTILES = (0.2, 0.4, 0.6)
"""The radii hold this share of the distances at which a neighbourhood is just large enough."""


@dataclass(frozen=True)
class Kantz(Quantifier[Series]):
    """Mean logarithmic divergence of neighbourhoods: Kantz, Phys. Lett. A 185 (1994) 77-87.

    Neighbourhoods of several radii around the same references are followed in one pass, and fitted together. A
    neighbourhood of fewer than `least` points does not count. `average="logarithm"` takes the mean of logarithms over
    the neighbours; `"distance"` is the paper's logarithm of the mean distance, which large pairs saturate sooner.
    """

    average: Literal["logarithm", "distance"] = "logarithm"
    least: int = 2
    references: int = 2500
    name: ClassVar[str] = "lyapunov_kantz"
    paper: ClassVar[str] = "Kantz, Phys. Lett. A 185 (1994) 77-87"
    unit: ClassVar[str] = "1/s"

    def estimate(self, data: Series, *, rng: np.random.Generator) -> Estimate:
        return exponent(data, self._pairs, before=self.average == "distance")

    def _pairs(self, made: States, steps: int, share: float) -> Pairs:
        """Return neighbourhoods as groups: the `least` nearest always, so that dense and sparse parts weigh alike."""
        found = sought(made, steps, round(share * self.references), MOST)
        near = found.groups[:, :, 0]
        far = np.sqrt(((made.points[found.wanted][:, None] - made.points[near]) ** 2).sum(axis=2))
        far[near < 0] = np.inf
        typical = far[:, self.least - 1][np.isfinite(far[:, self.least - 1])]
        if not len(typical):
            return Pairs(found.wanted, np.full((len(near), 1, 1), -1), found.limit, found.repeats)
        groups = np.full((len(near), len(QUANTILES), MOST), -1)
        for g, radius in enumerate(np.quantile(typical, QUANTILES)):
            inside = far <= radius
            inside[:, : self.least] |= near[:, : self.least] >= 0
            groups[:, g] = np.where(inside, near, -1)
        return Pairs(found.wanted, groups, found.limit, found.repeats)
