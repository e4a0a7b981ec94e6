"""Exponents of models against known answers, a slow twin, an analytic Jacobian and a saltation matrix."""

import math
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import lfilter

from lostmotion.contracts import Interface, Model, Orbit, Param
from lostmotion.likelihood.system import System
from lostmotion.quantities import NUMBER
from lostmotion_chaos.flows.flow import SteppedFlow, flow_of, make_stepped_flow
from lostmotion_chaos.quantifiers.flows import KaplanYorke, LyapunovMax, LyapunovSpectrum
from lostmotion_chaos.rates import exponent_in
from lostmotion_plugins.models.basic import LinearOscillator
from lostmotion_plugins.models.joint import RobotJoint
from lostmotion_plugins.models.lin import LinBacklash, ground
from lostmotion_plugins.terms.elastic import CubicStiffness
from lostmotion_plugins.terms.friction import CoulombFriction, StribeckFriction
from lostmotion_plugins.terms.memory import DahlFriction

CASE_1 = {"m": 1.0, "c": 8.0, "k1": 0.0, "k0": 4e4, "x0": 0.005}
START = np.array([0.001, 0.1])


class Autonomous(Model):
    """Three first-order equations that nothing drives."""

    motion = "translation"
    states = ("x", "y", "z")
    inputs = ("force",)
    channels = ("x",)
    interfaces = (Interface("ground", row=0, inertia="one", motion=ground),)

    @staticmethod
    def observe(t, y, dydt, u, p, seen):
        seen[0] = y[0]


def named(*names):
    return tuple(Param(name, name, NUMBER) for name in ("one", *names))


@dataclass(frozen=True)
class Lorenz(Autonomous):
    name: ClassVar[str] = "lorenz"
    paper: ClassVar[str] = "Lorenz, J. Atmospheric Sciences 20 (1963) 130-141"
    params = named("sigma", "rho", "beta")

    @staticmethod
    def rhs(t, y, u, p, dydt):
        dydt[0] = p[1] * (y[1] - y[0])
        dydt[1] = y[0] * (p[2] - y[2]) - y[1]
        dydt[2] = y[0] * y[1] - p[3] * y[2]


@dataclass(frozen=True)
class Roessler(Autonomous):
    name: ClassVar[str] = "roessler"
    paper: ClassVar[str] = "Roessler, Physics Letters A 57 (1976) 397-398"
    params = named("a", "b", "c")

    @staticmethod
    def rhs(t, y, u, p, dydt):
        dydt[0] = -y[1] - y[2]
        dydt[1] = y[0] + p[1] * y[1]
        dydt[2] = p[2] + y[2] * (y[0] - p[3])


def lin(amplitude=100.0, **options):
    return make_stepped_flow(System.of(LinBacklash()), CASE_1, drive=(amplitude, 40.0), start=START, **options)


def lorenz(period=0.5):
    start = np.array([1.0, 1.0, 20.0])
    return make_stepped_flow(
        System.of(Lorenz()), {"sigma": 10.0, "rho": 28.0, "beta": 8.0 / 3.0}, drive=period, start=start
    )


def roessler():
    return make_stepped_flow(
        System.of(Roessler()), {"a": 0.2, "b": 0.2, "c": 5.7}, drive=6.0, start=np.array([1.0, 1.0, 0.0])
    )


def ueda():
    system = System.of(LinearOscillator() + CubicStiffness())
    values = {"m": 1.0, "c": 0.05, "k": 0.0, "cubic_stiffness.coefficient": 1.0}
    return make_stepped_flow(system, values, drive=(7.5, 1.0), start=np.array([2.5, 0.0]))


KNOWN = {
    "lorenz": (lorenz, (0.9056, 0.0, -14.5723), 2.06215, 2500),
    "roessler": (roessler, (0.0714, 0.0, -5.3943), 2.0132, 1200),
    "ueda": (ueda, (0.1034, -0.1534), 2.6741, 2500),
}
"""Exponents (1/s) and Kaplan-Yorke dimensions: Sprott, Chaos and Time-Series Analysis (Oxford, 2003), appendix A."""


