"""The composed kernels against their slow twin, an exact solution, another integrator and what dry friction must do."""

import json
import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from independent import Machine, lin_oscillator, recording

from lostmotion.forcing import Drive
from lostmotion.system import System
from lostmotion.workflow.conceal import FRICTION, HIDDEN, JOINT, joint_motion
from lostmotion_plugins.models.basic import RigidDrive
from lostmotion_plugins.models.joint import RobotJoint
from lostmotion_plugins.models.lin import LinBacklash
from lostmotion_plugins.terms.friction import CoulombFriction, StribeckFriction
from lostmotion_plugins.terms.memory import DahlFriction
from lostmotion_plugins.terms.viscous import QuadraticDamping, ViscousDamping

CASE_1 = {"m": 1.0, "c": 8.0, "k1": 0.0, "k0": 4e4, "x0": 0.005}
PERIOD = 2.0 * math.pi / 40.0
FORCE = (lambda t: 100.0 * np.cos(40.0 * t),)
BASE = (lambda t: 0.05 * np.cos(9.7 * t), lambda t: -0.485 * np.sin(9.7 * t))
SAMPLES = 40

TWINS = {
    "coulomb": (LinBacklash(), CoulombFriction(), {**CASE_1, "coulomb_friction.force": 3.0}, FORCE),
    "joint": (RobotJoint(), CoulombFriction("base"), {**JOINT, HIDDEN: FRICTION}, BASE),
    "dahl": (
        LinBacklash(),
        DahlFriction(),
        {**CASE_1, "dahl_friction.force": 3.0, "dahl_friction.deflection": 1e-4},
        FORCE,
    ),
}


def drive_of(model, columns, *, samples=SAMPLES, nsub=3):
    """Return smooth inputs at 200 samples of a drive period, or at 200 Hz for a joint."""
    dt = PERIOD / 200.0 if "force" in model.inputs else 1.0 / 200.0
    return Drive.smooth(list(columns), dt, nsub, samples)


def track_all(system, full, drive, channel, *, latent, compiled):
    """Return every array that the filter writes, from a start that is wrong on purpose."""
    active, n = system.everything, system.states(system.everything) + latent
    base, own = system.pack(full, drive.dt / drive.nsub)
    truth = system.simulate(full, active, np.array([0.6 * full[system.index["x0"]], 0.1]), drive).states
    z = truth[:, 0] + 1e-5 * np.random.default_rng(0).standard_normal(len(truth))
    z[7] = np.nan
    y0, cov = np.zeros(n), np.diag(np.array([1e-5, 1e-2, 1.0, 1.0])[:n])
    written = [
        np.zeros(shape) for shape in ((SAMPLES,), (SAMPLES,), *2 * ((SAMPLES, n), (SAMPLES, n, n)), (SAMPLES, n, n))
    ]
    errors, variances, *kept = written
    track = system.kernel(active, latent=latent, compiled=compiled).track
    done = track(
        z, drive.u, drive.begin, drive.dt, drive.nsub, base, own, *system.wiring(active), 20.0, 1e-3, 1e-10, 4e-10, 0.7,
        y0, cov, *system.channel(channel), errors, variances, True, *kept,
    )  # fmt: skip
    assert done == SAMPLES
    return written


@pytest.mark.parametrize(("name", "latent"), list(product(TWINS, [False, True])))
def test_filter_equals_its_slow_twin(name, latent):
    """The channel "position" is a state; "acceleration" has to be linearised. On x86-64 the twins are bit-equal."""
    model, term, values, columns = TWINS[name]
    system = System(model, (term,))
    full, drive = system.vector(values), drive_of(model, columns)
    for channel in ("position", "acceleration"):
        fast, slow = (track_all(system, full, drive, channel, latent=latent, compiled=c) for c in (True, False))
        for one, other in zip(fast, slow, strict=True):
            np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-12 * np.abs(other).max())


@pytest.mark.parametrize("name", TWINS)
def test_free_run_equals_its_slow_twin(name):
    model, term, values, columns = TWINS[name]
    system = System(model, (term,))
    full, drive, n = system.vector(values), drive_of(model, columns), system.states(system.everything)
    base, own = system.pack(full, drive.dt / drive.nsub)
    fast, slow = np.zeros((2, SAMPLES, n))
    for states, compiled in ((fast, True), (slow, False)):
        run = system.kernel(system.everything, compiled=compiled).run
        assert (
            run(
                np.full(n, 1e-3),
                drive.u,
                drive.begin,
                drive.dt,
                3,
                base,
                own,
                *system.wiring(system.everything),
                0.0,
                states,
            )
            == SAMPLES
        )
    assert np.ptp(fast[:, 0]) > 0.0
    np.testing.assert_allclose(fast, slow, rtol=1e-12, atol=1e-15)


