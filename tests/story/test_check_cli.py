"""`lostmotion check`: what a recording can tell, through the command line and in Python."""

import json

import pytest
from click.testing import CliRunner
from slider_case import CASE, case_in

import lostmotion as lm
from lostmotion.cli import main


def check(*args):
    """Return the outcome of the command line."""
    return CliRunner().invoke(main, ["check", *map(str, args)], prog_name="lostmotion")


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """Return a case of an oscillator with backlash that lacks nothing."""
    folder = tmp_path_factory.mktemp("checked")
    return case_in(folder, 0.0)


@pytest.fixture(scope="module")
def checked(case):
    """Return the check in Python."""
    return lm.check(case, progress=False)


def test_the_command_says_what_the_recording_can_tell(case):
    done = check(case, "--out", case.parent / "out", "--quiet")
    assert done.exit_code == 0, done.output
    lines = done.stdout.splitlines()
    assert lines[0].startswith("Expected 95 % intervals: c ")
    assert lines[1].startswith("Named with a probability of 90 %: Coulomb friction from ")
    assert any(
        line.startswith("Viscous damping has no size from which it is named: the parameter c has") for line in lines
    )
    assert lines[-1] == str(case.parent / "out" / "check.html")
    page = (case.parent / "out" / "check.html").read_text(encoding="utf-8")
    assert "Coulomb friction" in page
    assert "What would be named" in page
    assert 'src="http' not in page


def test_json_is_the_content_of_the_file_and_of_the_result(case, checked):
    done = check(case, "--out", case.parent / "again", "--json")
    stored = json.loads((case.parent / "again" / "check.json").read_text(encoding="utf-8"))
    assert json.loads(done.stdout) == stored == json.loads(json.dumps(checked.to_dict()))
    assert stored["schema"] == "lostmotion.check/1"


def test_the_result_shows_itself(checked, tmp_path):
    from matplotlib.figure import Figure

    assert "Expected 95 % intervals" in repr(checked)
    assert "<svg" in checked._repr_html_()
    assert isinstance(checked.plot.effects(), Figure)
    checked.save(tmp_path)
    assert lm.load(tmp_path).to_dict() == checked.to_dict()


def test_sizes_and_intervals_are_those_of_the_machine(checked):
    assert 8.0 in checked.parameters["c"]
    assert 5e-3 in checked.parameters["x0"]
    rows = {one.mechanism: one for one in checked.effects}
    friction = rows["coulomb_friction"]
    assert 0.01 < friction.smallest < 3.0
    assert friction.share_of_drive == pytest.approx(friction.smallest / 100.0, rel=0.05)
    assert rows["excitation_delay"].confused_with


def test_help_has_examples():
    done = check("--help")
    assert "lostmotion check case.toml --json" in done.stdout


@pytest.mark.parametrize(
    ("model", "part"),
    [
        ('name = "lin_backlash"\nknown = { m = 1.0 }', "needs c, k0"),
        ('inverse = "arm.py:make"', "lacks 'joints'"),
    ],
)
def test_an_unusable_case_is_one_sentence(case, tmp_path, model, part):
    text = CASE.partition("[model]")[0] + f"[model]\n{model}\n"
    (tmp_path / "recording.csv").write_bytes((case.parent / "recording.csv").read_bytes())
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    done = check(tmp_path / "case.toml", "--out", tmp_path / "out", "--quiet")
    assert done.exit_code == 2
    assert part in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert "Traceback" not in done.stderr
