"""A machine that is stepped: an arm with two joints in NumPy, many rows at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Dynamics, Param, Place
from lostmotion.quantities import DAMPING, INERTIA

GRAVITY = 9.81
LENGTH, UPPER_MASS, UPPER_CENTRE, UPPER_INERTIA = 0.4, 3.0, 0.2, 0.05
FORE_CENTRE, GYRATION = 0.15, 0.19
"""Centre of mass and radius of gyration (m) of the forearm about the elbow: with its inertia they give its mass."""


@dataclass(frozen=True)
class TwoJointArm(Dynamics):
    """An arm of two links in a vertical plane; angles are from the horizontal, and relative at the elbow.

    A step is one of RK4, or several where `fine` is larger than one. The mass matrix stays inside of the class.
    """

    fine: int = 1
    name: ClassVar[str] = "two_joint_arm"
    paper: ClassVar[str] = "Siciliano, Sciavicco, Villani, Oriolo, Robotics (2009), section 7.3"
    motion = "rotation"
    states = ("shoulder", "elbow", "shoulder.velocity", "elbow.velocity")
    inputs = ("shoulder_force", "elbow_force")
    channels = ("shoulder", "elbow", "shoulder.velocity", "elbow.velocity", "elbow.acceleration")
    params = (
        Param("fore_inertia", "moment of inertia of the forearm about the elbow", INERTIA, low=0.0, scale="log"),
        Param("shoulder_damping", "viscous damping in the shoulder", DAMPING, low=0.0, scale="log"),
        Param("elbow_damping", "viscous damping in the elbow", DAMPING, low=0.0, scale="log"),
    )
    places = (
        Place("shoulder", motion=lambda y, u: (y[0], y[2])),
        Place("elbow", motion=lambda y, u: (y[1], y[3])),
    )

    def step(self, x: Array, u: Array, f: Array, p: Array, dt: float) -> Array:
        torque, h = u + f, dt / self.fine
        for _ in range(self.fine):
            k1 = compute_rates(x, torque, p)
            k2 = compute_rates(x + 0.5 * h * k1, torque, p)
            k3 = compute_rates(x + 0.5 * h * k2, torque, p)
            k4 = compute_rates(x + h * k3, torque, p)
            x = x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        return x

    def observe(self, x: Array, u: Array, f: Array, p: Array) -> Array:
        return np.column_stack([x, compute_rates(x, u + f, p)[:, 3]])


def compute_rates(x: Array, torque: Array, p: Array) -> Array:
    """Return the derivatives (rows, 4) of the states: M(q) a = torque - damping - c(q, v) - g(q)."""
    far, one, two, v1, v2 = p[:, 0], x[:, 0], x[:, 1], x[:, 2], x[:, 3]
    mass = far / GYRATION**2
    near = UPPER_INERTIA + UPPER_MASS * UPPER_CENTRE**2 + mass * LENGTH**2
    bend, c, s = LENGTH * mass * FORE_CENTRE, np.cos(two), np.sin(two)
    m11, m12 = near + far + 2.0 * bend * c, far + bend * c
    tip = GRAVITY * mass * FORE_CENTRE * np.cos(one + two)
    root = GRAVITY * (UPPER_MASS * UPPER_CENTRE + mass * LENGTH) * np.cos(one) + tip
    left = torque[:, 0] - p[:, 1] * v1 - root + bend * s * (2.0 * v1 * v2 + v2**2)
    right = torque[:, 1] - p[:, 2] * v2 - tip - bend * s * v1**2
    det = m11 * far - m12**2
    return np.column_stack([v1, v2, (far * left - m12 * right) / det, (m11 * right - m12 * left) / det])
