"""Machines of a calibration move as the models say, by integrators that share nothing with them."""

import numpy as np
import pytest

from lostmotion.errors import CaseError
from lostmotion.likelihood.system import Clock, System
from lostmotion.registry import default
from lostmotion.simulation.drive_signals import signal_of
from lostmotion_trials.coverage import machines
from lostmotion_trials.coverage.machines import Stand, record_machine

LIN = {"m": 1.0, "c": 8.0, "k1": 0.0, "k0": 4e4, "x0": 0.005}
JOINT = {"m": 0.05, "c": 0.15, "k0": 180.0, "x0": 0.0131, "mgl": 0.3}
FORCE, BASE = "harmonic:amplitude=100,omega=40", "harmonic:amplitude=0.05236,frequency=1.54"
CASES = {
    "lin": ("lin_backlash", LIN, FORCE, 636.6, {}, 3e-5),
    "lin with friction": ("lin_backlash", LIN, FORCE, 636.6, {"ground": 2.0}, 3e-3),
    "joint": ("robot_joint", JOINT, BASE, 200.0, {}, 3e-5),
    "joint with friction at the bearing": ("robot_joint", JOINT, BASE, 200.0, {"ground": 0.03}, 3e-3),
    "joint with friction in the joint": ("robot_joint", JOINT, BASE, 200.0, {"base": 0.03}, 3e-3),
}


@pytest.mark.parametrize("name", list(CASES))
def test_leapfrog_goes_with_the_model(name):
    """Over a short time, before chaos parts them: the two integrators share no line."""
    model, values, text, rate, friction, close = CASES[name]
    registry = default()
    terms = [registry.make("term", "coulomb_friction", at=place) for place in friction]
    system = System(registry.make("model", model), tuple(terms))
    forces = {f"{key}.force": f for key, f in zip(system.keys, friction.values(), strict=True)}
    full, samples = system.vector({**values, **forces}), 120
    drive = signal_of(text, duration=10.0, rng=np.random.default_rng(0))
    moved = machines._choose_mover(system)(
        system, full, machines._DrivenRun(drive, rate, samples), np.array([0.5, 0.3])
    )
    assert machines.describe_motion(system) == machines.INDEPENDENT
    known = {"force": drive.value, "base_position": drive.value, "base_velocity": drive.slope}
    inputs = [known[name] for name in system.model.driven]
    begin = [float(f(np.zeros(1))[0]) for f in (drive.value, drive.slope)] if model == "robot_joint" else [0.0, 0.0]
    y0 = np.array([begin[0] + 0.5 * values["x0"], begin[1] + 0.3 * values["x0"] * (values["k0"] / values["m"]) ** 0.5])
    other = system.moved(full, y0, inputs, Clock(1.0 / rate, 400, samples)).states[:, 0]
    assert np.abs(moved - other).max() < close * other.std()


def test_friction_sticks():
    registry = default()
    system = System(registry.make("model", "lin_backlash"), (registry.make("term", "coulomb_friction"),))
    full = system.vector({**LIN, "coulomb_friction.force": 3.0})
    bench = Stand(("step:size=2.9,at=0.2",), 1.0, 500.0, 0.0)
    seen = record_machine(system, full, bench, bench.drives[0], np.random.default_rng(0))
    # A push below the friction force moves nothing, not even slowly.
    assert np.ptp(seen.response[150:]) == 0.0


def test_noise_is_what_was_asked_for():
    system = System(default().make("model", "lin_backlash"))
    clean, noisy = (
        record_machine(
            system, system.vector(LIN), Stand((FORCE,), 5.0, 600.0, noise, loud), FORCE, np.random.default_rng(0)
        )
        for noise, loud in ((0.0, 0.0), (0.05, 0.01))
    )
    assert noisy.noise == pytest.approx(0.05 * clean.response.std())
    assert (noisy.response - clean.response).std() == pytest.approx(noisy.noise, rel=0.06)
    assert (noisy.excitation - clean.excitation).std() == pytest.approx(1.0, rel=0.06)
    assert clean.noise == 0.0


def test_another_term_is_moved_by_the_model_itself():
    registry = default()
    system = System(registry.make("model", "lin_backlash"), (registry.make("term", "quadratic_damping"),))
    assert machines.describe_motion(system) == machines.OWN
    drive = signal_of(FORCE, duration=10.0, rng=np.random.default_rng(0))
    bare = System(system.model)
    run = machines._DrivenRun(drive, 600.0, 100)
    start = np.array([0.5, 0.0])
    own = machines._move_by_model(system, system.vector(LIN), run, start)
    assert np.abs(own - machines._move_oscillator(bare, bare.vector(LIN), run, start)).max() < 3e-5 * own.std()


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"duration": -1.0}, "duration is -1"),
        ({"noise": -1.0}, "noise is -1"),
        ({"drives": ("humming:x=1",)}, "no drive"),
    ],
)
def test_benches_that_cannot_be_are_refused(change, sentence):
    given = {"drives": (FORCE,), "duration": 1.0, "rate": 600.0, "noise": 0.01, **change}
    with pytest.raises(CaseError, match=sentence):
        Stand(**given).check()
