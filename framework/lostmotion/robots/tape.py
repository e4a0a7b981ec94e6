"""The tape: the equations of motion of a simulator, linear along a recorded path.

tau = M_k a + h_k + Kq_k (q - q_k) + Kv_k (v - v_k) for each sample k. The path is known within the noise of the
encoders, where the equations are linear to rounding, so that a filter on the tape has the likelihood of one that steps
the simulator exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import savgol_filter

from lostmotion.errors import ContractError
from lostmotion.parts import Array
from lostmotion.simulators import Simulator

ANGLE, SPEED = 1e-4, 1e-3
"""The steps of central differences over positions and velocities (SI)."""
CHANGE = 0.01
"""The share by which a linear value is changed to find its part of the tape; for a payload the mass in kg."""
EVERY = 5
"""The samples between those at which the small torques of inertial values are found: positions are smooth."""
SMOOTHING, ORDER = 0.03, 4
"""Length (s) and order of the polynomials that smooth a recorded path."""


@dataclass(frozen=True, eq=False)
class Path:
    """Positions, velocities and accelerations of n joints, each (samples, n), in SI units."""

    q: Array
    v: Array
    a: Array


@dataclass(frozen=True, eq=False)
class Tape:
    """The linear equations of motion at each sample of a path; matrices are (samples, n, n), vectors (samples, n)."""

    path: Path
    mass: Array
    bias: Array
    stiffness: Array
    damping: Array

    @property
    def torque(self) -> Array:
        """The torque (samples, n) along the path itself."""
        return np.asarray(np.einsum("kij,kj->ki", self.mass, self.path.a) + self.bias)


@dataclass(frozen=True, eq=False)
class Part:
    """What one more unit of a linear value adds to the mass matrix (samples, n, n) and to the bias (samples, n)."""

    mass: Array
    bias: Array

    def weigh(self, a: Array) -> Array:
        """Return the torque (samples, n) that one more unit needs under accelerations (samples, n)."""
        return np.asarray(np.einsum("kij,kj->ki", self.mass, a) + self.bias)


def smooth_path(q: Array, dt: float) -> Path:
    """Return the path of recorded positions (samples, n), smoothed by polynomials over a short window."""
    window = max(2 * round(0.5 * SMOOTHING / dt) + 1, ORDER + 3 - ORDER % 2)
    window = min(window, len(q) - 1 + len(q) % 2)
    found = [savgol_filter(q, window, ORDER, deriv=d, delta=dt, axis=0) for d in range(3)]
    return Path(*found)


def make_tape(simulator: Simulator, path: Path) -> Tape:
    """Return the tape of a simulator along a path, by differences of its inverse dynamics."""
    q, v, a = path.q, path.v, path.a
    samples, n = q.shape
    mass, bias = _find_mass(simulator, path)
    stiffness, damping = np.zeros((samples, n, n)), np.zeros((samples, n, n))
    for j in range(n):
        angle, speed = np.zeros(n), np.zeros(n)
        angle[j], speed[j] = ANGLE, SPEED
        stiffness[:, :, j] = (_ask(simulator, q + angle, v, a) - _ask(simulator, q - angle, v, a)) / (2.0 * ANGLE)
        damping[:, :, j] = (_ask(simulator, q, v + speed, a) - _ask(simulator, q, v - speed, a)) / (2.0 * SPEED)
    return Tape(path, mass, bias, stiffness, damping)


def make_part(simulator: Simulator, name: str, tape: Tape) -> Part:
    """Return the part in the tape of a linear or inertial value or a payload, by a difference of two simulators."""
    known = simulator.linear.get(name, 0.0)
    change = CHANGE * (abs(known) or simulator.inertial.get(name, 1.0))
    mass, bias = _find_mass(simulator.changed({name: known + change}), tape.path)
    return Part((mass - tape.mass) / change, (bias - tape.bias) / change)


def make_inertial_parts(simulator: Simulator, tape: Tape) -> dict[str, Part]:
    """Return the parts of first moments and moments of inertia, interpolated between every few samples of the tape."""
    samples = len(tape.bias)
    kept = np.unique(np.r_[0:samples:EVERY, samples - 1])
    path = Path(tape.path.q[kept], tape.path.v[kept], tape.path.a[kept])
    thin = Tape(path, tape.mass[kept], tape.bias[kept], tape.stiffness[kept], tape.damping[kept])
    between = np.interp(np.arange(samples), kept, np.arange(len(kept)))
    low = np.minimum(between.astype(int), len(kept) - 2)
    share = between - low

    def widen(x: Array) -> Array:
        part = share.reshape(-1, *[1] * (x.ndim - 1))
        return np.asarray((1.0 - part) * x[low] + part * x[low + 1])

    made = {name: make_part(simulator, name, thin) for name in simulator.inertial}
    return {name: Part(widen(part.mass), widen(part.bias)) for name, part in made.items()}


def make_shares(simulator: Simulator, tape: Tape) -> dict[str, Part]:
    """Return the parts of a simulator that has no values of its own, each a torque of which a share may be wrong.

    These are the mean and the variation of each entry of the mass matrix; at each joint the mean damping, and what else
    depends on velocities; and the torque of gravity of each joint, there and at the joints before it.
    """
    path, (samples, n), names = tape.path, tape.path.q.shape, simulator.joints
    still = np.zeros((samples, n))
    weight = _ask(simulator, path.q, still, still)
    middle, loss = tape.mass.mean(axis=0), np.diagonal(tape.damping.mean(axis=0)) * path.v
    torques = [(i, f"gravity_{names[j]}", weight[:, j]) for i in range(n) for j in range(i, n)]
    torques += [(i, "damping_share", loss[:, i]) for i in range(n)]
    torques += [(i, "coriolis_share", (tape.bias - weight - loss)[:, i]) for i in range(n)]
    made = {}
    for i, word, torque in torques:
        bias = still.copy()
        bias[:, i] = torque
        made[f"{names[i]}.{word}"] = Part(np.zeros_like(tape.mass), bias)
    for i in range(n):
        for j in range(i, n):
            for word, entry in (("mean", middle[i, j]), ("variation", tape.mass[:, i, j] - middle[i, j])):
                mass = np.zeros_like(tape.mass)
                mass[:, i, j] = mass[:, j, i] = entry
                made[f"{names[i]}.{word}_{names[j]}"] = Part(mass, still)
    return made


def _find_mass(simulator: Simulator, path: Path) -> tuple[Array, Array]:
    """Return the mass matrix (samples, n, n) and the torque without acceleration (samples, n) along a path."""
    samples, n = path.q.shape
    none = np.zeros((samples, n))
    bias = _ask(simulator, path.q, path.v, none)
    mass = np.zeros((samples, n, n))
    for j in range(n):
        unit = none.copy()
        unit[:, j] = 1.0
        mass[:, :, j] = _ask(simulator, path.q, path.v, unit) - bias
    return 0.5 * (mass + mass.transpose(0, 2, 1)), bias


def _ask(simulator: Simulator, q: Array, v: Array, a: Array) -> Array:
    """Return the inverse dynamics of a simulator; raise `ContractError` for a result that cannot be used."""
    found = np.asarray(simulator.inverse(q, v, a), dtype=float)
    if found.shape != q.shape:
        raise ContractError(
            f"{simulator.name}: inverse returned an array {found.shape} for positions {q.shape}: return torques of the"
            " same shape (samples, joints)"
        )
    if not np.isfinite(found).all():
        raise ContractError(
            f"{simulator.name}: inverse returned numbers that are not finite for the recorded path: check the model"
        )
    return found
