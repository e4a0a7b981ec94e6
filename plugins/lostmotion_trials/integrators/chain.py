"""Arms with many joints in space under a digital controller, by recursive Newton-Euler equations in body frames.

It shares no code with the framework and none with a simulator. A step is one of the midpoint rule, followed by the
impulses of set-valued dry friction at all joints (projected Gauss-Seidel, Moreau 1988).
Source: Featherstone, Rigid Body Dynamics Algorithms (2008), chapter 5.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.kernels.stored import stored
from lostmotion_trials.integrators.arm import GRAVITY, Log, add_waves

Array = NDArray[np.float64]
STEP = 1e-4
SWEEPS = 30
"""The largest number of sweeps over the friction of all joints."""
_TURNS = (0.0, -1.0, 1.0, 1.0, -1.0, 1.0, 1.0)
"""The angle between the axes of a joint and the one before, in right angles, about x."""
_PLACES = ((0, 0, 0.333), (0, 0, 0), (0, -0.316, 0), (0.08, 0, 0), (-0.08, 0.384, 0), (0, 0, 0), (0.09, 0, 0))
_MASSES = (4.0, 3.0, 3.0, 2.5, 1.5, 1.3, 0.7)
_ARMATURES = (0.3, 0.3, 0.25, 0.2, 0.1, 0.1, 0.06)


@dataclass
class Chain:
    """A chain of n bodies; joint i turns body i about its z axis. Units are SI.

    `turn` (n,) is the angle about x from the frame of a body to that of the next, `place` (n, 3) the joint in the frame
    before, `centre` (n, 3) the centre of mass and `inertia` (n, 3) the moments about it, both in the frame of the body.
    The other arrays are (n,): see `integrators.arm`. `payload` (kg) is carried at `tip` (3,) of the last body.
    """

    turn: Array
    place: Array
    mass: Array
    centre: Array
    inertia: Array
    tip: Array
    armature: Array
    damping: Array
    friction: Array
    excess: Array
    stribeck: Array
    backward: Array
    ripple: Array
    order: Array
    spring: Array
    offset: Array
    delay: Array
    gain: Array
    payload: float = 0.0

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the joints."""
        return tuple(f"joint{i + 1}" for i in range(len(self.mass)))

    def bodies(self) -> tuple[Array, ...]:
        """Return turns, places, masses, centres and inertias (n, 3, 3), with the payload."""
        mass, centre = self.mass.copy(), self.centre.copy()
        inertia = np.array([np.diag(one) for one in self.inertia])
        own, total = mass[-1], mass[-1] + self.payload
        middle = (own * centre[-1] + self.payload * self.tip) / total
        for weight, arm in ((own, centre[-1] - middle), (self.payload, self.tip - middle)):
            inertia[-1] += weight * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        mass[-1], centre[-1] = total, middle
        return self.turn, self.place, mass, centre, inertia

    def torque(self, q: Array, v: Array, a: Array) -> Array:
        """Return the torques (samples, n) without friction: what a controller feeds forward."""
        bodies, found = self.bodies(), np.zeros_like(q)
        for k in range(len(q)):
            _find_torque(q[k], v[k], a[k], GRAVITY, *bodies, found[k])
        return np.asarray(found + self.armature * a + self.damping * v)


def draw_chain(rng: np.random.Generator, joints: int) -> Chain:
    """Return a random arm with up to seven joints, about as large as a usual robot."""
    n = joints
    spread = rng.uniform(0.8, 1.25, (4, n))
    mass, armature = np.array(_MASSES[-n:]) * spread[0], np.array(_ARMATURES[-n:]) * spread[1]
    centre = rng.uniform(-0.06, 0.06, (n, 3))
    inertia = mass[:, None] * rng.uniform(0.002, 0.006, (n, 3))
    inertia = np.maximum(inertia, 0.55 * inertia.sum(axis=1, keepdims=True) * np.array([0.6, 0.6, 0.6]))
    return Chain(
        turn=0.5 * math.pi * np.array(_TURNS[:n]), place=np.array(_PLACES[:n], dtype=float), mass=mass, centre=centre,
        inertia=inertia, tip=np.array([0.03, 0.0, 0.15]), armature=armature, damping=1.5 * armature * spread[2],
        stribeck=np.full(n, 0.1), order=np.full(n, 60.0), gain=np.ones(n),
        friction=np.zeros(n), excess=np.zeros(n), backward=np.zeros(n), ripple=np.zeros(n), spring=np.zeros(n),
        offset=np.zeros(n), delay=np.zeros(n),
    )  # fmt: skip


