"""Named, likely, open: how sure a diagnosis is, and what is withheld."""

import math
from types import SimpleNamespace

import pytest
from made_explanations import (
    CHANGE,
    DELAY,
    FRICTION,
    STRIBECK,
    diagnosis,
    explanations,
    fit_of,
    hypothesis,
    missing,
)

from lostmotion.codec import to_plain
from lostmotion.diagnosis.findings import withhold_intervals
from lostmotion.diagnosis.states import (
    LIKELY,
    NAMED,
    OPEN,
    choose_state,
    compute_gain,
    compute_probability,
    is_valid,
    limit_confidence,
    list_open_terms,
    list_warnings,
    sort_findings,
    warn_of_moved_amplitudes,
    warn_of_short_delay,
)
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Mechanism
from lostmotion.settings import DEFAULT

RUB = {f"{FRICTION}.force": 1.0}
BRISTLES = {f"{STRIBECK}.force": 1.0, f"{STRIBECK}.excess": 0.5, f"{STRIBECK}.velocity": 0.1}
LATE = {f"{DELAY}.delay": 0.2}


def rubbing(score=10.0, **more):
    """Return a diagnosis that found friction with a score of so much over nothing missing."""
    return diagnosis(explanations(hypothesis(RUB, score)), **more)


@pytest.mark.parametrize(("time", "sure"), [(3.0, False), (50.0, True)])
def test_a_change_at_the_very_beginning_may_be_a_wrong_known_value(time, sure):
    change = hypothesis({f"{CHANGE}.change": 1.0, f"{CHANGE}.time": time}, 10.0)
    doubts = list_warnings(diagnosis(explanations(change)), CHANGE)
    assert doubts == [] if sure else ["first 3 % of the recording" in doubt for doubt in doubts] == [True]


@pytest.mark.parametrize(("more", "sure"), [(12.0, False), (8.0, True)])
def test_a_further_name_beside_a_discrepancy_that_explains_more_is_likely(more, sure):
    both = hypothesis({**RUB, **LATE}, 30.0)
    told = explanations(hypothesis(RUB, 20.0), hypothesis(LATE, 1.0), both, discrepancy=more)
    said = ["add 12 to the log evidence, this term 10" in d for d in list_warnings(diagnosis(told), DELAY)]
    assert said == ([] if sure else [True])
    assert list_warnings(diagnosis(told), FRICTION) == []


def test_a_single_name_needs_its_probability_only():
    assert list_warnings(diagnosis(explanations(hypothesis(RUB, 10.0), discrepancy=300.0)), FRICTION) == []


@pytest.mark.parametrize(("error", "shared"), [(10.1, True), (10.4, False)])
def test_laws_that_predict_the_same_readings_share_their_probability(error, shared):
    """100 predictions that differ by 0.1 standard deviations are expected to give 0.5, by 0.4 they give 8."""
    rubbed = hypothesis(RUB, 10.0)
    told = explanations(rubbed, hypothesis({f"{CHANGE}.change": 1.0}, 4.0, error=error))
    assert told.inclusion(FRICTION) == pytest.approx(0.5 if shared else 1.0, abs=0.01)


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
    assert choose_state(rubbing(left=missing(left)), doubts, valid=valid) == state


def test_a_sure_term_is_named():
    assert list_warnings(rubbing(math.log(99.0)), FRICTION) == []


def test_a_term_with_an_alternative_is_not_named_and_says_which():
    d = diagnosis(explanations(hypothesis(RUB, 20.0), hypothesis(LATE, 20.0 - math.log(4.0))))
    assert compute_probability(d, FRICTION) == pytest.approx(0.8)
    (doubt,) = list_warnings(d, FRICTION)
    assert doubt == "Its probability is 0.8; the alternative is excitation delay. Together they have the probability 1."


def test_a_term_that_nothing_missing_rivals_is_not_named():
    (doubt,) = list_warnings(rubbing(math.log(4.0)), FRICTION)
    assert doubt == "Its probability is 0.8; the alternative is a small smooth force without a name."


def test_a_law_that_contains_the_term_counts_for_it():
    """Where friction grows towards rest, there is friction; a delay says nothing about friction."""
    d = diagnosis(explanations(hypothesis(RUB, 20.0), hypothesis(BRISTLES, 20.0)))
    assert compute_probability(d, FRICTION) == pytest.approx(1.0)
    assert list_warnings(d, FRICTION) == []
    d = diagnosis(explanations(hypothesis(RUB, 20.0), hypothesis(LATE, 20.0)))
    assert compute_probability(d, FRICTION) == pytest.approx(0.5)


