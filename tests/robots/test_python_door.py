"""Robots in Python: models, cases, results, and what is refused in one sentence."""

import json

import numpy as np
import pytest
from lostmotion_template.simulators import TwoLink

import lostmotion as lm
from lostmotion.errors import CaseError
from lostmotion_trials.integrators.arm import Arm

JOINTS = ("shoulder", "elbow")
UNITS = {"shoulder.torque": "N m", "elbow.torque": "N m", "shoulder": "rad", "elbow": "deg"}
TRIED = ["coulomb_friction", "viscous_damping", "stribeck_friction"]


def inverse(q, v, a):
    own = np.array([0.3, 0.1]) * a + np.array([0.5, 0.3]) * v
    return TwoLink().inverse(q, v, a) + own


@pytest.fixture(scope="module")
def log(helpers):
    return helpers.record(Arm(friction=np.array([0.0, 0.4])), samples=2500)


def make_recording(log, **changes):
    data = {"shoulder.torque": log.torque[:, 0], "elbow.torque": log.torque[:, 1]}
    seen = {"elbow": np.degrees(log.readings[:, 1]), "shoulder": log.readings[:, 0]}  # not in the order of the joints
    given = {"inputs": data, "sensors": seen, "units": UNITS, "name": "run"} | changes
    return lm.Recording.from_arrays(0.002 * np.arange(log.samples), **given)


@pytest.fixture(scope="module")
def model():
    return lm.model(inverse=inverse, joints=JOINTS)


@pytest.fixture(scope="module")
def found(log, model):
    case = lm.Case(make_recording(log), model, title="Arm")
    return lm.diagnose(case, terms=TRIED, progress=False)


def test_friction_is_named_with_its_joint(found):
    assert (found.verdict, [(m.mechanism, m.at) for m in found.found]) == ("mismatch", [("coulomb_friction", "elbow")])
    force = found.found[0].parameters["force"]
    assert force.low < 0.4 < force.high
    assert force.unit == "N m"
    assert "Dry friction of" in " ".join(found.says)
    assert found.heldout["after"].nrmse < 0.5 * found.heldout["before"].nrmse
    assert "shoulder.random_force" in found.parameters_after
    tried = {name for row in found.ranking for name in row.mechanism.split(" + ")}
    assert "coulomb_friction" in tried <= {"nothing_missing", "unknown", *TRIED}


def test_a_result_is_saved_and_loaded(found, tmp_path):
    place = found.save(tmp_path / "result")
    again = lm.load(place)
    assert again.to_dict() == found.to_dict() == json.loads((place / "diagnosis.json").read_text())
    assert again.to_xarray().identical(found.to_xarray())
    assert repr(again) == repr(found)
    assert "Joint by joint" in found.report(tmp_path / "page.html").read_text()
    assert len(found.plot.prediction().axes) == 2
    assert "<li>" in found._repr_html_()


@pytest.mark.parametrize(
    ("ask", "says"),
    [
        (lambda d: d.model.write_mjcf("arm_found.xml"), "inverse has no MJCF file"),
        (lambda d: d.model.simulate({}), "simulate does not apply to a robot: write the model"),
        (lambda d: d.to_arviz(), "to_arviz does not apply to a robot: its posterior is normal"),
        (lambda d: d.plot.sections(), r"plot\.sections does not apply to a robot: there are"),
    ],
)
def test_what_does_not_apply_says_so(found, ask, says):
    with pytest.raises(CaseError, match=says):
        ask(found)


@pytest.mark.slow
def test_mjcf_in_python_and_in_a_case_file_give_the_same_answer(log, tmp_path):
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    from lostmotion_plugins.simulators.mujoco import EXAMPLE

    (tmp_path / "arm.xml").write_text(EXAMPLE, encoding="utf-8")
    robot = lm.model(mujoco=tmp_path / "arm.xml", joints=list(JOINTS), torque="motor")
    prior = {"elbow.damping": lm.LogUniform(0.03, 3.0)}
    case = lm.Case(make_recording(log), robot, known={"shoulder.damping": 0.5}, estimate=prior, title="Arm")
    path = case.write(tmp_path / "case")
    read = lm.Case.read(path)
    assert (read.known, read.estimate, read.title) == (case.known, case.estimate, "Arm")
    assert np.allclose(read.recordings[0].sensors[1], case.recordings[0].sensors[0])
    first = lm.diagnose(case, terms="coulomb_friction@elbow", progress=False)
    second = lm.diagnose(path, terms="coulomb_friction@elbow", progress=False, out=tmp_path / "out")
    assert [m.at for m in second.found] == [m.at for m in first.found] == ["elbow"]
    values = [d.found[0].parameters["force"].median for d in (first, second)]
    assert values[0] == pytest.approx(values[1], rel=1e-4)
    assert "elbow.damping" in first.parameters_after
    written = lm.load(tmp_path / "out").model.write_mjcf(tmp_path / "again.xml").read_text()
    assert written == (tmp_path / "out" / "arm_found.xml").read_text() == second.model.text
    assert "frictionloss" in written


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"mujoco": "none.xml", "torque": "motor"}, "names the file 'none.xml', which does not exist"),
        ({"mujoco": "arm.xml"}, "on which side of the gear is the torque measured"),
        ({"mujoko": "arm.xml", "torque": "motor"}, "unknown argument 'mujoko'.*did you mean 'mujoco'"),
        ({"inverse": inverse}, "lacks 'joints'"),
        ({"inverse": "gone.py:inverse", "joints": JOINTS}, "no file 'gone.py'"),
        ({"inverse": inverse, "joints": JOINTS, "torque": "both"}, "torque is 'both': expected one of motor, link"),
        ({}, "model has 0 models"),
    ],
)
def test_a_wrong_model_is_refused(options, says):
    with pytest.raises(CaseError, match=says):
        lm.model(**options)


def test_a_wrong_case_is_refused(log, model, found):
    recording = make_recording(log)
    few = make_recording(
        log, inputs={"shoulder.torque": log.torque[:, 0]}, units={k: UNITS[k] for k in UNITS if k != "elbow.torque"}
    )
    other = make_recording(
        log, sensors={"shoulder": log.readings[:, 0], "wrist": log.readings[:, 1]},
        units={**{k: UNITS[k] for k in list(UNITS)[:3]}, "wrist": "rad"},
    )  # fmt: skip
    for make, says in (
        (lambda: lm.Case(few, model), "has no torque of elbow"),
        (lambda: lm.Case(other, model), "has 'wrist', and the joints are shoulder, elbow"),
        (lambda: lm.Case([recording, recording], model), "2 recordings: a robot is diagnosed from one"),
        (lambda: lm.Case(recording, model, known={"elbow.dampin": 1.0}), "did you mean 'elbow.damping'"),
        (lambda: lm.diagnose(recording, model, terms="coulomb_frction", progress=False), "did you mean 'coulomb_fri"),
        (lambda: lm.identify(lm.Case(recording, model), progress=False), "that of a robot"),
        (lambda: lm.Case(recording, model).write("folder"), "no file holds the function"),
    ):
        with pytest.raises(CaseError, match=says):
            make()
