"""Amplitudes in standard deviations: the cosine and the sine of a wave count as one."""

import numpy as np
import pytest
from scipy.stats import norm

from lostmotion.inference.significance import REFERENCE, compute_deviations


def test_one_amplitude_is_counted_in_its_standard_deviations():
    assert compute_deviations(np.array([-6.0]), np.array([[4.0]])) == pytest.approx(3.0)


def test_a_wave_without_a_sine_stands_out_by_its_cosine():
    covariance = np.array([[1.0, 0.3], [0.3, 1.0]])
    assert compute_deviations(np.array([8.0, 0.0]), covariance) > REFERENCE
    assert compute_deviations(np.array([0.0, -8.0]), covariance) > REFERENCE


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.slow
def test_noise_is_believed_no_more_often_where_there_are_more_amplitudes(count):
    rng = np.random.default_rng(count)
    root = rng.normal(size=(count, count)) + 2.0 * np.eye(count)
    draws = rng.normal(size=(20_000, count)) @ root.T
    share = np.mean([compute_deviations(draw, root @ root.T) > REFERENCE for draw in draws])
    expected = 2.0 * norm.sf(REFERENCE)
    assert abs(share - expected) < 4.0 * np.sqrt(expected / 20_000)
