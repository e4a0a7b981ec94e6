"""What a term costs before any recording is seen, and which terms are relatives."""

from __future__ import annotations

import math

from lostmotion.contracts import Term
from lostmotion.settings import DEFAULT, Settings


def are_related(one: Term, other: Term) -> bool:
    """Return whether two terms tell the same story at the same place."""
    return one.at == other.at and (other.name in one.resembles or one.name in other.resembles)


def compute_penalty(term: Term, many: int, settings: Settings = DEFAULT) -> float:
    """Return the log price of a term by the prior: one of `many`, a factor e, its further parameters and choices.

    What an engineer looks for last costs more (`Term.unlikely`).
    """
    choices = [len(q.choices) for q in term.params if q.choices]
    further = len(term.params) - len(choices) - 1
    return (
        math.log(max(many, 1))
        + 1.0
        + term.unlikely
        + settings.select.further * further
        + sum(math.log(count) for count in choices)
    )
