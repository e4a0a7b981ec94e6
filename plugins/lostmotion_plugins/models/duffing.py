"""Duffing's oscillator: a spring with a cubic part, with one or two potential wells."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Interface, Model, Motion, Param
from lostmotion.quantities import DAMPING, INERTIA, STIFFNESS, Dimension
from lostmotion_plugins.models.lin import LinBacklash, ground


@dataclass(frozen=True)
class Duffing(Model):
    """m (x'' + a) + c x' + k x + k3 x^3 = force: a spring that hardens or softens, or with k < 0 < k3 a buckled beam.

    With k < 0 there are two wells, at x = +-sqrt(-k / k3), and with k = 0 it is the oscillator of Ueda. The base
    acceleration a is that of a shaking table that carries the spring; x is relative to the table.
    """

    name: ClassVar[str] = "duffing"
    paper: ClassVar[str] = "Duffing (1918); Ueda, J. Statistical Physics 20 (1979) 181-196"
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity")
    inputs = ("force", "base_acceleration")
    channels = ("position", "velocity", "acceleration")
    params = (
        Param("m", "mass", INERTIA, low=0.0, scale="log"),
        Param("c", "viscous damping", DAMPING, low=0.0, scale="log"),
        Param("k", "stiffness at zero, below 0 where there are two wells", STIFFNESS),
        Param("k3", "cubic stiffness", Dimension(1, -3, 0)),
    )
    aliases: ClassVar[Mapping[str, str]] = {"mass": "m", "damping": "c", "k1": "k", "stiffness": "k", "cubic": "k3"}
    interfaces = (Interface("ground", row=1, inertia="m", motion=ground, holds=("k", "k3")),)

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        x = y[0]
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - (p[2] + p[3] * x * x) * x) / p[0] - u[1]

    observe = staticmethod(LinBacklash.observe)
