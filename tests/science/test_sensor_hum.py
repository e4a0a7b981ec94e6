"""Hum of a sensor: the lines that are found, how often noise shows one, and the score of an explanation with it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from explained import made_of
from scipy.stats import binom

from lostmotion.evidence.channel_errors import list_channel_errors
from lostmotion.evidence.sensor_hum import FALSE_HUM, SensorHum, find_lines, renew_hums
from lostmotion.inference.setup import make_posterior, search_maximum

SAMPLES, RATE = 1000, 100.0
TIME = np.arange(SAMPLES) / RATE


def test_the_frequency_of_a_hum_is_found_to_a_fiftieth_of_its_width():
    rng = np.random.default_rng(5)
    errors = rng.standard_normal(SAMPLES) + 0.5 * np.cos(2.0 * math.pi * 23.37 * TIME + 1.0)
    (pace,) = find_lines(errors, 1.0 / RATE)
    assert pace == pytest.approx(2.0 * math.pi * 23.37, abs=0.1 * 2.0 * math.pi * RATE / SAMPLES)


def test_the_two_strongest_lines_are_found_and_no_third_one():
    rng = np.random.default_rng(6)
    waves = sum(a * np.cos(2.0 * math.pi * f * TIME) for a, f in ((1.5, 11.0), (1.0, 17.0), (0.7, 31.0)))
    paces = list(find_lines(rng.standard_normal(SAMPLES) + waves, 1.0 / RATE))
    assert paces == pytest.approx([2.0 * math.pi * 11.0, 2.0 * math.pi * 17.0], abs=0.1)


def test_white_noise_shows_a_line_at_the_stated_rate():
    """At most 1 % of recordings: a rate of 1 % gives more than 21 of 1,000 with a probability of 1e-3."""
    rng = np.random.default_rng(7)
    found = sum(bool(list(find_lines(rng.standard_normal(SAMPLES), 1.0 / RATE))) for _ in range(1000))
    assert found <= binom.ppf(0.999, 1000, FALSE_HUM)


def test_a_multiple_of_the_drive_is_no_hum():
    rng = np.random.default_rng(8)
    omega = 2.0 * math.pi * 3.1
    errors = rng.standard_normal(SAMPLES) + 2.0 * np.cos(3.0 * omega * TIME)
    assert not list(find_lines(errors, 1.0 / RATE, omega))
    assert not list(find_lines(errors, 1.0 / RATE, drives=np.sin(3.0 * omega * TIME)[:, None]))
    assert list(find_lines(errors, 1.0 / RATE))


@pytest.mark.parametrize(("off", "found"), [(0.0, False), (0.2, False), (0.5, True), (1.2, True)])
def test_a_hum_close_to_a_multiple_of_the_drive_is_told_from_it(off, found):
    """`off` is in steps of 1/duration; a strong harmonic of the drive is beside it."""
    rng, resolution = np.random.default_rng(9), RATE / SAMPLES
    omega = 2.0 * math.pi * 3.12
    wave = 7.0 * 3.12 + off * resolution
    errors = rng.standard_normal(SAMPLES) + 1.5 * np.cos(3.0 * omega * TIME) + 0.5 * np.cos(2.0 * math.pi * wave * TIME)
    paces = list(find_lines(errors, 1.0 / RATE, omega))
    assert paces == pytest.approx([2.0 * math.pi * wave] if found else [], abs=0.2 * 2.0 * math.pi * resolution)


def test_a_hum_of_one_sensor_is_two_waves_of_its_noise(tmp_path):
    prepared, system = made_of(tmp_path, lambda x, v, t: 0.0)
    (observation,) = prepared.observations
    noise = 2e-4
    readings = observation.readings + noise * np.cos(2.0 * math.pi * 18.7 * observation.time)[:, None]
    humming = type(observation)(**{**vars(observation), "readings": readings})
    nominal = search_maximum(make_posterior(system, prepared.case, (humming,), jobs=1), np.random.default_rng(0))
    hums = [one for one in list_channel_errors(nominal, [humming]) if isinstance(one, SensorHum)]
    assert [one.pace for one in hums] == pytest.approx([2.0 * math.pi * 18.7] * 2, rel=1e-3)
    sizes = np.linalg.lstsq(
        np.column_stack([one.correct(observation, 1.0).readings - observation.readings for one in hums]),
        observation.readings - readings,
        rcond=None,
    )[0]
    assert np.hypot(*sizes)[0] * hums[0].noise == pytest.approx(noise, rel=0.01)


def test_a_better_fit_has_its_own_hums_and_the_other_errors_of_the_channels(tmp_path):
    prepared, system = made_of(tmp_path, lambda x, v, t: 0.0)
    (observation,) = prepared.observations
    wave = 2e-4 * np.cos(2.0 * math.pi * 18.7 * observation.time)
    humming = replace(observation, readings=observation.readings + wave[:, None])
    nominal = search_maximum(make_posterior(system, prepared.case, (humming,), jobs=1), np.random.default_rng(0))
    others = [one for one in list_channel_errors(nominal, [humming]) if not isinstance(one, SensorHum)]
    wrong = SensorHum(0, observation.name, 2.0 * math.pi * 21.0, 0.0, 1e-4)
    renewed = renew_hums((*others, wrong), nominal, [humming])
    assert list(renewed[: len(others)]) == others
    assert [one.pace for one in renewed[len(others) :]] == pytest.approx([2.0 * math.pi * 18.7] * 2, rel=1e-3)
    assert list(renew_hums((*others, wrong), nominal, [observation])) == others
