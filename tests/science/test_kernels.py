"""The composed kernels against their slow twin, an exact solution, another integrator and what dry friction must do."""

import json
import math
from dataclasses import fields, replace
from itertools import product

import numpy as np
import pytest
from independent import Machine, lin_oscillator, recording
from reference import Reference

from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.innovations import Smoothed
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points, SensorNoises
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.system import Clock, System
from lostmotion.noises import AR1, NoiseBlock, White
from lostmotion_plugins.models.basic import RigidDrive
from lostmotion_plugins.models.joint import RobotJoint
from lostmotion_plugins.models.lin import LinBacklash
from lostmotion_plugins.terms.friction import CoulombFriction, StribeckFriction
from lostmotion_plugins.terms.memory import DahlFriction
from lostmotion_plugins.terms.viscous import QuadraticDamping, ViscousDamping
from lostmotion_trials.demo.conceal import FRICTION, HIDDEN, JOINT, simulate_joint

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


def drive_of(model, columns, *, samples=SAMPLES):
    """Return smooth inputs at 200 samples of a drive period, or at 200 Hz for a joint."""
    dt = PERIOD / 200.0 if "force" in model.inputs else 1.0 / 200.0
    return Drive.smooth(list(columns), dt, samples)


def seen_of(system, full, drive, sensors, random):
    """Return running, an observation with a lost reading, and points of which the first start is wrong on purpose."""
    running = Lanes(system, system.everything, 4, random)
    truth = system.simulate(full, system.everything, np.array([0.6 * full[system.index["x0"]], 0.1]), drive, 4)
    packed = system.pack(full[None], drive.dt / 4)
    _, channels = system.compute_derivatives(system.everything, packed, truth.states, drive.inputs)
    columns = [channels[:, system.model.channels.index(s.channel)] for s in sensors]
    z = np.stack([c + 1e-3 * c.std() * np.random.default_rng(0).standard_normal(len(c)) for c in columns], axis=1)
    z[7] = np.nan
    z[11, -1] = np.nan
    observation = Observation("seen", z, drive.inputs, drive.dt, sensors)
    return running, observation, points_of(running, full, drive, z, sensors)


SENSORS = {
    "position": (Sensor("position"),),
    "acceleration": (Sensor("acceleration"),),
    "both, with slow noise": tuple(Sensor(name, noises=(White(), AR1())) for name in ("position", "acceleration")),
}


def noise_of(sensors, scale, count):
    """Return white noise of a thousandth of the readings, and half as large slow noise of a memory of three samples."""
    sizes = {White: 1e-3, AR1: 5e-4}
    row = [
        NoiseBlock.join([n.covariance((sizes[type(n)] * s, 2.8), 1.0) for n in one.noises])
        for one, s in zip(sensors, scale, strict=True)
    ]
    return SensorNoises.of([row] * count)


def points_of(running, full, drive, z, sensors=SENSORS["position"], count=3):
    """Return parameter points near `full`, with noise levels of about those of the readings (samples, sensors)."""
    n, m = running.states, z.shape[1]
    shape, scale = (count, m), np.nanstd(z, axis=0)
    tile = np.tile(np.diag(np.array([1e-5, 1e-2, 1.0, 1.0])[:n]), (count, 1, 1))
    near = full * (1.0 + 1e-3 * np.arange(count)[:, None])
    return Points(
        near, np.full(count, 1e-3), np.full(count, 20.0), noise_of(sensors, scale, count),
        np.ones(shape) + 0.01 * np.arange(m),
        1e-4 * scale + np.zeros(shape), np.zeros(shape), np.zeros((count, n)), tile, (drive,),
        np.zeros(count, dtype=np.int64), np.zeros(count, dtype=np.int64),
    )  # fmt: skip


RANDOM = ("white", "held", "latent")
WAYS = [
    pytest.param(name, sensors, random, marks=() if (i + j + k) % 3 == 0 else pytest.mark.slow)
    for (i, name), (j, sensors), (k, random) in product(enumerate(TWINS), enumerate(SENSORS), enumerate(RANDOM))
]
"""All combinations; a Latin square of them, in which each pair stands once, runs always."""


@pytest.mark.parametrize(("name", "sensors", "random"), WAYS)
def test_filter_equals_its_slow_twin(name, sensors, random):
    """The channel "position" is a state; "acceleration" has to be linearised. The source is the same: bit by bit."""
    model, term, values, columns = TWINS[name]
    system = System(model, (term,))
    full = system.vector(values)
    asked = seen_of(system, full, drive_of(model, columns), SENSORS[sensors], random)
    fast, slow = asked[0], replace(asked[0], compiled=False)
    smoothed = [one.smooth(*asked[1:]) for one in (fast, slow)]
    for one, other in ((getattr(s, f.name) for s in smoothed) for f in fields(Smoothed) if f.name != "innovations"):
        np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-12 * np.abs(other).max())
    both = [one.filter(*asked[1:]) for one in (fast, slow)]
    assert both[0].finite.all()
    np.testing.assert_allclose(both[0].errors, both[1].errors, rtol=1e-12, atol=1e-12 * np.abs(both[1].errors).max())
    np.testing.assert_allclose(both[0].variances, both[1].variances, rtol=1e-12)


