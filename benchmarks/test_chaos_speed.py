"""The chaos laboratory stays ahead of plain NumPy and SciPy: `pytest benchmarks`. Ratios, since times are noise."""

import importlib

import pytest

from yardstick import ratio_of

MOST = {
    "embedding": {"mutual information, lags 0-100, 64 bins": 0.3, "Cao and false neighbours, dimensions 1-8": 1.5},
    "surrogates": {"39 IAAFT surrogates": 0.3, "prediction error": 0.5},
    "denoising": {
        "simple scheme, 2 % noise": 0.2,
        "simple scheme, 10 % noise": 0.4,
        "local projection, 2 % noise": 1.5,
    },
    "exponents": {"Rosenstein, refined, with interval": 1.5, "Kantz, three shells, with interval": 3.0},
    "flows": {
        "exact flow, 10,000 periods with tangent, against the general kernel": 0.2,
        "general kernel, 100 periods with tangent, against DOP853 without": 0.1,
    },
}
"""The largest ratio of our time to that of the plain version: two to three times what a quiet machine shows."""
CASES = [(area, name, most) for area, limits in MOST.items() for name, most in limits.items()]


@pytest.mark.parametrize(("area", "name", "most"), CASES, ids=[name for _, name, _ in CASES])
def test_ratio_to_the_plain_version(benchmark, area, name, most):
    (case,) = (c for c in importlib.import_module(f"yardstick_{area}").CASES if c.name == name)
    benchmark.pedantic(case.ours, rounds=3, iterations=1, warmup_rounds=1)
    ratio = benchmark.extra_info["ratio"] = ratio_of(case.ours, case.plain)
    assert ratio < most


def test_correlation_sums_against_a_tree_search(benchmark):
    """The plain sums take a minute; the yardstick is another plain search of neighbours."""
    (ours,) = (c.ours for c in importlib.import_module("yardstick_dimension").CASES if c.name.startswith("correlation"))
    (tree,) = (c.plain for c in importlib.import_module("yardstick_embedding").CASES if c.name.startswith("Cao"))
    benchmark.pedantic(ours, rounds=1, iterations=1, warmup_rounds=1)
    ratio = benchmark.extra_info["ratio"] = ratio_of(ours, tree, rounds=3)
    assert ratio < 12.0
