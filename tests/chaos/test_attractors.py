"""Distances between clouds of points and between sections of motions."""

import numpy as np
import pytest

from lostmotion.contracts import Motions
from lostmotion.diagnosis.compared_motions import take_section
from lostmotion_chaos.attractors import MOST, measure_distances
from lostmotion_chaos.signals.distances import distances, energy_distance, same_chance

PERIOD = 40.0


def motions(period=PERIOD, **states):
    """The motions of a diagnosis: their states by name, 40 samples a period of the drive or none."""
    return Motions(states, {}, {}, 0.01, period, 0.0)


def wandering(seed, samples=8000, middle=0.0):
    """States (samples, 2) of an orbit with a new amplitude each period, as chaos has it."""
    rng = np.random.default_rng(seed)
    size = np.repeat(1.0 + 0.4 * rng.random(samples // 40), 40)
    angle = 2 * np.pi * np.arange(samples) / PERIOD
    return np.stack([middle + size * np.sin(angle), size * np.cos(angle)], axis=1)


def test_energy_distance_of_two_points_is_twice_their_distance():
    points = np.array([[[0.0, 0.0], [0.0, 0.0], [3.0, 4.0], [3.0, 4.0]]])
    table = distances(points)
    assert energy_distance(table, np.arange(2), np.arange(2, 4)) == pytest.approx(10.0, abs=1e-6)


def test_energy_distance_is_that_of_scipy_in_one_dimension():
    from scipy.stats import energy_distance as scipys

    rng = np.random.default_rng(3)
    a, b = rng.standard_normal(60), 0.5 + rng.standard_normal(80)
    table = distances(np.concatenate([a, b])[None, :, None])
    own = energy_distance(table, np.arange(60), np.arange(60, 140))
    assert own == pytest.approx(scipys(a, b) ** 2, rel=1e-6)


def test_chance_is_even_for_equal_clouds_and_small_for_others():
    """Forty pairs of equal clouds: p below 0.05 in 2 of them on average; more than 8 has a chance of 1e-4."""
    rng = np.random.default_rng(5)
    small = 0
    for _ in range(40):
        table = distances(rng.standard_normal((1, 160, 2)))
        small += same_chance(table, 80, rng) < 0.05
    assert small <= 8
    moved = rng.standard_normal((1, 160, 2))
    moved[0, 80:] += 1.0
    assert same_chance(distances(moved), 80, rng) == pytest.approx(0.005)


def test_model_with_the_right_orbit_is_at_the_floor_and_another_is_not():
    shown = motions(recorded=wandering(1), before=wandering(2, middle=0.3), after=wandering(3))
    apart, strobed = measure_distances(shown, np.random.default_rng(0))
    assert strobed
    assert apart["before"].p < 0.01 < apart["after"].p
    assert apart["before"].value > 3.0 * apart["noise_floor"].value
    assert apart["after"].value < 3.0 * apart["noise_floor"].value


def test_without_a_drive_looks_at_the_whole_orbit_are_compared():
    shown = motions(None, recorded=wandering(1), before=wandering(2, middle=0.5))
    apart, strobed = measure_distances(shown, np.random.default_rng(0))
    assert not strobed
    assert apart["before"].status == "ok"
    assert apart["before"].p < 0.01


def test_short_recordings_and_runaways_have_a_status():
    runaway = wandering(2)
    runaway[500:] = np.nan
    apart, _ = measure_distances(motions(recorded=wandering(1), before=runaway), np.random.default_rng(0))
    assert apart["before"].status == "diverged"
    short = motions(recorded=wandering(1, 400), before=wandering(2, 400))
    apart, _ = measure_distances(short, np.random.default_rng(0))
    assert apart["before"].status == apart["noise_floor"].status == "too_short"


def test_sections_are_taken_at_the_phase_asked_for():
    points = take_section(wandering(1), PERIOD, 0.25)
    assert len(points) == 200
    np.testing.assert_allclose(points[:, 1], 0.0, atol=1e-9)
    assert MOST >= 200
