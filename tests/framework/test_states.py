"""Named, likely, open: how sure a diagnosis is, what held-out data may veto, and what is withheld."""

from types import SimpleNamespace

import numpy as np
import pytest

from lostmotion.codec import to_plain
from lostmotion.diagnosis import confirming
from lostmotion.diagnosis import run as ways
from lostmotion.diagnosis.compare import PARTS, is_better, is_worse
from lostmotion.diagnosis.confirming import describe_usual_delay
from lostmotion.diagnosis.findings import withhold_intervals
from lostmotion.diagnosis.states import (
    LIKELY,
    NAMED,
    OPEN,
    choose_state,
    is_valid,
    limit_confidence,
    list_open_terms,
    list_warnings,
    sort_findings,
    warn_of_moved_amplitudes,
)
from lostmotion.inference.robustness import RobustChecks
from lostmotion.inference.term_sets import SimplestTerms, TermSet
from lostmotion.likelihood.problem import RANDOM
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Mechanism
from lostmotion.settings import DEFAULT
from lostmotion_plugins.terms.bodies import InertiaChange
from lostmotion_plugins.terms.drive import ExcitationDelay
from lostmotion_plugins.terms.friction import CoulombFriction

FRICTION, DELAY, CHANGE = "coulomb_friction@ground", "excitation_delay@drive", "inertia_change@ground"


def fit_of(values, active, sds=None):
    terms = (CoulombFriction(at="ground"), ExcitationDelay(at="drive"), InertiaChange(at="ground"))
    system = SimpleNamespace(keys=(FRICTION, DELAY, CHANGE), terms=terms)
    slots = {
        FRICTION: [SimpleNamespace(key=f"{FRICTION}.force", param=CoulombFriction.params[0])],
        DELAY: [SimpleNamespace(key=f"{DELAY}.delay", param=ExcitationDelay.params[0])],
        CHANGE: [SimpleNamespace(key=f"{CHANGE}.{q.name}", param=q) for q in InertiaChange.params],
    }
    system.own = slots
    free = [SimpleNamespace(key=k, log=False, unit="N" if "force" in k else "s") for k in values]
    problem = SimpleNamespace(system=system, active=frozenset(active), free=free, scales=SimpleNamespace(time=1.0))
    problem.observations = (SimpleNamespace(time=np.arange(100.0), samples=100, dt=1.0),)
    sds = sds or dict.fromkeys(values, 0.01)
    return SimpleNamespace(problem=problem, values=values, sd=sds, log_evidence=0.0)


def missing(size):
    """What is told of a force that is missing, here of a given standard deviation."""
    return SimpleNamespace(missing=SimpleNamespace(force=np.array([size, -size])))


def diagnosis(after, probabilities, fitted_sets=None, **course):
    sets = {frozenset(k): p for k, p in probabilities.items()}
    selection = SimpleNamespace(
        chosen=after,
        fitted_sets={frozenset(k): SimpleNamespace(fit=f) for k, f in (fitted_sets or {}).items()}
        | course.get("weights", {}),
        gain=lambda key: 10.0,
        probabilities=lambda: sets,
        inclusion=lambda key: sum(p for terms, p in sets.items() if key in terms),
        tied=course.get("tied", set()),
        declined=course.get("declined", set()),
        heldout_gains=course.get("heldout_gains", {}),
        simplest=course.get("simplest"),
        withdrawn=frozenset(),
    )
    found = tuple(after.problem.active)
    return SimpleNamespace(
        selection=selection,
        after=after,
        before=after,
        found=found,
        named=found,
        learned=course.get("learned"),
        left=course.get("left"),
        located=missing(1.0),
        unexplained=course.get("left") is not None,
        withdrawn=course.get("withdrawn", ()),
        settings=DEFAULT,
    )


@pytest.fixture(autouse=True)
def _slots(monkeypatch):
    def term_of(problem, key):
        system = problem.system
        return system.terms[system.keys.index(key)], system.own[key]

    monkeypatch.setattr("lostmotion.diagnosis.states.find_term", term_of)
    monkeypatch.setattr("lostmotion.diagnosis.confirming.find_term", term_of)


