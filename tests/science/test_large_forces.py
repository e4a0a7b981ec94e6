"""A force that is most of what a load cell shows is found although the model without it is far from its prior."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from sensed import moved, multisine, noisy
from truths import fit_oscillator

from lostmotion.inference.candidates import add_term
from lostmotion.inference.fit import maximise, restart
from lostmotion.inference.large_forces import LARGE, fit_large_force, guess_large_force
from lostmotion.likelihood.observation import Observation

KEY, FRICTION = "coulomb_friction", 6.0
T = np.arange(0.0, 8.0, 0.02)


@pytest.fixture(scope="module")
def nominal():
    """The fit without friction of a mass of 1 kg, 2 N s/m, 300 N/m and a friction of 6 N under 10 N, by DOP853."""
    force = multisine(10.0, 0.5, 4.0, 5)

    def rates(t, y):
        return [y[1], float(force(t)) - 2.0 * y[1] - 300.0 * y[0] - FRICTION * np.tanh(y[1] / 1e-3)]

    shown = noisy(moved(rates, T, [0.0, 0.0])[:, 0], 0.003, 5)
    seen = Observation.of("seen", shown, np.asarray(force(T))[:, None], 0.02, "position")
    return fit_oscillator(seen, np.random.default_rng(5), terms=(KEY, "cubic_stiffness"))


def test_only_a_force_of_one_amplitude_can_be_large(nominal):
    assert guess_large_force(nominal.problem, "cubic_stiffness") is None
    hint = guess_large_force(nominal.problem, KEY)
    assert hint.start == {f"{KEY}.force": pytest.approx(LARGE * nominal.problem.scales.force)}


def test_a_large_force_is_found_from_a_nominal_fit_at_the_bounds_of_its_prior(nominal):
    """From there alone the fit ends far below; from the centre of the prior it has the true friction. No chance."""
    corner = np.array([f.high if f.key == "k" else f.low if f.key == "c" else t
                       for f, t in zip(nominal.problem.free, nominal.theta, strict=True)])  # fmt: skip
    wrong = replace(nominal, local=replace(nominal.local, theta=corner))
    hint = guess_large_force(nominal.problem, KEY)
    alone = maximise(add_term(restart(wrong), hint, hint.start))
    found = fit_large_force(wrong, wrong, hint)
    assert found.local.log_posterior > alone.local.log_posterior + 50.0
    assert found.values[f"{KEY}.force"] == pytest.approx(FRICTION, rel=0.1)
