"""The log evidence by Laplace's method and by importance sampling, in `diagnosis.json` and in a sentence."""

from __future__ import annotations

import numpy as np

from lostmotion.diagnosis.stages import SearchResult
from lostmotion.inference.laplace import sample_evidence
from lostmotion.results.diagnosis import EvidenceCheck, SampledEvidence

FEWEST = 15.0
"""Importance sampling checks the evidence when it has at least this number of effective draws."""
EQUAL = 3.0
"""Two log evidences agree when they differ by at most this (a factor of twenty), plus three standard errors."""


def check_evidence(diagnosis: SearchResult, rng: np.random.Generator) -> EvidenceCheck:
    """Return the log evidence of both models by both methods; an empty check if nothing was found."""
    if diagnosis.after is diagnosis.before:
        return EvidenceCheck()
    before, after = (sample_evidence(fit, rng) for fit in (diagnosis.before, diagnosis.after))
    return EvidenceCheck(before, after, _describe_evidence(before, after))


def _describe_evidence(before: SampledEvidence, after: SampledEvidence) -> str:
    laplace, sampled = after.laplace - before.laplace, after.sampled - before.sampled
    error = float(np.hypot(before.error, after.error))
    if min(before.effective, after.effective) < FEWEST:
        return (
            f"The findings raise the log evidence by {laplace:.1f} by Laplace's method; importance sampling cannot"
            " check this value, because too few draws have nearly all of the weight."
        )
    same = abs(sampled - laplace) <= EQUAL + 3.0 * error
    return (
        f"The findings raise the log evidence by {laplace:.1f} (Laplace's method) and {sampled:.1f} +- {error:.1f}"
        f" (importance sampling): {'the two agree' if same else 'they differ, so the probabilities are approximate'}."
    )
