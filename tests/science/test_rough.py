"""The integrator of the imperfect world: against that of the perfect one, against another method, and in its parts."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lostmotion_trials.blind import imperfect, simulator
from lostmotion_trials.blind.hiding import convert_effects
from lostmotion_trials.blind.imperfect import KINDS, draw_effect, draw_machine, draw_world, simulate_imperfect
from lostmotion_trials.blind.mechanisms import Pilot
from lostmotion_trials.blind.simulator import Disturbances, simulate_machine
from lostmotion_trials.integrators.hidden import BOUC_WEN, DAHL, LUGRE, Body, Hidden, move
from lostmotion_trials.integrators.imperfect import CELLS, REACH, Flaws, _read, move_rough

BODY = Body(m=2.0, c=3.0, k=60.0, k0=800.0, x0=0.02)
DRIVE, OMEGA = 30.0, 7.0
STEP, EVERY, SAMPLES = 2e-5, 500, 300
PLACES = np.linspace(-REACH, REACH, CELLS + 1)
LEVEL = np.array([np.zeros(CELLS + 1), np.zeros(CELLS + 1), np.ones(CELLS + 1)])
"""Curves that do nothing: no force over position and velocity, and friction at its usual level."""
MIDDLES = (np.arange(SAMPLES * EVERY) + 0.5) * STEP
FIRST = 200
SWEPT = np.zeros((3, len(MIDDLES)))


def rough(hidden, flaws=None, curves=LEVEL, body=BODY, force=None, start=(0.03, 0.0)):
    """Return what the sensor shows (samples,) with these flaws, and the state at the end."""
    state = np.array([*start, *[0.0] * 7])
    pull = DRIVE * np.cos(OMEGA * MIDDLES) if force is None else force
    seen = move_rough(pull, SWEPT, body, hidden, flaws or Flaws(), curves, state, (0.0, STEP), EVERY)
    return seen[:, 0], state


HIDING = {
    "nothing": Hidden(),
    "dry friction that sticks": Hidden(friction=4.0, excess=2.0, velocity=0.1),
    "friction against the base": Hidden(friction=3.0, friction_place=1.0, rough=2.0, rough_length=0.02),
    "springs and drags": Hidden(square=2.0, cube=900.0, spring=40.0, drag=0.7, contact_drag=1.0, mixed=5.0),
    "waves": Hidden(depth=0.2, pace=14.0, phase=0.4, drift=2e-3, push=1.0, ripple=1.0, ripple_length=0.01),
    "play and stops": Hidden(play=0.01, stop=900.0, stop_travel=0.03, stop_side=1.0, crush=50.0, hertz=400.0),
    "a mass that rattles, and one more": Hidden(
        mode_mass=0.3, mode_stiffness=40.0, mode_drag=0.2, added=0.5, added_from=1.0
    ),
    "frictions": Hidden(friction=3.0, friction_back=1.0, wave=1.0, wave_length=0.02, warm=1.0, load=0.1, slant=1.0),
    "what comes later": Hidden(spring=40.0, bow=900.0, fold=20.0, aging=0.2, onset=1.0),
    "a bristle": Hidden(memory=LUGRE, memory_force=4.0, memory_excess=2.0, memory_velocity=0.3, memory_travel=0.01),
    "hysteresis": Hidden(memory=BOUC_WEN, memory_force=4.0, memory_travel=0.02),
    "a bristle at the base": Hidden(memory=DAHL, memory_force=4.0, memory_travel=0.01, memory_place=1.0),
}


@pytest.mark.parametrize("name", HIDING)
def test_without_flaws_it_moves_as_in_the_perfect_world(name):
    base = np.stack([0.01 * np.sin(5.0 * (MIDDLES + h)) for h in (0.0, 0.0, 0.5 * STEP)])
    base[1:] = [0.05 * np.cos(5.0 * (MIDDLES + h)) for h in (0.0, 0.5 * STEP)]
    force, clock = DRIVE * np.cos(OMEGA * MIDDLES), (0.0, STEP)
    state, flawed = np.zeros(6), np.zeros(9)
    state[0] = flawed[0] = 0.03
    wanted = move(force, base, BODY, HIDING[name], state, clock, EVERY)[:, 0]
    found = move_rough(force, base, BODY, HIDING[name], Flaws(), LEVEL, flawed, clock, EVERY)[:, 0]
    assert np.abs(found - wanted).max() < 1e-11 * np.abs(wanted).max()
    assert np.allclose(flawed[[0, 1, 2, 3, 7, 8]], state, rtol=1e-9, atol=0.0)
    assert not flawed[4:7].any()


@pytest.mark.slow
def test_all_flaws_agree_with_an_adaptive_method():
    """The twin is written from the equations of motion: a spring with play on a foot, curves, a bristle, a far mode."""
    flaws = Flaws(0.03, 0.3, 4e4, 200.0, 90.0, 0.02, 2e-4)
    curves = np.array([2.0 * np.sin(PLACES) ** 2, 1.5 * np.cos(2.0 * PLACES), np.exp(0.2 * np.sin(3.0 * PLACES))])
    hidden = Hidden(memory=BOUC_WEN, memory_force=4.0, memory_travel=0.02)

    def slope(t, y):
        x, v, z, sunk, far, fast = y
        squeezed = x - sunk - min(max(x - sunk, -BODY.x0), BODY.x0)
        inner = -BODY.k * x - BODY.k0 * squeezed
        inner += np.interp(x / flaws.position, PLACES, curves[0]) + np.interp(v / flaws.velocity, PLACES, curves[1])
        level = np.interp(abs(v) / flaws.velocity, PLACES, curves[2])
        a = (DRIVE * math.cos(OMEGA * t) + inner - BODY.c * v - 4.0 * level * z) / BODY.m
        dz = (v - 0.5 * (abs(v) * abs(z) * z + v * z * z)) / 0.02
        ring = flaws.far_pace**2 * (flaws.far_compliance * BODY.m * a - far)
        return [
            v, a, dz, (-inner - flaws.foot * sunk) / flaws.foot_drag,
            fast, ring - 2.0 * flaws.far_loss * flaws.far_pace * fast,
        ]  # fmt: skip

    times = np.arange(SAMPLES) * STEP * EVERY
    start = [0.03, 0.0, 0.0, 0.0, 0.0, 0.0]
    done = solve_ivp(slope, (0.0, times[-1]), start, "DOP853", t_eval=times, rtol=1e-8, atol=1e-11, max_step=2e-3)
    wanted, (found, _) = done.y[0] + done.y[4], rough(hidden, flaws, curves)
    assert np.abs(found - wanted).max() < 2e-4 * np.abs(wanted).max()
    assert np.abs(found - rough(hidden)[0]).max() > 0.05 * np.abs(wanted).max()


def test_foot_gives_way_by_force_over_stiffness():
    """At rest the contact carries the push; half the play, contact and foot give way one after the other."""
    body, push, foot = BODY._replace(k=0.0, c=60.0), 50.0, 8000.0
    shown, state = rough(Hidden(), Flaws(foot=foot, foot_drag=40.0), body=body, force=np.full(len(MIDDLES), push))
    assert state[4] == pytest.approx(push / foot, rel=1e-4)
    assert shown[-1] == pytest.approx(body.x0 + push / body.k0 + push / foot, rel=1e-4)


def far_part(loss):
    """Return what a far mode of 40 rad/s adds (samples,) under a push that sets in at once, and its static value."""
    free, force = Body(2.0, 0.0, 0.0, 0.0, 0.0), np.full(len(MIDDLES), 6.0)
    bare = rough(Hidden(), body=free, force=force)[0]
    with_mode = rough(Hidden(), Flaws(far_pace=40.0, far_loss=loss, far_compliance=3e-3), body=free, force=force)[0]
    return with_mode - bare, 6.0 * 3e-3


def test_far_mode_settles_at_its_static_compliance():
    found, static = far_part(0.3)
    assert found[-1] == pytest.approx(static, rel=1e-4)


def test_far_mode_rings_at_its_pace_and_dies_at_its_loss():
    found, static = far_part(0.01)
    times = np.arange(SAMPLES) * STEP * EVERY
    pace = 40.0 * math.sqrt(1.0 - 0.01**2)
    envelope = np.exp(-0.01 * 40.0 * times)
    wanted = static * (1.0 - envelope * (np.cos(pace * times) + 0.01 / math.sqrt(1.0 - 0.01**2) * np.sin(pace * times)))
    assert np.abs(found - wanted).max() < 2e-3 * static


def test_curves_are_read_by_straight_lines_and_are_constant_beyond():
    table = np.random.default_rng(0).standard_normal(CELLS + 1)
    places = np.linspace(-2.0 * REACH, 2.0 * REACH, 5001)
    found = np.array([_read(table, z) for z in places])
    assert np.allclose(found, np.interp(places, PLACES, table), atol=1e-6)
    assert np.allclose([_read(table, z) for z in PLACES], table, atol=1e-6)


def test_friction_follows_its_curve_over_the_speed():
    """At a steady speed the push of dry friction is its level times the curve there."""
    free, curves = Body(2.0, 0.0, 0.0, 0.0, 0.0), LEVEL.copy()
    curves[2] = np.where(np.abs(PLACES) > 1.0, 1.5, 0.5)
    for speed, level in ((0.5, 0.5), (-0.5, 0.5), (2.0, 1.5), (-2.0, 1.5)):
        pull = math.copysign(4.0 * level, speed)
        shown, _ = rough(Hidden(friction=4.0), Flaws(), curves, free, np.full(len(MIDDLES), pull), (0.0, speed))
        assert shown[-1] == pytest.approx(speed * (SAMPLES - 1) * STEP * EVERY, rel=1e-6)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["coulomb_friction", "cubic_stiffness"])
def test_half_the_step_moves_it_less_than_the_noise(kind, name, monkeypatch):
    """Over the first cycles, from rest: later a chaotic machine is anywhere, whatever the step."""
    monkeypatch.setattr(simulator, "SETTLING_PERIODS", 0)
    rng = np.random.default_rng([3, KINDS.index(kind)])
    rig = draw_machine(kind, rng, 500)
    pilot = Pilot(rig, simulate_machine(rig, Hidden(), Disturbances(), rng))
    world = draw_world(kind, pilot, rng)
    hidden = convert_effects(rig, (draw_effect(name, pilot, rng),))
    coarse = simulate_imperfect(rig, hidden, world, rng)
    monkeypatch.setattr(imperfect, "STEPS_PER_RATE", 0.5 * imperfect.STEPS_PER_RATE)
    fine = simulate_imperfect(rig, hidden, world, rng)
    apart = np.abs(coarse - fine)[:FIRST].max()
    assert 0.0 < apart < 0.3 * pilot.noise