def plan_chain(rng: np.random.Generator, samples: int, dt: float, joints: int) -> tuple[Array, Array, Array]:
    """Return positions, velocities and accelerations (samples, joints) of a smooth exciting motion."""
    time = dt * np.arange(samples)
    q, v, a = np.zeros((3, samples, joints))
    for j in range(joints):
        q[:, j] = rng.uniform(-1.0, 1.0)
        add_waves((q[:, j], v[:, j], a[:, j]), time, rng, size=0.4, paces=(0.12, 0.29, 0.61, 1.1, 1.7))
    return q, v, a


def record_chain(
    arm: Chain, model: Chain, rng: np.random.Generator, *, samples: int = 5000, dt: float = 0.002,
    encoder: float = 3e-5, disturbed: float = 0.015, noisy: float = 0.007,
) -> Log:  # fmt: skip
    """Return the log of an arm whose controller knows its `model`; see `integrators.arm.record_motion`."""
    n = len(arm.mass)
    q, v, a = plan_chain(rng, samples, dt, n)
    feed = model.torque(q, v, a)
    size = np.std(feed, axis=0)
    noise = encoder * rng.standard_normal((samples, n))
    kicks, errors = (share * size * rng.standard_normal((samples, n)) for share in (disturbed, noisy))
    steps = round(dt / STEP)
    table = np.array(
        [
            arm.friction, arm.excess, arm.stribeck, arm.backward, arm.ripple, arm.order, arm.spring, arm.offset,
            arm.armature, arm.damping, arm.gain,
        ]
    )  # fmt: skip
    late = np.round(arm.delay / STEP).astype(np.int64)
    gains = np.outer((600.0, 30.0), 2.0 * arm.armature)
    seen, told = _simulate(q, v, feed, noise, kicks, gains, *arm.bodies(), table, late, steps, dt)
    return Log(np.asarray(dt * np.arange(samples), dtype=float), told + errors, seen)


@stored(error_model="numpy")
def _cross(a, b, out):  # type: ignore[no-untyped-def]
    out[0] = a[1] * b[2] - a[2] * b[1]
    out[1] = a[2] * b[0] - a[0] * b[2]
    out[2] = a[0] * b[1] - a[1] * b[0]


@stored(error_model="numpy")
def _turn(turn, angle, x, out, back):  # type: ignore[no-untyped-def]
    """Write a vector of the frame before a joint in that of its body, or back."""
    c, s, ct, st = math.cos(angle), math.sin(angle), math.cos(turn), math.sin(turn)
    if back:
        a, b = c * x[0] - s * x[1], s * x[0] + c * x[1]
        out[0], out[1], out[2] = a, ct * b - st * x[2], st * b + ct * x[2]
    else:
        b, e = ct * x[1] + st * x[2], -st * x[1] + ct * x[2]
        out[0], out[1], out[2] = c * x[0] + s * b, -s * x[0] + c * b, e


