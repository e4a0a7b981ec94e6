"""Motions that users bring to `analyse`: a drifting zero, a coarse sensor; each verdict gives the reason that holds."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lostmotion as lm
from lostmotion_chaos.results import Analysis

CASES = Path(__file__).resolve().parents[2].parent / "shared" / "cases"
N = 4000
T = np.arange(N) / 100.0
TURN = 2.0 * np.pi * T / 0.77
CYCLE = np.sin(TURN) + 0.4 * np.sin(2.0 * TURN + 1.0)
NOISE = 0.005 * np.random.default_rng(1).standard_normal(N)
SLOW = T / T[-1]


def analyse(source: Path | np.ndarray) -> Analysis:
    options: dict[str, Any] = {"denoiser": "none", "draws": 19, "progress": False}
    if isinstance(source, Path):
        return lm.analyse(source, columns="x", **options).result
    made = lm.Recording.from_arrays(rate=100.0, sensors={"position": source}, units={"position": "m"})
    return lm.analyse(made, **options).result


def case(name: str) -> Path:
    if not (CASES / name).is_dir():
        pytest.skip(f"no cases of users: {CASES / name} is absent")
    return CASES / name / "run.csv"


def test_a_case_with_a_drifting_zero_is_periodic() -> None:
    found = analyse(case("c11_periodic_with_drift"))
    assert found.verdict == "periodic"
    assert "repeats each period of 0.7693 s about a zero that drifts by" in found.says


@pytest.mark.slow
def test_a_coarse_case_is_told_its_number_of_values() -> None:
    found = analyse(case("c02_lorenz_int"))
    assert found.verdict == "undecided"
    values = len(np.unique(np.loadtxt(case("c02_lorenz_int"), delimiter=",", skiprows=1)[:, 1]))
    assert f"its {values} different values are too coarse" in found.says


DRIFTS = {"line": 0.8 * SLOW, "bow": 0.6 * SLOW**2 - 0.3 * SLOW, "bend": -0.7 * SLOW**3}


@pytest.mark.parametrize("drift", DRIFTS.values(), ids=DRIFTS)
def test_a_periodic_motion_about_a_drifting_zero_is_periodic(drift: np.ndarray) -> None:
    found = analyse(CYCLE + drift + NOISE)
    assert found.verdict == "periodic"
    assert "about a zero that drifts by" in found.says


def test_a_second_frequency_is_no_drift() -> None:
    found = analyse(CYCLE + 0.5 * np.sin(TURN / np.sqrt(30.0)) + NOISE)
    assert found.verdict != "periodic"
