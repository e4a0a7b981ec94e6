"""What held-out data decide: withdrawn findings, further terms, and sets that predict better."""

from types import SimpleNamespace

import numpy as np
import pytest

from lostmotion.diagnosis import confirming
from lostmotion.diagnosis import run as ways
from lostmotion.diagnosis.compare import PARTS, is_better, is_worse
from lostmotion.inference.robustness import RobustChecks
from lostmotion.inference.term_sets import TermSet
from lostmotion.likelihood.problem import RANDOM
from lostmotion.settings import DEFAULT


def prediction(nrmse, scores, errors=()):
    return SimpleNamespace(nrmse=nrmse, scores=np.asarray(scores, dtype=float), errors=np.asarray(errors, dtype=float))


def test_held_out_data_speak_against_what_predicts_worse():
    flat, rng = np.zeros(20), np.random.default_rng(0)
    assert is_worse(prediction(0.286, flat), prediction(0.315, flat))
    assert not is_worse(prediction(0.30, flat), prediction(0.302, flat))
    assert is_worse(prediction(0.30, flat), prediction(0.2, flat - 0.11 + 0.01 * rng.standard_normal(20)))
    assert not is_worse(prediction(0.30, flat), prediction(0.2, flat + 0.1))
    assert is_worse(prediction(0.30, flat), prediction(float("nan"), flat))


@pytest.mark.parametrize(("scatter", "gain", "worse"), [(0.3, 0.1, False), (0.01, 0.1, True), (0.3, 0.0, True)])
def test_a_larger_error_that_is_not_significant_needs_better_one_step_predictions(scatter, gain, worse):
    """Ten parts, seeded: errors that rise by 5 % with this scatter, and scores that rise or not."""
    rng = np.random.default_rng(4)
    errors = 0.3 * np.exp(scatter * rng.standard_normal(PARTS))
    scores = gain + 0.05 * rng.standard_normal(20)
    after = prediction(0.315, scores, errors * 1.05 * np.exp(scatter * rng.standard_normal(PARTS)))
    assert is_worse(prediction(0.30, np.zeros(20), errors), after) is worse


def test_a_score_falls_by_chance_in_one_of_twenty_models_that_predict_as_well():
    """2,000 pairs of models, blocks of normal scores: 5 % fall significantly, standard error 0.5 %. Seeded."""
    rng = np.random.default_rng(5)
    falls = [
        is_worse(prediction(0.3, np.zeros(20)), prediction(0.3, 0.001 * rng.standard_normal(20))) for _ in range(2000)
    ]
    assert 0.035 < np.mean(falls) < 0.065


def test_a_score_that_falls_within_a_wide_scatter_speaks_against_a_model_that_predicts_hardly_better():
    flat = np.zeros(20)
    outlier = np.where(np.arange(20) == 7, -50.0, 0.5)
    assert not is_worse(prediction(1.0, flat), prediction(0.4, outlier))
    assert is_worse(prediction(1.0, flat), prediction(0.9, outlier))
    assert not is_worse(prediction(1.0, flat), prediction(0.9, flat - 0.005 * np.cos(np.arange(20) * np.pi) - 0.0005))


@pytest.mark.parametrize(
    ("improbable", "left"), [((), ("a",)), (("a",), ())], ids=["probable", "the last term is improbable"]
)
def test_what_makes_predictions_worse_or_is_improbable_is_taken_back(monkeypatch, improbable, left):
    errors = {("a", "b", "curve"): 0.5, ("a", "b"): 0.4, ("a",): 0.1, (): 0.3}

    def compare_heldout(d, prepared):
        return SimpleNamespace(diagnosis=d, before=prediction(0.3, [0.0]), after=prediction(errors[d.found], [0.0]))

    def simpler(d, rng):
        return SimpleNamespace(
            found=d.found[:-1], withdrawn=(*d.withdrawn, d.found[-1]), explains=True, settings=DEFAULT
        )

    monkeypatch.setattr(ways, "compare_heldout", compare_heldout)
    monkeypatch.setattr(ways, "drop_least_probable", simpler)
    monkeypatch.setattr(ways, "list_improbable", lambda d: [key for key in d.found if key in improbable])
    monkeypatch.setattr(ways, "find_better_set", lambda outcome, observations: None)
    monkeypatch.setattr(ways, "decide_by_heldout", lambda outcome, observations: None)
    monkeypatch.setattr(ways, "find_simplest", lambda outcome, observations: None)
    start = SimpleNamespace(found=("a", "b", "curve"), withdrawn=(), explains=True, settings=DEFAULT)
    outcome = ways.check_heldout(start, SimpleNamespace(observations=()), np.random.default_rng(0))
    assert outcome.diagnosis.found == left
    assert outcome.diagnosis.withdrawn == ("curve", "b", *improbable)


