"""Machines on a shaking table: closed forms, and equations in coordinates of the room by another integrator."""

from __future__ import annotations

import math

import numpy as np
import pytest
from field import elsewhere

from lostmotion.likelihood.system import Clock, System
from lostmotion_plugins.models.basic import LinearOscillator, RigidDrive
from lostmotion_plugins.models.clearance_chain import ClearanceChain
from lostmotion_plugins.models.duffing import Duffing
from lostmotion_plugins.models.gear_mesh import GearMesh
from lostmotion_plugins.models.impact_oscillator import ImpactOscillator
from lostmotion_plugins.models.joint import RobotJoint
from lostmotion_plugins.models.lin import LinBacklash
from lostmotion_plugins.models.slider import BacklashSlider

OMEGA, TRAVEL = 7.0, 0.05


def table(t):
    """Return place, velocity and acceleration of the table."""
    angle = OMEGA * t + 0.3
    sway, speed = TRAVEL * np.cos(angle), -TRAVEL * OMEGA * np.sin(angle)
    return sway, speed, -(OMEGA**2) * sway


def push(t):
    return 0.8 * np.cos(3.0 * t)


@pytest.mark.parametrize("motion", ["translation", "rotation"])
@pytest.mark.parametrize("omega", [2.0, 4.4, 20.0])
def test_transmissibility_of_a_linear_oscillator(omega, motion):
    """What the accelerometer on the body shows over what that on the table shows, amplitude and phase:
    (k + i c w) / (k - m w^2 + i c w); Thomson, Theory of Vibration with Applications, section 3.5."""
    m, c, k = 2.0, 3.0, 40.0
    answer = (k + 1j * c * omega) / (k - m * omega**2 + 1j * c * omega)
    relative = answer * 1.0 / (-(omega**2)) - 1.0 / (-(omega**2))
    system = System(LinearOscillator(motion))
    full = system.vector({"m": m, "c": c, "k": k})
    t = np.arange(400) * 0.01
    columns = [np.zeros_like, lambda t: np.cos(omega * t)]
    motion = system.moved(full, np.array([relative.real, (1j * omega * relative).real]), columns, Clock(0.01, 20, 400))
    inputs = np.stack([f(t) for f in columns], axis=1)
    _, seen = system.compute_derivatives(frozenset(), system.pack(full[None], 1e-3), motion.states, inputs, t)
    np.testing.assert_allclose(seen[:, 2], (answer * np.exp(1j * omega * t)).real, atol=1e-7 * abs(answer))


def loose(x, gap):
    return math.copysign(max(abs(x) - gap, 0.0), x)


def stopped(x, v):
    return max(300.0 * (x - 0.02) * (1.0 + 0.5 * v), 0.0) if x > 0.02 else 0.0


def chain(x, v):
    """Return the accelerations of two bodies whose springs and dampers stand on the table."""
    joint = 0.4 * (v[0] - v[1]) + 900.0 * loose(x[0] - x[1], 0.01)
    return [-1.1 * v[0] - 200.0 * x[0] - joint, (joint - 0.7 * v[1] - 60.0 * x[1]) / 0.6]


ALONE = {
    "lin_backlash": (
        LinBacklash, {"m": 1.5, "c": 1.2, "k1": 20.0, "k0": 500.0, "x0": 0.02}, 1.5,
        lambda t, x, v: -1.2 * v - 20.0 * x - 500.0 * loose(x, 0.02),
    ),
    "duffing": (Duffing, {"m": 1.5, "c": 0.9, "k": -20.0, "k3": 4e3}, 1.5,
                lambda t, x, v: -0.9 * v + 20.0 * x - 4e3 * x**3),
    "rigid_drive": (RigidDrive, {"m": 1.5, "c": 0.9}, 1.5, lambda t, x, v: -0.9 * v),
    "impact_oscillator": (
        ImpactOscillator, {"m": 1.5, "c": 0.9, "k": 60.0, "k0": 300.0, "x0": 0.02, "loss": 0.5}, 1.5,
        lambda t, x, v: -0.9 * v - 60.0 * x - stopped(x, v),
    ),
    "gear_mesh": (
        GearMesh,
        {"m": 1.5, "c": 0.9, "k0": 500.0, "x0": 0.02, "preload": 0.3, "kappa": 0.2, "omega_mesh": 11.0}, 1.5,
        lambda t, x, v: 0.3 - 0.9 * v - 500.0 * (1.0 + 0.2 * math.cos(11.0 * t)) * loose(x, 0.02),
    ),
}  # fmt: skip
"""Model, values, mass, and the force of springs, dampers and stops by motion relative to the table."""


