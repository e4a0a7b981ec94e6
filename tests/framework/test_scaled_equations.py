"""Equations of coordinates with very different units, compared with least squares by singular values."""

import numpy as np
import pytest

from lostmotion.inference.scaled_equations import solve_scaled


def make_information(scales, columns=40, *, same=False):
    """Return the information (n, n) of random derivatives; with `same` two coordinates have the same effect."""
    rows = np.random.default_rng(2).standard_normal((len(scales), columns))
    if same:
        rows[1] = rows[0]
    rows *= np.array(scales)[:, None]
    return rows @ rows.T


@pytest.mark.parametrize("shape", [(4,), (4, 3)])
def test_the_solution_is_that_of_least_squares_in_scaled_coordinates(shape):
    scales = np.array([1e-7, 1.0, 3e5, 1e9])
    information, right = make_information(scales), np.random.default_rng(3).standard_normal(shape)
    plain = np.linalg.lstsq(make_information(np.ones(4)), (right.T / scales).T, rcond=None)[0]
    assert solve_scaled(information, right) == pytest.approx((plain.T / scales).T, rel=1e-9)


def test_two_coordinates_with_one_effect_share_it():
    """The matrix is singular: of all solutions it is the shortest one in units of the information."""
    information = make_information((1e-3, 1e-3, 1.0), same=True)
    right = information @ np.array([2.0, 4.0, 1.0])
    assert solve_scaled(information, right) == pytest.approx([3.0, 3.0, 1.0], rel=1e-6)


def test_a_coordinate_without_effect_stays_and_none_is_a_solution():
    assert solve_scaled(np.diag([4.0, 0.0]), np.array([2.0, 0.0])) == pytest.approx([0.5, 0.0])
    assert solve_scaled(np.zeros((0, 0)), np.zeros(0)).shape == (0,)
