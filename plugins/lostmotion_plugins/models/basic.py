"""Machines without a gap: a mass on a guide, and a mass on a spring."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Interface, Model, Motion, Param
from lostmotion.quantities import DAMPING, INERTIA, STIFFNESS
from lostmotion_plugins.models.lin import LinBacklash, ground

_GROUND = Interface("ground", row=1, inertia="m", motion=ground)
_MASS = Param("m", "moving mass", INERTIA, low=0.0, scale="log")
_DAMPING = Param("c", "viscous friction", DAMPING, low=0.0, scale="log")
_ALIASES = {"M": "m", "mass": "m", "Fv": "c", "damping": "c"}


@dataclass(frozen=True)
class RigidDrive(Model):
    """m (x'' + a) + c x' = force: a carriage moved by a motor, as that of the EMPS benchmark of Janot et al. (2019).

    The base acceleration a is that of the table that carries it; x is relative to the table.
    """

    name: ClassVar[str] = "rigid_drive"
    paper: ClassVar[str] = "Janot, Gautier, Brunot, Nonlinear System Identification Benchmarks workshop (2019)"
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity")
    inputs = ("force", "base_acceleration")
    channels = ("position", "velocity", "acceleration")
    params = (_MASS, _DAMPING)
    aliases: ClassVar[Mapping[str, str]] = _ALIASES
    interfaces = (_GROUND,)

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1]) / p[0] - u[1]

    observe = staticmethod(LinBacklash.observe)


@dataclass(frozen=True)
class LinearOscillator(Model):
    """m (x'' + a) + c x' + k x = force: the linear oscillator, which is the nominal model of the Silverbox benchmark.

    The base acceleration a is that of a shaking table that carries the spring; x is relative to the table.
    """

    name: ClassVar[str] = "linear_oscillator"
    paper: ClassVar[str] = "Wigren, Schoukens, European Control Conference (2013), the linear part"
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity")
    inputs = ("force", "base_acceleration")
    channels = ("position", "velocity", "acceleration")
    params = (_MASS, _DAMPING, Param("k", "stiffness", STIFFNESS, low=0.0, scale="log"))
    aliases: ClassVar[Mapping[str, str]] = {**_ALIASES, "k1": "k", "stiffness": "k"}
    interfaces = (Interface("ground", row=1, inertia="m", motion=ground, holds=("k",), stiffness="k"),)

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - p[2] * y[0]) / p[0] - u[1]

    observe = staticmethod(LinBacklash.observe)
