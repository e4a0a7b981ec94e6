"""Rules for simulators: the inverse dynamics of a chain of joints, on a closed path that all joints follow."""

from __future__ import annotations

import math

import numpy as np

from lostmotion.contracts import Array, Simulator
from lostmotion.testing.rules import join_words, rule

SAMPLES, PERIOD, TRAVEL = 400, 2.0, 0.3
"""Samples, period (s) and amplitude (rad or m) of the path."""
CLOSE = 1e-7
"""The largest accepted difference, as a share of the largest torque."""
TAKEN = ("damping", "frictionloss", "armature", "stiffness", "rest")


def _make_path(simulator: Simulator) -> tuple[Array, Array, Array]:
    """Return positions, velocities and accelerations (samples, n) of a closed path."""
    n = len(simulator.joints)
    angle = 2.0 * math.pi * np.outer(np.arange(SAMPLES) / SAMPLES, 1.0 + np.arange(n) % 3) + np.arange(n)
    w = 2.0 * math.pi / PERIOD * (1.0 + np.arange(n) % 3)
    path = (TRAVEL * np.sin(angle), TRAVEL * w * np.cos(angle), -TRAVEL * w**2 * np.sin(angle))
    return np.asarray(path[0], float), np.asarray(path[1], float), np.asarray(path[2], float)


def _find_mass(simulator: Simulator, q: Array, v: Array) -> Array:
    """Return the mass matrix (samples, n, n)."""
    none, n = np.zeros_like(q), q.shape[1]
    bias = simulator.inverse(q, v, none)
    columns = []
    for j in range(n):
        unit = none.copy()
        unit[:, j] = 1.0
        columns.append(simulator.inverse(q, v, unit) - bias)
    return np.stack(columns, axis=2)


@rule("simulator", declaration=True)
def joints_have_names(simulator: Simulator) -> str:
    """Return in `joints` a tuple with a name for each joint, each once, and in `moves` as many kinds of motion."""
    names = simulator.joints
    if not names or len(set(names)) < len(names) or not all(isinstance(name, str) and name for name in names):
        return f"its joints are {names!r}"
    wrong = [kind for kind in simulator.moves if kind not in ("rotation", "translation")]
    return f"its moves are {simulator.moves!r}" if wrong or len(simulator.moves) != len(names) else ""


@rule("simulator", declaration=True)
def values_belong_to_joints(simulator: Simulator) -> str:
    """Name the values that are taken out `joint.damping`, `.frictionloss`, `.armature`, `.stiffness` or `.rest`."""
    known = {f"{joint}.{kind}" for joint in simulator.joints for kind in TAKEN}
    unknown = [name for name in simulator.taken if name not in known]
    return f"taken has {join_words(unknown)}" if unknown else ""


@rule("simulator")
def torques_have_the_shape_of_positions(simulator: Simulator) -> str:
    """Return finite torques (samples, n) for arrays (samples, n), each sample on its own, and change no argument."""
    q, v, a = _make_path(simulator)
    kept = [x.copy() for x in (q, v, a)]
    found = np.asarray(simulator.inverse(q, v, a))
    if found.shape != q.shape or not np.isfinite(found).all():
        return f"inverse returned an array {found.shape} for positions {q.shape}, or numbers that are not finite"
    if any((x != y).any() for x, y in zip((q, v, a), kept, strict=True)):
        return "inverse changed its arguments"
    alone = np.concatenate([simulator.inverse(q[k : k + 1], v[k : k + 1], a[k : k + 1]) for k in (0, 7, 150)])
    return "" if np.allclose(alone, found[[0, 7, 150]], rtol=0.0, atol=CLOSE * abs(found).max()) else "samples mix"


@rule("simulator")
def torque_is_linear_in_accelerations(simulator: Simulator) -> str:
    """Let `inverse` be M(q) a + h(q, v): no friction, contact or limit may depend on the acceleration."""
    q, v, a = _make_path(simulator)
    none = np.zeros_like(a)
    bias = simulator.inverse(q, v, none)
    one, two = simulator.inverse(q, v, a) - bias, simulator.inverse(q, v, 2.0 * a) - bias
    worst = float(np.abs(two - 2.0 * one).max() / max(np.abs(two).max(), 1e-300))
    return (
        "" if worst < CLOSE else f"twice the acceleration adds another torque than twice as much, by {worst:.2g} of it"
    )


@rule("simulator")
def mass_matrix_is_symmetric_and_positive(simulator: Simulator) -> str:
    """Let the mass matrix be symmetric and, with the armatures that are taken out, positive definite."""
    q, v, _ = _make_path(simulator)
    mass = _find_mass(simulator, q, v)
    skew = float(np.abs(mass - mass.transpose(0, 2, 1)).max() / np.abs(mass).max())
    if skew > CLOSE:
        return f"its mass matrix differs from its transpose by {skew:.2g} of its largest entry"
    armature = np.array([simulator.taken.get(f"{joint}.armature", 0.0) for joint in simulator.joints])
    least = float(np.linalg.eigvalsh(mass + np.diag(armature)).min())
    return "" if least > 0.0 else f"its mass matrix has the eigenvalue {least:.3g}"


@rule("simulator")
def closed_path_needs_no_work(simulator: Simulator) -> str:
    """Leave damping and friction out of `inverse`: after a closed path the work of the torques is zero."""
    q, v, a = _make_path(simulator)
    power = np.sum(simulator.inverse(q, v, a) * v, axis=1)
    share = float(abs(power.mean()) / max(np.abs(power).mean(), 1e-300))
    return "" if share < 1e-6 else f"the work of a closed path is {share:.2g} of the work that passes"


@rule("simulator")
def linear_values_are_linear(simulator: Simulator) -> str:
    """Let `inverse` depend linearly on values of `linear` and `inertial`, and `changed` know them and each payload."""
    q, v, a = _make_path(simulator)
    plain = simulator.inverse(q, v, a)
    steps = {name: 0.1 * (abs(value) or 1.0) for name, value in simulator.linear.items()}
    steps |= {name: 0.1 * size for name, size in simulator.inertial.items()}
    steps |= {f"{point}.payload": 0.1 for point in simulator.points}
    for name, step in steps.items():
        base = simulator.linear.get(name, 0.0)
        one, two = (simulator.changed({name: base + k * step}).inverse(q, v, a) - plain for k in (1.0, 2.0))
        worst = float(np.abs(two - 2.0 * one).max() / max(np.abs(plain).max(), 1e-300))
        if worst > CLOSE:
            return f"twice the change of {name} changes the torque by another amount than twice as much"
    return ""