@pytest.mark.slow
@pytest.mark.parametrize("name", KNOWN)
def test_spectrum_and_dimension_are_the_known_ones(name):
    """Five standard errors, and what Sprott's last digits leave open."""
    make, exponents, dimension, periods = KNOWN[name]
    flow = make()
    found = LyapunovSpectrum(periods=periods).estimate(flow, rng=np.random.default_rng(0))
    assert found.status == "ok", found.says
    spectrum, stderr = found.curve["spectrum"], found.curve["stderr"]
    assert np.abs(spectrum - exponents) == pytest.approx(0.0, abs=1e-4 * abs(exponents[-1]) + 5.0 * stderr.max())
    assert found.details["sum"] == pytest.approx(sum(exponents), rel=5e-3)
    assert found.low <= found.value <= found.high
    measured = KaplanYorke(periods=periods).estimate(flow, rng=np.random.default_rng(0))
    assert measured.value == pytest.approx(dimension, abs=0.02 if name == "ueda" else 0.003)
    assert measured.low <= measured.value <= measured.high
    assert measured.details["section"] == pytest.approx(measured.value - 1.0)


def test_case_1_is_as_chaotic_as_known():
    """7.27 +- 0.03 1/s and a sum of -c/m: the exact piecewise solution over 20 000 periods (reference of the issue).

    In the units of Fig. 6 of Tjahjowidodo et al. (2007) that is 0.052 bit per normalised time.
    """
    found = LyapunovSpectrum(periods=4000).estimate(lin(), rng=np.random.default_rng(0))
    assert found.status == "ok"
    assert found.value == pytest.approx(7.27, abs=4.0 * math.hypot(found.details["stderr"], 0.03))
    assert found.details["sum"] == pytest.approx(-8.0, abs=1e-3)
    assert exponent_in(found, "bit/period", period=1.0 / 200.0).value == pytest.approx(0.052, abs=0.001)
    measured = KaplanYorke(periods=4000).estimate(lin(), rng=np.random.default_rng(0))
    assert measured.value == 1.0 + measured.details["section"] == pytest.approx(2.476, abs=0.01)


def test_case_1_at_2_6_is_periodic():
    found = LyapunovMax().estimate(lin(200.0 / 2.6), rng=np.random.default_rng(0))
    assert found.value == pytest.approx(-4.0, abs=0.1)
    assert KaplanYorke().estimate(lin(200.0 / 2.6), rng=np.random.default_rng(0)).value == pytest.approx(1.0)


def test_linear_oscillator_shrinks_by_its_damping():
    """Both exponents are -zeta omega_0 = -c / 2m: Floquet exponents of a linear system."""
    flow = make_stepped_flow(System.of(LinearOscillator()), {"m": 2.0, "c": 0.3, "k": 5.0}, drive=(1.0, 1.3))
    found = LyapunovSpectrum(periods=4000).estimate(flow, rng=np.random.default_rng(0))
    assert found.curve["spectrum"] == pytest.approx([-0.075, -0.075], abs=1e-4)
    assert found.details["sum"] == pytest.approx(-0.15, rel=1e-6)
    assert KaplanYorke().estimate(flow, rng=np.random.default_rng(0)).value == pytest.approx(1.0)


@pytest.mark.parametrize("periods", [200, 2000])
@pytest.mark.slow
def test_intervals_cover(periods):
    """100 orbits of Case 1, solved exactly: the 95 % interval misses 7.235 at most 12 times (binomial: 1 in 1000)."""
    rng, misses = np.random.default_rng(3), np.zeros(2)
    for _ in range(100):
        begun = flow_of(LinBacklash(), CASE_1, drive=(100.0, 40.0), start=START * rng.normal(size=2) * 3.0)
        found = LyapunovMax(periods=periods).estimate(begun, rng=rng), KaplanYorke(periods).estimate(begun, rng=rng)
        misses += [not e.low <= true <= e.high for e, true in zip(found, (7.235, 2.0 + 7.235 / 15.235), strict=True)]
    assert misses.max() <= 12


