"""Terms of a contact with play: damping in the contact, a gap that is not centred, a nonlinear contact stiffness."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, TermPrior, Values
from lostmotion.quantities import DAMPING, LENGTH, Dimension
from lostmotion_plugins.laws import subtract_gap


@dataclass(frozen=True)
class ContactDamping(Term):
    """Viscous damping that acts only while the parts touch, |x| > x0."""

    at: str = "ground"
    name: ClassVar[str] = "contact_damping"
    physics: ClassVar[str] = "The contact has a viscous damping of {coefficient} while the parts touch"
    formula: ClassVar[str] = "-coefficient * v where |x| > x0"
    paper: ClassVar[str] = "Gilardi, Sharf, Mechanism and Machine Theory 37 (2002) 1213-1239, section 4.1"
    params = (Param("coefficient", "damping in contact", DAMPING, low=0.0, null=0.0),)
    needs = ("x0",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * v if abs(x) > p[1] else 0.0


@dataclass(frozen=True)
class AsymmetricGap(Term):
    """A gap whose centre is not at zero: both stops are shifted by the same travel."""

    at: str = "ground"
    name: ClassVar[str] = "asymmetric_gap"
    physics: ClassVar[str] = "The gap is not centred: it is shifted by {shift}"
    formula: ClassVar[str] = "F(x) - F(x - shift), F the contact force of the model"
    paper: ClassVar[str] = "Theodossiades, Natsiavas, J. Sound and Vibration 229 (2000) 287-310, eq. (3)"
    params = (Param("shift", "shift of the centre of the gap", LENGTH, null=0.0, prior=TermPrior(0.3)),)
    needs = ("k0", "x0")

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return p[1] * subtract_gap(x, p[2]) - p[1] * subtract_gap(x - p[0], p[2])


@dataclass(frozen=True)
class HuntCrossleyContact(Term):
    """Contact damping that is proportional to the depth of the contact, so that the force is continuous at touch."""

    at: str = "ground"
    name: ClassVar[str] = "hunt_crossley_contact"
    physics: ClassVar[str] = "The damping of the contact grows with its depth: it is {coefficient} times the depth"
    formula: ClassVar[str] = "-coefficient * d * v, d = |x| - x0 where that is positive, else 0"
    paper: ClassVar[str] = "Hunt, Crossley, J. Applied Mechanics 42 (1975) 440-445, eq. (9) with n = 1"
    params = (
        Param(
            "coefficient",
            "damping over depth of the contact",
            Dimension(1, -2, 1),
            low=0.0,
            null=0.0,
            prior=TermPrior(3.0),
        ),
    )
    needs = ("x0",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * max(abs(x) - p[1], 0.0) * v


@dataclass(frozen=True)
class HertzContact(Term):
    """A Hertzian contact of curved bodies in parallel to the linear contact of the model: the force is depth^(3/2)."""

    at: str = "ground"
    name: ClassVar[str] = "hertz_contact"
    physics: ClassVar[str] = "The contact has a further force of {coefficient} times its depth to the power of 3/2"
    formula: ClassVar[str] = "-coefficient * d^(3/2) * sign(x), d = |x| - x0 where that is positive, else 0"
    paper: ClassVar[str] = "Hertz, J. reine angewandte Mathematik 92 (1882) 156-171; Johnson, Contact Mechanics (1985)"
    params = (Param("coefficient", "Hertzian stiffness", Dimension(1, -1.5, 0), null=0.0, prior=TermPrior(3.0)),)
    needs = ("x0",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        depth = max(abs(x) - p[1], 0.0)
        push = p[0] * depth * math.sqrt(depth)
        return -push if x > 0.0 else push
