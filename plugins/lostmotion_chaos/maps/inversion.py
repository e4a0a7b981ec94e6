"""The quantifier route: the posterior density of the parameters given exponents and dimensions, from maps of a model.

Tjahjowidodo, Al-Bender, Van Brussel (2007), sections 1 and 7, propose to read backlash from exponents and dimensions.
Attractors coexist, and it is unknown which one a recording shows. So the likelihood of a level at a point of the map is
a mixture over the starts in the cells around the point:

- a periodic start is observed as periodic, except for the error shares in `OBSERVATION_SHARES`;
- a chaotic start is observed as chaotic, with an exponent and a dimension near its own values. Both belong to the same
  start, so a dimension can distinguish two gaps at which the exponents agree.

The mixture does not depend on where in a cell the point lies, so it is computed once for each cell and level.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lostmotion.case.drive_levels import Level, Measured
from lostmotion.contracts import Array
from lostmotion.likelihood.space import ParameterSpace
from lostmotion.results.identification import ExpectedRange
from lostmotion.settings import DEFAULT, LevelSettings
from lostmotion_chaos.maps.atlas import CHAOTIC, MISSING, PERIODIC, Atlas, Places
from lostmotion_chaos.maps.numbers import NumberLaw

OBSERVED_MOTIONS = ("periodic", "chaotic", None)

OBSERVATION_SHARES = {
    "periodic": (0.985, 0.01, 0.005),
    "chaotic": (0.01, 0.97, 0.02),
    "weak": (0.35, 0.50, 0.15),
    "unsure": (0.45, 0.35, 0.20),
}
"""Share of motions of each kind observed as periodic, as chaotic, or as neither: `benchmarks/levels.py errors`.

