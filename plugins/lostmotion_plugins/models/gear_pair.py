"""Two gear wheels with backlash between their teeth, each with an encoder of its own."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Group, Interface, Model, Motion, Param
from lostmotion.quantities import DAMPING, FORCE, INERTIA, LENGTH, NUMBER, STIFFNESS, Dimension
from lostmotion_plugins.laws import subtract_gap
from lostmotion_plugins.models.clearance_chain import ClearanceChain, second
from lostmotion_plugins.models.gear_mesh import MESH_GROUPS
from lostmotion_plugins.models.lin import ground


def mesh(y: Array, u: Array, ratio: float) -> tuple[float, float]:
    """Return deflection of the mesh and its rate, measured at the first wheel."""
    return y[0] - ratio * y[2], y[1] - ratio * y[3]


def _reduce_inertia(q: Mapping[str, float]) -> float:
    """Return the effective inertia (at the first wheel) of the relative motion of the two wheels."""
    return 1.0 / (1.0 / q["m1"] + q["ratio"] ** 2 / q["m2"])


@dataclass(frozen=True)
class GearPair(Model):
    """m1 x1'' + c1 x1' = force - G, m2 x2'' + c2 x2' = ratio G - load + second_force, G = c d' + k(t) F(d).

    Here d = x1 - ratio x2 is the deflection of the mesh, measured at the first wheel, and `ratio` is the number of
    turns of the first wheel for one turn of the second. F = 0 inside the gap |d| < x0 and |d| - x0 beyond, with the
    sign of d; the mesh has the stiffness k(t) = k0 (1 + kappa cos(omega_mesh t + phase)). In rotation x1 and x2 are the
    angles of the wheels, with signs such that both grow when the wheels turn together; in translation they are travels
    along the line of action, and the ratio is 1. Channels without "second_" are those of the first wheel;
    `second_force` acts on the second one, as that of a brake. Where the bearings stand on a table with the acceleration
    a, x1 and x2 are relative to it, -m a acts on each, and the channels of acceleration are x'' + a; in rotation the
    sign of a is that of both angles. A term acts in the bearing of the first wheel (`ground`) or of the second
    (`second`), or between the teeth (`mesh`). Time, and with it the phase of the mesh, is zero at the start of the
    recording.
    """

    name: ClassVar[str] = "gear_pair"
    paper: ClassVar[str] = (
        "Kahraman, Singh, J. Sound and Vibration 142 (1990) 49-75, section 2;"
        " Theodossiades, Natsiavas, J. Sound and Vibration 229 (2000) 287-310"
    )
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ClearanceChain.states
    inputs = ClearanceChain.inputs
    channels = ClearanceChain.channels
    params = (
        Param("m1", "inertia of the first wheel", INERTIA, low=0.0, scale="log"),
        Param("c1", "viscous damping in the bearing of the first wheel", DAMPING, low=0.0),
        Param("m2", "inertia of the second wheel", INERTIA, low=0.0, scale="log"),
        Param("c2", "viscous damping in the bearing of the second wheel", DAMPING, low=0.0),
        Param("c", "viscous damping of the mesh", DAMPING, low=0.0, scale="log"),
        Param("k0", "mean stiffness of the mesh", STIFFNESS, low=0.0, scale="log"),
        Param("x0", "half of the backlash at the first wheel", LENGTH, low=0.0, scale="log"),
        Param("ratio", "turns of the first wheel for one of the second", NUMBER, low=0.0, scale="log"),
        Param("load", "constant load on the second wheel", FORCE),
        Param("kappa", "share of the stiffness that pulsates", NUMBER, low=0.0, high=1.0),
        Param("omega_mesh", "angular frequency at which teeth mesh (rad/s)", Dimension(0, 0, -1), low=0.0),
        Param("phase", "phase of the mesh at the start (rad)", NUMBER),
    )
    aliases: ClassVar[Mapping[str, str]] = {
        "m": "m1",
        "J1": "m1",
        "J2": "m2",
        "damping": "c",
        "stiffness": "k0",
        "backlash": "x0",
    }
    interfaces = (
        Interface("ground", row=1, inertia="m1", motion=ground),
        Interface(
            "mesh", row=1, inertia="m1", motion=mesh, holds=("k0", "x0"), stiffness="k0", play="x0",
            against=(3, "m2"), lever="ratio",
        ),
        Interface("second", row=3, inertia="m2", motion=second),
    )  # fmt: skip
    groups = (
        Group(
            "zeta", "damping ratio of the mesh", "c / (2 sqrt(k0 m)), 1/m = 1/m1 + ratio^2/m2", "c",
            lambda q, n: 2.0 * n * math.sqrt(q["k0"] * _reduce_inertia(q)),
        ),
        Group(
            "frequency_ratio", "frequency of the drive", "omega / sqrt(k0 / m)", "drive.omega",
            lambda q, n: n * math.sqrt(q["k0"] / _reduce_inertia(q)),
        ),
        Group(
            "alpha", "amplitude of the drive", "A m / (m1 k0 x0)", "drive.amplitude",
            lambda q, n: n * q["k0"] * q["x0"] * q["m1"] / _reduce_inertia(q),
        ),
        *MESH_GROUPS,
    )  # fmt: skip

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        stiffness = p[5] * (1.0 + p[9] * math.cos(p[10] * t + p[11]))
        push = p[4] * (y[1] - p[7] * y[3]) + stiffness * subtract_gap(y[0] - p[7] * y[2], p[6])
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - push) / p[0] - u[2]
        dydt[2] = y[3]
        dydt[3] = (u[1] + p[7] * push - p[8] - p[3] * y[3]) / p[2] - u[2]

    observe = staticmethod(ClearanceChain.observe)