@pytest.fixture(scope="module")
def exact(shared):
    """Exact states of Case 1 once a period: solved piece by piece, checked by a Taylor integrator to 5e-9 half gaps."""
    path = shared / "reference" / "ode_reference.json"
    if not path.is_file():
        pytest.skip(f"no reference: {path} is absent")
    return np.array(json.loads(path.read_text())["strobe_states_t_kT"])


@pytest.mark.real
def test_free_run_against_the_exact_solution(exact):
    """Chaos multiplies an error by about three a period; at a kink RK4 is of first order in the mean, not of fourth.

    With 200 steps a period the motion is lost after six periods; 2000 steps hold four periods to 1e-3 of the gap.
    """
    errors = {steps: strobed(steps, exact) for steps in (200, 2000, 16000)}
    assert errors[200][6] > 0.1
    assert errors[2000][:5].max() < 1e-3
    assert errors[16000][:9].max() < 1e-3
    for period in range(1, 9):
        assert errors[16000][period] < errors[2000][period] < errors[200][period]


def strobed(steps, exact):
    """Return the errors of position, in half gaps, once a period."""
    system = System(LinBacklash())
    drive = Drive.smooth(list(FORCE), PERIOD, steps, len(exact))
    states = system.simulate(system.vector(CASE_1), (), exact[0], drive).states
    return np.abs(states[:, 0] - exact[:, 0]) / CASE_1["x0"]


@pytest.mark.real
def test_other_integrator_against_the_exact_solution(exact):
    states = lin_oscillator(Machine(), tuple(exact[0]), PERIOD / 200.0, 1001)[::200]
    assert np.abs(states[:5, 0] - exact[:5, 0]).max() < 1e-3 * CASE_1["x0"]


def test_kernel_and_other_integrator_agree_with_friction():
    """Two methods with two laws of stick: the set-valued one, and a steep line as wide as one step."""
    machine = Machine(coulomb=3.0, quadratic=0.5)
    dt, samples = PERIOD / 200.0, 401
    other = lin_oscillator(machine, (0.001, 0.1), dt, samples)
    system = System(LinBacklash(), (CoulombFriction(), QuadraticDamping()))
    full = system.vector({**CASE_1, "coulomb_friction.force": 3.0, "quadratic_damping.coefficient": 0.5})
    states = system.simulate(
        full, system.everything, np.array([0.001, 0.1]), Drive.smooth(list(FORCE), dt, 40, samples)
    ).states
    assert np.abs(states[:, 0] - other[:, 0]).max() < 2e-3 * machine.x0


def test_joint_of_the_demo_obeys_the_model_that_will_find_it():
    """Degrees, relative motion and leapfrog against radians, absolute motion and RK4, for one period."""
    base, seen = joint_motion(0.0, 0.3, FRICTION, 200.0, 130)
    amplitude, omega = math.radians(base[0]), 2.0 * math.pi * 1.54
    columns = (lambda t: amplitude * np.cos(omega * t), lambda t: -amplitude * omega * np.sin(omega * t))
    system = System(RobotJoint(), (CoulombFriction("base"),))
    full = system.vector({**JOINT, HIDDEN: FRICTION})
    start = np.array([math.radians(base[0] + 0.3), 0.0])
    states = system.simulate(full, system.everything, start, Drive.smooth(list(columns), 1.0 / 200.0, 100, 130)).states
    link = base + seen[:, 0]
    assert np.abs(np.degrees(states[:, 0]) - link).max() < 1e-3


def test_recording_is_settled_and_noisy():
    one = recording(Machine(coulomb=3.0), periods=10, noise=0.01, seed=2)
    again = recording(Machine(coulomb=3.0), periods=10, noise=0.01, seed=2)
    np.testing.assert_array_equal(one.position, again.position)
    assert np.std(one.position - one.states[:, 0]) == pytest.approx(0.01 * one.states[:, 0].std(), rel=0.1)


LAWS = {
    "coulomb": (CoulombFriction(), {"coulomb_friction.force": 3.0}),
    "stribeck": (
        StribeckFriction(),
        {"stribeck_friction.force": 2.0, "stribeck_friction.excess": 1.0, "stribeck_friction.velocity": 0.05},
    ),
}