@stored(error_model="numpy")
def _invert(q, v, a, gravity, turn, place, mass, centre, inertia, tau):  # type: ignore[no-untyped-def]
    """Write the torques (n,) of a motion."""
    n = len(q)
    w, dw, acc = np.zeros(3), np.zeros(3), np.array([0.0, 0.0, gravity])
    forces, moments = np.zeros((n, 3)), np.zeros((n, 3))
    t1, t2, t3 = np.zeros(3), np.zeros(3), np.zeros(3)
    for i in range(n):
        _cross(dw, place[i], t1)
        _cross(w, place[i], t2)
        _cross(w, t2, t3)
        _turn(turn[i], q[i], acc + t1 + t3, acc, False)
        _turn(turn[i], q[i], w.copy(), w, False)
        _turn(turn[i], q[i], dw.copy(), dw, False)
        dw[0] += w[1] * v[i]
        dw[1] -= w[0] * v[i]
        dw[2] += a[i]
        w[2] += v[i]
        _cross(dw, centre[i], t1)
        _cross(w, centre[i], t2)
        _cross(w, t2, t3)
        for k in range(3):
            forces[i, k] = mass[i] * (acc[k] + t1[k] + t3[k])
            t1[k] = inertia[i, k, 0] * w[0] + inertia[i, k, 1] * w[1] + inertia[i, k, 2] * w[2]
            t2[k] = inertia[i, k, 0] * dw[0] + inertia[i, k, 1] * dw[1] + inertia[i, k, 2] * dw[2]
        _cross(w, t1, t3)
        _cross(centre[i], forces[i], t1)
        for k in range(3):
            moments[i, k] = t2[k] + t3[k] + t1[k]
    for i in range(n - 1, -1, -1):
        tau[i] = moments[i, 2]
        if i > 0:
            _turn(turn[i], q[i], forces[i], t1, True)
            _turn(turn[i], q[i], moments[i], t2, True)
            _cross(place[i], t1, t3)
            for k in range(3):
                forces[i - 1, k] += t1[k]
                moments[i - 1, k] += t2[k] + t3[k]


@stored(error_model="numpy")
def _integrate(q, v, feed, noise, kicks, gains, turn, place, mass, centre, inertia, table, late, steps, dt):  # type: ignore[no-untyped-def]
    """Return encoder readings and commanded torques (samples, n) under a controller that holds its torque."""
    samples, n = q.shape
    seen, told = np.zeros((samples, n)), np.zeros((samples, n))
    x, w, h = q[0].copy(), v[0].copy(), dt / steps
    past = np.zeros((4096, n))
    past[:] = feed[0]
    at, rate, last, acc = 0, v[0].copy(), q[0].copy(), np.zeros(n)
    full, push, unit, none = np.zeros((n, n)), np.zeros(n), np.zeros(n), np.zeros(n)
    for k in range(samples):
        for j in range(n):
            seen[k, j] = x[j] + noise[k, j]
            speed = (seen[k, j] - last[j]) / dt if k > 0 else v[0, j]
            rate[j] += 0.25 * (speed - rate[j])
            last[j] = seen[k, j]
            told[k, j] = feed[k, j] + gains[0, j] * (q[k, j] - seen[k, j]) + gains[1, j] * (v[k, j] - rate[j])
        for s in range(steps):
            past[at] = told[k]
            x += 0.5 * h * w
            middle = w + 0.5 * h * acc
            _invert(x, middle, none, 9.81, turn, place, mass, centre, inertia, push)
            if s % 5 == 0:
                for j in range(n):
                    unit[:] = 0.0
                    unit[j] = 1.0
                    _invert(x, none, unit, 0.0, turn, place, mass, centre, inertia, full[j])
                    full[j, j] += table[8, j]
                ease = np.linalg.inv(full)
            for j in range(n):
                act = table[10, j] * past[(at - late[j]) % 4096, j] + kicks[k, j]
                act += table[4, j] * math.sin(table[5, j] * x[j]) - table[6, j] * x[j] + table[7, j]
                push[j] = act - table[9, j] * middle[j] - push[j]
            at = (at + 1) % 4096
            new = w + h * (ease @ push)
            impulse = np.zeros(n)
            for _ in range(SWEEPS):
                most = 0.0
                for j in range(n):
                    level = table[0, j] if w[j] >= 0.0 or table[3, j] == 0.0 else table[3, j]
                    level += table[1, j] * math.exp(-((w[j] / table[2, j]) ** 2))
                    if level == 0.0:
                        continue
                    wanted = impulse[j] - new[j] / ease[j, j]
                    wanted = min(max(wanted, -level * h), level * h)
                    change = wanted - impulse[j]
                    impulse[j] = wanted
                    for i in range(n):
                        new[i] += ease[i, j] * change
                    most = max(most, abs(change))
                if most < 1e-12:
                    break
            acc = (new - w) / h
            w = new
            x += 0.5 * h * w
    return seen, told


_find_torque: Callable[..., None] = _invert
_simulate: Callable[..., tuple[Array, Array]] = _integrate
