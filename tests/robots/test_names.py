"""Joint and physics are named, from recordings of an integrator that shares no code with the framework."""

import numpy as np
import pytest

from lostmotion.evidence.search import compute_probabilities
from lostmotion.robots.arm_search import find_probabilities
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
