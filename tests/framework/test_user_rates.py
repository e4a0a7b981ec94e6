"""A sampling rate beside a table or in an attribute is taken with the words that state it, or asked about."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy.io import savemat

from lostmotion.errors import DataError
from lostmotion.preparation.beginning import write_first_case
from lostmotion.recording import Recording
from lostmotion.recording.outline import GivenRoles, outline_table
from lostmotion.registry import default
from lostmotion_chaos.analysis.source import WantedChannel, load_source

N = 300
T = np.arange(N) / 100.0
FORCE = 40.0 * np.sin(7.0 * T)
PLACE = 30.0 * np.cos(7.0 * T)
WHICH: dict[str, Any] = {"inputs": {"force": "F"}, "sensors": {"position": "x"}, "units": {"F": "N", "x": "mm"}}


def write(folder: Path, above: str, names: str = "Force [N];Pos [mm]", time: Any = None) -> Path:
    columns = [FORCE, PLACE] if time is None else [time, FORCE, PLACE]
    rows = "".join(";".join(f"{value:.4f}" for value in row) + "\n" for row in zip(*columns, strict=True))
    (folder / "run.csv").write_text(f"{above}\n{names}\n{rows}", encoding="utf-8")
    return folder / "run.csv"


STATED = [
    "# sampling rate: 100 Hz", "Fs=100", "Sample interval 0.01 s", "Sample interval;0,01;s", "Abtastrate: 100 Hz",
    "% dt = 0.01", "Sample Rate;0.1 kHz", "sample_rate_hz: 100", "Sampling rate [Hz];100", "# Ts = 10 ms", "fs: 1e2",
    "Data rate 100 S/s", "SampleTime[ms];10", "Sampling: 100 Hz", "Rate: 100 Hz, channels: 2",
    '{"rig": 3, "rate": 100}',
    "---\nrig: 3\nfs: 100\n---", "サンプリング周波数: 100Hz", "Sampling rate;100;100", "Delta: 0.01 sec.",
    "Sampling rate: 100 Hz (decimated from 1000 Hz)",
]  # fmt: skip


@pytest.mark.parametrize("above", STATED)
def test_a_rate_above_the_table_is_taken_with_its_words(tmp_path: Path, above: str) -> None:
    path = write(tmp_path, above)
    found = outline_table(path, GivenRoles())
    assert (found.time, found.dt) == (None, pytest.approx(0.01))
    assert found.clock.says.startswith("time from the rate of 100 Hz: line ")
    read = Recording.read(path, inputs={"force": "Force"}, sensors={"position": "Pos"})
    assert (read.rate, read.notes[0]) == (pytest.approx(100.0), found.clock.says)
    assert load_source(path, WantedChannel(("Pos",)), default()).dt == pytest.approx(0.01)
    draft = write_first_case(path, tmp_path / "case.toml", GivenRoles(), default())
    assert "rate = 100  # Hz" in draft.text
    assert "states" in draft.found[0]


@pytest.mark.parametrize(
    "above",
    ["Baud rate: 9600", "Max sample rate: 1000 Hz", "Feed rate: 100 mm/min", "Spring rate: 100 N/mm", "Fs: 500 N",
     "Sample rate 1,000 Hz", "dt=10", "Ts: 20 degC", "Sample 5 of 10", "dt: 2025-03-04", "Sampling rate;100;50"],
)  # fmt: skip
def test_other_lines_state_no_rate(tmp_path: Path, above: str) -> None:
    with pytest.raises(DataError, match=r"no column of run\.csv has the name or the unit of a time"):
        outline_table(write(tmp_path, above), GivenRoles())


def test_two_stated_rates_are_asked_about(tmp_path: Path) -> None:
    with pytest.raises(DataError, match=r"two sampling rates are stated: line 1 .* \(100 Hz\), and line 2 "):
        outline_table(write(tmp_path, "Fs: 100 Hz\ndt: 0.02"), GivenRoles())


def test_a_rate_that_contradicts_the_stamps_is_asked_about(tmp_path: Path) -> None:
    path = write(tmp_path, "# sampling rate: 500 Hz", "Time [s];Force [N];Pos [mm]", T)
    with pytest.raises(DataError, match=r"line 1 states 'sampling rate: 500 Hz', and the time has 100 Hz: one of them"):
        outline_table(path, GivenRoles())
    for roles, dt in ((GivenRoles(time="Time [s]"), 0.01), (GivenRoles(rate=500.0), 0.002)):
        found = outline_table(path, roles)
        assert found.dt == pytest.approx(dt)
        assert any("one of them is wrong" in note for note in found.clock.notes)


def test_a_rate_that_agrees_is_no_matter(tmp_path: Path) -> None:
    found = outline_table(write(tmp_path, "# fs: 100", "Time [s];Force [N];Pos [mm]", T), GivenRoles())
    assert (found.time, found.clock.notes) == ("Time [s]", ())


@pytest.mark.parametrize("names", ["sample;Force [N];Pos [mm]", "time;Force [N];Pos [mm]"])
def test_a_rate_beside_a_counter_is_taken(tmp_path: Path, names: str) -> None:
    found = outline_table(write(tmp_path, "Sample rate: 100 Hz", names, np.arange(N)), GivenRoles())
    assert (found.time, found.dt) == (None, pytest.approx(0.01))


def test_a_rate_hides_no_gap(tmp_path: Path) -> None:
    path = write(tmp_path, "Sample rate: 100 Hz", "Time [s];Force [N];Pos [mm]", np.where(T < 1.0, T, T + 1.0))
    outline = outline_table(path, GivenRoles())
    assert [one.keys for one in outline.stretches] == [{"t_start": 2.0}, {"t_end": 0.99}]


ATTRIBUTES = [{"fs": 100}, {"sampling_rate": "0.1 kHz"}, {"dt": 0.01}, {"sample_interval": "10 ms"}]


@pytest.mark.parametrize("told", ATTRIBUTES)
def test_attributes_of_frames_and_data_sets_state_a_rate(told: dict[str, Any]) -> None:
    frame = pd.DataFrame({"F": FORCE, "x": PLACE})
    frame.attrs.update(told)
    data = xr.Dataset({"F": ("time", FORCE), "x": ("time", PLACE)}, attrs=told)
    for read in (Recording.from_pandas(frame, **WHICH), Recording.from_xarray(data, **WHICH)):
        assert read.rate == pytest.approx(100.0)
        assert read.notes[0].startswith("time from the rate of 100 Hz: the attribute ")
    frame["t"] = 2.0 * T
    with pytest.raises(DataError, match=r"the attribute .* states it, and the time has 50 Hz"):
        Recording.from_pandas(frame, **WHICH)


def to_mat(path: Path) -> None:
    savemat(path, {"F": FORCE, "x": PLACE, "fs": 100.0})


def to_npz(path: Path) -> None:
    np.savez(path, F=FORCE, x=PLACE, dt=0.01)


def to_h5(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file["F"], file["x"] = FORCE, PLACE
        file.attrs["Sample rate"] = "100 Hz"


def to_nc(path: Path) -> None:
    data = xr.Dataset({"F": ("time", FORCE), "x": ("time", PLACE)}, attrs={"sampling_rate": 100.0})
    data.to_netcdf(path, engine="h5netcdf")


@pytest.mark.parametrize("write_file", [to_mat, to_npz, to_h5, to_nc])
def test_numbers_and_attributes_of_files_state_a_rate(tmp_path: Path, write_file: Any) -> None:
    path = tmp_path / f"run.{write_file.__name__.removeprefix('to_')}"
    write_file(path)
    read = Recording.read(path, **WHICH)
    assert read.rate == pytest.approx(100.0)
    assert read.notes[0].startswith("time from the rate of 100 Hz: the ")
