"""Independent looks: known answers, and how often series that do not repeat are taken for such that do."""

import numpy as np
import pytest
from scipy.signal import lfilter

from lostmotion.signals.repetition import SAME, cycles_of, period_found, repeated_share, repetition_of

PERIOD, SAMPLES, TRAIN = 41.3, 3000, 2100


def cycle(t, period=PERIOD):
    angle = 2.0 * np.pi * t / period
    return np.cos(angle) + 0.4 * np.cos(3.0 * angle + 1.0) + 0.1 * np.sin(5.0 * angle)


def periodic(rng, noise=0.02, samples=SAMPLES, **more):
    return cycle(np.arange(samples), **more) + noise * rng.standard_normal(samples)


def multisine(rng):
    """Return a sum of lines that share no period within the recording."""
    t, paces = np.arange(SAMPLES), rng.uniform(0.05, 0.4, 12)
    phases, sizes = rng.uniform(0.0, 2.0 * np.pi, (2, 12))
    return np.sum((0.2 + sizes[:, None]) * np.cos(paces[:, None] * t + phases[:, None]), axis=0)


def sweep(rng):
    t = np.arange(SAMPLES)
    return np.cos(0.05 * t + 0.5 * rng.uniform(0.5, 2.0) * 1e-4 * t**2 + rng.uniform(0.0, 6.0))


def driven_by_noise(rng):
    """Return a resonance of 41 samples that rings for ten cycles, pushed by white noise."""
    near = 1.0 - 1.0 / 400.0
    return lfilter([1.0], [1.0, -2.0 * near * np.cos(2.0 * np.pi / PERIOD), near**2], rng.standard_normal(SAMPLES))


def chaos(rng):
    """Return Duffing's oscillator where its motion is chaotic, 40 samples to a period of its drive."""
    step, x, v, seen = 2.0 * np.pi / (1.2 * 400.0), rng.uniform(-1.0, 1.0), 0.0, []
    for k in range((SAMPLES + 400) * 10):
        v += step * (x - x**3 - 0.3 * v + 0.5 * np.cos(1.2 * k * step))
        x += step * v
        if k % 10 == 0:
            seen.append(x)
    return np.array(seen[400:])


def decay(rng):
    """Return blows of random size and time, each of which dies away."""
    force = np.zeros(SAMPLES)
    force[np.sort(rng.choice(SAMPLES, 12, replace=False))] = rng.uniform(0.3, 1.5, 12) * rng.choice([-1, 1], 12)
    return lfilter([1.0], [1.0, -2.0 * 0.98 * np.cos(0.15), 0.98**2], force)


def noisy(x, rng, share=0.02):
    return x + share * np.std(x) * rng.standard_normal(len(x)), share * np.std(x)


NOT_REPEATED = {"multisine": multisine, "sweep": sweep, "noise": driven_by_noise, "chaos": chaos, "blows": decay}


