"""Single wrong readings are left out; hits on the machine and clean recordings stay as they are."""

from dataclasses import replace

import numpy as np
import pytest
from explained import VALUES, T, oscillator
from sensed import case_of, model_of, multisine, noisy

from lostmotion.diagnosis.outliers import FAR, find_outliers, leave_out_outliers
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry

NOISE = 0.003
SEEDS = range(2)


def fit_case(folder, seed, shown, extra=lambda x, v, t: 0.0):
    """Return the recordings and the nominal fit of an oscillator whose sensor has `shown` of readings with noise."""
    force = multisine(10.0, 0.5, 5.0, seed)
    x = oscillator(force, extra)
    columns = {"t": T, "F": force(T), "x": shown(noisy(x, NOISE, seed))}
    recording = {
        "excitation": {"column": "F", "quantity": "force", "unit": "N"},
        "response": {"column": "x", "quantity": "position", "unit": "m"},
    }
    prepared = prepare(case_of(folder, columns, recording, model_of("linear_oscillator", VALUES, ("c", "k"))),
                       Registry.discover())  # fmt: skip
    train, _ = split_heldout(prepared.observations)
    posterior = make_posterior(System(prepared.model, ()), prepared.case, train, jobs=1)
    return prepared.observations, search_maximum(posterior, np.random.default_rng(0))


def spoil(seed):
    """Return what spoils 6 of 600 readings by 8 to 20 standard deviations of the noise, and their places."""
    rng = np.random.default_rng(seed + 50)
    places = 20 + 95 * np.arange(6) + rng.integers(0, 60, 6)
    sizes = rng.choice([-1.0, 1.0], 6) * rng.uniform(8.0, 20.0, 6)

    def shown(readings):
        spoilt = readings.copy()
        spoilt[places] += sizes * NOISE * np.std(readings)
        return spoilt

    return shown, places


@pytest.mark.parametrize("seed", SEEDS)
def test_wrong_readings_are_left_out_and_no_others(tmp_path, seed):
    shown, places = spoil(seed)
    recordings, nominal = fit_case(tmp_path, seed, shown)
    fit, kept = leave_out_outliers(nominal, recordings)
    missing = np.flatnonzero(np.isnan(kept[0].readings[:, 0]))
    assert missing.tolist() == sorted(places)
    assert kept[0].outliers == len(places)
    true = NOISE * np.std(recordings[0].readings)
    assert np.exp(fit.values["log_noise"]) == pytest.approx(true, rel=0.2)
    assert np.exp(nominal.values["log_noise"]) > 1.3 * true


@pytest.mark.parametrize("seed", SEEDS)
def test_clean_readings_stay(tmp_path, seed):
    """Of 1,200 normal errors none is expected beyond 5 deviations (1 in 1,450 such sets has one)."""
    recordings, nominal = fit_case(tmp_path, seed, lambda readings: readings)
    assert leave_out_outliers(nominal, recordings) == (nominal, tuple(recordings))


@pytest.mark.parametrize("seed", SEEDS)
def test_hits_that_were_not_recorded_stay(tmp_path, seed):
    """Each is a force of 40 N during 40 ms: the first reading after it is as far off as that of an outlier."""
    times = 1.0 + 2.0 * np.arange(5) + 0.1 * seed

    def hit(x, v, t):
        return 40.0 * float(np.any(np.abs(times - t) < 0.02))

    recordings, nominal = fit_case(tmp_path, seed, lambda readings: readings, hit)
    whole = nominal.posterior.on((recordings[0],))
    seen = whole.innovations(nominal.theta)
    assert np.sum(np.abs(seen.errors) > FAR * np.sqrt(seen.variances)) >= 5
    assert not find_outliers(whole, nominal.theta).any()


def test_readings_that_are_wrong_too_often_stay(tmp_path):
    """One in ten is no outlier but the usual behaviour of this sensor."""

    def shown(readings):
        return readings + 12.0 * NOISE * np.std(readings) * (np.arange(len(readings)) % 10 == 3)

    recordings, nominal = fit_case(tmp_path, 0, shown)
    assert leave_out_outliers(nominal, recordings) == (nominal, tuple(recordings))


def test_the_number_of_readings_left_out_belongs_to_the_whole_recording(tmp_path):
    shown, places = spoil(1)
    recordings, nominal = fit_case(tmp_path, 1, shown)
    fit, _ = leave_out_outliers(nominal, [replace(one) for one in recordings])
    assert fit.posterior.observations[0].outliers == len(places)
