"""Times as loggers, spreadsheets, ROS and pandas write them: the right rate, or one question."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.preparation.beginning import write_first_case
from lostmotion.recording import Recording
from lostmotion.recording.outline import GivenRoles, outline_table
from lostmotion.registry import default

N = 300
BEGUN = datetime(2025, 3, 4, 9, 58, 58)
Cells = Callable[[int, datetime], str]


def write(folder: Path, head: str, cells: Cells) -> Path:
    """Write a table whose first cells are those of the time, 100 rows a second, over the end of a minute."""
    rows = [
        f"{cells(k, BEGUN + timedelta(milliseconds=10 * k))},{4 * np.sin(0.07 * k):.4f},{np.cos(0.07 * k):.4f}"
        for k in range(N)
    ]
    (folder / "run.csv").write_text(f"{head},Force [N],Pos [mm]\n" + "\n".join(rows) + "\n")
    return folder / "run.csv"


def milli(stamp: datetime, form: str) -> str:
    return stamp.strftime(form) + f"{stamp.microsecond // 1000:03d}"


@pytest.mark.parametrize(
    ("head", "cells", "column"),
    [
        ("", lambda k, s: f"{k / 100:.2f}", "column 1"),  # the index of pandas
        ("", lambda k, s: str(s), "column 1"),
        ("", lambda k, s: f"0 days 00:00:{k / 100:09.6f}", "column 1"),
        ("#,Elapsed", lambda k, s: f"{k},{k // 6000:02d}:{k / 100 % 60:06.3f}", "Elapsed"),
        ("Date", lambda k, s: f"{45720.4158 + k / 8.64e6:.10f}", "Date"),  # Excel
        ("Time", lambda k, s: f"{739680.4158 + k / 8.64e6:.10f}", "Time"),  # MATLAB
        ("Time [d]", lambda k, s: f"{k / 8.64e6:.10f}", "Time [d]"),
        ("TimeUS", lambda k, s: f"{10_000 * k}", "TimeUS"),
        ("millis", lambda k, s: f"{10 * k}", "millis"),
        ("ms", lambda k, s: f"{10 * k}", "ms"),
        ("Zeit in ms", lambda k, s: f"{10 * k}", "Zeit in ms"),
        ("TIME_MS", lambda k, s: f"{10 * k}", "TIME_MS"),
        ("time", lambda k, s: milli(s, "%Y%m%dT%H%M%S."), "time"),
        ("time", lambda k, s: milli(s, "%Y%m%d%H%M%S"), "time"),
        ("time", lambda k, s: milli(s, "%Y%m%d%H%M%S."), "time"),
        ("Time", lambda k, s: milli(s, "Tuesday 04 Mar 2025 %H:%M:%S."), "Time"),
        ("FileTime", lambda k, s: f"{133855559300000000 + 100_000 * k}", "FileTime"),  # Windows
        ("Time", lambda k, s: f"{638766791300000000 + 100_000 * k}", "Time"),  # .NET
        ("epoch", lambda k, s: f"{1741082330000000 + 10_000 * k}", "epoch"),  # us since 1970, by their size alone
        ("Time,Millis", lambda k, s: f"{s:%H:%M:%S},{s.microsecond // 1000}", "Time"),
        ("Time,usec", lambda k, s: f"{s:%H:%M:%S},{s.microsecond}", "Time"),
        ("stamp.secs,stamp.nsecs", lambda k, s: f"{1741082330 + k // 100},{k % 100 * 10**7}",
         "stamp.secs and stamp.nsecs"),
        ("Hour,Minute,Second", lambda k, s: f"{s.hour},{s.minute},{s.second + s.microsecond / 1e6:.2f}",
         "Hour, Minute and Second"),
    ],
)  # fmt: skip
def test_a_time_is_found(tmp_path: Path, head: str, cells: Cells, column: str) -> None:
    path = write(tmp_path, head, cells)
    found = outline_table(path, GivenRoles())
    assert (found.time, found.dt) == (column, pytest.approx(0.01, rel=1e-4))
    read = Recording.read(path, inputs={"force": "Force"}, sensors={"position": "Pos"})
    assert (read.rate, read.notes[0]) == (pytest.approx(100.0, rel=1e-4), found.clock.says)
    case = write_first_case(path, tmp_path / "case.toml", GivenRoles(), default())  # which reads the table again
    assert f"{N} rows at 100" in case.found[0] or f"{N} rows at 99.99" in case.found[0]


@pytest.mark.parametrize(
    ("head", "cells", "says"),
    [
        ("t", lambda k, s: f"{4 * k}", r"'t' holds whole numbers \(0, 4, 8, ...\) and no unit"),
        ("time", lambda k, s: f"{1000 * k}", "may be in ms or count rows"),
        ("Time", lambda k, s: s.strftime("%H:%M"), "column 'Time': '09:58' is neither a number nor a known time"),
        ("Angle", lambda k, s: f"{0.5 * k:.2f}", "no column of run.csv has the name or the unit of a time"),
        ("Temp", lambda k, s: f"{20 + 0.01 * k:.2f}", "no column of run.csv has the name or the unit of a time"),
        ("", lambda k, s: f"{k}", "'column 1' counts rows, and not seconds"),
    ],
)  # fmt: skip
def test_a_time_is_asked_about(tmp_path: Path, head: str, cells: Cells, says: str) -> None:
    path = write(tmp_path, head, cells)
    with pytest.raises(DataError, match=says):
        outline_table(path, GivenRoles())
    with pytest.raises(DataError, match=says):
        Recording.read(path, inputs={"force": "Force"}, sensors={"position": "Pos"})


def test_whole_numbers_with_a_unit_are_a_time(tmp_path: Path) -> None:
    path = write(tmp_path, "t", lambda k, s: f"{4 * k}")
    assert outline_table(path, GivenRoles(units={"t": "ms"})).dt == pytest.approx(0.004)
    with pytest.raises(DataError, match="'t' holds whole numbers"):
        outline_table(path, GivenRoles(time="t"))


def test_a_time_that_is_a_guess_stands_in_the_answer(tmp_path: Path) -> None:
    path = write(tmp_path, "", lambda k, s: f"{k / 100:.2f}")
    draft = write_first_case(path, tmp_path / "case.toml", GivenRoles(), default())
    assert "column 1 is the time in s, since it alone grows evenly" in draft.text


def test_stamps_that_all_repeat_are_said(tmp_path: Path) -> None:
    path = write(tmp_path, "time [s]", lambda k, s: f"{k // 2 / 50:.2f}")
    with pytest.raises(DataError, match=r"150 of 300 stamps repeat the one before \(the first is sample 1, line 3\)"):
        outline_table(path, GivenRoles())


def test_the_names_of_rows_have_no_name_themselves(tmp_path: Path) -> None:
    rows = [f'"{k + 1}" {k / 100:.2f} {4 * np.sin(0.07 * k):.4f} {np.cos(0.07 * k):.4f}' for k in range(N)]
    (tmp_path / "run.txt").write_text('"time" "force" "pos"\n' + "\n".join(rows) + "\n")  # write.table of R
    found = outline_table(tmp_path / "run.txt", GivenRoles())
    assert (found.time, found.dt) == ("time", pytest.approx(0.01))
    assert float(np.nanmax(found.response.values)) == pytest.approx(1.0, abs=1e-3)


NIGHTS = [datetime(2025, *day, 23, 59, 58, 500_000) for day in ((3, 4), (11, 12), (3, 12), (3, 31), (12, 31), (1, 1))]


@pytest.mark.parametrize("form", ["%d/%m/%Y", "%m/%d/%Y", "%d-%m-%y", "%d.%m.%Y", "%Y/%m/%d"])
@pytest.mark.parametrize("begun", NIGHTS)
def test_the_other_dates_tell_whether_the_day_or_the_month_is_first(tmp_path: Path, begun: datetime, form: str) -> None:
    stamps = [begun + timedelta(milliseconds=10 * k) for k in range(N)]
    path = write(tmp_path, "When", lambda k, s: milli(stamps[k], f"{form} %H:%M:%S."))
    assert outline_table(path, GivenRoles()).dt == pytest.approx(0.01)


@pytest.mark.parametrize("day", ["01/02/2025", "12/11/2025"])
def test_one_date_with_two_readings_changes_no_time(tmp_path: Path, day: str) -> None:
    path = write(tmp_path, "When", lambda k, s: milli(s, f"{day} %H:%M:%S."))
    assert outline_table(path, GivenRoles()).dt == pytest.approx(0.01)


def test_dates_with_two_readings_and_two_times_are_asked_about(tmp_path: Path) -> None:
    path = write(tmp_path, "When", lambda k, s: milli(s, f"{'01/02/2025' if k < N // 2 else '02/03/2025'} %H:%M:%S."))
    with pytest.raises(
        DataError, match=r"'02/03/2025' is 2025-0\d-0\d or .*, and '01/02/2025' allows both: write dates"
    ):
        outline_table(path, GivenRoles())
