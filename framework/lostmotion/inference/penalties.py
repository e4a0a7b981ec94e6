"""The prior penalty of a term, and which terms are related."""

from __future__ import annotations

import math

from lostmotion.contracts import Term
from lostmotion.defaults import RARE
from lostmotion.inference.late import compute_onset_price
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.posterior import Posterior
from lostmotion.settings import DEFAULT, Settings


def is_simpler(one: Term, other: Term) -> bool:
    """Return whether a term is a simpler law that another one at the same place contains."""
    return one.at == other.at and one.name in other.extends


def weigh_rarity(term: Term) -> float:
    """Return the log odds against a cause: those of a rare one in `defaults.RARE`, else zero."""
    return RARE[term.name].odds if term.name in RARE else 0.0


def compute_unknown_price(many: int) -> float:
    """Return the log prior penalty of any one more law, also of one that the library of `many` terms lacks."""
    return math.log(max(many, 1)) + 1.0


def compute_penalty(term: Term, many: int, settings: Settings = DEFAULT) -> float:
    """Return the log prior penalty of a term: one of `many`, a factor e, its further parameters and its choices.

    Uncommon causes have an additional penalty (`weigh_rarity`).
    """
    return compute_unknown_price(many) + compute_own_penalty(term, settings.select.further)


def compute_own_penalty(term: Term, further: float) -> float:
    """Return the log prior penalty of a term beyond that of any law; `further` is that of each further parameter."""
    choices = [len(q.prior.choices) for q in term.params if q.prior.choices]
    return (
        weigh_rarity(term) + further * (len(term.params) - len(choices) - 1) + sum(math.log(count) for count in choices)
    )


def compute_price(posterior: Posterior, many: int) -> float:
    """Return the log prior penalty of the active terms, out of `many`, and of their onsets."""
    own = [compute_penalty(find_term(posterior, key)[0], many, posterior.settings) for key in sorted(posterior.active)]
    return sum(own) + compute_onset_price(posterior)
