"""What a diagnosis says of recordings whose truth is known: 20 training periods of Case 1, position alone."""

from __future__ import annotations

import numpy as np
import pytest
from truths import FORCE, FRICTION, case_of, observation_of, system_of

from lostmotion.diagnosis.compare import average_exponent, choose_heldout_horizon, compute_rates, cut_heldout, predict
from lostmotion.diagnosis.outcome import compute_intervals, draw_parameters
from lostmotion.diagnosis.stages import diagnose

pytestmark = pytest.mark.slow


def diagnosed(force, unknown, **kind):
    """Return the recording and the diagnosis of it."""
    observation, _ = observation_of(force, **kind)
    return observation, diagnose(case_of(unknown), [observation], system_of(), rng=np.random.default_rng(0))


def interval(diagnosis, key):
    """Return the 95 % interval of a parameter after the diagnosis."""
    return compute_intervals(diagnosis.after, draw_parameters(diagnosis.after, np.random.default_rng(1)))[key]


@pytest.fixture(scope="module")
def rubbing():
    return diagnosed(3.0, ("c", "x0"), seed=11)


def test_hidden_friction_is_named_and_measured(rubbing):
    """3 N (3 % of the drive) is named, within 0.05 N and its interval, and only friction is.

    Prototype: 3.018 +- 0.012 N. The interval misses one new recording in twenty; this one is fixed.
    """
    found = interval(rubbing[1], FORCE)
    assert rubbing[1].found == (FRICTION,)
    assert found.low <= 3.0 <= found.high
    assert abs(found.median - 3.0) < 0.05
    assert rubbing[1].explained.inclusion(FRICTION) > 0.95


def test_damping_that_soaked_up_friction_lets_it_go(rubbing):
    """Ignored, friction hides in c (13 in place of 8); with it c is right. No chance but the interval's 5 %."""
    _, d = rubbing
    assert d.before.values["c"] > 11.0
    c = interval(d, "c")
    assert c.low <= 8.0 <= c.high
    assert c.high - c.low < 0.5


def test_nothing_is_left_over(rubbing):
    """With the right term no random force remains, and the missing force lived in the velocity. No chance."""
    _, d = rubbing
    assert not d.unexplained
    assert max(d.located.shares, key=d.located.shares.get) == "velocity"
    assert d.left.missing.force.std() < 0.1 * d.located.missing.force.std()


def test_held_out_data_are_predicted_better(rubbing):
    """Free predictions of data that no fit has seen hold twice as long (prototype: 2.0 and 6.8 Lyapunov times).

    Median over starts on one fixed recording.
    """
    observation, d = rubbing
    pieces = cut_heldout([observation], d.held)
    rates = compute_rates(d.after, [observation])
    horizon = choose_heldout_horizon(d.after, pieces, average_exponent(rates))
    before, after = (predict(fit, pieces, horizon, rates) for fit in (d.before, d.after))
    assert after.valid_time > 2.0 * before.valid_time
    assert after.nrmse < 0.3 * before.nrmse
    assert after.log_score > before.log_score + 0.01


@pytest.mark.parametrize("noise", [0.01, 0.1])
def test_clean_recording_is_adequate(noise):
    """Nothing hidden, nothing found, nothing left over. Rule: twenty to one in evidence; 0 of 10 in the ensemble."""
    _, d = diagnosed(0.0, ("c", "x0"), seed=12, noise=noise)
    assert d.found == ()
    assert not d.unexplained
    assert d.explained.probabilities[frozenset()] > 0.9


@pytest.mark.slow
def test_intervals_cover_the_truth():
    """Ten recordings with the gap and its stiffness unknown too: at least 9 named, covered and within 0.05 N.

    With 95 % intervals, 8 or fewer of 10 cover in 8.6 % of new ensembles; this one is fixed.
    """
    diagnoses = [diagnosed(3.0, ("c", "x0", "k0"), seed=100 + s)[1] for s in range(10)]
    found = [interval(d, FORCE) for d in diagnoses if d.found == (FRICTION,)]
    assert len(found) >= 9
    assert sum(i.low <= 3.0 <= i.high for i in found) >= 9
    assert max(abs(i.median - 3.0) for i in found) < 0.05


@pytest.mark.slow
def test_no_false_alarm_on_ten_clean_recordings():
    """None of ten (rival: none of ten). A rate of 1 % false alarms would show in 10 % of new ensembles."""
    for seed in range(100, 110):
        _, d = diagnosed(0.0, ("c", "x0", "k0"), seed=seed)
        assert d.found == (), seed
        assert not d.unexplained, seed
