"""Laws that predict the same readings share their probability."""

from types import SimpleNamespace

import numpy as np
import pytest

from lostmotion.evidence.explanations import Explanations


def hypothesis(score, *terms, error=0.0):
    """Return what is asked of a hypothesis with a score, and the same error of each of its 100 predictions."""
    return SimpleNamespace(
        terms=frozenset(terms),
        frame=SimpleNamespace(own=2),
        scatter=1.0,
        expansion=SimpleNamespace(here=SimpleNamespace(errors=np.full(100, error), variances=np.ones(100))),
        price=0.0,
        log_profile=0.0,
        score=lambda temper=1.0: score / temper,
    )


@pytest.mark.parametrize(("error", "shared"), [(0.1, True), (0.4, False)])
def test_laws_that_predict_the_same_readings_share_their_probability(error, shared):
    """100 predictions that differ by 0.1 standard deviations are expected to give 0.5, by 0.4 they give 8."""
    found = [hypothesis(0.0), hypothesis(10.0, "friction"), hypothesis(4.0, "drag", error=error)]
    told = Explanations({}, {one.terms: one for one in found})
    assert told.inclusion("friction") == pytest.approx(0.5 if shared else 1.0, abs=0.01)
