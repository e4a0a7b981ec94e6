"""A machine: states, inputs, channels, parameters, and two functions in plain scalar Python."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Interface, Model, Param
from lostmotion.quantities import DAMPING, FORCE, INERTIA


def bearing(y: Array, u: Array) -> tuple[float, float]:
    """Return angle and angular velocity in the bearing, where terms act."""
    return y[0], y[1]


@dataclass(frozen=True)
class DrivenPendulum(Model):
    """J q'' + c q' + mgl sin q = torque: a pendulum moved by a motor at its bearing; q is 0 where it hangs."""

    name: ClassVar[str] = "driven_pendulum"
    paper: ClassVar[str] = "Baker, Gollub, Chaotic Dynamics: An Introduction (1996)"
    motion = "rotation"
    states = ("position", "velocity")
    inputs = ("force",)
    channels = ("position", "velocity")
    params = (
        Param("m", "moment of inertia", INERTIA, low=0.0, scale="log"),
        Param("c", "viscous damping in the bearing", DAMPING, low=0.0, scale="log"),
        Param("mgl", "gravity torque of the horizontal pendulum", FORCE, low=0.0),
    )
    aliases: ClassVar[Mapping[str, str]] = {"J": "m", "inertia": "m", "damping": "c", "gravity": "mgl"}
    interfaces = (Interface("ground", row=1, inertia="m", motion=bearing),)

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - p[2] * math.sin(y[0])) / p[0]

    @staticmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        seen[0] = y[0]
        seen[1] = y[1]
