"""Forces that grow with velocity and dissipate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, Values
from lostmotion.quantities import DAMPING, Dimension


@dataclass(frozen=True)
class ViscousDamping(Term):
    """A drag that is proportional to velocity."""

    at: str = "ground"
    name: ClassVar[str] = "viscous_damping"
    physics: ClassVar[str] = "Viscous damping of {coefficient} slows the motion"
    formula: ClassVar[str] = "-coefficient * v"
    paper: ClassVar[str] = "Rayleigh, The Theory of Sound (1877), section 45"
    params = (Param("coefficient", "viscous coefficient", DAMPING, low=0.0, null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * v


@dataclass(frozen=True)
class QuadraticDamping(Term):
    """A drag that grows with the square of velocity, as in air or oil."""

    at: str = "ground"
    name: ClassVar[str] = "quadratic_damping"
    physics: ClassVar[str] = "Drag of {coefficient} times the velocity squared slows the motion"
    formula: ClassVar[str] = "-coefficient * v * |v|"
    paper: ClassVar[str] = "Nayfeh, Mook, Nonlinear Oscillations (1979), section 3.3"
    params = (Param("coefficient", "drag coefficient", Dimension(1, -2, 2), low=0.0, null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * v * abs(v)
