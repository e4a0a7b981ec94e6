"""Laws with an inner state: bristles at a joint, and hysteresis between motor and link."""

from dataclasses import replace

import numpy as np
import pytest

from lostmotion.kernels.inner_states import FORCE, RATE, follow_law
from lostmotion.kernels.joint_laws import FEW, FEW_SHARES, MANY, MANY_SHARES
from lostmotion.likelihood.compose import compile_law
from lostmotion.robots.arm import Column, make_law
from lostmotion.robots.arm_preparation import SearchOptions, prepare_search
from lostmotion.robots.arm_search import SMALL, ProposedFit, find_probabilities
from lostmotion.robots.gears import Gear
from lostmotion.robots.promises import SAME_LAW, ArmPromise, list_gear_promises
from lostmotion_plugins.terms.memory import BoucWenHysteresis, DahlFriction
from lostmotion_trials.integrators.arm import Arm

LEVELS = (np.array([0.1, 0.03]) ** 2 * 0.002, np.array([3e-5, 3e-5]) ** 2)
TRUE = {"dahl_friction@elbow.force": 0.5, "dahl_friction@elbow.deflection": 0.01}
BRISTLES = Arm(bristles=np.array([0.0, 0.5]), travel=np.array([1e-3, 0.01]))
LOOP = Arm(
    play=np.array([-1.0, 0.0]), stiffness=np.array([5e4, 300.0]), loss=np.array([20.0, 1.0]),
    bristles=np.array([0.0, 1.0]), travel=np.array([1e-3, 3e-3]), within=np.array([0.0, 1.0]),
)  # fmt: skip


@pytest.fixture(scope="module")
def bristled(helpers):
    return helpers.make_arm(helpers.make_simulator(), helpers.record(BRISTLES))


def plain_follow(term, numbers, x, cov, move, ends, row, push, hs):
    """Return state, covariance and transition after a law has acted, by matrices and calls of the term."""
    b, c, s, b2, c2 = ends
    see = np.zeros((3, len(x)))
    see[[0, 1, 2], [b, c, s]] = 1.0
    if b2 >= 0:
        see[[0, 1], [b2, c2]] = -1.0

    def tell(q, v, z):
        found = np.zeros(1)
        term.rate(0.0, q, v, found, numbers, (z,), found)
        return found[0] if row == RATE else term.force(0.0, q, v, found, numbers, (z,))

    q, v, z = see @ x
    q -= 0.5 * hs * v
    sq, sv, sz = np.sqrt(np.diag(see @ cov @ see.T))
    near = abs(v) < 6.0 * sv + 1e-9
    nodes, shares = (MANY, MANY_SHARES) if near else (FEW, FEW_SHARES)
    told = np.array([tell(q, v + sv * node, z) for node in nodes])
    slopes = np.array([
        (tell(q + sq, v, z) - tell(q - sq, v, z)) / (2.0 * sq),
        shares @ (nodes * told) / sv,
        (tell(q, v, z + sz) - tell(q, v, z - sz)) / (2.0 * sz),
    ])  # fmt: skip
    left = max(shares @ told**2 - (shares @ told) ** 2 - (slopes[1] * sv) ** 2, 0.0)
    step = np.eye(len(x)) + np.outer(push, slopes @ see)
    return x + push * (shares @ told), step @ cov @ step.T + left * np.outer(push, push), step @ move


@pytest.mark.parametrize("row", [RATE, FORCE])
@pytest.mark.parametrize("ends", [(1, 3, 6, -1, -1), (4, 5, 6, 1, 3)])
@pytest.mark.parametrize("speed", [0.0, 0.003, 0.4])
def test_the_kernel_is_its_slow_twin(ends, speed, row):
    rng = np.random.default_rng(0)
    term, hs, size = BoucWenHysteresis(at="elbow.gear"), 5e-4, 7
    x, root = rng.normal(0.0, 0.02, size), 1e-3 * rng.standard_normal((size, size))
    x[ends[1]] = speed
    cov, push, move = root @ root.T, rng.normal(0.0, hs, size), np.eye(size)
    law, values = make_law(term), np.array([0.8, 2e-3, 0.0])
    table = np.array([compile_law(law, 0)[0]]), np.array([0]), np.array([3]), np.array([0, 0, 2]), values
    found, pushes = [x.copy(), cov.copy(), move.copy()], np.zeros((size, 4))
    desks = np.zeros((16, 32)), np.zeros((8, 32)), np.zeros((2, size))
    follow_law(0.0, *found, pushes, True, np.array(ends), row, push, hs, 0, table, *desks)
    wanted = plain_follow(term, (0.8, 2e-3, hs), x, cov, move, ends, row, push, hs)
    for one, other in zip(found, wanted, strict=True):
        assert np.abs(one - other).max() < 1e-12 * max(1.0, np.abs(other).max())


