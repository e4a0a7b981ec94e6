"""Sections: values at a drive phase between samples, crossings without echoes of noise, and returns after k periods."""

from __future__ import annotations

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion_chaos.signals.sections import poincare, return_spread, stroboscopic

DT, PERIOD = 0.01, 0.3737


def motion(t):
    """Return a motion of period two."""
    return np.sin(2 * np.pi * t / PERIOD) + 0.3 * np.cos(np.pi * t / PERIOD)


def sampled(n=4000, noise=0.0):
    return motion(np.arange(n) * DT) + noise * np.random.default_rng(0).normal(size=n)


@pytest.mark.parametrize("phase", [0.0, 0.25, 0.9])
def test_values_between_samples_are_those_of_the_motion(phase):
    section = stroboscopic(sampled(), DT, PERIOD, phase=phase, lag=5)
    inner = slice(1, -1)
    assert section.time[0] == pytest.approx(phase * PERIOD)
    assert np.diff(section.time) == pytest.approx(PERIOD)
    assert section.first[inner] == pytest.approx(motion(section.time)[inner], abs=1e-4)
    assert section.second[inner] == pytest.approx(motion(section.time + 5 * DT)[inner], abs=1e-4)
    assert section.points.shape == (len(section.time), 2)


def test_whole_numbers_of_samples_give_the_samples():
    x = np.random.default_rng(1).normal(size=403)
    section = stroboscopic(x, 0.1, 2.0, lag=3)
    assert section.first == pytest.approx(x[:400:20], abs=0.0)
    assert section.second == pytest.approx(x[3:403:20], abs=0.0)


def test_one_point_a_period_up_to_the_end():
    assert len(stroboscopic(np.arange(101.0), 1.0, 20.0, lag=0).time) == 6
    assert len(stroboscopic(np.arange(101.0), 1.0, 20.0, lag=1).time) == 5


@pytest.mark.parametrize(("period", "lag"), [(np.nan, 1), (100.0, 1), (1e-3, 1), (1.0, 5000), (1.0, -1)])
def test_what_cannot_be_is_refused(period, lag):
    with pytest.raises(DataError):
        stroboscopic(sampled(), DT, period, lag=lag)


def test_crossings_are_upward_and_refined():
    t = np.arange(2000) * DT
    section = poincare(np.sin(2 * np.pi * t), dt=DT, lag=10)
    assert section.time == pytest.approx(np.arange(1, len(section.time) + 1), abs=1e-3)
    assert section.first == pytest.approx(np.sin(0.2 * np.pi), abs=1e-3)
    assert section.second == pytest.approx(np.sin(0.4 * np.pi), abs=1e-3)


def test_noise_makes_no_crossings_of_its_own():
    t = np.arange(20_000) * 0.001
    noisy = np.sin(2 * np.pi * t) + 0.02 * np.random.default_rng(2).normal(size=t.size)
    assert len(poincare(noisy, dt=0.001, lag=10).time) == 19


def test_level_that_is_never_crossed_gives_no_points():
    assert poincare(sampled(), dt=DT, lag=3, level=9.0).points.shape == (0, 2)


def test_delay_longer_than_the_series_is_refused():
    with pytest.raises(DataError, match="lag of 300"):
        poincare(sampled(500), dt=DT, lag=300)


def test_motion_of_period_two_returns_after_every_second_period():
    spread = return_spread(sampled(), DT, PERIOD)
    assert spread.shape == (16,)
    assert np.all(spread[1::2] < 1e-3)
    assert np.all(spread[::2] > 0.4)


def test_noise_is_taken_off_the_spread():
    x = sampled(noise=0.2)
    raw, clean = (return_spread(x, DT, PERIOD, most=4, noise=noise) for noise in (0.0, 0.2))
    assert raw[1] == pytest.approx(np.sqrt(2) * 0.2 / np.std(x), rel=0.15)
    assert clean[1] < 0.08
    assert clean[0] == pytest.approx(return_spread(sampled(), DT, PERIOD, most=1)[0], rel=0.05)


def test_white_noise_never_returns():
    x = np.random.default_rng(3).normal(size=20_000)
    assert return_spread(x, 1.0, 20.0) == pytest.approx(np.sqrt(2), rel=0.03)


def test_series_too_short_for_a_return_says_nothing_of_it():
    spread = return_spread(sampled(200), DT, PERIOD, most=16)
    assert np.isfinite(spread[:2]).all()
    assert np.isnan(spread[3:]).all()


def test_huge_offset_changes_nothing():
    x = sampled()
    assert return_spread(x + 1e6, DT, PERIOD) == pytest.approx(return_spread(x, DT, PERIOD), abs=1e-6)


@pytest.mark.real
def test_section_of_the_backlash_oscillator_is_the_one_computed_from_its_model(shared):
    # The same orbit, once sampled 200 times a period and once followed by exact pieces from period to period.
    data = np.load(shared / "reference" / "lin_backlash.npz")
    drive = 2.0 * np.pi / 40.0
    for name, dt, rows in (("x_200pp", "dt200", 8), ("x_50pp", "dt50", 8)):
        section = stroboscopic(data[name], float(data[dt]), drive, lag=3)
        assert section.first[:rows] == pytest.approx(data["strobe_x"][:rows], abs=1e-6)
