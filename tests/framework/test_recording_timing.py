"""Time columns: what rounding explains is accepted, what it does not is refused."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.recording.timing import EvenClock, even_clock, resample_channel

N = 20000
EVEN = np.arange(N)


def printed(time: np.ndarray, form: str) -> np.ndarray:
    return np.array([float(form % t) for t in time])


@pytest.mark.parametrize(
    ("time", "dt"),
    [
        (EVEN / 1000, 1e-3),
        (EVEN / 1000 + 1.7e9, 1e-3),
        (EVEN / 1024 - 3, 1 / 1024),
        (printed(EVEN / 1000, "%.6f"), 1e-3),
        (printed(EVEN / 4096, "%.6f"), 1 / 4096),
        (printed(EVEN / 1024, "%.3f"), 1 / 1024),
        (printed(EVEN / 1024 + 100, "%.6g"), 1 / 1024),
        (printed(EVEN / 44100, "%.5f"), 1 / 44100),
        ((EVEN / 1000).astype(np.float32).astype(float), 1e-3),
        ((EVEN / 1000 + 900).astype(np.float32).astype(float), 1e-3),
        (EVEN / 1000 + 4e-6 * np.sin(EVEN), 1e-3),
    ],
)
def test_an_even_grid_is_seen_through_rounding(time: np.ndarray, dt: float) -> None:
    assert even_clock(time, "a.csv").dt == pytest.approx(dt, rel=2e-5)


def test_rounding_that_matters_is_noted() -> None:
    assert "rounded to 0.001 s" in even_clock(printed(EVEN / 1024, "%.3f"), "a.csv").notes[0]
    assert even_clock(EVEN / 1000, "a.csv").notes == ()


def jittered(scale: float) -> np.ndarray:
    return np.cumsum(1e-3 * (1 + scale * np.random.default_rng(1).uniform(-1, 1, N)))


@pytest.mark.parametrize(
    ("time", "words"),
    [
        (jittered(0.3), ["time steps run from", "resample", "rate = "]),
        (np.round(jittered(0.9), 3), ["resample"]),
        (np.cumsum(np.random.default_rng(1).choice([0.010, 0.011], N)).round(3), ["deviates", "resample"]),
        (np.delete(EVEN / 1000, 7), ["gap of 0.002 s", "0.006 s", "0.008 s"]),
        (np.delete(EVEN / 1000, slice(500, 900)), ["gap of 0.401 s", "t_end = 0.499", "t_start = 0.9"]),
        (np.delete(EVEN / 1024, [7, 500]), ["gap", "1 more"]),
        (np.delete(printed(EVEN / 1024, "%.3f"), slice(7, 9)), ["gap"]),
        (np.delete((EVEN / 1000).astype(np.float32).astype(float), 7), ["gap"]),
        (np.insert(EVEN / 1000, 7, 0.007), ["only 0 s", "sample 8", "repeated"]),
        (np.concatenate([EVEN, EVEN]) / 1000, ["decreases", "sample 20000"]),
        (np.zeros(N), ["stays at 0 s"]),
        (np.where(EVEN == 5, np.nan, EVEN), ["sample 5", "nan"]),
        (np.floor(EVEN / 1000), ["rounded to 1 s", "more digits", "rate"]),
    ],
)  # fmt: skip
def test_uneven_time_is_refused(time: np.ndarray, words: list[str]) -> None:
    with pytest.raises(DataError) as caught:
        even_clock(time, "a.csv")
    message = str(caught.value)
    assert [w for w in ["a.csv", *words] if w not in message] == [], message


@pytest.mark.parametrize("step", [1e-300, 1e-15, 1e9, 1e300])
def test_a_step_that_no_recorder_has_is_refused(step: float) -> None:
    with pytest.raises(DataError, match="sampling step comes to"):
        even_clock(step * np.arange(200.0), "run.csv")


def late(share: float, seed: int = 0, rate: float = 1000.0) -> np.ndarray:
    """Stamps of even samples, each off by noise of that share of the step (rms)."""
    return (EVEN + share * np.random.default_rng(seed).normal(size=N)) / rate


def uneven(share: float, seed: int = 0, rate: float = 1000.0) -> np.ndarray:
    """Times of samples whose steps differ by noise of that share of the step (rms)."""
    return np.cumsum(1.0 + share * np.random.default_rng(seed).normal(size=N)) / rate


@pytest.mark.parametrize("share", [0.002, 0.006, 0.01])
@pytest.mark.parametrize("seed", range(5))
def test_jitter_leaves_the_mean_rate(share: float, seed: int) -> None:
    clock = even_clock(late(share, seed), "a.csv")
    # The standard error of the slope of a line through n points with errors s is s sqrt(12) / n ** 1.5.
    assert abs(clock.dt - 1e-3) < 5 * share * 1e-3 * math.sqrt(12) / N**1.5
    assert abs(clock.start) < 5 * share * 1e-3 * 2 / math.sqrt(N)
    assert clock.uneven
    said = re.match(r"time stamps jitter by ([\d.]+) % of the step", clock.notes[0])
    assert float(said[1]) == pytest.approx(100 * share, rel=0.05)
    steps = even_clock(uneven(share, seed), "a.csv")
    assert abs(steps.dt - 1e-3) < 5 * 1.2 * share * 1e-3 / math.sqrt(N)  # sqrt(6 / 5) times that of the mean step
    assert steps.uneven


def test_what_rounding_explains_is_not_resampled() -> None:
    for time in (EVEN / 1000, printed(EVEN / 1024, "%.3f"), (EVEN / 1000 + 900).astype(np.float32).astype(float)):
        clock = even_clock(time, "a.csv")
        assert not clock.uneven
        assert clock.start == time[0]


@pytest.mark.parametrize("share", [0.03, 0.1, 0.3])
@pytest.mark.parametrize("stamps", [late, uneven], ids=["late", "uneven"])
def test_the_rate_that_is_advised_is_the_true_one(share: float, stamps: Callable[..., np.ndarray]) -> None:
    time = np.sort(stamps(share))
    with pytest.raises(DataError, match="give rate = ") as caught:
        even_clock(time, "a.csv")
    found = float(re.search(r"rate = ([\d.]+)", str(caught.value))[1])
    assert found == pytest.approx(1000.0, rel=6 * share / math.sqrt(N) + 1e-5)


def test_a_lost_sample_among_stamps_that_jitter_is_a_gap() -> None:
    with pytest.raises(DataError, match=r"gap of 0\.002"):
        even_clock(np.delete(late(0.006), 700), "a.csv")
    with pytest.raises(DataError, match="moves by only"):
        even_clock(np.insert(late(0.006), 700, late(0.006)[700]), "a.csv")


@pytest.mark.parametrize("jitter", [0.0, 0.0005])
def test_a_rate_that_changes_is_refused(jitter: float) -> None:
    with pytest.raises(DataError, match="deviates"):
        even_clock(late(jitter) + 0.03 * (EVEN / N) ** 2, "a.csv")


def tone(time: np.ndarray) -> np.ndarray:
    """Two sines of ten samples a period and more."""
    return np.sin(2 * np.pi * 37.0 * time) + 0.5 * np.cos(2 * np.pi * 100.0 * time)


def test_resampling_puts_values_where_the_grid_is() -> None:
    for time in (late(0.01), uneven(0.01)):
        clock = even_clock(time, "a.csv")
        grid = clock.start + clock.dt * EVEN
        error = resample_channel(time, tone(time), clock) - tone(grid)
        before = tone(time) - tone(grid)
        assert np.abs(error[5:-5]).std() < 0.01 * before.std()


def test_lost_samples_stay_lost_and_spoil_no_others() -> None:
    time = late(0.006)
    values = tone(time)
    lost = np.r_[0, 40, 500:600, N - 1]
    values[lost] = np.nan
    clock = even_clock(time, "a.csv")
    got = resample_channel(time, values, clock)
    assert np.array_equal(np.flatnonzero(np.isnan(got)), lost)
    seen = np.setdiff1d(EVEN[5:-5], lost)
    assert np.abs(got - tone(clock.start + clock.dt * EVEN))[seen].max() < 2e-3
    slow = np.where(EVEN % 10 == 0, tone(time), np.nan)
    assert np.array_equal(np.isfinite(resample_channel(time, slow, clock)), EVEN % 10 == 0)


def test_samples_beside_a_gap_are_lost_where_the_grid_lies_between_them() -> None:
    time, clock = EVEN / 1000 + 0.0004, EvenClock(1e-3, True, (), 0.0)
    values = np.where(EVEN == 100, np.nan, tone(time))
    assert np.flatnonzero(np.isnan(resample_channel(time, values, clock))).tolist() == [100, 101]


def test_a_held_value_is_not_interpolated() -> None:
    values = np.repeat(np.arange(N // 20), 20).astype(float)
    time = late(0.01)
    assert np.array_equal(resample_channel(time, values, even_clock(time, "a.csv"), hold="step"), values)
