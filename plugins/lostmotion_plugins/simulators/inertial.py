"""Masses, first moments and moments of inertia of the bodies of a MuJoCo model: changed by amounts, and their sizes.

The torque of a chain is linear in mass, first moment and inertia about the origin of each body (Atkeson, An,
Hollerbach, Int. J. Robotics Research 5 (1986) 101-119).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lostmotion.parts import Array

AXES = "xyz"
MOMENTS = tuple(f"moment_{x}" for x in AXES)
INERTIAS = tuple(f"inertia_{AXES[i]}{AXES[j]}" for i in range(3) for j in range(i, 3))


def add_payload(mujoco: Any, model: Any, body: int, point: Array, mass: float) -> None:
    """Add a point mass (kg) to a body, at a point (m) in the frame of the body."""
    _add(mujoco, model, body, mass, mass * point, mass * _spread(point, point))


def add_amount(mujoco: Any, model: Any, body: int, kind: str, amount: float) -> None:
    """Add an amount to a first moment (kg m) of a body, its inertia kept about the moved centre, or to its inertia."""
    moment, inertia = np.zeros(3), np.zeros((3, 3))
    if kind in MOMENTS:
        moment[MOMENTS.index(kind)] = amount
        centre = np.array(model.body_ipos[body])
        inertia = _spread(centre, moment) + _spread(moment, centre)
    else:
        i, j = (AXES.index(x) for x in kind[-2:])
        inertia[i, j] = inertia[j, i] = amount
    _add(mujoco, model, body, 0.0, moment, inertia)


def measure_sizes(mujoco: Any, model: Any, body: int) -> dict[str, float]:
    """Return the usual sizes of the first moments (kg m) and moments of inertia (kg m^2) of a body, by kind.

    That of a moment is the mass times the radius of gyration about the joint: a link whose centre lies on its axis may
    be off as well.
    """
    mass, centre = float(model.body_mass[body]), np.array(model.body_ipos[body])
    inertia = _find_inertia(mujoco, model, body)
    joint = int(model.body_jntadr[body])
    arm = centre - np.array(model.jnt_pos[joint]) if joint >= 0 else centre
    found = dict.fromkeys(MOMENTS, float(np.sqrt(mass * (mass * (arm @ arm) + 0.5 * np.trace(inertia)))))
    for kind in INERTIAS:
        i, j = (AXES.index(x) for x in kind[-2:])
        found[kind] = float(np.sqrt(inertia[i, i] * inertia[j, j]))
    return {kind: size for kind, size in found.items() if size > 0.0}


def _spread(one: Array, two: Array) -> Array:
    """Return the inertia (3, 3) that a unit mass adds, split into two factors."""
    return np.asarray((one @ two) * np.eye(3) - np.outer(one, two))


def _find_inertia(mujoco: Any, model: Any, body: int) -> Array:
    """Return the inertia (3, 3) about the centre of mass, along the axes of the body."""
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[body])
    frame = turn.reshape(3, 3)
    return np.asarray(frame @ np.diag(model.body_inertia[body]) @ frame.T)


def _add(mujoco: Any, model: Any, body: int, mass: float, moment: Array, inertia: Array) -> None:
    """Add mass, first moment and inertia about the origin of the frame of a body."""
    own, centre = float(model.body_mass[body]), np.array(model.body_ipos[body])
    total = own + mass
    middle = (own * centre + moment) / total
    about = (
        _find_inertia(mujoco, model, body) + own * _spread(centre, centre) + inertia - total * _spread(middle, middle)
    )
    values, axes = np.linalg.eigh(0.5 * (about + about.T))
    axes[:, 2] *= np.sign(np.linalg.det(axes))
    turned = np.zeros(4)
    mujoco.mju_mat2Quat(turned, axes.reshape(-1))
    model.body_mass[body], model.body_ipos[body] = total, middle
    model.body_inertia[body], model.body_iquat[body] = values, turned
    model.body_sameframe[body] = 0  # the frame of the inertia is no longer that of the body, as MuJoCo may have noted
