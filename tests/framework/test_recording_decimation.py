"""Merging samples: amplitude, phase and alias of sines in closed form, ends, lost samples, and how many are merged."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lostmotion.recording import Channel, RecordingSpec, load_recording
from lostmotion.recording.decimation import decimate, factor_for, low_pass, thin_recording

DT = 1e-4
N = 40_000
TIME = DT * np.arange(N)
FACTORS = [2, 3, 10, 37]


def fitted(values: np.ndarray, frequency: float, dt: float) -> complex:
    """Return the complex amplitude of a sine in the middle of a signal, by least squares."""
    inside = slice(values.size // 5, -(values.size // 5))
    angle = 2 * math.pi * frequency * dt * np.arange(values.size)[inside]
    parts = np.column_stack([np.cos(angle), -np.sin(angle), np.ones(angle.size)])
    real, imaginary, _ = np.linalg.lstsq(parts, values[inside])[0]
    return complex(real, imaginary)


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("share", [0.01, 0.05, 0.1, 0.2, 0.25])
def test_amplitude_and_phase_stay(factor: int, share: float) -> None:
    frequency = share / (factor * DT)
    got = fitted(decimate(np.cos(2 * math.pi * frequency * TIME + 0.7), factor), frequency, factor * DT)
    assert abs(got) == pytest.approx(1.0, abs=1e-3)
    assert np.angle(got) == pytest.approx(0.7, abs=1e-3)


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("share", [0.75, 0.9, 1.0, 1.23])
def test_what_would_fold_back_into_the_band_is_taken_out(factor: int, share: float) -> None:
    frequency = min(share / (factor * DT), 0.5 / DT)
    got = decimate(np.cos(2 * math.pi * frequency * TIME + 0.4), factor)
    inside = slice(got.size // 5, -(got.size // 5))
    assert np.abs(got[inside]).max() < 1e-3


def test_the_filter_is_symmetric_and_keeps_a_constant() -> None:
    for factor in FACTORS:
        taps = low_pass(factor)
        assert taps.size % 2 == 1
        np.testing.assert_allclose(taps, taps[::-1], rtol=1e-12)
        assert taps.sum() == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("factor", FACTORS)
def test_the_ends_follow_the_signal(factor: int) -> None:
    values = 3.0 + 2.0 * TIME
    np.testing.assert_allclose(decimate(values, factor), values[::factor], rtol=1e-9)
    slow = np.sin(2 * math.pi * 0.02 / (factor * DT) * TIME + 0.3)
    got = decimate(slow, factor)
    assert got.size == -(-N // factor)
    assert np.abs(got - slow[::factor]).max() < 0.02  # an odd mirror has a bend of its own at the ends
    assert np.abs(got - slow[::factor])[20:-20].max() < 1e-3


def test_lost_samples_are_bridged_or_stay_lost() -> None:
    values = np.sin(2 * math.pi * 20 * TIME)
    spoilt = values.copy()
    spoilt[[5003, 5004, 9007]] = np.nan
    spoilt[20_000:20_100] = np.nan
    spoilt[30_000] = np.nan
    got = decimate(spoilt, 10)
    lost = np.flatnonzero(np.isnan(got))
    assert {*range(2000, 2010)} <= set(lost.tolist()) <= {*range(1997, 2013)}
    there = np.setdiff1d(np.arange(20, got.size - 20), lost)
    assert np.abs(got - values[::10])[there].max() < 2e-3
    assert np.isnan(decimate(np.full(N, np.nan), 10)).all()


def test_a_factor_that_makes_no_sense_is_refused() -> None:
    assert np.array_equal(decimate(TIME, 1), TIME)
    with pytest.raises(ValueError, match="expected 1 or more"):
        decimate(TIME, 0)
    with pytest.raises(ValueError, match="too few"):
        decimate(TIME[:50], 40)


@pytest.mark.parametrize("noise", [1e-6, 1e-3, 0.05])
@pytest.mark.parametrize("highest", [20.0, 60.0, 200.0])
def test_the_factor_leaves_twenty_samples_in_the_shortest_period(noise: float, highest: float) -> None:
    rng = np.random.default_rng(5)
    values = np.sin(2 * math.pi * 7 * TIME) + 0.3 * np.sin(2 * math.pi * highest * TIME) + noise * rng.normal(size=N)
    factor = factor_for(values, DT)
    right = 1.0 / (20 * DT * highest)
    assert factor <= right
    assert factor > 0.25 * right - 1


def test_a_factor_that_cannot_be_told_is_one() -> None:
    rng = np.random.default_rng(6)
    assert factor_for(rng.normal(size=N), DT) == 1
    assert factor_for(np.sin(2 * math.pi * 3000 * TIME), DT) == 1
    assert factor_for(np.ones(N), DT) == 1
    assert factor_for(np.sin(TIME[:100]), DT) == 1
    assert factor_for(np.where(np.arange(N) % 3, np.nan, np.sin(TIME)), DT) == 1


def test_merging_by_the_factor_loses_nothing() -> None:
    rng = np.random.default_rng(7)
    tones = np.sum([np.sin(2 * math.pi * f * TIME + f) for f in (3.0, 11.0, 31.0)], axis=0)
    factor = factor_for(tones + 0.01 * rng.normal(size=N), DT)
    assert factor > 1
    got = decimate(tones, factor)
    assert np.abs(got - tones[::factor])[40:-40].max() < 3e-3


def test_a_recording_that_was_sampled_far_too_fast_is_thinned_with_a_note(tmp_path: Path) -> None:
    t = np.arange(120_000) / 20_000.0
    noise = 0.01 * np.random.default_rng(4).standard_normal((2, t.size))
    np.savez(tmp_path / "run.npz", F=np.sin(20.0 * t) + noise[0], x=np.cos(20.0 * t) + noise[1])
    spec = RecordingSpec("run.npz", None, 20_000.0, (Channel("F", "force", "N"),), (Channel("x", "position", "m"),))
    raw = load_recording(spec, tmp_path)
    kept = thin_recording(raw)
    assert raw.n / kept.n > 10
    assert kept.n >= 2000
    assert "20000 Hz" in kept.notes[-1]
    assert f"{kept.rate:.6g} Hz" in kept.notes[-1]
    np.testing.assert_allclose(kept.sensors[0].time, kept.dt * np.arange(kept.n), atol=1e-9)
    left = kept.sensors[0].to_numpy() - np.cos(20.0 * kept.sensors[0].time.to_numpy())
    assert float(np.std(left)) < 0.012 / np.sqrt(raw.n / kept.n)
    assert abs(float(np.corrcoef(left[1:], left[:-1])[0, 1])) < 0.1  # noise that was white stays white
    assert thin_recording(replace(raw, hold="step")).n == raw.n
