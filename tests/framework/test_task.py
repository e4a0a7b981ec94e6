"""What a fit hands over to the sampling."""

from __future__ import annotations

import numpy as np

from lostmotion.identification.task import limit_covariance
from lostmotion.likelihood.space import FreeParameter

FREE = (FreeParameter("c", "1", 0.0, -1.0, 1.0), FreeParameter("log_noise", "1", 0.0, -10.0, 2.0))


def test_a_parameter_of_which_the_data_say_nothing_stays_between_its_bounds():
    """An information of 1e-8 is a deviation of 1e4, and the bounds are 12 apart; the correlation is kept."""
    root = np.array([[0.01, 0.0], [6e3, 8e3]])
    got = limit_covariance(root @ root.T, FREE)
    np.testing.assert_allclose(np.sqrt(np.diag(got)), [0.01, 12.0 / np.sqrt(12.0)])
    np.testing.assert_allclose(got[0, 1] / np.sqrt(got[0, 0] * got[1, 1]), 0.6)


def test_a_covariance_that_fits_is_left_alone():
    covariance = np.array([[1e-4, 1e-4], [1e-4, 4e-2]])
    np.testing.assert_array_equal(limit_covariance(covariance, FREE), covariance)