def test_an_unknown_force_beside_a_term_is_a_doubt():
    with_it = hypothesis(RUB, 20.0 - math.log(9.0), unknown=True)
    (doubt,) = list_warnings(diagnosis(explanations(hypothesis(RUB, 20.0), with_it)), FRICTION)
    assert "an unknown force" in doubt
    assert "the probability 0.1" in doubt
    rare = hypothesis(RUB, 20.0 - math.log(99.0), unknown=True)
    assert list_warnings(diagnosis(explanations(hypothesis(RUB, 20.0), rare)), FRICTION) == []


@pytest.mark.parametrize(("sd", "sure"), [(0.6, False), (0.4, True)])
def test_a_size_whose_interval_reaches_zero_is_a_doubt(sd, sure):
    doubts = list_warnings(diagnosis(explanations(hypothesis(RUB, 10.0, sd=sd))), FRICTION)
    assert doubts == [] if sure else ["interval of its force reaches zero" in doubt for doubt in doubts] == [True]


def test_the_gain_of_a_found_term_is_that_beside_the_others():
    both = hypothesis(RUB | LATE, 30.0)
    d = diagnosis(explanations(both, hypothesis(RUB, 20.0), hypothesis(LATE, 5.0)))
    assert compute_gain(d, DELAY) == pytest.approx(10.0)
    assert compute_gain(d, FRICTION) == pytest.approx(25.0)


def test_a_long_delay_is_no_doubt():
    for share in (0.01, 0.5):
        d = diagnosis(explanations(hypothesis({f"{DELAY}.delay": share * 2.0 * math.pi}, 10.0)))
        assert list_warnings(d, DELAY) == []


def test_a_level_that_moves_when_a_delay_comes_in_is_told_and_the_delay_doubted():
    both = hypothesis({f"{FRICTION}.force": 0.27, f"{DELAY}.delay": 0.1}, 40.0)
    d = diagnosis(explanations(both, hypothesis({f"{FRICTION}.force": 0.68}, 20.0)))
    (told,) = warn_of_moved_amplitudes(d, DELAY)
    assert "0.68 N without excitation delay and 0.27 N with it" in told
    assert list_warnings(d, DELAY) == [told]
    assert list_warnings(d, FRICTION) == []
    still = diagnosis(explanations(both, hypothesis({f"{FRICTION}.force": 0.28}, 20.0)))
    assert list(warn_of_moved_amplitudes(still, DELAY)) == []


def test_what_stays_open_is_told_with_the_reason_once():
    alone = (fit_of(RUB, log_evidence=30.0), fit_of(LATE, log_evidence=25.0))
    d = diagnosis(explanations(fits=alone), withdrawn=(DELAY, "unknown"))
    rows = list_open_terms(d)
    assert [row.mechanism for row in rows] == ["excitation_delay", "coulomb_friction"]
    assert "held-out data are predicted worse" in rows[0].says
    assert "generic smooth force explains as much" in rows[1].says


@pytest.mark.parametrize(("gain", "open_"), [(0.9, False), (1.1, True)])
def test_a_term_is_open_if_it_alone_would_raise_the_evidence_by_much(gain, open_):
    alone = fit_of(RUB, log_evidence=gain * DEFAULT.rival.much)
    assert bool(list_open_terms(diagnosis(explanations(fits=(alone,))))) is open_
    likely = explanations(hypothesis(RUB, -math.log(9.0)), fits=(alone,))
    assert list_open_terms(diagnosis(likely)) == ()


@pytest.mark.parametrize(("error", "floor", "good"), [(0.2, 0.01, True), (0.35, 0.1, True), (5.92, 0.01, False),
                                                     (float("nan"), 0.1, False)])  # fmt: skip
def test_a_model_holds_that_predicts(error, floor, good):
    assert is_valid(SimpleNamespace(nrmse=error), floor) is good


def test_intervals_are_withheld_with_the_reason():
    told = {"c": Interval(1.0, 0.9, 1.1, "N s/m")}
    assert withhold_intervals(told, "") == told
    kept = to_plain(withhold_intervals(told, "because")["c"])
    assert kept == {"median": 1.0, "low": None, "high": None, "unit": "N s/m", "withheld": "because"}


@pytest.mark.parametrize(("delay", "told"), [(0.9, True), (1.1, False)])
def test_a_delay_of_no_more_than_a_sample_is_usual(delay, told):
    """Samples are 1 s apart."""
    d = diagnosis(explanations(hypothesis({f"{DELAY}.delay": delay}, 10.0)))
    assert bool(list(warn_of_short_delay(d, DELAY))) == told
    assert not list(warn_of_short_delay(rubbing(), FRICTION))


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
