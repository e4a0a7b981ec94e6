"""Sampling that keeps step with a drive: found, and got rid of."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion_chaos.signals.sampling import commensurate, golden_step, resampled, unlocked


@pytest.mark.parametrize(
    ("each", "n", "expected"),
    [
        (50.0, 20_000, (50, 1)),
        (50.0005, 20_000, (50, 1)),
        (50.5, 20_000, (101, 2)),
        (33.0 + 1.0 / 3.0, 20_000, (100, 3)),
        (1.0, 5_000, (1, 1)),
    ],
)
def test_a_whole_number_of_samples_in_a_few_periods_is_found(each, n, expected):
    found = commensurate(each * 0.01, 0.01, n)
    assert found is not None
    assert (found.samples, found.periods) == expected
    assert abs(found.off) < 1e-3


@pytest.mark.parametrize("each", [49.618, 50.03, 50.0 + (math.sqrt(5.0) - 1.0) / 2.0, 31.4159])
def test_a_sampling_that_drifts_through_the_phases_is_left_alone(each):
    assert commensurate(each * 0.01, 0.01, 20_000) is None


def test_a_slow_drift_counts_by_the_length_of_the_recording():
    """Off by 0.004 samples a period: 400 periods drift by 1.6 samples, 40 periods by 0.16."""
    assert commensurate(50.004, 1.0, 20_000) is None
    assert commensurate(50.004, 1.0, 2_000) is not None


def test_too_few_periods_are_no_evidence():
    assert commensurate(50.0, 1.0, 120) is None


def test_the_golden_step_is_a_little_longer_and_hits_no_phase_twice():
    step = golden_step(0.5, 0.01)
    assert 0.01 < step < 1.03 * 0.01
    assert commensurate(0.5, step, 20_000) is None


@pytest.mark.parametrize("period", [1.0, 1.37])
def test_resampling_is_exact_to_the_error_of_the_spline(period):
    t = 0.02 * np.arange(5000)

    def wave(s):
        return np.sin(2 * np.pi * s / period) + 0.3 * np.cos(6 * np.pi * s / period + 1.0)

    step = golden_step(period, 0.02)
    new = resampled(wave(t), 0.02, step)
    times = step * np.arange(len(new))
    assert times[-1] <= t[-1] + 1e-9
    assert t[-1] - times[-1] < step
    np.testing.assert_allclose(new, wave(times), atol=2e-4)


def test_unlocked_moves_only_what_keeps_step():
    x = np.sin(2 * np.pi * np.arange(2000) / 50.0)
    moved, step, found = unlocked(x, 0.1, 5.0)
    assert found is not None
    assert str(found) == "50 samples a period of the drive"
    assert step > 0.1
    assert len(moved) < len(x)
    same, step, found = unlocked(x, 0.1, 5.0418)
    assert found is None
    assert same is x
    assert step == 0.1


def test_a_section_is_said_and_not_resampled():
    x = np.random.default_rng(0).normal(size=500)
    same, _, found = unlocked(x, 1.0, 1.0)
    assert found is not None
    assert same is x


def test_impossible_numbers_are_told():
    with pytest.raises(DataError, match="must be positive"):
        commensurate(-1.0, 0.1, 100)
    with pytest.raises(DataError, match="sample faster"):
        golden_step(0.2, 0.1)
    with pytest.raises(DataError, match="step"):
        resampled(np.zeros(100), 0.1, 0.0)
    with pytest.raises(DataError, match="too few"):
        resampled(np.zeros(4), 0.1, 0.2)