@pytest.mark.parametrize(("gain", "sure"), [(29.0, False), (31.0, True)])
def test_a_name_has_to_win_three_times_what_has_no_name_beside_it(gain, sure):
    after = fit_of({f"{FRICTION}.force": 1.0}, [FRICTION])
    weights = {frozenset({FRICTION}): SimpleNamespace(weight=gain), frozenset(): SimpleNamespace(weight=0.0)}
    d = diagnosis(after, {(FRICTION,): 1.0}, weights=weights, learned=SimpleNamespace(gain=10.0))
    doubts = list_warnings(d, FRICTION)
    assert doubts == [] if sure else ["29 in log evidence" in doubt for doubt in doubts] == [True]


@pytest.mark.parametrize(("time", "sure"), [(3.0, False), (50.0, True)])
def test_a_change_at_the_very_beginning_may_be_a_wrong_known_value(time, sure):
    after = fit_of({f"{CHANGE}.change": 1.0, f"{CHANGE}.time": time}, [CHANGE])
    doubts = list_warnings(diagnosis(after, {(CHANGE,): 1.0}), CHANGE)
    assert doubts == [] if sure else ["first 3 % of the recording" in doubt for doubt in doubts] == [True]


@pytest.mark.parametrize(("left", "sure"), [(0.6, False), (0.4, True)])
def test_a_name_that_leaves_most_of_the_force_missing_is_likely(left, sure):
    after = fit_of({f"{FRICTION}.force": 1.0}, [FRICTION])
    doubts = list_warnings(diagnosis(after, {(FRICTION,): 1.0}, left=missing(left)), FRICTION)
    assert doubts == [] if sure else ["60 % of the missing force is still" in doubt for doubt in doubts] == [True]


@pytest.mark.parametrize(
    ("left", "valid", "doubts", "state"),
    [
        (0.6, False, ["why"], "open"),
        (0.4, False, ["why"], "likely"),
        (0.6, True, ["why"], "likely"),
        (0.4, True, [], "named"),
    ],
)
def test_a_term_that_leaves_most_of_the_force_missing_in_a_model_that_is_not_valid_is_open(left, valid, doubts, state):
    after = fit_of({f"{FRICTION}.force": 1.0}, [FRICTION])
    assert choose_state(diagnosis(after, {(FRICTION,): 1.0}, left=missing(left)), doubts, valid=valid) == state


def test_a_sure_term_is_named_and_one_with_rivals_is_not():
    after = fit_of({f"{FRICTION}.force": 1.0}, [FRICTION])
    assert list_warnings(diagnosis(after, {(FRICTION,): 0.99, (): 0.01}), FRICTION) == []
    (doubt,) = list_warnings(diagnosis(after, {(FRICTION,): 0.8, (DELAY,): 0.2}), FRICTION)
    assert doubt == "Its probability is 0.8; the alternative is excitation delay."
    (doubt,) = list_warnings(diagnosis(after, {(FRICTION,): 0.8, (): 0.2}), FRICTION)
    assert doubt.endswith("the alternative is a generic smooth force.")


@pytest.mark.parametrize(
    ("gain", "told"),
    [
        (12.34, "held-out data decide for the term, by 12 in log score."),
        (0.0, "free runs over held-out data decide for the term."),
    ],
)
def test_a_term_for_which_held_out_data_decide_is_told_so(gain, told):
    after, sets = fit_of({f"{FRICTION}.force": 1.0}, [FRICTION]), {(FRICTION,): 0.99, (): 0.01}
    (doubt,) = list_warnings(
        diagnosis(after, sets, tied={FRICTION}, heldout_gains={frozenset({FRICTION}): gain}), FRICTION
    )
    assert doubt.endswith(told)


@pytest.mark.parametrize(("behind", "sure"), [(2.0, False), (4.0, True)])
def test_another_cause_that_explains_the_fitted_data_as_well_is_a_doubt(behind, sure):
    """A delay and a friction are no relatives: which of them it is was decided by prior odds alone."""
    after, other = fit_of({f"{FRICTION}.force": 1.0}, [FRICTION]), fit_of({f"{DELAY}.delay": 1.0}, [DELAY])
    other.log_evidence = -behind
    doubts = list_warnings(diagnosis(after, {(FRICTION,): 0.99, (DELAY,): 0.01}, {(DELAY,): other}), FRICTION)
    assert doubts == [] if sure else ["Excitation delay explains the fitted data as well" in doubts[0]] == [True]


