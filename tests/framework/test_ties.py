"""Laws that predict the same readings share their probability."""

import pytest
from made_fits import make_hypothesis as hypothesis

from lostmotion.evidence.explanations import Explanations


@pytest.mark.parametrize(("error", "shared"), [(0.1, True), (0.4, False)])
def test_laws_that_predict_the_same_readings_share_their_probability(error, shared):
    """100 predictions that differ by 0.1 standard deviations are expected to give 0.5, by 0.4 they give 8."""
    found = [hypothesis(0.0), hypothesis(10.0, "friction"), hypothesis(4.0, "drag", error=error)]
    told = Explanations({}, {one.terms: one for one in found})
    assert told.inclusion("friction") == pytest.approx(0.5 if shared else 1.0, abs=0.01)
