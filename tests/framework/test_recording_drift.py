"""Two clocks that drift apart: found where they do, silent where they do not, chaotic and real machines among them.

Responses to many tones are closed forms; those of oscillators with a gap come from scipy's DOP853.
"""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import lsim

from lostmotion.recording import read_columns
from lostmotion.recording.drift import clock_drift, note_drift

DT = 1e-3


def response(frequency: np.ndarray, own: float = 10.0, damping: float = 0.05) -> np.ndarray:
    """Return position over force of an oscillator of 1 kg (`own` in Hz)."""
    omega, zero = 2 * math.pi * frequency, 2 * math.pi * own
    return np.asarray(1.0 / (zero**2 - omega**2 + 2j * damping * zero * omega))


def linear(
    seed: int, ppm: float = 0.0, *, tones: int = 400, noise: float = 0.01, seconds: float = 60.0
) -> list[np.ndarray]:
    """Return the drive and the position of an oscillator, the second read by a clock that is slow by `ppm`."""
    rng = np.random.default_rng(seed)
    time = DT * np.arange(int(seconds / DT))
    frequency, phase = rng.uniform(1.0, 60.0, tones), rng.uniform(0, 2 * math.pi, tones)
    drive, place = np.zeros(time.size), np.zeros(time.size)
    for f, p, h in zip(frequency, phase, response(frequency), strict=True):
        drive += np.cos(2 * math.pi * f * time + p)
        place += abs(h) * np.cos(2 * math.pi * f * time * (1 - 1e-6 * ppm) + p + np.angle(h))
    return [drive, place + noise * place.std() * rng.normal(size=time.size)]


@pytest.mark.parametrize("ppm", [100.0, -100.0, 10.0, 1000.0])
def test_a_drift_is_found_and_told(ppm: float) -> None:
    (note,) = note_drift(*linear(1, ppm), DT)
    found = re.search(r"by (\S+) \+- (\S+) ppm, (\S+) ms over the record", note)
    value, error, over = (float(word) for word in found.groups())
    assert value == pytest.approx(ppm, abs=max(5 * error, 0.005 * abs(ppm)))
    assert error < 1.0
    assert over == pytest.approx(0.06 * ppm, rel=0.1)
    assert ("later and later" in note) == (ppm > 0)
    assert "two devices" in note
    assert "machine changed" in note


def test_what_it_says_to_do_takes_the_drift_away() -> None:
    drive, place = linear(2, 100.0)
    (note,) = note_drift(drive, place, DT)
    factor = float(re.search(r"time of the response by ([\d.]+)", note)[1])
    time = DT * np.arange(place.size)
    inside = slice(100, -100)
    assert [*note_drift(drive[inside], np.interp(time, factor * time, place)[inside], DT)] == []


@pytest.mark.parametrize("tones", [1, 3, 400])
def test_a_sine_shows_it_as_well(tones: int) -> None:
    drift = clock_drift(*linear(3, 100.0, tones=tones), DT)
    assert drift.is_significant()
    assert 1e6 * drift.rate == pytest.approx(100.0, rel=0.02)


def test_nothing_is_told_without_a_drift() -> None:
    """Of 90 recordings of linear oscillators, with one tone to many and up to 30 % noise, none is doubted."""
    for seed in range(30):
        for noise in (0.0, 0.01, 0.3):
            both = linear(seed, tones=(1, 3, 60)[seed % 3], noise=noise, seconds=10.0)
            assert [*note_drift(*both, DT)] == []


@pytest.mark.parametrize("damping", [0.02, 0.05, 0.1])
def test_a_sweep_through_a_resonance_is_no_drift(damping: float) -> None:
    """In a sweep each segment has frequencies of its own, so a change over time is one over frequency."""
    time, own = 2.5e-3 * np.arange(8000), 2 * math.pi * 6.0
    drive = np.sin(2 * math.pi * (time + 19.0 * time**2 / (2 * time[-1])))
    _, place, _ = lsim(((1.0,), (1.0, 2 * damping * own, own**2)), drive, time)
    place += 0.005 * place.std() * np.random.default_rng(4).normal(size=time.size)
    assert [*note_drift(drive, place, 2.5e-3)] == []


@pytest.mark.slow
def test_standard_errors_are_those_of_repeated_recordings() -> None:
    found = [clock_drift(*linear(seed, 100.0, tones=60, noise=0.1, seconds=20.0), DT) for seed in range(40)]
    away = [(1e6 * drift.rate - 100.0) / (1e6 * drift.error) for drift in found]
    assert abs(np.mean(away)) < 4 / math.sqrt(40)
    assert 0.6 < np.std(away) < 1.7


