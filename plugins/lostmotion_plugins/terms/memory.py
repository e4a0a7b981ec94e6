"""Friction and hysteresis with a state of their own: the force is elastic before it slides."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Param, Term, TermPrior, Values
from lostmotion.quantities import FORCE, LENGTH, SPEED


@dataclass(frozen=True)
class DahlFriction(Term):
    """Dry friction through bristles that bend before they slide; the bristle force (N) is a state of its own.

    The rate is bounded by the step, so that the law stays stable where bristles are stiffer than one step resolves.
    """

    at: str = "ground"
    name: ClassVar[str] = "dahl_friction"
    extends: ClassVar[tuple[str, ...]] = ("coulomb_friction",)
    physics: ClassVar[str] = (
        "Dry friction of {force}, with {deflection} of elastic travel before it slides, opposes the motion"
    )
    formula: ClassVar[str] = "-f,  f' = |v|/deflection * (force * sign(v) - f)"
    paper: ClassVar[str] = "Dahl, AIAA Journal 14 (1976) 1675-1682, eq. (4) with i = 1"
    params = (
        Param("force", "sliding friction force", FORCE, low=0.0, null=0.0),
        Param("deflection", "elastic travel before sliding", LENGTH, low=0.0, scale="log", prior=TermPrior(0.05)),
    )
    states: ClassVar[Mapping[str, str]] = {"bristle_force": "force"}
    needs = ("step",)

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        return -s[0]

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        pace = min(abs(v) / p[1], 1.0 / p[2])
        level = p[0] if v > 0.0 else -p[0]
        dsdt[0] = pace * (level - s[0])


@dataclass(frozen=True)
class LuGreFriction(Term):
    """Bristle friction with a breakaway force: it is larger near rest, and elastic before it slides.

    The state is the bristle force f = sigma0 z. sigma1 = sigma2 = 0, since other terms model damping.
    """

    at: str = "ground"
    name: ClassVar[str] = "lugre_friction"
    extends: ClassVar[tuple[str, ...]] = ("coulomb_friction", "dahl_friction")
    physics: ClassVar[str] = (
        "Dry friction of {force}, rising by {excess} towards rest below {velocity}, with {deflection} of elastic travel"
        " before it slides, opposes the motion"
    )
    formula: ClassVar[str] = (
        "-f,  f' = |v|/deflection * (g sign(v) - f) * force/g,  g = force + excess * exp(-(v/velocity)^2)"
    )
    paper: ClassVar[str] = "Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Automatic Control 40 (1995) 419-425"
    params = (
        Param("force", "sliding friction force", FORCE, low=0.0, null=0.0),
        Param("excess", "breakaway friction above the sliding one", FORCE, low=0.0, null=0.0),
        Param("velocity", "Stribeck velocity", SPEED, low=0.0, scale="log", prior=TermPrior(0.1)),
        Param("deflection", "elastic travel before sliding", LENGTH, low=0.0, scale="log", prior=TermPrior(0.05)),
    )
    states: ClassVar[Mapping[str, str]] = {"bristle_force": "force"}
    needs = ("step",)

    force = staticmethod(DahlFriction.force)

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        level = p[0] + p[1] * math.exp(-((v / p[2]) ** 2))
        stiffer = p[0] / level if level > 0.0 else 1.0
        pace = min(abs(v) / p[3] * stiffer, 1.0 / p[4])
        dsdt[0] = pace * ((level if v > 0.0 else -level) - s[0])


@dataclass(frozen=True)
class BoucWenHysteresis(Term):
    """A hysteretic force that is elastic at first and then yields: the smooth loop of joints, rubber and wire rope.

    The state is the force f itself. With beta = gamma = 1/2 and n = 2, unloading is as stiff as the first loading.
    """

    at: str = "ground"
    name: ClassVar[str] = "bouc_wen_hysteresis"
    extends: ClassVar[tuple[str, ...]] = ("coulomb_friction",)
    physics: ClassVar[str] = "A hysteretic force that yields at {force} after {travel} of travel acts"
    formula: ClassVar[str] = "-f,  f' = (force * v - (|v| f |f| + v f^2) / (2 force)) / travel"
    paper: ClassVar[str] = "Wen, J. Engineering Mechanics Division ASCE 102 (1976) 249-263; Bouc (1967)"
    params = (
        Param("force", "yield force", FORCE, low=0.0, null=0.0),
        Param("travel", "yield force over the initial stiffness", LENGTH, low=0.0, scale="log", prior=TermPrior(0.3)),
    )
    states: ClassVar[Mapping[str, str]] = {"hysteretic_force": "force"}
    needs = ("step",)

    force = staticmethod(DahlFriction.force)

    @staticmethod
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        f = s[0]
        pace = min(abs(v) / p[1], 1.0 / p[2])
        sense = 1.0 if v > 0.0 else -1.0
        dsdt[0] = pace * (sense * p[0] - 0.5 * (f * abs(f) + sense * f * f) / p[0]) if p[0] > 0.0 else 0.0