@dataclass(frozen=True)
class Told:
    """A flow whose growth is told: one exponent, 0.5 s between looks."""

    rates: np.ndarray
    period: float = 0.5
    driven: bool = True
    states: tuple[str, ...] = ("x",)
    start: np.ndarray = field(default_factory=lambda: np.zeros(1))

    def strobe(self, start, *, periods, tangents):
        return Orbit(np.zeros((periods + 1, 1)), 0.5 * self.rates[:periods, None])


def red(rng, n, memory):
    """Return autoregressive noise (n,) of mean zero and variance one."""
    return lfilter([math.sqrt(1.0 - memory**2)], [1.0, -memory], rng.normal(size=n + 200))[200:]


@pytest.mark.parametrize("memory", [-0.7, 0.0, 0.8])
def test_error_and_transient_are_judged_as_stated(memory):
    """200 settled series: the interval misses in 5 %, the alarm goes off in 1 % (bounds: binomial, below 1 in 1000)."""
    rng = np.random.default_rng(5)
    found = [LyapunovMax(800, 0).estimate(Told(red(rng, 800, memory)), rng=rng) for _ in range(200)]
    assert sum(e.status == "uncertain" for e in found) <= 8
    assert sum(not e.low <= 0.0 <= e.high for e in found) <= 21


@pytest.mark.parametrize("share", [0.15, 0.4, 0.85])
def test_a_transient_that_lasts_is_uncertain(share):
    """Chaos that ends in a periodic motion, early or late in what was looked at."""
    rng = np.random.default_rng(1)
    settled = np.arange(800) > share * 800
    rates = np.where(settled, -3.0 + np.sin(np.arange(800)), 7.0 + 6.0 * red(rng, 800, 0.5))
    found = LyapunovMax(800, 0).estimate(Told(rates), rng=rng)
    assert found.status == "uncertain"
    assert "not settled" in found.says


