"""Friction that changes during a recording, over a time, over two times and over the way: named, with its size.

The machines are integrated with 40 steps to a sample by the method of Euler, with friction that truly sticks.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import lostmotion as lm
from lostmotion.contracts import Array

M, C, K, DT, INNER = 2.0, 5.0, 800.0, 0.01, 40
FREE = {"c": lm.LogUniform(0.5, 50.0), "k": lm.LogUniform(80.0, 8000.0)}
DRIFTS = ("friction_drift", "friction_drift_travel", "friction_drift_twice")
Level = Callable[[float, float], float]


def run_machine(level: Level, *, samples: int = 1500, busy: float = 1.0) -> dict[str, Array]:
    """Return time, force, position (noise: 20 um) and way; the force is large in a share `busy` of each 5 s."""
    rng, h = np.random.default_rng(4), DT / INNER
    x = v = way = 0.0
    rows = []
    for n in range(samples * INNER):
        t = n * h
        on = 1.5 if (t % 5.0) < 5.0 * busy else 0.6
        u = on * (6.0 * np.sin(9.0 * t) + 6.0 * np.sin(23.0 * t + 1.0))
        if n % INNER == 0:
            rows.append((t, u, x, way))
        free = v + h / M * (u - C * v - K * x)
        v = float(np.sign(free)) * max(abs(free) - h / M * level(t, way), 0.0)
        x, way = x + h * v, way + h * abs(v)
    t, u, x, way = np.array(rows).T
    return {"time": t, "force": u, "position": x + 2e-5 * rng.standard_normal(samples), "way": way}


def diagnose(held: dict[str, Array], *, also: tuple[str, ...] = ()) -> Any:
    units = {"force": "N", "position": "m"}
    recording = lm.Recording.from_arrays(
        held["time"], inputs={"force": held["force"]}, sensors={"position": held["position"]}, units=units
    )
    case = lm.Case(recording, "linear_oscillator", known={"m": M}, estimate=FREE)
    return lm.diagnose(case, progress=False, terms=["coulomb_friction", "viscous_damping", "offset_force", *also])


@pytest.mark.slow
def test_friction_that_falls_over_a_time_and_its_picture(tmp_path: Path) -> None:
    found = diagnose(run_machine(lambda t, way: 3.2 - 2.2 * (1.0 - np.exp(-t / 5.0))), also=DRIFTS)
    drift = found.found[0]
    assert drift.mechanism == "friction_drift"
    assert drift.parameters["force"].median == pytest.approx(3.2, rel=0.03)
    assert drift.parameters["change"].median == pytest.approx(-2.2, rel=0.05)
    found.save(str(tmp_path))
    with xr.open_dataset(tmp_path / "arrays.nc") as data:
        time = data["level_time"].values
        truth = 3.2 - 2.2 * (1.0 - np.exp(-time / 5.0))
        np.testing.assert_allclose(data["friction_level"].values, truth, atol=0.1)
        assert (data["friction_level_low"].values <= data["friction_level"].values).all()
    assert "Friction over the time" in (tmp_path / "report.html").read_text(encoding="utf-8")


@pytest.mark.slow
def test_friction_that_falls_over_the_way() -> None:
    held = run_machine(lambda t, way: 3.0 - 2.0 * (1.0 - np.exp(-way / 1.5)), busy=0.5, samples=3000)
    found = diagnose(held, also=DRIFTS)
    drift = found.found[0]
    assert drift.mechanism == "friction_drift_travel"
    assert drift.parameters["force"].median == pytest.approx(3.0, rel=0.05)
    assert drift.parameters["distance"].median == pytest.approx(1.5, rel=0.15)


@pytest.mark.slow
def test_friction_that_falls_over_two_times() -> None:
    def level(t: float, way: float) -> float:
        return 4.0 - 1.5 * (1.0 - np.exp(-t / 0.8)) - 1.5 * (1.0 - np.exp(-t / 9.0))

    drift = diagnose(run_machine(level, samples=3000), also=DRIFTS).found[0]
    assert drift.mechanism == "friction_drift_twice"
    assert drift.parameters["time"].median == pytest.approx(0.8, rel=0.2)
    assert drift.parameters["slower"].median == pytest.approx(9.0, rel=0.2)
    assert drift.parameters["force"].median == pytest.approx(4.0, rel=0.05)


@pytest.mark.slow
def test_constant_friction_does_not_drift() -> None:
    found = diagnose(run_machine(lambda t, way: 2.0), also=DRIFTS)
    assert [one.mechanism for one in found.found] == ["coulomb_friction"]


@pytest.mark.slow
def test_the_machine_that_warms_up(shared_cases: Path) -> None:
    """The friction falls from 3.2 to 1 N within the 15 s of the recording."""
    case = lm.Case.read(str(shared_cases / "i09_friction_warms_up" / "case.toml"))
    drift = lm.diagnose(case, progress=False).found[0]
    assert drift.mechanism in DRIFTS
    assert drift.parameters["force"].median == pytest.approx(3.2, rel=0.02)
