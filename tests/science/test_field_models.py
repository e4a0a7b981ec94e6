"""Known answers of Duffing's oscillator and of the gear pair: closed forms, published exponents, other integrators."""

from __future__ import annotations

import math

import numpy as np
import pytest
from field import elsewhere, flow_of, followed
from scipy.optimize import brentq
from scipy.special import ellipj, mathieu_a, mathieu_b

from lostmotion_chaos.flows.flow import Harmonic
from lostmotion_chaos.quantifiers.flows import KaplanYorke, LyapunovMax
from lostmotion_plugins.models.duffing import Duffing
from lostmotion_plugins.models.gear_mesh import GearMesh

RNG = np.random.default_rng(0)


@pytest.mark.parametrize(("k", "k3", "far"), [(2.0, 5.0, 0.7), (0.0, 3.0, 1.1), (2.0, -1.5, 0.8), (-1.0, 2.0, 0.9)])
def test_free_duffing_is_an_elliptic_function(k, k3, far):
    """Kovacic, Brennan, The Duffing Equation (2011), section 2.2."""
    values = {"m": 1.3, "c": 0.0, "k": k, "k3": k3}
    seen = followed(Duffing(), values, drive=12.0, start=[far, 0.0], looks=300, steps=6000)
    exact = elliptic(k / 1.3, k3 / 1.3, far, np.linspace(0.0, 12.0, 301))
    np.testing.assert_allclose(seen[:, 0], exact, atol=1e-8)


def elliptic(k, k3, far, t):
    """Return the free motion of a unit mass from rest at `far`: dn in one well of two, else cn, or cd if it softens."""
    bent = 0.5 * k3 * far**2
    if k < 0.0:
        return far * ellipj(math.sqrt(bent) * t, 2.0 + k / bent)[2]
    if k3 < 0.0:
        _, cn, dn, _ = ellipj(math.sqrt(k + bent) * t, -bent / (k + bent))
        return far * cn / dn
    return far * ellipj(math.sqrt(k + 2.0 * bent) * t, bent / (k + 2.0 * bent))[1]


PUBLISHED = {
    "Ueda": ({"m": 1.0, "c": 0.05, "k": 0.0, "k3": 1.0}, 7.5, 0.1034, 2.674),
    "two wells": ({"m": 1.0, "c": 0.25, "k": -1.0, "k3": 1.0}, 0.4, 0.1571, 2.386),
}
"""Values, amplitude at omega = 1, largest exponent (1/s) and dimension: Sprott, Chaos and Time-Series Analysis (2003),
appendix A.5. A Runge-Kutta program of our own beside this one gave 0.1032 +- 0.0003 and 0.1568 +- 0.0003."""


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_exponents_of_duffing(name):
    values, amplitude, exponent, dimension = PUBLISHED[name]
    flow = flow_of(Duffing(), values, drive=Harmonic(amplitude, 1.0), start=[1.0, 0.1])
    found = KaplanYorke(periods=4000).estimate(flow, rng=RNG)
    assert found.status == "ok", found.says
    error = float(np.max(found.curve["stderr"]))
    assert found.details["lyapunov_max"] == pytest.approx(exponent, abs=0.0005 + 3.0 * error)
    assert error < 0.03 * exponent
    assert found.value == pytest.approx(dimension, abs=0.001 + 2.0 * (found.high - found.low))
    assert found.curve["spectrum"].sum() == pytest.approx(-values["c"], abs=1e-6)


def mesh(c=0.0, kappa=0.3, omega=2.0, **more):
    """Return the parameters of a gear pair without backlash whose mean natural frequency is one."""
    return {"m": 1.0, "c": c, "k0": 1.0, "x0": 0.0, "kappa": kappa, "omega_mesh": omega, **more}


def tongue(kappa):
    """Return the frequencies between which a mesh of unit frequency is unstable at first order of resonance.

    4/w^2 = a is the characteristic value of odd, or of even, solutions at q = kappa a / 2: McLachlan, Theory and
    Application of Mathieu Functions (1947), section 3.
    """
    edges = [brentq(lambda a, f=f: f(1, 0.5 * kappa * a) - a, 0.5, 2.0) for f in (mathieu_a, mathieu_b)]
    return tuple(2.0 / math.sqrt(a) for a in edges)


