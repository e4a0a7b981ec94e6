"""The case of a robot on the command line: a diagnosis, and what is refused in one sentence."""

import json
import re

import numpy as np
import pytest
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion_trials.integrators.arm import Arm, record_motion

MODEL = """
import numpy as np

def inverse(q, v, a):
    c, s = np.cos(q[:, 1]), np.sin(q[:, 1])
    far, bend = 0.075 + 0.0, 0.12
    m11, m12 = 0.05 + 0.12 + 0.32 + far + 2 * bend * c, far + bend * c
    tip = 9.81 * 0.3 * np.cos(q.sum(axis=1))
    root = 9.81 * (0.6 + 0.8) * np.cos(q[:, 0]) + tip
    one = (m11 + 0.3) * a[:, 0] + m12 * a[:, 1] - bend * s * (2 * v[:, 0] * v[:, 1] + v[:, 1] ** 2) + root
    two = m12 * a[:, 0] + (far + 0.1) * a[:, 1] + bend * s * v[:, 0] ** 2 + tip
    return np.stack([one + 0.5 * v[:, 0], two + 0.3 * v[:, 1]], axis=1)
"""
CASE = """
title = "Arm"
[[recordings]]
file = "log.csv"
time = "t"
inputs = [
  { input = "shoulder.torque", column = "u1", unit = "N m" }, { input = "elbow.torque", column = "u2", unit = "N m" },
]
sensors = [
  { channel = "shoulder", column = "q1", unit = "rad" }, { channel = "elbow", column = "q2", unit = "rad" },
]
[model]
inverse = "my_model.py:inverse"
joints = ["shoulder", "elbow"]
torque = "motor"
"""


def write(folder, machine=None, seed=0, samples=2500, case=CASE, change=None):
    log = record_motion(machine or Arm(), Arm(), np.random.default_rng(seed), samples=samples)
    columns = np.column_stack([log.time, log.torque, log.encoder])
    columns = columns if change is None else change(columns)
    folder.mkdir(parents=True, exist_ok=True)
    np.savetxt(folder / "log.csv", columns, delimiter=",", header="t,u1,u2,q1,q2", comments="", fmt="%.9g")
    (folder / "my_model.py").write_text(MODEL, encoding="utf-8")
    (folder / "case.toml").write_text(case, encoding="utf-8")
    return folder / "case.toml"


def run(case, out):
    return CliRunner().invoke(main, ["diagnose", str(case), "--out", str(out), "--quiet"])


@pytest.fixture(scope="module")
def diagnosed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("arm")
    done = run(write(folder / "case", Arm(friction=np.array([0.0, 0.4]))), folder / "out")
    return done, folder / "out"


def test_friction_is_named_with_its_joint(diagnosed):
    done, out = diagnosed
    assert done.exit_code == 0, done.output
    told = json.loads((out / "diagnosis.json").read_text())
    assert told["verdict"] == "mismatch"
    assert [(m["mechanism"], m["at"]) for m in told["found"]] == [("coulomb_friction", "elbow")]
    force = told["found"][0]["parameters"]["force"]
    assert force["low"] < 0.4 < force["high"]
    assert force["unit"] == "N m"
    assert told["model"]["after"] == "my_model.py + coulomb_friction@elbow"
    after, before = told["fit"]["after"], told["fit"]["before"]
    assert after["heldout_log_score"] > before["heldout_log_score"]
    assert after["heldout_nrmse_by_sensor"]["elbow"] < 0.2 * before["heldout_nrmse_by_sensor"]["elbow"]


def test_the_page_shows_each_joint(diagnosed):
    page = (diagnosed[1] / "report.html").read_text()
    assert "Joint by joint" in page
    assert "Dry friction of" in page
    assert "counts as the simpler one there" in page


def negate(columns):
    columns[:, 2] *= -1.0
    return columns


def swap(columns):
    columns[:, [1, 2]] = columns[:, [2, 1]]
    return columns


def turn(columns):
    columns[:, 3:] = np.degrees(columns[:, 3:])
    return columns


def scale(columns):
    columns[:, 1] *= 1000.0
    return columns


def shift(columns):
    columns[:, 1:3] = np.roll(columns[:, 1:3], 12, axis=0)
    return columns


def swap_positions(columns):
    columns[:, [3, 4]] = columns[:, [4, 3]]
    return columns


def swap_joints(columns):
    return swap_positions(swap(columns))


def mirror(columns):
    columns[:, 4] *= -1.0
    return columns


def turn_elbow(columns):
    columns[:, 4] = np.degrees(columns[:, 4])
    return columns


def move_zero(columns):
    columns[:, 4] += 0.5 * np.pi
    return columns


