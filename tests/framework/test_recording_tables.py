"""Tables as data loggers write them: lines above the names, units beside and below them, time stamps."""

from __future__ import annotations

import os
from pathlib import Path

import h5py
import numpy as np
import pytest
import pyuff
import xarray as xr

from lostmotion.errors import DataError
from lostmotion.recording import Table, read_columns, read_table

N = 300
TIME = np.arange(N) / 1000
FORCE = np.round(1.5 * np.sin(40 * TIME), 6)
PLACE = np.round(0.2 * np.cos(40 * TIME) - 0.5, 6)
ROWS = np.column_stack([1000 * TIME, FORCE, PLACE])


def table(folder: Path, text: str, name: str = "run.csv", encoding: str = "utf-8") -> Table:
    (folder / name).write_bytes(text.encode(encoding))
    return read_table(folder / name)


def body(separator: str = ",", *, comma: bool = False, quoted: bool = False, end: str = "\n") -> str:
    cells = [[f"{v:.6f}" for v in row] for row in ROWS]
    if comma:
        cells = [[cell.replace(".", ",") for cell in row] for row in cells]
    if quoted:
        cells = [[f'"{cell}"' for cell in row] for row in cells]
    return "".join(separator.join(row) + end for row in cells)


def check(got: Table, time: str = "Time", force: str = "Force", place: str = "x") -> None:
    for name, wanted in zip((time, force, place), ROWS.T, strict=True):
        np.testing.assert_array_equal(got.columns[name], wanted)


PLAIN = {"Time": "ms", "Force": "N", "x": "mm"}
LOOKS = {
    "square brackets": "Time [ms],Force [N],x [mm]\n" + body(),
    "round brackets": "Time (ms),Force(N),x (mm)\n" + body(),
    "a second line": "Time;Force;x\nms;N;mm\n" + body(";", comma=True),
    "a second line in brackets": "Time;Force;x\n[ms];[N];[mm]\n" + body(";"),
    "a second line in round brackets": "Time,Force,x\n(ms),(N),(mm)\n" + body(),
    "tabs and decimal commas": "Time\tForce\tx\nms\tN\tmm\n" + body("\t", comma=True),
    "blanks": "Time Force x\nms N mm\n" + body(" "),
    "blanks and brackets": "Time [ms]  Force [N]  x [mm]\n" + body("  "),
    "quoted decimal commas": '"Time","Force","x"\nms,N,mm\n' + body(comma=True, quoted=True),
    "a byte order mark": "\ufeffTime;Force;x\r\nms;N;mm\r\n" + body(";", comma=True, end="\r\n"),
    "separators at line ends": "Time;Force;x;\nms;N;mm;\n" + body(";", end=";\n"),
    "separators at the ends of rows": "Time;Force;x\nms;N;mm\n" + body(";", end=";\r\n"),
    "a separator behind the names": "Time,Force,x,\nms,N,mm\n" + body(),
    "lines above": "Device: logger 7\nSample rate;1000\n\nTime;Force;x\nms;N;mm\n" + body(";"),
    "lines above of as many cells": "Device;X;1\nFrom;2026-03-01;08:15:00\nTime [ms];Force [N];x [mm]\n" + body(";"),
    "a comment": "# Device: X\n# Time,Force,x\n# ms,N,mm\n" + body(),
}


@pytest.mark.parametrize("text", LOOKS.values(), ids=LOOKS)
def test_a_table_is_read_whatever_it_looks_like(tmp_path: Path, text: str) -> None:
    got = table(tmp_path, text)
    check(got)
    assert {name: got.units[name] for name in PLAIN} == PLAIN
    assert got.starts == {}


def test_a_column_has_its_full_and_its_bare_name(tmp_path: Path) -> None:
    got = table(tmp_path, "Time [ms],a [N],a [mm]\n" + body())
    assert list(got.columns) == ["Time [ms]", "a [N]", "a [mm]", "Time"]
    assert got.full_names == ("Time [ms]", "a [N]", "a [mm]")
    assert got.columns["Time"] is got.columns["Time [ms]"]
    assert got.units == {"Time [ms]": "ms", "a [N]": "N", "a [mm]": "mm", "Time": "ms"}
    assert list(table(tmp_path, "Time [ms],Time,x\n" + body()).columns) == ["Time [ms]", "Time", "x"]


@pytest.mark.parametrize("name", ["x(t)", "F (t)", "x[0]", "pos (left)", "u (measured)", "acc (link)"])
def test_brackets_that_hold_no_unit_belong_to_the_name(tmp_path: Path, name: str) -> None:
    got = table(tmp_path, f"time,{name},y\n" + body())
    assert (list(got.columns), got.units) == (["time", name, "y"], {})


