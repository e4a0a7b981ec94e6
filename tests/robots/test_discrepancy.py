"""The choice of smooth forces: the evidence is split exactly into that of known values and that of the forces."""

import numpy as np
import pytest

from lostmotion.evidence.expansion import compute_log_evidence
from lostmotion.robots.arm import Column
from lostmotion.robots.arm_discrepancy import Discrepancy, SmoothTorque

KNOWN, WAVES = 12, 10


@pytest.fixture
def made():
    """Return a discrepancy of 12 known values and three smooth forces, with a gradient and an information."""
    rng = np.random.default_rng(0)
    count = KNOWN + 3 * WAVES
    options = np.array([np.full(WAVES, 0.01), np.full(WAVES, 0.1)])
    forces = tuple(
        SmoothTorque(0, "position", slice(KNOWN + WAVES * k, KNOWN + WAVES * (k + 1)), options) for k in range(3)
    )
    fixed = np.concatenate([np.full(KNOWN, 0.3), np.zeros(3 * WAVES)])
    columns = tuple(Column(f"c{i}", 0, np.ones(5)) for i in range(count))
    slopes = rng.standard_normal((80, count))
    return Discrepancy(columns, fixed, np.arange(count) < 6, forces, (5, 2)), slopes


@pytest.mark.parametrize("choice", [(-1, -1, -1, 0), (0, -1, 1, 1), (1, 1, 0, 0)])
def test_evidence_given_the_known_values_adds_up(made, choice):
    discrepancy, slopes = made
    gradient, information = slopes.T @ np.linspace(-5.0, 5.0, 80), slopes.T @ slopes
    known, slope, bend = discrepancy._condition(gradient, information, choice[-1])
    widths = discrepancy.widths(choice)
    split = known + compute_log_evidence(slope, bend, widths[discrepancy.fixed == 0.0])
    assert split == pytest.approx(compute_log_evidence(gradient, information, widths), rel=1e-9)


def test_a_force_that_is_there_is_chosen(made):
    discrepancy, slopes = made
    force = np.zeros(slopes.shape[1])
    force[KNOWN + WAVES : KNOWN + 2 * WAVES] = 0.5
    pulled = slopes @ force + np.random.default_rng(1).standard_normal(80)
    chosen = discrepancy.choose(slopes.T @ pulled, slopes.T @ slopes, discrepancy.none)
    assert chosen[1] == 1
    assert discrepancy.choose(np.zeros(42), slopes.T @ slopes, discrepancy.none)[:3] == (-1, -1, -1)
