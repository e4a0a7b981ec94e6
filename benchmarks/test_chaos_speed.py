"""The chaos laboratory stays ahead of plain NumPy and SciPy: `pytest benchmarks`. Ratios, since times are noise."""

import importlib

import pytest

from yardstick import clocked

MOST = {
    "embedding": {"mutual information, lags 0-100, 64 bins": 0.3, "Cao and false neighbours, dimensions 1-8": 1.5},
    "surrogates": {"39 IAAFT surrogates": 0.3, "prediction error": 0.5},
    "denoising": {"simple scheme, 2 % noise": 0.2, "simple scheme, 10 % noise": 0.4},
    "flows": {"exact flow, 10,000 periods with tangent, against the general kernel": 0.2},
}
"""The largest ratio of our time to that of the plain version: two to three times what a quiet machine shows."""
CASES = [(area, name, most) for area, limits in MOST.items() for name, most in limits.items()]


@pytest.mark.parametrize(("area", "name", "most"), CASES, ids=[name for _, name, _ in CASES])
def test_ratio_to_the_plain_version(benchmark, area, name, most):
    (case,) = (c for c in importlib.import_module(f"yardstick_{area}").CASES if c.name == name)
    case.ours()
    benchmark.pedantic(case.ours, rounds=5, iterations=1)
    plain = clocked(case.plain, 1)
    benchmark.extra_info["ratio"] = benchmark.stats.stats.min / plain
    assert benchmark.stats.stats.min < most * plain