def test_a_set_without_the_term_that_is_a_part_of_what_was_found_is_no_other_cause():
    after = fit_of({f"{FRICTION}.force": 1.0, f"{CHANGE}.time": 50.0}, [FRICTION, CHANGE])
    part = fit_of({f"{CHANGE}.time": 50.0}, [CHANGE])
    assert list_warnings(diagnosis(after, {(FRICTION, CHANGE): 0.99}, {(CHANGE,): part}), FRICTION) == []


def test_the_simplest_explanation_is_likely_and_says_why():
    after = fit_of({f"{FRICTION}.force": 1.0}, [FRICTION])
    (doubt,) = list_warnings(
        diagnosis(after, {(FRICTION,): 0.45}, simplest=SimplestTerms({FRICTION: 0.45}, 30.0)), FRICTION
    )
    assert "better than any learned curve" in doubt
    assert doubt.endswith("its probability is 0.45.")


def test_a_simplest_explanation_lists_what_these_data_cannot_distinguish():
    """Terms with less than a twentieth of its probability are left out."""
    after, simplest = fit_of({f"{DELAY}.delay": 0.2}, [DELAY]), {DELAY: 0.3, FRICTION: 0.19, CHANGE: 0.01}
    d = diagnosis(after, {(DELAY,): 0.3}, simplest=SimplestTerms(simplest, 30.0))
    why, usual = list_warnings(d, DELAY)
    assert why.endswith("it cannot be distinguished from: Coulomb friction.")
    assert usual.startswith("A delay of 0.2 samples is usual in acquisition systems")


def test_a_long_delay_is_no_more_than_likely():
    period = 2.0 * np.pi
    for share, doubts in ((0.5 * DEFAULT.name.late, 0), (2.0 * DEFAULT.name.late, 1)):
        after = fit_of({f"{DELAY}.delay": share * period}, [DELAY])
        assert len(list_warnings(diagnosis(after, {(DELAY,): 1.0}), DELAY)) == doubts


def test_a_level_that_moves_when_a_delay_comes_in_is_told_and_the_delay_doubted():
    after = fit_of({f"{FRICTION}.force": 0.27, f"{DELAY}.delay": 0.01}, [FRICTION, DELAY])
    before = fit_of({f"{FRICTION}.force": 0.68}, [FRICTION])
    d = diagnosis(after, {(FRICTION, DELAY): 1.0}, {(FRICTION,): before})
    (told,) = warn_of_moved_amplitudes(d, DELAY)
    assert "0.68 N without excitation delay and 0.27 N with it" in told
    assert list_warnings(d, DELAY) == [told]
    assert list_warnings(d, FRICTION) == []
    still = fit_of({f"{FRICTION}.force": 0.28}, [FRICTION])
    assert not list(warn_of_moved_amplitudes(diagnosis(after, {(FRICTION, DELAY): 1.0}, {(FRICTION,): still}), DELAY))


def test_what_stays_open_is_told_with_the_reason_once():
    after = fit_of({}, [])
    d = diagnosis(after, {(): 1.0}, tied={FRICTION}, declined={FRICTION, DELAY}, withdrawn=("unknown",))
    rows = list_open_terms(d)
    assert [row.mechanism for row in rows] == ["coulomb_friction", "excitation_delay"]
    assert "generic smooth force explains as much" in rows[0].says
    assert "residuals are autocorrelated" in rows[1].says


@pytest.mark.parametrize(("error", "floor", "good"), [(0.2, 0.01, True), (0.35, 0.1, True), (5.92, 0.01, False),
                                                     (float("nan"), 0.1, False)])  # fmt: skip
def test_a_model_holds_that_predicts(error, floor, good):
    assert is_valid(SimpleNamespace(nrmse=error), floor) is good


def test_intervals_are_withheld_with_the_reason():
    told = {"c": Interval(1.0, 0.9, 1.1, "N s/m")}
    assert withhold_intervals(told, "") == told
    kept = to_plain(withhold_intervals(told, "because")["c"])
    assert kept == {"median": 1.0, "low": None, "high": None, "unit": "N s/m", "withheld": "because"}


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