Of 240 recordings all 148 periodic ones and all 80 with strong chaos were classified correctly, and 6 of 10 with weak
chaos. Outcomes that never occurred get half an event, and a percent for cases outside of the benchmark. The shares of
motions that the map itself cannot classify (long transients) are a guess."""
ERROR_DOF = 5.0
"""Degrees of freedom of the errors of exponents and dimensions (Student's t): some readings are far off."""
MISREAD_DENSITY = 0.5
"""Density of the dimension of a motion that was classified wrongly: uniform from 1 to 3."""


@dataclass(frozen=True, eq=False)
class Inversion:
    """The posterior of the parameters of `space` given `levels`; level k uses the map `atlases[which[k]]`.

    `laws` give each dimensionless number at each level from the free parameters. `limits` say which motions of a map
    count as weak chaos.
    """

    levels: tuple[Level, ...]
    atlases: tuple[Atlas, ...]
    which: tuple[int, ...]
    laws: tuple[Mapping[str, NumberLaw], ...]
    space: ParameterSpace
    limits: LevelSettings = DEFAULT.levels

    def log_likelihood(self, points: Array) -> Array:
        """Return the log-likelihoods (count,) at coordinates (count, parameters); -inf outside of the maps."""
        logs, total = self._compute_logs(points), np.zeros(len(points))
        with np.errstate(divide="ignore"):
            for i, (numbers, table, ring) in enumerate(self._tables):
                places = self._locate_levels(i, numbers, logs)
                found = self.atlases[i].interpolate(table, ring, places)
                total += np.log(np.where(places.inside, found, 0.0)).reshape(len(numbers), -1).sum(axis=0)
        return total

    def locate(self, k: int, points: Array) -> Places:
        """Return the positions of coordinates (count, parameters) in the map of level k."""
        return self._locate_levels(self.which[k], [k], self._compute_logs(np.atleast_2d(points)))

    def _locate_levels(self, i: int, levels: Sequence[int], logs: Array) -> Places:
        """Return the positions of logarithms (parameters, count) in map i, one level after the other."""
        names, atlas = self.atlases[i].names, self.atlases[i]
        numbers = {name: np.concatenate([self.laws[k][name](logs) for k in levels]) for name in names}
        return atlas.locate(numbers, np.repeat(np.arange(len(levels)), logs.shape[1]))

    def _compute_logs(self, points: Array) -> Array:
        """Return the logarithms (parameters, count) of the parameters at coordinates."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.stack([points[:, i] if f.log else np.log(points[:, i]) for i, f in enumerate(self.space.free)])

    @cached_property
    def _tables(self) -> tuple[tuple[list[int], Array, Array], ...]:
        """For each map: the levels that use it, their likelihood in each cell, and its mean in the ring around it."""
        found = []
        for i, atlas in enumerate(self.atlases):
            levels = [k for k, at in enumerate(self.which) if at == i]
            tables = [compute_likelihood(self.levels[k], atlas, self.limits) for k in levels]
            found.append((levels, np.concatenate(tables), np.concatenate([atlas.average_ring(t) for t in tables])))
        return tuple(found)

    def compute_numbers(self, points: Array) -> dict[str, Array]:
        """Return the dimensionless numbers (count,) of the machine at coordinates, without those of the drive."""
        logs = self._compute_logs(np.atleast_2d(points))
        return {name: law(logs) for name, law in self.laws[0].items() if not law.of_drive}

    def without_d2(self) -> Inversion:
        """Return the posterior given the exponents alone."""
        return replace(self, levels=tuple(replace(level, d2=None) for level in self.levels))


def compute_likelihood(level: Level, atlas: Atlas, limits: LevelSettings = DEFAULT.levels) -> Array:
    """Return the likelihood (cells,) of the observations at a level: the mean over the starts of each cell."""
    column = OBSERVED_MOTIONS.index(_classify_motion(level, limits))
    chaotic = atlas.kind == CHAOTIC
    weak = chaotic & (2.0 * math.pi * atlas.exponent < limits.weak)
    kinds = {"periodic": atlas.kind == PERIODIC, "chaotic": chaotic & ~weak, "weak": weak}
    seen = np.full(atlas.kind.shape, OBSERVATION_SHARES["unsure"][column])
    for name, where in kinds.items():
        seen[where] = OBSERVATION_SHARES[name][column]
    if level.lyapunov is not None or level.d2 is not None:
        seen *= _compute_density(level, atlas)
    known = atlas.kind != MISSING
    mean = np.where(known, seen, 0.0).sum(axis=1) / np.maximum(known.sum(axis=1), 1)
    return np.asarray(np.where(known.any(axis=1), mean, 0.0))


def _classify_motion(level: Level, limits: LevelSettings) -> str | None:
    """Return the observed motion; without one, an exponent significantly above zero means chaos."""
    if level.motion is None and level.lyapunov and level.lyapunov.value > limits.chaotic * level.lyapunov.sd:
        return "chaotic"
    return level.motion


def _compute_density(level: Level, atlas: Atlas) -> Array:
    """Return the density (cells, starts) of the measured exponent and dimension.

    It is centred on the values of a chaotic start, and broad for any other start.
    """
    density = np.ones(atlas.kind.shape)
    chaotic = atlas.kind == CHAOTIC
    if level.lyapunov is not None:
        usual = float(np.nanmedian(np.where(chaotic, atlas.exponent, np.nan))) if chaotic.any() else 0.1
        own = Measured(level.lyapunov.value / level.omega, level.lyapunov.sd / level.omega)
        near = _compute_student_density(own, atlas.exponent, atlas.exponent_error)
        density *= np.where(chaotic, near, 0.5 / max(usual, 1e-9))
    if level.d2 is not None:
        near = _compute_student_density(level.d2, atlas.dimension, atlas.dimension_error)
        density *= np.where(chaotic & np.isfinite(near), near, MISREAD_DENSITY)
    return density


def _compute_student_density(seen: Measured, values: Array, errors: Array) -> Array:
    """Return Student's density of a measurement about `values`; its scale combines its own error and `errors`."""
    sd = np.hypot(seen.sd, errors)
    scale = math.lgamma(0.5 * (ERROR_DOF + 1.0)) - math.lgamma(0.5 * ERROR_DOF) - 0.5 * math.log(ERROR_DOF * math.pi)
    return np.asarray(
        np.exp(scale - 0.5 * (ERROR_DOF + 1.0) * np.log1p(((seen.value - values) / sd) ** 2 / ERROR_DOF)) / sd
    )


@dataclass(frozen=True)
class Predicted:
    """Prediction at a level: the probability of chaos, and exponent and dimension of the chaotic motions."""

    level: Level
    chaotic_share: float
    lyapunov: ExpectedRange | None
    d2: ExpectedRange | None


def predict_levels(inversion: Inversion, points: Array, rng: np.random.Generator) -> tuple[Predicted, ...]:
    """Return the predictions of posterior draws (count, parameters) at each level, with one motion for each draw."""
    return tuple(_predict_level(inversion, k, points, rng) for k in range(len(inversion.levels)))


def _predict_level(inversion: Inversion, k: int, points: Array, rng: np.random.Generator) -> Predicted:
    atlas, level = inversion.atlases[inversion.which[k]], inversion.levels[k]
    at = atlas.draw_cells(inversion.locate(k, points), rng)
    chaotic = atlas.kind[at] == CHAOTIC
    exponent, dimension = level.omega * atlas.exponent[at][chaotic], atlas.dimension[at][chaotic]
    return Predicted(
        level, float(chaotic.mean()), _compute_range(exponent), _compute_range(dimension[np.isfinite(dimension)])
    )


def _compute_range(values: Array) -> ExpectedRange | None:
    return ExpectedRange(*np.quantile(values, [0.025, 0.5, 0.975]).tolist()) if len(values) else None


def group_levels(levels: Sequence[Level], same: float = 1e-3) -> list[list[int]]:
    """Return the indices of the levels, grouped by drive frequency to within the relative tolerance `same`."""
    groups: list[list[int]] = []
    for k in sorted(range(len(levels)), key=lambda i: levels[i].omega):
        if groups and levels[k].omega <= levels[groups[-1][0]].omega * (1.0 + same):
            groups[-1].append(k)
        else:
            groups.append([k])
    return groups