@pytest.mark.parametrize("noise", [0.0, 0.01, 0.1, 0.2])
def test_cycle_that_comes_again_is_one_look(noise):
    x = periodic(np.random.default_rng(0), noise)
    for period in (PERIOD, None):
        found = repetition_of(x, noise, period)
        assert found.cycles == int((SAMPLES - 1) // PERIOD)
        assert found.period == pytest.approx(PERIOD, rel=1e-3)
        assert found.share > 0.995
        assert 1.0 <= found.distinct < 1.1
    assert repeated_share(x[:TRAIN], x[TRAIN:], noise) > 0.998


def test_two_cycles_in_turn_are_two_looks():
    """A motion that repeats after two periods of its drive has two distinct cycles, however often."""
    rng = np.random.default_rng(1)
    x = periodic(rng) + 0.5 * np.cos(np.pi * np.arange(SAMPLES) / PERIOD)
    found = repetition_of(x, 0.02, PERIOD)
    assert found.distinct == pytest.approx(2.0, abs=0.1)
    assert found.share < 0.95
    assert period_found(x, 0.02, PERIOD) == pytest.approx(2.0 * PERIOD)
    assert repeated_share(x[:TRAIN], x[TRAIN:], 0.02) > 0.998


def test_levels_are_as_many_looks_as_there_are():
    x = periodic(np.random.default_rng(2)) * np.repeat([1.0, 2.0, 3.0, 4.0], SAMPLES // 4)
    assert repetition_of(x, 0.02, PERIOD).distinct == pytest.approx(4.0, abs=0.6)


def test_share_of_the_mean_cycle_is_known():
    """Noise that is no measurement noise, a tenth of the variance, is what the mean cycle leaves."""
    rng = np.random.default_rng(3)
    x = periodic(rng, 0.0, 40_000)
    other = driven_by_noise(rng)
    x = x[:SAMPLES] + np.sqrt(np.var(x) / 9.0) * other / np.std(other)
    assert repetition_of(x, 0.0, PERIOD).share == pytest.approx(0.9, abs=0.04)


@pytest.mark.parametrize("name", NOT_REPEATED)
def test_series_that_does_not_repeat_is_not_taken_for_one_that_does(name):
    """None of 40 series of each kind, 8 of chaos (0 to 9 and 0 to 37 %, Clopper-Pearson 95 %).

    Between blows a machine rests, in one cycle of rest as in the next: of those several are distinct, not most.
    """
    repeated = found = few = 0
    for seed in range(40 if name != "chaos" else 8):
        rng = np.random.default_rng([4, seed])
        x, noise = noisy(NOT_REPEATED[name](rng), rng)
        share = repeated_share(x[:TRAIN], x[TRAIN:], noise)
        repeated += share is not None and share > SAME
        found += period_found(x, noise) is not None
        looks = repetition_of(x, noise, PERIOD if name != "chaos" else 40.0)
        few += looks.distinct < (2.0 if name == "blows" else 0.1 * looks.cycles)
    assert (repeated, found, few) == (0, 0, 0)


@pytest.mark.slow
def test_series_that_repeats_is_always_found():
    """All of 40 cycles of random shape, period and noise (91 to 100 %, Clopper-Pearson 95 %)."""
    for seed in range(40):
        rng = np.random.default_rng([5, seed])
        angle = 2.0 * np.pi * np.arange(SAMPLES) / rng.uniform(12.0, 300.0)
        waves = [rng.standard_normal() * np.cos(k * angle + rng.uniform(0.0, 6.0)) / k**2 for k in range(1, 4)]
        x, noise = noisy(sum(waves), rng, float(rng.choice([0.0, 0.03, 0.2])))
        assert repeated_share(x[:TRAIN], x[TRAIN:], noise) > SAME
        assert period_found(x, noise) is not None
        assert repetition_of(x, noise).distinct < 1.15


def test_multisine_that_begins_again_is_found_at_its_own_period():
    rng = np.random.default_rng(6)
    t, base = np.arange(SAMPLES), 2.0 * np.pi / 731.0
    x = sum(np.cos(k * base * t + rng.uniform(0.0, 6.0)) for k in range(5, 30))
    x, noise = noisy(x, rng)
    assert period_found(x, noise) == pytest.approx(731.0, abs=0.1)
    assert repetition_of(x, noise).cycles == 4
    assert repeated_share(x[:TRAIN], x[TRAIN:], noise) > 0.995


def test_another_level_of_the_same_cycle_is_not_a_repetition():
    rng = np.random.default_rng(7)
    x = periodic(rng)
    assert repeated_share(x[:TRAIN], 1.2 * x[TRAIN:], 0.02) < 0.98


def test_nothing_is_said_of_noise_of_rest_and_of_gaps():
    rng = np.random.default_rng(8)
    white = rng.standard_normal(SAMPLES)
    holes = periodic(rng)
    holes[5] = np.nan
    for x, noise in ((white, 1.0), (np.zeros(SAMPLES), 0.0), (holes, 0.02)):
        assert repetition_of(x, noise, PERIOD) is None
        assert period_found(x, noise) is None
        assert repeated_share(x[:TRAIN], x[TRAIN:], noise) is None


def test_too_few_cycles_are_not_compared():
    x = periodic(np.random.default_rng(9))
    assert repetition_of(x[:60], 0.02, PERIOD) is None
    assert repetition_of(x, 0.02, 4.0) is None


def test_cycles_are_read_at_the_same_phases():
    table = cycles_of(cycle(np.arange(2000)), PERIOD)
    assert table.shape == (int(1999 // PERIOD), 41)
    assert np.ptp(table, axis=0).max() < 2e-3
