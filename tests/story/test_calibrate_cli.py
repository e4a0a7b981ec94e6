"""From a case without recordings to a calibration, on the command line: a few machines, and one that goes on."""

import csv
import json

import pytest
from click.testing import CliRunner

from lostmotion.cli import main

pytestmark = pytest.mark.slow

CASE = """
title = "Small Lin"
[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 40000.0
k1 = 0.0
[model.estimate]
c = { low = 2.0, high = 32.0, scale = "log" }
x0 = { low = 2e-3, high = 1.25e-2, scale = "log" }
"""
BENCH = ("--drive", "harmonic:amplitude=100,omega=40", "--duration", "1.571", "--rate", "509.3", "--noise", "0.01")
WHAT = ("calibration.json", "machines.csv", "report.html")


def run(case, out, *args, bench=BENCH):
    line = ["calibrate", str(case), *bench, "--ess", "100", "--out", str(out), *args]
    return CliRunner().invoke(main, line, prog_name="lostmotion")


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    path = tmp_path_factory.mktemp("case") / "case.toml"
    path.write_text(CASE, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def done(case, tmp_path_factory):
    """Four machines on two cores, ten periods each."""
    out = tmp_path_factory.mktemp("out")
    return run(case, out, "--machines", "4", "--jobs", "2"), out


def test_truths_are_found_again(done):
    outcome, out = done
    assert outcome.exit_code == 0, outcome.output
    content = json.loads((out / "calibration.json").read_text(encoding="utf-8"))
    assert content["schema"] == "lostmotion.calibration/1"
    assert content["route"] == "trajectory"
    assert content["machines"] == 4
    assert content["failed"] == []
    assert content["moved_by"] == "leapfrog, with friction that sticks"
    for name in ("c", "x0"):
        row = content["parameters"][name]
        assert row["drawn"]
        assert row["rms_z"] < 4.0, "no chance of one in ten thousand"
        assert row["median_relative_sd"] < 0.02
        assert row["coverage"]["95"]["of"] == 4 - len(content["unconverged"])
    assert not content["parameters"]["measurement_noise"]["drawn"]
    assert isinstance(content["passes"], bool)
    assert content["provenance"]["seed"] == 0
    assert content["provenance"]["settings"]["machines"] == 4


def test_what_is_printed_and_written(done):
    outcome, out = done
    assert "only large errors can be detected" in outcome.output
    assert outcome.output.rstrip().endswith(str(out / "report.html"))
    with (out / "machines.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["machine"] for row in rows] == ["0", "1", "2", "3"]
    assert all(2.0 <= float(row["c.truth"]) <= 32.0 for row in rows)
    assert all(0 <= int(row["x0.rank"]) <= 99 for row in rows if row["status"] == "ok")
    page = (out / "report.html").read_text(encoding="utf-8")
    for heading in ("Small Lin", "Are the ranks uniform?", "Where do intervals miss?", "Hardest machines"):
        assert heading in page
    assert "<script" not in page


@pytest.mark.slow
def test_a_lost_machine_is_made_again_with_the_same_bytes(case, done, tmp_path):
    _, out = done
    before = {name: (out / name).read_bytes() for name in WHAT}
    (out / "trials" / "00002.json").unlink()
    assert run(case, out, "--machines", "4", "--jobs", "1").exit_code == 0
    assert {name: (out / name).read_bytes() for name in WHAT} == before


def test_another_campaign_is_refused(case, done):
    outcome = run(case, done[1], "--machines", "4", "--seed", "1")
    assert outcome.exit_code == 2
    assert "seed 0, now 1" in outcome.output
    assert "--fresh to start over" in outcome.output


def test_machines_that_fail_are_listed(case, tmp_path):
    """A step of no size leaves an excitation in which there is nothing."""
    bench = ("--drive", "step:size=0", *BENCH[2:])
    outcome = run(case, tmp_path, "--machines", "2", "--jobs", "1", bench=bench)
    assert outcome.exit_code == 0, outcome.output
    assert "None of the machines has a posterior." in outcome.output
    content = json.loads((tmp_path / "calibration.json").read_text(encoding="utf-8"))
    assert [one["machine"] for one in content["failed"]] == [0, 1]
    assert "is constant (0)" in content["failed"][0]["says"]
    assert content["passes"] is False
    assert "Machine 1, failed" in (tmp_path / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (("--hide", "coulomb_frictoin:force=1"), "did you mean 'coulomb_friction'"),
        (("--term", "coulomb_friction@base"), "base"),
        (("--excitation-noise", "-1"), "excitation noise is -1"),
        (("--drive", "humming:x=1"), "there is no drive 'humming'"),
        (("--route", "quantifiers", "--term", "coulomb_friction"), "knows no terms"),
    ],
)
def test_what_cannot_be_used_is_refused(case, tmp_path, args, sentence):
    outcome = run(case, tmp_path / "never", *args)
    assert outcome.exit_code == 2
    assert sentence in outcome.output
    assert not (tmp_path / "never").exists()


def test_a_case_that_is_not_there_is_refused(tmp_path):
    outcome = run(tmp_path / "none.toml", tmp_path / "never")
    assert outcome.exit_code == 2
    assert "none.toml cannot be read" in outcome.output


def test_help_has_examples():
    outcome = CliRunner().invoke(main, ["calibrate", "--help"], prog_name="lostmotion")
    assert outcome.exit_code == 0
    assert "Examples:" in outcome.output
    assert "--hide coulomb_friction:force=1" in outcome.output