@pytest.mark.parametrize("motion", ["translation", "rotation"])
@pytest.mark.parametrize("name", ALONE)
def test_a_shaken_body_against_another_integrator_in_coordinates_of_the_room(name, motion):
    model, values, mass, held = ALONE[name]

    def rates(t, y):
        sway, speed, _ = table(t)
        return [y[1], (push(t) + held(t, y[0] - sway, y[1] - speed)) / mass]

    system = System(model(motion))
    compared(system, values, rates, [0.01, 0.2])


def test_a_shaken_chain_against_another_integrator_in_coordinates_of_the_room():
    def rates(t, y):
        sway, speed, _ = table(t)
        first, second = chain((y[0] - sway, y[2] - sway), (y[1] - speed, y[3] - speed))
        return [y[1], first + push(t), y[3], second - 0.3 * math.sin(5.0 * t) / 0.6]

    values = {"m1": 1.0, "c1": 1.1, "k1": 200.0, "m2": 0.6, "c2": 0.7, "k2": 60.0, "k0": 900.0, "c0": 0.4, "x0": 0.01}
    compared(System(ClearanceChain()), values, rates, [0.01, 0.2, 0.0, -0.1], lambda t: -0.3 * np.sin(5.0 * t))


def compared(system, values, rates, start, *between):
    """Hold the motion of a system, and what all its sensors show, against an integrator in coordinates of the room."""
    full, t = system.vector(values), np.arange(300) * 0.01
    columns = [push, *between, lambda t: table(t)[2]]
    sway, speed, _ = table(t)
    begin = np.array(start) - np.tile([sway[0], speed[0]], len(start) // 2)
    motion = system.moved(full, begin, columns, Clock(0.01, 100, 300))
    room = elsewhere(rates, t, start, max_step=2e-3)
    carried = np.tile(np.stack([sway, speed], axis=1), len(start) // 2)
    np.testing.assert_allclose(motion.states, room - carried, atol=3e-5 * np.abs(room).max())
    inputs = np.stack([f(t) for f in columns], axis=1)
    _, seen = system.compute_derivatives(frozenset(), system.pack(full[None], 1e-3), room - carried, inputs, t)
    slopes = np.array([rates(at, y) for at, y in zip(t, room, strict=True)])
    for body in range(len(start) // 2):
        np.testing.assert_allclose(seen[:, 3 * body + 2], slopes[:, 2 * body + 1], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(seen[:, 3 * body], room[:, 2 * body] - sway, atol=1e-15)


@pytest.mark.parametrize("model", [RobotJoint(), BacklashSlider(), BacklashSlider("rotation")])
def test_a_body_behind_a_gap_that_is_pushed_too(model):
    """A base that moves and a force on the body itself, in coordinates relative to the base."""
    weight = 2.0 if model.name == "robot_joint" else 0.0

    def rates(t, y):
        sway, _, shaken = table(t)
        contact = 500.0 * loose(y[0], 0.02)
        return [y[1], (push(t) - 0.9 * y[1] - contact - weight * math.sin(y[0] + sway)) / 1.5 - shaken]

    system, t = System(model), np.arange(300) * 0.01
    full = system.vector({"m": 1.5, "c": 0.9, "k0": 500.0, "x0": 0.02} | ({"mgl": weight} if weight else {}))
    sway, speed, _ = table(t)
    start = np.array([0.01, 0.2])
    columns = [lambda t: table(t)[0], lambda t: table(t)[1], push]
    motion = system.moved(full, start + np.array([sway[0], speed[0]]), columns, Clock(0.01, 100, 300))
    relative = elsewhere(rates, t, start, max_step=2e-3)
    np.testing.assert_allclose(motion.states - np.stack([sway, speed], axis=1), relative, atol=3e-5)
    inputs = np.stack([f(t) for f in columns], axis=1)
    _, seen = system.compute_derivatives(frozenset(), system.pack(full[None], 1e-3), motion.states, inputs, t)
    felt = -0.9 * relative[:, 1] - 500.0 * np.array([loose(x, 0.02) for x in relative[:, 0]])
    np.testing.assert_allclose(seen[:, 3], felt, atol=3e-2 * np.abs(felt).max())
