"""Trends of decays: dry friction, drag, springs and viscous damping are told apart; false alarms are counted."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lostmotion.signals.decay import Decay, decay_of
from lostmotion.signals.trends import says, trend_of

W, DT = 2.0 * np.pi * 5.0, 0.005
TIME = DT * np.arange(3000)


def decayed(force, noise=0.0, seed=0):
    """Return the decay of a unit mass from 1 under a force (x, v), by DOP853."""
    found = solve_ivp(
        lambda t, y: [y[1], force(*y)], (0.0, TIME[-1]), [1.0, 0.0], "DOP853", TIME, rtol=1e-9, atol=1e-11
    )
    return decay_of(found.y[0] + noise * np.random.default_rng(seed).normal(size=TIME.size), DT)


def dry(drop):
    """Return the decay of a body under Coulomb friction that takes `drop` off each cycle: a closed form."""
    offset = drop / 4.0
    halves = int(np.ceil((1.0 - offset) / (2.0 * offset)))
    half = np.floor(TIME * W / np.pi).astype(int)
    angle = np.where(half >= halves, halves * np.pi, W * TIME)
    half = np.minimum(half, halves - 1)
    return decay_of((1.0 - (2 * half + 1) * offset) * np.cos(angle) + offset * (-1.0) ** half, DT)


@pytest.mark.parametrize("drop", [0.03, 0.06, 0.12])
def test_dry_friction_is_known_by_its_constant_fall(drop):
    trend = trend_of(dry(drop))
    assert trend.damping == "dry friction"
    assert trend.stiffness == "constant"
    assert trend.dry.value == pytest.approx(drop, rel=0.04)
    assert trend.dry.sure


@pytest.mark.parametrize("noise", [0.0, 0.005])
def test_drag_is_known_by_a_decrement_that_goes_with_the_amplitude(noise):
    trend = trend_of(decayed(lambda x, v: -(W**2) * x - 0.1 * abs(v) * v - 0.01 * W * v, noise))
    assert (trend.stiffness, trend.damping) == ("constant", "drag")
    assert trend.decrement.value == pytest.approx(8.0 / 3.0 * 0.1, rel=0.06)


@pytest.mark.parametrize(("cubic", "kind"), [(0.3, "hardening"), (0.05, "hardening"), (-0.05, "softening")])
@pytest.mark.parametrize("noise", [0.0, 0.005])
def test_a_cubic_spring_bends_the_backbone(cubic, kind, noise):
    trend = trend_of(decayed(lambda x, v: -(W**2) * (x + cubic * x**3) - 0.01 * W * v, noise))
    assert (trend.stiffness, trend.damping) == (kind, "viscous")
    # First order: 3/8 of the cubic part (Nayfeh and Mook, 1979).
    assert trend.frequency.value == pytest.approx(5.0 * 0.375 * cubic, rel=0.12)


@pytest.mark.slow
def test_a_linear_oscillator_raises_an_alarm_in_one_of_a_hundred_noisy_records_at_most():
    rng, alarms = np.random.default_rng(7), 0
    for _ in range(100):
        w, ratio = 2.0 * np.pi * rng.uniform(4.0, 7.0), rng.uniform(0.003, 0.02)
        readings = np.exp(-ratio * w * TIME) * np.cos(w * np.sqrt(1.0 - ratio**2) * TIME + rng.uniform(0.0, 6.0))
        trend = trend_of(decay_of(readings + 10.0 ** rng.uniform(-4.0, -1.3) * rng.normal(size=TIME.size), DT))
        alarms += (trend.stiffness, trend.damping) != ("constant", "viscous")
    assert alarms <= 1


def test_sentences_say_what_was_found():
    still = says(decayed(lambda x, v: -(W**2) * x - 0.02 * W * v), "mm", factor=1e3)
    assert still.startswith("The frequency stays at 5.000 Hz from an amplitude of ")
    assert "mm; the logarithmic decrement stays at 0.0628. So one linear mode with viscous damping" in still
    sticking = says(dry(0.06))
    assert "the logarithmic decrement rises from 0.0" in sticking
    assert "as the motion dies. So the damping is strongest in small motion, as with dry friction." in sticking
    stiff = says(decayed(lambda x, v: -(W**2) * (x + 0.3 * x**3) - 0.01 * W * v), "m")
    assert "The frequency falls from 5.4" in stiff
    assert "So the stiffness rises with the amplitude (hardening)." in stiff


def test_few_cycles_have_no_trend():
    short = np.ones(4)
    few = Decay(np.arange(4.0), np.array([1.0, 0.8, 0.7, 0.6]), 5.0 * short, 0.2 * short, *(3 * [0.01 * short]), 0.01)
    trend = trend_of(few)
    assert (trend.stiffness, trend.damping) == ("constant", "viscous")
    assert not trend.dry.sure


def test_a_slipping_joint_does_both():
    size = np.geomspace(1.0, 0.01, 80)
    none = np.full(80, 1e-9)
    time = np.arange(80) / 5.0
    joint = Decay(time, size, 5.0 - 0.1 * size**2, np.full(80, 0.06), none, none, none, 1e-9)
    assert trend_of(joint).stiffness == "softening"
    rises = np.exp(-np.cumsum(0.02 + 0.2 * np.exp(-time)))
    both = Decay(time, rises, 5.0 - 0.1 * rises**2, 0.02 + 0.2 * np.exp(-time), none, none, none, 1e-9)
    assert trend_of(both).damping == "drag"
    assert says(both).endswith("; a joint that slips does both.")
