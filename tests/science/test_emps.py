"""A real machine: the published identification of EMPS is found again, from the position alone."""

from __future__ import annotations

import numpy as np
import pytest
from machines import CARRIAGE, EMPS, EMPS_FILES, PUBLISHED

from lostmotion.diagnosis.compare import compute_rates, cut_heldout, predict
from lostmotion.diagnosis.diagnosis_run import check_heldout, draw_posteriors
from lostmotion.diagnosis.outcome import compute_intervals, draw_parameters
from lostmotion.diagnosis.stages import diagnose
from lostmotion.evidence.effects import propose_start
from lostmotion.inference.candidates import fit_term
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default

FOUND = frozenset({"coulomb_friction", "directional_damping"})
PUBLISHED_TERMS = frozenset({"coulomb_friction", "offset_force"})
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
    return draw_posteriors(check_heldout(found, rng.spawn(1)[0], lambda _: None), rng)


def test_friction_and_damping_by_direction_are_found(outcome):
    """The published model has a constant force in place of the damping by direction. One real recording: no chance."""
    assert set(outcome.diagnosis.found) == FOUND


@pytest.fixture(scope="module")
def published(outcome):
    """The fit of the published model: dry friction, and a constant force."""
    fit = outcome.diagnosis.explained.nominal
    for key in sorted(PUBLISHED_TERMS):
        fit = fit_term(fit, key, propose_start(fit, key))
    return fit


def test_values_of_the_published_model_are_the_published_ones(published):
    """Within 3 % (offset 10 %), and the published values inside our intervals. One real recording: no chance."""
    ours = compute_intervals(published, draw_parameters(published, np.random.default_rng(0)))
    for key, (value, _) in PUBLISHED.items():
        assert ours[key].median == pytest.approx(value, rel=TOLERANCE[key]), key
        assert ours[key].low <= value <= ours[key].high, key


def test_pulses_that_no_fit_has_seen_are_predicted_better_than_by_the_published_model(outcome, published):
    """Free runs of DATA_EMPS_PULSES; the error of the found terms is the lower one. One real recording: no chance."""
    d = outcome.diagnosis
    pieces = cut_heldout(d.corrected, d.held)
    rates = compute_rates(d.after, d.corrected)
    found, theirs = (predict(fit, pieces, outcome.horizon, rates).nrmse for fit in (d.after, published))
    assert found**2 < 0.9 * theirs**2


def test_pulses_that_no_fit_has_seen_are_predicted_better(outcome):
    """DATA_EMPS_PULSES: the error of a free run falls to less than half. One real recording: no chance."""
    assert outcome.after.nrmse < 0.5 * outcome.before.nrmse
    assert outcome.after.valid_time > 2.0 * outcome.before.valid_time
    assert outcome.after.log_score > outcome.before.log_score
