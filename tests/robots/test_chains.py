"""Arms with more than two joints: friction in every joint is one proposal, and each joint is named."""

import numpy as np
import pytest

from lostmotion.robots.arm_preparation import SearchOptions, make_arm, prepare_search
from lostmotion.robots.arm_search import find_probabilities
from lostmotion.robots.log import RobotLog
from lostmotion.robots.user import FunctionSimulator
from lostmotion_trials.arms.chains import draw_hidden_chain, format_mjcf
from lostmotion_trials.integrators.chain import draw_chain, plan_chain, record_chain

NAMES = ("coulomb_friction", "stribeck_friction", "viscous_damping", "offset_force")


def search_chain(model, log, terms):
    count = len(model.joints)
    picks = tuple((j, 0) for j in range(count))
    recorded = RobotLog("log", model.joints, 0.002, log.torque, log.encoder, picks)
    simulator = FunctionSimulator(model.torque, model.joints)
    arm = make_arm(simulator, recorded)
    kept = [t for t in terms if t.name in NAMES]
    found, start = prepare_search(arm, simulator, kept, {}, SearchOptions(asked=NAMES))
    return found.run(start)


@pytest.mark.slow
def test_friction_in_every_joint_is_one_proposal(terms):
    rng = np.random.default_rng(3)
    model, machine = draw_chain(rng, 3), draw_chain(np.random.default_rng(3), 3)
    size = np.std(model.torque(*plan_chain(np.random.default_rng(0), 500, 0.02, 3)), axis=0)
    machine.friction = 0.1 * size + 0.05
    search = search_chain(model, record_chain(machine, model, rng, samples=2000), terms)
    wanted = {f"coulomb_friction@{joint}" for joint in model.joints}
    assert {key for key, share in find_probabilities(search).items() if share > 0.95} == wanted
    for joint, force in zip(model.joints, machine.friction, strict=True):
        assert search.best.values[f"coulomb_friction@{joint}.force"] == pytest.approx(force, rel=0.1)
    assert not any(len(terms) == 2 and terms < wanted and terms in search.extended for terms in search.found)


def test_its_motion_is_that_of_mujoco():
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    import mujoco

    model, (truth,), log = draw_hidden_chain(0, 5, ["payload"], 7)
    assert truth.mechanism == "payload"
    assert np.isfinite(log.encoder).all()
    machine = mujoco.MjModel.from_xml_string(format_mjcf(model))
    data = mujoco.MjData(machine)
    rng = np.random.default_rng(0)
    q, v, a = rng.standard_normal((3, 5, 7))
    for k, own in enumerate(model.torque(q, v, a)):
        data.qpos, data.qvel, data.qacc = q[k], v[k], a[k]
        mujoco.mj_inverse(machine, data)
        assert np.allclose(data.qfrc_inverse, own, atol=1e-9)
