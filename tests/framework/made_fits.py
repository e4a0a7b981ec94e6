"""Fits and hypotheses that are made by hand, at a given place and of a given height."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.inference.fit import Fit, LocalExpansion


@dataclass(frozen=True)
class MadePosterior:
    """What a posterior consists of."""

    space: Any = None
    observations: tuple = ()
    system: Any = None


@dataclass(frozen=True)
class MadeFit(Fit):
    """A fit whose log evidence is given."""

    evidence: float

    @property
    def log_evidence(self):
        return self.evidence


def make_fit(posterior, theta, height=0.0, *, evidence=None, sd=1.0):
    """Return a fit of a posterior at `theta` with the log posterior `height`, in which coordinates are independent."""
    at = np.array(theta, dtype=float)
    zeros, information = np.zeros(len(at)), np.eye(len(at)) / sd**2
    local = LocalExpansion(at, height, height, zeros, information, zeros)
    return MadeFit(posterior, local, "converged", 1, height if evidence is None else evidence)


class MadeHypothesis(Hypothesis):
    """A hypothesis whose priors have unit density, and whose scores scatter as they should."""

    scatter = 1.0
    log_profile = 0.0


@dataclass(frozen=True)
class _Part:
    """A frame, an expansion, or one-step errors: as much of them as a comparison of hypotheses reads."""

    terms: frozenset = frozenset()
    own: int = 2
    here: Any = None
    errors: Any = None
    variances: Any = None


def make_hypothesis(score, *terms, error=0.0):
    """Return a hypothesis with a score, and the same error of each of its 100 predictions."""
    here = _Part(errors=np.full(100, error), variances=np.ones(100))
    return MadeHypothesis(_Part(frozenset(terms)), _Part(here=here), (), score, smooth=0.0, price=0.0)
