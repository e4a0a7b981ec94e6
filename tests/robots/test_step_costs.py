"""What time steps cost in log-likelihood, and how much of a finding the changed model keeps."""

import numpy as np
import pytest

from lostmotion.robots.arm_case import load_robot_case
from lostmotion.robots.arm_preparation import SearchOptions, make_arm, prepare_search
from lostmotion.robots.arm_run import diagnose_robot
from lostmotion.robots.step_costs import _weigh_shift, describe_steps, measure_steps
from lostmotion_trials.arms.draw import write_case
from lostmotion_trials.integrators.arm import Arm, record_motion

pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
from lostmotion_plugins.simulators.mujoco import MujocoSimulator


@pytest.fixture(scope="module")
def nominal(helpers):
    log, simulator = helpers.record(Arm(), samples=1200), MujocoSimulator()
    found, start = prepare_search(make_arm(simulator, log), simulator, [], {}, SearchOptions())
    found.weigh((), [start])
    return found.found[frozenset()]


def test_a_finer_step_costs_less(nominal):
    costs = measure_steps(nominal, MujocoSimulator())
    assert [one.step for one in costs] == [2e-3, 5e-4]
    assert costs[0].nats > 4.0 * costs[1].nats > 0.0
    assert describe_steps(costs).startswith("Your simulation's step of 2 ms costs ")


def test_the_cost_of_a_shift_is_that_of_the_force_that_causes_it(nominal):
    frame, last = nominal.frame, nominal.frame.last
    more = np.zeros((frame.arm.log.samples, 2))
    more[:, 1] = 0.05
    force = frame.discrepancy.force(nominal.at[len(frame.own) :])
    lost = (
        nominal.kept.seen.log_likelihood
        - frame.run(nominal.at, force=force - np.hstack([more, 0.0 * more])).seen.log_likelihood
    )
    shift = np.einsum("kai,ki->ka", nominal.kept.pushes[:, :, :2], -more[:last])
    assert _weigh_shift(nominal, shift) == pytest.approx(float(lost), rel=1e-6)


def test_a_simulator_without_steps_costs_nothing(nominal, helpers):
    assert measure_steps(nominal, helpers.make_simulator()) == ()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("machine", "term", "least"),
    [
        (Arm(friction=np.array([0.0, 0.3])), "coulomb_friction@elbow", 0.8),
        (
            Arm(play=np.array([1e-3, -1.0]), stiffness=np.array([6e4, 5e4]), loss=np.array([30.0, 10.0])),
            "backlash@shoulder.gear",
            0.5,
        ),
    ],
)
def test_the_written_model_keeps_the_gain(tmp_path, registry, machine, term, least):
    log = record_motion(machine, Arm(), np.random.default_rng(0), samples=3000)
    case = load_robot_case(write_case(tmp_path, 0, Arm(), log), registry)
    result = diagnose_robot(case, registry, terms=(term,)).result
    assert [f"{one.mechanism}@{one.at}" for one in result.found] == [term]
    assert result.written.share > least
    assert any("and with arm_found.xml, stepped by its simulator" in says for says in result.says)
    assert result.written.exact < result.written.before
