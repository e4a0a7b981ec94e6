"""`lostmotion init` as a newcomer uses it: a table, a case, and every refusal with what to do."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner

import lostmotion
from lostmotion.case import load_case
from lostmotion.cli import main

T = np.arange(400) / 100.0


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    force = sum(np.cos(2.0 * np.pi * k * T / 4.0 + k * k) for k in range(2, 12))
    moved = np.convolve(force, np.exp(-T[:80] / 0.2) * np.sin(20.0 * T[:80]))[: T.size]
    rows = "".join(f"{1e3 * t:g};{f:.6f};{x:.6f}\n" for t, f, x in zip(T, force, moved, strict=True))
    (tmp_path / "my run.csv").write_text("Time;Force;Laser\nms;N;mm\n" + rows, encoding="utf-8")
    return tmp_path


def said(*args):
    result = CliRunner().invoke(main, ["init", *args])
    return result.exit_code, result.output


def test_a_table_becomes_a_case_and_the_next_command_is_told(place):
    code, output = said("my run.csv", "--out", "sub case.toml")
    assert code == 0
    assert "400 rows at 100 Hz, time in the column 'Time' (ms)" in output
    assert "Force (N): force" in output
    assert "lostmotion diagnose 'sub case.toml' --out result" in output
    spec = load_case(place / "sub case.toml").recordings[0]
    assert (spec.time, spec.time_unit, spec.inputs[0].target, spec.sensors[0].unit) == ("Time", "ms", "force", "mm")


def test_a_case_that_is_there_is_not_lost(place):
    assert said("my run.csv")[0] == 0
    (place / "case.toml").write_text("mine", encoding="utf-8")
    code, output = said("my run.csv")
    assert code == 2
    assert "--force" in output
    assert (place / "case.toml").read_text(encoding="utf-8") == "mine"
    assert said("my run.csv", "--force")[0] == 0


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (("--drive", "Forse"), "did you mean 'Force'?"),
        (("--factor", "Force=much"), "'much' is not a number"),
        (("--unit", "Force"), "expected COLUMN=VALUE"),
        (("--unit", "Laser=V"), "measures none of force, position"),
        (
            ("--model", "robot_joint", "--response", "Force", "--drive", "Laser"),
            "does not fit: robot_joint is of rotation",
        ),
    ],
)
def test_what_cannot_be_done_is_told_with_what_to_do(place, options, says):
    code, output = said("my run.csv", *options)
    assert code == 2
    assert says in output


def test_a_recording_is_diagnosed_without_a_case_where_its_columns_are_clear(place, monkeypatch):
    """The case is written as `init` does, into the folder of the results, which has a usual name."""
    asked = []

    def run_diagnosis(case, out, registry, **options):
        asked.append((case, out))
        return SimpleNamespace(says=("Nothing is missing.",), notes=("guessed: a", "b"), absent=())

    monkeypatch.setattr("lostmotion.diagnosis.diagnosis_run.run_diagnosis", run_diagnosis)
    result = CliRunner().invoke(main, ["diagnose", "my run.csv", "--model", "duffing", "--quiet"])
    assert result.exit_code == 0, result.output
    assert "Nothing is missing.\nguessed: a\n" in result.output
    assert asked == [(Path("lostmotion-diagnose/case.toml"), Path("lostmotion-diagnose"))]
    case = load_case(place / "lostmotion-diagnose" / "case.toml")
    assert (case.model, case.recordings[0].time_unit) == ("duffing", "ms")


def test_a_model_goes_with_a_recording_and_not_with_a_case(place):
    assert said("my run.csv")[0] == 0
    result = CliRunner().invoke(main, ["diagnose", "case.toml", "--model", "duffing"])
    assert result.exit_code == 2
    assert "--model needs a recording" in result.output


def test_the_front_doors_are_listed():
    """For completion in a shell: before anything was used."""
    assert {"analyse", "diagnose", "identify", "map", "simulate", "registry"} <= set(dir(lostmotion))
