"""Free decays: closed forms, DOP853 and elliptic functions against what is read off, with noise, NaN and two modes."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import hilbert
from scipy.special import ellipk

from lostmotion.errors import DataError
from lostmotion.signals.decay import decay_of, decays_of

W = 2.0 * np.pi * 5.0
DT = 0.005
TIME = DT * np.arange(4000)
PER_CYCLE = 0.03


def viscous(time, ratio=0.01, frequency=5.0, size=1.0):
    """Return the closed form of a damped oscillator."""
    w = 2.0 * np.pi * frequency
    return size * np.exp(-ratio * w * time) * np.cos(w * np.sqrt(1.0 - ratio**2) * time + 0.3)


def decrement(ratio):
    return 2.0 * np.pi * ratio / np.sqrt(1.0 - ratio**2)


def dry(time, size=1.0, offset=PER_CYCLE):
    """Return the closed form under Coulomb friction (Den Hartog, 1931): half cosines about +-offset, then rest."""
    halves = int(np.ceil((size - offset) / (2.0 * offset)))
    half = np.floor(time * W / np.pi).astype(int)
    angle = np.where(half >= halves, halves * np.pi, W * time)
    half = np.minimum(half, halves - 1)
    return (size - (2 * half + 1) * offset) * np.cos(angle) + offset * (-1.0) ** half


def integrated(force, start=1.0, until=20.0):
    """Return position and acceleration of a unit mass under a force (x, v), by DOP853."""
    time = TIME[until >= TIME]
    found = solve_ivp(lambda t, y: [y[1], force(*y)], (0.0, until), [start, 0.0], "DOP853", time, rtol=1e-9, atol=1e-11)
    return found.y[0], force(*found.y)


@pytest.mark.parametrize("samples", [8.0, 8.37, 20.0, 100.0])
@pytest.mark.parametrize("ratio", [0.002, 0.01, 0.05, 0.1])
def test_the_exponential_is_met_to_nine_digits(samples, ratio):
    dt = 0.2 / samples
    found = decay_of(5.0 + viscous(dt * np.arange(round(40 * samples)), ratio), dt)
    assert found.time.size >= 30
    assert found.frequency == pytest.approx(5.0 * np.sqrt(1.0 - ratio**2), rel=1e-8)
    assert found.decrement == pytest.approx(decrement(ratio), rel=1e-6)
    assert found.damping_ratio == pytest.approx(ratio, rel=1e-6)
    assert found.amplitude == pytest.approx(np.exp(-ratio * W * found.time), rel=1e-6)


@pytest.mark.slow
def test_standard_errors_are_those_of_the_scatter():
    rng = np.random.default_rng(1)
    rows = []
    for _ in range(60):
        noisy = decay_of(viscous(TIME[:1600]) + 0.01 * rng.normal(size=1600), DT, noise=0.01)
        rows.append((noisy.frequency[20] - 5.0) / noisy.frequency_error[20])
        rows.append((noisy.decrement[20] - decrement(0.01)) / noisy.decrement_error[20])
        rows.append((noisy.amplitude[20] - np.exp(-0.01 * W * noisy.time[20])) / noisy.amplitude_error[20])
    scatter = np.std(np.reshape(rows, (-1, 3)), axis=0)
    assert np.all((scatter > 0.75) & (scatter < 1.25))
    quiet = decay_of(viscous(TIME) + 0.01 * rng.normal(size=TIME.size), DT)
    assert quiet.noise == pytest.approx(0.01, rel=0.2)
    assert quiet.amplitude.min() > 3.0 * quiet.noise


def test_fits_beat_the_hilbert_transform_at_the_ends_and_in_noise():
    rng = np.random.default_rng(2)
    readings = viscous(TIME[:1600]) + 0.003 * rng.normal(size=1600)
    found = decay_of(readings, DT)
    size = np.log(np.abs(hilbert(readings)))
    there = [np.abs(TIME[:1600] - centre) <= 0.2 for centre in found.time]
    other = np.array([-0.2 * np.polyfit(TIME[:1600][near], size[near], 1)[0] for near in there])
    middle, true = slice(5, -5), decrement(0.01)
    assert np.std(found.decrement[middle] - true) < 0.7 * np.std(other[middle] - true)
    assert np.abs(found.decrement[[0, -1]] - true).max() < 0.2 * np.abs(other[[0, -1]] - true).max()


@pytest.mark.parametrize("noise", [0.0, 0.003])
def test_dry_friction_takes_the_same_off_each_cycle_until_the_body_sticks(noise):
    readings = 2.0 + dry(TIME) + noise * np.random.default_rng(3).normal(size=TIME.size)
    found = decay_of(readings, DT)
    assert found.time.size == 8
    assert np.diff(found.amplitude)[:-1] == pytest.approx(-4.0 * PER_CYCLE, rel=0.035 + 3.0 * noise / PER_CYCLE)
    assert found.decrement[-2] > 2.5 * found.decrement[0]
    assert found.frequency[:5] == pytest.approx(5.0, rel=0.004)


@pytest.mark.parametrize("cubic", [1.0, -0.3])
def test_a_cubic_spring_gives_its_backbone(cubic):
    # Without damping the period is an elliptic integral; the little damping here changes it by 1e-5.
    position, acceleration = integrated(lambda x, v: -(W**2) * (x + cubic * x**3) - 2.0 * 0.005 * W * v)
    found, other = decay_of(position, DT), decay_of(acceleration, DT)
    inner = slice(2, -1)
    size = found.amplitude[inner]
    peak = size + cubic * size**3 / 32.0 / (1.0 + 0.75 * cubic * size**2)  # with the third harmonic
    stiff = 1.0 + cubic * peak**2
    exact = np.pi * np.sqrt(stiff) / (2.0 * ellipk(cubic * peak**2 / (2.0 * stiff))) * 5.0
    assert found.frequency[inner] == pytest.approx(exact, rel=1.5e-3)
    late = slice(20, -1)
    assert found.frequency[late] == pytest.approx(exact[18:], rel=1e-3)
    assert np.interp(found.time[inner], other.time, other.frequency) == pytest.approx(found.frequency[inner], rel=2e-3)
    assert np.ptp(found.frequency) > 0.08 * 5.0


def test_quadratic_damping_gives_a_decrement_proportional_to_the_amplitude():
    # The loss of a cycle is 8/3 c A^3 w^2 (Nayfeh and Mook, 1979): decrement 8/3 c A.
    position, acceleration = integrated(lambda x, v: -(W**2) * x - 0.1 * abs(v) * v)
    found, other = decay_of(position, DT), decay_of(acceleration, DT)
    assert found.decrement[1:-1] == pytest.approx(8.0 / 3.0 * 0.1 * found.amplitude[1:-1], rel=0.03)
    assert other.decrement[1:-1] == pytest.approx(8.0 / 3.0 * 0.1 * other.amplitude[1:-1] / W**2, rel=0.03)


def test_lost_samples_are_left_out():
    readings = viscous(TIME)
    readings[np.random.default_rng(4).choice(readings.size, 800, replace=False)] = np.nan
    readings[400:430] = np.nan
    found = decay_of(readings, DT)
    assert found.frequency == pytest.approx(5.0 * np.sqrt(1.0 - 1e-4), rel=1e-7)
    assert found.decrement == pytest.approx(decrement(0.01), rel=1e-5)


@pytest.mark.parametrize(("other", "loud"), [(8.0, 0.8), (31.0, 3.0), (1.3, 0.4)])
def test_two_modes_are_told_apart(other, loud):
    readings = viscous(TIME, 0.005) + viscous(TIME, 0.004, other, loud)
    found = decay_of(readings, DT, near=5.0)
    kept = found.amplitude > 0.1
    assert found.time[kept].size > 50
    assert found.frequency[kept] == pytest.approx(5.0, rel=1e-3)
    assert found.decrement[kept] == pytest.approx(decrement(0.005), rel=0.04)
    second = decay_of(readings, DT, near=other)
    assert np.median(second.frequency) == pytest.approx(other, rel=2e-3)
    assert np.median(second.decrement) == pytest.approx(decrement(0.004), rel=0.05)


@pytest.mark.slow
def test_white_noise_steady_sines_and_beats_are_no_decays():
    rng = np.random.default_rng(5)
    assert not [k for k in range(200) if decay_of(rng.normal(size=1000), DT) is not None]
    for k in range(50):
        steady = np.sin((20.0 + 3.0 * k) * TIME) + 0.01 * rng.normal(size=TIME.size)
        assert decay_of(steady, DT) is None
    assert decay_of(np.sin(W * TIME), DT) is None
    assert decay_of(viscous(TIME, 0.002) + viscous(TIME, 0.002, 5.3, 0.8), DT) is None
    assert decay_of(-viscous(TIME[::-1]), DT) is None
    assert decay_of(np.zeros(1000), DT) is None
    assert decay_of(np.full(1000, np.nan), DT) is None
    assert decay_of(viscous(TIME[:20]), DT) is None
    assert decay_of(viscous(TIME), DT, near=20.0) is None


def test_several_hits_in_one_record():
    starts = (100, 1500, 2800)
    readings = np.zeros(TIME.size)
    for start, stop in zip(starts, (*starts[1:], TIME.size), strict=True):
        readings[start:stop] = viscous(DT * np.arange(stop - start), 0.02, size=1.0 + start / 1000)
    found = decays_of(readings, DT, starts)
    assert len(found) == 3
    for decay, start in zip(found, starts, strict=True):
        assert DT * start < decay.time[0] < DT * start + 0.2
        assert decay.decrement == pytest.approx(decrement(0.02), rel=1e-5)
    assert len(decays_of(readings, DT, (0, 100))) <= 2
    with pytest.raises(DataError, match="give rising numbers"):
        decays_of(readings, DT, (100, 50))


def test_what_cannot_be_is_refused():
    with pytest.raises(DataError, match="one channel"):
        decay_of(np.zeros((3, 100)), DT)
    with pytest.raises(DataError, match="positive"):
        decay_of(viscous(TIME), 0.0)


@pytest.mark.slow
@pytest.mark.real
def test_a_bolted_beam_rings_lower_and_dies_faster_in_large_motion(shared):
    place = shared / "data" / "brake_reuss_beam" / "HammerImpact.mat"
    if not place.is_file():
        pytest.skip(f"no recording: {place} is absent")
    from pymatreader import read_mat

    recording = read_mat(place)["HIdata"]
    dt, start = float(np.diff(recording["time"][:2])[0]), int(np.searchsorted(recording["time"], 0.0))
    first = [decay_of(recording[name][start:], dt, near=80.0) for name in ("acc1", "acc2", "acc3")]
    for decay in first:
        late = (decay.time > 1.5) & (decay.time < 2.5)
        assert decay.frequency[:20].mean() == pytest.approx(80.26, abs=0.08)
        assert decay.frequency[late].mean() == pytest.approx(80.52, abs=0.05)
        assert np.median(decay.decrement[:20]) > 1.3 * np.median(decay.decrement[late])
    apart = [np.interp(np.arange(0.2, 2.0, 0.1), decay.time, decay.frequency) for decay in first]
    assert apart[0] == pytest.approx(apart[2], abs=0.02)
    second = decay_of(recording["acc2"][start:], dt, near=297.0)
    assert second.frequency[10:60].mean() < second.frequency[400:600].mean() - 0.05
    assert second.damping_ratio[10:60].mean() > 1.1 * second.damping_ratio[400:600].mean()
