"""What a diagnosis says of cycles that come again."""

import numpy as np
import pytest

from lostmotion.diagnosis.repetition_notes import compute_repeated_share, count_cycles, note_repetitions
from lostmotion.likelihood.observation import Observation, find_harmonic

SAMPLES, TRAIN, DT, PERIOD = 2000, 1400, 0.01, 37.7


def observed(name="run 1", level=1.0, seed=0, noise=0.01, waveform=None):
    rng, angle = np.random.default_rng(seed), 2.0 * np.pi * np.arange(SAMPLES) / PERIOD + seed
    u = np.cos(angle) if waveform is None else waveform(rng)
    x = level * (np.sin(angle) + 0.3 * np.cos(3.0 * angle)) if waveform is None else np.cumsum(u) / 30.0
    noisy = x + noise * np.std(x) * rng.standard_normal(SAMPLES)
    bare = Observation.of(name, noisy, u[:, None], DT, "position")
    return Observation.of(name, noisy, u[:, None], DT, "position", harmonic=find_harmonic(bare))


def slow_noise(rng):
    return np.convolve(rng.standard_normal(SAMPLES + 30), np.hanning(31), mode="valid")


def parts(whole):
    return (whole.part(0, TRAIN),), (whole.part(TRAIN, SAMPLES),)


def test_held_out_part_that_repeats_the_fitted_one_is_told():
    whole = observed()
    notes = note_repetitions((whole,), *parts(whole))
    assert len(notes) == 2
    assert notes[0].startswith("The held-out part repeats the motion of the fitted part (")
    assert notes[0].endswith(" % of its variance): the predictions are a test for this cycle only.")
    assert float(notes[0].partition("(")[2].partition(" %")[0]) > 99.5
    assert notes[1].startswith("The 53 cycles of run 1 are equivalent to 1.0 distinct cycles (the mean cycle is")


def test_motion_that_does_not_repeat_has_no_note():
    whole = observed(waveform=slow_noise)
    assert note_repetitions((whole,), *parts(whole)) == []
    assert count_cycles(whole) is None


def test_another_recording_at_the_same_level_is_the_same_motion_and_another_level_is_not():
    train = (observed("run 1"), observed("run 2", seed=1))
    same, louder = observed("run 3", seed=2), observed("run 4", level=1.5, seed=3)
    assert compute_repeated_share(train, same) > 0.995
    assert compute_repeated_share(train, louder) < 0.95
    (note,) = [n for n in note_repetitions((), train, (same, louder)) if "are a test for" in n]
    assert note.startswith("The held-out part of run 3 repeats")


def test_readings_that_were_not_taken_are_bridged():
    whole = observed()
    holes = whole.readings.copy()
    holes[::50] = np.nan
    bridged = Observation(whole.name, holes, whole.inputs, DT, whole.sensors, harmonic=whole.harmonic)
    assert count_cycles(bridged).distinct == pytest.approx(1.0, abs=0.1)
    holes[::2] = np.nan
    assert count_cycles(bridged) is None
    assert note_repetitions((bridged,), *parts(bridged)) == []


def test_nothing_is_compared_with_another_channel_or_another_rate():
    whole = observed()
    (train,), (held,) = parts(whole)
    faster = Observation.of("fast", held.response, held.inputs, 0.5 * DT, "position")
    other = Observation.of("other", held.response, held.inputs, DT, "velocity")
    assert compute_repeated_share((train,), faster) is None
    assert compute_repeated_share((train,), other) is None


def test_two_equal_blows_are_one_motion_and_no_cycle():
    time = DT * np.arange(SAMPLES)
    x = sum(np.exp(-0.8 * (time - at)) * np.sin(9.0 * (time - at)) * (time >= at) for at in (0.5, 10.5))
    x = x + 1e-3 * np.random.default_rng(0).standard_normal(SAMPLES)
    blows = np.isin(np.arange(SAMPLES), (50, 1050)).astype(float)
    whole = Observation.of("blows", x, blows[:, None], DT, "position")
    notes = note_repetitions((whole,), (whole.part(0, 1000),), (whole.part(1000, SAMPLES),))
    assert len(notes) == 1
    assert notes[0].endswith("the predictions are a test for this motion only.")
