"""Dry friction as laws that jump at zero velocity."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, Values
from lostmotion.quantities import FORCE, SPEED

NOTHING = 0.05
"""A part of a friction force below this share of it is told as nothing, where the evidence is no worse."""


@dataclass(frozen=True)
class CoulombFriction(Term):
    """Dry friction of constant size. It sticks: below the velocity `force * mobility` the law is a steep line."""

    at: str = "ground"
    name: ClassVar[str] = "coulomb_friction"
    physics: ClassVar[str] = "Dry friction of {force} opposes the motion"
    formula: ClassVar[str] = "-force * sign(v)"
    paper: ClassVar[str] = "Coulomb (1785); Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138"
    params = (Param("force", "friction force", FORCE, low=0.0, null=0.0),)
    needs = ("mobility",)
    resembles = ("stribeck_friction", "lugre_friction", "dahl_friction")

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        width = abs(p[0]) * p[1]
        if abs(v) >= width:
            return -p[0] if v > 0.0 else (p[0] if v < 0.0 else 0.0)
        return -p[0] * v / width


@dataclass(frozen=True)
class StribeckFriction(Term):
    """Dry friction that is larger near rest and falls to its sliding value as the velocity rises."""

    at: str = "ground"
    name: ClassVar[str] = "stribeck_friction"
    physics: ClassVar[str] = (
        "Dry friction of {force}, rising by {excess} towards rest below {velocity}, opposes the motion"
    )
    formula: ClassVar[str] = "-(force + excess * exp(-(v/velocity)^2)) * sign(v)"
    paper: ClassVar[str] = "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138, eq. (6)"
    params = (
        Param("force", "sliding friction force", FORCE, low=0.0, null=0.0),
        Param("excess", "breakaway friction above the sliding one", FORCE, low=0.0, null=0.0),
        Param("velocity", "Stribeck velocity", SPEED, low=0.0, scale="log", typical=0.1),
    )
    needs = ("mobility",)
    resembles = ("coulomb_friction", "lugre_friction", "dahl_friction")

    def commoner(self, values: Mapping[str, float]) -> Mapping[str, Mapping[str, float]]:
        """Return friction of one level where the excess is next to nothing."""
        level = values["force"]
        return {"coulomb_friction": {"force": level}} if values["excess"] < NOTHING * level else {}

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        size = p[0] + p[1] * math.exp(-((v / p[2]) ** 2))
        width = (abs(p[0]) + abs(p[1])) * p[3]
        if abs(v) >= width:
            return -size if v > 0.0 else (size if v < 0.0 else 0.0)
        return -size * v / width
