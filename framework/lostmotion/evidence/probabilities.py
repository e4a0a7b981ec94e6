"""Probabilities of sets of terms, from their scores."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Protocol

from lostmotion.evidence.bare import Terms
from lostmotion.evidence.hypothesis import Hypothesis


def measure_temper(found: Iterable[Hypothesis], share: float = 1.0) -> float:
    """Return what log evidences are divided by: a share of the samples, times the scatter of the best hypothesis."""
    return share * max(found, key=lambda one: one.score(share)).scatter


class Scored(Protocol):
    """A set of terms with a score."""

    @property
    def terms(self) -> Terms:
        """The keys of the terms."""

    def score(self, temper: float = 1.0) -> float:
        """Return the log posterior weight."""


def compute_probabilities(found: Iterable[Scored], temper: float) -> dict[Terms, float]:
    """Return the posterior probability of each set: the softmax of the scores."""
    scores = {h.terms: h.score(temper) for h in found}
    top = max(scores.values())
    weights = {terms: math.exp(score - top) for terms, score in scores.items()}
    total = sum(weights.values())
    return {terms: weight / total for terms, weight in weights.items()}
