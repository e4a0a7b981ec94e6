"""The blind trial on robot arms: what counts as right, its table, and that it is sealed and resumable."""

import json

import pytest
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion_trials.arms.judging import JudgedArm, JudgedSize, count_mechanisms, count_targets, judge_outcome
from lostmotion_trials.arms.trial import ArmsPlan, conceal_arm
from lostmotion_trials.sealing import open_seal, publish

COULOMB, RIPPLE, PAYLOAD = "coulomb_friction@elbow", "cogging@elbow", "payload@tip"


@pytest.mark.parametrize(
    ("hidden", "named", "outcome"),
    [
        ((COULOMB,), (COULOMB,), "right"),
        ((COULOMB,), (COULOMB, PAYLOAD), "right and more"),
        ((COULOMB,), (PAYLOAD,), "wrong joint"),
        ((COULOMB,), (RIPPLE,), "other physics"),
        ((COULOMB,), (), "silent"),
        ((COULOMB, RIPPLE), (RIPPLE,), "in part"),
        ((), (), "empty"),
        ((), (PAYLOAD,), "false"),
    ],
)
def test_outcomes(hidden, named, outcome):
    assert judge_outcome(hidden, named) == outcome


def test_small_effects_are_not_counted_as_missed():
    size = JudgedSize(f"{COULOMB}.force", 0.3, 0.28, 0.29, 0.31, True)
    rows = [
        JudgedArm("000", (COULOMB,), (COULOMB,), "right", 500.0, (size,)),
        JudgedArm("001", (COULOMB,), (), "silent", 5.0, ()),
        JudgedArm("002", (), (), "empty", float("nan"), ()),
    ]
    first, wrong, _, empty, sizes, _ = count_targets(rows, wrong=False)
    assert (first.rate.hits, first.rate.of, first.state) == (1, 1, "met")
    assert (wrong.rate.hits, wrong.rate.of) == (0, 2)
    assert (empty.rate.hits, empty.rate.of) == (0, 1)
    assert (sizes.rate.share, sizes.state) == (1.0, "open")
    assert count_mechanisms(rows) == {"coulomb_friction": {"right": 1, "silent": 1}, "nothing": {"empty": 1}}


def test_three_of_five_arms_hide_something_and_all_mechanisms_take_turns():
    plan = ArmsPlan()
    chosen = [plan.choose(k) for k in range(5 * len(plan.names))]
    assert sum(map(bool, chosen)) == 3 * len(plan.names)
    assert {name for names in chosen for name in names} == set(plan.names)


def test_a_case_states_how_well_its_model_is_known_and_truths_are_sealed(tmp_path):
    plan = ArmsPlan(samples=600, wrong=0.05)
    cases = [conceal_arm(plan, tmp_path, k) for k in (0, 3)]
    publish(tmp_path, cases)
    assert "tolerance = 0.05" in (tmp_path / "cases" / "000" / "case.toml").read_text(encoding="utf-8")
    assert [len(open_seal(tmp_path, k)["effects"]) for k in (0, 3)] == [1, 0]
    assert conceal_arm(plan, tmp_path / "again", 0).digests == cases[0].digests


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (("--only", "gap_drift"), "no mechanism 'gap_drift' can be hidden in such an arm"),
        (("--only", "cogging", "--clean"), "either --clean or --only"),
        (("--effects", "2"), "arms with 2 joints hide one effect"),
    ],
)
def test_what_cannot_be_used_is_refused(tmp_path, args, sentence):
    outcome = CliRunner().invoke(
        main, ["prove", "--world", "arms", "--cases", "1", "--out", str(tmp_path / "x"), *args]
    )
    assert outcome.exit_code == 2
    assert sentence in outcome.output


@pytest.mark.slow
def test_a_trial_is_told_and_continued_with_the_same_bytes(tmp_path):
    line = ["prove", "--world", "arms", "--cases", "2", "--only", "coulomb_friction", "--samples", "1500"]
    line += ["--out", str(tmp_path)]
    outcome = CliRunner().invoke(main, line, prog_name="lostmotion")
    assert outcome.exit_code == 0, outcome.output
    assert "joint and physics right" in outcome.output
    before = (tmp_path / "proof.json").read_bytes()
    content = json.loads(before)
    assert [arm["hidden"][0].partition("@")[0] for arm in content["arms"]] == ["coulomb_friction"] * 2
    (tmp_path / "steps" / "score" / "trials" / "00001.json").unlink()
    assert CliRunner().invoke(main, line, prog_name="lostmotion").exit_code == 0
    assert (tmp_path / "proof.json").read_bytes() == before
