"""The demo, small: friction that was hidden in a joint is found, and where nothing was hidden nothing is."""

import json

import pytest
from answers import answer, entry
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion_trials.demo.conceal import FRICTION
from lostmotion_trials.demo.run import judge

pytestmark = pytest.mark.slow


def demo(*args):
    """Return the outcome of the command line."""
    return CliRunner().invoke(main, ["demo", "--quick", *map(str, args)], prog_name="lostmotion")


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    folder = tmp_path_factory.mktemp("demo") / "out"
    return folder, demo("--out", folder)


def test_hidden_friction_is_found_where_it_acts(shown):
    folder, done = shown
    assert done.exit_code == 0, done.output
    (entry,) = json.loads((folder / "diagnosis.json").read_text(encoding="utf-8"))["found"]
    assert (entry["mechanism"], entry["at"]) == ("coulomb_friction", "base")
    assert entry["parameters"]["force"]["median"] == pytest.approx(FRICTION, rel=0.05)


def test_lines_tell_the_story_and_the_report_comes_last(shown):
    folder, done = shown
    lines = done.stdout.rstrip().splitlines()
    assert [line.split()[0] for line in lines[:5]] == ["recorded", "hidden", "found", "truth", "held"]
    assert "lies in the 95 % interval" in lines[3]
    assert "error falls from" in lines[4]
    assert lines[-1] == str(folder / "report.html")


def test_case_and_picture_are_left_to_play_with(shown):
    folder, _ = shown
    assert {p.name for p in (folder / "case").iterdir()} == {"case.toml", "recording.csv"}
    assert {"report.html", "diagnosis.json", "arrays.nc", "hero.png"} <= {p.name for p in folder.iterdir()}
    assert (folder / "hero.png").stat().st_size < 200_000


@pytest.mark.slow
def test_nothing_hidden_nothing_found(tmp_path):
    done = demo("--clean", "--out", tmp_path / "out")
    assert done.exit_code == 0, done.output
    assert "hidden     nothing" in done.stdout
    assert "found      nothing, as it should be" in done.stdout


FOUND = entry("coulomb_friction", "base")


@pytest.mark.parametrize(
    ("found", "clean", "right"),
    [
        ([FOUND], False, True),
        ([FOUND], True, False),
        ([], True, True),
        ([], False, False),
        ([{**FOUND, "at": "ground"}], False, False),
        ([entry("unknown")], False, False),
        ([FOUND, entry("offset_force", "ground")], False, False),
    ],
)
def test_a_wrong_answer_is_called_wrong(found, clean, right):
    assert judge(answer(found=found), clean=clean) is right


def test_a_miss_ends_with_status_1(monkeypatch, tmp_path):
    from lostmotion_trials.demo import run as workflow

    missed = workflow.DemoResult(("found      nothing: this should not happen",), right=False)
    monkeypatch.setattr(workflow, "run_demo", lambda *_, **__: missed)
    done = demo("--out", tmp_path / "out")
    assert done.exit_code == 1
    assert done.stdout.rstrip().endswith("report.html")