NOTHING = SimpleNamespace(active=frozenset())


def make_outcome(monkeypatch, weights, scores, leads, tied, begun=""):
    """Return an outcome with fitted sets, named by the letters of their terms.

    `scores` are those of held-out data, also of a force that is `smooth` if there is one; `leads` are the log odds over
    the set without the further term, and `begun` is the chosen set. `s` is a usual error of a channel.
    """
    fits = {k: SimpleNamespace(status="converged", key=k, problem=NOTHING) for k in scores}
    rival = SimpleNamespace(fit=fits["smooth"], corrected=None) if "smooth" in fits else None
    selection = SimpleNamespace(
        chosen=SimpleNamespace(problem=SimpleNamespace(active=frozenset(begun))),
        fitted_sets={frozenset(k): TermSet(frozenset(k), fits[k], weight) for k, weight in weights.items()},
        tied=tied,
        compute_log_odds=lambda term_set, over: leads["".join(sorted(term_set.terms))],
        fit_discrepancy=lambda term_set: None,
        discrepancy_fit=lambda term_set: rival,
        expansion=lambda term_set: SimpleNamespace(inflation=1.0),
    )
    monkeypatch.setattr(confirming, "find_term", lambda problem, key: (SimpleNamespace(usual=key == "s"), ()))
    monkeypatch.setattr(confirming, "score_heldout", lambda fit, pieces: scores[fit.key])
    monkeypatch.setattr(confirming, "cut_heldout", lambda observations, held: ())
    return SimpleNamespace(diagnosis=SimpleNamespace(selection=selection, learned=None, held=(), settings=DEFAULT))


@pytest.mark.parametrize(
    ("scores", "leads", "chosen"),
    [
        ({"a": 12.0, "smooth": 2.0, "": 0.0}, {"a": 1.0}, "a"),
        ({"a": 12.0, "smooth": 11.0, "": 0.0}, {"a": 1.0}, None),
        ({"a": 12.0, "smooth": 2.0, "": 14.0}, {"a": 1.0}, None),
        ({"a": 90.0, "smooth": 2.0, "": 0.0}, {"a": -11.0}, None),
        ({"a": 12.0, "b": 20.0, "smooth": 2.0, "": 0.0}, {"a": 1.0, "b": -4.0}, "b"),
        ({"a": 12.0, "b": 20.0, "smooth": 2.0, "": 0.0}, {"a": 1.0, "b": -9.0}, "a"),
        ({"a": 12.0, "s": 11.0, "smooth": 2.0, "": 0.0}, {"a": 1.0, "s": 0.0}, "a"),
        ({"a": 12.0, "s": 13.0, "smooth": 2.0, "": 0.0}, {"a": 1.0, "s": 0.0}, None),
    ],
)
def test_held_out_data_decide_between_a_term_and_a_smooth_force(monkeypatch, scores, leads, chosen):
    """Log odds of the fitted data and log scores of held-out data add; odds of 20, times those asked, are wanted.

    `s` is a delay of a sensor: where it explains all data better, they do not decide for the force.
    """
    weights = {k: 50.0 if k else 0.0 for k in ("", *leads)}
    outcome = make_outcome(monkeypatch, weights, scores, leads, set(leads))
    found = confirming.decide_by_heldout(outcome, ())
    assert (found and found[0].key) == chosen


@pytest.mark.parametrize(("weight", "chosen"), [(90.0, "a"), (70.0, "ab")])
def test_a_term_that_stood_for_a_further_one_is_not_kept_beside_it(monkeypatch, weight, chosen):
    """`b` was chosen first, `a` is to be added: without `b` the set has more weight, or less."""
    weights = {"": 0.0, "b": 30.0, "a": weight, "ab": 80.0}
    scores = {k: 20.0 * ("a" in k) for k in weights}
    outcome = make_outcome(monkeypatch, weights, scores, dict.fromkeys(weights, 1.0), {"a"}, begun="b")
    fit, gains = confirming.decide_by_heldout(outcome, ())
    assert fit.key == chosen
    assert gains == {frozenset(chosen): 20.0}


