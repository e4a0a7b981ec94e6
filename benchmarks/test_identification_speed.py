"""How fast the likelihood of identify is, over the same filter in plain NumPy in the same run: `pytest benchmarks`."""

import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from identification import Machine, against_plain, fitted, measured, posed

LEAST = 500.0
"""Ours over plain NumPy on one core, whatever else the machine does; a quiet one has several thousand."""
AS_LONG_AS = 6_000


@pytest.fixture(scope="module")
def fit():
    """The fit of 6000 samples of Case 1 in chaos, with steps finer than identify takes."""
    return fitted(posed(measured(Machine(), AS_LONG_AS // 200, 1, 1e-3)[1]))


def test_likelihood_outruns_plain_numpy_and_agrees_with_it(benchmark, fit):
    problem, theta = replace(fit.problem, jobs=1), fit.theta
    benchmark.pedantic(lambda: problem.innovations(theta).log_likelihood, rounds=9, warmup_rounds=1)
    seconds = benchmark.stats.stats.min
    plain, apart = against_plain(problem, theta, 1000)
    ratio = 1.0 / (seconds * plain)
    benchmark.extra_info.update(ratio=ratio, samples_per_second=AS_LONG_AS / seconds)
    print(
        f"\n{1e9 * seconds / AS_LONG_AS:.0f} ns a sample, {ratio:.0f} times as fast as plain NumPy; apart: {apart:.1e}"
    )
    assert apart < 1e-6
    assert ratio > LEAST


def test_steps_where_the_force_is_straight_cost_little(benchmark, fit):
    """Eight times finer steps at a contact take less than three times as long: the rest of the way is one step."""
    problem, theta = replace(fit.problem, jobs=1), fit.theta
    finer = replace(problem, nsub=8 * problem.nsub)
    coarse = min(clock(problem, theta) for _ in range(9))
    benchmark.pedantic(lambda: finer.innovations(theta), rounds=9, warmup_rounds=1)
    assert benchmark.stats.stats.min < 3.0 * coarse


def clock(problem, theta):
    """Return the time (s) of one run."""
    begin = time.perf_counter()
    problem.innovations(theta)
    return time.perf_counter() - begin
