"""Fits within bounds: steps are optimal within them, and derivatives exist on them."""

import numpy as np
import pytest

from lostmotion.evidence.hypothesis import maximise_within
from lostmotion.robots.arm_effects import ArmCoordinate
from lostmotion.robots.arm_preparation import SearchOptions, make_arm, prepare_search
from lostmotion.robots.arm_words import find_told, list_findings
from lostmotion.robots.promises import list_promises
from lostmotion_trials.integrators.arm import Arm


def test_a_step_that_is_cut_off_leads_downhill_and_the_best_one_within_bounds_does_not():
    precision, pull = np.array([[1.0, -0.9], [-0.9, 1.0]]), np.array([1.0, -0.8])
    low, high = np.array([-0.1, -np.inf]), np.array([0.1, np.inf])

    def gain(step):
        return float(pull @ step - 0.5 * step @ precision @ step)

    free = np.linalg.solve(precision, pull)
    made = maximise_within(pull, precision, low, high)
    grid = [np.array([a, b]) for a in np.linspace(-0.1, 0.1, 21) for b in np.linspace(-2.0, 2.0, 401)]
    assert made == pytest.approx([0.1, -0.71])
    assert gain(made) >= max(map(gain, grid)) - 1e-9
    assert gain(np.clip(free, low, high)) < gain(made) - 0.1


def test_a_step_without_bounds_is_that_of_gauss_newton():
    precision, pull = np.array([[2.0, 0.5], [0.5, 1.0]]), np.array([1.0, 3.0])
    endless = np.full(2, np.inf)
    assert maximise_within(pull, precision, -endless, endless) == pytest.approx(np.linalg.solve(precision, pull))


def test_a_value_on_its_upper_bound_still_has_a_derivative(helpers):
    """A difference beyond the bound is zero, so that a fit never left the bound again."""
    simulator = helpers.make_simulator()
    arm = make_arm(simulator, helpers.record(Arm(), samples=1000))
    gradients = []
    for high in (0.3, 10.0):
        damping = ArmCoordinate("elbow.damping", 0.3, 1.0, 1.0, low=0.0, high=high)
        search, start = prepare_search(arm, simulator, [], {damping.key: damping}, SearchOptions())
        place = [c.key for c in search.frame.own].index(damping.key)
        start[place] = 1.0
        gradients.append(search.frame.expand(start)[0].gradient[place])
    assert abs(gradients[1]) > 1.0
    assert gradients[0] == pytest.approx(gradients[1], rel=0.2)


def test_a_promise_at_a_bound_is_that_of_the_bound(helpers, terms):
    """Friction is most of the torque of the elbow: a gain of zero would explain it, one of 0.4 does so less well."""
    log, simulator = helpers.record(Arm(friction=np.array([0.0, 8.0])), samples=1500), helpers.make_simulator()
    kept = [term for term in terms if term.name in ("coulomb_friction", "excitation_gain")]
    search, start = prepare_search(make_arm(simulator, log), simulator, kept, {}, SearchOptions())
    search.weigh((), [start])
    told = {p.effect.key: p for p in list_promises(search.screen, search.found[frozenset()], search.price, 1.0)}
    gain = told["excitation_gain@elbow.torque"]
    assert gain.start == {"excitation_gain@elbow.torque.error": pytest.approx(-0.6)}
    assert gain.gain < told["coulomb_friction@elbow"].gain
    assert told["inertia_change@elbow"].gain < 0.0  # the joint moves with an acceleration that friction has reduced


def test_a_gain_at_the_end_of_its_range_is_likely_at_most(helpers, search_of):
    log = helpers.record(Arm(gain=np.array([1.0, 0.2])), samples=1500)
    search = search_of(log, ("excitation_gain",), most=1)
    motions = dict.fromkeys(("shoulder", "elbow"), "rotation")
    (found,) = [m for m in list_findings(search, find_told(search), motions) if m.mechanism == "excitation_gain"]
    assert found.parameters["error"].median == pytest.approx(-0.6)
    assert found.state == "likely"
    assert "end of the range" in found.doubts[-1]


def test_a_part_of_a_law_is_not_proposed_beside_it(helpers, terms):
    """Dry friction is a part of one with a drift; that with a soft onset contains it too, and would only share it."""
    log, simulator = helpers.record(Arm(friction=np.array([0.0, 0.5])), samples=1500), helpers.make_simulator()
    kept = [term for term in terms if term.name in ("coulomb_friction", "friction_drift", "cogging")]
    search, start = prepare_search(make_arm(simulator, log), simulator, kept, {}, SearchOptions())
    (drift,) = [e for e in search.screen.effects if e.key == "friction_drift@elbow"]
    search.weigh((drift,), [search._place((drift,), dict(zip([c.key for c in search.frame.own], start, strict=False)))])
    told = {p.effect.key for p in list_promises(search.screen, search.found[frozenset({drift.key})], 0.0, 1.0)}
    assert not {"coulomb_friction@elbow", "soft_friction@elbow", "friction_drift@elbow"} & told
    assert {"coulomb_friction@shoulder", "cogging@elbow"} <= told
