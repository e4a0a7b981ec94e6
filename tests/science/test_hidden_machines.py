"""The integrator of the blind trial against one that shares nothing with it, and what dry friction must do."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lostmotion_trials.blind.simulator import BlindDrive, BlindMachine, Disturbances, simulate_machine
from lostmotion_trials.integrators.hidden import BOUC_WEN, DAHL, LUGRE, Body, Hidden, _levels, move

BODY = Body(m=2.0, c=3.0, k=0.0, k0=800.0, x0=0.02)
DRIVE, OMEGA = 30.0, 7.0
STEP, EVERY, SAMPLES = 2e-5, 500, 300


def force(t):
    return DRIVE * np.cos(OMEGA * t)


def ours(hidden, body=BODY, start=(0.03, 0.0)):
    middle = (np.arange(SAMPLES * EVERY) + 0.5) * STEP
    state = np.array([*start, 0.0, 0.0, start[0], start[1]])
    return move(force(middle), np.zeros((3, len(middle))), body, hidden, state, (0.0, STEP), EVERY)[:, 0]


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


def beyond(x, travel, side):
    """Return how far a body is beyond a stop at one side, or at both if that is 0."""
    return max(x - travel, 0.0) * (side >= 0.0) - max(-travel - x, 0.0) * (side <= 0.0)


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
    "a stop at both ends": (
        Hidden(stop=3000.0, stop_travel=0.03),
        lambda t, x, v, z: -3000.0 * beyond(x, 0.03, 0.0),
        lambda *_: 0.0,
    ),
    "a stop at the lower end": (
        Hidden(stop=3000.0, stop_travel=0.03, stop_side=-1.0),
        lambda t, x, v, z: -3000.0 * beyond(x, 0.03, -1.0),
        lambda *_: 0.0,
    ),
    "a contact that is crushed": (
        Hidden(crush=600.0, hertz=2000.0),
        lambda t, x, v, z: -600.0 * abs(outside(x)) * v - math.copysign(2000.0 * abs(outside(x)) ** 1.5, x),
        lambda *_: 0.0,
    ),
    "what is larger one way": (
        Hidden(fold=90.0, bow=2000.0, slant=2.0),
        lambda t, x, v, z: -90.0 * abs(x) - 2000.0 * x * x - 2.0 * abs(v),
        lambda *_: 0.0,
    ),
    "a drag that grows": (
        Hidden(aging=1.5),
        lambda t, x, v, z: -1.5 * t * v,
        lambda *_: 0.0,
    ),
    "a wave that narrows": (
        Hidden(ripple=2.0, ripple_length=0.03, ripple_phase=0.8, ripple_chirp=0.2),
        lambda t, x, v, z: 2.0 * math.sin(2.0 * math.pi * x / 0.03 * (1.0 + 0.2 * x / 0.03) + 0.8),
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


def test_play_takes_the_spring_off():
    body = Body(m=2.0, c=3.0, k=500.0, k0=0.0, x0=0.0)
    other = theirs(lambda t, x, v, z: 500.0 * min(max(x, -0.02), 0.02), body=body)
    assert np.max(np.abs(ours(Hidden(play=0.02), body) - other)) < 3e-4 * np.ptp(other)


def test_hidden_mass_rides_on_the_body_and_another_is_added():
    """The twin has both masses in its equations of motion; the added one joins at 1.2 s."""
    mass, stiff, drag = 0.3, 40.0, 0.2

    def slope(t, y):
        x, v, z, w = y
        between = stiff * (z - x) + drag * (w - v)
        contact = BODY.k0 * math.copysign(max(abs(x) - BODY.x0, 0.0), x)
        pull = force(t) - BODY.c * v - contact + between
        return [v, pull / (BODY.m + (0.7 if t >= 1.2 else 0.0)), w, -between / mass]

    times = np.arange(SAMPLES) * STEP * EVERY
    start = [0.03, 0.0, 0.03, 0.0]
    done = solve_ivp(slope, (0.0, times[-1]), start, t_eval=times, rtol=1e-9, atol=1e-11, max_step=2e-3)
    hidden = Hidden(mode_mass=mass, mode_stiffness=stiff, mode_drag=drag, added=0.7, added_from=1.2)
    assert np.max(np.abs(ours(hidden) - done.y[0])) < 3e-4 * np.ptp(done.y[0])


def test_nothing_acts_before_its_onset():
    late, always, never = (ours(Hidden(spring=200.0, **more)) for more in ({"onset": 1.5}, {}, {"onset": 99.0}))
    cut = round(1.5 / (STEP * EVERY))
    assert np.array_equal(late[: cut + 1], ours(Hidden())[: cut + 1])
    assert np.abs(late - always).max() > 0.01 * np.ptp(always)
    assert np.array_equal(never, ours(Hidden()))


@pytest.mark.parametrize(
    ("hidden", "ahead", "back"),
    [
        (Hidden(friction=4.0), 4.0, 4.0),
        (Hidden(friction=4.0, friction_back=1.5), 4.0, 1.5),
        (
            Hidden(friction=4.0, wave=2.0, wave_length=0.1, wave_phase=0.5),
            4.0 + 2.0 * math.cos(0.4 * math.pi + 0.5),
            None,
        ),
        (Hidden(friction=4.0, warm=-3.0, warm_time=2.0), 4.0 - 3.0 * (1.0 - math.exp(-1.5)), None),
        (Hidden(friction=4.0, load=0.1), 4.0 + 0.1 * 25.0, None),
        (Hidden(friction=1.0, warm=-3.0, warm_time=2.0), 0.0, None),
    ],
)
def test_friction_has_the_level_of_its_law(hidden, ahead, back):
    """At 3 s, 0.02 m and a load of 25 N."""
    assert _levels(3.0, 0.4, 0.02, 25.0, hidden) == pytest.approx((ahead, ahead if back is None else back))


def test_friction_stops_a_sliding_body_where_it_should():
    """A body of 2 kg at 0.5 m/s against 4 N slides for 0.25 s and 62.5 mm, and then does not move at all."""
    state = np.array([0.0, 0.5, 0.0, 0.0, 0.0, 0.0])
    free = Body(2.0, 0.0, 0.0, 0.0, 0.0)
    steps = 20_000
    seen = move(np.zeros(steps), np.zeros((3, steps)), free, Hidden(friction=4.0), state, (0.0, STEP), 100)[:, 0]
    assert seen[-1] == pytest.approx(0.0625, abs=1e-5)
    assert state[1] == 0.0
    assert np.ptp(seen[len(seen) // 2 + 30 :]) < 1e-9


def test_body_sticks_below_its_breakaway_force():
    state = np.zeros(6)
    push = np.full(10_000, 5.0)
    hidden = Hidden(friction=4.0, excess=1.5, velocity=0.01)
    seen = move(push, np.zeros((3, len(push))), Body(2.0, 0.0, 0.0, 0.0, 0.0), hidden, state, (0.0, STEP), 100)
    assert not seen.any()


def test_body_sticks_to_a_moving_base():
    times = np.arange(1, 10_001) * STEP
    middle = times - 0.5 * STEP
    base = np.stack([0.1 * np.sin(middle), 0.1 * np.cos(middle), 0.1 * np.cos(times)])
    state = np.array([0.0, 0.1, 0.0, 0.0, 0.0, 0.0])
    body, hidden = Body(2.0, 0.0, 0.0, 0.0, 0.0), Hidden(friction=4.0, friction_place=1.0)
    seen = move(np.zeros(len(times)), base, body, hidden, state, (0.0, STEP), 100)[:, 0]
    assert np.allclose(seen, 0.1 * np.sin(np.arange(len(seen)) * 100 * STEP), atol=1e-6)


def rig(**changed):
    values = {"m": 2.0, "c": 8.0, "k": 800.0}
    given = {"rate": 200.0, "samples": 800, "noise": 0.01, "signal": BlindDrive(((30.0, OMEGA, 0.3), (9.0, 13.0, 1.0)))}
    return BlindMachine("linear_oscillator", values, ("c", "k"), **{**given, **changed})


def answer(t, amplitude, omega, phase):
    """Return the settled motion of the oscillator under one tone."""
    gain = amplitude / (800.0 - 2.0 * omega**2 + 8.0j * omega)
    return np.real(gain * np.exp(1j * (omega * t + phase)))


@pytest.mark.parametrize(
    ("disturbances", "late", "gain"),
    [
        (Disturbances(), 0.0, 1.0),
        (Disturbances(excitation_delay=0.013), 0.013, 1.0),
        (Disturbances(sensor_delay=0.013), 0.013, 1.0),
        (Disturbances(excitation_gain=0.2), 0.0, 1.2),
        (Disturbances(sensor_gain=-0.1), 0.0, 0.9),
    ],
)
def test_recordings_are_those_of_the_linear_answer(disturbances, late, gain):
    machine = rig()
    seen = simulate_machine(machine, Hidden(), disturbances, np.random.default_rng(0))
    wanted = sum(answer(machine.time - late, *tone) for tone in machine.signal.tones)
    assert np.max(np.abs(seen - gain * wanted)) < 1e-4 * np.ptp(wanted)


def test_harmonic_of_the_drive_acts_and_is_not_recorded():
    machine = rig()
    seen = simulate_machine(machine, Hidden(), Disturbances(harmonic=(6.0, 2.0 * OMEGA, 0.7)), np.random.default_rng(0))
    wanted = sum(answer(machine.time, *tone) for tone in (*machine.signal.tones, (6.0, 2.0 * OMEGA, 0.7)))
    assert np.max(np.abs(seen - wanted)) < 1e-4 * np.ptp(wanted)


def test_lags_are_those_of_the_linear_answer():
    """A lag of actuator or sensor multiplies each tone by 1 / (1 + i omega time)."""
    machine, time = rig(), 0.02
    wanted = sum(
        np.real(a / (800.0 - 2.0 * w**2 + 8.0j * w) / (1.0 + 1.0j * w * time) * np.exp(1j * (w * machine.time + p)))
        for a, w, p in machine.signal.tones
    )
    for disturbances in (Disturbances(actuator_time=time), Disturbances(sensor_time=time)):
        seen = simulate_machine(machine, Hidden(), disturbances, np.random.default_rng(0))
        assert np.max(np.abs(seen - wanted)) < 1e-3 * np.ptp(wanted)


def test_sensor_can_show_velocity_and_acceleration():
    machine = rig()
    for order, channel in enumerate(("position", "velocity", "acceleration")):
        seen = simulate_machine(replace(machine, channel=channel), Hidden(), Disturbances(), np.random.default_rng(0))
        wanted = sum(
            np.real((1j * w) ** order * a / (800.0 - 2.0 * w**2 + 8.0j * w) * np.exp(1j * (w * machine.time + p)))
            for a, w, p in machine.signal.tones
        )
        assert np.max(np.abs(seen - wanted)) < 1e-3 * np.ptp(wanted)


def test_drive_is_cut_above_its_limit_and_in_its_dead_zone():
    signal, t = BlindDrive(((10.0, 5.0, 0.0),)), np.linspace(0.0, 3.0, 3001)
    value, slope = Disturbances(limit=6.0, dead=2.0).distort_drive(signal, t)
    assert np.abs(value).max() == pytest.approx(4.0)
    assert (value == 0.0).mean() == pytest.approx(2.0 / math.pi * math.asin(0.2), abs=0.01)
    assert not slope[(value == 0.0) | (np.abs(value) == np.abs(value).max())].any()


def test_swept_drive_is_the_integral_of_its_slope():
    signal = BlindDrive(((2.0, 5.0, 0.2),), sweep=0.8)
    t = np.linspace(-1.0, 6.0, 70_001)
    assert np.allclose(np.gradient(signal.value(t), t)[1:-1], signal.slope(t)[1:-1], atol=1e-4)
