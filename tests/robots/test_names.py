"""Joint and physics are named, from recordings of an integrator that shares no code with the framework."""

from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest

from lostmotion.evidence.probabilities import compute_probabilities
from lostmotion.robots.arm_preparation import SearchOptions, make_arm, prepare_search
from lostmotion.robots.arm_search import find_probabilities
from lostmotion.robots.promises import _gain_in_one_step
from lostmotion_trials.integrators.arm import Arm

NAMES = ("coulomb_friction", "stribeck_friction", "viscous_damping", "cogging", "excitation_delay", "offset_force")


def lead(search):
    return max(find_probabilities(search).items(), key=lambda pair: pair[1])


def test_friction_at_the_elbow(search_of, helpers):
    search = search_of(helpers.record(Arm(friction=np.array([0.0, 0.3]))), NAMES)
    key, share = lead(search)
    assert (key, share > 0.95) == ("coulomb_friction@elbow", True)
    assert search.best.values["coulomb_friction@elbow.force"] == pytest.approx(0.3, rel=0.03)


def test_play_in_the_gear_of_the_shoulder(search_of, helpers):
    machine = Arm(play=np.array([1e-3, -1.0]), stiffness=np.array([6e4, 5e4]), loss=np.array([30.0, 10.0]))
    search = search_of(helpers.record(machine), NAMES)
    key, share = lead(search)
    assert (key, share > 0.95) == ("backlash@shoulder.gear", True)
    assert search.best.values["backlash@shoulder.gear.gap"] == pytest.approx(1e-3, rel=0.05)


def test_a_gear_is_not_refused_for_what_fitted_values_undo(helpers, terms):
    """A constant torque that the fit knows costs 20 nats as it is, and nothing after one step."""
    simulator = helpers.make_simulator()
    arm = make_arm(simulator, helpers.record(Arm(), samples=1500))
    search, start = prepare_search(arm, simulator, terms, {}, SearchOptions(asked=("coulomb_friction",)))
    search.weigh((), [start])
    nominal = search.found[frozenset()]
    names = [c.name for c in nominal.frame.discrepancy.columns]
    place = len(nominal.frame.own) + names.index("elbow.zero")
    at = nominal.at.copy()
    at[place] += 7.0 / np.sqrt(nominal.expansion.information[place, place])
    seen = nominal.frame.run(at).seen
    assert seen.log_likelihood < nominal.expansion.here.log_likelihood - 20.0
    assert abs(_gain_in_one_step(nominal, seen)) < 1.0
    # Errors that nothing explains promise nothing: in one step of noise levels, any gain was predicted.
    assert _gain_in_one_step(nominal, replace(seen, errors=30.0 * seen.errors)) < -1000.0


def test_friction_with_a_soft_onset_at_the_elbow(search_of, helpers):
    """Without its law, ripple of the friction and a flexible gear were named, or a friction of two directions."""
    machine = Arm(friction=np.array([0.0, 0.3]), onset=np.array([2e-4, 0.05]))
    search = search_of(helpers.record(machine), (*NAMES, "directional_friction", "position_dependent_friction"))
    assert search.best.terms == {"soft_friction@elbow"}
    assert lead(search)[1] > 0.95
    assert search.best.values["soft_friction@elbow.force"] == pytest.approx(0.3, rel=0.03)
    assert search.best.values["soft_friction@elbow.velocity"] == pytest.approx(0.05, rel=0.1)


def test_a_sharp_resonance_of_a_gear_is_found(helpers, terms):
    """Its motor is hardly damped: starts at 5 and 39 kN m/rad alone did not reach 2 kN m/rad, which gains 370 nats."""
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    from lostmotion_plugins.simulators.mujoco import MujocoSimulator

    machine = Arm(play=np.array([-1.0, 0.0]), stiffness=np.array([5e4, 2e3]), loss=np.array([20.0, 0.2]))
    simulator, name = MujocoSimulator(), "joint_elasticity@elbow.gear"
    arm = make_arm(simulator, helpers.record(machine, seed=11, samples=5000))
    search, start = prepare_search(arm, simulator, terms, {}, SearchOptions(asked=(name,), most=1))
    search.run(start)
    assert search.best.terms == {name}
    assert search.best.values[f"{name}.stiffness"] == pytest.approx(2e3, rel=0.03)


def test_nothing_is_named_where_nothing_is_hidden(search_of, helpers):
    search = search_of(helpers.record(Arm(), seed=4), NAMES)
    key, share = lead(search)
    assert (key, share > 0.9) == ("nothing_missing", True)
    assert sum(compute_probabilities(search.found.values(), search.temper).values()) == pytest.approx(1.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("machine", "key"),
    [
        (Arm(damping=np.array([0.9, 0.3])), "viscous_damping@shoulder"),
        (Arm(ripple=np.array([0.0, 0.15]), order=np.array([60.0, 80.0])), "cogging@elbow"),
        (Arm(delay=np.array([0.0, 0.006])), "excitation_delay@elbow.torque"),
        (Arm(offset=np.array([0.6, 0.0])), "offset_force@shoulder"),
    ],
)
def test_other_effects(search_of, helpers, machine, key):
    assert lead(search_of(helpers.record(machine), NAMES))[0] == key


@pytest.mark.slow
def test_wrong_centres_of_mass_are_no_missing_physics(helpers, terms):
    """The centres are wrong by 10 %, known within 5 %; without their freedom a payload is named."""
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    from lostmotion_plugins.simulators.mujoco import MujocoSimulator

    class Sure(MujocoSimulator):
        """The same arm, whose centres of mass and moments of inertia are known exactly."""

        inertial: ClassVar = {}

    log = helpers.record(Arm(centre=np.array([0.22, 0.165])), seed=1)
    kept, found = [t for t in terms if t.name in (*NAMES, "linear_stiffness")], []
    for simulator in (MujocoSimulator(), Sure()):
        search, start = prepare_search(
            make_arm(simulator, log), simulator, kept, {}, SearchOptions(tolerance=0.05, most=2)
        )
        found.append(lead(search.run(start)))
    assert found[0][0] == "nothing_missing"
    assert found[1][0] == "payload@tip"
    assert found[1][1] > 0.95
