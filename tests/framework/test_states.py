"""Named, likely, open: how sure a diagnosis is, and what is withheld."""

import pytest
from made_facts import (
    CHANGE,
    DELAY,
    FRICTION,
    NOTHING,
    STRIBECK,
    WITH_UNKNOWN,
    make_change,
    make_facts,
    make_found,
    make_prediction,
    make_sensor,
)

from lostmotion.codec import to_plain
from lostmotion.diagnosis.findings import list_findings, withhold_intervals
from lostmotion.diagnosis.states import (
    LIKELY,
    NAMED,
    OPEN,
    choose_state,
    compute_probability,
    doubt_moved_amplitudes,
    doubt_short_delay,
    is_valid,
    limit_confidence,
    list_doubts,
    list_open_terms,
    sort_findings,
)
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Mechanism
from lostmotion.settings import DEFAULT

RUB, BRISTLES, LATE = (frozenset({name}) for name in (FRICTION, STRIBECK, DELAY))
FORCE = {"force": Interval(1.0, 0.9, 1.1, "N")}


def doubts_of(found, **changes):
    """Return the doubts about a term that alone was found."""
    return list_doubts(make_facts(found, **changes), found)


@pytest.mark.parametrize(("share", "sure"), [(0.03, False), (0.5, True)])
def test_a_change_at_the_very_beginning_may_be_a_wrong_known_value(share, sure):
    doubts = doubts_of(make_found(CHANGE, complete=(share,)))
    assert doubts == () if sure else ["first 3 % of the recording" in doubt for doubt in doubts] == [True]


@pytest.mark.parametrize(("after", "sure"), [(0.06, False), (0.05004, True), (0.04, True)])
def test_a_name_that_makes_free_runs_worse_is_likely(after, sure):
    """The errors that the page shows are 5 %, and 6 %, 5 % or 4 %."""
    predicted = {"before": make_prediction(0.05), "after": make_prediction(after)}
    said = ["rises from 5 % to 6 %" in doubt for doubt in doubts_of(make_found(FRICTION), **predicted)]
    assert said == ([] if sure else [True])


@pytest.mark.parametrize(
    ("left", "error", "doubts", "state"),
    [
        (0.6, 0.5, ["why"], "open"),
        (0.4, 0.5, ["why"], "likely"),
        (0.6, 0.01, ["why"], "likely"),
        (0.4, 0.01, [], "named"),
    ],
)
def test_a_term_that_leaves_most_of_the_force_missing_in_a_model_that_is_not_valid_is_open(left, error, doubts, state):
    facts = make_facts(make_found(FRICTION), after=make_prediction(error), remains=left)
    assert choose_state(facts, doubts) == state


def test_a_sure_term_is_named():
    assert doubts_of(make_found(FRICTION), sets={RUB: 0.99, NOTHING: 0.01}) == ()


def test_a_term_with_an_alternative_is_not_named_and_says_which():
    found = make_found(FRICTION)
    facts = make_facts(found, sets={RUB: 0.8, LATE: 0.2})
    assert compute_probability(facts, found) == pytest.approx(0.8)
    (doubt,) = list_doubts(facts, found)
    assert doubt == "Its probability is 0.8; the alternative is excitation delay. Together they have the probability 1."


def test_a_term_that_nothing_missing_rivals_is_not_named():
    (doubt,) = doubts_of(make_found(FRICTION), sets={RUB: 0.8, NOTHING: 0.2})
    assert doubt == "Its probability is 0.8; the alternative is a small smooth force without a name."


def test_a_law_that_contains_the_term_counts_for_it():
    """Where friction grows towards rest, there is friction; a delay says nothing about friction."""
    found = make_found(FRICTION)
    facts = make_facts(found, sets={RUB: 0.5, BRISTLES: 0.5})
    assert compute_probability(facts, found) == pytest.approx(1.0)
    assert list_doubts(facts, found) == ()
    assert compute_probability(make_facts(found, sets={RUB: 0.5, LATE: 0.5}), found) == pytest.approx(0.5)


def test_an_unknown_force_beside_a_term_is_a_doubt():
    found = make_found(FRICTION)
    (doubt,) = doubts_of(found, sets={RUB: 0.9, WITH_UNKNOWN: 0.1})
    assert "an unknown force" in doubt
    assert "the probability 0.1" in doubt
    assert doubts_of(found, sets={RUB: 0.99, WITH_UNKNOWN: 0.01}) == ()


def test_a_size_whose_interval_reaches_zero_is_a_doubt():
    (doubt,) = doubts_of(make_found(FRICTION, vague=("force",)))
    assert "interval of its force reaches zero" in doubt


def test_a_long_delay_is_no_doubt():
    assert doubts_of(make_found(DELAY, delay=60.0)) == ()


