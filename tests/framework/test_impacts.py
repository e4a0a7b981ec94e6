"""Hammer tests: hits and double hits in a force, onsets in a response, overloads; false alarms are counted."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from lostmotion.errors import DataError
from lostmotion.signals.impacts import hits_of, note_hits, note_overload, onsets_of, overloaded

DT, N = 1e-4, 20000
AT = np.arange(N)


def pulse(start, length, peak):
    """Return a half sine of so many samples."""
    return np.where((start <= AT) & (start + length >= AT), peak * np.sin(np.pi * (AT - start) / length), 0.0)


def ringing(start, size, period, fade):
    since = np.maximum(AT - start, 0)
    return size * np.exp(-since / fade) * np.sin(2.0 * np.pi * since / period)


def test_a_clean_hit_is_measured():
    (hit,) = hits_of(3.0 - pulse(1000, 20, 80.0), DT)
    assert (hit.start, hit.stop) == (1001, 1020)
    assert hit.peak == pytest.approx(-80.0)
    assert hit.duration == pytest.approx(0.0019)
    assert hit.impulse == pytest.approx(-80.0 * 2.0 / np.pi * 20 * DT, rel=0.01)
    assert not hit.double


def test_single_hits_with_noise_and_ringing_are_not_called_double():
    rng = np.random.default_rng(5)
    doubles = 0
    for _ in range(200):
        force = 100.0 * 10.0 ** rng.uniform(-3.0, -2.0) * rng.normal(size=N)
        for start in (1000, 6000, 11000, 16000):
            length, peak = int(rng.integers(5, 60)), 100.0 * rng.uniform(0.3, 1.0)
            after = ringing(start + length, 0.03 * peak, rng.uniform(0.5, 3.0) * length, 3.0 * length)
            force += pulse(start, length, peak) + after
        hits = hits_of(force, DT)
        assert len(hits) == 4
        doubles += sum(hit.double for hit in hits)
    assert doubles <= 4  # of 800


def test_double_hits_are_found_and_measured():
    rng = np.random.default_rng(6)
    for _ in range(100):
        length, share = int(rng.integers(8, 60)), rng.uniform(0.08, 0.9)
        gap, second = int(length * rng.uniform(2.0, 15.0)), int(max(6, length * rng.uniform(0.7, 1.3)))
        noise = 10.0 ** rng.uniform(-3.0, -2.0)
        force = pulse(1000, length, 80.0) + pulse(1000 + gap, second, 80.0 * share) + 80.0 * noise * rng.normal(size=N)
        (hit,) = hits_of(force, DT)
        assert hit.double
        assert hit.second == pytest.approx(share, abs=4.0 * noise + 0.03)
        assert hit.after == pytest.approx((gap + (second - length) / 2) * DT, abs=0.35 * length * DT)
        assert hit.stop > 1000 + gap
        assert hit.impulse == pytest.approx(80.0 * 2.0 / np.pi * DT * (length + share * second), rel=0.15)


def test_hits_well_apart_are_single_ones_and_lost_samples_do_no_harm():
    force = pulse(1000, 20, 80.0) + pulse(4000, 20, 20.0)
    force[[10, 500, 5000]] = np.nan
    hits = hits_of(force, DT)
    assert [hit.double for hit in hits] == [False, False]
    assert [hit.start for hit in hits] == [1001, 4001]


def test_no_hits_in_noise_sines_and_silence():
    rng = np.random.default_rng(8)
    assert not [k for k in range(100) if hits_of(rng.normal(size=N), DT)]
    assert hits_of(np.sin(0.1 * AT), DT) == ()
    assert hits_of(np.zeros(50), DT) == ()
    with pytest.raises(DataError, match="one channel"):
        hits_of(np.zeros((2, 5)), DT)
    with pytest.raises(DataError, match="all readings are NaN"):
        hits_of(np.full(9, np.nan), DT)


def test_a_double_hit_is_said():
    force = pulse(1000, 20, 80.0) + pulse(12340, 20, 80.0) + pulse(12401, 20, 14.4)
    (note,) = note_hits(force, DT)
    assert note.startswith(
        "hit 2 at 1.234 s is a double hit: a second contact of 18 % of its peak follows after 6.1 ms"
    )
    assert not list(note_hits(pulse(1000, 20, 80.0), DT))


def test_onsets_are_where_a_vibration_begins_anew():
    rng = np.random.default_rng(9)
    at, right = np.arange(60000), 0
    for _ in range(40):
        starts = np.sort(500 + 12000 * np.arange(5) + rng.integers(0, 3000, 5))
        readings = 10.0 ** rng.uniform(-4.0, -2.0) * rng.normal(size=at.size) + 7.0
        w = rng.uniform(0.06, 0.3)
        for start in starts:
            since = np.maximum(at - start, 0)
            both = np.exp(-0.01 * w * since) * np.sin(w * since)
            readings += rng.uniform(0.5, 1.0) * (both + 0.3 * np.exp(-0.02 * w * since) * np.sin(4.3 * w * since))
        found = onsets_of(readings, DT)
        right += len(found) == 5 and bool(np.all(np.abs(np.subtract(found, starts)) <= 3))
    assert right >= 38


def test_noise_and_resonances_have_no_onsets():
    rng, alarms = np.random.default_rng(10), 0
    for _ in range(100):
        alarms += len(onsets_of(rng.normal(size=N), DT))
        w = 0.1 * rng.uniform(0.5, 3.0)
        alarms += len(onsets_of(lfilter([1.0], [1.0, -1.99 * np.cos(w), 0.99], rng.normal(size=N)), DT))
    assert alarms <= 1
    spike = rng.normal(size=N)
    spike[7000] = 100.0
    assert onsets_of(spike, DT) == ()


def test_a_record_that_begins_with_the_decay_has_its_onset_there():
    decay = np.exp(-0.001 * AT) * np.sin(0.1 * AT)
    assert onsets_of(decay, DT) == (0,)
    assert onsets_of(np.concatenate([np.zeros(150), decay]), DT)[0] == pytest.approx(150, abs=3)


def clipped(noise):
    decay = 100.0 * np.exp(-0.002 * AT) * np.sin(0.1 * AT)
    return np.clip(decay, -49.03, 49.03) + noise * np.random.default_rng(11).normal(size=N)


@pytest.mark.parametrize("noise", [0.0, 0.1])
def test_flat_tops_are_found_at_both_ends(noise):
    high, low = overloaded(clipped(noise))
    assert high.value == pytest.approx(49.03, abs=0.1)
    assert low.value == pytest.approx(-49.03, abs=0.1)
    assert high.exact is (noise == 0.0)
    assert 5 <= high.stretches <= 6
    assert high.samples == pytest.approx(np.count_nonzero(clipped(0.0) == 49.03), rel=0.15)
    assert 5 <= high.first <= 7


def test_round_tops_are_no_overloads():
    rng, alarms, at = np.random.default_rng(12), 0, np.arange(5000)
    for _ in range(200):
        w, fade = rng.uniform(0.02, 0.8), rng.uniform(0.0, 0.02)
        two = np.sin(w * at) + 0.4 * np.sin(3.7 * w * at + 1.0)
        alarms += len(
            overloaded(np.exp(-fade * w * at) * two + 10.0 ** rng.uniform(-5.0, -2.0) * rng.normal(size=5000))
        )
        w = 0.1 * rng.uniform(0.1, 3.0)
        alarms += len(overloaded(lfilter([1.0], [1.0, -1.98 * np.cos(w), 0.98], rng.normal(size=5000))))
    assert alarms <= 4  # of 800 ends
    assert overloaded(np.zeros(10)) == ()


@pytest.mark.parametrize("step", [0.09, 1.0])
def test_a_machine_before_an_encoder_overloads_nothing(step):
    """It rests before a spin-up and after it, or turns round: whole steps, many of them equal at the extremes."""
    t = np.arange(4000) * 1e-3
    spun = np.cumsum(np.interp(t, [0.05, 0.15, 2.5, 3.0], [0.0, 500.0, 500.0, 0.0])) * 1e-3
    swung = 30.0 * np.sin(2.0 * np.pi * t)
    for motion in (spun, -spun, swung, np.deg2rad(swung)):
        unit = step if np.ptp(motion) > 2.0 else np.deg2rad(step)
        assert overloaded(unit * np.round(motion / unit)) == ()


@pytest.mark.parametrize("bits", [8, 12, 16])
def test_a_clipped_converter_is_an_overload(bits):
    grain = 100.0 / 2**bits
    high, low = overloaded(grain * np.round(clipped(0.0) / grain))
    assert high.exact
    assert low.exact
    assert 5 <= high.stretches <= 6


def test_an_overload_is_said_with_its_unit():
    high, low = note_overload(clipped(0.0), "the sensor 'a'", "m/s^2")
    assert high.startswith("the sensor 'a' stays at its largest value 49.03 m/s^2 for ")
    assert "samples in 6 stretches" in high or "samples in 5 stretches" in high
    assert low.startswith("the sensor 'a' stays at its smallest value -49.03 m/s^2")
    resting = np.concatenate([clipped(0.0)[:3000], np.full(2000, 49.03)])
    assert not [note for note in note_overload(resting, "a") if "largest" in note]


@pytest.mark.real
def test_a_measured_hammer_impact_has_one_onset_and_no_overload(shared):
    place = shared / "data" / "brake_reuss_beam" / "HammerImpact.mat"
    if not place.is_file():
        pytest.skip(f"no recording: {place} is absent")
    from pymatreader import read_mat

    recording = read_mat(place)["HIdata"]
    dt = float(np.diff(recording["time"][:2])[0])
    for name in ("acc1", "acc2", "acc3"):
        assert overloaded(recording[name]) == ()
        (onset,) = onsets_of(recording[name], dt)
        assert recording["time"][onset] == pytest.approx(0.0, abs=1e-3)
