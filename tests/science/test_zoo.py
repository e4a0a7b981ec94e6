"""The integrator of the blind trial against one that shares nothing with it, and what dry friction must do."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lostmotion.kernels.independent_zoo import BOUC_WEN, DAHL, LUGRE, Body, Hidden, move
from lostmotion.workflow.zoo import Meddling, Rig, Signal, moved

BODY = Body(m=2.0, c=3.0, k=0.0, k0=800.0, x0=0.02)
DRIVE, OMEGA = 30.0, 7.0
STEP, EVERY, SAMPLES = 2e-5, 500, 300


def force(t):
    return DRIVE * np.cos(OMEGA * t)


def ours(hidden, body=BODY, start=(0.03, 0.0)):
    middle = (np.arange(SAMPLES * EVERY) + 0.5) * STEP
    state = np.array([*start, 0.0, 0.0])
    return move(force(middle), np.zeros((3, len(middle))), body, hidden, state, (0.0, STEP), EVERY)


def theirs(extra, rate=lambda t, x, v, z: 0.0, body=BODY, start=(0.03, 0.0)):
    """Return the motion by an adaptive method; `extra` is a force of time, position, velocity and one more state."""

    def slope(t, y):
        x, v, z = y
        contact = body.k0 * math.copysign(max(abs(x) - body.x0, 0.0), x)
        pull = force(t) - body.c * v - body.k * x - contact + extra(t, x, v, z)
        return [v, pull / body.m, rate(t, x, v, z)]

    times = np.arange(SAMPLES) * STEP * EVERY
    done = solve_ivp(slope, (0.0, times[-1]), [*start, 0.0], t_eval=times, rtol=1e-9, atol=1e-11, max_step=2e-3)
    return done.y[0]


def wave(t):
    return 0.2 * math.cos(2.0 * OMEGA * t + 0.4)


def outside(x, half=BODY.x0):
    return math.copysign(max(abs(x) - half, 0.0), x)


def dahl(t, x, v, z):
    return v * 4.0 / 0.01 - abs(v) * z / 0.01


def lugre(t, x, v, z):
    """A bristle of the stiffness force / deflection, z its force."""
    return 400.0 * (v - abs(v) * z / (4.0 + 2.0 * math.exp(-((v / 0.3) ** 2))))


def bouc_wen(t, x, v, z):
    return (v - 0.5 * (abs(v) * abs(z) * z + v * z * z)) / 0.02


CASES = {
    "nothing": (Hidden(), lambda t, x, v, z: 0.0, lambda *_: 0.0),
    "drags and springs": (
        Hidden(square=2.0, cube=900.0, spring=40.0, drag=0.7),
        lambda t, x, v, z: -2.0 * v * abs(v) - 900.0 * x**3 - 40.0 * x - 0.7 * v,
        lambda *_: 0.0,
    ),
    "a stiffness that changes": (
        Hidden(depth=0.2, pace=2.0 * OMEGA, phase=0.4),
        lambda t, x, v, z: -BODY.k0 * wave(t) * outside(x),
        lambda *_: 0.0,
    ),
    "a gap that grows": (
        Hidden(drift=2e-3),
        lambda t, x, v, z: BODY.k0 * (outside(x) - outside(x, BODY.x0 + 2e-3 * t)),
        lambda *_: 0.0,
    ),
    "a gap off its middle": (
        Hidden(shift=0.004, push=1.5),
        lambda t, x, v, z: BODY.k0 * (outside(x) - outside(x - 0.004)) + 1.5,
        lambda *_: 0.0,
    ),
    "a ripple": (
        Hidden(ripple=2.0, ripple_length=0.03),
        lambda t, x, v, z: 2.0 * math.sin(2.0 * math.pi * x / 0.03),
        lambda *_: 0.0,
    ),
    "dahl": (
        Hidden(memory=DAHL, memory_force=4.0, memory_travel=0.01),
        lambda t, x, v, z: -z,
        dahl,
    ),
    "lugre": (
        Hidden(memory=LUGRE, memory_force=4.0, memory_excess=2.0, memory_velocity=0.3, memory_travel=0.01),
        lambda t, x, v, z: -z,
        lugre,
    ),
    "bouc-wen": (
        Hidden(memory=BOUC_WEN, memory_force=4.0, memory_travel=0.02),
        lambda t, x, v, z: -4.0 * z,
        bouc_wen,
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_motion_is_that_of_another_integrator(name):
    hidden, extra, rate = CASES[name]
    mine, other = ours(hidden), theirs(extra, rate)
    assert np.max(np.abs(mine - other)) < 3e-4 * np.ptp(other)


def test_hidden_things_show():
    plain = ours(Hidden())
    for name, (hidden, *_) in CASES.items():
        if name != "nothing":
            assert np.max(np.abs(ours(hidden) - plain)) > 5e-3 * np.ptp(plain), name


def test_friction_stops_a_sliding_body_where_it_should():
    """A body of 2 kg at 0.5 m/s against 4 N slides for 0.25 s and 62.5 mm, and then does not move at all."""
    state = np.array([0.0, 0.5, 0.0, 0.0])
    free = Body(2.0, 0.0, 0.0, 0.0, 0.0)
    steps = 20_000
    seen = move(np.zeros(steps), np.zeros((3, steps)), free, Hidden(friction=4.0), state, (0.0, STEP), 100)
    assert seen[-1] == pytest.approx(0.0625, abs=1e-5)
    assert state[1] == 0.0
    assert np.ptp(seen[len(seen) // 2 + 30 :]) < 1e-9


def test_body_sticks_below_its_breakaway_force():
    state = np.zeros(4)
    push = np.full(10_000, 5.0)
    hidden = Hidden(friction=4.0, excess=1.5, velocity=0.01)
    seen = move(push, np.zeros((3, len(push))), Body(2.0, 0.0, 0.0, 0.0, 0.0), hidden, state, (0.0, STEP), 100)
    assert not seen.any()


def test_body_sticks_to_a_moving_base():
    times = np.arange(1, 10_001) * STEP
    middle = times - 0.5 * STEP
    base = np.stack([0.1 * np.sin(middle), 0.1 * np.cos(middle), 0.1 * np.cos(times)])
    state = np.array([0.0, 0.1, 0.0, 0.0])
    body, hidden = Body(2.0, 0.0, 0.0, 0.0, 0.0), Hidden(friction=4.0, friction_place=1.0)
    seen = move(np.zeros(len(times)), base, body, hidden, state, (0.0, STEP), 100)
    assert np.allclose(seen, 0.1 * np.sin(np.arange(len(seen)) * 100 * STEP), atol=1e-6)


def rig(**changed):
    values = {"m": 2.0, "c": 8.0, "k": 800.0}
    given = {"rate": 200.0, "samples": 800, "noise": 0.01, "signal": Signal(((30.0, OMEGA, 0.3), (9.0, 13.0, 1.0)))}
    return Rig("linear_oscillator", values, ("c", "k"), **{**given, **changed})


def answer(t, amplitude, omega, phase):
    """Return the settled motion of the oscillator under one tone."""
    gain = amplitude / (800.0 - 2.0 * omega**2 + 8.0j * omega)
    return np.real(gain * np.exp(1j * (omega * t + phase)))


@pytest.mark.parametrize(
    ("meddling", "late", "gain"),
    [
        (Meddling(), 0.0, 1.0),
        (Meddling(excitation_delay=0.013), 0.013, 1.0),
        (Meddling(sensor_delay=0.013), 0.013, 1.0),
        (Meddling(excitation_gain=0.2), 0.0, 1.2),
        (Meddling(sensor_gain=-0.1), 0.0, 0.9),
    ],
)
def test_recordings_are_those_of_the_linear_answer(meddling, late, gain):
    machine = rig()
    seen = moved(machine, Hidden(), meddling, np.random.default_rng(0))
    wanted = sum(answer(machine.time - late, *tone) for tone in machine.signal.tones)
    assert np.max(np.abs(seen - gain * wanted)) < 1e-4 * np.ptp(wanted)


def test_harmonic_of_the_drive_acts_and_is_not_recorded():
    machine = rig()
    seen = moved(machine, Hidden(), Meddling(harmonic=(6.0, 2.0 * OMEGA, 0.7)), np.random.default_rng(0))
    wanted = sum(answer(machine.time, *tone) for tone in (*machine.signal.tones, (6.0, 2.0 * OMEGA, 0.7)))
    assert np.max(np.abs(seen - wanted)) < 1e-4 * np.ptp(wanted)


def test_swept_drive_is_the_integral_of_its_slope():
    signal = Signal(((2.0, 5.0, 0.2),), sweep=0.8)
    t = np.linspace(-1.0, 6.0, 70_001)
    assert np.allclose(np.gradient(signal.value(t), t)[1:-1], signal.slope(t)[1:-1], atol=1e-4)