def test_two_columns_with_words_above_are_a_table(tmp_path: Path) -> None:
    pairs = "".join(f"{t:.3f};{f:.6f}\n" for t, f in zip(TIME, FORCE, strict=True))
    got = table(tmp_path, "Device;X\nSample rate;1000\nOperator;Smith\nTime [s];Force [N]\n" + pairs)
    assert got.full_names == ("Time [s]", "Force [N]")
    np.testing.assert_array_equal(got.columns["Force"], FORCE)


def test_words_and_empty_cells_beside_numbers_stay_what_they_were(tmp_path: Path) -> None:
    got = table(tmp_path, "state;value\n" + "".join(f"ok;{v}\n" for v in (1, "", 3)))
    assert list(got.columns) == ["value"]
    np.testing.assert_array_equal(got.columns["value"], [1, np.nan, 3])
    got = table(tmp_path, "t;x;\n" + "".join(f"{t};{'' if t == 5 else t};\n" for t in range(9)))
    assert np.flatnonzero(np.isnan(got.columns["x"])).tolist() == [5]


def test_a_later_line_of_words_is_no_header(tmp_path: Path) -> None:
    with pytest.raises(DataError, match=r"line 3, column 'time': 'foo'"):
        table(tmp_path, "time,x\n0,1\nfoo,bar\n1,2\n2,3\n")


def test_quoted_thousands_are_not_taken_for_decimals(tmp_path: Path) -> None:
    with pytest.raises(DataError, match="write decimal points"):
        table(tmp_path, "t,x\n" + "".join(f'{t},"1,{t:03d}"\n' for t in range(9))).column("x", "run.csv")
    rows = "".join(f'{t},"{t},25"\n' for t in range(9)) + '10,"1,234.5"\n'
    with pytest.raises(DataError, match=r"'0,25' \(line 2\) a decimal comma, so one of them is not a number"):
        table(tmp_path, f"t,x\n{rows}").column("x", "run.csv")


def stamped(cells: list[str], separator: str = ";") -> str:
    return f"When{separator}F\n" + "".join(f"{cell}{separator}{k}.5\n" for k, cell in enumerate(cells))


STEPS = 1_000_250 * np.arange(120)
"""Microseconds."""


def forms(first: str, form: str) -> list[str]:
    stamps = np.datetime64(first, "us") + STEPS.astype("timedelta64[us]")
    return [stamp.astype(object).strftime(form) for stamp in stamps]


@pytest.mark.parametrize(
    ("cells", "start"),
    [
        (forms("2026-03-01T08:15:00.001", "%Y-%m-%dT%H:%M:%S.%f"), "2026-03-01T08:15:00.001"),
        (forms("2026-03-01T08:15:00.001", "%Y-%m-%d %H:%M:%S,%f"), "2026-03-01T08:15:00.001"),
        (forms("2026-03-01T23:59:30.5", "%Y-%m-%dT%H:%M:%S.%fZ"), "2026-03-01T23:59:30.5Z"),
        (forms("2026-02-28T23:59:30", "%Y-%m-%dT%H:%M:%S.%f+02:00"), "2026-02-28T23:59:30+02:00"),
        (forms("2026-03-01T23:59:30", "%H:%M:%S.%f"), "23:59:30"),
        (forms("2026-03-31T23:59:30", "%d.%m.%Y %H:%M:%S.%f"), "2026-03-31T23:59:30"),
        (forms("2026-03-12T23:59:30", "%m/%d/%Y %H:%M:%S.%f"), "2026-03-12T23:59:30"),
        (forms("2026-03-12T23:59:30", "%d/%m/%Y %H:%M:%S.%f"), "2026-03-12T23:59:30"),
        (forms("2026-02-03T23:59:30", "%d/%m/%Y %H:%M:%S.%f"), "2026-02-03T23:59:30"),
        (forms("2026-02-03T11:59:30", "%m/%d/%Y %I:%M:%S.%f %p"), "2026-02-03T11:59:30"),
        (forms("2026-02-03T11:59:30", "%Y/%m/%d %H:%M:%S.%f"), "2026-02-03T11:59:30"),
    ],
    ids=["T", "comma", "Z", "offset", "time alone", "dots", "month first", "day first", "day first by its length",
         "half days", "year first"],
)  # fmt: skip
@pytest.mark.parametrize("separator", [";", ",", "\t"])
def test_time_stamps_become_seconds(tmp_path: Path, cells: list[str], start: str, separator: str) -> None:
    quoted = [f'"{cell}"' if separator in cell else cell for cell in cells]
    got = table(tmp_path, stamped(quoted, separator))
    np.testing.assert_array_equal(got.columns["When"], STEPS / 1e6)
    np.testing.assert_array_equal(got.columns["F"], np.arange(120) + 0.5)
    assert (got.units["When"], dict(got.starts)) == ("s", {"When": start})


