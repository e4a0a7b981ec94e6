"""Two bodies in a row, with play in the joint between them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Interface, Model, Motion, Param
from lostmotion.quantities import DAMPING, INERTIA, LENGTH, STIFFNESS
from lostmotion_plugins.laws import subtract_gap
from lostmotion_plugins.models.lin import ground


def joint(y: Array, u: Array) -> tuple[float, float]:
    """Return position and velocity of the first body relative to the second."""
    return y[0] - y[2], y[1] - y[3]


def second(y: Array, u: Array) -> tuple[float, float]:
    """Return position and velocity of the second body relative to the ground."""
    return y[2], y[3]


@dataclass(frozen=True)
class ClearanceChain(Model):
    """m1 x1'' + c1 x1' + k1 x1 + J = force, m2 x2'' + c2 x2' + k2 x2 = J + second_force, J = c0 d' + F(d), d = x1 - x2.

    F is zero inside the gap |d| < x0 and k0 (|d| - x0) beyond, with the sign of d. Channels without "second_" are those
    of the first body. On a table with the acceleration a, positions are relative to the table, -m a acts on each body,
    and the channels of acceleration are x'' + a. A term acts between the first body and its guide (`ground`), between
    the second body and its guide (`second`), or between the two bodies (`joint`).
    """

    name: ClassVar[str] = "clearance_chain"
    paper: ClassVar[str] = "Nordin, Gutman, Automatica 38 (2002) 1633-1649, section 2: two masses with backlash"
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity", "second_position", "second_velocity")
    inputs = ("force", "second_force", "base_acceleration")
    channels = (
        "position", "velocity", "acceleration", "second_position", "second_velocity", "second_acceleration",
    )  # fmt: skip
    params = (
        Param("m1", "mass of the first body", INERTIA, low=0.0, scale="log"),
        Param("c1", "viscous damping of the first body", DAMPING, low=0.0),
        Param("k1", "stiffness from the first body to the ground", STIFFNESS, low=0.0),
        Param("m2", "mass of the second body", INERTIA, low=0.0, scale="log"),
        Param("c2", "viscous damping of the second body", DAMPING, low=0.0),
        Param("k2", "stiffness from the second body to the ground", STIFFNESS, low=0.0),
        Param("k0", "stiffness of the joint in contact", STIFFNESS, low=0.0, scale="log"),
        Param("c0", "viscous damping across the joint", DAMPING, low=0.0),
        Param("x0", "half gap of the joint", LENGTH, low=0.0, scale="log"),
    )
    aliases: ClassVar[Mapping[str, str]] = {"m": "m1", "stiffness": "k0", "gap": "x0", "backlash": "x0"}
    interfaces = (
        Interface("ground", row=1, inertia="m1", motion=ground, holds=("k1",), stiffness="k1"),
        Interface(
            "joint", row=1, inertia="m1", motion=joint, holds=("k0", "x0"), stiffness="k0", play="x0", against=(3, "m2")
        ),
        Interface("second", row=3, inertia="m2", motion=second, holds=("k2",), stiffness="k2"),
    )

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        joint = p[7] * (y[1] - y[3]) + p[6] * subtract_gap(y[0] - y[2], p[8])
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - p[2] * y[0] - joint) / p[0] - u[2]
        dydt[2] = y[3]
        dydt[3] = (u[1] + joint - p[4] * y[3] - p[5] * y[2]) / p[3] - u[2]

    @staticmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        seen[0] = y[0]
        seen[1] = y[1]
        seen[2] = dydt[1] + u[2]
        seen[3] = y[2]
        seen[4] = y[3]
        seen[5] = dydt[3] + u[2]