@pytest.mark.parametrize(("name", "sensors", "random"), WAYS)
def test_filter_equals_that_of_matrices(name, sensors, random):
    """`Reference` shares nothing with `Lanes` but the rule by which a step is halved."""
    model, term, values, columns = TWINS[name]
    system = System(model, (term,))
    asked = seen_of(system, system.vector(values), drive_of(model, columns), SENSORS[sensors], random)
    slack = 1e-3 if name == "dahl" else 1e-7  # a bristle that turns round amplifies the last digit
    lanes, *given = asked
    both = (lanes, Reference(lanes.system, lanes.active, lanes.nsub, lanes.random))
    fast, slow = (one.smooth(*given) for one in both)
    one, other = (np.diagonal(s.covariance, axis1=1, axis2=2) for s in (fast, slow))
    most = other.max(axis=0)
    assert np.all(np.abs(fast.states - slow.states) < slack * np.sqrt(most))
    assert np.all(np.abs(one - other) < slack * most)
    fast, slow = (one.filter(*given) for one in both)
    assert np.all(np.abs(fast.errors - slow.errors) < slack * (np.sqrt(slow.variances) + np.abs(slow.errors)))
    assert np.allclose(fast.variances, slow.variances, rtol=slack)


def test_sliding_friction_with_an_elastic_part_is_smoothed():
    """Of a bristle that slides the filter knows the deflection to 1e-18, and rounding errors must not be amplified.

    The smoothed force was 1.7 N m at a prior standard deviation of 0.0006 N m before.
    """
    system = System(RobotJoint(), (DahlFriction(),))
    values = {"m": 0.104, "c": 0.0985, "k0": 54.9, "x0": 0.00738}
    full = system.vector({**values, "dahl_friction.force": 0.0033, "dahl_friction.deflection": 0.00125})
    drive = Drive.smooth([lambda t: 0.06 * np.cos(3.25 * t), lambda t: -0.195 * np.sin(3.25 * t)], 0.0171, 400)
    truth = system.simulate(full, system.everything, np.array([0.001, 0.1]), drive, 7).states[:, :1]
    noise = 1e-2 * truth.std()
    z = truth + noise * np.random.default_rng(0).standard_normal(truth.shape)
    points = replace(
        points_of(Lanes(system, system.everything), full, drive, z, count=1),
        pace=np.array([77.0]), process=np.array([1e-8]), noise=SensorNoises.of([[NoiseBlock(white=noise**2)]]),
    )  # fmt: skip
    observation = Observation("seen", z, drive.inputs, drive.dt, (Sensor("position"),))
    for run in (Lanes, Reference):
        seen = run(system, system.everything, 7, "latent").smooth(observation, points)
        assert seen.states[:, 3].std() < 6e-4


@pytest.mark.parametrize("name", TWINS)
def test_free_run_equals_its_slow_twin_and_that_of_matrices(name):
    model, term, values, columns = TWINS[name]
    system = System(model, (term,))
    full, drive, n = system.vector(values), drive_of(model, columns), system.states(system.everything)
    lanes = Lanes(system, system.everything)
    asked = points_of(lanes, full, drive, np.zeros((1, 1))), np.full((3, n), 1e-3), SAMPLES
    ways = (lanes, replace(lanes, compiled=False), Reference(system, system.everything))
    fast, slow, plain = (one.simulate(*asked) for one in ways)
    assert np.ptp(fast[0, :, 0]) > 0.0
    np.testing.assert_allclose(fast, slow, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(fast, plain, rtol=1e-9, atol=1e-12)


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
    states = system.moved(system.vector(CASE_1), exact[0], FORCE, Clock(PERIOD, steps, len(exact))).states
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
    states = system.moved(full, np.array([0.001, 0.1]), FORCE, Clock(dt, 40, samples)).states
    assert np.abs(states[:, 0] - other[:, 0]).max() < 2e-3 * machine.x0


def test_joint_of_the_demo_obeys_the_model_that_will_find_it():
    """Degrees, relative motion and leapfrog against radians, absolute motion and RK4, for one period."""
    base, seen = simulate_joint(0.0, 0.3, FRICTION, 200.0, 130)
    amplitude, omega = math.radians(base[0]), 2.0 * math.pi * 1.54
    columns = (lambda t: amplitude * np.cos(omega * t), lambda t: -amplitude * omega * np.sin(omega * t))
    system = System(RobotJoint(), (CoulombFriction("base"),))
    full = system.vector({**JOINT, HIDDEN: FRICTION})
    start = np.array([math.radians(base[0] + 0.3), 0.0])
    states = system.moved(full, start, columns, Clock(1.0 / 200.0, 100, 130)).states
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
    return system.moved(full, np.zeros(2), [lambda t: np.full(len(t), force)], Clock(1e-3, nsub, 201)).states


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
    x, v = system.moved(full, np.array([0.0, 0.15]), [np.zeros_like], Clock(1e-3, 1, 301)).states.T
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
    assert whole.functions() is System(LinBacklash(), TERMS).functions()


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
