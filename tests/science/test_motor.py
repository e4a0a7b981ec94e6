"""Motors with voltage, current and speed: friction is named from any two of the three, and its size is right.

The motors are integrated with 200 steps to a sample by the method of Euler, with friction that truly sticks.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lostmotion as lm
from lostmotion.quantities import INDUCTANCE, RESISTANCE, VOLTAGE

J, C, K, R, FRICTION = 4e-5, 2e-6, 0.05, 1.2, 0.006
DT, INNER = 0.005, 200
WIDE = {
    "J": lm.LogUniform(4e-6, 4e-4), "c": lm.LogUniform(1e-7, 1e-4), "K": lm.LogUniform(0.01, 0.3),
    "R": lm.LogUniform(0.2, 10.0), "L": lm.LogUniform(5e-5, 5e-3),
}  # fmt: skip


def run_motor(friction: float, *, inductance: float = 5e-4, samples: int = 1000) -> dict[str, np.ndarray]:
    """Return time, voltage, current and speed with noise of 2 mA and 0.2 rad/s."""
    rng, h = np.random.default_rng(1), DT / INNER
    speed = current = 0.0
    fine = np.arange(samples * INNER) * h
    volts = 2.6 * np.sin(2.1 * fine) + 1.4 * np.sin(5.3 * fine + 1.0) + 0.8 * np.sin(11.7 * fine)
    rows = []
    for k, v in enumerate(volts.tolist()):
        if k % INNER == 0:
            rows.append((current, speed))
        current += h / inductance * (v - R * current - K * speed)
        free = speed + h / J * (K * current - C * speed)
        speed = np.sign(free) * max(abs(free) - h / J * friction, 0.0)
    amps, speeds = np.array(rows).T
    return {
        "time": fine[::INNER], "voltage": volts[::INNER],
        "current": amps + 2e-3 * rng.standard_normal(samples), "velocity": speeds + 0.2 * rng.standard_normal(samples),
    }  # fmt: skip


UNITS = {"voltage": "V", "current": "A", "velocity": "rad/s"}


def diagnose(held: dict[str, np.ndarray], model: str, drive: str, sensors: tuple[str, ...], **known: float) -> Any:
    recording = lm.Recording.from_arrays(
        held["time"], inputs={drive: held[drive]}, sensors={name: held[name] for name in sensors},
        units={name: UNITS[name] for name in (drive, *sensors)},
    )  # fmt: skip
    free = {n: q for n, q in WIDE.items() if n not in known and not (model == "current_motor" and n in "RL")}
    case = lm.Case(recording, model, known=known, estimate=free)
    return lm.diagnose(case, progress=False, terms=["coulomb_friction", "quadratic_damping", "offset_force", "cogging"])


@pytest.fixture
def trusted_units(monkeypatch):
    """No column is tried with another unit: in a motor, friction alone is as large as the drive seems."""
    monkeypatch.setattr("lostmotion.diagnosis.stages.find_wrong_scales", lambda *_: ())


WAYS = [
    ("dc_motor", "voltage", ("velocity", "current"), {}),
    ("dc_motor", "voltage", ("velocity",), {"R": R, "K": K}),
    ("current_motor", "current", ("velocity",), {"K": K}),
]


@pytest.mark.usefixtures("trusted_units")
@pytest.mark.parametrize(
    ("model", "drive", "sensors", "known"),
    WAYS,
    ids=["all three", "voltage, speed", "current, speed"],
)
def test_friction_of_a_motor_is_named_with_its_size(
    model: str, drive: str, sensors: tuple[str, ...], known: dict[str, float]
) -> None:
    samples = 1000 if model == "current_motor" else 500
    found = diagnose(run_motor(FRICTION, samples=samples), model, drive, sensors, **known)
    friction = next(one for one in found.found if one.mechanism == "coulomb_friction")
    assert friction.parameters["force"].median == pytest.approx(FRICTION, rel=0.03)
    after = found.parameters_after
    assert after["J"].median == pytest.approx(J, rel=0.05)  # known values may be wrong by 1 % each
    truth = {"J": J, "c": C, "K": K, "R": R}
    for name in {"J", "c", "K", "R"} & set(after):
        # a recorded current is interpolated between samples, which its ripple at a reversal is not; the error of the
        # scale of a sensor has the shape of predictions by the nominal model
        slack = {"current_motor": 0.01, "dc_motor": 0.02}[model] * truth[name]
        assert after[name].low - slack <= truth[name] <= after[name].high + slack, name


def test_a_motor_without_friction_hides_nothing() -> None:
    found = diagnose(run_motor(0.0), "dc_motor", "voltage", ("velocity", "current"))
    assert not [one for one in found.found if one.mechanism == "coulomb_friction"]


@pytest.mark.slow
def test_the_log_of_a_driver_names_its_friction(shared_cases: Path) -> None:
    """The truth is 0.006 N m; the inductance is resolved by no sample, so `dc_motor` bounds it from above only."""
    recording = lm.Recording.read(
        str(shared_cases / "i04_dc_motor_voltage" / "run.csv"), time="Time [s]", inputs={"voltage": "Voltage [V]"},
        sensors={"velocity": "Speed [rpm]", "current": "Current [A]"},
    )  # fmt: skip
    case = lm.Case(recording, "dc_motor", estimate=WIDE)
    found = lm.diagnose(case, progress=False)
    assert [one.mechanism for one in found.found] == ["coulomb_friction"]
    assert found.found[0].parameters["force"].median == pytest.approx(0.006, rel=0.01)
    assert found.parameters_after["R"].median == pytest.approx(1.2, rel=0.01)
    assert found.parameters_after["K"].median == pytest.approx(0.05, rel=0.01)


def test_units_of_electricity() -> None:
    assert [one.unit("rotation") for one in (VOLTAGE, RESISTANCE, INDUCTANCE)] == ["V", "ohm", "H"]