def exponent_at_rest(values):
    """Return the largest exponent (1/s) of the state of rest."""
    flow = flow_of(GearMesh(), values, drive=2.0 * math.pi / values["omega_mesh"], start=[0.0, 0.0])
    return float(flow.strobe(np.zeros(2), periods=2000, tangents=1).growth[200:].mean() / flow.period)


@pytest.mark.parametrize("kappa", [pytest.param(0.1, marks=pytest.mark.slow), 0.5])
def test_mesh_stiffness_makes_rest_unstable_where_mathieu_says(kappa):
    low, high = tongue(kappa)
    inside, outside = (low * 1.003, high * 0.997), (low * 0.997, high * 1.003)
    assert all(exponent_at_rest(mesh(kappa=kappa, omega=w)) > 0.03 * kappa for w in inside)
    assert all(abs(exponent_at_rest(mesh(kappa=kappa, omega=w))) < 0.01 * kappa for w in outside)


def test_exponents_of_a_damped_mesh_are_those_of_floquet():
    """From the monodromy matrix by DOP853; damping takes c / 2m off each exponent."""
    values = mesh(c=0.06, kappa=0.4, omega=2.05)
    period = 2.0 * math.pi / values["omega_mesh"]

    def rates(t, y):
        return [y[1], -0.06 * y[1] - (1.0 + 0.4 * math.cos(2.05 * t)) * y[0]]

    ends = np.array([elsewhere(rates, np.array([0.0, period]), e)[-1] for e in np.eye(2)])
    floquet = np.log(np.abs(np.linalg.eigvals(ends))).max() / period
    assert exponent_at_rest(values) == pytest.approx(floquet, abs=1e-5)
    assert exponent_at_rest(mesh(kappa=0.4, omega=2.05)) == pytest.approx(floquet + 0.03, abs=2e-3)


def test_teeth_that_never_part_answer_as_hill_says():
    """A heavy mean load: x - x0 is the steady answer of a linear spring that pulsates, by balance of 12 harmonics."""
    values = mesh(c=0.1, kappa=0.3, omega=0.8, preload=1.0) | {"x0": 0.05}
    orders = np.arange(-12, 13)
    balance = np.diag(1.0 - (0.8 * orders) ** 2 + 0.1j * 0.8 * orders).astype(complex)
    balance += 0.15 * (np.eye(25, k=1) + np.eye(25, k=-1))
    shares = np.linalg.solve(balance, (orders == 0).astype(complex))
    t = np.linspace(0.0, 2.0 * math.pi / 0.8, 65)
    steady = (np.exp(0.8j * np.outer(t, orders)) @ shares).real
    assert steady.min() > 0.1
    seen = followed(
        GearMesh(), values, drive=2.0 * math.pi / 0.8, start=[0.05 + steady[0], 0.0], periods=60, looks=64, steps=640
    )
    np.testing.assert_allclose(seen[-65:, 0] - 0.05, steady, atol=1e-6)


def test_gears_that_rattle_against_another_integrator():
    values = mesh(c=0.05, kappa=0.3, omega=1.4, preload=0.1, phase=0.6) | {"x0": 1.0}
    t = np.linspace(0.0, 6 * math.pi / 0.7, 301)

    def rates(t, y):
        beyond = math.copysign(max(abs(y[0]) - 1.0, 0.0), y[0])
        push = 0.1 + 0.5 * math.cos(0.7 * t)
        return [y[1], push - 0.05 * y[1] - (1.0 + 0.3 * math.cos(1.4 * t + 0.6)) * beyond]

    seen = followed(GearMesh(), values, drive=Harmonic(0.5, 0.7), start=[0.9, 0.3], periods=3, looks=100, steps=4000)
    assert np.sum(np.diff(np.abs(seen[:, 0]) > 1.0)) >= 6
    np.testing.assert_allclose(seen, elsewhere(rates, t, [0.9, 0.3], max_step=0.01), atol=2e-5)


def test_exponents_are_measured_through_teeth():
    """The force has kinks and no jumps, so that tangent vectors go through them without more ado."""
    values = mesh(c=0.05, kappa=0.3, omega=1.4, preload=0.1) | {"x0": 1.0}
    flow = flow_of(GearMesh(), values, drive=Harmonic(0.5, 0.7), start=[0.1, 0.0])
    found = LyapunovMax(periods=300, transient=100).estimate(flow, rng=RNG)
    assert found.status == "ok", found.says
    assert flow.strobe(flow.start, periods=20, tangents=1).status == "ok"
