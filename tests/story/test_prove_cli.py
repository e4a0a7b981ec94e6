"""A blind trial from the command line: concealed, diagnosed, unsealed, scored; continued, and refused when tampered."""

import json
import shutil

import pytest
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion_trials.blind.run import Diagnoser

WHAT = ("proof.json", "report.html", "seal.json")


def run(out, *args):
    line = ["prove", "--samples", "800", "--seed", "5", "--out", str(out), *args]
    return CliRunner().invoke(main, line, prog_name="lostmotion")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    out = tmp_path_factory.mktemp("proof")
    return run(out, "--cases", "2", "--only", "coulomb_friction", "--jobs", "2"), out


def again(out, *args):
    return run(out, "--cases", "2", "--only", "coulomb_friction", "--jobs", "1", *args)


@pytest.mark.slow
def test_trial_is_told(done):
    outcome, out = done
    assert outcome.exit_code == 0, outcome.output
    content = json.loads((out / "proof.json").read_text(encoding="utf-8"))
    assert content["schema"] == "lostmotion.proof/1"
    assert (content["cases"], content["effects"], content["failed"]) == (2, 2, [])
    assert content["unmeasured"] == []
    assert content["mechanisms"][0]["bound_status"] == "ok"
    assert content["mechanisms"][0]["median_gain"] > 1.0
    assert content["heldout"]["cases"] == 2
    assert "hidden effects" in outcome.output
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "http" not in page
    assert "section-detection" in page


@pytest.mark.slow
def test_interrupted_trial_goes_on_with_the_same_bytes(done):
    _, out = done
    before = {name: (out / name).read_bytes() for name in WHAT}
    (out / "steps" / "diagnose" / "trials" / "00001.json").unlink()
    (out / "steps" / "score" / "trials" / "00001.json").unlink()
    shutil.rmtree(out / "cases" / "001" / "diagnosis")
    assert again(out).exit_code == 0
    assert {name: (out / name).read_bytes() for name in WHAT} == before


@pytest.mark.slow
def test_diagnosis_needs_no_truth(done, tmp_path):
    _, out = done
    shutil.copytree(out / "cases" / "000", tmp_path / "000", ignore=shutil.ignore_patterns("diagnosis"))
    assert Diagnoser(tmp_path)(0).status == "ok"
    there, here = (place / "000" / "diagnosis" / "diagnosis.json" for place in (out / "cases", tmp_path))
    assert here.read_bytes() == there.read_bytes()


@pytest.mark.slow
def test_changed_truth_is_refused(done, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(done[1], copy)
    path = copy / "sealed" / "000.json"
    path.write_text(path.read_text(encoding="utf-8").replace("coulomb_friction", "offset_force"), encoding="utf-8")
    shutil.rmtree(copy / "steps" / "score")
    outcome = again(copy)
    assert outcome.exit_code == 2
    assert "truth of case 000 does not match its digest in seal.json" in outcome.output


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (("--only", "coulomb_frictoin"), "no mechanism is called 'coulomb_frictoin'"),
        (("--only", "gap_drift", "--clean"), "either --clean or --only"),
    ],
)
def test_what_cannot_be_used_is_refused(tmp_path, args, sentence):
    outcome = run(tmp_path / "never", "--cases", "1", *args)
    assert outcome.exit_code == 2
    assert sentence in outcome.output
    assert not (tmp_path / "never").exists()


def test_help_has_examples():
    outcome = CliRunner().invoke(main, ["prove", "--help"], prog_name="lostmotion")
    assert outcome.exit_code == 0
    assert "Examples:" in outcome.output
    assert "--clean" in outcome.output
