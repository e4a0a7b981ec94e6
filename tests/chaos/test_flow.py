"""The flow of a model: what may be asked of it, and what it says of what it cannot do."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from lostmotion.errors import ContractError, DataError
from lostmotion.likelihood.system import System
from lostmotion.results import Estimate
from lostmotion_chaos.flows.flow import FEWEST, Harmonic, flow_of, make_stepped_flow
from lostmotion_chaos.quantifiers.flows import KaplanYorke, LyapunovMax, LyapunovSpectrum
from lostmotion_chaos.rates import UNITS, exponent_in
from lostmotion_plugins.models.basic import LinearOscillator
from lostmotion_plugins.models.joint import RobotJoint
from lostmotion_plugins.terms.contact import ContactDamping
from lostmotion_plugins.terms.elastic import CubicStiffness
from lostmotion_plugins.terms.friction import CoulombFriction
from lostmotion_plugins.terms.memory import DahlFriction

SOFT = {"m": 1.0, "c": 0.1, "k": 1.0}
JOINT = {"m": 1.0, "c": 2.0, "k0": 4e3, "x0": 0.02, "mgl": 3.0}
RNG = np.random.default_rng(0)


def soft(**options):
    return make_stepped_flow(System.of(LinearOscillator()), SOFT, drive=(1.0, 1.3), **options)


def test_looks_of_a_linear_oscillator_are_its_closed_form():
    flow = soft(steps=400)
    seen = flow.sample(np.zeros(2), periods=60, looks=8)
    t = np.arange(len(seen)) * flow.period / 8
    steady = (1.0 / (1.0 - 1.3**2 + 0.13j) * np.exp(1.3j * t)).real
    np.testing.assert_allclose(seen[-80:, 0], steady[-80:], atol=2e-5)
    np.testing.assert_array_equal(seen[::8], flow.strobe(np.zeros(2), periods=60, tangents=0).states)


def test_a_base_motion_carries_its_velocity():
    """A stiff joint without gravity follows its base; `base_velocity` must be the slope of `base_position`."""
    flow = flow_of(RobotJoint(), {**JOINT, "x0": 0.0, "mgl": 0.0}, drive=Harmonic(0.05, 3.0, 0.4))
    states = flow.strobe(flow.start, periods=40, tangents=0).states
    np.testing.assert_allclose(states[-1], [0.05 * math.cos(0.4), -0.15 * math.sin(0.4)], atol=1e-3)


def test_states_of_terms_are_states_of_the_flow():
    values = {**SOFT, "dahl_friction.force": 0.1, "dahl_friction.deflection": 0.01}
    flow = flow_of(LinearOscillator() + DahlFriction(), values, drive=(1.0, 1.3))
    assert flow.states == ("position", "velocity", "dahl_friction.bristle_force")
    orbit = flow.strobe(flow.start, periods=50, tangents=3)
    assert orbit.status == "ok"
    assert orbit.states.shape == (51, 3)
    assert orbit.growth.shape == (50, 3)


def test_the_step_follows_the_fastest_rate():
    slow, fast = (
        make_stepped_flow(System.of(LinearOscillator()), {**SOFT, "k": k}, drive=(1.0, 1.3)).steps for k in (1.0, 1e4)
    )
    assert slow == pytest.approx(2.0 * math.pi / 1.3 / 0.04, rel=0.01)
    assert fast == pytest.approx(100.0 * slow, rel=0.01)
    assert soft(steps=FEWEST).steps == FEWEST


def test_a_motion_that_runs_away_says_so():
    machine = LinearOscillator() + CubicStiffness()
    values = {**SOFT, "cubic_stiffness.coefficient": -1.0}
    flow = flow_of(machine, values, drive=(0.1, 1.3), start=np.array([2.0, 0.0]))
    orbit = flow.strobe(flow.start, periods=50, tangents=2)
    assert orbit.status == "diverged"
    assert np.isnan(orbit.states[-1]).all()
    assert np.isnan(orbit.growth[-1]).all()
    for quantifier in (LyapunovMax(), LyapunovSpectrum(), KaplanYorke()):
        estimate = quantifier.estimate(flow, rng=RNG)
        assert estimate.status == "diverged"
        assert "diverges" in estimate.says


@pytest.mark.slow
def test_a_force_that_jumps_in_position_says_so():
    values = {"m": 1.0, "c": 2.0, "k0": 4e3, "x0": 0.02, "mgl": 3.0, "contact_damping@base.coefficient": 5.0}
    flow = flow_of(RobotJoint() + ContactDamping("base"), values, drive=(0.05, 9.7))
    assert flow.strobe(flow.start, periods=50, tangents=2).status == "jumps"
    estimate = LyapunovMax().estimate(flow, rng=RNG)
    assert estimate.status == "jumps"
    assert math.isnan(estimate.value)
    assert len(estimate.curve["running"]) > 10


@pytest.mark.parametrize(
    "values",
    [
        {"coulomb_friction@base.force": 20.0},
        pytest.param({"coulomb_friction@base.force": 0.5}, marks=pytest.mark.slow),
    ],
)
def test_dry_friction_of_ours_is_resolved_by_the_step(values):
    flow = flow_of(RobotJoint() + CoulombFriction("base"), {**JOINT, **values}, drive=(0.05, 9.7))
    assert flow.strobe(flow.start, periods=200, tangents=2).status == "ok"


@dataclass(frozen=True)
class VanDerPol(LinearOscillator):
    """A limit cycle that nothing drives: x'' + x = m (1 - x^2) x'."""

    @staticmethod
    def rhs(t, y, u, p, dydt):
        dydt[0] = y[1]
        dydt[1] = p[0] * (1.0 - y[0] * y[0]) * y[1] - y[0]


