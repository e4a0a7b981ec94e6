"""Properties that change while the machine runs: a stiffness that pulsates, a gap that wears."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, TermPrior, Values
from lostmotion.quantities import NUMBER, SPEED
from lostmotion_plugins.laws import describe_wave, subtract_gap

RATIO = Param("ratio", "frequency over that of the drive", NUMBER, low=0.0, scale="log")
"""The frequency of a wave; a term gives it the choices that are usual for its cause."""
DEPTH = Param("depth", "share of the stiffness that pulsates", NUMBER)


@dataclass(frozen=True)
class ParametricStiffness(Term):
    """A stiffness that pulsates with a multiple of the drive frequency, as that of meshing teeth.

    Cosine and sine are shares of the stiffness. They give the depth sqrt(cosine^2 + sine^2) and a phase.
    """

    at: str = "ground"
    name: ClassVar[str] = "parametric_stiffness"
    physics: ClassVar[str] = (
        "The stiffness pulsates at {ratio} times the frequency of the drive: by {cosine} of its mean as a cosine and"
        " {sine} as a sine"
    )
    formula: ClassVar[str] = "-(cosine * cos(ratio omega t) + sine * sin(ratio omega t)) * F(x), F the contact force"
    paper: ClassVar[str] = "Theodossiades, Natsiavas, J. Sound and Vibration 229 (2000) 287-310, eq. (5)"
    params = (
        Param(
            "cosine",
            "share of the stiffness that pulsates as cos(ratio omega t)",
            NUMBER,
            null=0.0,
            prior=TermPrior(0.2),
        ),
        Param(
            "sine", "share of the stiffness that pulsates as sin(ratio omega t)", NUMBER, null=0.0, prior=TermPrior(0.2)
        ),
        replace(RATIO, prior=TermPrior(choices=(1.0, 2.0, 3.0, 0.5))),
    )
    needs = ("stiffness", "play", "omega")

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        beyond = subtract_gap(x, p[4])
        if beyond == 0.0:
            return 0.0
        angle = p[2] * p[5] * t
        return -(p[0] * math.cos(angle) + p[1] * math.sin(angle)) * p[3] * beyond

    @staticmethod
    def derived(p: Values) -> Mapping[Param, float]:
        return describe_wave(DEPTH, p[0], p[1])


@dataclass(frozen=True)
class GapDrift(Term):
    """A gap that grows or shrinks at a constant rate, by wear or by heat."""

    at: str = "ground"
    name: ClassVar[str] = "gap_drift"
    physics: ClassVar[str] = "The half gap changes by {rate} while the machine runs"
    formula: ClassVar[str] = "F(x; x0) - F(x; x0 + rate * t), F the contact force of the model"
    paper: ClassVar[str] = "Flodin, Andersson, Wear 207 (1997) 16-23: wear as travel times load"
    params = (Param("rate", "growth of the half gap", SPEED, null=0.0, prior=TermPrior(0.1, lasting=True)),)
    needs = ("k0", "x0")

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        changed = max(p[2] + p[0] * t, 0.0)
        return p[1] * (subtract_gap(x, p[2]) - subtract_gap(x, changed))
