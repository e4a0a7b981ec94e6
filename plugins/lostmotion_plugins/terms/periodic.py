"""What repeats over travel or turn."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, TermPrior, Values
from lostmotion.quantities import FORCE, LENGTH
from lostmotion_plugins.laws import describe_wave, resist_sliding

PITCH_PRIOR = TermPrior(0.3, scan=(0.1, 4.2))
"""The usual pitch in amplitudes of the motion, and the range of pitches that are tried in units of that.

The longest one has 1.6 periods within the travel of a harmonic motion, and three within that of a multisine, which has
rare peaks. A longer one could not be told from another smooth curve."""

PITCH = Param("pitch", "travel or turn after which it repeats", LENGTH, low=0.0, scale="log", prior=PITCH_PRIOR)
AMPLITUDE = Param("force", "amplitude of the force", FORCE)
VARIATION = Param("wave", "amplitude of the variation", FORCE)


def turn_wave(cosine: float, sine: float, angle: float) -> tuple[float, float]:
    """Return the cosine and sine parts of a wave whose zero is moved forward by an angle (rad)."""
    c, s = math.cos(angle), math.sin(angle)
    return cosine * c + sine * s, sine * c - cosine * s


@dataclass(frozen=True)
class Cogging(Term):
    """A force that is periodic in position: cogging torque of a motor, or the force of a bent screw."""

    at: str = "ground"
    name: ClassVar[str] = "cogging"
    physics: ClassVar[str] = "A force that repeats with every {pitch} acts, {cosine} as a cosine and {sine} as a sine"
    formula: ClassVar[str] = "cosine * cos(2 pi x / pitch) + sine * sin(2 pi x / pitch)"
    paper: ClassVar[str] = "Zhu, Howe, IEEE Trans. Energy Conversion 15 (2000) 407-412"
    params = (
        Param("cosine", "force as cos(2 pi x / pitch)", FORCE, null=0.0, prior=TermPrior(0.1)),
        Param("sine", "force as sin(2 pi x / pitch)", FORCE, null=0.0, prior=TermPrior(0.1)),
        PITCH,
    )

    @staticmethod
    def derived(p: Values) -> Mapping[Param, float]:
        return describe_wave(AMPLITUDE, p[0], p[1])

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        angle = 2.0 * math.pi * x / p[2]
        return p[0] * math.cos(angle) + p[1] * math.sin(angle)

    @staticmethod
    def shifted(p: Values, by: float) -> Values:
        return *turn_wave(p[0], p[1], 2.0 * math.pi * by / p[2]), p[2]


@dataclass(frozen=True)
class PositionDependentFriction(Term):
    """Dry friction that is periodic in position.

    Below the velocity at which friction reverses the motion within one step, the law is a steep line.
    """

    at: str = "ground"
    name: ClassVar[str] = "position_dependent_friction"
    extends: ClassVar[tuple[str, ...]] = ("coulomb_friction",)
    physics: ClassVar[str] = (
        "Dry friction of {force} on average, which varies periodically with every {pitch} by {cosine} as a cosine and"
        " {sine} as a sine, opposes the motion"
    )
    formula: ClassVar[str] = "-max(force + cosine * cos(2 pi x / pitch) + sine * sin(2 pi x / pitch), 0) * sign(v)"
    paper: ClassVar[str] = "Armstrong, IEEE Int. Conf. Robotics and Automation (1988) 1299-1305: position dependence"
    params = (
        Param("force", "mean friction force", FORCE, low=0.0, null=0.0),
        Param("cosine", "friction as cos(2 pi x / pitch)", FORCE, null=0.0, prior=TermPrior(0.3)),
        Param("sine", "friction as sin(2 pi x / pitch)", FORCE, null=0.0, prior=TermPrior(0.3)),
        PITCH,
    )
    needs = ("mobility",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        angle = 2.0 * math.pi * x / p[3]
        level = max(p[0] + p[1] * math.cos(angle) + p[2] * math.sin(angle), 0.0)
        return resist_sliding(v, level, (abs(p[0]) + abs(p[1]) + abs(p[2])) * p[4])

    @staticmethod
    def derived(p: Values) -> Mapping[Param, float]:
        return describe_wave(VARIATION, p[1], p[2])

    @staticmethod
    def shifted(p: Values, by: float) -> Values:
        return p[0], *turn_wave(p[1], p[2], 2.0 * math.pi * by / p[3]), p[3]
