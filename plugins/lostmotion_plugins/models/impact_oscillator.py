"""An oscillator that hits a stop on one side."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Group, Interface, Model, Motion, Param
from lostmotion.quantities import DAMPING, INERTIA, LENGTH, STIFFNESS, Dimension
from lostmotion_plugins.models.lin import LinBacklash, ground


@dataclass(frozen=True)
class ImpactOscillator(Model):
    """m (x'' + a) + c x' + k x + P = force, with the force of the stop P = k0 (x - x0) (1 + loss x') where x > x0.

    The stop cannot pull: P is zero where the formula is negative. As the damping grows with the depth (Hunt, Crossley),
    the force does not jump at first contact. The coefficient of restitution is one for slow impacts and falls with the
    speed: a body that arrives with v leaves with w, where s - ln(1 + s) is the same for s = loss v and s = -loss w. The
    base acceleration a is that of a shaking table that carries spring and stop; x is relative to the table.
    """

    name: ClassVar[str] = "impact_oscillator"
    paper: ClassVar[str] = (
        "Shaw, Holmes, J. Sound and Vibration 90 (1983) 129-155; Hunt, Crossley, J. Applied Mechanics 42 (1975) 440-445"
    )
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity")
    inputs = ("force", "base_acceleration")
    channels = ("position", "velocity", "acceleration")
    params = (
        Param("m", "mass", INERTIA, low=0.0, scale="log"),
        Param("c", "viscous damping", DAMPING, low=0.0, scale="log"),
        Param("k", "stiffness of the spring", STIFFNESS, low=0.0, scale="log"),
        Param("k0", "stiffness of the stop", STIFFNESS, low=0.0, scale="log"),
        Param("x0", "position of the stop", LENGTH, low=0.0, scale="log"),
        Param("loss", "loss of the stop: its damping over stiffness times depth", Dimension(0, -1, 1), low=0.0),
    )
    aliases: ClassVar[Mapping[str, str]] = {"mass": "m", "damping": "c", "k1": "k", "stiffness": "k", "gap": "x0"}
    interfaces = (Interface("ground", row=1, inertia="m", motion=ground, holds=("k",), stiffness="k"),)
    groups = (
        Group("zeta", "damping ratio", "c / (2 sqrt(k m))", "c", lambda q, n: 2.0 * n * math.sqrt(q["k"] * q["m"])),
        Group(
            "frequency_ratio", "frequency of the drive", "omega / sqrt(k / m)", "drive.omega",
            lambda q, n: n * math.sqrt(q["k"] / q["m"]),
        ),
        Group("alpha", "amplitude of the drive", "A / (k x0)", "drive.amplitude", lambda q, n: n * q["k"] * q["x0"]),
        Group("stiffness_ratio", "stiffness of the stop", "k0 / k", "k0", lambda q, n: n * q["k"]),
    )  # fmt: skip

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        push = 0.0
        if y[0] > p[4]:
            push = max(p[3] * (y[0] - p[4]) * (1.0 + p[5] * y[1]), 0.0)
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - p[2] * y[0] - push) / p[0] - u[1]

    observe = staticmethod(LinBacklash.observe)
