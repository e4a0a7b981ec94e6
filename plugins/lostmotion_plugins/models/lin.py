"""The oscillator with backlash of Lin, as studied by Tjahjowidodo, Al-Bender and Van Brussel (2007)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.contracts import Array, Drive, Flow, Group, Interface, Model, Motion, Param
from lostmotion.quantities import DAMPING, INERTIA, LENGTH, STIFFNESS
from lostmotion_plugins.laws import subtract_gap

CONTACT_ALIASES = {"damping": "c", "stiffness": "k0", "gap": "x0", "backlash": "x0"}
"""Further names of the parameters of a contact with play."""


def ground(y: Array, u: Array) -> tuple[float, float]:
    """Return position and velocity relative to the ground."""
    return y[0], y[1]


@dataclass(frozen=True)
class LinBacklash(Model):
    """m (x'' + a) + c x' + k1 x + F(x) = force, where the contact F is zero in the gap |x| < x0, k0 (|x| - x0) beyond.

    The base acceleration a is that of a shaking table that carries spring and stops. x is relative to the table, and
    the channel "acceleration" is x'' + a, which an accelerometer on the body measures. The states are position and
    velocity; the parameters are m, c, k1, k0, x0 in this order.
    """

    name: ClassVar[str] = "lin_backlash"
    paper: ClassVar[str] = "Tjahjowidodo, Al-Bender, Van Brussel, MSSP 21 (2007) 973-986, eq. (1); Lin (1990)"
    motion: Motion = "translation"
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    states = ("position", "velocity")
    inputs = ("force", "base_acceleration")
    channels = ("position", "velocity", "acceleration")
    params = (
        Param("m", "mass", INERTIA, low=0.0, scale="log"),
        Param("c", "viscous damping", DAMPING, low=0.0, scale="log"),
        Param("k1", "stiffness of the free spring", STIFFNESS, low=0.0),
        Param("k0", "stiffness of the contact", STIFFNESS, low=0.0, scale="log"),
        Param("x0", "half gap", LENGTH, low=0.0, scale="log"),
    )
    aliases: ClassVar[Mapping[str, str]] = {"mass": "m", **CONTACT_ALIASES}
    interfaces = (
        Interface("ground", row=1, inertia="m", motion=ground, holds=("k0", "x0"), stiffness="k0", play="x0"),
    )
    groups = (
        Group("stiffness_ratio", "stiffness of the free spring", "k1 / k0", "k1", lambda q, n: n * q["k0"]),
        Group("zeta", "damping ratio", "c / (2 sqrt(k0 m))", "c", lambda q, n: 2.0 * n * math.sqrt(q["k0"] * q["m"])),
        Group(
            "frequency_ratio", "frequency of the drive", "omega / sqrt(k0 / m)", "drive.omega",
            lambda q, n: n * math.sqrt(q["k0"] / q["m"]),
        ),
        Group("alpha", "amplitude of the drive", "A / (k0 x0)", "drive.amplitude", lambda q, n: n * q["k0"] * q["x0"]),
    )  # fmt: skip

    @staticmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        x = y[0]
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - p[2] * x - p[3] * subtract_gap(x, p[4])) / p[0] - u[1]

    @staticmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        seen[0] = y[0]
        seen[1] = y[1]
        seen[2] = dydt[1] + u[1]

    @classmethod
    def exact(cls, values: Mapping[str, float], drive: Drive, start: Array | None) -> Flow | None:
        """Return the flow under (amplitude, omega, phase), solved in closed form from contact to contact."""
        from lostmotion_plugins.models.exact import solve_exactly

        return solve_exactly(values, drive, start)

    @staticmethod
    def normalised(
        *, m: float, c: float, k0: float, x0: float, amplitude: float, omega: float, k1: float = 0.0
    ) -> dict[str, float]:
        """Return alpha = A/(k0 x0), zeta, frequency ratio and k1/k0 of a harmonic drive A cos(omega t); eq. (3)."""
        return {
            "alpha": amplitude / (k0 * x0),
            "zeta": c / (2.0 * math.sqrt(k0 * m)),
            "frequency_ratio": omega / math.sqrt(k0 / m),
            "stiffness_ratio": k1 / k0,
        }

    @staticmethod
    def physical(
        *, alpha: float, zeta: float, frequency_ratio: float, stiffness_ratio: float = 0.0
    ) -> tuple[dict[str, float], float, float]:
        """Return the parameters with m = k0 = x0 = 1 of the normalised form, the drive amplitude and its omega."""
        params = {"m": 1.0, "c": 2.0 * zeta, "k1": stiffness_ratio, "k0": 1.0, "x0": 1.0}
        return params, alpha, frequency_ratio
