"""Modes of a posterior: which of its maxima belong together, and which are separate."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit

LOOKS = 9
NEIGHBOURS = 4


def is_same_mode(a: Fit, b: Fit) -> bool:
    """Return whether two maxima belong to one mode: close by, or without a dip on the straight line between them.

    A filter through a kink leaves a posterior rough, so fits stop at several places of one mode; a dip from roughness
    is shallower than one between modes.
    """
    width, limits = np.maximum(_list_sd(a), _list_sd(b)), a.posterior.settings.mode
    if np.all(np.abs(a.theta - b.theta) < limits.near * width):
        return True
    posterior = max(a.posterior, b.posterior, key=lambda p: p.dynamics.nsub)
    along = np.linspace(0.0, 1.0, LOOKS)[:, None]
    log_densities = posterior.log_density(posterior.space.clip(a.theta + along * (b.theta - a.theta)))
    return bool(np.min(log_densities[1:-1]) > min(log_densities[0], log_densities[-1]) - limits.dip)


def _list_sd(fit: Fit) -> Array:
    return np.array(list(fit.sd.values()))


def select_modes(fits: Iterable[Fit], within: float) -> list[Fit]:
    """Return one fit of each mode, best first by log posterior, down to `within` below the best."""
    ranked = sorted((f for f in fits if math.isfinite(f.local.log_posterior)), key=lambda f: -f.local.log_posterior)
    kept: list[Fit] = []
    for fit in ranked:
        if fit.local.log_posterior < ranked[0].local.log_posterior - within:
            break
        if not any(is_same_mode(fit, other) for other in kept):
            kept.append(fit)
    return kept


@dataclass(frozen=True)
class StartingPoints:
    """Starting points: places `unit` (points, parameters) in the unit cube, coordinates, and scores (points,)."""

    unit: Array
    starts: Array
    scores: Array

    def best(self, count: int) -> list[int]:
        """Return the `count` points with the best scores."""
        return [int(i) for i in np.argsort(self.scores)[::-1][:count]]

    def peaks(self, count: int) -> list[int]:
        """Return up to `count` points, first those that are better than their nearest neighbours.

        The best points alone would often be all in the widest mode.
        """
        apart = np.abs(self.unit[:, None] - self.unit[None]).max(axis=2)
        near = np.argsort(apart, axis=1)[:, 1 : NEIGHBOURS + 1]
        peak = self.scores >= self.scores[near].max(axis=1, initial=-math.inf)
        order = np.lexsort((-self.scores, ~peak))
        return [int(i) for i in order[:count] if math.isfinite(self.scores[i])]