@pytest.mark.slow
@pytest.mark.parametrize("period", [1.0, 6.6632868593231301, 20.0])
def test_a_limit_cycle_has_the_dimension_one(period):
    """Looks that keep step with the cycle (6.6633 s) or not; the other exponent is -1.0594 (by Floquet, scipy)."""
    flow = flow_of(VanDerPol(), SOFT, drive=period, start=np.array([1.0, 0.0]))
    assert not flow.driven
    found = LyapunovSpectrum().estimate(flow, rng=RNG)
    assert found.status == "ok", found.says
    assert found.curve["spectrum"] == pytest.approx([0.0, -1.0594], abs=1e-3)
    assert found.low <= 0.0 <= found.high
    measured = KaplanYorke().estimate(flow, rng=RNG)
    assert measured.value == pytest.approx(1.0, abs=1e-3)
    assert measured.low <= 1.0 <= measured.high


def test_rest_and_nonsense_are_answered():
    still = make_stepped_flow(System.of(LinearOscillator()), SOFT, drive=2.0)
    assert LyapunovMax(periods=200).estimate(still, rng=RNG).value == pytest.approx(-0.05, abs=1e-3)
    assert LyapunovMax(periods=10).estimate(still, rng=RNG).status == "too_short"
    for wrong in (-1.0, 0.0, math.inf, (1.0, 0.0)):
        with pytest.raises(ContractError, match="above zero"):
            flow_of(LinearOscillator(), SOFT, drive=wrong)
    for bad in (math.nan, -1.0):
        with pytest.raises(
            ContractError, match=r"c \(viscous friction\) is .*: expected a finite number from 0 to inf"
        ):
            flow_of(LinearOscillator(), {**SOFT, "c": bad}, drive=2.0)
    with pytest.raises(ContractError, match=r"m .* above 0 kg"):
        flow_of(LinearOscillator(), {**SOFT, "m": 0.0}, drive=2.0)
    with pytest.raises(ContractError, match=r"lacks k \(stiffness, N/m\)"):
        flow_of(LinearOscillator(), {"m": 1.0, "c": 1.0}, drive=2.0)
    with pytest.raises(ContractError, match="up to 2 finite numbers"):
        flow_of(LinearOscillator(), SOFT, drive=2.0, start=np.zeros(3))
    with pytest.raises(ContractError, match="shape"):
        still.strobe(np.zeros(3), periods=5, tangents=1)


def test_exponents_change_their_unit_and_nothing_else():
    e = Estimate(7.27, 7.2, 7.3, "ok", "1/s", {"spectrum": np.array([7.27, -15.27])})
    assert exponent_in(e, "bit/s").value == pytest.approx(7.27 / math.log(2.0))
    assert exponent_in(e, "1/period", period=2.0 * math.pi / 40.0).value == pytest.approx(1.142, abs=1e-3)
    normalised = exponent_in(e, "bit/period", period=1.0 / 200.0)
    assert normalised.value == pytest.approx(0.0524, abs=1e-4)
    assert normalised.low == pytest.approx(7.2 / 200.0 / math.log(2.0))
    assert normalised.curve is e.curve
    assert exponent_in(e, "1/s") == e
    assert "base 2" in UNITS["bit/s"]
    for unit, period, match in (("nat/s", 1.0, "no unit"), ("1/period", math.nan, "needs a period")):
        with pytest.raises(DataError, match=match):
            exponent_in(e, unit, period=period)
    with pytest.raises(DataError, match="only one in"):
        exponent_in(normalised, "1/s")
