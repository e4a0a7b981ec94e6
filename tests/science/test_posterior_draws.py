"""Draws of a hypothesis with its smooth forces averaged, beside the sum over every choice of smooth forces."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from explained import explain_machine
from scipy.special import softmax

from lostmotion.evidence.discrepancy import Quadratic
from lostmotion.evidence.hypothesis import compute_step
from lostmotion.evidence.posterior_draws import draw_own, sample_choices

DRAWS = 4000


def push(x, v, t):
    """Return a smooth force that no term describes (N)."""
    return 0.05 * np.sin(2.0 * v / 0.1) + 0.03 * np.cos(3.0 * x / 2e-3)


@pytest.fixture(scope="module")
def pushed(tmp_path_factory):
    """The model without any term beside a smooth force, with two smooth forces only: each choice can be listed."""
    found = explain_machine(tmp_path_factory.mktemp("pushed"), push).found[frozenset()]
    frame = replace(found.frame, forces=found.frame.forces[:2])
    return replace(found, frame=frame, choice=found.choice[:2])


def list_shares(found):
    """Return every choice with its probability."""
    quadratic = Quadratic.of(found.frame, found.expansion.curvature)
    choices = list(product(*(range(-1, len(force.options)) for force in found.frame.forces)))
    return choices, softmax([quadratic.evaluate(one) / found.scatter for one in choices])


def test_choices_are_drawn_by_their_evidence(pushed):
    """Seeded; 4,000 draws of some tens of likely choices: half the sum of the differences of shares is about 0.05."""
    choices, shares = list_shares(pushed)
    drawn = sample_choices(pushed, DRAWS, np.random.default_rng(0))
    seen = np.array([drawn.count(one) / DRAWS for one in choices])
    assert seen.sum() == pytest.approx(1.0)
    assert 0.5 * np.abs(seen - shares).sum() < 0.12
    assert shares.max() < 0.95  # or nothing is averaged


def test_draws_have_mean_and_deviation_of_the_mixture_over_all_choices(pushed):
    choices, shares = list_shares(pushed)
    own = pushed.frame.own
    middle = np.array([pushed.theta + compute_step(pushed.frame, pushed.expansion, one)[0][:own] for one in choices])
    within = np.array([pushed.scatter * np.diag(replace(pushed, choice=one).covariance) for one in choices])
    mean = shares @ middle
    deviation = np.sqrt(shares @ (within + (middle - mean) ** 2))
    drawn = draw_own(pushed, DRAWS, np.random.default_rng(1))
    names = pushed.frame.names[:own]
    for k in (names.index("c"), names.index("k")):
        assert drawn[:, k].mean() == pytest.approx(mean[k], abs=0.1 * deviation[k])
        assert drawn[:, k].std() == pytest.approx(deviation[k], rel=0.1)


def test_an_interval_is_wider_than_with_the_best_smooth_forces_alone(pushed):
    fixed = np.sqrt(pushed.scatter * np.diag(pushed.covariance))
    drawn = draw_own(pushed, DRAWS, np.random.default_rng(2))
    assert drawn[:, pushed.frame.names.index("c")].std() > 1.05 * fixed[pushed.frame.names.index("c")]