def test_a_level_that_moves_when_a_delay_comes_in_is_told_and_the_delay_doubted():
    late = make_found(DELAY, moved=(make_change(0.68, 0.27),))
    facts = make_facts(make_found(FRICTION, gain=40.0), late)
    (told,) = doubt_moved_amplitudes.write(facts, late)
    assert "0.68 N without excitation delay and 0.27 N with it" in told
    assert list_doubts(facts, late) == (told,)
    for still in (make_change(0.28, 0.27), make_change(0.68, 0.27, sd=0.1)):
        assert doubt_moved_amplitudes.write(facts, make_found(DELAY, moved=(still,))) == ()


def test_only_what_is_rare_or_acts_on_a_channel_is_doubted_because_it_moves_an_amplitude():
    rub = make_found(FRICTION, moved=(make_change(0.68, 0.27),))
    assert doubt_moved_amplitudes.write(make_facts(rub), rub)
    assert doubts_of(rub) == ()


def test_what_stays_open_is_told_with_the_reason_once():
    facts = make_facts(alone={FRICTION: 30.0, DELAY: 25.0}, withdrawn=(DELAY, "unknown"))
    rows = list_open_terms(facts)
    assert [row.mechanism for row in rows] == ["excitation_delay", "coulomb_friction"]
    assert "held-out data are predicted worse" in rows[0].says
    assert "generic smooth force explains as much" in rows[1].says


@pytest.mark.parametrize(("gain", "open_"), [(0.9, False), (1.1, True)])
def test_a_term_is_open_if_it_alone_would_raise_the_evidence_by_much(gain, open_):
    alone = {FRICTION: gain * DEFAULT.rival.much}
    assert bool(list_open_terms(make_facts(alone=alone))) is open_
    assert list_open_terms(make_facts(alone=alone, sets={NOTHING: 0.9, RUB: 0.1})) == ()
    assert list_open_terms(make_facts(alone=alone, learned=True)) == ()


def test_a_law_that_contains_a_found_one_does_not_stay_open():
    alone = {STRIBECK: 30.0}
    assert [row.mechanism for row in list_open_terms(make_facts(make_found(DELAY), alone=alone))] == [STRIBECK]
    assert list_open_terms(make_facts(make_found(FRICTION), alone=alone)) == ()


@pytest.mark.parametrize(("error", "noise", "good"), [(0.2, 0.01, True), (0.35, 0.1, True), (5.92, 0.01, False),
                                                     (float("nan"), 0.1, False)])  # fmt: skip
def test_a_model_holds_that_predicts(error, noise, good):
    assert is_valid(make_facts(after=make_prediction(error), sensors=(make_sensor(sd=noise),))) is good


def test_intervals_are_withheld_with_the_reason():
    told = {"c": Interval(1.0, 0.9, 1.1, "N s/m")}
    assert withhold_intervals(told, "") == told
    kept = to_plain(withhold_intervals(told, "because")["c"])
    assert kept == {"median": 1.0, "low": None, "high": None, "unit": "N s/m", "withheld": "because"}


def test_an_entry_has_its_sentence_and_in_a_model_that_does_not_predict_no_interval():
    found = make_found(FRICTION, parameters=FORCE, share=0.1)
    (entry,) = list_findings(make_facts(found))
    assert (entry.state, entry.doubts) == (NAMED, ())
    assert "1.000 N [0.900, 1.100]" in entry.says
    assert entry.says.endswith(", up to 10 % of the drive.")
    (entry,) = list_findings(make_facts(found, after=make_prediction(0.6), remains=0.9))
    assert (entry.state, entry.probability) == (OPEN, DEFAULT.name.simplest)
    assert "60 % of the response" in entry.doubts[0]
    assert "1 N opposes" in entry.says


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({}, []),
        ({"unexplained": True}, ["A random force acts."]),
        ({"after": make_prediction(0.6)}, ["The nominal model is not valid"]),
    ],
)
def test_a_force_without_a_name_is_an_entry_where_something_is_missing(changes, told):
    unnamed = Mechanism(
        mechanism="random_force", probability=0.9, state=OPEN, parameters={}, says="A random force acts."
    )
    entries = list_findings(make_facts(unnamed=unnamed, **changes))
    assert [entry.says[: len(said)] for entry, said in zip(entries, told, strict=True)] == told


@pytest.mark.parametrize(("delay", "told"), [(0.9, True), (1.1, False)])
def test_a_delay_of_no_more_than_a_sample_is_usual(delay, told):
    late = make_found(DELAY, delay=delay)
    assert bool(doubt_short_delay.write(make_facts(late), late)) == told
    whole = make_found(DELAY, delay=1.0)
    assert doubt_short_delay.write(make_facts(whole), whole)[0].startswith("A delay of 1 sample is usual")
    assert not doubt_short_delay.write(make_facts(late), make_found(FRICTION))


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
