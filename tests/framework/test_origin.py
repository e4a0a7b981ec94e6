"""The zero of the position where no sensor shows it: the phase of a wave over the travel is unknown."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lostmotion.inference.fit import Fit, maximise
from lostmotion.inference.origin import list_shifted, list_unlocated, shift_origin
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM, FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import System
from lostmotion.noises import NOISE
from lostmotion_plugins.models.basic import RigidDrive
from lostmotion_plugins.terms.elastic import LinearStiffness
from lostmotion_plugins.terms.periodic import Cogging

DT, SAMPLES = 0.01, 300
WAVE = {"cogging.cosine": 0.03, "cogging.sine": -0.04, "cogging.pitch": 0.2}


def fit_drive(channel: str, *terms) -> Fit:
    """Return a fit to a mass on a motor whose commutation pulls it, with the wave at its true values."""
    t = np.arange(SAMPLES) * DT
    shown = np.sin(6.0 * t) + 1e-3 * np.random.default_rng(0).standard_normal(SAMPLES)
    observation = Observation.of("run", shown, 6.0 * np.cos(6.0 * t)[:, None], DT, channel)
    system = System(RigidDrive(), (Cogging(), *terms))
    known = system.vector({"m": 1.0, "c": 0.1, **WAVE, **{f"{t.name}.coefficient": 2.0 for t in terms}})
    frees = (FreeParameter(RANDOM, "1", -10.0, -60.0, 5.0), FreeParameter(NOISE, "1", -6.0, -20.0, 3.0))
    active = frozenset({"cogging", *(t.name for t in terms)})
    return maximise(
        Posterior(ParameterSpace(frees), (observation,), Lanes(system, active), Scales(6.0, 1.0, 0.16), known),
        np.array([-3.0, -5]),
    )


@pytest.mark.parametrize(
    ("channel", "terms", "unlocated"),
    [
        ("velocity", (), ["cogging"]),
        ("acceleration", (), ["cogging"]),
        ("position", (), []),
        ("velocity", (LinearStiffness(),), []),
    ],
)
def test_the_zero_is_unknown_if_neither_a_sensor_nor_a_spring_shows_it(channel, terms, unlocated):
    assert list_unlocated(fit_drive(channel, *terms)) == unlocated


def test_draws_have_any_phase_and_keep_their_size():
    """The phase is uniform (within four standard errors of its mean direction), amplitude and pitch are as before."""
    keys, draws = list(WAVE), np.tile(list(WAVE.values()), (2000, 1))
    made = shift_origin(fit_drive("velocity"), draws, keys, np.random.default_rng(1))
    assert np.hypot(made[:, 0], made[:, 1]) == pytest.approx(np.full(2000, 0.05))
    assert np.all(made[:, 2] == 0.2)
    assert abs(np.mean(np.exp(1j * np.arctan2(made[:, 1], made[:, 0])))) < 4.0 / math.sqrt(2000.0)


def test_draws_with_a_known_zero_are_unchanged():
    keys, draws = list(WAVE), np.tile(list(WAVE.values()), (5, 1))
    assert np.array_equal(shift_origin(fit_drive("position"), draws, keys, np.random.default_rng(1)), draws)


def test_the_parts_of_a_wave_depend_on_the_zero_and_its_pitch_does_not():
    values = {"cosine": 0.03, "sine": -0.04, "pitch": 0.2}
    assert list_shifted(Cogging(), values, 0.05) == ["cosine", "sine"]
    assert list_shifted(LinearStiffness(), {"coefficient": 2.0}, 0.05) == []
