"""Damping forces that depend on velocity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, TermPrior, Values
from lostmotion.quantities import DAMPING, Dimension


@dataclass(frozen=True)
class ViscousDamping(Term):
    """Viscous damping, proportional to velocity."""

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
    """Drag that grows with the square of velocity, as in air or oil."""

    at: str = "ground"
    name: ClassVar[str] = "quadratic_damping"
    physics: ClassVar[str] = "Drag of {coefficient} times the velocity squared slows the motion"
    formula: ClassVar[str] = "-coefficient * v * |v|"
    paper: ClassVar[str] = "Nayfeh, Mook, Nonlinear Oscillations (1979), section 3.3"
    params = (Param("coefficient", "drag coefficient", Dimension(1, -2, 2), low=0.0, null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * v * abs(v)


@dataclass(frozen=True)
class DirectionalDamping(Term):
    """Viscous damping that depends on the direction, as that of a shock absorber with a check valve."""

    at: str = "ground"
    name: ClassVar[str] = "directional_damping"
    physics: ClassVar[str] = "The damping in positive direction less that in negative direction is {difference}"
    formula: ClassVar[str] = "-difference/2 * |v|"
    paper: ClassVar[str] = "Surace, Worden, Tomlinson, Proc. IMechE D 206 (1992) 157-167"
    params = (Param("difference", "damping for v > 0 less that for v < 0", DAMPING, null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -0.5 * p[0] * abs(v)


@dataclass(frozen=True)
class DampingDrift(Term):
    """Viscous damping that changes at a constant rate while the machine runs, as with oil that warms up."""

    at: str = "ground"
    name: ClassVar[str] = "damping_drift"
    physics: ClassVar[str] = "The damping changes by {rate} while the machine runs"
    formula: ClassVar[str] = "-rate * t * v"
    paper: ClassVar[str] = "Isermann, Fault-Diagnosis Systems (2006), section 5.1: parameters that drift"
    params = (Param("rate", "growth of the damping", Dimension(1, -1, 0), null=0.0, prior=TermPrior(0.3)),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * t * v
