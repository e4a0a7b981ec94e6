"""Several sensors and several inputs: delays of any length, sensors of their own rate, what each has of its own.

The machines are followed by DOP853 from equations written anew (`sensed.py`).
"""

from __future__ import annotations

import numpy as np
import pytest
from sensed import CHAIN, case_of, chain, model_of, moved, multisine, noisy, said_of

from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.space import FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import System
from lostmotion_plugins.models.basic import LinearOscillator
from lostmotion_plugins.terms.sensor import SensorDelay

ENCODERS = (
    {"channel": "position", "column": "motor", "unit": "mm", "name": "motor encoder"},
    {"channel": "second_position", "column": "load", "unit": "mm", "name": "load encoder"},
)
FORCE = {"input": "force", "column": "F", "unit": "N"}
T = np.arange(1800) / 150.0
DRIVE = multisine(1.4, 0.6, 3.6, seed=1)


def oscillator(dt, samples, late):
    """Return force, position, and the position as it was `late` seconds ago, of a linear oscillator."""
    drive, before = multisine(1.0, 0.5, 3.0, seed=5), 1.0
    t = np.arange(round(before / dt) + samples) * dt

    def rates(now, y):
        return [y[1], drive(now) - 0.8 * y[1] - 90.0 * y[0]]

    whole = moved(rates, t, [0.0, 0.0])
    behind = moved(rates, np.r_[0.0, t[t > late + 1e-9] - late], [0.0, 0.0])
    keep = slice(-samples, None)
    return drive(t[keep]), whole[keep, 0], behind[keep, 0]


def test_the_likelihood_of_a_late_sensor_is_smooth_and_highest_at_its_delay():
    dt, late = 0.01, 0.0237  # 2.37 samples
    force, x, behind = oscillator(dt, 900, late)
    readings = np.stack([noisy(x, 0.01, 1), noisy(behind, 0.01, 2)], axis=1)
    sensors = (Sensor("position", "near"), Sensor("position", "far"))
    seen = Observation("run", readings, force[:, None], dt, sensors, driven=("force",))
    system = System(LinearOscillator(), (SensorDelay(at="near"), SensorDelay(at="far")))
    known = system.vector({"m": 1.0, "c": 0.8, "k": 90.0})
    levels = [FreeParameter(f"log_noise:{s.label}", "1", np.log(0.01 * x.std()), -20.0, 0.0) for s in sensors]
    delay = FreeParameter("sensor_delay@far.delay", "s", 0.0, 0.0, 0.05)
    frees = (delay, *levels, FreeParameter("log_random_force", "1", np.log(1e-8), -40.0, 0.0))
    posterior = Posterior(
        ParameterSpace(frees), (seen,), Lanes(system, frozenset({"sensor_delay@far"})), Scales(1.0, 0.02, 0.1), known
    )
    grid = np.linspace(0.0, 0.045, 181)
    theta = np.tile(posterior.space.start, (len(grid), 1))
    theta[:, 0] = grid
    heights = posterior.log_likelihood(theta)
    assert grid[np.argmax(heights)] == pytest.approx(late, abs=2e-4)
    near = np.abs(grid - late) < 0.006  # half samples lie at 0.025 and, beyond, at 0.015
    steps = np.diff(heights[near])
    assert np.abs(np.diff(steps)).max() < 0.05 * np.abs(steps).max() + 0.3
    errors = posterior.innovations(theta[[np.argmax(heights)]])[0].errors.reshape(-1, 2)
    assert np.count_nonzero(errors[:5]) == 0  # where a sensor may be late, the first readings are left out


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mechanism", "spoil", "name", "truth"),
    [
        ("sensor_delay", lambda x, t: np.interp(t - 0.011, t, x), "delay", 0.011),
        ("sensor_gain", lambda x, t: 1.06 * x, "error", 0.06),
        ("sensor_offset", lambda x, t: x + 2.5e-3, "offset", 2.5e-3),
    ],
)
def test_what_one_of_two_encoders_has_of_its_own_is_named_at_it(tmp_path, mechanism, spoil, name, truth):
    states = chain(T, DRIVE)
    load = 1e3 * noisy(spoil(states[:, 2], T), 0.01, 4)
    columns = {"t": T, "F": DRIVE(T), "motor": 1e3 * noisy(states[:, 0], 0.01, 3), "load": load}
    model = model_of("clearance_chain", CHAIN, ("c1", "k0", "x0"))
    said = said_of(case_of(tmp_path, columns, {"inputs": [FORCE], "sensors": list(ENCODERS)}, model))
    (found,) = said.found
    assert (found.mechanism, found.at) == (mechanism, "load encoder")
    value = found.parameters[name]
    assert value.low - 0.02 * abs(truth) <= truth <= value.high + 0.02 * abs(truth)
    assert all(row.mechanism != "excitation_delay" for row in said.confused_with)


