"""`lostmotion init` for the log of a robot: columns are matched with joints by name, in any order."""

import json
import tomllib

import numpy as np
import pytest
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion.robots.arm_first_case import match_columns
from lostmotion_trials.integrators.arm import Arm, record_motion

pytest.importorskip("mujoco", reason="MJCF and URDF need the extra mujoco")
from lostmotion_plugins.simulators.mujoco import EXAMPLE

COLUMNS = ("t", "tau_shoulder", "tau_elbow", "q_shoulder", "q_elbow")
SEVEN = tuple(f"joint{i + 1}" for i in range(7))


@pytest.fixture(scope="module")
def recorded():
    log = record_motion(Arm(friction=np.array([0.0, 0.4])), Arm(), np.random.default_rng(0), samples=1500)
    return np.column_stack([log.time, log.torque, log.encoder])


def write(folder, recorded, names=COLUMNS, seed=0):
    """Write a log with the columns of the arm under other names, in a random order, beside its model."""
    order = np.random.default_rng(seed).permutation(len(names))
    header = ",".join(names[i] for i in order)
    np.savetxt(folder / "log.csv", recorded[:, order], "%.9g", ",", header=header, comments="")
    (folder / "arm.xml").write_text(EXAMPLE, encoding="utf-8")
    return str(folder / "log.csv")


def init(folder, log, *more):
    command = ["init", log, "--mujoco", str(folder / "arm.xml"), "--out", str(folder / "case.toml"), *more]
    return CliRunner().invoke(main, command)


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize(
    "names",
    [
        COLUMNS,
        ("time", "Shoulder effort", "Elbow effort", "Shoulder position", "Elbow position"),
        ("t", "u[0]", "u[1]", "q[0]", "q[1]"),
        ("stamp", "elbow_joint_x", "x2", "shoulder", "y"),
    ],
)
def test_columns_in_any_order_find_their_joints(tmp_path, recorded, names, seed):
    done = init(tmp_path, write(tmp_path, recorded, names, seed), "--torque", "motor")
    if "y" in names:
        assert done.exit_code == 2
        assert "Traceback" not in done.output
        return
    assert done.exit_code == 0, done.output
    case = tomllib.loads((tmp_path / "case.toml").read_text())
    (recording,) = case["recordings"]
    told = {one["input"]: one["column"] for one in recording["inputs"]}
    told |= {one["channel"]: one["column"] for one in recording["sensors"]}
    wanted = ("shoulder.torque", "elbow.torque", "shoulder", "elbow")
    assert told == dict(zip(wanted, names[1:], strict=True))
    assert (recording["time"], case["model"]["torque"], case["model"]["mujoco"]) == (names[0], "motor", "arm.xml")


def test_the_case_is_diagnosed_and_the_side_is_asked_for(tmp_path, recorded):
    assert init(tmp_path, write(tmp_path, recorded)).exit_code == 0
    case = tmp_path / "case.toml"
    run = ["diagnose", str(case), "--out", str(tmp_path / "out"), "--quiet", "--budget", "8"]
    done = CliRunner().invoke(main, run)
    assert done.exit_code == 2
    assert "on which side of the gear is the torque measured?" in " ".join(done.output.split())
    assert init(tmp_path, str(tmp_path / "log.csv"), "--torque", "motor", "--force").exit_code == 0
    done = CliRunner().invoke(main, run)
    assert done.exit_code == 0, done.output
    found = json.loads((tmp_path / "out" / "diagnosis.json").read_text())["found"]
    assert [(m["mechanism"], m["at"]) for m in found] == [("coulomb_friction", "elbow")]


@pytest.mark.parametrize(
    "names",
    [
        [f"{word}{i}" for i in (3, 1, 7, 2, 6, 5, 4) for word in ("tau", "dq", "q")],
        [f"{word}[{i}]" for i in (3, 1, 0, 2, 6, 5, 4) for word in ("effort", "velocity", "position")],
        [f"joint{i}_{word}" for i in (3, 1, 7, 2, 6, 5, 4) for word in ("torque", "vel", "pos")],
        [f"{word}_J{i}" for i in (3, 1, 7, 2, 6, 5, 4) for word in ("tau", "dq", "q", "q_des")],
    ],
)
def test_seven_joints_by_number(names):
    found = match_columns(names, SEVEN, {})
    assert len(found) == 21
    first = 0 if "[" in names[0] else 1
    for (joint, quantity), column in found.items():
        assert int("".join(c for c in column if c.isdigit())) - first == SEVEN.index(joint)
        assert {"force": "t", "velocity": "v", "position": "p"}[quantity] in column.replace("dq", "v").replace("q", "p")


@pytest.mark.parametrize(
    ("names", "more", "says"),
    [
        (("t", "a", "b", "c", "d"), (), "no column belongs to a joint of the model by its name"),
        (("t", "tau_shoulder", "b", "q_shoulder", "q_elbow"), (), "has no torque of elbow"),
        (("t", "set_shoulder", "set_elbow", "q_shoulder", "q_elbow"), (), "its input is 'shoulder.setpoint'"),
        (("a", *COLUMNS[1:]), (), "no column of time: give --time COLUMN"),
        (COLUMNS, ("--model", "linear_oscillator"), "--model does not belong to a robot"),
        (COLUMNS, ("--urdf", "arm.urdf"), "name two models"),
    ],
)
def test_what_cannot_be_matched_is_refused(tmp_path, recorded, names, more, says):
    done = init(tmp_path, write(tmp_path, recorded, names), *more)
    assert done.exit_code == 2
    assert "Traceback" not in done.output
    assert says in " ".join(done.output.split())
