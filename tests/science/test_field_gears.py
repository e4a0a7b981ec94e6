"""Two gear wheels: closed forms, balances of momentum, and the equations followed by another integrator."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from field import elsewhere

from lostmotion.contracts import Assembly
from lostmotion.inference.fit import maximise
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.space import RANDOM, FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import Clock, System
from lostmotion.noises import NOISE
from lostmotion_chaos.flows.flow import Harmonic, make_stepped_flow
from lostmotion_plugins.models.gear_pair import GearPair
from lostmotion_plugins.terms.elastic import CubicStiffness
from lostmotion_plugins.terms.friction import CoulombFriction

RATIO = 2.5
WHEELS = {"m1": 0.02, "m2": 0.3, "ratio": RATIO, "k0": 400.0, "x0": 0.0, "c": 0.0}
LOOSE = WHEELS | {
    "x0": 0.01,
    "c": 0.05,
    "c1": 0.03,
    "c2": 0.1,
    "load": 0.4,
    "kappa": 0.2,
    "omega_mesh": 35.0,
    "phase": 0.7,
}
START = np.array([0.012, 0.3, 0.001, -0.1])


def pulled(t):
    """Return torque on the first wheel, brake at the second, and acceleration of the table."""
    return np.array([1.5 * np.cos(9.0 * t), -0.5 * np.sin(4.0 * t), 6.0 * np.cos(23.0 * t + 0.4)])


def apart(t, y, moved=pulled, more=lambda d, rate: 0.0):
    """Return the rates of deflection d, angle of the second wheel and their rates: another choice of coordinates."""
    d, rate, _, turning = y
    torque, brake, shaken = moved(t)
    tooth = 400.0 * (1.0 + 0.2 * math.cos(35.0 * t + 0.7)) * math.copysign(max(abs(d) - 0.01, 0.0), d)
    mesh = 0.05 * rate + tooth - more(d, rate)
    first = (torque - mesh - 0.03 * (rate + RATIO * turning)) / 0.02 - shaken
    other = (RATIO * mesh - 0.4 + brake - 0.1 * turning) / 0.3 - shaken
    return np.array([rate, first - RATIO * other, turning, other])


def wheels(seen):
    """Return the states of the wheels (samples, 4) from those of `apart`."""
    return np.stack([seen[:, 0] + RATIO * seen[:, 2], seen[:, 1] + RATIO * seen[:, 3], seen[:, 2], seen[:, 3]], axis=1)


def deflected(y):
    return np.array([y[0] - RATIO * y[2], y[1] - RATIO * y[3], y[2], y[3]])


def test_wheels_that_rattle_against_another_integrator_in_other_coordinates():
    """All three inputs act; the accelerometers on both wheels show that of the table too."""
    system, full = System(GearPair("rotation")), System(GearPair("rotation")).vector(LOOSE)
    columns = [lambda t, i=i: pulled(t)[i] for i in range(3)]
    motion = system.moved(full, START, columns, Clock(0.005, 160, 400))
    t = np.arange(400) * 0.005
    seen = elsewhere(apart, t, deflected(START), max_step=1e-3)
    assert np.sum(np.diff(np.abs(seen[:, 0]) > 0.01)) > 10
    np.testing.assert_allclose(motion.states, wheels(seen), atol=2e-5 * np.abs(wheels(seen)).max())
    inputs = pulled(t).T
    _, shown = system.compute_derivatives(frozenset(), system.pack(full[None], 1e-3), wheels(seen), inputs, t)
    rates = np.array([apart(at, y) for at, y in zip(t, seen, strict=True)])
    absolute = np.stack([rates[:, 1] + RATIO * rates[:, 3] + inputs[:, 2], rates[:, 3] + inputs[:, 2]], axis=1)
    np.testing.assert_allclose(shown[:, [2, 5]], absolute, rtol=1e-9, atol=1e-9 * np.abs(absolute).max())
    np.testing.assert_allclose(shown[:, [0, 1, 3, 4]], wheels(seen), rtol=1e-12)


@pytest.mark.parametrize("compiled", [True, False])
def test_a_spring_in_the_mesh_pulls_the_second_wheel_by_the_ratio(compiled):
    """Through the stroboscopic kernel and its slow twin: only the torque acts."""

    def rates(t, y):
        return apart(t, y, lambda t: (1.5 * math.cos(9.0 * t), 0.0, 0.0), lambda d, rate: -3e4 * d**3)

    system = System.of(GearPair("rotation") + CubicStiffness(at="mesh"))
    values = {**LOOSE, "cubic_stiffness@mesh.coefficient": 3e4}
    flow = make_stepped_flow(system, values, drive=Harmonic(1.5, 9.0), start=START, steps=2000)
    t = np.linspace(0.0, 2.0 * np.pi / 9.0, 21)
    states = replace(flow, compiled=compiled).sample(START, periods=1, looks=20)
    exact = wheels(elsewhere(rates, t, deflected(START), max_step=1e-3))
    np.testing.assert_allclose(states, exact, atol=2e-5 * np.abs(exact).max())


@pytest.mark.parametrize("term", [(), (CoulombFriction(at="mesh"),), (CubicStiffness(at="mesh"),)])
def test_forces_between_the_teeth_keep_the_momentum(term):
    """No torque from outside: ratio m1 v1 + m2 v2 stays as it is, whatever acts in the mesh."""
    system = System.of(Assembly(GearPair("rotation"), term))
    values = {"coulomb_friction@mesh.force": 0.2, "cubic_stiffness@mesh.coefficient": 2e3}
    known = {key: value for key, value in values.items() if key in system.index}
    full = system.vector(WHEELS | {"x0": 0.01} | known)
    drive = Drive.smooth([np.zeros_like], 1e-4, 20000)
    states = system.simulate(full, system.everything, START, drive).states
    momentum = RATIO * 0.02 * states[:, 1] + 0.3 * states[:, 3]
    np.testing.assert_allclose(momentum, momentum[0], atol=1e-13)
    if "coulomb_friction@mesh" in system.keys:
        assert abs(states[-1, 1] - RATIO * states[-1, 3]) < 1e-3 * abs(states[0, 1] - RATIO * states[0, 3])


def test_closed_teeth_swing_at_the_frequency_of_both_wheels():
    """No gap, no damping: d = d0 cos(w t) with w^2 = k (1/m1 + ratio^2/m2), and the rest moves on evenly."""
    omega = math.sqrt(400.0 * (1.0 / 0.02 + RATIO**2 / 0.3))
    system = System(GearPair("rotation"))
    full = system.vector(WHEELS)
    drive = Drive.smooth([np.zeros_like], 2e-4, 5000)
    states = system.simulate(full, (), START, drive).states
    d = states[:, 0] - RATIO * states[:, 2]
    t, (first, rate) = np.arange(5000) * 2e-4, (d[0], START[1] - RATIO * START[3])
    np.testing.assert_allclose(d, first * np.cos(omega * t) + rate / omega * np.sin(omega * t), atol=1e-6)
    mesh = next(place for place in system.model.interfaces if place.name == "mesh")
    assert system.inertia(full, mesh) * omega**2 == pytest.approx(400.0, rel=1e-12)
    pack = 3.0 * system.inertia(np.stack([full, full]), mesh)
    np.testing.assert_allclose(pack, 3.0 / (1.0 / 0.02 + RATIO**2 / 0.3))


@pytest.mark.parametrize("open_", [True, False])
def test_the_fastest_rate_is_that_of_both_wheels_where_only_the_first_is_known_to_move(open_):
    """A light second wheel is the fastest part; steps for the first alone let the filter diverge."""
    system, light, c = System(GearPair("rotation")), 1e-3, 0.5
    full = system.vector(WHEELS | {"c": c, "m2": light, "x0": 10.0 if open_ else 1e-6})
    states = np.zeros((9, 4))
    states[:, 0] = [-1.0, -0.9, -0.8, -0.7, 0.6, 0.7, 0.8, 0.9, 1.0]
    states[:, 1] = np.tile([-20.0, 1.0, 20.0], 3)
    across = np.array([[-1.0, RATIO], [RATIO, -(RATIO**2)]]) / [[0.02], [light]]
    matrix = np.zeros((4, 4))
    matrix[[0, 2], [1, 3]] = 1.0
    matrix[np.ix_([1, 3], [1, 3])] = c * across
    matrix[np.ix_([1, 3], [0, 2])] = 0.0 if open_ else 400.0 * across
    fastest = np.abs(np.linalg.eigvals(matrix)).max()
    assert fastest > 0.4 * c * RATIO**2 / light
    assert system.find_fastest_rate(full, (), states, np.zeros((9, 3))) == pytest.approx(fastest, rel=1e-4)


def test_stiff_teeth_turn_as_one_shaft():
    """Rigid limit: (ratio^2 m1 + m2) x2'' = ratio torque + brake - load, and x1 = ratio x2, but for what teeth give."""
    system = System(GearPair("rotation"))
    full = system.vector(WHEELS | {"k0": 4e6, "c": 300.0, "load": 0.4})
    columns = [lambda t: 1.5 + 0.0 * t, lambda t: -0.2 + 0.0 * t]
    states = system.moved(full, np.zeros(4), columns, Clock(0.01, 400, 200)).states
    t = np.arange(200) * 0.01
    pull = (RATIO * 1.5 - 0.2 - 0.4) / (RATIO**2 * 0.02 + 0.3)
    np.testing.assert_allclose(states[:, 2], 0.5 * pull * t**2, atol=1e-5)
    np.testing.assert_allclose(states[:, 0], RATIO * states[:, 2], atol=1e-5)
    np.testing.assert_allclose(states[:, 3], pull * t, atol=1e-5)


def test_two_encoders_tell_ratio_backlash_stiffness_and_inertia():
    """Torque and brake are recorded, the table is not and stands still. Each truth within three standard deviations,
    which four numbers leave by chance in one of a hundred seeds."""
    t, brake = np.arange(1500) * 0.005, np.array([1.0, 1.0, 0.0])
    seen = wheels(elsewhere(lambda t, y: apart(t, y, lambda t: brake * pulled(t)), t, deflected(START), max_step=2e-3))
    noise = np.array([2e-4, 1e-4])
    readings = seen[:, [0, 2]] + noise * np.random.default_rng(5).standard_normal((1500, 2))
    sensors = (Sensor("position"), Sensor("second_position"))
    observation = Observation("gears", readings, pulled(t)[:2].T, 0.005, sensors)
    off = {"ratio": 1.0003, "x0": 1.15, "k0": 0.85, "m2": 1.15}
    starts = {key: math.log(LOOSE[key] * factor) for key, factor in off.items()}
    frees = [FreeParameter(key, "", start, start - 1.5, start + 1.5, log=True) for key, start in starts.items()]
    frees += [FreeParameter(f"{NOISE}:{s.channel}", "1", math.log(1e-3), -14.0, 0.0) for s in sensors]
    loud = FreeParameter(RANDOM, "1", math.log(0.2 * 0.005), -30.0, 2.0)
    system = System(GearPair("rotation"))
    scales = Scales(1.5, float(readings[:, 0].std()), 0.1)
    space = ParameterSpace((*frees, loud))
    found = maximise(Posterior(space, (observation,), Lanes(system, nsub=6), scales, system.vector(LOOSE)))
    assert found.status == "converged"
    for key in off:
        assert abs(math.log(found.values[key] / LOOSE[key])) < 3.0 * found.sd[key], key
    assert found.sd["x0"] < 0.01
    np.testing.assert_allclose([math.exp(found.theta[i]) for i in (4, 5)], noise, rtol=0.1)


def test_units_follow_from_the_motion_of_the_instance():
    units = {motion: [s.unit for s in System(GearPair(motion)).slots] for motion in ("translation", "rotation")}
    assert units["translation"][:8] == ["kg", "N s/m", "kg", "N s/m", "N s/m", "N/m", "m", "1"]
    assert units["rotation"][:8] == ["kg m^2", "N m s/rad", "kg m^2", "N m s/rad", "N m s/rad", "N m/rad", "rad", "1"]
