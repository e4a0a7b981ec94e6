"""A motor with brushes, or one phase of a servo motor: voltage, current and speed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Interface, Model, Param
from lostmotion.quantities import DAMPING, FORCE_PER_CURRENT, INDUCTANCE, INERTIA, RESISTANCE
from lostmotion_plugins.models.lin import ground

_PAPER = "Krishnan, Electric Motor Drives: Modeling, Analysis, and Control (2001), section 2.3"
_INERTIA = Param("J", "moment of inertia of rotor and load", INERTIA, low=0.0, scale="log")
_DAMPING = Param("c", "viscous friction", DAMPING, low=0.0, scale="log")
_CONSTANT = Param("K", "torque over current, and voltage over speed", FORCE_PER_CURRENT, low=0.0)
_RESISTANCE = Param("R", "resistance of the winding", RESISTANCE, low=0.0, scale="log")
_ALIASES = {"m": "J", "inertia": "J", "b": "c", "damping": "c", "kt": "K", "ke": "K"}
_GROUND = Interface("ground", row=1, inertia="J", motion=ground)


@dataclass(frozen=True)
class DcMotor(Model):
    """V = R i + L di/dt + K w, J w' = K i - c w + force: a motor under a recorded voltage V.

    The current i is a state and a channel, beside the angle and the speed w. `force` is a further torque on the shaft,
    such as that of a brake. A term acts in the bearing of the shaft (`ground`). A value of L that no
    sample resolves (L/R far below the sampling step) does not matter: give it a range, as a parameter to estimate.
    """

    name: ClassVar[str] = "dc_motor"
    paper: ClassVar[str] = _PAPER
    motion = "rotation"
    states = ("position", "velocity", "current")
    inputs = ("voltage", "force")
    channels = ("position", "velocity", "acceleration", "current")
    params = (
        _INERTIA, _DAMPING, _CONSTANT, _RESISTANCE,
        Param("L", "inductance of the winding", INDUCTANCE, low=0.0, scale="log"),
    )  # fmt: skip
    aliases: ClassVar[Mapping[str, str]] = {**_ALIASES, "resistance": "R", "inductance": "L"}
    interfaces = (_GROUND,)

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        dydt[0] = y[1]
        dydt[1] = (p[2] * y[2] - p[1] * y[1] + u[1]) / p[0]
        dydt[2] = (u[0] - p[3] * y[2] - p[2] * y[1]) / p[4]

    @staticmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        seen[0] = y[0]
        seen[1] = y[1]
        seen[2] = dydt[1]
        seen[3] = y[2]


@dataclass(frozen=True)
class CurrentMotor(Model):
    """J w' = K i - c w + force: a motor under a recorded current i, as a current controller drives it.

    Resistance and inductance do not matter for the motion where the current is known.
    """

    name: ClassVar[str] = "current_motor"
    paper: ClassVar[str] = _PAPER
    motion = "rotation"
    states = ("position", "velocity")
    inputs = ("current", "force")
    channels = ("position", "velocity", "acceleration")
    params = (_INERTIA, _DAMPING, _CONSTANT)
    aliases: ClassVar[Mapping[str, str]] = _ALIASES
    interfaces = (_GROUND,)

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        dydt[0] = y[1]
        dydt[1] = (p[2] * u[0] - p[1] * y[1] + u[1]) / p[0]

    @staticmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        seen[0] = y[0]
        seen[1] = y[1]
        seen[2] = dydt[1]