def test_microseconds_survive_a_date(tmp_path: Path) -> None:
    cells = [f"2026-03-01T08:15:{k // 10**6:02d}.{k % 10**6:06d}" for k in range(0, 900, 3)]
    np.testing.assert_array_equal(table(tmp_path, stamped(cells)).columns["When"], np.arange(0, 900, 3) / 1e6)


def test_summer_time_is_no_gap_where_the_offset_is_written(tmp_path: Path) -> None:
    cells = ["2026-03-29T01:59:58+01:00", "2026-03-29T01:59:59+01:00", "2026-03-29T03:00:00+02:00"]
    np.testing.assert_array_equal(table(tmp_path, stamped(cells)).columns["When"], [0, 1, 2])


def test_a_lost_stamp_is_nan_and_a_wrong_one_is_told(tmp_path: Path) -> None:
    cells = forms("2026-03-01T08:15:00", "%Y-%m-%dT%H:%M:%S.%f")
    got = table(tmp_path, stamped([*cells[:4], "", *cells[5:]])).columns["When"]
    assert np.flatnonzero(np.isnan(got)).tolist() == [4]
    with pytest.raises(DataError, match=r"line 6, column 'When': 'soon' is not a time stamp"):
        table(tmp_path, stamped([*cells[:4], "soon", *cells[5:]])).column("When", "run.csv")
    with pytest.raises(DataError, match="some time stamps have a date"):
        table(tmp_path, stamped([*cells[:4], "08:15:04", *cells[5:]])).column("When", "run.csv")
    with pytest.raises(DataError, match="correct the dates"):
        table(tmp_path, stamped(["2026-02-30T00:00:00"] * 4)).column("When", "run.csv")


def test_units_of_other_formats(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "run.h5", "w") as file:
        for name, unit in (("t", "ms"), ("log/F", np.bytes_("kN"))):
            file[name] = TIME
            file[name].attrs["units"] = unit
        file["log/blocks"] = np.zeros((3, N))
        file["log/blocks"].attrs["units"] = "mm"
        file["odd"] = TIME
        file["odd"].attrs["units"] = 3.0
    got = read_table(tmp_path / "run.h5")
    assert got.units == {"t": "ms", "log/F": "kN", **{f"log/blocks[{i}]": "mm" for i in range(3)}}
    data = xr.Dataset({"F": ("time", FORCE, {"units": "N"})}, {"time": ("time", TIME, {"units": "seconds"})})
    for engine in ("h5netcdf", "scipy"):
        data.to_netcdf(tmp_path / "run.nc", engine=engine)
        assert read_table(tmp_path / "run.nc").units == {"F": "N", "time": "seconds"}
    head = pyuff.prepare_58(
        binary=0, id1="F", func_type=1, rsp_node=1, rsp_dir=1, ref_node=1, ref_dir=1, data=FORCE, x=TIME,
        abscissa_spacing=1, abscissa_min=0.0, abscissa_inc=0.001, num_pts=N, ord_data_type=4,
        ordinate_axis_units_lab="N", abscissa_axis_units_lab="s",
    )  # fmt: skip
    pyuff.UFF(str(tmp_path / "run.uff")).write_sets(
        [{"orddenom_spec_data_type": 0, "z_axis_spec_data_type": 0} | head], "add"
    )
    assert read_table(tmp_path / "run.uff").units == {"58[0]": "N", "F": "N", "time": "s"}


def test_columns_are_those_of_the_table(tmp_path: Path) -> None:
    got = table(tmp_path, "Time [ms],Force [N],x [mm]\n" + body())
    columns = read_columns(tmp_path / "run.csv")
    assert list(columns) == list(got.columns)
    assert read_table(tmp_path / "run.csv").units["x"] == "mm"


def test_a_file_that_has_not_changed_is_read_once_and_one_that_was_changed_again(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text("time,x\n0,1\n1,2\n")
    assert read_table(path) is not read_table(path)  # it was changed just now: the next change may have the same time
    old = path.stat().st_mtime - 60.0
    os.utime(path, (old, old))
    kept = read_table(path)
    assert read_table(path) is kept
    with pytest.raises(ValueError, match="read-only"):
        kept.columns["x"][0] = 3.0
    path.write_text("time,x\n0,1\n1,5\n")
    assert read_table(path).columns["x"][1] == 5.0
    os.utime(path, (old + 1.0, old + 1.0))
    assert read_table(path).columns["x"][1] == 5.0