@pytest.mark.parametrize(("probability", "kept"), [(0.3, True), (0.01, False)])
def test_a_set_with_a_term_that_is_less_probable_than_a_rival_is_not_taken(probability, kept):
    selection = SimpleNamespace(inclusion=lambda key: probability)
    d = SimpleNamespace(explains=True, settings=DEFAULT, named=("a",), selection=selection)
    trial = SimpleNamespace(diagnosis=d, before=prediction(0.3, [0.0]), after=prediction(0.1, [0.0]))
    assert bool(ways._keep_good(trial)) == kept


@pytest.mark.parametrize(("less", "scattered", "taken"), [(0.9, 0.05, "a"), (0.995, 1e-4, None)])
def test_of_sets_that_explain_what_was_fitted_the_one_that_predicts_better_is_taken(
    monkeypatch, less, scattered, taken
):
    """Ten parts, errors that scatter by 5 %: one set errs by a tenth less, one by a tenth more, one as much. Seeded.

    An error that is lower by half a percent in each part is significant, and no reason to replace a set.
    """
    rng = np.random.default_rng(3)
    factors = {"ab": 1.0, "a": less, "b": 1.1, "c": 1.0}
    monkeypatch.setattr(RobustChecks, "list_vague", lambda self, term_set: [])
    problem = SimpleNamespace(keys=(RANDOM,))
    fits = {k: SimpleNamespace(status="converged", key=k, problem=problem, theta=np.zeros(1)) for k in ("", *factors)}
    fitted_sets = {frozenset(k): TermSet(frozenset(k), fit, 50.0 if k else 0.0) for k, fit in fits.items()}
    chosen = SimpleNamespace(problem=SimpleNamespace(active=frozenset("ab")))
    expansion = SimpleNamespace(find_best=lambda worse: SimpleNamespace(gain=1e3), inflation=2.0)
    selection = SimpleNamespace(
        chosen=chosen,
        nominal=fits[""],
        fitted_sets=fitted_sets,
        declined=set(),
        expansion=lambda term_set: expansion,
        discrepancy_fit=lambda term_set: None,
        probabilities=dict,
    )
    d = SimpleNamespace(selection=selection, learned=None, unexplained=True, held=(), settings=DEFAULT)
    scatter = np.exp(scattered * rng.standard_normal((len(factors), PARTS)))
    told = {k: factors[k] * row for k, row in zip(factors, scatter, strict=True)}
    monkeypatch.setattr(confirming, "cut_heldout", lambda observations, held: ())
    monkeypatch.setattr(confirming, "compute_run_errors", lambda fit, pieces, horizon: told[fit.key])
    monkeypatch.setattr(confirming, "score_heldout", lambda fit, pieces: {"a": 9.0, "": 3.0}[fit.key])
    outcome = SimpleNamespace(diagnosis=d, horizon=None)
    found = confirming.find_better_set(outcome, ())
    assert (found and found[0].key) == taken
    refuted = {frozenset("b"): -np.inf, frozenset("c"): -np.inf}
    told_gains = {**refuted, frozenset("a"): 3.0}
    assert not found or found[1] == told_gains, "the difference in log score, divided by the inflation"
    fits["a"].theta = np.ones(1)
    assert confirming.find_better_set(outcome, ()) is None, "it leaves more of a random force than the nominal model"
    fits["a"].theta, fitted_sets[frozenset("a")] = np.zeros(1), TermSet(frozenset("a"), fits["a"], 20.0)
    assert confirming.find_better_set(outcome, ()) is None, "it explains less than half of what the chosen set does"
    fitted_sets[frozenset("a")] = TermSet(frozenset("a"), fits["a"], 50.0)
    told["a"] = told["c"]
    assert confirming.find_better_set(outcome, ()) is None
    told["a"], d.unexplained = 0.5 * told["c"], False
    expansion.find_best = lambda worse: SimpleNamespace(gain=0.0)
    assert confirming.find_better_set(outcome, ()) is None, "where the model is right else, likelihood decides"


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
