"""What changes while the machine runs: a stiffness that pulsates, a gap that wears."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, Values
from lostmotion.quantities import NUMBER, SPEED


@dataclass(frozen=True)
class ParametricStiffness(Term):
    """A stiffness that pulsates with the drive or a multiple of it, as where teeth mesh.

    Cosine and sine are shares of the stiffness; together they are the depth sqrt(cosine^2 + sine^2) and a phase.
    """

    at: str = "ground"
    name: ClassVar[str] = "parametric_stiffness"
    unlikely: ClassVar[float] = 3.0
    physics: ClassVar[str] = (
        "The stiffness pulsates at {ratio} times the frequency of the drive, by {cosine} of it as its cosine and {sine}"
        " as its sine"
    )
    formula: ClassVar[str] = "-(cosine * cos(ratio omega t) + sine * sin(ratio omega t)) * F(x), F the contact force"
    paper: ClassVar[str] = "Theodossiades, Natsiavas, J. Sound and Vibration 229 (2000) 287-310, eq. (5)"
    params = (
        Param("cosine", "share of the stiffness that pulsates as cos(ratio omega t)", NUMBER, null=0.0, typical=0.2),
        Param("sine", "share of the stiffness that pulsates as sin(ratio omega t)", NUMBER, null=0.0, typical=0.2),
        Param("ratio", "frequency over that of the drive", NUMBER, low=0.0, choices=(1.0, 2.0, 3.0, 0.5)),
    )
    further = (Param("depth", "share of the stiffness that pulsates", NUMBER), Param("phase", "phase in rad", NUMBER))
    needs = ("stiffness", "play", "omega")

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        beyond = x - p[4] if x > p[4] else (x + p[4] if x < -p[4] else 0.0)
        if beyond == 0.0:
            return 0.0
        angle = p[2] * p[5] * t
        return -(p[0] * math.cos(angle) + p[1] * math.sin(angle)) * p[3] * beyond

    @staticmethod
    def derived(p: Values) -> Values:
        return math.hypot(p[0], p[1]), math.atan2(-p[1], p[0])


@dataclass(frozen=True)
class GapDrift(Term):
    """A gap that grows or shrinks steadily: wear, or heat."""

    at: str = "ground"
    name: ClassVar[str] = "gap_drift"
    physics: ClassVar[str] = "The half gap changes by {rate} while the machine runs"
    formula: ClassVar[str] = "F(x; x0) - F(x; x0 + rate * t), F the contact force of the model"
    paper: ClassVar[str] = "Flodin, Andersson, Wear 207 (1997) 16-23: wear as travel times load"
    params = (Param("rate", "growth of the half gap", SPEED, null=0.0, typical=0.1, lasting=True),)
    needs = ("k0", "x0")

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        wide = max(p[2] + p[0] * t, 0.0)
        old = x - p[2] if x > p[2] else (x + p[2] if x < -p[2] else 0.0)
        new = x - wide if x > wide else (x + wide if x < -wide else 0.0)
        return p[1] * (old - new)
