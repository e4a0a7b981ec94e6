"""The mesh of two gears with one degree of freedom, the transmission error."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Group, Interface, Model, Motion, Param
from lostmotion.quantities import DAMPING, FORCE, INERTIA, LENGTH, NUMBER, STIFFNESS, Dimension
from lostmotion_plugins.laws import subtract_gap
from lostmotion_plugins.models.lin import CONTACT_ALIASES, LinBacklash, ground

MESH_GROUPS = (
    Group("depth", "share of the stiffness that pulsates", "kappa", "kappa", lambda q, n: n),
    Group(
        "mesh_ratio", "frequency of the mesh over that of the drive", "omega_mesh / omega", "omega_mesh",
        lambda q, n: n * q["drive.omega"],
    ),
)  # fmt: skip
"""Dimensionless groups of the pulsating stiffness of a mesh."""


@dataclass(frozen=True)
class GearMesh(Model):
    """m (x'' + a) + c x' + k(t) F(x) = preload + force: a mesh of k(t) = k0 (1 + kappa cos(omega_mesh t + phase)).

    Here x is the transmission error along the line of action, and F = 0 inside the gap |x| < x0 and |x| - x0 beyond,
    with the sign of x. With base radii r1, r2 and inertias J1, J2, m is 1 / (r1^2 / J1 + r2^2 / J2), and a torque T on
    the first gear is the force m r1 T / J1. The mean load is `preload`; `force` is the alternating part of the load,
    and the base acceleration a is that of a profile error of the teeth. `gear_pair` has an encoder on each wheel.
    Time, and with it the phase of the mesh, is zero at the start of the recording. For a sweep of exponents
    `omega_mesh` must be an integer multiple of the frequency of the drive.
    """

    name: ClassVar[str] = "gear_mesh"
    paper: ClassVar[str] = "Theodossiades, Natsiavas, J. Sound and Vibration 229 (2000) 287-310"
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity")
    inputs = ("force", "base_acceleration")
    channels = ("position", "velocity", "acceleration")
    params = (
        Param("m", "equivalent mass", INERTIA, low=0.0, scale="log"),
        Param("c", "viscous damping of the mesh", DAMPING, low=0.0, scale="log"),
        Param("k0", "mean stiffness of the mesh", STIFFNESS, low=0.0, scale="log"),
        Param("x0", "half of the backlash", LENGTH, low=0.0, scale="log"),
        Param("preload", "mean load, as a force along the line of action", FORCE),
        Param("kappa", "share of the stiffness that pulsates", NUMBER, low=0.0, high=1.0),
        Param("omega_mesh", "angular frequency at which teeth mesh (rad/s)", Dimension(0, 0, -1), low=0.0),
        Param("phase", "phase of the mesh at the start (rad)", NUMBER),
    )
    aliases: ClassVar[Mapping[str, str]] = {"mass": "m", **CONTACT_ALIASES, "load": "preload"}
    interfaces = (Interface("ground", row=1, inertia="m", motion=ground, holds=("x0",), stiffness="k0", play="x0"),)
    groups = (
        Group("zeta", "damping ratio", "c / (2 sqrt(k0 m))", "c", lambda q, n: 2.0 * n * math.sqrt(q["k0"] * q["m"])),
        Group(
            "frequency_ratio", "frequency of the drive", "omega / sqrt(k0 / m)", "drive.omega",
            lambda q, n: n * math.sqrt(q["k0"] / q["m"]),
        ),
        Group("alpha", "amplitude of the drive", "A / (k0 x0)", "drive.amplitude", lambda q, n: n * q["k0"] * q["x0"]),
        Group("load_ratio", "mean load", "preload / (k0 x0)", "preload", lambda q, n: n * q["k0"] * q["x0"]),
        *MESH_GROUPS,
    )  # fmt: skip

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        stiffness = p[2] * (1.0 + p[5] * math.cos(p[6] * t + p[7]))
        dydt[0] = y[1]
        dydt[1] = (p[4] + u[0] - p[1] * y[1] - stiffness * subtract_gap(y[0], p[3])) / p[0] - u[1]

    observe = staticmethod(LinBacklash.observe)
