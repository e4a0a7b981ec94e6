"""Ranks of known truths: uniform ones pass, at the rate that the level says; those of a bad posterior do not."""

import numpy as np
import pytest
from scipy.stats import binom, norm

from lostmotion_trials.coverage.ranks import (
    DRAWS,
    choose_bin_count,
    compute_chi_square_p,
    compute_coverage_limits,
    compute_ecdf_band,
    compute_ecdf_p,
    compute_histogram_band,
    compute_rank,
    count_below,
    count_ranks,
)

MACHINES = 200
REPEATS = 2000


def ranks_of(rng, *, width=1.0, shift=0.0, machines=MACHINES):
    """Return ranks of truths from N(0, 1) among draws of posteriors that are N(shift, width^2) in place of N(0, 1)."""
    draws = shift + width * rng.standard_normal((machines, DRAWS))
    return np.sum(draws < rng.standard_normal((machines, 1)), axis=1)


@pytest.fixture(scope="module")
def uniform():
    """Ranks of so many perfect campaigns, (REPEATS, MACHINES)."""
    return np.random.default_rng(1).integers(0, DRAWS + 1, (REPEATS, MACHINES))


def limits(level):
    """Return between how many of the campaigns a test of this level rejects, all but one time in a thousand."""
    return binom.ppf([5e-4, 1.0 - 5e-4], REPEATS, level)


def test_chi_square_has_its_level(uniform):
    rejected = sum(compute_chi_square_p(ranks) < 0.01 for ranks in uniform)
    low, high = limits(0.01)
    assert low <= rejected <= high


def test_band_has_its_level(uniform):
    band = compute_ecdf_band(MACHINES)
    counts = np.stack([count_below(ranks) for ranks in uniform])
    left = int(np.sum(((counts < band.low) | (counts > band.high)).any(axis=1)))
    # Counts are whole numbers, so that the band has a little less than its level.
    assert limits(0.007)[0] <= left <= limits(0.01)[1]


def test_p_value_says_what_the_band_says(uniform):
    band = compute_ecdf_band(MACHINES, 0.2)
    chosen = uniform[:60]
    outside = [bool(((count_below(r) < band.low) | (count_below(r) > band.high)).any()) for r in chosen]
    assert 0 < sum(outside) < 30
    assert [compute_ecdf_p(r) <= 0.2 for r in chosen] == outside


def test_p_values_are_uniform_themselves(uniform):
    found = np.sort([compute_ecdf_p(ranks) for ranks in uniform[:150]])
    # Kolmogorov and Smirnov at one in a thousand.
    assert np.abs(found - (np.arange(150) + 0.5) / 150).max() < 1.95 / np.sqrt(150)


@pytest.mark.parametrize(
    "wrong", [{"width": 0.7}, {"width": 1.5}, {"shift": 0.35}, {"shift": -0.35}], ids=["narrow", "wide", "up", "down"]
)
def test_a_bad_posterior_is_refused(wrong):
    rng = np.random.default_rng(2)
    found = [compute_ecdf_p(ranks_of(rng, **wrong)) for _ in range(20)]
    assert np.mean(np.array(found) < 0.01) >= 0.9


@pytest.mark.parametrize("wrong", [{"width": 0.6}, {"width": 2.0}, {"shift": 0.5}], ids=["narrow", "wide", "up"])
def test_chi_square_refuses_a_bad_posterior(wrong):
    rng = np.random.default_rng(3)
    assert np.mean([compute_chi_square_p(ranks_of(rng, **wrong)) < 0.01 for _ in range(20)]) >= 0.9


def test_a_right_posterior_is_not_refused():
    rng = np.random.default_rng(4)
    assert min(compute_ecdf_p(ranks_of(rng)) for _ in range(10)) > 0.01


@pytest.mark.parametrize("machines", [1, 3, 10, 400])
def test_bands_hold_for_few_machines_and_many(machines):
    band = compute_ecdf_band(machines)
    assert np.all(band.low <= band.middle)
    assert np.all(band.middle <= band.high)
    ranks = np.random.default_rng(machines).integers(0, DRAWS + 1, (300, machines))
    counts = np.stack([count_below(r) for r in ranks])
    assert np.mean(((counts < band.low) | (counts > band.high)).any(axis=1)) < 0.035


def test_rank_is_counted_among_even_draws():
    chain = norm.ppf((np.arange(990) + 0.5) / 990)
    mixed = np.random.default_rng(5).permutation(chain).reshape(10, 99)
    assert compute_rank(-10.0, mixed) == 0
    assert compute_rank(10.0, mixed) == DRAWS
    assert abs(compute_rank(0.0, mixed) - 50) < 15
    assert compute_rank(0.0, np.sort(chain).reshape(10, 99)) in (49, 50)


def test_bins_hold_five_each():
    assert [choose_bin_count(n) for n in (1, 9, 10, 30, 60, 100, 5000)] == [1, 1, 2, 5, 10, 20, 20]
    assert count_ranks(np.array([0, 4, 5, 99]), 20).tolist() == [2, 1, *[0] * 16, 0, 1]
    assert np.isnan(compute_chi_square_p(np.arange(9)))
    assert np.isnan(compute_ecdf_p(np.array([], dtype=int)))


def test_limits_are_those_of_the_binomial_law():
    assert compute_coverage_limits(200, 0.95) == (181, 197) == tuple(binom.ppf([0.005, 0.995], 200, 0.95).astype(int))
    assert compute_histogram_band(200, 20) == (3, 19)
