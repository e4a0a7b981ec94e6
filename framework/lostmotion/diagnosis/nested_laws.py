"""Of nested laws the simplest that is not refuted is the name: a richer one needs its own amplitudes told from zero."""

from __future__ import annotations

from lostmotion.diagnosis.gather_facts import list_reaching
from lostmotion.diagnosis.outcome import Outcome, compute_intervals
from lostmotion.evidence.bare import Terms
from lostmotion.evidence.hypothesis import group_amplitudes
from lostmotion.evidence.weighing import REACH
from lostmotion.inference.natural import find_term, sort_slots
from lostmotion.inference.penalties import is_simpler
from lostmotion.likelihood.system import key_of


def find_simpler_set(outcome: Outcome) -> Terms | None:
    """Return a set with a simpler law in place of one of the most probable set; None where all laws are told.

    A law is not told from a simpler one if the interval of each amplitude that it adds contains the value that does
    nothing, and the set with the simpler law is close to the best one.
    """
    explained, posterior = outcome.diagnosis.explained, outcome.diagnosis.after.posterior
    intervals = compute_intervals(outcome.diagnosis.after, outcome.draws_after)
    for key in sorted(explained.terms):
        law = find_term(posterior, key)[0]
        added = group_amplitudes(posterior, key, sort_slots(posterior, key)[0])
        if len(list(list_reaching(posterior, key, intervals))) < len(added):
            continue
        simpler = [key_of(term) for term in posterior.system.terms if is_simpler(term, law)]
        close = [less for one in simpler if explained.is_close(less := explained.terms - {key} | {one}, REACH)]
        if close:
            return max(close, key=lambda less: explained.probabilities[less])
    return None
