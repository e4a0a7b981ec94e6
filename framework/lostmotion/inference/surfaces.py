"""Forces that are learned over two variables, or over the history of the motion.

A surface is a tensor product of the sines of two curves: a Gaussian process of reduced rank with a separable kernel
(Solin, Särkkä, Statistics and Computing 30 (2020) 419-446). A force with a memory is a curve over a hidden state of
first order: the extension of a spring in series with a dashpot.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy.signal import lfilter

from lostmotion.contracts import Array, Machine, Param, Values
from lostmotion.inference.learned import (
    COARSE,
    WIDER,
    DragOverPosition,
    FrictionOverPosition,
    LearnedTerm,
    OverPhase,
    OverPosition,
    OverTime,
    OverVelocity,
    compute_spectrum,
    look_up,
    make_params,
)
from lostmotion.quantities import FORCE, LENGTH, SPEED, TIME, Dimension

WIDE, DEEP = 8, 6
"""Functions along the first and along the second variable of a force."""


def compute_angle(at: float, middle: float, half: float) -> float:
    """Return the angle (rad) of the first sine at a place, limited to the range of a surface."""
    return 0.5 * math.pi / WIDER * (min(max((at - middle) / half, -1.0), 1.0) + WIDER)


def _make_surface_params(second: Dimension) -> tuple[Param, ...]:
    """Return the parameters of a surface: those of a curve over position, and the range of the second variable."""
    middle = Param("middle2", "middle of the second range of a learned surface", second)
    half = Param("half2", "half width of the second range of a learned surface", second, low=0.0, scale="log")
    return (*make_params(WIDE * DEEP, FORCE, LENGTH), middle, half)


@dataclass(frozen=True)
class Surface(LearnedTerm):
    """A force that is learned over position and a second variable."""

    wide: int = WIDE
    deep: int = DEEP
    count: ClassVar[int] = WIDE * DEEP
    over: ClassVar[str] = "position"
    beside: ClassVar[str]

    @classmethod
    def lines(cls) -> tuple[Array, Array]:
        """Return the angular frequencies along both variables, in rad per half width of the range (or half period)."""
        both = (0.5 * math.pi / WIDER * np.arange(1, n + 1) for n in (WIDE, DEEP))
        first, second = (np.asarray(waves, dtype=float) for waves in both)
        return first, second

    @classmethod
    def spread(cls, length: float) -> Array:
        """Return the prior standard deviation (count,) of each coefficient: products of those along each variable."""
        first, second = cls.lines()
        return np.asarray(np.outer(compute_spectrum(first, length), compute_spectrum(second, length)).ravel())

    @classmethod
    def along(cls, z: Array) -> Array:
        """Return the functions (points, `DEEP`) of the second variable, in half widths from the middle of its range."""
        return np.asarray(np.sin(np.outer(np.clip(z, -1.0, 1.0) + WIDER, cls.lines()[1])), dtype=float)

    @classmethod
    def grid(cls, first: Array, second: Array) -> Array:
        """Return all functions (points of `first`, points of `second`, count) on a grid."""
        across = np.sin(np.outer(np.clip(first, -1.0, 1.0) + WIDER, cls.lines()[0]))
        return np.asarray(np.einsum("ai,bj->abij", across, cls.along(second)).reshape(len(first), len(second), -1))

    def prepared(self, p: Array) -> Array:
        """Return the parameters as they are: a sum of sines needs no table."""
        return p


@dataclass(frozen=True)
class OverPlane(Surface):
    """A force that depends on position and velocity together."""

    name: ClassVar[str] = "unknown_over_position_and_velocity"
    formula: ClassVar[str] = "f(x, v)"
    beside: ClassVar[str] = "velocity"
    depends: ClassVar[tuple[str, ...]] = ("position", "velocity")
    params = _make_surface_params(SPEED)

    def force(self, t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:  # type: ignore[override]
        """Return the surface; the sines follow from a recursion: sin kz = 2 cos z sin (k-1)z - sin (k-2)z."""
        n = self.wide * self.deep
        one, two = compute_angle(x, p[n], p[n + 1]), compute_angle(v, p[n + 2], p[n + 3])
        begin, twice, also = math.sin(two), 2.0 * math.cos(one), 2.0 * math.cos(two)
        here, last, total = math.sin(one), 0.0, 0.0
        for i in range(self.wide):
            row, sine, before = 0.0, begin, 0.0
            for j in range(self.deep):
                row += p[i * self.deep + j] * sine
                sine, before = also * sine - before, sine
            total += row * here
            here, last = twice * here - last, here
        return total


@dataclass(frozen=True)
class OverPositionAndPhase(Surface):
    """A force that depends on the position and on the phase of the drive."""

    name: ClassVar[str] = "unknown_over_position_and_phase"
    formula: ClassVar[str] = "f(x, omega t)"
    beside: ClassVar[str] = "phase"
    depends: ClassVar[tuple[str, ...]] = ("position", "phase")
    params = _make_surface_params(TIME)
    needs = ("omega",)

    @classmethod
    def lines(cls) -> tuple[Array, Array]:
        """Return the angular frequencies: those along the phase each twice, of a cosine and of a sine."""
        return Surface.lines()[0], np.asarray(math.pi * np.repeat(np.arange(1, DEEP // 2 + 1), 2), dtype=float)

    @classmethod
    def along(cls, z: Array) -> Array:
        """Return the functions (points, `DEEP`) of the phase, in half periods."""
        turned = np.tile([0.5 * math.pi, 0.0], DEEP // 2)
        return np.asarray(np.sin(np.outer(z, cls.lines()[1]) + turned), dtype=float)

    def force(self, t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:  # type: ignore[override]
        """Return the surface; `p` ends with the frequency of the drive."""
        n = self.wide * self.deep
        one = compute_angle(x, p[n], p[n + 1])
        cosine, sine = math.cos(p[n + 4] * t), math.sin(p[n + 4] * t)
        here, last, total, twice = math.sin(one), 0.0, 0.0, 2.0 * math.cos(one)
        for i in range(self.wide):
            row, c, w = 0.0, cosine, sine
            for j in range(0, self.deep, 2):
                row += p[i * self.deep + j] * c + p[i * self.deep + j + 1] * w
                c, w = c * cosine - w * sine, w * cosine + c * sine
            total += row * here
            here, last = twice * here - last, here
        return total


@dataclass(frozen=True)
class OverHistory(LearnedTerm):
    """A force that depends on the history of the motion: a curve over the extension of a spring behind a dashpot.

    Its state z follows dz/dt = v - z / time: for a long time it is the position, for a short one the velocity.
    """

    name: ClassVar[str] = "unknown_over_history"
    formula: ClassVar[str] = "f(z), dz/dt = v - z / time"
    over: ClassVar[str] = "history"
    depends: ClassVar[tuple[str, ...]] = ("history",)
    states = ("stretch",)
    params = (
        *make_params(COARSE, FORCE, LENGTH),
        Param("time", "time in which a learned force forgets", TIME, low=0.0, scale="log"),
    )

    def force(self, t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:  # type: ignore[override]
        """Return the curve over the state."""
        return look_up(p, (s[0] - p[0]) * p[1], self.cells)

    def rate(  # type: ignore[override]
        self, t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array
    ) -> None:
        """Return the derivative of the state: it follows the motion and decays."""
        dsdt[0] = v - s[0] / p[2]

    @staticmethod
    def followed(velocity: Array, dt: float, time: float) -> Array:
        """Return the state (samples,) along a motion of this velocity (samples,), sampled every `dt` s."""
        kept = math.exp(-dt / time)
        pushed = time * (1.0 - kept) * 0.5 * (velocity[1:] + velocity[:-1])
        return np.asarray(lfilter([1.0], [1.0, -kept], np.concatenate([[0.0], pushed])))


KINDS: tuple[type[LearnedTerm], ...] = (OverPosition, OverVelocity, FrictionOverPosition, DragOverPosition)
CLOCKS: tuple[type[LearnedTerm], ...] = (OverTime, OverPhase)
RICHER: tuple[type[LearnedTerm], ...] = (OverPlane, OverPositionAndPhase, OverHistory)
"""Tried where curves over one variable do not suffice."""


def list_all_curves(model: Machine, *, driven: bool) -> tuple[LearnedTerm, ...]:
    """Return every curve that can be learned in a model: of the motion at each place, of time and drive at the first.

    `driven` says that all recordings have a drive with one frequency.
    """
    moving: tuple[type[LearnedTerm], ...] = (*KINDS, OverPlane, OverHistory)
    timed: tuple[type[LearnedTerm], ...] = (*CLOCKS, OverPositionAndPhase)
    own = [kind(at=place.name) for place in model.places for kind in moving]
    clocks = [kind for kind in timed if driven or "omega" not in kind.needs]
    return (*own, *(kind(at=model.first_place.name) for kind in clocks))
