"""Small inputs on which a wrong number came out without a word, from the command to the right value."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner

from lostmotion.cli import main

FRICTION = ("coulomb_friction", "stribeck_friction")
"""Dry friction, with an excess below a speed that these data may leave undecided."""


def diagnosed(folder, *args):
    result = CliRunner().invoke(main, ["diagnose", *args, "--out", str(folder), "--quiet"])
    assert result.exit_code == 0, result.output
    return json.loads((folder / "diagnosis.json").read_text(encoding="utf-8")), result.output


@pytest.mark.slow
def test_an_input_that_is_called_f_drives_the_machine(shared_cases, tmp_path):
    run = str(shared_cases / "e02_input_called_F" / "run.csv")
    found, output = diagnosed(tmp_path, run, "--model", "m*x'' + c*x' + k*x = F")
    first = found["found"][0]
    assert first["mechanism"] in FRICTION
    assert first["parameters"]["force"]["median"] == pytest.approx(1.5, rel=0.01)
    assert not {"F"} & {*found["parameters"]["before"], *found["parameters"]["after"]}
    assert "guessed: F in the equation stands for the recorded input force" in output


@pytest.mark.slow
def test_a_natural_frequency_of_an_equation_has_the_unit_of_its_value(shared_cases, tmp_path):
    found, _ = diagnosed(tmp_path, str(shared_cases / "e04_natural_frequency" / "case.toml"))
    natural = found["parameters"]["after"]["w0"]
    assert natural["unit"] == "rad/s"
    assert natural["median"] == pytest.approx(20.0, rel=0.01)
    assert found["found"][0]["mechanism"] in FRICTION
    assert found["found"][0]["parameters"]["force"]["median"] == pytest.approx(1.5, rel=0.01)
