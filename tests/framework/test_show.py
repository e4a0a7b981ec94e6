"""The table of before, after and noise floor, and its sentences."""

from dataclasses import astuple

import pytest
import report_fixture as made

from lostmotion.codec import from_plain, to_plain
from lostmotion.diagnosis.report import behaviour_table
from lostmotion.diagnosis.show_words import describe_behaviour
from lostmotion.results.behaviour import Behaviour


def facts_with(augmented=True, d2=None):
    """Return a diagnosis with the sentences of the measures as they are written; `d2` in place of its dimensions."""
    facts = (made.mismatch if augmented else made.adequate)()
    columns = [name for name in ("before", "after", "noise_floor") if name in facts["show"]]
    facts["show"] |= {name: facts["show"][name] | ({"d2": d2} if d2 else {}) for name in columns}
    facts["show"]["says"] = to_plain(sentences(from_plain(Behaviour, facts["show"])))
    return facts


def sentences(measured, strobed=True, **options):
    """Return a sentence on each measure of the last model."""
    return describe_behaviour(
        measured.after or measured.before, measured.noise_floor, measured.horizon, strobed, **options
    )


def plain(text):
    return text.replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(("free", "how"), [(False, "under the recorded drive"), (True, "without a drive")])
def test_an_exponent_says_what_drove_the_model(free, how):
    says = sentences(from_plain(Behaviour, made.show()), not free, driven=not free)
    assert says.largest_exponent.startswith(f"Of the model {how}")


def test_what_could_not_be_measured_keeps_its_sentence():
    refused = {"value": None, "low": None, "high": None, "status": "too_short", "says": "Too few periods."}
    facts = facts_with(d2=refused)
    row = next(r for r in behaviour_table.make_table(made.evidence(facts)).rows if r[0] == "Correlation dimension")
    assert row[1:4] == ["–"] * 3
    assert "Too few periods." in row[4]


def test_table_of_the_report_has_every_measure_with_a_sentence():
    table = behaviour_table.make_table(made.evidence(facts_with()))
    assert [row[0].partition(" (")[0] for row in table.rows] == list(astuple(behaviour_table.MEASURE_NAMES))
    assert all(row[-1].endswith(".") for row in table.rows)
    distance = next(row for row in table.rows if row[0] == "Distance between attractors")
    assert [plain(cell) for cell in distance[1:4]] == ["0.3 (p = 0.005)", "0.02 (p = 0.4)", "0.01 (p = 0.5)"]
    exponent = next(row for row in table.rows if row[0] == "Largest exponent (1/s)")
    assert plain(exponent[1]) == "1.00 [0.80, 1.20]"


def test_table_of_an_adequate_model_has_one_model():
    table = behaviour_table.make_table(made.evidence(facts_with(augmented=False)))
    assert table.head[1] == "Nominal model"
    assert all(len(row) == len(table.head) for row in table.rows)


def test_a_model_whose_motion_was_not_measured_has_dashes():
    facts = facts_with()
    del facts["show"]["after"]
    table = behaviour_table.make_table(made.evidence(facts))
    assert table.head[1:4] == ["Before", "After", "Noise floor or recording"]
    assert {row[2] for row in table.rows} == {"–"}