def gaps(seed: int, count: int, periods: int, tones: int) -> tuple[np.ndarray, np.ndarray]:
    """Return drive and position (count, 40 * periods) of oscillators with a gap, 40 samples to a drive period."""
    rng = np.random.default_rng(seed)
    damping, push, pace = rng.uniform(0.005, 0.1, count), rng.uniform(0.2, 3.0, count), rng.uniform(0.3, 2.0, count)
    phase = rng.uniform(0, 2 * math.pi, (count, tones))
    tone = np.ones((count, 1)) if tones == 1 else rng.uniform(0.3, 1.5, (count, tones))

    def drive(t: float) -> np.ndarray:
        return push / math.sqrt(tones) * np.cos(tone * t + phase).sum(axis=1)

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        x, v = y[:count], y[count:]
        spring = np.where(np.abs(x) > 1.0, x - np.sign(x), 0.0)
        return np.concatenate([v, (drive(t) - 2.0 * damping * pace * v - spring) / pace**2])

    time = 2.0 * math.pi / 40 * np.arange(40 * periods)
    first = np.concatenate([rng.uniform(-2.0, 2.0, count), np.zeros(count)])
    done = solve_ivp(rates, (0.0, time[-1]), first, "DOP853", time, rtol=1e-6, atol=1e-8, max_step=time[1])
    return np.array([drive(t) for t in time]).T, done.y[:count]


@pytest.mark.parametrize("tones", [1, pytest.param(12, marks=pytest.mark.slow)])
def test_oscillators_with_a_gap_are_not_doubted(tones: int) -> None:
    told = [[*note_drift(u, x, DT)] for u, x in zip(*gaps(7, 30, 60, tones), strict=True)]
    assert not any(told)


@pytest.mark.slow
@pytest.mark.parametrize("tones", [1, 12])
def test_at_most_one_recording_in_a_thousand_is_doubted_without_reason(tones: int) -> None:
    """Of 1000 recordings of 250 oscillators (whole and cut, with noise and without), 3 and more have odds of 8 %."""
    rng, told = np.random.default_rng(8), 0
    for u, x in zip(*gaps(8, 250, 160, tones), strict=True):
        for noise in (0.0, 0.02):
            seen = x + noise * x.std() * rng.normal(size=x.size)
            for cut in (slice(None), slice(x.size // 3, None)):
                told += len([*note_drift(u[cut], seen[cut], DT)])
    assert told < 3


@pytest.mark.slow
def test_a_gap_does_not_hide_a_drift() -> None:
    count = found = 0
    for u, x in zip(*gaps(9, 20, 160, 12), strict=True):
        late = np.interp(np.arange(x.size) * (1 - 1e-3), np.arange(x.size), x)
        drift = clock_drift(u, late, DT)
        count += 1
        found += drift is not None and drift.is_significant() and abs(drift.rate - 1e-3) < 1e-4
    assert found >= 0.5 * count, found


def test_a_machine_that_changes_is_told_as_the_other_possibility() -> None:
    """An oscillator whose stiffness grows by a fifth: a note is right, if it names this cause as well."""
    time = DT * np.arange(20_000)
    rng = np.random.default_rng(4)
    phase = rng.uniform(0, 2 * math.pi, 40)
    tone = rng.uniform(2.0, 30.0, 40)
    done = solve_ivp(
        lambda t, y: [y[1], np.cos(2 * math.pi * tone * t + phase).sum() - 3 * y[1] - 3900 * (1 + 0.01 * t) * y[0]],
        (0.0, time[-1]), [0.0, 0.0], "DOP853", time, rtol=1e-6, atol=1e-9, max_step=0.01,
    )  # fmt: skip
    drive = np.array([np.cos(2 * math.pi * tone * t + phase).sum() for t in time])
    assert all("machine changed" in note for note in note_drift(drive, done.y[0], DT))


def test_short_or_silent_recordings_show_nothing() -> None:
    drive, place = linear(5, 100.0, seconds=0.5)
    assert clock_drift(drive, place, DT) is None
    assert [*note_drift(np.zeros(9000), np.sin(np.arange(9000.0)), DT)] == []
    assert [*note_drift(np.sin(np.arange(9000.0)), np.zeros(9000), DT)] == []


def test_lost_samples_do_no_harm() -> None:
    drive, place = linear(6, 100.0)
    place[[5, 900, 901]] = np.nan
    assert clock_drift(drive, place, DT).rate == pytest.approx(1e-4, rel=0.02)


@pytest.mark.real
def test_real_recordings_have_one_clock(shared) -> None:
    folder = shared / "data"
    for name in ("DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"):
        columns = read_columns(folder / "emps" / name)
        for cut in (slice(None), slice(5000, None)):
            assert [*note_drift(columns["vir"][cut], columns["qm"][cut], 1e-3)] == []
    for name in ("SNLS80mV.npz", "Schroeder80mV.npz"):
        columns = read_columns(folder / "silverbox" / name)
        for cut in (slice(None), slice(0, 40575), slice(98304, None)):
            assert [*note_drift(columns["V1"][cut], columns["V2"][cut], 1 / 610.35)] == []