def test_bristles_are_most_likely_at_their_true_values(bristled):
    term = DahlFriction(at="elbow")
    told = {}
    for force, deflection in ((0.5, 0.01), (0.45, 0.01), (0.55, 0.01), (0.5, 0.008), (0.5, 0.012), (0.5, 0.001)):
        values = dict(zip(TRUE, (force, deflection), strict=True))
        told[force, deflection] = bristled.filter(values, (term,), LEVELS).seen.log_likelihood
    assert max(told, key=told.get) == (0.5, 0.01)


def test_derivatives_over_forces_hold_beside_bristles(bristled):
    """The law bends with the motion, so that differences are those of its slopes within a few parts in a thousand."""
    wave, term = np.sin(0.05 * np.arange(bristled.log.samples)), (DahlFriction(at="elbow"),)
    kept = bristled.filter(TRUE, term, LEVELS, last=1500, keep=True)
    row = bristled.differentiate(kept, [Column("one", 1, wave)], {})[0]
    force = np.stack([0.0 * wave, wave], axis=1)
    ends = [bristled.filter(TRUE, term, LEVELS, last=1500, force=s * force).seen.errors for s in (1e-3, -1e-3)]
    difference = ((ends[0] - ends[1]) / 2e-3).ravel()
    assert np.abs(row - difference).max() < 5e-3 * np.abs(difference).max()


def test_stiff_bristles_take_more_steps(bristled):
    assert bristled.count_steps({}, {1: 1e2}) == 1
    assert bristled.count_steps({}, {1: 1e6}) > 4
    stiff = {**TRUE, "dahl_friction@elbow.deflection": 2e-6}
    assert np.isfinite(bristled.filter(stiff, (DahlFriction(at="elbow"),), LEVELS).seen.log_likelihood)


def test_bristles_are_named_and_not_the_dry_friction_that_they_contain(search_of, helpers):
    """Beside dry friction alone, a search ended with damping and a larger moment of inertia."""
    machine = replace(BRISTLES, bristles=np.array([0.0, 0.3]), travel=np.array([1e-3, 0.002]))
    kinds = {"coulomb_friction", "dahl_friction", "viscous_damping", "soft_friction"}
    found = search_of(helpers.record(machine, 3), kinds)
    assert find_probabilities(found)["dahl_friction@elbow"] > 0.95
    values = found.best.values
    assert values["dahl_friction@elbow.force"] == pytest.approx(0.3, rel=0.03)
    assert values["dahl_friction@elbow.deflection"] == pytest.approx(0.002, rel=0.1)


def test_hysteresis_in_a_flexible_gear_is_told_from_the_gear_alone(helpers, registry):
    arm, law = helpers.make_arm(helpers.make_simulator(), helpers.record(LOOP, 3, 5000)), "bouc_wen_hysteresis"
    search, start = prepare_search(arm, helpers.make_simulator(), [registry.make("term", law)], {}, SearchOptions())
    search.weigh((), [start])
    gear = next(e for e in search.screen.effects if e.key == "joint_elasticity@elbow.gear")
    begin = {"joint_elasticity@elbow.gear.stiffness": 500.0, "joint_elasticity@elbow.gear.damping_ratio": 0.1}
    search._fit_all(search.best, [ProposedFit((ArmPromise(gear, begin, 0.0),), (0.0,))])
    flexible = search.found[frozenset({gear.key})]
    promise = list_gear_promises(search.screen, flexible, SMALL, search.price, search.temper)[0]
    assert promise.effect.key == f"{law}@elbow.gear"
    search._fit_all(flexible, [ProposedFit((promise,), (0.0,))])
    found = search.found[frozenset({promise.effect.key})]
    assert found.score(search.temper) > flexible.score(search.temper) + SAME_LAW
    values = {key.rpartition(".")[2]: x for key, x in found.values.items() if law in key}
    stiffness = values["stiffness"] + values["force"] / values["travel"]
    assert stiffness == pytest.approx(300.0 + 1.0 / 3e-3, rel=0.1)


def test_a_law_within_a_gear_needs_one(helpers):
    arm = helpers.make_arm(helpers.make_simulator(), helpers.record(LOOP, 0))
    values = {"bouc_wen_hysteresis@elbow.gear.force": 1.0, "bouc_wen_hysteresis@elbow.gear.travel": 3e-3}
    gear, law = {1: Gear(0.0, 300.0, 0.09)}, (BoucWenHysteresis(at="elbow.gear"),)
    with_loop = arm.filter(values, law, LEVELS, gears=gear).seen.log_likelihood
    assert with_loop > arm.filter({}, (), LEVELS, gears=gear).seen.log_likelihood + 30.0
