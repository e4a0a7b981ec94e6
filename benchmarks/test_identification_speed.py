"""How fast the likelihood of identify is, over the same filter in plain NumPy in the same run: `pytest benchmarks`."""

from dataclasses import replace

import numpy as np
import pytest
from reference import Reference

from identification import Machine, fitted, measured, posed
from yardstick import ratio_of

LEAST = 500.0
"""Plain NumPy over ours on one core, whatever else the machine does; a quiet one has several thousand."""
AS_LONG_AS, PART, POINTS = 6_000, 500, 16


@pytest.fixture(scope="module")
def fit():
    """The fit of 6000 samples of Case 1 in chaos, with steps finer than identify takes."""
    return fitted(posed(measured(Machine(), AS_LONG_AS // 200, 1, 1e-3)[1]))


def near(theta):
    """Return points about `theta`, (POINTS, parameters)."""
    return theta + 1e-6 * np.arange(POINTS)[:, None]


def test_likelihood_outruns_plain_numpy_and_agrees_with_it(benchmark, fit):
    posterior, theta = replace(fit.posterior, jobs=1), fit.theta
    part = posterior.on((posterior.observations[0].part(0, PART),))

    def plainly():
        return (
            replace(part, dynamics=Reference(part.system, part.active, part.dynamics.nsub))
            .innovations(theta)
            .log_likelihood
        )

    benchmark.pedantic(lambda: posterior.log_likelihood(near(theta)), rounds=9, warmup_rounds=1)
    often = ratio_of(lambda: posterior.log_likelihood(near(theta)), plainly, rounds=12)
    ratio = often / POINTS
    ours, plain = part.innovations(theta).log_likelihood, plainly()
    faster = AS_LONG_AS / PART / ratio
    benchmark.extra_info.update(ratio=ratio, samples_per_second=POINTS * AS_LONG_AS / benchmark.stats.stats.min)
    print(f"\n{faster:.0f} times as fast as plain NumPy; apart: {abs(plain - ours) / abs(ours):.1e}")
    assert abs(plain - ours) < 1e-6 * abs(ours)
    assert faster > LEAST


def test_steps_where_the_force_is_straight_cost_little(benchmark, fit):
    """Eight times finer steps at a contact take less than three times as long: the rest of the way is one step."""
    posterior, theta = replace(fit.posterior, jobs=1), fit.theta
    finer = posterior.stepped(8 * posterior.dynamics.nsub)
    benchmark.pedantic(lambda: finer.log_likelihood(near(theta)), rounds=9, warmup_rounds=1)
    ratio = ratio_of(
        lambda: finer.log_likelihood(near(theta)), lambda: posterior.log_likelihood(near(theta)), rounds=15
    )
    benchmark.extra_info["ratio"] = ratio
    assert ratio < 3.0
