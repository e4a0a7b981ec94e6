"""Named, likely, open: how sure a diagnosis is, and what is withheld."""

from types import SimpleNamespace

import numpy as np
import pytest
from lostmotion.diagnosis.confirming import describe_usual_delay
from lostmotion.inference.term_sets import SimplestTerms

from lostmotion.codec import to_plain
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


@pytest.mark.parametrize(("curve", "than"), [(30.0, "any learned curve"), (0.0, "the model alone")])
def test_the_simplest_explanation_is_likely_and_says_why(curve, than):
    """A learned curve is mentioned where there was one."""
    after = fit_of({f"{FRICTION}.force": 1.0}, [FRICTION])
    (doubt,) = list_warnings(
        diagnosis(after, {(FRICTION,): 0.45}, simplest=SimplestTerms({FRICTION: 0.45}, curve, 0.55, 0.0)), FRICTION
    )
    assert f"better than {than} and predicts held-out data" in doubt
    assert doubt.endswith("its probability is 0.45.")


def test_a_simplest_explanation_lists_what_these_data_cannot_distinguish():
    """Terms with less than a twentieth of its probability are left out."""
    after, simplest = fit_of({f"{DELAY}.delay": 0.2}, [DELAY]), {DELAY: 0.3, FRICTION: 0.19, CHANGE: 0.01}
    d = diagnosis(after, {(DELAY,): 0.3}, simplest=SimplestTerms(simplest, 30.0, 0.5, 0.0))
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