def slow(columns):
    columns[:, 0] *= 1000.0
    return columns


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (swap_positions, "positions of shoulder and elbow look swapped"),
        (swap_joints, "joints shoulder and elbow look swapped"),
        (mirror, "elbow .*opposite sign"),
        (turn_elbow, "positions .*degrees"),
        (move_zero, "zero of the encoder of elbow seems to be shifted: add -90 degrees"),
        (slow, "a sample every 2 s.* if the stamps are in ms"),
        (negate, "torque of elbow has the opposite sign"),
        (swap, "torques of shoulder and elbow look swapped"),
        (turn, "positions look like degrees"),
        (scale, "torque of shoulder is .* times that of the model"),
        (shift, "torque and position have different clocks"),
    ],
)
def test_a_fault_of_the_log_is_named_before_any_fit(tmp_path, change, says):
    done = run(write(tmp_path / "case", change=change), tmp_path / "out")
    assert done.exit_code == 2
    assert "Traceback" not in done.output
    assert re.search(says, " ".join(done.output.split())), done.output


def test_gravity_in_the_other_direction_is_named(tmp_path):
    case = write(tmp_path / "case")
    text = MODEL.replace("9.81", "-9.81")
    (tmp_path / "case" / "my_model.py").write_text(text, encoding="utf-8")
    done = run(case, tmp_path / "out")
    assert done.exit_code == 2
    assert "gravity in the opposite direction" in " ".join(done.output.split())


def test_a_model_without_gravity_is_named(tmp_path):
    case = write(tmp_path / "case")
    (tmp_path / "case" / "my_model.py").write_text(MODEL.replace("9.81", "0.0"), encoding="utf-8")
    done = run(case, tmp_path / "out")
    assert done.exit_code == 2
    assert "switch gravity on in the model" in " ".join(done.output.split())


def test_the_side_of_the_torque_is_asked_for(tmp_path):
    case = write(tmp_path / "case", case=CASE.replace('torque = "motor"\n', ""))
    done = run(case, tmp_path / "out")
    assert done.exit_code == 2
    assert "on which side of the gear is the torque measured?" in " ".join(done.output.split())


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("shoulder.torque", "sholder.torque", "did you mean 'shoulder'?"),
        ("elbow.torque", "elbow.setpoint", "the gains of its controller are not known"),
        ("my_model.py:inverse", "other.py:inverse", "no file 'other.py' beside the case"),
        ("my_model.py:inverse", "my_model.py:invers", "did you mean 'inverse'?"),
        ("[model]\n", "[model]\ntolerence = 0.1\n", "did you mean 'tolerance'?"),
    ],
)
def test_a_wrong_case_is_refused_in_one_sentence(tmp_path, old, new, says):
    done = run(write(tmp_path / "case", case=CASE.replace(old, new)), tmp_path / "out")
    assert done.exit_code == 2
    assert says in " ".join(done.output.split())


def test_mjcf_needs_mujoco_or_reads_it(tmp_path):
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    from lostmotion_trials.arms.draw import draw_arm, write_case

    model, _, log = draw_arm(0, 7, "none")
    case = write_case(tmp_path / "case", 0, model, log)
    earlier = tmp_path / "out" / "arm_found.py"
    earlier.parent.mkdir()
    earlier.write_text("the callback of an earlier diagnosis")
    done = run(case, tmp_path / "out")
    assert done.exit_code == 0, done.output
    assert not earlier.exists()
    assert json.loads((tmp_path / "out" / "diagnosis.json").read_text())["verdict"] == "adequate"
    assert "<mujoco" in (tmp_path / "out" / "arm_found.xml").read_text()


@pytest.mark.slow
def test_a_batch_diagnoses_robots_and_sets_faults_aside(tmp_path):
    good = write(tmp_path / "good", Arm(friction=np.array([0.0, 0.4])), samples=1500)
    bad = write(tmp_path / "bad", change=swap, samples=1500)
    command = ["diagnose", str(good), str(bad), "--out", str(tmp_path / "out"), "--quiet", "--budget", "4"]
    done = CliRunner().invoke(main, command)
    assert done.exit_code == 1, done.output
    assert "1 of 2 cases diagnosed, 1 set aside" in done.output
    assert "look swapped" in done.output
    rows = (tmp_path / "out" / "summary.csv").read_text().splitlines()
    assert any("coulomb_friction@elbow" in row for row in rows)
    result = tmp_path / "out" / "good-case" / "diagnosis.json"
    made = result.stat().st_mtime_ns
    assert CliRunner().invoke(main, command).exit_code == 1
    assert result.stat().st_mtime_ns == made  # an existing diagnosis is not repeated
    with (good.parent / "my_model.py").open("a", encoding="utf-8") as stream:
        stream.write("\n")
    assert CliRunner().invoke(main, command).exit_code == 1
    assert result.stat().st_mtime_ns != made


def test_the_command_check_tells_how_torques_agree(tmp_path):
    done = CliRunner().invoke(main, ["check", str(write(tmp_path / "case")), "--quiet"])
    assert done.exit_code == 0, done.output
    assert "Torque and inverse dynamics of elbow correlate with" in " ".join(done.output.split())


def test_the_command_check_refuses_what_a_diagnosis_refuses(tmp_path):
    done = CliRunner().invoke(main, ["check", str(write(tmp_path / "case", change=negate)), "--quiet"])
    assert done.exit_code == 2
    assert "torque of elbow has the opposite sign" in " ".join(done.output.split())
