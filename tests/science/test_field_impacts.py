"""Known answers of the impact oscillator and of the chain with a clearance."""

from __future__ import annotations

import math

import numpy as np
import pytest
from field import elsewhere, flow_of, followed
from scipy.optimize import brentq

from lostmotion_chaos.flows.flow import Harmonic
from lostmotion_chaos.quantifiers.flows import LyapunovMax, LyapunovSpectrum
from lostmotion_plugins.models.clearance_chain import ClearanceChain
from lostmotion_plugins.models.impact_oscillator import ImpactOscillator

RNG = np.random.default_rng(0)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [0.1, 1.0, 3.0])
@pytest.mark.parametrize("loss", [0.0, 0.2, 1.0])
def test_restitution_of_the_stop(speed, loss):
    """s - ln(1 + s) before and after: Marhefka, Orin, IEEE Trans. Systems, Man, Cybernetics A 29 (1999) 566-572."""
    values = {"m": 2.0, "c": 0.0, "k": 0.0, "k0": 5e3, "x0": 0.0, "loss": loss}
    seen = followed(ImpactOscillator(), values, drive=0.2, start=[-0.01 * speed, speed], looks=10, steps=20_000)
    leaving = -seen[-1, 1]
    assert seen[-1, 0] < 0.0
    if loss == 0.0:
        assert leaving == pytest.approx(speed, rel=1e-6)
        return
    come = loss * speed - math.log1p(loss * speed)
    expected = brentq(lambda s: -s - math.log1p(-s) - come, 1e-9, 1.0 - 1e-9) / loss
    assert leaving == pytest.approx(expected, rel=1e-5)


def test_period_of_a_body_between_spring_and_stop():
    """Half a swing on the spring, half on spring and stop: Shaw, Holmes (1983), piecewise linear."""
    period = math.pi * math.sqrt(1.5 / 40.0) + math.pi * math.sqrt(1.5 / (40.0 + 900.0))
    values = {"m": 1.5, "c": 0.0, "k": 40.0, "k0": 900.0, "x0": 0.0}
    seen = followed(ImpactOscillator(), values, drive=5.0 * period, start=[-0.02, 0.0], looks=5, steps=20_000)
    np.testing.assert_allclose(seen[:, 0], -0.02, rtol=1e-5)


ZETA, BEAT = 0.1, 2.2


def hard_orbit():
    """Return (velocity, drive phase) at the impact of the motion with one elastic impact a period on a hard stop at 0.

    x = e^(-zeta t) (a cos w t + b sin w t) + p cos(beat t) - q sin(beat t) for unit mass, stiffness and drive; x is 0
    at both ends of a period and the velocity there is reversed: Shaw, Holmes (1983), section 4.
    """
    w, period = math.sqrt(1.0 - ZETA**2), 2.0 * math.pi / BEAT
    fade, cos, sin = math.exp(-ZETA * period), math.cos(w * period), math.sin(w * period)
    begun = np.array([-ZETA, w, 0.0, -BEAT])
    ended = np.array([fade * (-ZETA * cos - w * sin), fade * (w * cos - ZETA * sin), 0.0, -BEAT])
    rows = np.array([[1.0, 0.0, 1.0, 0.0], [fade * cos, fade * sin, 1.0, 0.0], begun + ended])
    way = np.linalg.svd(rows)[2][-1]
    reply = 1.0 / complex(1.0 - BEAT**2, 2.0 * ZETA * BEAT)
    for sign in (1.0, -1.0):
        found = sign * way * abs(reply) / math.hypot(way[2], way[3])
        if begun @ found < 0.0:
            return float(begun @ found), float(np.angle(complex(found[2], found[3]) / reply))
    raise AssertionError("no such motion")


def test_a_stiff_stop_comes_to_the_motion_on_a_hard_one():
    """The orbit is attracting; what is left of the difference falls as the time in contact, with 1 / sqrt(k0)."""
    velocity, phase = hard_orbit()
    gaps = []
    for k0 in (1e4, 1e6):
        values = {"m": 1.0, "c": 2.0 * ZETA, "k": 1.0, "k0": k0, "x0": 0.0}
        flow = flow_of(
            ImpactOscillator(), values, drive=Harmonic(1.0, BEAT, phase), start=[0.0, velocity], steps=16_000
        )
        path = flow.sample(flow.start, periods=40, looks=1600)[-1601:]
        fastest = int(np.argmax(np.diff(path[:, 0] > 0.0)))
        assert np.sum(np.diff(np.sign(path[:, 0])) > 0) == 1
        gaps.append(abs(path[fastest, 1] + velocity) / abs(velocity))
    assert gaps[0] < 0.1
    assert gaps[1] < 0.2 * gaps[0]


def test_impacts_with_loss_against_another_integrator():
    values = {"m": 1.0, "c": 0.2, "k": 1.0, "k0": 200.0, "x0": 0.2, "loss": 0.5}

    def rates(t, y):
        push = max(200.0 * (y[0] - 0.2) * (1.0 + 0.5 * y[1]), 0.0) if y[0] > 0.2 else 0.0
        return [y[1], math.cos(1.6 * t) - 0.2 * y[1] - y[0] - push]

    t = np.linspace(0.0, 3 * 2.0 * math.pi / 1.6, 301)
    seen = followed(
        ImpactOscillator(), values, drive=Harmonic(1.0, 1.6), start=[0.0, 0.5], periods=3, looks=100, steps=8000
    )
    assert np.sum(np.diff(seen[:, 0] > 0.2)) >= 5
    np.testing.assert_allclose(seen, elsewhere(rates, t, [0.0, 0.5], max_step=0.005), atol=2e-5)


