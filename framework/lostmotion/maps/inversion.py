"""The quantifier route: which machines show such chaos at such levels? A posterior density over the maps of a model.

Tjahjowidodo, Al-Bender, Van Brussel (2007), sections 1 and 7, propose to read backlash from exponents and dimensions.
The likelihood of a level at a point of the map is a mixture over what the starts in the cells around the point do:
attractors coexist, and nobody knows which one a recording has caught. So much follows from a start:

- one that is periodic is seen as periodic, but for the misread shares of `MISREAD`;
- one that is chaotic is seen as chaotic, with an exponent and a dimension that lie around its own: both of the same
  start, so a dimension tells between two gaps at which the exponents agree.

Since the mixture does not depend on where in a cell the point lies, it is worked out once for each cell and level.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lostmotion.case.levels import Level, Measured
from lostmotion.contracts import Array
from lostmotion.likelihood.space import FreeParameter
from lostmotion.maps.atlas import CHAOTIC, MISSING, PERIODIC, Atlas, Places
from lostmotion.maps.numbers import NumberLaw
from lostmotion.results.identification import ExpectedRange

SEEN = ("periodic", "chaotic", None)
WEAK = 0.5
"""Exponents (nat per period of the drive) below which chaos is weak: a recording may show nothing of it."""
MISREAD = {
    "periodic": (0.985, 0.01, 0.005),
    "chaotic": (0.01, 0.97, 0.02),
    "weak": (0.35, 0.50, 0.15),
    "unsure": (0.45, 0.35, 0.20),
}
"""How often a motion of each kind is seen as periodic, as chaotic, or as neither: `benchmarks/levels.py errors`.

