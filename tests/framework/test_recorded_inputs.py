"""A name in an equation that stands for a recorded input: it is that input and a note says so, or it is asked for."""

from __future__ import annotations

import numpy as np
import pytest

import lostmotion as lm
from lostmotion.case import load_case
from lostmotion.equations import name_inputs
from lostmotion.errors import CaseError
from lostmotion.preparation.beginning import write_first_case
from lostmotion.preparation.prepare import prepare
from lostmotion.recording.outline import GivenRoles
from lostmotion.registry import Registry

FORCE, SHAKEN = ["force"], ["base_acceleration"]
NAMED = {
    "m*x'' + c*x' + k*x = F": (FORCE, "m*x'' + c*x' + k*x = force"),
    "J*th'' + b*th' = tau": (FORCE, "J*th'' + b*th' = force"),
    "m*x'' = u - c*x' - k*x": (FORCE, "m*x'' = force - c*x' - k*x"),
    "m*x'' + c*x' + k*x - F = 0": (FORCE, "m*x'' + c*x' + k*x - force = 0"),
    "x'' + 2*z*w*x' + w^2*x = F/m": (FORCE, "x'' + 2*z*w*x' + w^2*x = force/m"),
    "m*y'' + c*y' + k*y = -m*a0": (SHAKEN, "m*y'' + c*y' + k*y = -m*base_acceleration"),
    "m*x'' + Fc*sign(x') + k*x = sat(F, top)": (FORCE, None),
    "m*x'' + c*x' + k*x = K*u": (FORCE, None),
    "m*x'' + c*x' + k*x = F + F0": (FORCE, None),
    "m*x'' + c*x' + k*x = 0": (FORCE, None),
    "m*x'' + c*x' + k*x = F1 - F2": (["force", "second_force"], None),
}
OSCILLATOR, FREE = "m*x'' + c*x' + k*x = F", "m*x'' + c*x' + k*x = 0"


@pytest.mark.parametrize("text", NAMED)
def test_one_free_name_is_the_recorded_input_and_several_are_asked_for(text):
    recorded, wanted = NAMED[text]
    if wanted is None:
        with pytest.raises(CaseError, match=r"has no input, but the recording has .*force.*: write .*force"):
            name_inputs([text], recorded)
        return
    named, said = name_inputs([text], recorded)
    assert named == (wanted,)
    assert f"stands for the recorded input {recorded[0]}" in said[0]


def test_a_refusal_names_the_candidates():
    with pytest.raises(CaseError, match=r"the name that stands for it \(K, u\)"):
        name_inputs(["m*x'' + c*x' = K*u"], FORCE)
    with pytest.raises(CaseError, match=r"has the input force, but the recording has second_force"):
        name_inputs(["m*x'' + c*x' = force + F2"], ["force", "second_force"])


def test_a_name_with_a_value_is_no_input():
    assert name_inputs(["m*x'' + c*x' = K*u"], FORCE, ["K"])[0] == ("m*x'' + c*x' = K*force",)
    with pytest.raises(CaseError, match="write force where it acts"):
        name_inputs([OSCILLATOR], FORCE, ["F"])


def test_a_constant_is_a_constant_where_nothing_is_recorded_or_the_input_has_its_name():
    assert name_inputs([OSCILLATOR], []) == ((OSCILLATOR,), ())
    plain = "m*x'' + c*x' + k*x = force - F0"
    assert name_inputs([plain], FORCE) == ((plain,), ())


def made():
    t = np.arange(300) / 100.0
    return lm.Recording.from_arrays(
        t, inputs={"force": np.sin(9.0 * t)}, sensors={"position": 1e-3 * np.cos(9.0 * t)},
        units={"force": "N", "position": "m"},
    )  # fmt: skip


def test_the_notebook_takes_the_input_from_text_and_from_a_model(tmp_path):
    priors = {"c": lm.LogUniform(0.1, 10.0), "k": lm.LogUniform(1.0, 1e4)}
    for given in (OSCILLATOR, lm.model(OSCILLATOR)):
        case = lm.Case(made(), given, {"m": 2.0}, priors)
        assert case.model.equations == ("m*x'' + c*x' + k*x = force",)
        assert [q.name for q in case.model.params] == ["m", "c", "k"]
        assert any("F in the equation stands for the recorded input force" in note for note in case.notes)
    again = load_case(case.write(tmp_path / "written"))
    assert again.notes == case.notes
    with pytest.raises(CaseError, match="has no input, but the recording has force"):
        lm.Case(made(), FREE, {"m": 2.0}, priors)


def table(folder):
    t = np.arange(300) / 100.0
    rows = "".join(f"{a:.2f},{np.sin(9 * a):.6f},{1e-3 * np.cos(9 * a):.6f}\n" for a in t)
    (folder / "run.csv").write_text(f"t (s),F (N),x (m)\n{rows}", encoding="utf-8")


def test_the_first_case_has_the_input_and_says_so(tmp_path):
    table(tmp_path)
    draft = write_first_case(
        tmp_path / "run.csv", tmp_path / "case.toml", GivenRoles(), Registry.discover(), OSCILLATOR
    )
    assert "F = {" not in draft.text
    assert any("F in the equation stands for" in note for note in draft.notes)
    case = prepare(tmp_path / "case.toml", Registry.discover())
    assert case.notes[0].startswith("guessed: F in the equation")


def test_a_case_file_has_the_input_or_names_the_candidates(tmp_path):
    table(tmp_path)
    head = "[[recordings]]\nfile = 'run.csv'\ntime = 't (s)'\n"
    head += "inputs = [{ input = 'force', column = 'F (N)', unit = 'N' }]\n"
    head += "sensors = [{ channel = 'x', column = 'x (m)', unit = 'm' }]\n[model]\n"
    (tmp_path / "case.toml").write_text(f'{head}equations = ["{OSCILLATOR}"]\nknown = {{ m = 1.0 }}\n')
    case = load_case(tmp_path / "case.toml")
    assert case.equations == ("m*x'' + c*x' + k*x = force",)
    assert "F in the equation stands for" in case.notes[0]
    (tmp_path / "case.toml").write_text(f'{head}equations = ["{FREE}"]\n')
    with pytest.raises(CaseError, match=r"model cannot be used: .*has no input, but the recording has force"):
        load_case(tmp_path / "case.toml")


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("m*x'' + 2*m*zeta*w0*x' + m*w0^2*x = force", "w0"),
        ("J*th'' + J*rate*th' = torque", "rate"),
        ("m*x'' + c*x' + k*x*(1 + e*sin(x*w/v)) = force", "w"),
    ],
)
def test_a_rate_of_an_equation_is_in_radians_per_second(text, name):
    made = lm.model(text, units={"v": "m/s"} if "/v" in text else None)
    units = {q.name: q.unit(made.motion) for q in made.params}
    assert units[name] == "rad/s"
    assert "Hz" not in units.values()
