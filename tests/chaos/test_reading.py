"""What is made of the estimates behind a level: their biases depend on what drives the machine."""

import numpy as np
import pytest

from lostmotion.registry import default
from lostmotion.results import Estimate
from lostmotion_chaos.flows.flow import Harmonic
from lostmotion_chaos.levels.reading import ESTIMATOR_ERRORS, correct_estimate, read_level
from lostmotion_chaos.levels.rehearsal import RecordingPlan, simulate_signals


@pytest.mark.parametrize("name", ESTIMATOR_ERRORS)
def test_what_is_read_of_a_truth_is_corrected_to_that_truth(name):
    bias, scale, share = ESTIMATOR_ERRORS[name]
    read = (1.0 + bias) * 2.4
    found = correct_estimate(name, Estimate(read, read - 0.196, read + 0.196, "ok"))
    assert found.value == pytest.approx(2.4)
    assert found.sd == pytest.approx(np.hypot(scale * 0.1, share * 2.4), rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("model", "beat", "kind"),
    [("lin_backlash", Harmonic(0.5, 0.2), "d2"), ("robot_joint", Harmonic(12.5, 0.2), "d2 of a moved base")],
)
def test_a_dimension_is_corrected_for_a_force_or_a_moved_base(model, beat, kind):
    rng, registry = np.random.default_rng(5), default()
    values = {"m": 1.0, "c": 0.04, "k0": 1.0, "x0": 1.0, "mgl" if model == "robot_joint" else "k1": 0.0}
    read = read_level(
        simulate_signals(registry.make("model", model), values, beat, RecordingPlan(), rng)[0], registry, rng
    )
    assert read.level.motion == "chaotic"
    assert read.level.d2 == correct_estimate(kind, read.dimension)
