"""Learned curves: smooth functions that act as terms where no term of the library explains the missing force.

A curve is a sum of sines over an interval wider than the visited range; their coefficients are normal, with the
spectrum of a Matern process: a Gaussian process of reduced rank (Solin, Särkkä, Statistics and Computing 30 (2020)
419-446). So it is smooth, its band widens where data are few, and its roughness is chosen by marginal likelihood.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Param, Term, Values
from lostmotion.quantities import DAMPING, FORCE, LENGTH, SPEED, TIME, Dimension

WIDER = 1.25
"""The interval of the sines, in units of that of the data."""
FINE, COARSE = 40, 16
HARMONICS = 8
CELLS = 128
"""Cells of the table of a coarse curve, twice as many for a fine one: the error of the cubics is less than 1e-3 of a
function."""
POSITION, VELOCITY, TIME_PASSED, PHASE = range(4)
ONE, AGAINST_MOTION, DRAG = range(3)


def make_params(count: int, dimension: Dimension, over: Dimension) -> tuple[Param, ...]:
    """Return the parameters of a curve: its coefficients, then the middle and the half width of the visited range."""
    weights = tuple(Param(f"v{i}", "coefficient of a learned curve", dimension, null=0.0) for i in range(count))
    middle = Param("middle", "middle of the range of a learned curve", over)
    return (*weights, middle, Param("half", "half width of the range", over, low=0.0, scale="log"))


def look_up(p: Values, z: float, cells: int) -> float:
    """Return a curve at `z`, in cells from its begin: a cubic between the nodes of the table after `p[2]`."""
    z = min(z, cells) if z > 0.0 else 0.0
    cell = min(int(z), cells - 1)
    z -= cell
    low, high, first, last = p[3 + 2 * cell], p[5 + 2 * cell], p[4 + 2 * cell], p[6 + 2 * cell]
    bent = first + last - 2.0 * (high - low)
    return low + z * (first + z * (high - low - first - bent + z * bent))


def compute_spectrum(waves: Array, length: float) -> Array:
    """Return the prior standard deviation of each coefficient of functions with these `waves` (rad per half width)."""
    power = (5.0 / length**2 + waves**2) ** -3.0
    return np.asarray(np.sqrt(2.0 * power / power.sum()))


EVENLY = tuple(np.linspace(-1.0, 1.0, 401).tolist())
"""Places all over the range, where no motion is known."""
LEFT = 0.1
"""The constant and the line that is left in a smooth force, as a share of its size: no motion repeats exactly."""


@lru_cache(maxsize=64)
def _fit_lines(curve: type[LearnedTerm], places: tuple[float, ...]) -> Array:
    """Return the constants and the slopes of the sines of a curve (plain, sines), by least squares at some places."""
    if not curve.plain:
        return np.zeros((0, len(curve.waves())))
    z = np.array(places)
    return np.asarray(np.linalg.lstsq(np.vander(z, curve.plain, increasing=True), curve.sines(z), rcond=None)[0])


@dataclass(frozen=True)
class LearnedTerm(Term):
    """A force that is learned as a curve: a sum of `count` sines of one variable.

    `depends` names the covariates of the force, `times` the factor of the curve. The kernel reads the curve from a
    table of so many `cells`, over the variable `source`, and multiplies it by the `factor`. The first `plain` functions
    are the constant and the straight line: a force of these forms has a name. The sines are without them along the
    recorded motion, of which `places` are the quantiles, in half widths from the middle of the range.
    """

    at: str = "ground"
    source: int = POSITION
    factor: int = ONE
    cells: int = CELLS
    places: tuple[float, ...] = EVENLY
    count: ClassVar[int] = COARSE
    plain: ClassVar[int] = 0
    over: ClassVar[str]
    depends: ClassVar[tuple[str, ...]]
    times: ClassVar[str] = ""
    physics: ClassVar[str] = "A force that no term of the library has"
    paper: ClassVar[str] = "Solin, Särkkä, Statistics and Computing 30 (2020) 419-446"

    def spread(self, length: float) -> Array:
        """Return the prior standard deviation (count,) of each coefficient, for a force of unit standard deviation.

        `length` is the correlation length in half widths of the range, of a Matern process of order 5/2.
        """
        sines = compute_spectrum(self.waves(), length)
        return np.concatenate([np.sqrt(self._lines**2 @ sines**2), sines])

    @classmethod
    def waves(cls) -> Array:
        """Return the angular frequency of each sine, in rad per half width of the range."""
        return np.asarray(0.5 * math.pi / WIDER * np.arange(1, cls.count - cls.plain + 1), dtype=float)

    @classmethod
    def sines(cls, z: Array) -> Array:
        """Return the sines (points, sines) at places `z` (points,), in half widths from the middle of the range."""
        return np.asarray(np.sin(np.outer(z + WIDER, cls.waves())), dtype=float)

    @property
    def _lines(self) -> Array:
        return _fit_lines(type(self), self.places)

    def bent_spread(self, length: float, count: int) -> Array:
        """Return the spread of `count` coefficients for a unit deviation of the sines along the motion.

        Plain functions have a share `LEFT` of it.
        """
        spread = self.spread(length)[:count]
        spread[: self.plain] = 0.0
        functions = self.basis(np.array(self.places))[:, :count]
        spread /= math.sqrt(float(np.mean(functions**2 @ spread**2)))
        spread[: self.plain] = LEFT
        return spread

    def basis(self, z: Array) -> Array:
        """Return the functions (points, count) at places `z` (points,), in half widths from the middle of the range."""
        z = np.clip(z, -1.0, 1.0)
        plain = np.vander(z, self.plain, increasing=True)
        return np.column_stack([plain, self.sines(z) - plain @ self._lines])

    def slopes(self, z: Array) -> Array:
        """Return the derivatives (points, count) of the functions within the range."""
        slopes = self.waves() * np.cos(np.outer(z + WIDER, self.waves()))
        plain = np.zeros((len(z), self.plain))
        plain[:, 1:] = 1.0
        return np.column_stack([plain, slopes - plain @ self._lines])

    def prepared(self, p: Array) -> Array:
        """Return begin and cells per unit of the table, the need of the law, then value and slope at each node."""
        middle, half = p[:, self.count], p[:, self.count + 1]
        need = p[:, self.count + 2] if p.shape[1] > self.count + 2 else np.zeros(len(p))
        begin, per = middle - half, 0.5 * self.cells / half
        if self.source == PHASE:
            begin, per = np.zeros(len(p)), 0.5 * self.cells / math.pi * need
        z = np.linspace(0.0, 2.0, self.cells + 1) - (0.0 if self.source == PHASE else 1.0)
        nodes = np.zeros((len(p), self.cells + 1, 2))
        if p[:, : self.count].any():
            nodes[..., 0] = p[:, : self.count] @ self.basis(z).T
            nodes[..., 1] = p[:, : self.count] @ self.slopes(z).T * (2.0 / self.cells)
        return np.column_stack([begin, per, need, nodes.reshape(len(p), -1)])

    def force(self, t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:  # type: ignore[override]
        """Return the curve, by a cubic between the nodes of its table, times its factor."""
        seen = t
        if self.source == POSITION:
            seen = x
        if self.source == VELOCITY:
            seen = v
        z = (seen - p[0]) * p[1]
        if self.source == PHASE:
            z -= self.cells * math.floor(z / self.cells)
        size = look_up(p, z, self.cells)
        if self.factor == DRAG:
            return -size * v
        if self.factor == AGAINST_MOTION:
            width = abs(size) * p[2]
            if abs(v) >= width:
                return -size if v > 0.0 else (size if v < 0.0 else 0.0)
            return -size * v / width
        return size


@dataclass(frozen=True)
class OverPosition(LearnedTerm):
    """A force that depends on the position."""

    cells: int = 2 * CELLS
    name: ClassVar[str] = "unknown_over_position"
    formula: ClassVar[str] = "f(x)"
    count: ClassVar[int] = FINE
    plain: ClassVar[int] = 2
    over: ClassVar[str] = "position"
    depends: ClassVar[tuple[str, ...]] = ("position",)
    params = make_params(FINE, FORCE, LENGTH)


@dataclass(frozen=True)
class OverVelocity(LearnedTerm):
    """A force that depends on the velocity."""

    source: int = VELOCITY
    name: ClassVar[str] = "unknown_over_velocity"
    formula: ClassVar[str] = "f(v)"
    plain: ClassVar[int] = 2
    over: ClassVar[str] = "velocity"
    depends: ClassVar[tuple[str, ...]] = ("velocity",)
    params = make_params(COARSE, FORCE, SPEED)


@dataclass(frozen=True)
class FrictionOverPosition(LearnedTerm):
    """Friction of a size that depends on the position; it sticks as `coulomb_friction` does."""

    factor: int = AGAINST_MOTION
    name: ClassVar[str] = "unknown_friction_over_position"
    formula: ClassVar[str] = "-f(x) * sign(v)"
    over: ClassVar[str] = "position"
    depends: ClassVar[tuple[str, ...]] = ("position", "sign of velocity")
    times: ClassVar[str] = "-sign(v)"
    params = make_params(COARSE, FORCE, LENGTH)
    needs = ("mobility",)


@dataclass(frozen=True)
class DragOverPosition(LearnedTerm):
    """A viscous drag of which the coefficient depends on the position."""

    factor: int = DRAG
    name: ClassVar[str] = "unknown_drag_over_position"
    formula: ClassVar[str] = "-f(x) * v"
    over: ClassVar[str] = "position"
    depends: ClassVar[tuple[str, ...]] = ("position", "velocity")
    times: ClassVar[str] = "-v"
    params = make_params(COARSE, DAMPING, LENGTH)


@dataclass(frozen=True)
class OverTime(LearnedTerm):
    """A force that changes slowly during a recording; after its end it keeps its last value."""

    source: int = TIME_PASSED
    name: ClassVar[str] = "unknown_over_time"
    formula: ClassVar[str] = "f(t)"
    plain: ClassVar[int] = 1
    over: ClassVar[str] = "time"
    depends: ClassVar[tuple[str, ...]] = ("time",)
    params = make_params(COARSE, FORCE, TIME)


@dataclass(frozen=True)
class OverPhase(LearnedTerm):
    """A force that repeats with each period of the drive; `middle` and `half` are not used."""

    source: int = PHASE
    name: ClassVar[str] = "unknown_over_phase"
    formula: ClassVar[str] = "f(omega t)"
    count: ClassVar[int] = 2 * HARMONICS
    over: ClassVar[str] = "phase"
    depends: ClassVar[tuple[str, ...]] = ("phase",)
    params = make_params(2 * HARMONICS, FORCE, TIME)
    needs = ("omega",)

    @classmethod
    def waves(cls) -> Array:
        """Return the angular frequency (count,) of each function, in rad per half period."""
        return np.asarray(math.pi * np.repeat(np.arange(1, HARMONICS + 1), 2), dtype=float)

    @classmethod
    def basis(cls, z: Array) -> Array:
        """Return the functions (points, count) at places `z` (points,), in half periods from the start."""
        return np.asarray(np.sin(np.outer(z, cls.waves()) + _make_phases(cls.count)), dtype=float)

    @classmethod
    def slopes(cls, z: Array) -> Array:
        """Return the derivatives (points, count) of the functions."""
        return np.asarray(cls.waves() * np.cos(np.outer(z, cls.waves()) + _make_phases(cls.count)), dtype=float)


def _make_phases(count: int) -> Array:
    """Return phases (count,) that turn every other sine into a cosine."""
    return np.asarray(np.tile([0.5 * math.pi, 0.0], count // 2), dtype=float)


def compute_spread(term: LearnedTerm, length: float) -> Array:
    """Return the prior standard deviation (count,) of each coefficient of a curve, for a force of unit deviation."""
    return term.spread(length)


def list_covariates(terms: Sequence[LearnedTerm]) -> list[str]:
    """Return the covariates on which the sum of some curves depends, each once."""
    return list(dict.fromkeys(_name_at_place(name, term) for term in terms for name in term.depends))


def _name_at_place(name: str, term: LearnedTerm) -> str:
    moving = name not in ("time", "phase") and term.at != "ground"
    return f"{name} at {term.at}" if moving else name
