"""When a model disagrees: windows, hits and recordings against chance, with the false alarms that are stated."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import binom

from lostmotion.diagnosis.disagreement_times import compare_by_recording, compare_over_time
from lostmotion.inference.disagreement import (
    average_windows,
    compute_recording_p,
    compute_trend,
    compute_window_p,
    find_memory,
    make_even_windows,
    make_hit_windows,
)
from lostmotion.likelihood.observation import Observation

DT = 1e-3


def squares(rng, samples=3000, memory=0.0):
    """Return squared one-step errors of a model that holds; with a memory where it holds on average only."""
    noise = lfilter([np.sqrt(1.0 - memory**2)], [1.0, -memory], rng.normal(size=samples + 100))[100:]
    return noise**2


def observed(samples=3000, excitation=None):
    rng = np.random.default_rng(0)
    push = rng.normal(size=samples) if excitation is None else excitation
    return Observation.of("seen", rng.normal(size=samples), push[:, None], DT, "position", driven=("force",))


def test_windows_hold_whole_periods_and_means_are_those_of_loops():
    windows = make_even_windows(1000, period=120.0)
    assert len(windows) == 8
    assert np.diff(windows.edges).min() >= 120
    values = squares(np.random.default_rng(1), 1000)
    values[3] = np.nan
    slow = [np.mean([v for v in values[a:b] if np.isfinite(v)]) for a, b in pairwise(windows.edges)]
    np.testing.assert_allclose(average_windows(values, windows), slow)


def test_a_memory_is_measured_and_a_louder_stretch_is_none():
    rng, windows = np.random.default_rng(2), make_even_windows(6000)
    white = squares(rng, 6000)
    white[1000:1400] *= 5.0
    assert find_memory(white, windows) <= 3
    assert 5 <= find_memory(squares(rng, 6000, 0.9), windows) <= 40


@pytest.mark.slow
@pytest.mark.parametrize("memory", [0.0, 0.8])
def test_chance_is_seldom_taken_for_a_disagreement(memory):
    """At 5 % over all windows, 200 recordings: at most the 99.9 % point of the binomial, 21. Seeded.

    Errors with a memory of 0.8 from sample to sample are what a model without a slow force leaves.
    """
    rng, wrong = np.random.default_rng(3), 0
    observation = observed()
    for _ in range(200):
        wrong += compare_over_time(observation, {"before": squares(rng, memory=memory)}, rng).worst.beyond_chance
    assert wrong <= binom.ppf(0.999, 200, 0.05)


def test_the_stretch_that_disagrees_is_named_with_its_times():
    rng = np.random.default_rng(4)
    before, after = squares(rng), squares(rng)
    before[1500:1600] *= 4.0
    told = compare_over_time(observed(), {"before": before, "after": after}, rng)
    worst = told.worst_before
    assert worst.beyond_chance
    assert (worst.begin, worst.end) == (1.5, 1.6)
    assert not told.worst.beyond_chance
    assert told.says.startswith("The nominal model disagrees most between 1.5 and 1.6 s (")
    assert len(told.edges) == len(told.before) + 1 == len(told.after) + 1
    after[600:700] *= 4.0
    told = compare_over_time(observed(), {"before": before, "after": after}, rng)
    assert told.says.startswith("The model disagrees most between 0.6 and 0.7 s (")


def struck(rng, loudest=1.0):
    """Return a recording of six hits and one at its end, and squared errors that die away after each.

    The third is `loudest`.
    """
    starts, push = np.arange(100, 3000, 480), np.zeros(3000)
    size = np.ones(3000)
    for i, start in enumerate(starts):
        push[start : start + 8] = 100.0 * np.sin(np.pi * np.arange(0.5, 8.5) / 8.0)
        length = min(480, 3000 - start)
        size[start : start + length] += 5.0 * np.exp(-np.arange(length) / 60.0) * (loudest if i == 2 else 1.0)
    return observed(excitation=push), size * squares(rng), starts


@pytest.mark.slow
def test_hits_are_compared_at_equal_times_after_each():
    """Errors that die away after every hit alike are no disagreement of one hit: 100 recordings at 5 %, at most 13."""
    rng, wrong = np.random.default_rng(5), 0
    for _ in range(100):
        observation, values, starts = struck(rng)
        p = compute_window_p(values, make_hit_windows(3000, starts), rng)
        wrong += bool(np.min(p) <= 0.05)
    assert wrong <= binom.ppf(0.999, 100, 0.05)
    observation, values, starts = struck(rng, 4.0)
    told = compare_over_time(observation, {"before": values}, rng)
    assert told.windows == "hits"
    assert told.worst.window == 2
    assert told.says.startswith(f"The model disagrees most after hit 3, at {starts[2] * DT:.4g} s (")
    assert told.peaks.values == pytest.approx([100.0] * 7, rel=0.05)


def test_the_level_that_disagrees_most_is_named_and_a_trend_is_told():
    rng, levels = np.random.default_rng(6), [1.0, 2.0, 4.0, 8.0]
    recordings = [observed(2000, level * rng.normal(size=2000)) for level in levels]
    parts = [squares(rng, 2000) * (1.0 + 0.1 * level) for level in levels]
    told = compare_by_recording(recordings, {"before": parts}, 3, "translation", rng)
    assert [row.fitted for row in told.rows] == [True, True, True, False]
    assert told.rows[3].level == pytest.approx(8.0, rel=0.1)
    assert "the disagreement grows with the level" in told.says
    assert told.trend.after.p < 0.01
    alike = [squares(rng, 2000) for _ in levels]
    told = compare_by_recording(recordings, {"before": parts, "after": alike}, 3, "translation", rng)
    assert told.says.startswith("Of 4 recordings the nominal model disagrees most in seen (level ")
    assert compare_by_recording(recordings, {"before": alike}, 3, "translation", rng).says == ""


@pytest.mark.slow
def test_recordings_that_agree_alike_are_seldom_told_apart():
    """Four recordings, 200 times at 5 %: at most the 99.9 % point of the binomial, 21, for each of both tests."""
    rng, wrong, tends = np.random.default_rng(7), 0, 0
    for _ in range(200):
        parts = [squares(rng, 800, 0.5) for _ in range(4)]
        wrong += bool(np.min(compute_recording_p(parts, rng)) <= 0.05)
        tends += compute_trend(parts, np.array([1.0, 2.0, 4.0, 8.0]), rng)[1] <= 0.05
    assert max(wrong, tends) <= binom.ppf(0.999, 200, 0.05)


def test_too_little_is_not_tested():
    rng = np.random.default_rng(8)
    assert compute_window_p(squares(rng, 60), make_even_windows(60), rng) is None
    assert compute_trend([squares(rng), squares(rng)], np.array([1.0, 2.0]), rng) is None
