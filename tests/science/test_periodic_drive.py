"""A periodic force without the noise of its gauge: only where the motion shows that this noise did not act."""

import numpy as np
import pytest
from explained import VALUES, T, oscillator
from scipy.interpolate import CubicSpline
from sensed import case_of, model_of, multisine, noisy

from lostmotion.diagnosis.periodic_drive import keep_harmonics, leave_out_gauge_noise
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry

NOISE, SLOW, PACE = 0.5, 2.0, 9.0
"""The noise of the gauge (N), amplitude (N) of the third multiple, and angular frequency (rad/s) of the force."""


def cycle(t):
    """Return a force (N) of one frequency."""
    return 10.0 * np.sin(PACE * t) + SLOW * np.cos(3.0 * PACE * t)


def fit_case(folder, seed, *, acts, shape=cycle):
    """Return the recordings and the nominal fit of an oscillator; its gauge has noise, which `acts` on it or not."""
    recorded = noisy(shape(T), NOISE / np.std(shape(T)), seed)
    force = CubicSpline(T, recorded) if acts else shape
    x = oscillator(force, lambda x, v, t: 0.0)
    recording = {
        "excitation": {"column": "F", "quantity": "force", "unit": "N"},
        "response": {"column": "x", "quantity": "position", "unit": "m"},
    }
    columns = {"t": T, "F": recorded, "x": noisy(x, 1e-3, seed + 100)}
    case = case_of(folder, columns, recording, model_of("linear_oscillator", VALUES, ("c", "k")))
    prepared = prepare(case, Registry.discover())
    train, _ = split_heldout(prepared.observations)
    posterior = make_posterior(System(prepared.model, ()), prepared.case, train, jobs=1)
    return prepared.observations, search_maximum(posterior, np.random.default_rng(0))


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_noise_that_did_not_act_is_left_out(tmp_path, seed):
    recordings, nominal = fit_case(tmp_path, seed, acts=False)
    calm, used = leave_out_gauge_noise(nominal, recordings)
    assert used[0].gauge_noise == pytest.approx(NOISE, rel=0.15)
    assert np.std(used[0].excitation - cycle(T)) < 0.4 * NOISE
    assert calm.log_likelihood > nominal.log_likelihood
    assert calm.posterior.observations[0].gauge_noise == used[0].gauge_noise


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_force_that_acted_stays(tmp_path, seed):
    recordings, nominal = fit_case(tmp_path, seed, acts=True)
    same, used = leave_out_gauge_noise(nominal, recordings)
    assert same is nominal
    assert used == tuple(recordings)


def test_a_force_that_does_not_repeat_stays(tmp_path):
    recordings, _ = fit_case(tmp_path, 1, acts=False, shape=multisine(10.0, 0.5, 5.0, 1))
    assert keep_harmonics(recordings[0]) is recordings[0]