CHAIN = {"m1": 1.0, "c1": 1.5, "k1": 300.0, "m2": 0.6, "c2": 0.8, "k2": 50.0, "k0": 900.0, "c0": 0.5, "x0": 0.004}


@pytest.mark.parametrize("omega", [8.0, 22.0, 55.0])
def test_a_chain_without_clearance_is_the_linear_one(omega):
    """Both amplitudes and phases are those of (K + i w C - w^2 M)^-1 (force, 0)."""
    v = {**CHAIN, "x0": 0.0}
    stiff = np.array([[v["k1"] + v["k0"], -v["k0"]], [-v["k0"], v["k2"] + v["k0"]]])
    drag = np.array([[v["c1"] + v["c0"], -v["c0"]], [-v["c0"], v["c2"] + v["c0"]]])
    reply = np.linalg.solve(stiff + 1j * omega * drag - omega**2 * np.diag([v["m1"], v["m2"]]), [3.0, 0.0])
    periods = math.ceil(30.0 * omega / (2.0 * math.pi))
    seen = followed(ClearanceChain(), v, drive=Harmonic(3.0, omega), start=np.zeros(4), periods=periods, looks=64)
    turn = np.exp(-2j * math.pi * np.arange(64) / 64) / 32
    np.testing.assert_allclose(turn @ seen[-65:-1, [0, 2]], reply, rtol=1e-5)


def test_bodies_that_collide_keep_momentum_and_energy():
    """Free bodies, no loss; as each collision reverses the relative velocity, they part as fast as they meet."""
    values = {"m1": 1.0, "m2": 0.3, "k0": 4e3, "x0": 0.01}
    seen = followed(ClearanceChain(), values, drive=0.5, start=[0.0, 2.0, 0.0, -0.5], looks=2000, steps=40_000)
    lean, speed = seen[:, 0] - seen[:, 2], seen[:, 1] - seen[:, 3]
    momentum = seen[:, 1] + 0.3 * seen[:, 3]
    beyond = np.maximum(np.abs(lean) - 0.01, 0.0)
    energy = 0.5 * seen[:, 1] ** 2 + 0.15 * seen[:, 3] ** 2 + 2e3 * beyond**2
    assert np.sum(np.diff(beyond > 0.0)) >= 8
    np.testing.assert_allclose(momentum, 2.0 - 0.15, rtol=1e-12)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)
    np.testing.assert_allclose(np.abs(speed[beyond == 0.0]), 2.5, rtol=1e-6)


def test_a_chain_that_rattles_against_another_integrator():
    v = CHAIN

    def rates(t, y):
        lean = y[0] - y[2]
        joint = v["c0"] * (y[1] - y[3]) + v["k0"] * math.copysign(max(abs(lean) - v["x0"], 0.0), lean)
        first = 4.0 * math.cos(14.0 * t) - v["c1"] * y[1] - v["k1"] * y[0] - joint
        return [y[1], first / v["m1"], y[3], (joint - v["c2"] * y[3] - v["k2"] * y[2]) / v["m2"]]

    t = np.linspace(0.0, 4 * 2.0 * math.pi / 14.0, 201)
    seen = followed(ClearanceChain(), v, drive=Harmonic(4.0, 14.0), start=np.zeros(4), periods=4, looks=50, steps=4000)
    assert np.sum(np.diff(np.abs(seen[:, 0] - seen[:, 2]) > 0.004)) >= 8
    np.testing.assert_allclose(seen, elsewhere(rates, t, np.zeros(4), max_step=2e-3), atol=2e-5)


def test_volumes_in_the_chain_shrink_as_its_damping_says():
    """Liouville: the exponents sum to -(c1 + c0) / m1 - (c2 + c0) / m2, kinks or not."""
    flow = flow_of(ClearanceChain(), CHAIN, drive=Harmonic(4.0, 14.0), start=np.zeros(4))
    found = LyapunovSpectrum(periods=100, transient=20).estimate(flow, rng=RNG)
    assert found.details["sum"] == pytest.approx(-2.0 - 1.3 / 0.6, rel=5e-4)
    assert len(found.curve["spectrum"]) == 4


def test_exponents_are_measured_through_impacts():
    """The force has kinks and no jumps, so that tangent vectors go through them without more ado."""
    values = {"m": 1.0, "c": 0.2, "k": 1.0, "k0": 200.0, "x0": 0.2, "loss": 0.1}
    flow = flow_of(ImpactOscillator(), values, drive=Harmonic(1.0, 1.6), start=[0.1, 0.0])
    found = LyapunovMax(periods=300, transient=100).estimate(flow, rng=RNG)
    assert found.status == "ok", found.says
    assert flow.strobe(flow.start, periods=20, tangents=1).status == "ok"
