"""Forces over two things at once, and with a memory, are learned from recordings by another integrator (DOP853).

The forces are no sums of the functions they are learned with, and no sums of curves over one thing.
"""

import numpy as np
import pytest
from sensed import case_of, model_of, moved, multisine, noisy

from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.inference.curves import compute_band
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.inference.unexplained import CurveSearch
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry

VALUES = {"m": 1.2, "c": 2.0, "k": 300.0}
T = np.arange(0.0, 24.0, 0.02)
TIME = 0.15
"""In which the hidden dashpot lets go (s)."""


def twisted(x, v, z):
    """Return a force that waves along a direction between position and velocity."""
    return 1.5 * np.sin(x / 0.02 + v / 0.35)


def yielding(x, v, z):
    """Return the force of a hard spring behind a dashpot."""
    return -60.0 * z - 4e4 * z**3


def over_one_thing(x, v, z):
    return 1.5 * np.tanh(x / 0.02)


def hidden_case(folder, law, seed=0):
    """Return the case of a machine in which a force is hidden."""
    force = multisine(10.0, 0.5, 5.0, seed)

    def rates(t, y):
        pull = float(force(t)) - VALUES["c"] * y[1] - VALUES["k"] * y[0] + law(*y)
        return [y[1], pull / VALUES["m"], y[1] - y[2] / TIME]

    x = moved(rates, T, [0.0, 0.0, 0.0])[:, 0]
    recording = {
        "excitation": {"column": "F", "quantity": "force", "unit": "N"},
        "response": {"column": "x", "quantity": "position", "unit": "m"},
    }
    model = model_of("linear_oscillator", VALUES, ("c", "k"))
    return case_of(folder, {"t": T, "F": force(T), "x": noisy(x, 0.003, seed)}, recording, model)


def learned(folder, law, seed=0):
    """Return what is learned where a force is hidden, the library being empty."""
    prepared = prepare(hidden_case(folder, law, seed), Registry.discover())
    train, _ = split_heldout(prepared.observations)
    system = System(prepared.model)
    nominal = search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(seed))
    return CurveSearch(1).unknown(nominal, nominal)


def depends(found):
    return [name for term in found.terms for name in term.depends]


@pytest.mark.slow
def test_a_force_over_position_and_velocity_is_learned_as_a_map(tmp_path):
    found = learned(tmp_path, twisted)
    assert depends(found) == ["position", "velocity"]
    band = compute_band(found.fit, found.keys[0])
    x, v = np.meshgrid(band.at, band.beside, indexing="ij")
    visited = (np.abs(x) < 0.5 * np.max(band.at)) & (np.abs(v) < 0.5 * np.max(band.beside))
    told, true = band.mean.reshape(x.shape)[visited], twisted(x, v, 0.0)[visited]
    beside = np.column_stack([x[visited], v[visited], np.ones(visited.sum())])  # spring, damping and offset are free
    left = (told - true) - beside @ np.linalg.lstsq(beside, told - true, rcond=None)[0]
    assert np.std(left) < 0.25 * np.std(true)


@pytest.mark.slow
def test_a_spring_behind_a_dashpot_is_a_force_that_depends_on_the_history(tmp_path):
    found = learned(tmp_path, yielding)
    assert depends(found) == ["history"]
    time = found.fit.posterior.known[found.fit.posterior.system.index[f"{found.keys[0]}.time"]]
    assert TIME / 3.0 < time < 3.0 * TIME


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_a_force_over_one_thing_stays_a_curve(tmp_path, seed):
    assert depends(learned(tmp_path, over_one_thing, seed)) == ["position"]


@pytest.mark.slow
@pytest.mark.parametrize(("law", "names"), [(twisted, ["position", "velocity"]), (yielding, ["history"])])
def test_beside_the_whole_library_it_stays_unknown_and_is_predicted(tmp_path, law, names):
    told = run_diagnosis(hidden_case(tmp_path, law), tmp_path / "out", Registry.discover(), jobs=1, propose=False)
    (found,) = [entry for entry in told.found if entry.mechanism != "random_force"]
    assert found.mechanism == "unknown"
    assert list(found.depends_on) == names
    assert told.fit.after.nrmse < 0.15 * told.fit.before.nrmse
    assert np.shape(found.curve.force) == ((41, 31) if len(names) == 2 else (161,))
