"""Inputs and sensors of a recording: lists and short forms, names, units that fit, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lostmotion.case import load_case
from lostmotion.errors import CaseError
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default

FORCE = '{ input = "force", column = "F", unit = "N" }'
MOTOR = '{ channel = "position", column = "x", unit = "mm", name = "motor encoder" }'
LOAD = '{ channel = "second_position", column = "z", unit = "mm", name = "load encoder", noise = "quantised" }'
MODEL = """
[model]
name = "clearance_chain"
known = { m1 = 1.0, c1 = 1.0, k1 = 0.0, m2 = 1.0, c2 = 0.0, k2 = 1.0, c0 = 0.1, x0 = 0.001 }
[model.estimate]
k0 = { low = 10.0, high = 1e4, scale = "log" }
"""


def written(folder: Path, channels: str, model: str = MODEL, more: str = "") -> Path:
    """Return the path of a case with a recording of 300 samples of F, x, z and a."""
    t = np.arange(300) * 0.01
    np.savez(folder / "run.npz", t=t, F=np.sin(t), x=np.cos(t), z=np.sin(2.0 * t), a=np.cos(3.0 * t))
    text = f'[[recordings]]\nfile = "run.npz"\ntime = "t"\n{channels}\n{more}{model}'
    (folder / "case.toml").write_text(text, encoding="utf-8")
    return folder / "case.toml"


def test_lists_of_inputs_and_sensors_are_read(tmp_path: Path) -> None:
    case = load_case(written(tmp_path, f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR}, {LOAD} ]"))
    (spec,) = case.recordings
    assert [(c.target, c.column, c.name) for c in spec.inputs] == [("force", "F", "")]
    told = [(c.target, c.quantity, c.name, c.noise) for c in spec.sensors]
    assert told == [("position", "position", "motor encoder", "white"),
                    ("second_position", "position", "load encoder", "quantised")]  # fmt: skip


def test_the_short_form_is_one_of_each(tmp_path: Path) -> None:
    short = 'excitation = { column = "F", quantity = "force", unit = "N" }\n' \
            'response = { column = "x", quantity = "position", unit = "mm" }'  # fmt: skip
    (spec,) = load_case(written(tmp_path, short)).recordings
    assert (spec.inputs[0].target, spec.sensors[0].target, spec.sensors[0].name) == ("force", "position", "")


@pytest.mark.parametrize("nothing", ["inputs = []", 'excitation = "none"'])
def test_a_free_decay_has_no_input(tmp_path: Path, nothing: str) -> None:
    found = prepare(written(tmp_path, f"{nothing}\nsensors = [ {MOTOR} ]"), default())
    assert found.recordings[0].inputs == ()
    assert found.observations[0].free
    assert not found.observations[0].inputs.any()
    assert not [term for term in found.terms if term.acts == "drive"]


def test_sensors_without_a_name_are_called_by_their_channel(tmp_path: Path) -> None:
    bare = '{ channel = "position", column = "x", unit = "mm" }'
    (spec,) = load_case(written(tmp_path, f"inputs = []\nsensors = [ {bare}, {bare}, {LOAD} ]")).recordings
    assert [c.name for c in spec.sensors] == ["position", "position 2", "load encoder"]


def test_terms_of_a_sensor_are_tried_at_each_by_name(tmp_path: Path) -> None:
    found = prepare(written(tmp_path, f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR}, {LOAD} ]"), default())
    places = {term.at for term in found.terms if term.name == "sensor_delay"}
    assert places == {"motor encoder", "load encoder"}
    assert {t.at for t in found.terms if t.name == "sensor_offset"} == places
    alone = prepare(written(tmp_path, f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR} ]"), default())
    assert {t.at for t in alone.terms if t.acts == "sensor"} == {"motor encoder"}
    assert not [t for t in alone.terms if t.name in ("sensor_offset", "sensor_delay")]  # a force, a late drive


def test_several_inputs_have_terms_of_the_drive_each(tmp_path: Path) -> None:
    brake = '{ input = "second_force", column = "z", unit = "N" }'
    found = prepare(written(tmp_path, f"inputs = [ {FORCE}, {brake} ]\nsensors = [ {MOTOR} ]"), default())
    assert {t.at for t in found.terms if t.name == "excitation_gain"} == {"force", "second_force"}
    inputs = found.observations[0].inputs
    assert np.ptp(inputs[:, 0]) > 0.1
    assert np.ptp(inputs[:, 1]) > 0.1
    assert not inputs[:, 2].any()


@pytest.mark.parametrize(
    ("channels", "words"),
    [
        (f"inputs = [ {FORCE} ]", ["lacks 'response'", "sensors"]),
        (f"sensors = [ {MOTOR} ]", ["lacks 'excitation'", "[] where nothing drives"]),
        (f"inputs = [ {FORCE} ]\nsensors = []", ["sensors = []", "at least one"]),
        (f'inputs = [ {FORCE} ]\nexcitation = "none"\nsensors = [ {MOTOR} ]', ["both excitation and inputs"]),
        (f"inputs = [ {FORCE}, {FORCE} ]\nsensors = [ {MOTOR} ]", ["input 'force' twice"]),
        (f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR}, {MOTOR} ]", ["two sensors named 'motor encoder'"]),
        (f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR.replace('motor encoder', 'a:b')} ]", ["name 'a:b'", "':'"]),
        (f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR.replace('channel', 'chanel')} ]", ["did you mean 'channel'"]),
        (f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR.replace('position', 'positon')} ]", ["did you mean 'position'"]),
        (f"inputs = [ {FORCE.replace('N', 'mm')} ]\nsensors = [ {MOTOR} ]", ["inputs[0]", "wrong unit"]),
        (f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR.replace('mm', 'N')} ]", ["sensors[0]", "wrong unit"]),
    ],
)  # fmt: skip
def test_what_cannot_be_meant_is_refused(tmp_path: Path, channels: str, words: list[str]) -> None:
    with pytest.raises(CaseError) as caught:
        load_case(written(tmp_path, channels))
    assert [word for word in words if word not in str(caught.value)] == []


@pytest.mark.parametrize(
    ("channels", "model", "words"),
    [
        (f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR.replace('position', 'third_position')} ]", MODEL,
         ["third_position", "did you mean"]),
        (f"inputs = [ {FORCE.replace('force', 'third_force')} ]\nsensors = [ {MOTOR} ]", MODEL,
         ["third_force", "did you mean"]),
        (f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR.replace('mm', 'deg')} ]", MODEL,
         ["mix", "in rad", "in N", "torque"]),
        (f"inputs = [ {FORCE} ]\nsensors = [ {MOTOR} ]", MODEL.replace('"clearance_chain"',
         '"clearance_chain"\nmotion = "rotation"'), ["motion = 'rotation'", "translation"]),
        (f"inputs = []\nsensors = [ {MOTOR} ]", '[model]\nname = "robot_joint"\n', ["robot_joint", "rotation"]),
    ],
)  # fmt: skip
def test_what_a_model_has_not_is_refused(tmp_path: Path, channels: str, model: str, words: list[str]) -> None:
    with pytest.raises(CaseError) as caught:
        prepare(written(tmp_path, channels, model), default())
    assert [word for word in words if word not in str(caught.value)] == []


def test_a_model_turns_where_units_say_so(tmp_path: Path) -> None:
    torque, angle = FORCE.replace("force", "torque").replace("N", "Nm"), MOTOR.replace("mm", "deg")
    turned = f"inputs = [ {torque} ]\nsensors = [ {angle} ]"
    found = prepare(written(tmp_path, turned), default())
    assert found.model.motion == "rotation"
    assert found.recordings[0].inputs[0].attrs["units"] == "N m"
    assert found.observations[0].response[0] == pytest.approx(np.pi / 180.0)


def test_a_load_cell_beside_an_encoder(tmp_path: Path) -> None:
    sensors = ('[ { channel = "force", column = "F", unit = "N", name = "load cell" },'
               ' { channel = "position", column = "x", unit = "mm", name = "encoder" } ]')  # fmt: skip
    moved = '[ { input = "base_position", column = "z", unit = "mm" } ]'
    model = '\n[model]\nname = "backlash_slider"\nknown = { m = 1.0, c = 1.0, k0 = 100.0, x0 = 0.001 }\n'
    found = prepare(written(tmp_path, f"inputs = {moved}\nsensors = {sensors}", model), default())
    seen = found.observations[0]
    assert [s.channel for s in seen.sensors] == ["force", "position"]
    assert seen.readings.shape == (300, 2)
    assert seen.slope == 1
