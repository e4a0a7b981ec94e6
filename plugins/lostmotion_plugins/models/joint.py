"""A robot link behind a joint with backlash, driven by the measured motion of its motor side."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Drive, Flow, Group, Interface, Model, Param
from lostmotion.quantities import DAMPING, FORCE, INERTIA, LENGTH, STIFFNESS
from lostmotion_plugins.laws import subtract_gap
from lostmotion_plugins.models.lin import CONTACT_ALIASES


def ground(y: Array, u: Array) -> tuple[float, float]:
    """Return angle and angular velocity of the link relative to the ground (its bearing)."""
    return y[0], y[1]


def base(y: Array, u: Array) -> tuple[float, float]:
    """Return angle and angular velocity of the link relative to the motor side of the joint (its backlash)."""
    return y[0] - u[0], y[1] - u[1]


@dataclass(frozen=True)
class RobotJoint(Model):
    """J q'' + c (q' - qb') + F(q - qb) + mgl sin q = force: a link q moved by a base motion qb through a gap.

    The contact F is zero inside the gap |q - qb| < x0 and k0 (|q - qb| - x0) beyond. Encoder 1 reads qb (the input),
    encoder 2 reads q (the channel "position"), a torque sensor reads the torque through contact and damper (the channel
    "force"; a term at the place "base" is not part of it). The input "force" is a torque on the link. The angle is
    measured from where the link hangs straight down; mgl = 0 for a link that turns in the horizontal plane. The
    dimensionless groups hold for such a link only: weight depends on the angle itself, not on its ratio to the gap.
    """

    name: ClassVar[str] = "robot_joint"
    paper: ClassVar[str] = "Tjahjowidodo, Al-Bender, Van Brussel, MSSP 21 (2007) 973-986, section 6 and Fig. 1"
    motion = "rotation"
    states = ("position", "velocity")
    inputs = ("base_position", "base_velocity", "force")
    channels = ("position", "velocity", "acceleration", "force")
    params = (
        Param("m", "moment of inertia of the link", INERTIA, low=0.0, scale="log"),
        Param("c", "viscous damping in the joint", DAMPING, low=0.0, scale="log"),
        Param("k0", "stiffness of the joint in contact", STIFFNESS, low=0.0, scale="log"),
        Param("x0", "half of the backlash", LENGTH, low=0.0, scale="log"),
        Param("mgl", "gravity torque of the horizontal link", FORCE),
    )
    aliases: ClassVar[Mapping[str, str]] = {"J": "m", "inertia": "m", **CONTACT_ALIASES, "gravity": "mgl"}
    interfaces = (
        Interface("base", row=1, inertia="m", motion=base, holds=("k0", "x0"), stiffness="k0", play="x0"),
        Interface("ground", row=1, inertia="m", motion=ground),
    )
    groups = (
        Group("zeta", "damping ratio", "c / (2 sqrt(k0 m))", "c", lambda q, n: 2.0 * n * math.sqrt(q["k0"] * q["m"])),
        Group(
            "frequency_ratio", "frequency of the drive", "omega / sqrt(k0 / m)", "drive.omega",
            lambda q, n: n * math.sqrt(q["k0"] / q["m"]),
        ),
        Group("alpha", "amplitude of the base motion", "A / x0", "drive.amplitude", lambda q, n: n * q["x0"]),
    )  # fmt: skip

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        contact = p[2] * subtract_gap(y[0] - u[0], p[3])
        dydt[0] = y[1]
        dydt[1] = -(p[1] * (y[1] - u[1]) + contact + p[4] * math.sin(y[0]) - u[2]) / p[0]

    @staticmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        seen[0] = y[0]
        seen[1] = y[1]
        seen[2] = dydt[1]
        seen[3] = p[1] * (u[1] - y[1]) + p[2] * subtract_gap(u[0] - y[0], p[3])

    @classmethod
    def exact(cls, values: Mapping[str, float], drive: Drive, start: Array | None) -> Flow | None:
        """Return the flow under a base motion (amplitude, omega, phase), exact where the link has no weight."""
        from lostmotion_plugins.models.exact import solve_joint_exactly

        return solve_joint_exactly(values, drive, start)
