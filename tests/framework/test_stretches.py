"""Gaps in the time of a recording: a first case has a recording for each stretch between them that can be used."""

from pathlib import Path

import numpy as np
import pytest

from lostmotion.case import load_case
from lostmotion.errors import DataError
from lostmotion.preparation.beginning import write_first_case
from lostmotion.recording.load import load_recording
from lostmotion.recording.outline import GivenRoles, outline_table
from lostmotion.registry import default

ROWS = 1500
T = np.arange(ROWS) / 100.0
FORCE = 40.0 * np.sin(7.0 * T) + 20.0 * np.cos(19.0 * T)
PLACE = 30.0 * np.cos(7.0 * T) - 4.0 * np.sin(19.0 * T)
LOST = [*range(300, 350), 900, *range(1420, 1440)]


def write(folder: Path, time: np.ndarray, unit: str = "s", force: np.ndarray = FORCE) -> Path:
    rows = np.delete(np.stack([time, force, PLACE], axis=1), LOST, axis=0)
    path = folder / "run.csv"
    np.savetxt(path, rows, "%.14g", ",", header=f"Time [{unit}],Force [N],Pos [mm]", comments="")
    return path


def read_case(path: Path) -> list:
    draft = write_first_case(path, path.with_suffix(".toml"), GivenRoles(), default())
    assert any("3 gaps in the time, up to 0.51 s: cut into 3 recordings" in line for line in draft.found)
    return [load_recording(spec, path.parent) for spec in load_case(path.with_suffix(".toml")).recordings]


@pytest.mark.parametrize(("unit", "factor", "start"), [("s", 1.0, 0.0), ("ms", 1e3, 0.0), ("ms", 1e3, 1.7e9)])
def test_each_stretch_is_a_recording_with_its_own_rows_the_longest_first(tmp_path, unit, factor, start):
    recordings = read_case(write(tmp_path, factor * (T + start), unit))
    rows = [(350, 900), (901, 1420), (0, 300)]  # the last 60 samples are too few
    assert [one.name for one in recordings] == ["run", "run 2", "run 3"]
    assert [one.n for one in recordings] == [last - first for first, last in rows]
    for one, (first, last) in zip(recordings, rows, strict=True):
        np.testing.assert_allclose(one.sensors[0].values, 1e-3 * PLACE[first:last], rtol=1e-9, atol=1e-12)


def test_a_stretch_in_which_nothing_moves_is_left_out(tmp_path):
    force = np.where(T < 3.5, 0.0, FORCE)
    outline = outline_table(write(tmp_path, T, force=force), GivenRoles())
    assert [one.keys for one in outline.stretches] == [
        {"t_start": 3.5, "t_end": 8.99},
        {"t_start": 9.01, "t_end": 14.19},
    ]
    assert "380 rows of other stretches are not used" not in outline.cut
    assert "360 rows of other stretches are not used" in outline.cut


def test_gaps_that_leave_too_little_and_repeated_stamps_are_refused(tmp_path):
    path = tmp_path / "run.csv"
    rows = np.stack([T + np.floor(np.arange(ROWS) / 99.0), FORCE, PLACE], axis=1)
    np.savetxt(path, rows, "%.14g", ",", header="Time [s],Force [N],Pos [mm]", comments="")
    with pytest.raises(DataError, match="a gap of 1"):
        outline_table(path, GivenRoles())
    time = T.copy()
    time[700] = time[699]
    path = write(tmp_path, time)
    with pytest.raises(DataError, match="a gap of"):
        outline_table(path, GivenRoles())
