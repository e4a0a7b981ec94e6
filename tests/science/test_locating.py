"""Where a hidden force lives, by the likelihood ratio of curves: machines of the blind trial's integrator."""

import importlib.util
import sys
from pathlib import Path

import pytest
from scipy.stats import binom

from lostmotion_trials.rates import estimate_rate

FILE = Path(__file__).parents[2] / "benchmarks" / "locate.py"


@pytest.fixture(scope="module")
def study():
    spec = importlib.util.spec_from_file_location("benchmarks_locate", FILE)
    found = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = found
    spec.loader.exec_module(found)
    return found


@pytest.mark.parametrize(
    ("number", "first"),
    [
        (14, "velocity"),
        (21, "sign of velocity at base"),
        pytest.param(10, "position at base", marks=pytest.mark.slow),
        pytest.param(3, "position", marks=pytest.mark.slow),
    ],
)
@pytest.mark.slow
def test_the_true_covariate_and_place_come_first_of_two(study, number, first):
    """Machines with two places, fixed by seed and number."""
    row = study.run_machine("two", 0, number)
    assert study.rank_covariates(row, "odds")[0] == first
    assert study.score_first(row, "odds")["both"]


@pytest.mark.slow
def test_noise_seldom_has_a_covariate(study):
    """Forty machines with nothing hidden, noise of four kinds, at 5 %: at most the 99.9 % point, 7."""
    alarms = sum(bool(study.rank_covariates(study.run_machine("noise", 1, number), "odds")) for number in range(40))
    assert alarms <= binom.ppf(0.999, 40, 0.05)


@pytest.mark.slow
def test_the_place_is_right_more_often_than_by_shares(study):
    """Twenty machines with two places: both covariate and place come first in half of them at least."""
    rows = [study.run_machine("two", 1, number) for number in range(20)]
    right = {test: sum(study.score_first(row, test)["both"] for row in rows) for test in ("shares", "odds")}
    assert right["odds"] >= max(10, right["shares"])


def test_rates_carry_the_interval_of_clopper_and_pearson():
    """0 of 100 and 5 of 100 as in tables of the exact interval."""
    assert (estimate_rate(0, 100).low, estimate_rate(0, 100).high) == pytest.approx((0.0, 0.0362), abs=1e-4)
    assert (estimate_rate(5, 100).low, estimate_rate(5, 100).high) == pytest.approx((0.0164, 0.1128), abs=1e-4)