@pytest.mark.slow
def test_a_slow_sensor_beside_a_fast_one_tells_what_it_sees(tmp_path):
    states = chain(T, DRIVE)
    load = np.full(len(T), np.nan)
    load[::10] = 1e3 * noisy(states[:, 2], 0.01, 4)[::10]
    columns = {"t": T, "F": DRIVE(T), "motor": 1e3 * noisy(states[:, 0], 0.01, 3), "load": load}
    model = model_of("clearance_chain", CHAIN, ("c1", "k0", "x0"))
    said = said_of(case_of(tmp_path, columns, {"inputs": [FORCE], "sensors": list(ENCODERS)}, model))
    assert said.verdict == "adequate"
    assert any("every 10th row (15 Hz)" in note for note in said.notes)
    assert [s.name for s in said.sensors] == ["motor encoder", "load encoder"]
    assert said.sensors[1].noise_sd == pytest.approx(0.01 * states[:, 2].std(), rel=0.15)
    by_sensor = said.fit.after.nrmse_by_sensor
    assert set(by_sensor) == {"motor encoder", "load encoder"}
    assert said.fit.after.nrmse == pytest.approx(np.mean(list(by_sensor.values())))
    for parameter in ("k0", "x0"):
        value = said.parameters.after[parameter]
        assert value.low * 0.99 <= CHAIN[parameter] <= value.high * 1.01


@pytest.mark.slow
def test_two_forces_are_two_inputs(tmp_path):
    second = multisine(0.7, 0.8, 3.0, seed=9)
    states = chain(T, DRIVE, second)
    columns = {"t": T, "F": DRIVE(T), "B": second(T), "motor": 1e3 * noisy(states[:, 0], 0.01, 3)}
    inputs = [FORCE, {"input": "second_force", "column": "B", "unit": "N"}]
    model = model_of("clearance_chain", CHAIN, ("c1", "k0", "x0"))
    said = said_of(case_of(tmp_path, columns, {"inputs": inputs, "sensors": [ENCODERS[0]]}, model))
    assert said.verdict == "adequate"
    for parameter in ("k0", "x0"):
        value = said.parameters.after[parameter]
        assert value.low * 0.99 <= CHAIN[parameter] <= value.high * 1.01


@pytest.mark.slow
def test_a_shaken_table_with_an_accelerometer_on_it(tmp_path):
    base, t = multisine(3.0, 0.6, 3.6, seed=2), np.arange(2400) / 200.0
    drag = 0.25

    def rates(now, y):
        return [y[1], -float(base(now)) - 0.7 * y[1] - 150.0 * y[0] - drag * np.tanh(y[1] / 2e-5)]

    states = moved(rates, t, [0.0, 0.0])
    own = np.array([rates(now, y)[1] for now, y in zip(t, states, strict=True)])
    table = base(t)
    columns = {"t": 1e3 * t, "table": table / 9.80665, "body": noisy(own + table, 0.01, 3) / 9.80665,
               "gauge": 1e3 * noisy(states[:, 0], 0.01, 4)}  # fmt: skip
    recording = {
        "time": {"column": "t", "unit": "ms"},
        "inputs": [{"input": "base_acceleration", "column": "table", "unit": "g"}],
        "sensors": [
            {"channel": "acceleration", "column": "body", "unit": "g", "name": "accelerometer"},
            {"channel": "position", "column": "gauge", "unit": "mm", "name": "strain gauge"},
        ],
    }
    model = model_of("linear_oscillator", {"m": 1.0, "c": 0.7, "k": 150.0}, ("c", "k"))
    said = said_of(case_of(tmp_path, columns, recording, model))
    (found,) = said.found
    assert found.mechanism == "coulomb_friction"
    value = found.parameters["force"]
    assert value.low - 0.005 <= drag <= value.high + 0.005


@pytest.mark.slow
def test_a_load_cell_beside_an_encoder_on_a_joint_that_is_moved(tmp_path):
    m, c, k0, x0, drag = 0.9, 1.2, 900.0, 1.2e-3, 0.35
    base, t = multisine(6e-3, 0.5, 2.5, seed=7), np.arange(2000) / 200.0
    pace = 1e-6

    def slope(now):
        return (float(base(now + pace)) - float(base(now - pace))) / (2.0 * pace)

    def through(now, y):
        gap = float(base(now)) - y[0]
        return c * (slope(now) - y[1]) + k0 * np.copysign(max(abs(gap) - x0, 0.0), gap)

    states = moved(lambda now, y: [y[1], (through(now, y) - drag * np.tanh(y[1] / 1e-5)) / m], t, [0.0, 0.0])
    cell = np.array([through(now, y) for now, y in zip(t, states, strict=True)])
    columns = {"t": t, "base": 1e3 * base(t), "cell": noisy(cell, 0.01, 3), "x": 1e3 * noisy(states[:, 0], 0.01, 4)}
    recording = {
        "inputs": [{"input": "base_position", "column": "base", "unit": "mm"}],
        "sensors": [
            {"channel": "force", "column": "cell", "unit": "N", "name": "load cell"},
            {"channel": "position", "column": "x", "unit": "mm", "name": "encoder"},
        ],
    }
    values = {"m": m, "c": c, "k0": k0, "x0": x0}
    said = said_of(case_of(tmp_path, columns, recording, model_of("backlash_slider", values, ("c", "k0", "x0"))))
    (found,) = said.found
    assert (found.mechanism, found.at) == ("coulomb_friction", "ground")
    value = found.parameters["force"]
    assert value.low - 0.005 <= drag <= value.high + 0.005
    for parameter in ("k0", "x0"):
        value = said.parameters.after[parameter]
        assert value.low * 0.99 <= values[parameter] <= value.high * 1.01
