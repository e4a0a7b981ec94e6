"""Friction with a soft onset: the mean force of a step is that of the exact motion."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lostmotion.robots.soft_friction import SOFT_FRICTION


def force(v, level, velocity, mobility):
    return SOFT_FRICTION.force(0.0, 0.0, v, (), (level, velocity, mobility), ())


@pytest.mark.parametrize("velocity", [0.003, 0.05, 1.0])
@pytest.mark.parametrize("v", [-0.4, -0.02, 1e-4, 0.07, 2.0])
def test_a_long_step_ends_where_the_motion_does(v, velocity):
    level, mobility = 0.8, 0.02  # the speed changes by up to 0.016 in a step, five times the shortest onset
    moved = solve_ivp(
        lambda t, y: -level * np.tanh(y / velocity) * mobility, (0.0, 1.0), [v], rtol=1e-10, atol=1e-14, method="LSODA"
    )
    assert v + mobility * force(v, level, velocity, mobility) == pytest.approx(moved.y[0, -1], rel=1e-6, abs=1e-10)


def test_a_short_step_feels_the_force_itself():
    for v in (-3.0, -0.01, 0.0, 0.02, 5.0):
        assert force(v, 0.3, 0.05, 1e-9) == pytest.approx(-0.3 * math.tanh(v / 0.05), abs=1e-12)


def test_a_short_onset_is_dry_friction_that_stops():
    level, mobility = 0.5, 0.01
    assert force(2.0, level, 1e-6, mobility) == pytest.approx(-level, rel=1e-6)
    assert force(0.003, level, 1e-6, mobility) * mobility == pytest.approx(-0.003, rel=1e-2)
    assert force(0.0, level, 1e-6, mobility) == 0.0
