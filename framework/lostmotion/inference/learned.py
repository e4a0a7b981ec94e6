"""Curves that are learned where no term of the library explains what is missing: smooth functions that act as terms.

A curve is a sum of sines over an interval wider than what was visited; their coefficients are normal, with the spectrum
of a Matern process: a Gaussian process of reduced rank (Solin, Särkkä, Statistics and Computing 30 (2020) 419-446).
So it is smooth, its band widens where data are few, and how rough it is can be chosen by marginal likelihood.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Model, Param, Term, Values
from lostmotion.quantities import DAMPING, FORCE, LENGTH, SPEED, TIME, Dimension

WIDER = 1.25
"""The interval of the sines, in units of that of the data."""
FINE, COARSE = 40, 16
HARMONICS = 8


def _params(count: int, dimension: Dimension, over: Dimension) -> tuple[Param, ...]:
    """Return the parameters of a curve: its coefficients, then the middle and the half width of what was visited."""
    weights = tuple(Param(f"v{i}", "coefficient of a learned curve", dimension, null=0.0) for i in range(count))
    middle = Param("middle", "middle of the range of a learned curve", over)
    return (*weights, middle, Param("half", "half width of the range", over, low=0.0, scale="log"))


class Learned(Term):
    """A force that is learned as a curve over `over`; `count` functions with `waves` (rad per half width of the range).

    `depends` names the covariates on which the force depends, `times` what the curve is multiplied with.
    """

    count: ClassVar[int]
    over: ClassVar[str]
    depends: ClassVar[tuple[str, ...]]
    times: ClassVar[str] = ""
    physics: ClassVar[str] = "A force that no term of the library has"
    paper: ClassVar[str] = "Solin, Särkkä, Statistics and Computing 30 (2020) 419-446"

    @classmethod
    def waves(cls) -> Array:
        """Return the angular frequency (count,) of each function, in rad per half width of the range."""
        return np.asarray(0.5 * math.pi / WIDER * np.arange(1, cls.count + 1), dtype=float)

    @classmethod
    def basis(cls, z: Array) -> Array:
        """Return the functions (points, count) at places `z` (points,), in half widths from the middle of the range."""
        return np.asarray(np.sin(np.outer(np.clip(z, -1.0, 1.0) + WIDER, cls.waves())), dtype=float)


@dataclass(frozen=True)
class OverPosition(Learned):
    """A force that depends on the position."""

    at: str = "ground"
    name: ClassVar[str] = "unknown_over_position"
    formula: ClassVar[str] = "f(x)"
    count: ClassVar[int] = FINE
    over: ClassVar[str] = "position"
    depends: ClassVar[tuple[str, ...]] = ("position",)
    params = _params(FINE, FORCE, LENGTH)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return f(x)."""
        z = min(max((x - p[40]) / p[41], -1.0), 1.0)
        angle = 0.5 * math.pi * (z / 1.25 + 1.0)
        twice, near, far = 2.0 * math.cos(angle), 0.0, 0.0
        for i in range(40):
            near, far = p[39 - i] + twice * near - far, near
        return near * math.sin(angle)


@dataclass(frozen=True)
class OverVelocity(Learned):
    """A force that depends on the velocity."""

    at: str = "ground"
    name: ClassVar[str] = "unknown_over_velocity"
    formula: ClassVar[str] = "f(v)"
    count: ClassVar[int] = COARSE
    over: ClassVar[str] = "velocity"
    depends: ClassVar[tuple[str, ...]] = ("velocity",)
    params = _params(COARSE, FORCE, SPEED)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return f(v)."""
        z = min(max((v - p[16]) / p[17], -1.0), 1.0)
        angle = 0.5 * math.pi * (z / 1.25 + 1.0)
        twice, near, far = 2.0 * math.cos(angle), 0.0, 0.0
        for i in range(16):
            near, far = p[15 - i] + twice * near - far, near
        return near * math.sin(angle)


@dataclass(frozen=True)
class FrictionOverPosition(Learned):
    """Friction of a size that depends on the position; it sticks as `coulomb_friction` does."""

    at: str = "ground"
    name: ClassVar[str] = "unknown_friction_over_position"
    formula: ClassVar[str] = "-f(x) * sign(v)"
    count: ClassVar[int] = COARSE
    over: ClassVar[str] = "position"
    depends: ClassVar[tuple[str, ...]] = ("position", "sign of velocity")
    times: ClassVar[str] = "-sign(v)"
    params = _params(COARSE, FORCE, LENGTH)
    needs = ("mobility",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return -f(x) sign(v)."""
        z = min(max((x - p[16]) / p[17], -1.0), 1.0)
        angle = 0.5 * math.pi * (z / 1.25 + 1.0)
        twice, near, far = 2.0 * math.cos(angle), 0.0, 0.0
        for i in range(16):
            near, far = p[15 - i] + twice * near - far, near
        size = near * math.sin(angle)
        width = abs(size) * p[18]
        if abs(v) >= width:
            return -size if v > 0.0 else (size if v < 0.0 else 0.0)
        return -size * v / width


