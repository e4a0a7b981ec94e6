"""Dry friction laws with a jump at zero velocity, which is resolved as a steep line (`laws.resist_sliding`)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, TermPrior, Values
from lostmotion.quantities import FORCE, SPEED
from lostmotion_plugins.laws import resist_sliding

NEGLIGIBLE_SHARE = 0.05
"""A part of a friction force below this share of it is dropped from the answer, where the evidence is no worse.

In long recordings the integration errors of our own laws are significant: Coulomb friction then came back as Stribeck
friction with an excess of 2 % (`benchmarks/seconds.py friction_200k`)."""


@dataclass(frozen=True)
class CoulombFriction(Term):
    """Dry friction of constant size. To model sticking, the law is a steep line below the speed `force * mobility`."""

    at: str = "ground"
    name: ClassVar[str] = "coulomb_friction"
    physics: ClassVar[str] = "Dry friction of {force} opposes the motion"
    formula: ClassVar[str] = "-force * sign(v)"
    paper: ClassVar[str] = "Coulomb (1785); Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138"
    params = (Param("force", "friction force", FORCE, low=0.0, null=0.0),)
    needs = ("mobility",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return resist_sliding(v, p[0], abs(p[0]) * p[1])


@dataclass(frozen=True)
class StribeckFriction(Term):
    """Dry friction that is larger near rest and falls to its sliding value as the velocity rises."""

    at: str = "ground"
    name: ClassVar[str] = "stribeck_friction"
    extends: ClassVar[tuple[str, ...]] = ("coulomb_friction",)
    physics: ClassVar[str] = (
        "Dry friction of {force}, rising by {excess} towards rest below {velocity}, opposes the motion"
    )
    formula: ClassVar[str] = "-(force + excess * exp(-(v/velocity)^2)) * sign(v)"
    paper: ClassVar[str] = "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138, eq. (6)"
    params = (
        Param("force", "sliding friction force", FORCE, low=0.0, null=0.0),
        Param("excess", "breakaway friction above the sliding one", FORCE, low=0.0, null=0.0),
        Param("velocity", "Stribeck velocity", SPEED, low=0.0, scale="log", prior=TermPrior(0.1)),
    )
    needs = ("mobility",)

    def commoner(self, values: Mapping[str, float]) -> Mapping[str, Mapping[str, float]]:
        """Return Coulomb friction of the sliding level where the excess is negligible."""
        level = values["force"]
        return {"coulomb_friction": {"force": level}} if values["excess"] < NEGLIGIBLE_SHARE * level else {}

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        level = p[0] + p[1] * math.exp(-((v / p[2]) ** 2))
        return resist_sliding(v, level, (abs(p[0]) + abs(p[1])) * p[3])
