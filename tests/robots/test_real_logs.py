"""What the gallery says of logs of real robots, on the cases that `benchmarks/robot_logs.py` prints.

Each fact is about one log of one robot: no chance, no rate of false alarms.
"""

import numpy as np
import pytest
from real_logs import LOGS

from lostmotion.errors import CaseError
from lostmotion.robots.arm_case import load_robot_case
from lostmotion.robots.arm_run import check_robot, diagnose_robot

pytestmark = pytest.mark.real
FRICTIONS = {"coulomb_friction", "soft_friction", "stribeck_friction", "directional_friction", "viscous_damping"}
PUBLISHED = {"hip": 0.2884, "thigh": 0.1739, "calf": 1.0151}
"""Dry friction (N m) of the leg in `robot_model/go2/go2.xml` of the repository of the log."""


@pytest.fixture
def write(shared, tmp_path):
    """Return a function that writes the case of a log and returns its path."""

    def write(name):
        try:
            text = LOGS[name](shared / "data", tmp_path)
        except FileNotFoundError as err:
            pytest.skip(f"no recording: {err.filename} is absent")
        (tmp_path / "case.toml").write_text(text)
        return tmp_path / "case.toml"

    return write


def test_the_pendulum_at_its_resonance_is_refused_with_the_reason(write, registry):
    with pytest.raises(CaseError, match=r"torque of shoulder .* is a small difference of large parts of the model"):
        check_robot(write("double_pendulum"), registry)


def test_the_stamps_of_the_panda_are_those_of_an_even_clock(write, registry):
    """The noise of its encoders was 60 urad with the stamps as they are; the positions have digits of 1 urad."""
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    log = load_robot_case(write("panda"), registry).log
    assert any("even clock, every 1 ms" in note for note in log.notes)
    assert np.std(np.diff(log.positions, 4, axis=0), axis=0).max() / np.sqrt(70.0) < 1e-5


def test_each_joint_of_the_panda_agrees_with_its_model(write, registry):
    """Joint 7 has hardly anything but friction."""
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    found = check_robot(write("panda"), registry)
    agreements = [says for says in found if "Torque and inverse dynamics" in says]
    assert len(agreements) == 7
    assert [says for says in agreements if "friction of any size" in says] == [agreements[6]]


@pytest.mark.slow
def test_friction_is_found_in_all_joints_of_the_leg(write, registry):
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    result = diagnose_robot(load_robot_case(write("go2_leg"), registry), registry).result
    sizes = {m.at: m.parameters["force"].median for m in result.found if m.mechanism in FRICTIONS}
    assert sizes == pytest.approx(PUBLISHED, rel=0.25)
    for row in result.joints:
        assert row.nrmse_after < 0.5 * row.nrmse_before, row.joint