@dataclass(frozen=True)
class DragOverPosition(Learned):
    """A viscous drag of which the coefficient depends on the position."""

    at: str = "ground"
    name: ClassVar[str] = "unknown_drag_over_position"
    formula: ClassVar[str] = "-f(x) * v"
    count: ClassVar[int] = COARSE
    over: ClassVar[str] = "position"
    depends: ClassVar[tuple[str, ...]] = ("position", "velocity")
    times: ClassVar[str] = "-v"
    params = _params(COARSE, DAMPING, LENGTH)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return -f(x) v."""
        z = min(max((x - p[16]) / p[17], -1.0), 1.0)
        angle = 0.5 * math.pi * (z / 1.25 + 1.0)
        twice, near, far = 2.0 * math.cos(angle), 0.0, 0.0
        for i in range(16):
            near, far = p[15 - i] + twice * near - far, near
        return -near * math.sin(angle) * v


@dataclass(frozen=True)
class OverTime(Learned):
    """A force that changes slowly in the course of a recording; after its end it stays what it is there."""

    at: str = "ground"
    name: ClassVar[str] = "unknown_over_time"
    formula: ClassVar[str] = "f(t)"
    count: ClassVar[int] = COARSE
    over: ClassVar[str] = "time"
    depends: ClassVar[tuple[str, ...]] = ("time",)
    params = _params(COARSE, FORCE, TIME)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return f(t)."""
        z = min(max((t - p[16]) / p[17], -1.0), 1.0)
        angle = 0.5 * math.pi * (z / 1.25 + 1.0)
        twice, near, far = 2.0 * math.cos(angle), 0.0, 0.0
        for i in range(16):
            near, far = p[15 - i] + twice * near - far, near
        return near * math.sin(angle)


@dataclass(frozen=True)
class OverPhase(Learned):
    """A force that repeats with each period of the drive; `middle` and `half` have no part in it."""

    at: str = "ground"
    name: ClassVar[str] = "unknown_over_phase"
    formula: ClassVar[str] = "f(omega t)"
    count: ClassVar[int] = 2 * HARMONICS
    over: ClassVar[str] = "phase"
    depends: ClassVar[tuple[str, ...]] = ("phase",)
    params = _params(2 * HARMONICS, FORCE, TIME)
    needs = ("omega",)

    @classmethod
    def waves(cls) -> Array:
        """Return the angular frequency (count,) of each function, in rad per half period."""
        return np.asarray(math.pi * np.repeat(np.arange(1, HARMONICS + 1), 2), dtype=float)

    @classmethod
    def basis(cls, z: Array) -> Array:
        """Return the functions (points, count) at places `z` (points,), in half periods from the start."""
        angles = np.outer(z, math.pi * np.arange(1, HARMONICS + 1))
        return np.stack([np.cos(angles), np.sin(angles)], axis=2).reshape(len(z), cls.count)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return f of the drive phase."""
        c, d = math.cos(p[18] * t), math.sin(p[18] * t)
        a, b, total = c, d, 0.0
        for i in range(8):
            total += p[2 * i] * a + p[2 * i + 1] * b
            a, b = a * c - b * d, a * d + b * c
        return total


KINDS: tuple[type[Learned], ...] = (OverPosition, OverVelocity, FrictionOverPosition, DragOverPosition)
CLOCKS: tuple[type[Learned], ...] = (OverTime, OverPhase)


def curves_for(model: Model, *, driven: bool) -> tuple[Learned, ...]:
    """Return every curve that can be learned in a model: of the motion at each place, of time and drive at the first.

    `driven` says that all recordings have a drive with one frequency.
    """
    own = [kind(at=place.name) for place in model.interfaces for kind in KINDS]  # type: ignore[call-arg]
    own += [kind(at=model.interfaces[0].name) for kind in CLOCKS if driven or "omega" not in kind.needs]  # type: ignore[call-arg]
    return tuple(own)


def spread(term: Learned | type[Learned], length: float) -> Array:
    """Return the prior standard deviation (count,) of each coefficient, for a force of unit standard deviation.

    `length` is the correlation length in half widths of the range, of a Matern process of order 5/2.
    """
    power = (5.0 / length**2 + term.waves() ** 2) ** -3.0
    return np.asarray(np.sqrt(2.0 * power / power.sum()))


def names_of(terms: Sequence[Learned]) -> list[str]:
    """Return the covariates on which the sum of some curves depends, each once."""
    return list(dict.fromkeys(_placed(name, term) for term in terms for name in term.depends))


def _placed(name: str, term: Learned) -> str:
    moving = name not in ("time", "phase") and term.at != "ground"
    return f"{name} at {term.at}" if moving else name
