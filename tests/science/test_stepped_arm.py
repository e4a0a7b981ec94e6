"""The arm of the template, which can only be stepped: parameters, forces at its joints, and a missing one.

The recording is made by another integrator with other equations (`swung_arm`).
"""

import importlib.util
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from swung_arm import NOISE, TRUE, swing

import lostmotion as lm
from lostmotion.evidence.effects import list_bare_promises
from lostmotion.inference.fit import maximise
from lostmotion.inference.setup import make_posterior
from lostmotion.likelihood.predict import filter_recording, predict_freely
from lostmotion.likelihood.stepped import make_system
from lostmotion.registry import default

FILE = Path(__file__).parents[2] / "plugins" / "template" / "src" / "lostmotion_template" / "dynamics.py"
PRIORS = {
    "fore_inertia": lm.LogUniform(0.01, 0.5),
    "shoulder_damping": lm.LogUniform(0.05, 5.0),
    "elbow_damping": lm.LogUniform(0.05, 5.0),
}
TERMS = ("coulomb_friction", "viscous_damping", "cubic_stiffness")


def arm():
    """Return the arm of the template, whose file is imported as a user's would be."""
    if "swung_file" not in sys.modules:
        spec = importlib.util.spec_from_file_location("swung_file", FILE)
        sys.modules["swung_file"] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules["swung_file"])
    return sys.modules["swung_file"].TwoJointArm()


def make(recording, terms=TERMS):
    """Return the posterior of a recording with the terms, none of them active."""
    prepared = lm.Case(recording, arm(), estimate=PRIORS).prepare(default(), terms)
    return make_posterior(make_system(prepared.model, prepared.terms), prepared.case, prepared.observations, jobs=1)


@pytest.fixture(scope="module")
def clean():
    return maximise(make(swing(300, seed=1)[0]))


@pytest.fixture(scope="module")
def rubbing():
    return maximise(make(swing(300, seed=2, friction=0.6)[0]))


def test_one_step_of_a_held_torque_is_one_sample(clean):
    assert clean.posterior.dynamics.nsub == 1
    assert clean.status in ("converged", "rough")


def test_parameters_are_found_within_their_deviations(clean):
    """Three deviations and a half: a true value is farther in 1 of 700 recordings, for three parameters."""
    for name, true in TRUE.items():
        assert abs(np.log(true) - clean.theta[clean.posterior.space.keys.index(name)]) < 3.5 * clean.sd[name]
        assert clean.sd[name] < 0.01


def test_noise_of_the_encoders_is_found(clean):
    for sensor in ("shoulder", "elbow"):
        assert np.exp(clean.values[f"log_noise:{sensor}"]) == pytest.approx(NOISE, rel=0.2)


def test_a_free_run_stays_beside_the_recording(clean):
    posterior = clean.posterior
    states = filter_recording(posterior, clean.theta).states
    both = predict_freely(posterior, clean.theta, states, np.array([20]), 200)
    for run in both:
        assert np.abs(run.error).max() < 0.01  # rad after two seconds; the motion is 1 rad


def test_dry_friction_of_the_elbow_is_what_raises_the_likelihood(rubbing):
    """Each of six terms at a joint alone: the true one promises most; one that promises nothing is not listed."""
    keys = [key for key in rubbing.posterior.system.keys if key.partition("@")[0] in TERMS]
    gains = {promise.key: promise.gain for promise in list_bare_promises(rubbing, keys, {})}
    assert len(keys) == 6
    assert max(gains, key=gains.get) == "coulomb_friction@elbow"


@pytest.mark.slow
def test_a_term_at_a_joint_is_estimated(rubbing):
    posterior = rubbing.posterior
    key = "coulomb_friction@elbow"
    free = replace(posterior.space.free[0], key=f"{key}.force", log=False, start=0.3, low=0.0, high=3.0)
    fit = maximise(posterior.extend((free,), (key,)).stepped(4), np.append(rubbing.theta, 0.3))
    assert fit.values[f"{key}.force"] == pytest.approx(0.6, abs=0.03)
    assert fit.local.log_posterior > rubbing.local.log_posterior + 100.0
