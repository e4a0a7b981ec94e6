"""Arms with two joints under a digital controller: fourth-order Runge-Kutta with steps of 10 us, by their Lagrangian.

The motion shares no code with the framework and none with a simulator. Dry friction is a smooth step, usually over a
speed that no encoder resolves; play is a contact with a spring and a damper; a link and its motor are two bodies where
there is a gear between them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.kernels.stored import stored

Array = NDArray[np.float64]
GRAVITY = 9.81
STEP = 1e-5
SLIDING = 2e-4
"""The usual `onset`, which no encoder resolves."""


def _pair(value: float) -> Array:
    return np.full(2, value)


@dataclass
class Arm:
    """Two links in a vertical plane, and what acts at their joints; arrays are (2,), in SI units.

    `onset` is the speed (rad/s) over which dry friction changes its sign. `play` is half of the play, negative where
    there is no gear between motor and link; a gear without play is flexible. A hysteretic force yields at `bristles`
    after a `travel` of the motor, or of the motor relative to its link where it is `within` the gear; it is that of
    Bouc and Wen there, and Dahl's else.
    `delay` (s) and `gain` change the commanded torque. `payload` (kg) is carried at `reach` (m) on the second link.
    """

    length: float = 0.4
    mass: Array = field(default_factory=lambda: np.array([3.0, 2.0]))
    centre: Array = field(default_factory=lambda: np.array([0.2, 0.15]))
    inertia: Array = field(default_factory=lambda: np.array([0.05, 0.03]))
    armature: Array = field(default_factory=lambda: np.array([0.3, 0.1]))
    damping: Array = field(default_factory=lambda: np.array([0.5, 0.3]))
    friction: Array = field(default_factory=lambda: _pair(0.0))
    excess: Array = field(default_factory=lambda: _pair(0.0))
    stribeck: Array = field(default_factory=lambda: _pair(0.05))
    backward: Array = field(default_factory=lambda: _pair(0.0))
    onset: Array = field(default_factory=lambda: _pair(SLIDING))
    ripple: Array = field(default_factory=lambda: _pair(0.0))
    order: Array = field(default_factory=lambda: _pair(60.0))
    phase: Array = field(default_factory=lambda: _pair(0.0))
    spring: Array = field(default_factory=lambda: _pair(0.0))
    offset: Array = field(default_factory=lambda: _pair(0.0))
    play: Array = field(default_factory=lambda: _pair(-1.0))
    stiffness: Array = field(default_factory=lambda: _pair(5e4))
    loss: Array = field(default_factory=lambda: _pair(20.0))
    bristles: Array = field(default_factory=lambda: _pair(0.0))
    travel: Array = field(default_factory=lambda: _pair(1e-3))
    within: Array = field(default_factory=lambda: _pair(0.0))
    delay: Array = field(default_factory=lambda: _pair(0.0))
    gain: Array = field(default_factory=lambda: _pair(1.0))
    payload: float = 0.0
    reach: float = 0.35

    def joint_table(self) -> Array:
        """Return what acts at each joint, (16, 2)."""
        rows = (
            self.friction, self.excess, self.stribeck, self.backward, self.ripple, self.order, self.phase, self.spring,
            self.offset, self.play, self.stiffness, self.loss, self.onset, self.bristles, self.travel, self.within,
        )  # fmt: skip
        return np.array(rows)

    def body_table(self) -> Array:
        """Return masses, centres, inertias, armatures and damping with the payload, (5, 2)."""
        mass, centre, inertia = self.mass.copy(), self.centre.copy(), self.inertia.copy()
        own, total = mass[1], mass[1] + self.payload
        middle = (own * centre[1] + self.payload * self.reach) / total
        inertia[1] += own * (centre[1] - middle) ** 2 + self.payload * (self.reach - middle) ** 2
        mass[1], centre[1] = total, middle
        return np.array([mass, centre, inertia, self.armature, self.damping])

    def torque(self, q: Array, v: Array, a: Array) -> Array:
        """Return the torques (samples, 2) of rigid joints without friction: what a controller feeds forward."""
        mass, centre, inertia, armature, damping = self.body_table()
        reach = self.length * centre[1]
        c, s = np.cos(q[:, 1]), np.sin(q[:, 1])
        far = mass[1] * centre[1] ** 2 + inertia[1]
        m11 = mass[0] * centre[0] ** 2 + inertia[0] + mass[1] * (self.length**2 + 2.0 * reach * c) + far + armature[0]
        m12, m22 = far + mass[1] * reach * c, far + armature[1]
        turn = mass[1] * reach * s
        tip = GRAVITY * mass[1] * centre[1] * np.cos(q.sum(axis=1))
        root = GRAVITY * (mass[0] * centre[0] + mass[1] * self.length) * np.cos(q[:, 0]) + tip
        one = m11 * a[:, 0] + m12 * a[:, 1] - turn * (2.0 * v[:, 0] * v[:, 1] + v[:, 1] ** 2) + root
        two = m12 * a[:, 0] + m22 * a[:, 1] + turn * v[:, 0] ** 2 + tip
        return np.stack([one + damping[0] * v[:, 0], two + damping[1] * v[:, 1]], axis=1)


@dataclass(frozen=True, eq=False)
class Log:
    """What a robot records: times (s), commanded torques and encoder readings, (samples, 2)."""

    time: Array
    torque: Array
    encoder: Array


def plan_motion(rng: np.random.Generator, samples: int, dt: float) -> tuple[Array, Array, Array]:
    """Return positions, velocities and accelerations (samples, 2) of a smooth exciting motion that hangs down."""
    time = dt * np.arange(samples)
    q, v, a = np.zeros((3, samples, 2))
    for j, (middle, size) in enumerate(((-0.5 * math.pi, 0.3), (0.0, 0.4))):
        q[:, j] = middle
        add_waves((q[:, j], v[:, j], a[:, j]), time, rng, size=size, paces=(0.13, 0.31, 0.67, 1.1, 1.9))
    return q, v, a


def add_waves(
    motion: tuple[Array, Array, Array],
    time: NDArray[np.floating[Any]],
    rng: np.random.Generator,
    *,
    size: float,
    paces: Sequence[float],
) -> None:
    """Add random sines about some frequencies (Hz) to position, velocity and acceleration (samples,) of a joint."""
    q, v, a = motion
    for base in paces:
        w = 2.0 * math.pi * base * rng.uniform(0.8, 1.2)
        amplitude = size * rng.uniform(0.5, 1.2) / (1.0 + (base / 0.6) ** 1.3)
        angle = w * time + rng.uniform(0.0, 2.0 * math.pi)
        q += amplitude * np.sin(angle)
        v += amplitude * w * np.cos(angle)
        a -= amplitude * w * w * np.sin(angle)


def record_motion(
    arm: Arm, model: Arm, rng: np.random.Generator, *, samples: int = 5000, dt: float = 0.002, encoder: float = 3e-5,
    disturbed: float = 0.015, noisy: float = 0.007,
) -> Log:  # fmt: skip
    """Return the log of an arm whose controller knows its `model`.

    `encoder` is the noise of an encoder (rad); `disturbed` and `noisy` are random torques that act and that are only
    read, as shares of the torque.
    """
    q, v, a = plan_motion(rng, samples, dt)
    feed = model.torque(q, v, a)
    size = np.std(feed, axis=0)
    noise = encoder * rng.standard_normal((samples, 2))
    kicks = disturbed * size * rng.standard_normal((samples, 2))
    errors = noisy * size * rng.standard_normal((samples, 2))
    gains = np.array([[600.0, 250.0], [30.0, 10.0]])
    steps = round(dt / STEP)
    late = np.round(arm.delay / STEP).astype(np.int64)
    seen, told = _integrate(
        q, v, feed, noise, kicks, gains, arm.length, arm.body_table(), arm.joint_table(), late, arm.gain, steps, dt
    )
    return Log(np.asarray(dt * np.arange(samples), dtype=float), told + errors, seen)


@stored(error_model="numpy")
def _accelerate(y, torque, length, bodies, table, out):  # type: ignore[no-untyped-def]
    """Write the rates of the state under motor torques (2,).

    It has positions and velocities of links, then of motors, and the bent bristles as shares of where they yield.
    """
    pull, push = np.zeros(2), np.zeros(2)
    motors = np.zeros(2)
    for j in range(2):
        soft = table[9, j] >= 0.0
        x, w = (y[4 + j], y[6 + j]) if soft else (y[j], y[2 + j])
        level = table[0, j] if w > 0.0 or table[3, j] == 0.0 else table[3, j]
        level += table[1, j] * math.exp(-((w / table[2, j]) ** 2))
        force = torque[j] - bodies[4, j] * w - level * math.tanh(w / table[12, j])
        force += table[4, j] * math.sin(table[5, j] * x + table[6, j]) - table[7, j] * x + table[8, j]
        force -= (1.0 - table[15, j]) * table[13, j] * y[8 + j]
        if soft:
            twist = x - y[j]
            gap = table[9, j]
            deep = twist - gap if twist > gap else (twist + gap if twist < -gap else 0.0)
            push[j] = table[10, j] * deep + (table[11, j] * (w - y[2 + j]) if deep != 0.0 else 0.0)
            push[j] += table[15, j] * table[13, j] * y[8 + j]
            motors[j] = (force - push[j]) / bodies[3, j]
        else:
            push[j] = force
        pull[j] = 0.0 if soft else bodies[3, j]
    reach = length * bodies[1, 1]
    c, s = math.cos(y[1]), math.sin(y[1])
    far = bodies[0, 1] * bodies[1, 1] ** 2 + bodies[2, 1]
    m11 = bodies[0, 0] * bodies[1, 0] ** 2 + bodies[2, 0] + bodies[0, 1] * (length**2 + 2.0 * reach * c) + far + pull[0]
    m12, m22 = far + bodies[0, 1] * reach * c, far + pull[1]
    turn = bodies[0, 1] * reach * s
    tip = GRAVITY * bodies[0, 1] * bodies[1, 1] * math.cos(y[0] + y[1])
    root = GRAVITY * (bodies[0, 0] * bodies[1, 0] + bodies[0, 1] * length) * math.cos(y[0]) + tip
    f1 = push[0] + turn * (2.0 * y[2] * y[3] + y[3] ** 2) - root
    f2 = push[1] - turn * y[2] ** 2 - tip
    det = m11 * m22 - m12 * m12
    out[0], out[1] = y[2], y[3]
    out[2], out[3] = (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det
    for j in range(2):
        out[4 + j] = y[6 + j] if table[9, j] >= 0.0 else y[2 + j]
        out[6 + j] = motors[j] if table[9, j] >= 0.0 else out[2 + j]
        z, inside = y[8 + j], table[15, j] > 0.0
        w = (y[6 + j] - y[2 + j] if inside else y[6 + j]) if table[9, j] >= 0.0 else y[2 + j]
        bent = 0.5 * (abs(w) * z * abs(z) + w * z * z) if inside else abs(w) * z
        out[8 + j] = (w - bent) / table[14, j] if table[13, j] != 0.0 else 0.0


@stored(error_model="numpy")
def _integrate(q, v, feed, noise, kicks, gains, length, bodies, table, late, gain, steps, dt):  # type: ignore[no-untyped-def]
    """Return encoder readings and commanded torques (samples, 2) under a controller that holds its torque."""
    samples = len(q)
    seen, told = np.zeros((samples, 2)), np.zeros((samples, 2))
    y, h = np.zeros(10), dt / steps
    for j in range(2):
        y[j], y[2 + j], y[4 + j], y[6 + j] = q[0, j], v[0, j], q[0, j], v[0, j]
    past = np.zeros((8192, 2))
    past[:, 0], past[:, 1] = feed[0, 0], feed[0, 1]
    place, rate, last = 0, v[0].copy(), q[0].copy()
    k1, k2, k3, k4 = np.zeros(10), np.zeros(10), np.zeros(10), np.zeros(10)
    acting = np.zeros(2)
    for k in range(samples):
        for j in range(2):
            seen[k, j] = y[4 + j] + noise[k, j]
            speed = (seen[k, j] - last[j]) / dt if k > 0 else v[0, j]
            rate[j] += 0.25 * (speed - rate[j])
            last[j] = seen[k, j]
            told[k, j] = feed[k, j] + gains[0, j] * (q[k, j] - seen[k, j]) + gains[1, j] * (v[k, j] - rate[j])
        for _ in range(steps):
            for j in range(2):
                past[place, j] = told[k, j]
                acting[j] = gain[j] * past[(place - late[j]) % 8192, j] + kicks[k, j]
            place = (place + 1) % 8192
            _accelerate(y, acting, length, bodies, table, k1)
            _accelerate(y + 0.5 * h * k1, acting, length, bodies, table, k2)
            _accelerate(y + 0.5 * h * k2, acting, length, bodies, table, k3)
            _accelerate(y + h * k3, acting, length, bodies, table, k4)
            for i in range(10):
                y[i] += h * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0
    return seen, told
