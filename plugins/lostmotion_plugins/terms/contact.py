"""What happens where the parts touch: losses in the contact, and a gap that is wider on one side."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, Values
from lostmotion.quantities import DAMPING, LENGTH


@dataclass(frozen=True)
class ContactDamping(Term):
    """A drag that acts only while the parts touch, |x| > x0."""

    at: str = "ground"
    name: ClassVar[str] = "contact_damping"
    physics: ClassVar[str] = "The contact itself dissipates, with {coefficient} while the parts touch"
    formula: ClassVar[str] = "-coefficient * v where |x| > x0"
    paper: ClassVar[str] = "Gilardi, Sharf, Mechanism and Machine Theory 37 (2002) 1213-1239, section 4.1"
    params = (Param("coefficient", "damping in contact", DAMPING, low=0.0, null=0.0),)
    needs = ("x0",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -p[0] * v if abs(x) > p[1] else 0.0


@dataclass(frozen=True)
class AsymmetricGap(Term):
    """A gap whose middle is not at zero: both stops are shifted by the same travel."""

    at: str = "ground"
    name: ClassVar[str] = "asymmetric_gap"
    physics: ClassVar[str] = "The gap is not centred: it is shifted by {shift}"
    formula: ClassVar[str] = "F(x) - F(x - shift), F the contact force of the model"
    paper: ClassVar[str] = "Theodossiades, Natsiavas, J. Sound and Vibration 229 (2000) 287-310, eq. (3)"
    params = (Param("shift", "shift of the middle of the gap", LENGTH, null=0.0, typical=0.3),)
    needs = ("k0", "x0")

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        k0 = p[1]
        x0 = p[2]
        y = x - p[0]
        old = k0 * (x - x0) if x > x0 else (k0 * (x + x0) if x < -x0 else 0.0)
        new = k0 * (y - x0) if y > x0 else (k0 * (y + x0) if y < -x0 else 0.0)
        return old - new
