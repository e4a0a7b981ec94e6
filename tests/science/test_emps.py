"""A real machine: the published identification of EMPS is found again, from the position alone."""

from __future__ import annotations

import numpy as np
import pytest
from machines import CARRIAGE, EMPS, EMPS_FILES, PUBLISHED

from lostmotion.diagnosis.findings import compute_intervals
from lostmotion.diagnosis.run import compare_heldout, draw_posteriors
from lostmotion.diagnosis.search import diagnose
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default

TOLERANCE = {"m": 0.03, "c": 0.03, "coulomb_friction.force": 0.03, "offset_force.force": 0.10}

pytestmark = [pytest.mark.real, pytest.mark.slow]


@pytest.fixture(scope="module")
def outcome(shared, tmp_path_factory):
    """The diagnosis from DATA_EMPS, judged on DATA_EMPS_PULSES."""
    data = shared / "data" / "emps"
    if not data.is_dir():
        pytest.skip(f"no EMPS recordings: {data} is absent")
    case = tmp_path_factory.mktemp("emps") / "case.toml"
    files = [(data / f"{name}.mat").resolve() for name in EMPS_FILES]
    case.write_text("".join(EMPS.format(file=file) for file in files) + CARRIAGE)
    prepared, rng = prepare(case, default()), np.random.default_rng(0)
    found = diagnose(prepared.case, prepared.observations, System(prepared.model, prepared.terms), rng=rng)
    return draw_posteriors(compare_heldout(found, prepared), rng)


def test_friction_and_offset_are_found(outcome):
    """The two terms that the published model has beside mass and viscous friction. One real recording: no chance."""
    assert set(outcome.diagnosis.found) == {"coulomb_friction", "offset_force"}


def test_values_are_the_published_ones(outcome):
    """Within 3 % (offset 10 %), and the published values inside our intervals. One real recording: no chance."""
    ours = compute_intervals(outcome.diagnosis.after, outcome.draws_after)
    for key, (value, _) in PUBLISHED.items():
        assert ours[key].median == pytest.approx(value, rel=TOLERANCE[key]), key
        assert ours[key].low <= value <= ours[key].high, key


def test_pulses_that_no_fit_has_seen_are_predicted_better(outcome):
    """DATA_EMPS_PULSES: the error of a free run falls to less than half. One real recording: no chance."""
    assert outcome.after.nrmse < 0.5 * outcome.before.nrmse
    assert outcome.after.valid_time > 2.0 * outcome.before.valid_time
    assert outcome.after.log_score > outcome.before.log_score