def test_what_makes_predictions_worse_is_taken_back_until_they_are_not(monkeypatch):
    errors = {("a", "b", "curve"): 0.5, ("a", "b"): 0.4, ("a",): 0.1, (): 0.3}

    def compare_heldout(d, prepared):
        return SimpleNamespace(diagnosis=d, before=prediction(0.3, [0.0]), after=prediction(errors[d.found], [0.0]))

    def simpler(d, rng):
        return SimpleNamespace(
            found=d.found[:-1], withdrawn=(*d.withdrawn, d.found[-1]), explains=True, settings=DEFAULT
        )

    monkeypatch.setattr(ways, "compare_heldout", compare_heldout)
    monkeypatch.setattr(ways, "drop_least_probable", simpler)
    monkeypatch.setattr(ways, "find_better_set", lambda outcome, observations: None)
    monkeypatch.setattr(ways, "decide_by_heldout", lambda outcome, observations: None)
    monkeypatch.setattr(ways, "find_simplest", lambda outcome, observations: None)
    start = SimpleNamespace(found=("a", "b", "curve"), withdrawn=(), explains=True, settings=DEFAULT)
    outcome = ways.check_heldout(start, SimpleNamespace(observations=()), np.random.default_rng(0))
    assert outcome.diagnosis.found == ("a",)
    assert outcome.diagnosis.withdrawn == ("curve", "b")


NOTHING = SimpleNamespace(active=frozenset())


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
    fits = {k: SimpleNamespace(status="converged", key=k, problem=NOTHING) for k in scores}
    fitted_sets = {frozenset(k): TermSet(frozenset(k), fits[k], 50.0 if k else 0.0) for k in ("", *leads)}
    selection = SimpleNamespace(
        chosen=SimpleNamespace(problem=SimpleNamespace(active=frozenset())),
        fitted_sets=fitted_sets,
        tied=set(leads),
        compute_log_odds=lambda term_set, here: leads["".join(term_set.terms)],
        fit_discrepancy=lambda term_set: None,
        discrepancy_fit=lambda term_set: SimpleNamespace(fit=fits["smooth"], corrected=None),
        expansion=lambda term_set: SimpleNamespace(inflation=1.0),
    )
    monkeypatch.setattr(confirming, "find_term", lambda problem, key: (SimpleNamespace(usual=key == "s"), ()))
    monkeypatch.setattr(confirming, "score_heldout", lambda fit, pieces: scores[fit.key])
    monkeypatch.setattr(confirming, "cut_heldout", lambda observations, held: ())
    d = SimpleNamespace(selection=selection, learned=None, held=(), settings=DEFAULT)
    found = confirming.decide_by_heldout(SimpleNamespace(diagnosis=d), ())
    assert (found and found[0].key) == chosen


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


@pytest.mark.parametrize(("delay", "told"), [(0.004, True), (0.006, False)])
def test_a_delay_of_less_than_half_a_sample_is_usual(delay, told):
    fit = fit_of({f"{DELAY}.delay": delay}, {DELAY})
    fit.problem.observations = (SimpleNamespace(dt=0.01),)
    d = SimpleNamespace(after=fit, values=fit.values, settings=DEFAULT)
    assert bool(describe_usual_delay(d, DELAY)) == told


def entry(**told):
    return Mechanism(parameters={}, says="It acts.", **told)


def test_what_is_doubted_is_likely_and_comes_behind_what_is_named():
    entries = [
        entry(mechanism="unknown", state=OPEN, probability=1.0),
        entry(mechanism="offset_force", state=NAMED, probability=0.999, doubts=("why",)),
        entry(mechanism="coulomb_friction", state=NAMED, probability=0.97),
    ]
    told = sort_findings([limit_confidence(one) for one in entries])
    assert [one.mechanism for one in told] == ["coulomb_friction", "offset_force", "unknown"]
    assert [one.state for one in told] == [NAMED, LIKELY, OPEN]
    assert [one.probability for one in told] == [0.97, DEFAULT.name.sure, 1.0]
