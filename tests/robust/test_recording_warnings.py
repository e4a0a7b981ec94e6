"""What looks wrong is said, once and in words that tell what to do; a good recording gets no note at all."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lostmotion.recording import Channel, Recording, RecordingSpec, load_recording
from lostmotion.settings import DEFAULT
from lostmotion.signals import impacts

DT = 0.002
TIME = DT * np.arange(10_000)
SPEC = RecordingSpec("a.npz", "time", None, (Channel("F", "force", "N"),), (Channel("x", "position", "m"),))
ANGLES = replace(SPEC, inputs=(Channel("F", "base_position", "rad"),), sensors=(Channel("x", "position", "rad"),))


def machine(seed: int = 0) -> dict[str, np.ndarray]:
    """A damped oscillator (1 kg, 4 N s/m, 900 N/m) under noise of low frequency, by small symplectic steps."""
    rng = np.random.default_rng(seed)
    force = np.convolve(rng.normal(size=TIME.size + 59), np.hanning(60), "valid")
    x, v, seen = 0.0, 0.0, np.empty(TIME.size)
    for k, push in enumerate(force):
        seen[k] = x
        v += DT * (push - 4.0 * v - 900.0 * x)
        x += DT * v
    return {"time": TIME, "F": force, "x": seen + 0.01 * seen.std() * rng.normal(size=TIME.size)}


def notes(folder: Path, columns: dict[str, np.ndarray], spec: RecordingSpec = SPEC) -> tuple[str, ...]:
    np.savez(folder / "a.npz", **columns)
    return load_recording(spec, folder).notes


def test_a_good_recording_gets_no_note(tmp_path: Path) -> None:
    assert notes(tmp_path, machine()) == ()
    assert notes(tmp_path, machine(1)) == ()


@pytest.mark.parametrize("quantity", ["position", "velocity", "acceleration"])
def test_a_wrong_sign_is_noted_and_a_right_one_is_not(tmp_path: Path, quantity: str) -> None:
    columns = machine()
    order = ("position", "velocity", "acceleration").index(quantity)
    for _ in range(order):
        columns["x"] = np.gradient(columns["x"], DT)
    unit = ("m", "m/s", "m/s^2")[order]
    spec = replace(SPEC, sensors=(Channel("x", quantity, unit),))
    assert notes(tmp_path, columns, spec) == ()
    (note,) = notes(tmp_path, {**columns, "x": -columns["x"]}, spec)
    assert "one of the signs is wrong (factor = -1.0)" in note


def test_swapped_columns_are_noted(tmp_path: Path) -> None:
    columns = machine()
    (note,) = notes(tmp_path, {**columns, "F": columns["x"], "x": columns["F"]})
    assert "'F' and 'x' are swapped" in note


def test_thresholds_of_warnings_can_be_changed(tmp_path: Path) -> None:
    columns = machine()
    notes(tmp_path, {**columns, "x": -columns["x"]})
    limits = DEFAULT.changed({"recording.returned_errors": 1e3}).recording
    assert load_recording(SPEC, tmp_path, limits).notes == ()
    settings = {"recording.returned_errors": 1e3}
    how = {"inputs": {"force": "F"}, "sensors": {"position": "x"}, "units": {"F": "N", "x": "m"}, "time": "time"}
    assert Recording.read(tmp_path / "a.npz", **how).notes
    assert Recording.read(tmp_path / "a.npz", **how, settings=settings).notes == ()


def test_the_default_without_settings_is_that_of_the_settings() -> None:
    assert DEFAULT.recording.stuck == impacts.STUCK


def test_power_of_a_measured_force_under_a_moved_base(tmp_path: Path) -> None:
    """A damper: the force follows the speed of its base."""
    base = np.convolve(np.random.default_rng(2).normal(size=TIME.size + 199), np.hanning(200), "valid")
    columns = {"time": TIME, "F": base, "x": 30.0 * np.gradient(base, DT)}
    spec = replace(SPEC, inputs=(Channel("F", "base_position", "m"),), sensors=(Channel("x", "force", "N"),))
    assert notes(tmp_path, columns, spec) == ()
    (note,) = notes(tmp_path, {**columns, "x": -columns["x"]}, spec)
    assert "signs" in note


def test_degrees_given_as_radians_are_noted(tmp_path: Path) -> None:
    swing = 0.15 * np.sin(9.0 * TIME)
    columns = {"time": TIME, "F": 0.1 * np.sin(9.0 * TIME + 0.3), "x": swing}
    assert notes(tmp_path, columns, ANGLES) == ()
    (note,) = notes(tmp_path, {**columns, "x": np.degrees(swing)}, ANGLES)
    assert "more than half a turn" in note
    assert "unit = 'deg'" in note
    mixed = replace(ANGLES, inputs=(Channel("F", "base_position", "deg"),))
    (note,) = notes(tmp_path, columns, mixed)
    assert "are both in one unit" in note
    assert notes(tmp_path, {**columns, "F": np.degrees(columns["F"])}, mixed) == ()


def test_a_shaft_that_turns_is_not_taken_for_degrees(tmp_path: Path) -> None:
    turning = 2.0 * TIME + 0.1 * np.sin(9.0 * TIME)
    assert notes(tmp_path, {"time": TIME, "F": 2.0 * TIME + 0.1 * np.cos(9.0 * TIME), "x": turning}, ANGLES) == ()


def test_a_stuck_sensor_is_noted_and_one_that_rests_between_its_steps_is_not(tmp_path: Path) -> None:
    columns = machine()
    stuck = columns["x"].copy()
    stuck[1000:1200] = stuck[1000]
    (note,) = notes(tmp_path, {**columns, "x": stuck})
    assert "200 samples from 2 s" in note
    assert "stuck" in note
    step = 0.2 * columns["x"].std()
    assert not [n for n in notes(tmp_path, {**columns, "x": np.round(stuck / step) * step}) if "from 2 s" in n]


def test_the_mark_of_a_lost_sample_is_noted(tmp_path: Path) -> None:
    columns = machine()
    columns["x"][[5, 77, 300]] = -9999.0
    assert any("-9999 at 3 samples" in note for note in notes(tmp_path, columns))


def test_islands_of_nan_are_counted(tmp_path: Path) -> None:
    columns = machine()
    columns["x"][100:140] = np.nan
    columns["x"][500:520] = np.nan
    (note,) = notes(tmp_path, columns)
    assert "60 of 10000" in note
    assert "at most 40 in a row" in note


@pytest.mark.real
def test_no_real_recording_is_doubted(shared: Path) -> None:
    folder = shared / "data"
    emps = replace(SPEC, file="DATA_EMPS.mat", time="t", inputs=(Channel("vir", "force", "N", 35.15065),),
                   sensors=(Channel("qm", "position", "m"),))  # fmt: skip
    box = RecordingSpec("SNLS80mV.npz", None, 610.35, (Channel("V1", "force", "N"),), (Channel("V2", "position", "m"),))
    assert load_recording(emps, folder / "emps").notes == ()
    assert load_recording(box, folder / "silverbox").notes == ()
    dampers = sorted((folder / "brfd_friction_backlash").glob("*.npz"))
    assert len(dampers) > 20
    for file in dampers:
        moved, felt = Channel("data[1]", "base_position", "inch"), Channel("data[2]", "force", "kip")
        damper = RecordingSpec(file.name, "data[0]", None, (moved,), (felt,))
        assert load_recording(damper, file.parent).notes == (), file.name
