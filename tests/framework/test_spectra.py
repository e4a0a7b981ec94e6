"""Spectra and lines: power is kept, a line is told from a hump, and a period is found to a part in a million."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar
from scipy.signal import lfilter

from lostmotion.errors import DataError
from lostmotion.signals.spectra import fundamental, refined_period, spectrum, without_harmonics

DT, FREQUENCY = 1.0 / 320.0, 6.3661977
PERIOD = 1.0 / FREQUENCY


def rng(seed=0):
    return np.random.default_rng(seed)


def wave(n, frequency=FREQUENCY, dt=DT, shape=(1.0, 0.0, 0.2)):
    """Return a sum of harmonics with amplitudes `shape`."""
    t = np.arange(n) * dt
    return sum(a * np.sin(2 * np.pi * k * frequency * t + k) for k, a in enumerate(shape, 1))


def hump(seed, n=4000, radius=0.95):
    """Return noise through a resonance with this radius of its poles, from which its line takes its width."""
    poles = [1.0, -2.0 * radius * np.cos(0.3), radius**2]
    return lfilter([1.0], poles, rng(seed).normal(size=n + 5000))[5000:]


@pytest.mark.parametrize("segments", [1, 8])
def test_density_adds_up_to_the_variance(segments):
    x = 3.0 * rng().normal(size=20_000)
    found = spectrum(x, DT, segments=segments)
    assert found.frequency[-1] == pytest.approx(0.5 / DT)
    assert np.sum(found.density) * found.frequency[1] == pytest.approx(9.0, rel=0.05)


def test_density_is_that_of_the_plain_formula():
    x = rng(1).normal(size=512)
    taper = np.sin(np.pi * np.arange(512) / 512) ** 2
    plain = 2.0 * DT * np.abs(np.fft.rfft((x - x.mean()) * taper)) ** 2 / np.sum(taper**2)
    assert spectrum(x, DT).density[1:-1] == pytest.approx(plain[1:-1])


def test_no_segments_are_refused():
    with pytest.raises(DataError, match="ask for 1 or more"):
        spectrum(wave(400), DT, segments=0)


@pytest.mark.parametrize(("n", "within"), [(2000, 2e-5), (20_000, 1e-6)])
def test_period_of_a_drive_to_a_part_in_a_million(n, within):
    assert refined_period(wave(n) + 0.01 * rng().normal(size=n), DT) == pytest.approx(PERIOD, rel=within)


def test_period_is_the_one_a_slow_search_finds():
    x = wave(3000) + 0.1 * rng(2).normal(size=3000)

    def left(frequency):
        return np.sum(without_harmonics(x, DT, 1.0 / frequency, harmonics=3)[0] ** 2)

    slow = minimize_scalar(left, bounds=(0.999 * FREQUENCY, 1.001 * FREQUENCY), options={"xatol": 1e-10})
    assert refined_period(x, DT) == pytest.approx(1.0 / slow.x, rel=1e-7)


def test_offset_and_coarse_steps_of_an_encoder_do_no_harm():
    counts = np.rint(40.0 * wave(20_000)) + 1e9
    assert refined_period(counts, DT) == pytest.approx(PERIOD, rel=1e-5)


@pytest.mark.slow
def test_two_tones_have_the_period_of_both():
    x = wave(20_000, 3.0) + wave(20_000, 4.5)
    assert refined_period(x, DT) == pytest.approx(1.0 / 1.5, rel=1e-6)


@pytest.mark.parametrize("values", [np.zeros(500), np.ones(20), np.arange(400.0), wave(30)])
def test_what_holds_no_line_gives_none(values):
    assert fundamental(values, DT) is None
    assert refined_period(values, DT) is None


def test_sweep_is_no_periodic_drive():
    t = np.arange(20_000) * DT
    assert refined_period(np.sin(2 * np.pi * (4.0 + 0.05 * t) * t), DT) is None


def test_noise_and_humps_of_it_pass_for_a_line_less_than_once_in_a_hundred():
    # Stated rate: 1 in 1000; of 400 records at most 3 with probability 0.999.
    alarms = [fundamental(rng(k).normal(size=1000), DT) is not None for k in range(200)]
    alarms += [fundamental(hump(k), DT) is not None for k in range(200)]
    assert sum(alarms) <= 3


def test_narrow_resonance_seldom_passes_for_a_line():
    # The series holds eight coherence times. Seen: 2 in 100 (300 records); 7 of 50 would be 5 in 100 at odds of 1:100.
    alarms = [fundamental(hump(k, radius=0.998), DT) is not None for k in range(50)]
    assert sum(alarms) < 7


def test_line_under_noise_is_found_with_its_error():
    drawn = [fundamental(0.5 * wave(4000) + rng(k).normal(size=4000), DT) for k in range(50)]
    errors = np.array([(line.period - PERIOD) / line.spread for line in drawn])
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(1.0, abs=0.5)
    assert all(0.05 < line.share < 0.2 and line.coherence > 0.7 for line in drawn)


def test_chaotic_flow_has_no_line():
    assert fundamental(lorenz(), 0.02) is None


def lorenz(n=8000, dt=0.02):
    """Return x of the Lorenz system by RK4."""

    def rate(y):
        return np.array([10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - 8 / 3 * y[2]])

    y, seen = np.array([1.0, 1.0, 20.0]), np.empty(n)
    for k in range(n):
        a = rate(y)
        b = rate(y + dt / 2 * a)
        c = rate(y + dt / 2 * b)
        y = y + dt / 6 * (a + 2 * b + 2 * c + rate(y + dt * c))
        seen[k] = y[0]
    return seen


def wandering(seed, n, rms):
    """Return a tone whose phase walks at random by `rms` radians in all, with some noise."""
    steps = np.cumsum(rng(seed).normal(size=n))
    steps -= np.linspace(steps[0], steps[-1], n)
    return np.sin(2 * np.pi * np.arange(n) / 50.3 + rms * steps / steps.std()) + 0.02 * rng(seed).normal(size=n)


def test_a_phase_that_walks_at_random_is_no_line():
    """Within a quarter of a radian 16 pieces agree well. Seen: 4 lines in 100 records."""
    seen = [fundamental(wandering(k, 8000, 0.25), DT) is not None for k in range(20)]
    assert sum(seen) <= 3


def test_a_drive_good_to_half_a_degree_is_a_line():
    assert all(fundamental(wandering(k, 8000, 0.01), DT) is not None for k in range(20))


@pytest.mark.slow
def test_the_hump_of_a_phase_coherent_chaos_is_no_line():
    """Roessler, a = b = 0.1, c = 14, for 300 cycles: the phase wanders by a tenth of a radian. Seen: 5 in 40."""

    def rates(_t, y):
        return [-y[1] - y[2], y[0] + 0.1 * y[1], 0.1 + y[2] * (y[0] - 14.0)]

    passed = 0
    for k in range(4):
        start = np.array([1.0, 1.0, 0.0]) + rng(k).normal(size=3)
        solved = solve_ivp(rates, (0.0, 2200.0), start, "DOP853", t_eval=0.2 * np.arange(1000, 11_000), rtol=1e-7)
        passed += fundamental(solved.y[0], 0.2) is not None
    assert passed <= 1


def test_lines_under_noise_are_kept():
    """Of 400 lines 3 may go by chance: 3 of 60 would be 5 in 100 at odds of 1:1000."""
    kept = [fundamental(wave(1000) + rng(k).normal(size=1000), DT) is not None for k in range(60)]
    assert sum(kept) >= 58


def test_harmonics_are_taken_out_and_the_rest_is_left():
    other = 0.3 * rng(3).normal(size=8000)
    rest, removed = without_harmonics(wave(8000, shape=(1.0, 0.5, 0.2, 0.1)) + other + 7.0, DT, PERIOD, harmonics=4)
    assert rest - 7.0 == pytest.approx(other, abs=0.05)
    assert removed == pytest.approx(wave(8000, shape=(1.0, 0.5, 0.2, 0.1)), abs=0.05)


def test_removal_is_that_of_the_plain_least_squares():
    n, number = 500, 9
    x = rng(4).normal(size=n)
    phase = 2 * np.pi * np.outer(np.arange(n), np.arange(1, number + 1)) / 20.7
    table = np.hstack([np.ones((n, 1)), np.cos(phase), np.sin(phase)])
    root = np.sin(np.pi * np.arange(1, n + 1) / (n + 1))
    amplitudes = np.linalg.lstsq(table * root[:, None], x * root)[0]
    rest, removed = without_harmonics(x, 1.0, 20.7, harmonics=number)
    assert removed == pytest.approx(table[:, 1:] @ amplitudes[1:])
    assert rest + removed == pytest.approx(x)


def test_no_component_at_the_nyquist_frequency_is_asked_for():
    x = wave(600, 0.05, 1.0) + (-1.0) ** np.arange(600)
    rest, _ = without_harmonics(x, 1.0, 20.0)
    assert rest == pytest.approx((-1.0) ** np.arange(600), abs=1e-3)


def test_strong_subharmonic_does_not_leak_into_what_is_removed():
    other = wave(4011, FREQUENCY / 2, shape=(1.0,))
    rest, _ = without_harmonics(wave(4011, shape=(0.1,)) + other, DT, PERIOD)
    assert rest == pytest.approx(other, abs=2e-3)


def test_subharmonics_are_removed_on_demand():
    x = wave(8000) + 0.5 * wave(8000, FREQUENCY / 2)
    kept, _ = without_harmonics(x, DT, PERIOD)
    gone, _ = without_harmonics(x, DT, PERIOD, divisions=2)
    assert np.std(kept) == pytest.approx(0.5 * np.std(wave(8000, FREQUENCY / 2)), rel=0.05)
    assert np.std(gone) < 1e-9


@pytest.mark.parametrize(("period", "words"), [(DT, "more than two steps"), (np.nan, "nan"), (1.0, "two periods")])
def test_impossible_periods_are_refused(period, words):
    with pytest.raises(DataError, match=words):
        without_harmonics(wave(400), DT, period)


@pytest.mark.real
def test_recorded_drive_of_the_bistable_beam_is_found(shared):
    # Norenberg et al., "Asymmetry-enhanced performance in bistable energy harvesters", 2025: driven at 6.50 Hz.
    data = np.load(shared / "data" / "bistablex_chaos" / "chaos_symmetric_40x8192.npz")
    periods = [refined_period(block, 1.0 / 2048.0) for block in data["base_acc_g"][:5]]
    assert 1.0 / np.array(periods) == pytest.approx(6.5, rel=2e-3)
