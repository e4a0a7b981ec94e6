"""What a recording becomes once it is read: values, units, notes; and real files where they are present."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.provenance import digest, provenance
from lostmotion.quantities import si_factor
from lostmotion.recording import Channel, RecordingSpec, load_recording, read_columns

N = 400
TIME = np.arange(N) / 1000
FORCE = -np.sin(40 * TIME)
POSITION = np.cos(40 * TIME)
SPEC = RecordingSpec("a.npz", "time", None, (Channel("u", "force", "N"),), (Channel("x", "position", "mm"),))


def write(folder: Path, **changes: np.ndarray) -> Path:
    np.savez(folder / "a.npz", **({"time": TIME, "u": FORCE, "x": POSITION} | changes))
    return folder


def spoilt(column: np.ndarray, where: int | slice, value: float) -> np.ndarray:
    column = column.copy()
    column[where] = value
    return column


def test_values_become_si_and_say_what_they_are(tmp_path: Path) -> None:
    got = load_recording(SPEC, write(tmp_path))
    np.testing.assert_allclose(got.data.response, POSITION / 1000)
    assert got.data.response.attrs["units"] == "m"
    told = {"units": "N", "quantity": "force", "long_name": "force (column 'u')"}
    assert {name: got.data.excitation.attrs[name] for name in told} == told
    assert (got.name, got.source, got.n, got.hold, got.notes) == ("a", "a.npz", N, "smooth", ())
    assert got.rate == pytest.approx(1000)
    assert got.digest == digest(tmp_path / "a.npz")
    assert got.data.response.dtype == np.float64


def test_factor_comes_before_the_unit(tmp_path: Path) -> None:
    spec = replace(SPEC, inputs=(Channel("u", "force", "kN", 2.0),))
    np.testing.assert_allclose(load_recording(spec, write(tmp_path)).data.excitation, FORCE * 2000)


def test_a_rate_stands_in_for_a_time_column(tmp_path: Path) -> None:
    got = load_recording(replace(SPEC, time=None, rate=500.0), write(tmp_path))
    assert got.dt == 0.002
    assert float(got.data.time[-1]) == pytest.approx((N - 1) / 500)


@pytest.mark.parametrize("how", [{"time": "time"}, {"time": None, "rate": 1000.0}])
def test_a_cut_keeps_both_ends(tmp_path: Path, how: dict[str, object]) -> None:
    got = load_recording(replace(SPEC, t_start=0.1, t_end=0.3, **how), write(tmp_path))
    assert got.n == 201
    assert float(got.data.time[0]) == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("changes", "spec", "words"),
    [
        (
            {"u": spoilt(FORCE, slice(7, 11), np.nan)},
            SPEC,
            ["excitation 'u'", "NaN", "sample 7", "4 in a row", "t_start"],
        ),
        ({"u": spoilt(FORCE, slice(0, 400, 100), np.nan)}, SPEC, ["excitation 'u'", "4 of 400", "1 %"]),
        ({"x": spoilt(POSITION, slice(0, 310), np.nan)}, SPEC, ["response 'x'", "90 readings in 400", "100"]),
        ({"x": spoilt(POSITION, slice(None), np.nan)}, SPEC, ["no reading at all"]),
        ({"x": spoilt(POSITION, 9, -np.inf)}, SPEC, ["infinite", "sample 9"]),
        ({"x": np.ones(N)}, SPEC, ["constant", "(1)", "sensor"]),
        ({"u": np.zeros(N)}, SPEC, ["excitation", "constant (0)"]),
        ({"x": POSITION[:-1]}, SPEC, ["differ in length", "'x' 399"]),
        ({}, replace(SPEC, t_end=0.05), ["51 samples", "100", "record longer"]),
        ({}, replace(SPEC, t_start=9.0), ["no samples", "0.399"]),
        ({"time": TIME[:9], "x": POSITION[:9], "u": FORCE[:9]}, SPEC, ["9 samples"]),
        ({"time": TIME[:0], "x": POSITION[:0], "u": FORCE[:0]}, SPEC, ["0 samples"]),
        (
            {},
            replace(SPEC, sensors=(Channel("position", "position", "m"),)),
            ["no column of numbers named 'position'", "time, u, x"],
        ),
        ({}, replace(SPEC, time="tine"), ["'tine'", "did you mean 'time'"]),
        ({}, replace(SPEC, time=None), ["neither time nor a positive rate"]),
        ({}, replace(SPEC, file="b.npz"), ["b.npz does not exist", "did you mean 'a.npz'"]),
    ],
)
def test_refusals_are_sentences(tmp_path: Path, changes: dict, spec: RecordingSpec, words: list[str]) -> None:
    with pytest.raises(DataError) as caught:
        load_recording(spec, write(tmp_path, **changes))
    message = str(caught.value)
    assert [w for w in words if w not in message] == [], message
    assert spec.file in message
    assert str(tmp_path) not in message


def test_a_few_lost_samples_of_the_response_are_kept_and_noted(tmp_path: Path) -> None:
    got = load_recording(SPEC, write(tmp_path, x=spoilt(POSITION, [5, 6, 50], np.nan)))
    assert int(np.isnan(got.data.response).sum()) == 3
    assert "3 of 400" in got.notes[0]
    assert "at most 2 in a row" in got.notes[0]


def test_a_clipped_sensor_is_noted(tmp_path: Path) -> None:
    (note,) = load_recording(SPEC, write(tmp_path, x=np.minimum(POSITION, 0.9))).notes
    assert "largest value 0.9" in note
    assert "clipped" in note


def test_degrees_called_radians_are_noted(tmp_path: Path) -> None:
    spec = replace(SPEC, sensors=(Channel("x", "position", "rad"),))
    (note,) = load_recording(spec, write(tmp_path, x=90 * POSITION)).notes
    assert "unit = 'deg'" in note


def test_blocks_of_one_array_are_columns(tmp_path: Path) -> None:
    write(tmp_path, x=np.vstack([POSITION, 2 * POSITION]))
    got = load_recording(replace(SPEC, sensors=(Channel("x[1]", "position", "m"),)), tmp_path)
    np.testing.assert_allclose(got.data.response, 2 * POSITION)


@pytest.mark.parametrize(("unit", "factor"), [("g", 9.80665), ("mg", 9.80665e-3), ("g_0", 9.80665)])
def test_accelerations_are_written_in_g(unit: str, factor: float) -> None:
    assert si_factor(unit, "acceleration") == (pytest.approx(factor), "m/s^2")
    assert si_factor(unit, "base_acceleration") == (pytest.approx(factor), "m/s^2")


@pytest.mark.parametrize("unit", ["N m)", "V", "", "nan m", "kg", "furlongz"])
def test_wrong_units_are_sentences(unit: str) -> None:
    with pytest.raises(DataError, match="unit"):
        si_factor(unit, "acceleration")


def test_revolutions_a_minute_are_a_velocity() -> None:
    assert si_factor("rpm", "velocity") == (pytest.approx(2 * np.pi / 60), "rad/s")


def test_provenance_is_the_same_twice_and_fit_for_json(tmp_path: Path) -> None:
    first = provenance("model lin_backlash", {"b": np.float64(2), "a": Path("/home/me/x.csv")}, 7, {"x.csv": "ab"})
    again = provenance("model lin_backlash", {"a": Path("/tmp/x.csv"), "b": 2.0}, 7, {"x.csv": "ab"})  # noqa: S108
    assert json.dumps(first) == json.dumps(again)
    assert set(first["versions"]) == {"python", "lostmotion", "numpy", "numba"}
    with pytest.raises(TypeError, match="object"):
        provenance("x", {"a": object()}, None, {})
    with pytest.raises(DataError, match=r"gone\.csv"):
        digest(tmp_path / "gone.csv")


def test_heavy_readers_are_not_loaded_with_the_module() -> None:
    code = (
        "import sys, lostmotion.case; print(*{'xarray', 'scipy', 'h5py', 'pyuff', 'pint', 'pandas'} & {*sys.modules})"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


@pytest.mark.real
def test_emps(shared: Path) -> None:
    pair = (Channel("vir", "force", "N", 35.15065),), (Channel("qm", "position", "m"),)
    got = load_recording(RecordingSpec("DATA_EMPS.mat", "t", None, *pair, "step"), shared / "data/emps")
    assert (got.n, got.hold) == (24841, "step")
    assert got.dt == pytest.approx(1e-3, rel=1e-6)
    assert not [note for note in got.notes if "time" in note]


@pytest.mark.real
def test_every_real_archive_is_read(shared: Path) -> None:
    files = sorted(shared.glob("data/*/*.npz"))
    assert files
    for file in files:
        assert min(column.size for column in read_columns(file).values()) > 3000
    assert read_columns(shared / "data/bistablex_chaos/chaos_symmetric_40x8192.npz")["tip_velocity[39]"].size == 8192


@pytest.mark.real
def test_friction_damper(shared: Path) -> None:
    pair = (Channel("data[2]", "force", "N", 4448.22),), (Channel("data[1]", "position", "inch"),)
    got = load_recording(
        RecordingSpec("d2_1Hz_30lb_1in.npz", "data[0]", None, *pair),
        shared / "data/brfd_friction_backlash",
    )
    assert got.rate == pytest.approx(1024, rel=1e-6)
    assert 0.02 < float(got.data.response.max()) < 0.03


@pytest.mark.real
def test_silverbox_by_rate(shared: Path) -> None:
    pair = (Channel("V1", "force", "N"),), (Channel("V2", "position", "m"),)
    assert load_recording(RecordingSpec("SNLS80mV.npz", None, 610.35, *pair), shared / "data/silverbox").n == 131072
