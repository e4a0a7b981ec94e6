"""The sets of terms that a forward selection extends: the beam, and sets that are nearly decisive."""

from __future__ import annotations

from lostmotion.inference.term_sets import BEAM, Selection, TermSet

NEAR_GAIN = 2.5
"""A set with one more term is extended, though not decisive, if the term adds at least this log evidence."""


def list_beam(selection: Selection, here: TermSet) -> list[TermSet]:
    """Return the sets to extend: the chosen one, and others of its size that explain at least half as much.

    One term can imitate two others until both are included.
    """
    if not here.terms:
        return [here]
    bottom = selection.fitted_sets[frozenset()].weight
    rivals = [v for v in selection.fitted_sets.values() if len(v.terms) == len(here.terms) and v.terms != here.terms]
    rivals = [v for v in rivals if v.weight - bottom > 0.5 * (here.weight - bottom)]
    return [here, *sorted(rivals, key=lambda v: -v.weight)[: BEAM - 1]]


def list_near_sets(selection: Selection, here: TermSet) -> list[TermSet]:
    """Return the best sets with one more term, if none is decisive but some are close to it.

    Two small effects may be decisive together although neither is decisive alone.
    """
    more = [v for v in selection.fitted_sets.values() if v.terms > here.terms]
    if any(v.weight > here.weight + selection.nominal.problem.settings.select.decisive for v in more):
        return []
    good = [v for v in more if v.fit.log_evidence > here.fit.log_evidence + NEAR_GAIN]
    return sorted(good, key=lambda v: -v.weight)[: BEAM - 1]