def pushed(name, force, *, nsub=1):
    """Return states (201, 2) every 1 ms of 2 kg from rest under a constant force."""
    term, values = LAWS[name]
    system = System(RigidDrive(), (term,))
    full = system.vector({"m": 2.0, "c": 0.0, **values})
    drive = Drive.smooth([lambda t: np.full(len(t), force)], 1e-3, nsub, 201)
    return system.simulate(full, system.everything, np.zeros(2), drive).states


@pytest.mark.parametrize(("name", "force", "nsub"), list(product(LAWS, [0.5, 2.0, -2.9], [1, 10])))
def test_friction_that_holds_creeps_no_faster_than_one_step_allows(name, force, nsub):
    """The bias of the law: at rest under `force` it creeps at `force * mobility`, with mobility = step / mass.

    At 2 N, 2 kg and 1 ms that is 1 mm/s, or 1 micrometre a step; it shrinks with the step. Stribeck's law creeps a
    little faster, since it weakens with the creep itself.
    """
    slack = 1.0 + (1e-9 if name == "coulomb" else 1e-3)
    creep = abs(force) * (1e-3 / nsub) / 2.0
    x, v = pushed(name, force, nsub=nsub).T
    assert np.abs(v).max() <= creep * slack
    assert np.abs(np.diff(x)).max() <= creep * 1e-3 * slack
    if name == "coulomb":
        assert abs(v[-1]) == pytest.approx(creep)


def test_friction_that_is_overcome_slides():
    """4 N against 3 N moves 2 kg with 0.5 m/s^2; what the steep line loses is less than one step of sliding."""
    v = pushed("coulomb", 4.0)[:, 1]
    assert np.diff(v)[20:] == pytest.approx(0.5e-3)
    assert 0.0 <= v[-1] - 0.5 * 0.2 <= 3.0 * 1e-3 / 2.0


def test_friction_stops_a_mass_within_a_step_of_the_right_time():
    """3 N stops 2 kg from 0.15 m/s in 0.1 s, after 7.5 mm; then it stays."""
    term, values = LAWS["coulomb"]
    system = System(RigidDrive(), (term,))
    full = system.vector({"m": 2.0, "c": 0.0, **values})
    drive = Drive.smooth([np.zeros_like], 1e-3, 1, 301)
    x, v = system.simulate(full, system.everything, np.array([0.0, 0.15]), drive).states.T
    assert x[-1] == pytest.approx(0.0075, abs=0.15e-3)
    assert np.abs(v[120:]).max() < 1e-8


SUBSETS = ((), ("coulomb_friction",), ("quadratic_damping", "viscous_damping"))
TERMS = (CoulombFriction(), QuadraticDamping(), ViscousDamping())
VALUES = {"coulomb_friction.force": 3.0, "quadratic_damping.coefficient": 0.5, "viscous_damping.coefficient": 2.0}


@pytest.mark.parametrize("active", SUBSETS)
def test_one_compilation_serves_every_subset(active):
    whole = System(LinBacklash(), TERMS)
    part = System(LinBacklash(), tuple(t for t in TERMS if t.name in active))
    drive = drive_of(LinBacklash(), FORCE, samples=400)
    own = {key: value for key, value in VALUES.items() if key.split(".")[0] in active}
    switched = whole.simulate(whole.vector({**CASE_1, **VALUES}), active, np.array([0.001, 0.1]), drive)
    built = part.simulate(part.vector({**CASE_1, **own}), part.everything, np.array([0.001, 0.1]), drive)
    np.testing.assert_array_equal(switched.states, built.states)
    assert whole.kernel(active) is whole.kernel(whole.everything)


def test_a_term_at_its_null_does_nothing():
    system = System(LinBacklash(), TERMS)
    drive = drive_of(LinBacklash(), FORCE, samples=400)
    idle, none = (
        system.simulate(system.vector(CASE_1), a, np.array([0.001, 0.1]), drive) for a in (system.everything, ())
    )
    np.testing.assert_array_equal(idle.states, none.states)


def test_machine_has_the_physics_it_names():
    """Each extra of the other integrator changes the motion; none does so at zero."""
    plain = lin_oscillator(Machine(), (0.001, 0.1), PERIOD / 200.0, 300)
    for key, size in (("coulomb", 3.0), ("quadratic", 2.0), ("cubic", 1e8), ("k1", 1e3)):
        changed = lin_oscillator(replace(Machine(), **{key: size}), (0.001, 0.1), PERIOD / 200.0, 300)
        assert np.abs(changed - plain).max() > 1e-4