BASE = {"m": 1.0, "c": 2.0, "k0": 4e3, "x0": 0.02, "mgl": 3.0}
TWINS = {
    "lin": (LinBacklash(), CASE_1, (100.0, 40.0)),
    "joint": (RobotJoint() + CoulombFriction("base"), {**BASE, "coulomb_friction@base.force": 0.5}, (0.05, 9.7)),
    "dahl": (
        LinBacklash() + DahlFriction(),
        {**CASE_1, "dahl_friction.force": 3.0, "dahl_friction.deflection": 1e-4},
        (100.0, 40.0),
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", TWINS)
def test_strobe_equals_its_slow_twin(name):
    machine, values, drive = TWINS[name]
    fast = make_stepped_flow(System.of(machine), values, drive=drive, steps=300)
    slow = SteppedFlow(fast.system, fast.full, fast.beat, fast.period, fast.start, 300, fast.scale, compiled=False)
    one, other = (f.strobe(fast.start + 1e-3, periods=3, tangents=len(f.states)) for f in (fast, slow))
    assert one.status == other.status == "ok"
    np.testing.assert_allclose(one.states, other.states, rtol=1e-10, atol=1e-14)
    np.testing.assert_allclose(one.growth, other.growth, rtol=1e-7, atol=1e-8)


def test_tangents_equal_those_of_an_analytic_jacobian():
    """Lorenz with its Jacobian by scipy (DOP853, 1e-12) over one look; RK4's own error is part of the tolerance."""
    flow = lorenz(period=0.4)
    y0 = np.array([-4.0, -6.0, 22.0])

    def rates(t, z):
        x, y, w = z[:3]
        jacobian = np.array([[-10.0, 10.0, 0.0], [28.0 - w, -1.0, -x], [y, x, -8.0 / 3.0]])
        field = [10.0 * (y - x), x * (28.0 - w) - y, x * y - 8.0 / 3.0 * w]
        return np.concatenate([field, (jacobian @ z[3:].reshape(3, 3)).ravel()])

    solved = solve_ivp(rates, (0.0, 0.4), np.concatenate([y0, np.eye(3).ravel()]), "DOP853", rtol=1e-12, atol=1e-12)
    orbit = flow.strobe(y0, periods=1, tangents=3)
    np.testing.assert_allclose(orbit.states[1], solved.y[:3, -1], rtol=1e-6)
    volume = np.log(abs(np.linalg.det(solved.y[3:, -1].reshape(3, 3))))
    assert orbit.growth.sum() == pytest.approx(volume, rel=1e-6)
    assert volume == pytest.approx(-0.4 * (10.0 + 1.0 + 8.0 / 3.0), rel=1e-6)


SLIDING = {"m": 1.0, "c": 0.1, "k": 1.0}


def reversals(force, amplitude, omega, periods):
    """Return the monodromy (2, 2) of the last of some periods, with the saltation diag(1, a+/a-) at each reversal.

    Leine, Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems (2004), section 4.2.
    """
    period = 2.0 * math.pi / omega
    state, monodromy = np.array([1.0, 0.0]), np.eye(2)
    sign, t = -1.0, 0.0

    def push(t, y, s):
        return amplitude * math.cos(omega * t) - SLIDING["c"] * y[1] - SLIDING["k"] * y[0] - s * force

    def rates(t, z, s):
        m = z[2:].reshape(2, 2)
        return np.concatenate([[z[1], push(t, z, s)], (np.array([[0.0, 1.0], [-1.0, -0.1]]) @ m).ravel()])

    def reversal(t, z, s):
        return z[1] if t > began + 1e-6 else s

    reversal.terminal = True
    for _ in range(periods):
        end, monodromy = t + period, np.eye(2)
        while t < end - 1e-12:
            began = t
            part = solve_ivp(
                rates, (t, end), np.concatenate([state, monodromy.ravel()]), "DOP853", events=reversal, args=(sign,),
                rtol=1e-11, atol=1e-12, max_step=0.05,
            )  # fmt: skip
            t, state, monodromy = part.t[-1], part.y[:2, -1], part.y[2:, -1].reshape(2, 2)
            if len(part.t_events[0]):
                before, after = push(t, state, sign), push(t, state, -sign)
                assert before * after > 0.0
                monodromy = np.diag([1.0, after / before]) @ monodromy
                sign = -sign
    return monodromy, period


def test_dry_friction_has_the_exponents_of_its_saltation():
    """A body that slides to and fro and does not stick. Without the saltation the sum would be -0.1."""
    force, amplitude, omega = 0.3, 2.0, 0.7
    monodromy, period = reversals(force, amplitude, omega, 12)
    wanted = np.sort(np.log(np.abs(np.linalg.eigvals(monodromy))) / period)[::-1]
    system = System.of(LinearOscillator() + CoulombFriction())
    values = {**SLIDING, "coulomb_friction.force": force}
    for steps in (1000, 8000):
        flow = make_stepped_flow(system, values, drive=(amplitude, omega), start=np.array([1.0, 0.0]), steps=steps)
        found = LyapunovSpectrum(periods=400, transient=50).estimate(flow, rng=np.random.default_rng(0))
        assert found.curve["spectrum"] == pytest.approx(wanted, rel=0.01)
    assert wanted.sum() < -0.1 - 0.05


@pytest.mark.parametrize("term", [CoulombFriction(), StribeckFriction()])
def test_a_body_that_sticks_forgets_where_it_came_from(term):
    """One direction is lost: it shrinks by a factor of e every eight steps of sticking."""
    own = {f"{term.name}.{q.name}": v for q, v in zip(term.params, (3.0, 1.0, 0.1), strict=False)}
    system = System.of(LinearOscillator() + term)
    flow = make_stepped_flow(system, {**SLIDING, **own}, drive=(4.2, 0.25))
    orbit = flow.strobe(flow.start, periods=60, tangents=2)
    assert orbit.status == "ok"
    assert orbit.growth[20:, 1].max() < -25.0