Of 240 recordings all 148 periodic ones and all 80 of strong chaos were seen as such, and 6 of 10 of weak chaos. Half an
event, and a percent for what no benchmark holds, is given to what was never seen. That of motions of which the map
itself cannot tell (long transients) is a guess."""
TAIL = 5.0
"""Degrees of freedom of the errors of exponents and dimensions (Student's t): some readings are far off."""
BROAD = 0.5
"""Density of the dimension of a motion that is misread: evenly from 1 to 3."""


@dataclass(frozen=True, eq=False)
class Inversion:
    """The posterior of the `free` parameters given `levels`: a level k is looked up in `atlases[which[k]]`.

    `laws` give each dimensionless number at each level from the free parameters.
    """

    levels: tuple[Level, ...]
    atlases: tuple[Atlas, ...]
    which: tuple[int, ...]
    laws: tuple[Mapping[str, NumberLaw], ...]
    free: tuple[FreeParameter, ...]

    def log_prior(self, theta: Array) -> float:
        """Return the log prior density at the coordinates `theta`."""
        return sum(f.log_prior(float(c)) for f, c in zip(self.free, theta, strict=True))

    def log_likelihoods(self, points: Array) -> Array:
        """Return the log-likelihoods (count,) at coordinates (count, parameters); -inf outside of the maps."""
        logs, total = self._logs(points), np.zeros(len(points))
        with np.errstate(divide="ignore"):
            for i, (numbers, table, ring) in enumerate(self._tables):
                places = self._places(i, numbers, logs)
                found = self.atlases[i].blended(table, ring, places)
                total += np.log(np.where(places.inside, found, 0.0)).reshape(len(numbers), -1).sum(axis=0)
        return total

    def places(self, k: int, points: Array) -> Places:
        """Return where coordinates (count, parameters) lie in the map of level k."""
        return self._places(self.which[k], [k], self._logs(np.atleast_2d(points)))

    def _places(self, i: int, levels: Sequence[int], logs: Array) -> Places:
        """Return where logarithms (parameters, count) lie at some levels in map i, one level after the other."""
        names, atlas = self.atlases[i].names, self.atlases[i]
        numbers = {name: np.concatenate([self.laws[k][name](logs) for k in levels]) for name in names}
        return atlas.places(numbers, np.repeat(np.arange(len(levels)), logs.shape[1]))

    def _logs(self, points: Array) -> Array:
        """Return the logarithms (parameters, count) of the parameters at coordinates."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.stack([points[:, i] if f.log else np.log(points[:, i]) for i, f in enumerate(self.free)])

    @cached_property
    def _tables(self) -> tuple[tuple[list[int], Array, Array], ...]:
        """For each map the levels that are looked up there, their likelihood in each cell, and in the rings around."""
        found = []
        for i, atlas in enumerate(self.atlases):
            levels = [k for k, at in enumerate(self.which) if at == i]
            tables = [likelihood_of(self.levels[k], atlas) for k in levels]
            found.append((levels, np.concatenate(tables), np.concatenate([atlas.around(t) for t in tables])))
        return tuple(found)

    def numbers(self, points: Array) -> dict[str, Array]:
        """Return the dimensionless numbers (count,) of the machine at coordinates; those of the drive left out."""
        logs = self._logs(np.atleast_2d(points))
        return {name: law(logs) for name, law in self.laws[0].items() if not law.of_drive}

    def without_d2(self) -> Inversion:
        """Return the posterior that the exponents alone give."""
        return replace(self, levels=tuple(replace(level, d2=None) for level in self.levels))


def likelihood_of(level: Level, atlas: Atlas) -> Array:
    """Return the likelihood (cells,) of what was seen at a level: the mean over the starts of each cell."""
    column = SEEN.index(_motion(level))
    chaotic = atlas.kind == CHAOTIC
    weak = chaotic & (2.0 * math.pi * atlas.exponent < WEAK)
    kinds = {"periodic": atlas.kind == PERIODIC, "chaotic": chaotic & ~weak, "weak": weak}
    seen = np.full(atlas.kind.shape, MISREAD["unsure"][column])
    for name, where in kinds.items():
        seen[where] = MISREAD[name][column]
    if level.lyapunov is not None or level.d2 is not None:
        seen *= _measured(level, atlas)
    known = atlas.kind != MISSING
    mean = np.where(known, seen, 0.0).sum(axis=1) / np.maximum(known.sum(axis=1), 1)
    return np.asarray(np.where(known.any(axis=1), mean, 0.0))


def _motion(level: Level) -> str | None:
    """Return the motion that was seen: a positive exponent beyond its error stands for chaos."""
    if level.motion is None and level.lyapunov and level.lyapunov.value > 2.0 * level.lyapunov.sd:
        return "chaotic"
    return level.motion


def _measured(level: Level, atlas: Atlas) -> Array:
    """Return the density (cells, starts) of the measured numbers: about those of a chaotic start, or broad."""
    density = np.ones(atlas.kind.shape)
    chaotic = atlas.kind == CHAOTIC
    if level.lyapunov is not None:
        usual = float(np.nanmedian(np.where(chaotic, atlas.exponent, np.nan))) if chaotic.any() else 0.1
        own = Measured(level.lyapunov.value / level.omega, level.lyapunov.sd / level.omega)
        near = _density(own, atlas.exponent, atlas.exponent_error)
        density *= np.where(chaotic, near, 0.5 / max(usual, 1e-9))
    if level.d2 is not None:
        near = _density(level.d2, atlas.dimension, atlas.dimension_error)
        density *= np.where(chaotic & np.isfinite(near), near, BROAD)
    return density


def _density(seen: Measured, values: Array, errors: Array) -> Array:
    """Return Student's density of what was seen about `values` with `errors` of the map beside its own."""
    sd = np.hypot(seen.sd, errors)
    scale = math.lgamma(0.5 * (TAIL + 1.0)) - math.lgamma(0.5 * TAIL) - 0.5 * math.log(TAIL * math.pi)
    return np.asarray(np.exp(scale - 0.5 * (TAIL + 1.0) * np.log1p(((seen.value - values) / sd) ** 2 / TAIL)) / sd)


@dataclass(frozen=True)
class Predicted:
    """What the posterior expects at a level: the share of chaos, and exponent and dimension of what is chaotic."""

    level: Level
    chaotic_share: float
    lyapunov: ExpectedRange | None
    d2: ExpectedRange | None


def predicted(inversion: Inversion, points: Array, rng: np.random.Generator) -> tuple[Predicted, ...]:
    """Return what draws (count, parameters) of the posterior expect at each level, one motion for each draw."""
    return tuple(_predicted(inversion, k, points, rng) for k in range(len(inversion.levels)))


def _predicted(inversion: Inversion, k: int, points: Array, rng: np.random.Generator) -> Predicted:
    atlas, level = inversion.atlases[inversion.which[k]], inversion.levels[k]
    at = atlas.drawn(inversion.places(k, points), rng)
    chaotic = atlas.kind[at] == CHAOTIC
    exponent, dimension = level.omega * atlas.exponent[at][chaotic], atlas.dimension[at][chaotic]
    return Predicted(level, float(chaotic.mean()), _band(exponent), _band(dimension[np.isfinite(dimension)]))


def _band(values: Array) -> ExpectedRange | None:
    return ExpectedRange(*np.quantile(values, [0.025, 0.5, 0.975]).tolist()) if len(values) else None


def grouped(levels: Sequence[Level], same: float = 1e-3) -> list[list[int]]:
    """Return the numbers of the levels in groups of one drive frequency, to within the share `same`."""
    groups: list[list[int]] = []
    for k in sorted(range(len(levels)), key=lambda i: levels[i].omega):
        if groups and levels[k].omega <= levels[groups[-1][0]].omega * (1.0 + same):
            groups[-1].append(k)
        else:
            groups.append([k])
    return groups
