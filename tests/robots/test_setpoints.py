"""Logs with set points in place of torques: the controller is part of the model, with gains of the case or the file."""

import math
from functools import cache

import numpy as np
import pytest

from lostmotion.contracts import DriveTerm
from lostmotion.errors import CaseError
from lostmotion.robots.arm_case import load_robot_case
from lostmotion.robots.arm_effects import GearEffect, LawEffect
from lostmotion.robots.arm_preparation import SearchOptions, make_arm, prepare_search
from lostmotion.robots.arm_run import diagnose_robot

JOINTS, GAINS = ("left", "right"), (20.0, 1.5)
INERTIA, WEIGHT, DAMPING = 0.05, 2.0, 0.1
DT, SAMPLES, STEPS = 0.004, 2000, 100
MODEL = f"""
import numpy as np

def inverse(q, v, a):
    return {INERTIA} * a + {WEIGHT} * np.sin(q) + {DAMPING} * v
"""
CASE = """
[[recordings]]
file = "log.csv"
time = "t"
inputs = [
  { input = "left.setpoint", column = "s1", unit = "rad" }, { input = "right.setpoint", column = "s2", unit = "rad" },
]
sensors = [
  { channel = "left", column = "q1", unit = "rad" }, { channel = "right", column = "q2", unit = "rad" },
]
[model]
inverse = "own.py:inverse"
joints = ["left", "right"]
torque = "motor"
[model.gains]
left = { kp = 20.0, kd = 1.5 }
right = { kp = 20.0, kd = 1.5 }
"""


def follow(wanted, friction, rng):
    """Return the positions (samples,) of a pendulum under a controller, with friction that holds it."""
    q, v, step, found = wanted[0], 0.0, DT / STEPS, []
    kp, kd = GAINS
    for target in wanted:
        found.append(q)
        kick = 0.01 * rng.standard_normal()
        for _ in range(STEPS):
            free = kp * (target - q) - (kd + DAMPING) * v - WEIGHT * math.sin(q) + kick
            hold = min(max(free + INERTIA * v / step, -friction), friction)
            v += step / INERTIA * (free - hold)
            q += step * v
    return np.array(found) + 3e-5 * rng.standard_normal(len(wanted))


@cache
def simulate(friction):
    """Return times, set points and positions (samples, 5) of two pendulums, the second one with friction."""
    rng, time = np.random.default_rng(1), DT * np.arange(SAMPLES)
    held = np.repeat(time[::8], 8)[:SAMPLES]
    wanted = [0.5 * np.sin(w * held + 0.2 * held**2) for w in (2.0, 3.0)]
    found = [follow(one, own, rng) for one, own in zip(wanted, (0.0, friction), strict=True)]
    return np.column_stack([time, *wanted, *found])


@pytest.fixture(scope="module")
def write(tmp_path_factory):
    """Return a function that writes a case of the two pendulums."""

    def write(friction, case=CASE):
        folder = tmp_path_factory.mktemp("setpoints")
        np.savetxt(folder / "log.csv", simulate(friction), "%.9g", ",", header="t,s1,s2,q1,q2", comments="")
        (folder / "own.py").write_text(MODEL)
        (folder / "case.toml").write_text(case)
        return folder / "case.toml"

    return write


@pytest.fixture(scope="module")
def diagnosed(write, registry):
    return diagnose_robot(load_robot_case(write(0.25), registry), registry).result


def test_friction_is_found_at_its_joint_behind_the_controller(diagnosed):
    (found,) = diagnosed.found
    assert (found.mechanism, found.at) == ("coulomb_friction", "right")
    assert found.parameters["force"].median == pytest.approx(0.25, rel=0.1)


def test_the_torque_of_a_joint_is_that_of_the_controller(diagnosed):
    """Of the set point alone it would be 20 N m/rad times 0.35 rad."""
    assert max(row.torque for row in diagnosed.joints) < 3.0
    assert all(check.passed for check in diagnosed.checks)


def test_without_friction_the_controller_explains_the_log(write, registry):
    result = diagnose_robot(load_robot_case(write(0.0), registry), registry).result
    assert result.found == ()
    assert max(row.nrmse_after for row in result.joints) < 0.01


def test_what_needs_the_size_of_a_torque_is_not_tried(write, registry, terms):
    case = load_robot_case(write(0.25, CASE + '[model.known]\n"left.armature" = 0.01\n'), registry)
    arm = make_arm(case.model.simulator, case.log, known=case.known)
    search, _ = prepare_search(arm, case.model.simulator, terms, {}, SearchOptions())
    assert not any(isinstance(e, GearEffect) for e in search.screen.effects)
    laws = [e.term for e in search.screen.effects if isinstance(e, LawEffect)]
    assert {term.name for term in laws if isinstance(term, DriveTerm)} == {"excitation_delay", "actuator_lag"}


def test_a_sensor_behind_the_gear_does_not_saturate_and_has_no_gain_near_zero(write, registry, terms):
    case = load_robot_case(
        write(
            0.25,
            CASE.replace("setpoint", "torque")
            .replace('"s1", unit = "rad"', '"s1", unit = "N m"')
            .replace('"s2", unit = "rad"', '"s2", unit = "N m"'),
        ),
        registry,
    )
    tried = {}
    for side in ("motor", "link"):
        arm = make_arm(case.model.simulator, case.log, side)
        search, _ = prepare_search(arm, case.model.simulator, terms, {}, SearchOptions())
        tried[side] = {effect.key: effect for effect in search.screen.effects}
    assert "drive_saturation@left.torque" in tried["motor"]
    assert {"drive_saturation", "drive_dead_zone"}.isdisjoint(key.partition("@")[0] for key in tried["link"])
    for side, bounds in (("motor", (-0.6, 1.5)), ("link", (-0.2, 0.25))):
        (gain,) = tried[side]["excitation_gain@left.torque"].coordinates
        assert (gain.low, gain.high) == pytest.approx(bounds)


def test_set_points_without_gains_are_refused_with_the_remedy(write, registry):
    case = CASE.replace("right = { kp = 20.0, kd = 1.5 }", "")
    with pytest.raises(CaseError, match=r'set point of right.*\[model.gains\], "right" = \{ kp'):
        load_robot_case(write(0.25, case), registry)


def test_gains_of_an_unknown_joint_are_refused(write, registry):
    with pytest.raises(CaseError, match="rihgt"):
        load_robot_case(write(0.25, CASE.replace("right = {", "rihgt = {")), registry)


def test_position_actuators_of_a_file_have_gains(tmp_path, registry):
    pytest.importorskip("mujoco")
    from lostmotion_plugins.simulators.mujoco import EXAMPLE

    text = EXAMPLE.replace(
        "</mujoco>",
        '<actuator><position joint="elbow" kp="30" kv="2"/><motor joint="shoulder"/></actuator></mujoco>',
    )
    (tmp_path / "arm.xml").write_text(text)
    made = registry.load("simulator", "mujoco")(file=str(tmp_path / "arm.xml"), moving=("shoulder", "elbow"))
    assert made.gains == {"elbow": (30.0, 2.0)}
