"""A body on a guide that a measured motion moves through a gap; the force through the gap is measured as well."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Interface, Model, Motion, Param
from lostmotion.quantities import DAMPING, INERTIA, LENGTH, STIFFNESS
from lostmotion_plugins.laws import subtract_gap
from lostmotion_plugins.models.joint import RobotJoint, base
from lostmotion_plugins.models.lin import CONTACT_ALIASES, ground


@dataclass(frozen=True)
class BacklashSlider(Model):
    """m x'' = f + force, f = c (xb' - x') + F(xb - x): a body x moved by a base motion xb through a gap of 2 x0.

    The contact F is zero inside the gap |xb - x| < x0 and k0 (|xb - x| - x0) beyond. The channel "force" is f, the
    force of the base on the body through contact and damper, as a load cell in the joint measures it. It contains
    neither a term at the place "base" nor the input "force", which acts on the body itself. Friction of the guide is a
    term at the ground: with it this is a friction damper with backlash, whose loop of force over travel is flat where
    it slides and thin where the gap is crossed.
    """

    name: ClassVar[str] = "backlash_slider"
    paper: ClassVar[str] = "Nordin, Gutman, Automatica 38 (2002) 1633-1649, section 2.1: dead zone with a damper"
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity")
    inputs = ("base_position", "base_velocity", "force")
    channels = ("position", "velocity", "acceleration", "force")
    params = (
        Param("m", "moving mass", INERTIA, low=0.0, scale="log"),
        Param("c", "viscous damping across the gap", DAMPING, low=0.0, scale="log"),
        Param("k0", "stiffness of the contact", STIFFNESS, low=0.0, scale="log"),
        Param("x0", "half gap", LENGTH, low=0.0, scale="log"),
    )
    aliases: ClassVar[Mapping[str, str]] = {"mass": "m", **CONTACT_ALIASES}
    interfaces = (
        Interface("base", row=1, inertia="m", motion=base, holds=("k0", "x0"), stiffness="k0", play="x0"),
        Interface("ground", row=1, inertia="m", motion=ground),
    )

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        contact = p[2] * subtract_gap(u[0] - y[0], p[3])
        dydt[0] = y[1]
        dydt[1] = (p[1] * (u[1] - y[1]) + contact + u[2]) / p[0]

    observe = staticmethod(RobotJoint.observe)
