"""Where nothing moves, nothing is decided: sensors of noise, and recordings that end at rest."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.diagnosis.moving import check_motion, cut_rest, note_rest
from lostmotion.errors import DataError
from lostmotion.likelihood.observation import Observation
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT

N, DT = 2000, 0.01
T = DT * np.arange(N)
DRIVE = np.sin(5.0 * T) + np.sin(11.0 * T)


def observe(readings: np.ndarray, drive: np.ndarray = DRIVE) -> Observation:
    return Observation.of("run", readings, drive[:, None], DT, "position", driven=("force",))


def test_a_sensor_of_noise_ends_the_diagnosis() -> None:
    noise = 1e-5 * np.random.default_rng(0).standard_normal(N)
    with pytest.raises(DataError, match=r"'position' shows no motion above its noise \(1e-05 m rms\)"):
        check_motion([observe(noise)], "translation")
    with pytest.raises(DataError, match="rad rms"):
        check_motion([observe(np.round(noise, 5)), observe(noise[::-1])], "rotation")


@pytest.mark.parametrize("size", [0.2, 1.0, 10.0])
def test_a_motion_within_the_noise_is_a_motion(size: float) -> None:
    noise = np.random.default_rng(1).standard_normal(N)
    check_motion([observe(size * np.cos(5.0 * T) + noise)], "translation")


def test_a_white_response_to_a_white_drive_is_a_motion() -> None:
    rng = np.random.default_rng(2)
    drive = rng.standard_normal(N)
    check_motion([observe(0.3 * drive + rng.standard_normal(N), drive)], "translation")


def test_one_recording_with_motion_is_enough() -> None:
    noise = np.random.default_rng(3).standard_normal(N)
    check_motion([observe(noise), observe(noise + np.cos(5.0 * T))], "translation")


def test_noise_passes_for_motion_rarely() -> None:
    """200 sensors of white noise: 0.4 are expected to pass; five or more have a probability below 1e-4."""
    rng = np.random.default_rng(4)
    passed = 0
    for _ in range(200):
        try:
            check_motion([observe(rng.standard_normal(N))], "translation")
            passed += 1
        except DataError:
            pass
    assert passed < 5


def test_the_end_of_a_recording_at_rest_is_left_out() -> None:
    noise = 1e-4 * np.random.default_rng(5).standard_normal(N)
    whole = observe(np.where(T < 12.0, (1.0 - T / 12.0) * np.cos(9.0 * T), 0.0) + noise)
    (cut,) = cut_rest([whole], DEFAULT.heldout)
    assert cut.samples * DT == pytest.approx(12.0, abs=0.5)
    assert note_rest([whole], [cut]) == [f"run is at rest from {cut.samples * DT:.3g} s on: this part is not used."]
    moving = observe(np.cos(9.0 * T) + noise)
    assert cut_rest([moving], DEFAULT.heldout)[0].samples == N
    assert note_rest([moving], [moving]) == []
    assert cut_rest([whole, whole], DEFAULT.heldout) == (whole, whole)


@pytest.mark.slow
def test_a_pendulum_that_comes_to_rest_has_its_friction(shared_cases: Path, tmp_path: Path) -> None:
    found = run_diagnosis(
        shared_cases / "i01b_pendulum_short" / "case.toml", tmp_path, Registry.discover(), propose=False
    )
    friction = found.found[0]
    assert (friction.mechanism, friction.state) == ("coulomb_friction", "named")
    assert friction.parameters["force"].median == pytest.approx(0.012, rel=0.02)
    assert any("is at rest from" in note for note in found.notes)
