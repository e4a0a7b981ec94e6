"""What the true model gains over the nominal one, where the nominal one has to find its way from afar."""

import pytest

from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default
from lostmotion_trials.blind.bound import compute_bound
from lostmotion_trials.blind.commitment import Blind, conceal_case, open_sealed
from lostmotion_trials.blind.judging import score_case
from lostmotion_trials.blind.pilot import Effect
from lostmotion_trials.sealing import publish

pytestmark = pytest.mark.slow


def concealed_in(folder, blind, number=0):
    publish(folder, [conceal_case(blind, folder, number)])
    return prepare(folder / "cases" / f"{number:03d}" / "case.toml", default()), open_sealed(folder, number)


def test_nominal_model_finds_its_best_fit_without_half_of_the_forces(tmp_path):
    """Friction of half of the drive: from the truth itself the nominal fit stops a million below its maximum."""
    prepared, truth = concealed_in(tmp_path, Blind(11, 1500, ("coulomb_friction",)))
    found = compute_bound(prepared, truth.machine, truth.effects, None)
    assert found.status == ("ok",)
    assert 100.0 < found.gains[0] < 600.0


def test_gain_grows_with_what_is_left_out(tmp_path):
    """An effect of no size gains nothing but chance."""
    prepared, truth = concealed_in(tmp_path, Blind(3, 1500, clean=True))
    found = compute_bound(prepared, truth.machine, [Effect("offset_force", "", {"force": 0.0})], None)
    assert 0.0 <= found.gains[0] < 8.0


def test_case_without_a_diagnosis_counts_as_missed(tmp_path):
    concealed_in(tmp_path, Blind(4, 800, ("unknown",)))
    row = score_case(tmp_path, default(), 0)
    assert row.verdict == "failed"
    assert [e.outcome for e in row.answer.effects] == ["missed"]
    assert row.answer.effects[0].status == "no likelihood"
