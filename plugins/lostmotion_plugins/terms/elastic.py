"""Forces that depend on position, and a constant force."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, Values
from lostmotion.quantities import FORCE, STIFFNESS, Dimension


@dataclass(frozen=True)
class LinearStiffness(Term):
    """A linear spring at the interface, in addition to those of the model."""

    at: str = "ground"
    name: ClassVar[str] = "linear_stiffness"
    physics: ClassVar[str] = "A further spring of {coefficient} acts about position zero"
    formula: ClassVar[str] = "-coefficient * x"
    paper: ClassVar[str] = "Nayfeh, Mook, Nonlinear Oscillations (1979), section 1.1"
    params = (Param("coefficient", "stiffness", STIFFNESS, null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * x


@dataclass(frozen=True)
class CubicStiffness(Term):
    """A spring that hardens (positive) or softens (negative) with the cube of travel, as in Duffing's equation."""

    at: str = "ground"
    name: ClassVar[str] = "cubic_stiffness"
    physics: ClassVar[str] = "A spring force of {coefficient} times the cube of position acts"
    formula: ClassVar[str] = "-coefficient * x^3"
    paper: ClassVar[str] = "Duffing (1918); Nayfeh, Mook, Nonlinear Oscillations (1979), section 4.1"
    params = (Param("coefficient", "cubic stiffness", Dimension(1, -3, 0), null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * x * x * x


@dataclass(frozen=True)
class QuadraticStiffness(Term):
    """A spring force with the square of travel, as that of a curved (buckled) beam."""

    at: str = "ground"
    name: ClassVar[str] = "quadratic_stiffness"
    physics: ClassVar[str] = "A spring force of {coefficient} times the square of position acts"
    formula: ClassVar[str] = "-coefficient * x^2"
    paper: ClassVar[str] = "Nayfeh, Mook, Nonlinear Oscillations (1979), section 4.4"
    params = (Param("coefficient", "quadratic stiffness", Dimension(1, -2, 0), null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * x * x


@dataclass(frozen=True)
class BilinearStiffness(Term):
    """A spring that is stiffer in one direction than in the other, as a crack that opens and closes."""

    at: str = "ground"
    name: ClassVar[str] = "bilinear_stiffness"
    physics: ClassVar[str] = "The spring is stiffer by {difference} on the positive side than on the negative one"
    formula: ClassVar[str] = "-difference/2 * |x|"
    paper: ClassVar[str] = "Shaw, Holmes, J. Sound and Vibration 90 (1983) 129-155, section 2"
    params = (Param("difference", "stiffness for x > 0 less that for x < 0", STIFFNESS, null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -0.5 * p[0] * abs(x)


@dataclass(frozen=True)
class OffsetForce(Term):
    """A constant force: a bias of the drive, a weight, a preload."""

    at: str = "ground"
    name: ClassVar[str] = "offset_force"
    physics: ClassVar[str] = "A constant force of {force} acts"
    formula: ClassVar[str] = "force"
    paper: ClassVar[str] = "Janot, Gautier, Brunot, Nonlinear System Identification Benchmarks workshop (2019)"
    params = (Param("force", "constant force in positive direction", FORCE, null=0.0),)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return p[0]


@dataclass(frozen=True)
class GravityPendulum(Term):
    """The weight of a link that turns in a vertical plane; its angle is measured from where it hangs straight down."""

    at: str = "ground"
    name: ClassVar[str] = "gravity_pendulum"
    physics: ClassVar[str] = "The weight of the link, {torque} when horizontal, pulls it down"
    formula: ClassVar[str] = "-torque * sin(x)"
    paper: ClassVar[str] = "Spong, Hutchinson, Vidyasagar, Robot Modeling and Control (2006), section 7.3"
    params = (Param("torque", "gravity torque of the horizontal link", FORCE, null=0.0),)
    needs = ("angle",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * math.sin(x)
