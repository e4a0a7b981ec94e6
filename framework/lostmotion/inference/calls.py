"""Calls of the force of a term along a recording: whether it returns finite numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from lostmotion.contracts import Array, Term, Values
from lostmotion.errors import ContractError
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.plan import prepare_values
from lostmotion.likelihood.posterior import Posterior

LOOKS = 200
"""Samples at which a force is evaluated when a filter with it diverges."""


def require_finite(posterior: Posterior, key: str) -> None:
    """Raise a `ContractError` if force or rates of a term, all its numbers one, are not finite along a recording."""
    term, _ = find_term(posterior, key)
    if term.acts == "motion" and not all(_is_finite(term, observation) for observation in posterior.observations):
        raise ContractError(
            f"the force of {key} is not a finite number along the recorded motion: correct the term, or leave it out",
            key,
        )


def _is_finite(term: Term, observation: Observation) -> bool:
    change = np.zeros(len(term.states))
    for told in list_calls(term, observation, LOOKS):
        if math.isfinite(told[1]) and math.isfinite(told[2]):
            term.rate(*told, change)
            if not (math.isfinite(term.force(*told)) and np.all(np.isfinite(change))):
                return False
    return True


def list_calls(
    term: Term, observation: Observation, looks: int
) -> Iterator[tuple[float, float, float, Array, Values, Values]]:
    """Yield the arguments of the force of a term at about `looks` samples; its numbers are one, its states zero."""
    p = prepare_values(term, np.ones(len(term.params) + len(term.needs)))
    s, u = (0.0,) * len(term.states), np.zeros(max(2, observation.inputs.shape[1]))
    speed = np.gradient(observation.response, observation.dt)
    for k in range(0, observation.samples, max(1, observation.samples // looks)):
        yield k * observation.dt, float(observation.response[k]), float(speed[k]), u, p, s
