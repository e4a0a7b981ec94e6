"""`lostmotion init` as a newcomer uses it: a table, a case, and every refusal with what to do."""

import numpy as np
import pytest
from click.testing import CliRunner

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
        (("--factor", "Force=much"), "'much' is no number"),
        (("--unit", "Force"), "wanted COLUMN=VALUE"),
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
