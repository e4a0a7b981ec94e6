"""Rules of the words name facts that exist, and are silent where one of them is absent."""

from dataclasses import fields

import pytest
from made_facts import FRICTION, make_facts, make_found

from lostmotion.diagnosis import notes, states
from lostmotion.diagnosis.facts import Doubt, Facts, Remark, Support

REMARKS = {name: one for name, one in vars(notes).items() if isinstance(one, Remark)}
DOUBTS = {name: one for name, one in vars(states).items() if isinstance(one, Doubt)}


@pytest.mark.parametrize("rule", REMARKS.values(), ids=REMARKS)
def test_a_remark_requires_facts_that_exist_and_is_silent_without_them(rule):
    assert set(rule.requires) <= {one.name for one in fields(Facts)}
    assert not rule.requires or rule.write(make_facts()) == ()


@pytest.mark.parametrize("rule", DOUBTS.values(), ids=DOUBTS)
def test_a_doubt_requires_support_that_exists_and_is_silent_without_it(rule):
    assert set(rule.requires) <= {one.name for one in fields(Support)}
    found = make_found(FRICTION)
    assert not rule.requires or rule.write(make_facts(found), found) == ()


def test_each_remark_is_among_the_notes_or_the_first_sentences():
    assert set(REMARKS.values()) - {*notes.NOTES} == {notes.note_large_noise}
