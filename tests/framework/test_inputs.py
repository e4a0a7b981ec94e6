"""What nothing drives is zero, a model turns into its other motion, and names tell quantities and units."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference import Reference

from lostmotion.contracts import Assembly
from lostmotion.errors import ContractError, DataError
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM, FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import Clock, System
from lostmotion.noises import NOISE
from lostmotion.quantities import quantity_of, unit_of
from lostmotion.registry import default
from lostmotion_chaos.flows.flow import Harmonic, make_stepped_flow

DT, SAMPLES = 0.01, 200
USUAL = ("lin_backlash", "robot_joint")
"""A force and a base motion; each further model has to be compiled, and runs with the slow tests."""
MODELS = [
    pytest.param(default().make("model", name), id=name, marks=() if name in USUAL else pytest.mark.slow)
    for name in default().names("model")
]
GAP = {"x0": 0.02, "k0": 300.0}
"""A gap that the motion crosses; all other parameters are one, or zero where they may be."""


def moved(model):
    """Return as many columns as one drive moves, (samples, inputs)."""
    t = np.arange(SAMPLES) * DT
    return np.stack([0.3 * np.sin(6.0 * t), 1.8 * np.cos(6.0 * t)], axis=1)[:, : len(model.driven)]


def posterior_of(model, inputs, run=Lanes):
    """Return the posterior of one sensor at the first body, with dry friction in it."""
    system = System.of(Assembly(model) + default().make("term", "coulomb_friction", at=model.interfaces[-1].name))
    key = system.keys[0]
    full = system.vector({**{k: v for k, v in GAP.items() if k in system.index}, f"{key}.force": 0.1})
    readings = 0.1 * np.sin(6.0 * np.arange(SAMPLES) * DT)
    observation = Observation.of("run", readings, inputs, DT, "position")
    frees = (FreeParameter(RANDOM, "1", -6.0, -20.0, 5.0), FreeParameter(NOISE, "1", -3.0, -20.0, 3.0))
    return Posterior(ParameterSpace(frees), (observation,), run(system, frozenset({key})), Scales(1.0, 0.2, 0.2), full)


@pytest.mark.parametrize("model", MODELS)
def test_inputs_that_a_recording_lacks_are_zero(model):
    inputs = moved(model)
    whole = np.concatenate([inputs, np.zeros((SAMPLES, len(model.inputs) - inputs.shape[1]))], axis=1)
    narrow, wide = posterior_of(model, inputs), posterior_of(model, whole)
    assert whole.shape[1] > inputs.shape[1]
    assert narrow.observations[0].inputs.shape == whole.shape
    assert np.isfinite(narrow.log_density(narrow.space.start))
    assert narrow.log_density(narrow.space.start) == wide.log_density(wide.space.start)
    assert wide.on(wide.observations).observations[0] is wide.observations[0]


@pytest.mark.parametrize("model", MODELS)
def test_motion_and_derivatives_take_fewer_inputs(model):
    system, inputs = posterior_of(model, moved(model)).system, moved(model)
    full = posterior_of(model, inputs).known
    whole = np.concatenate([inputs, np.zeros((SAMPLES, len(model.inputs) - inputs.shape[1]))], axis=1)
    start = np.full(len(model.states), 0.05)
    runs = [system.simulate(full, system.keys, start, Drive.held(u, DT), 4).states for u in (inputs, whole)]
    np.testing.assert_array_equal(*runs)
    columns = [lambda t, i=i: np.interp(t, np.arange(SAMPLES) * DT, inputs[:, i]) for i in range(inputs.shape[1])]
    more = [*columns, *[np.zeros_like] * (len(model.inputs) - len(columns))]
    free = [system.moved(full, start, c, Clock(DT, 4, SAMPLES)).states for c in (columns, more)]
    np.testing.assert_allclose(*free, rtol=1e-9, atol=1e-14)
    asked = (frozenset(system.keys), system.pack(full[None], DT), runs[0])
    for few, all_of_them in zip(*(system.compute_derivatives(*asked, u) for u in (inputs, whole)), strict=True):
        np.testing.assert_array_equal(few, all_of_them)


@pytest.mark.parametrize("model", MODELS)
def test_a_harmonic_drive_moves_the_first_input_alone(model):
    posterior = posterior_of(model, moved(model))
    values = {slot.key: float(posterior.known[i]) for i, slot in enumerate(posterior.system.slots)}
    flow = make_stepped_flow(posterior.system, values, drive=Harmonic(0.3, 6.0, 0.2), steps=100)
    inputs = flow._make_inputs(4, flow.period / 4).reshape(4, 3, -1)[:, 0]
    angle = 2.0 * np.pi * np.arange(4) / 4 + 0.2
    np.testing.assert_allclose(inputs[:, 0], 0.3 * np.cos(angle), atol=1e-15)
    if model.inputs[0] == "base_position":
        np.testing.assert_allclose(inputs[:, 1], -1.8 * np.sin(angle), atol=1e-14)
    assert not inputs[:, len(model.driven) :].any()


@pytest.mark.slow
def test_lanes_and_matrices_agree_on_a_place_with_a_lever():
    """Friction between the teeth of wheels of ratio 3, through lanes and in matrices."""
    model = default().make("model", "gear_pair", motion="rotation")
    found = []
    for run in (Lanes, Reference):
        system = System.of(Assembly(model) + default().make("term", "coulomb_friction", at="mesh"))
        full = system.vector({**GAP, "ratio": 3.0, "coulomb_friction@mesh.force": 0.2})
        rough = posterior_of(model, moved(model), run)
        whole = replace(rough, dynamics=run(system, frozenset(system.keys)), known=full)
        found.append(whole.innovations(whole.space.start))
    np.testing.assert_allclose(found[0].errors, found[1].errors, rtol=1e-8, atol=1e-11)
    np.testing.assert_allclose(found[0].variances, found[1].variances, rtol=1e-8)


def test_a_model_turns_into_what_it_can_be():
    turning = default().make("model", "lin_backlash").turned("rotation")
    assert turning == default().make("model", "lin_backlash", motion="rotation")
    assert turning.turned("rotation") is turning
    joint = default().make("model", "robot_joint")
    assert joint.turned("rotation") is joint
    with pytest.raises(ContractError, match="robot_joint is of rotation, not of translation: ask for rotation"):
        joint.turned("translation")
    with pytest.raises(ContractError, match="of translation or rotation, not of sideways"):
        turning.turned("sideways")


def test_names_tell_quantities_and_units():
    said = {"second_position": "position", "elbow.velocity": "velocity", "base_acceleration": "acceleration",
            "torque": "force", "second_force": "force", "position": "position"}  # fmt: skip
    assert {name: quantity_of(name) for name in said} == said
    assert unit_of("base_acceleration", "rotation") == "rad/s^2"
    assert unit_of("base_velocity", "translation") == "m/s"
    assert [unit_of("torque", m) for m in ("translation", "rotation")] == ["N", "N m"]
    assert [quantity_of(name) for name in ("x2", "elbow", "x2.velocity")] == ["position", "position", "velocity"]
    with pytest.raises(DataError, match=r"'positon' ends in none of position, velocity.*did you mean 'position'"):
        quantity_of("positon")
