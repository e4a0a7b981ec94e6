"""Checks before any fit: joints with hardly anything but friction pass, motions near a resonance are explained."""

from dataclasses import replace

import numpy as np
import pytest

from lostmotion.robots.arm_preparation import SearchOptions, make_arm, prepare_search
from lostmotion.robots.log import RobotLog
from lostmotion.robots.log_checks import check_log
from lostmotion.robots.user import FunctionSimulator
from lostmotion_trials.integrators.arm import Arm

DT, SAMPLES = 0.002, 5000
TIME = DT * np.arange(SAMPLES)
INERTIA, WEIGHT = 0.05, 0.2
SIMULATOR = FunctionSimulator(lambda q, v, a: INERTIA * a + WEIGHT * np.sin(q), ("one", "two"))


def swing(speeds, size=0.3):
    """Return positions, velocities and accelerations (samples,) of a sum of sines (rad/s)."""
    waves = [size * np.sin(w * TIME + w) for w in speeds]
    q = np.sum(waves, axis=0)
    v = np.sum([size * w * np.cos(w * TIME + w) for w in speeds], axis=0)
    return q, v, -np.sum([w * w * x for w, x in zip(speeds, waves, strict=True)], axis=0)


def check(paths, torques, noise=1e-5):
    rng = np.random.default_rng(0)
    q = np.stack([path[0] for path in paths], axis=1)
    readings = q + noise * rng.standard_normal(q.shape)
    log = RobotLog("log", ("one", "two"), DT, np.stack(torques, axis=1), readings, ((0, 0), (1, 0)))
    return check_log(make_arm(SIMULATOR, log), SIMULATOR)


def compute_torque(path, inertia=INERTIA, friction=0.0):
    q, v, a = path
    return inertia * a + WEIGHT * np.sin(q) + friction * np.sign(v)


BUSY = swing((3.0, 4.7, 7.1))
SLOW = swing((0.3, 0.47, 0.7))


def test_a_joint_with_hardly_anything_but_friction_passes():
    found = check((BUSY, SLOW), (compute_torque(BUSY), compute_torque(SLOW, friction=0.5)))
    assert all(one.passed for one in found)
    (told,) = (one.says for one in found if one.joint == "two")
    assert "with friction of any size" in told


def test_friction_that_would_drive_the_motion_does_not_pass():
    found = check((BUSY, SLOW), (compute_torque(BUSY), -compute_torque(SLOW, friction=0.5)))
    assert not all(one.passed for one in found if one.joint == "two")


@pytest.mark.parametrize("wrong", [0.95, 0.97])
def test_a_motion_near_the_resonance_is_refused_with_its_reason(wrong):
    """The inertia is wrong by 3 or 5 %, which is many times the torque that is left between inertia and weight."""
    path = swing((2.0, 2.0))
    torques = [compute_torque(path, wrong * INERTIA) + 0.002 * np.sin(5.0 * TIME) for _ in range(2)]
    found = [one for one in check((path, path), torques) if one.stop]
    assert {one.name for one in found} == {"resonance"}
    assert all("small difference of large parts of the model" in one.says for one in found)
    assert all("at other frequencies" in one.says for one in found)


def test_a_motion_far_from_the_resonance_is_not():
    found = check((BUSY, BUSY), [compute_torque(BUSY, 1.05 * INERTIA)] * 2)
    assert all(one.passed for one in found)


def test_the_nominal_fit_reaches_the_random_force_of_a_log_that_the_model_does_not_explain(helpers):
    """Its friction holds joints that move: from 2 % of the torque alone the fit ended far below."""
    log = helpers.record(Arm())
    wrong = replace(log, torque=-log.torque)
    simulator, known = helpers.make_simulator(), {"shoulder.frictionloss": 1.0, "elbow.frictionloss": 1.0}
    search, start = prepare_search(make_arm(simulator, wrong, known=known), simulator, (), {}, SearchOptions(most=1))
    assert search.frame.read(start)["shoulder.random_force"] > 0.3 * np.std(log.torque[:, 0])
    assert search.frame.run(start).seen.log_likelihood > 0.0
