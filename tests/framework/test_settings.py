"""The thresholds that decide: what they are, what changes them, and that results keep those they were made with."""

import ast
import json
import math
from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest
from click.testing import CliRunner

import lostmotion
from lostmotion.cli import main
from lostmotion.errors import CaseError
from lostmotion.settings import DEFAULT, Settings, read

ROOT = Path(lostmotion.__file__).parent
CHAOS = Path(__file__).parents[2] / "plugins" / "lostmotion_chaos"


def test_each_has_a_reason_and_a_key_of_its_own():
    told = list(DEFAULT)
    assert len({one.key for one in told}) == len(told) <= 60
    for one in told:
        assert one.why.endswith(".")
        assert one.unit
        assert one.value == one.default
        assert math.isfinite(one.value)


def test_a_change_makes_new_ones_and_the_rest_stays():
    changed = DEFAULT.changed({"select.decisive": 4, "heldout.share": "0.4"})
    assert (changed.select.decisive, changed.heldout.share) == (4.0, 0.4)
    assert changed.changed({"select.decisive": DEFAULT.select.decisive, "heldout.share": 0.3}) == DEFAULT
    with pytest.raises(FrozenInstanceError):
        changed.select.decisive = 3.0


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"select.decisiv": 4.0}, "no setting 'select.decisiv'.*'select.decisive'"),
        ({"heldout.share": 0.9}, "heldout.share is 0.9: expected a number from 0.05 to 0.7"),
        ({"name.sure": "much"}, "name.sure is 'much': expected a number"),
        ({"name.sure": float("nan")}, "name.sure is nan"),
        ({"chain.long": math.inf}, "chain.long is inf"),
    ],
)
def test_a_wrong_change_is_refused_in_a_sentence(values, says):
    with pytest.raises(CaseError, match=says):
        DEFAULT.changed(values)


def test_callers_give_settings_changes_or_nothing():
    changed = DEFAULT.changed({"select.decisive": 4.0})
    assert read(None) is DEFAULT
    assert read(changed) is changed
    assert read({"select.decisive": 4.0}) == changed


def test_the_command_lists_them_and_what_was_changed():
    run = CliRunner()
    text = run.invoke(main, ["settings"]).output
    assert all(one.key in text for one in DEFAULT)
    text = run.invoke(main, ["settings", "heldout", "--set", "heldout.share=0.4"]).output
    assert "heldout.share = 0.4   (default 0.3)" in text
    assert "select.decisive" not in text
    told = json.loads(run.invoke(main, ["settings", "--json"]).output)
    assert told == DEFAULT.as_dict()


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--set", "select.decisive"], "is not of the form STAGE.NAME=VALUE"),
        (["--set", "nothing.here=3"], "there is no setting 'nothing.here'"),
        (["somewhere"], "there is no stage 'somewhere'"),
    ],
)
def test_the_command_refuses_what_there_is_not(words, says):
    done = CliRunner().invoke(main, ["settings", *words])
    assert done.exit_code == 2
    assert says in done.output


def test_every_setting_is_used():
    """Each field is read in the framework or the package of chaos: one that nothing reads decides nothing."""
    read_names = {
        node.attr
        for path in (*ROOT.rglob("*.py"), *CHAOS.rglob("*.py"))
        if "settings" not in path.parts
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Attribute)
    }
    assert {one.key.partition(".")[2] for one in DEFAULT} <= read_names


def test_all_stages_are_frozen_and_compare():
    assert Settings() == DEFAULT
    assert hash(Settings()) == hash(DEFAULT)
