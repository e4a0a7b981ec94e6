"""What the author of a term or a parameter declares stays few: what an algorithm needs is computed, or in a table."""

from dataclasses import fields

from lostmotion.contracts import Param, Term

MOST_OF_A_TERM, MOST_OF_A_PARAMETER = 10, 8


def test_a_term_declares_few_things():
    declared = set(Term.__annotations__)
    assert len(declared) <= MOST_OF_A_TERM, declared


def test_a_parameter_declares_few_things():
    declared = [one.name for one in fields(Param)]
    assert len(declared) <= MOST_OF_A_PARAMETER, declared
