"""Other laws in the place of each effect of a set, which a search that adds effects does not meet."""

import numpy as np

from lostmotion.robots.arm_preparation import SearchOptions, prepare_search
from lostmotion.robots.arm_search import ProposedFit
from lostmotion.robots.promises import ArmPromise
from lostmotion_trials.integrators.arm import Arm

LAWS = ("coulomb_friction", "stribeck_friction", "excitation_delay", "actuator_lag")
WRONG = {
    "actuator_lag@elbow.torque": {"actuator_lag@elbow.torque.time_constant": 0.004},
    "stribeck_friction@shoulder": {"stribeck_friction@shoulder.force": 0.7},
}


def test_a_lag_is_swapped_for_a_delay_and_a_rich_law_for_its_simpler_form(helpers, registry):
    machine = Arm(friction=np.array([0.8, 0.0]), delay=np.array([0.0, 0.004]))
    arm = helpers.make_arm(helpers.make_simulator(), helpers.record(machine))
    terms = [registry.make("term", name) for name in LAWS]
    search, start = prepare_search(arm, helpers.make_simulator(), terms, {}, SearchOptions())
    search.weigh((), [start])
    effects = {e.key: e for e in search.screen.effects}
    wrong = tuple(ArmPromise(effects[key], values, 0.0) for key, values in WRONG.items())
    search._fit_all(search.best, [ProposedFit(wrong, (0.0,))])
    assert search.best.terms == frozenset(WRONG)
    search.drop_each(search.best)
    while search.swap_each(search.best):
        search.drop_each(search.best)
    assert search.best.terms == {"excitation_delay@elbow.torque", "coulomb_friction@shoulder"}


def test_a_set_of_one_effect_is_not_swapped(helpers, registry):
    """All laws were tried beside nothing before."""
    arm = helpers.make_arm(helpers.make_simulator(), helpers.record(Arm(), samples=1500))
    terms = [registry.make("term", "coulomb_friction")]
    search, start = prepare_search(arm, helpers.make_simulator(), terms, {}, SearchOptions())
    search.weigh((), [start])
    assert not search.swap_each(search.best)
