"""What has to be confirmed before it is named, where the model is not right in other ways too.

There evidence grows with every sample, whatever the term; a prediction does not. So what was found must make free runs
over held-out data better, and a flaw of a channel must be larger than acquisition systems have as a rule.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.course import RICH
from lostmotion.inference.gauges import APART
from lostmotion.inference.natural import term_of
from lostmotion.likelihood.observation import Observation
from lostmotion.quantities import TIME
from lostmotion.stages.compare import confirmed, pieces_of, run_errors
from lostmotion.stages.diagnose import Diagnosis
from lostmotion.workflow.findings import Outcome


def unconfirmed(outcome: Outcome, observations: Sequence[Observation]) -> dict[str, str]:
    """Return a sentence on each found term that is no more than likely, by key; none where the model is right else.

    It is not right where a random force is left, or where smooth forces or flaws of channels promise much beside what
    was found, each sample counting as one.
    """
    d, selection = outcome.diagnosis, outcome.diagnosis.selection
    here = selection.visits.get(selection.chosen.problem.active)
    if here is None or not here.terms:
        return {}
    if not d.unexplained and not selection.expansion(here).promise(1.0).gain > RICH:
        return {}
    pieces, told = pieces_of(observations, d.held), {}
    errors = run_errors(here.fit, pieces, outcome.horizon)
    for key in (key for key in d.named if key in here.terms):
        less = selection.visits.get(here.terms - {key})
        without = run_errors(less.fit, pieces, outcome.horizon) if less else None
        if sentence := usual(d, key):
            told[key] = sentence
        elif without is not None and not confirmed(errors, without):
            told[key] = (
                "The model is not right in other ways too, and free runs over held-out data are better with it in"
                f" {int(np.sum(errors < without))} of {len(errors)} parts only (they err by {_whole(errors):.2%} of the"
                f" response with it and by {_whole(without):.2%} without it), which is within chance."
            )
    return told


def usual(d: Diagnosis, key: str) -> str:
    """Return a sentence on a delay that is no longer than acquisition systems have as a rule; empty where it is."""
    term, slots = term_of(d.after.problem, key)
    late = [s for s in slots if s.param.dimension == TIME and s.key in d.after.values]
    if term.acts == "motion" or not late:
        return ""
    samples = abs(d.after.values[late[0].key]) / d.shown.dt
    if samples > APART:
        return ""
    return (
        f"A delay of {samples:.2g} samples is within what acquisition systems have as a rule, and the model is not"
        " right in other ways too."
    )


def _whole(errors: Array) -> float:
    return math.sqrt(float(np.mean(errors**2)))
