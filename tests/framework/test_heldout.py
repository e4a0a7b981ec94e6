"""What held-out data decide: which sets of terms free runs refute."""

from types import SimpleNamespace

import numpy as np
import pytest
from made_facts import make_prediction

from lostmotion.diagnosis import diagnosis_run as ways
from lostmotion.diagnosis.compare import PARTS, is_better, is_worse
from lostmotion.settings import DEFAULT


def test_held_out_data_speak_against_what_predicts_worse():
    flat, rng = np.zeros(20), np.random.default_rng(0)
    assert is_worse(make_prediction(0.286, flat), make_prediction(0.315, flat))
    assert not is_worse(make_prediction(0.30, flat), make_prediction(0.302, flat))
    assert is_worse(make_prediction(0.30, flat), make_prediction(0.2, flat - 0.11 + 0.01 * rng.standard_normal(20)))
    assert not is_worse(make_prediction(0.30, flat), make_prediction(0.2, flat + 0.1))
    assert is_worse(make_prediction(0.30, flat), make_prediction(float("nan"), flat))


@pytest.mark.parametrize(("scatter", "gain", "worse"), [(0.3, 0.1, False), (0.01, 0.1, True), (0.3, 0.0, True)])
def test_a_larger_error_that_is_not_significant_needs_better_one_step_predictions(scatter, gain, worse):
    """Ten parts, seeded: errors that rise by 5 % with this scatter, and scores that rise or not."""
    rng = np.random.default_rng(4)
    errors = 0.3 * np.exp(scatter * rng.standard_normal(PARTS))
    scores = gain + 0.05 * rng.standard_normal(20)
    after = make_prediction(0.315, scores, errors * 1.05 * np.exp(scatter * rng.standard_normal(PARTS)))
    assert is_worse(make_prediction(0.30, np.zeros(20), errors), after) is worse


def test_a_score_falls_by_chance_in_one_of_twenty_models_that_predict_as_well():
    """2,000 pairs of models, blocks of normal scores: 5 % fall significantly, standard error 0.5 %. Seeded."""
    rng = np.random.default_rng(5)
    falls = [
        is_worse(make_prediction(0.3, np.zeros(20)), make_prediction(0.3, 0.001 * rng.standard_normal(20)))
        for _ in range(2000)
    ]
    assert 0.035 < np.mean(falls) < 0.065


def test_a_score_that_falls_within_a_wide_scatter_speaks_against_a_model_that_predicts_hardly_better():
    flat = np.zeros(20)
    outlier, slight = np.where(np.arange(20) == 7, -50.0, 0.5), -0.005 * np.cos(np.arange(20) * np.pi) - 0.0005
    assert not is_worse(make_prediction(1.0, flat), make_prediction(0.4, outlier))
    assert is_worse(make_prediction(1.0, flat), make_prediction(0.9, outlier))
    assert not is_worse(make_prediction(1.0, flat), make_prediction(0.9, slight))


class Refuted:
    """Explanations in order of their probability, of which the first is refuted."""

    def __init__(self, sets):
        self.sets, self.terms = sets, frozenset(sets[0])

    def refute(self):
        return Refuted(self.sets[1:])


@pytest.mark.parametrize(
    ("errors", "left", "withdrawn"),
    [
        ({"ab": 0.5, "a": 0.1, "": 0.3}, "a", ("b",)),
        ({"ab": 0.2, "a": 0.1, "": 0.3}, "ab", ()),
        ({"ab": 0.5, "a": 0.4, "": 0.3}, "", ("b", "a")),
    ],
    ids=["the best set predicts worse", "it predicts better", "every set predicts worse"],
)
def test_sets_that_make_free_runs_worse_are_refuted_one_after_the_other(monkeypatch, errors, left, withdrawn):
    def compare_heldout(d):
        after = make_prediction(errors["".join(d.found)], [0.0])
        return SimpleNamespace(diagnosis=d, before=make_prediction(0.3, [0.0]), after=after)

    def explain_by(explained, d, rng, say):
        gone = tuple(key for key in reversed(d.found) if key not in explained.terms)
        return diagnosed(explained, (*d.withdrawn, *gone))

    def diagnosed(explained, withdrawn=()):
        found = tuple(sorted(explained.terms))
        return SimpleNamespace(explained=explained, found=found, withdrawn=withdrawn, settings=DEFAULT)

    monkeypatch.setattr(ways, "compare_heldout", compare_heldout)
    monkeypatch.setattr(ways, "explain_by", explain_by)
    outcome = ways.check_heldout(diagnosed(Refuted(list(errors))), np.random.default_rng(0))
    assert "".join(outcome.diagnosis.found) == left
    assert outcome.diagnosis.withdrawn == withdrawn


def test_equal_models_are_confirmed_as_seldom_as_the_test_says():
    """One-sided, so half of the chance: 2.5 % of 4000 pairs of equal errors, within four standard errors. Seeded."""
    rng = np.random.default_rng(5)
    told = [is_better(*np.exp(0.3 * rng.standard_normal((2, PARTS)))) for _ in range(4000)]
    assert np.mean(told) == pytest.approx(0.5 * DEFAULT.heldout.chance, abs=4.0 * np.sqrt(0.025 * 0.975 / 4000))


def test_errors_that_fall_in_each_part_are_confirmed_and_the_same_errors_are_not():
    errors = np.linspace(0.01, 0.5, PARTS)
    without = errors * np.linspace(1.1, 1.3, PARTS)
    assert is_better(errors, without)
    assert not is_better(without, errors)
    assert not is_better(errors, errors)
    assert not is_better(np.full(PARTS, np.nan), errors)
