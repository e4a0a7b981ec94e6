"""Files of instruments, dates of all kinds, comments and encodings: each is read without a question."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.recording import Recording, Table, read_table
from lostmotion.recording.clock import find_time
from lostmotion.recording.outline import GivenRoles, outline_table

N = 300
T = np.arange(N) / 100.0
FORCE = np.round(40.0 * np.sin(7.0 * T), 5)
PLACE = np.round(30.0 * np.cos(7.0 * T), 5)
BEGUN = datetime(2025, 3, 4, 9, 58, 50)
DATES = [BEGUN + timedelta(milliseconds=10 * k) for k in range(N)]


def write(folder: Path, text: str, ending: str = "csv", encoding: str = "utf-8") -> Table:
    (folder / f"run.{ending}").write_bytes(text.encode(encoding))
    return read_table(folder / f"run.{ending}")


def join(separator: str, *columns: list[str]) -> str:
    return "".join(separator.join(cells) + "\n" for cells in zip(*columns, strict=True))


def point(values: Any) -> list[str]:
    return [f"{value:.5f}" for value in values]


def comma(values: Any) -> list[str]:
    return [text.replace(".", ",") for text in point(values)]


def stamps(form: str, digits: int = 3) -> list[str]:
    """Return the dates in a format, in which @ stands for the fraction of a second."""
    return [date.strftime(form).replace("@", f"{date.microsecond:06d}"[:digits]) for date in DATES]


def check(table: Table, force: str, place: str = "", start: str = "") -> None:
    """The rate is 100 Hz, no number has changed, and the first stamp is as written."""
    found = find_time(table, "run.csv")
    assert found.clock.dt == pytest.approx(0.01)
    assert not found.clock.uneven
    np.testing.assert_allclose(table.column(force, "run.csv"), FORCE, atol=1e-9)
    if place:
        np.testing.assert_allclose(table.column(place, "run.csv"), PLACE, atol=1e-9)
    if start:
        assert table.starts[found.column or ""] == start


# -- dates


@pytest.mark.parametrize(
    ("head", "columns", "start"),
    [
        ("Datum", [stamps("%d.%m.%Y %H:%M:%S,@")], "2025-03-04T09:58:50"),
        ("Datum", [[s.replace("04.03.", "4. 3. ") for s in stamps("%d.%m.%Y %H:%M:%S.@")]], "2025-03-04T09:58:50"),
        ("Datum", [stamps("%Y.%m.%dT%H:%M:%S.@")], "2025-03-04T09:58:50"),
        ("Datum;Zeit", [stamps("%d.%m.%y"), stamps("%H:%M:%S,@")], "2025-03-04T09:58:50"),
        ("Time;Date", [stamps("%H:%M:%S.@", 6), stamps("%d/%m/%Y")], "2025-04-03T09:58:50"),
        ("Date;Time;Millisecond", [stamps("%Y-%m-%d"), stamps("%H:%M:%S"), stamps("@")], "2025-03-04T09:58:50.000"),
        ("日付 時間;ms", [stamps("%Y/%m/%d %H:%M:%S"), stamps("@")], "2025-03-04T09:58:50.000"),
        ("When", [stamps("%Y-%m-%dT%H:%M:%S.@+01:00")], "2025-03-04T09:58:50+01:00"),
        ("When", [stamps("%Y-%m-%d %H:%M:%S.@ CET")], "2025-03-04T09:58:50+01:00"),
        ("When", [stamps("%m/%d/%Y %H:%M:%S.@ EST")], "2025-03-04T09:58:50-05:00"),
        ("When", [stamps("%Y-%m-%dT%H:%M:%S.@Z")], "2025-03-04T09:58:50Z"),
    ],
)  # fmt: skip
def test_dates_of_loggers_are_time(tmp_path: Path, head: str, columns: list[list[str]], start: str) -> None:
    body = join(";", *columns, point(FORCE), point(PLACE))
    check(write(tmp_path, f"{head};force;position\n{body}"), "force", "position", start)


def test_a_change_to_summer_time_is_no_gap(tmp_path: Path) -> None:
    night = [datetime(2025, 3, 30, 1, 59, 58) + timedelta(milliseconds=10 * k) for k in range(N)]
    local = [f"{at:%Y-%m-%d %H:%M:%S.%f} CET" for at in night[:200]]
    local += [f"{at + timedelta(hours=1):%Y-%m-%d %H:%M:%S.%f} CEST" for at in night[200:]]
    check(write(tmp_path, "When;force\n" + join(";", local, point(FORCE))), "force", start="2025-03-30T01:59:58+01:00")


def test_milliseconds_beside_exact_stamps_are_a_column(tmp_path: Path) -> None:
    body = join(";", stamps("%Y-%m-%d %H:%M:%S.@"), stamps("@"), point(FORCE))
    table = write(tmp_path, f"When;ms;force\n{body}")
    check(table, "force")
    assert "ms" in table.columns


ZONE = timezone(timedelta(hours=2))
LISTS: dict[str, list[Any]] = {
    "datetime": DATES,
    "datetime of UTC": [date.replace(tzinfo=UTC) for date in DATES],
    "datetime of a zone": [date.replace(tzinfo=ZONE) for date in DATES],
    "time of day": [date.time() for date in DATES],
    "durations": [date - BEGUN for date in DATES],
    "datetime64": [np.datetime64(date) for date in DATES],
    "texts": [date.isoformat() for date in DATES],
}


@pytest.mark.parametrize("time", LISTS.values(), ids=LISTS)
def test_lists_of_times_are_time(time: list[Any]) -> None:
    units = {"position": "mm", "force": "N"}
    made = Recording.from_arrays(time, sensors={"position": PLACE}, inputs={"force": FORCE}, units=units)
    assert made.rate == pytest.approx(100.0)
    np.testing.assert_allclose(np.asarray(made.inputs[0]), FORCE, atol=1e-12)


# -- comments


COMMENTS: dict[str, tuple[str, str]] = {
    "names in the last comment": ("# rig 3\n# operator: me\n# time (s), force (N), position (mm)\n", ","),
    "names and units in comments": ("#time,force,position\n#s,N,mm\n", ","),
    "per cent": ("% rig 3\n% time force position\n", " "),
    "comments above the names": ("% Rate: 100\n%\n\ntime,force,position\ns,N,mm\n", ","),
    "settings above the names": ("#Rate: 100 Hz\n#Channels: 3\ntime;force;position\n", ";"),
    "slashes": ("// made by a rig\n// time;force;position\n// [s];[N];[mm]\n", ";"),
}


@pytest.mark.parametrize(("head", "separator"), COMMENTS.values(), ids=COMMENTS)
def test_comment_lines_are_no_rows(tmp_path: Path, head: str, separator: str) -> None:
    body = join(separator, point(T), point(FORCE), point(PLACE))
    check(write(tmp_path, head + body + "# end of the recording\n"), "force", "position")


# -- instruments


def beside(*channels: tuple[str, Any]) -> str:
    """Return the text of older Tektronix scopes, which write settings beside the readings of each channel."""
    said = ["Record Length,3.0e+02", "Sample Interval,1.0e-02", "Trigger Point,1.5e2", "Source,{}", "Vertical Units,V",
            "Horizontal Units,s", "Probe Atten,1.0e+00"]  # fmt: skip
    lines = []
    for k in range(N):
        left = said[k] if k < len(said) else ","
        lines.append("".join(f"{left.format(name)},,{T[k] - 1.0:.12f},{read[k]:10.5f}," for name, read in channels))
    return "\n".join(lines) + "\n"


KEYSIGHT = (
    "Revision:,0\nType:,raw\nPoints:,300\nXInc:,0.01\nXOrg:,-1.0\nDate:,4 MAR 2025\nTime:,9:58:50:00\n"
    "X Units:,second\nY Units:,Volt\nData:,\n"
)  # fmt: skip
INSTRUMENTS: dict[str, tuple[str, str, str, str]] = {
    "Tektronix TDS": (beside(("CH2", FORCE)), "CH2", "", "V"),
    "Tektronix TDS, two channels": (beside(("CH1", FORCE), ("CH2", PLACE)), "CH1", "CH2", "V"),
    "Tektronix MSO": (
        "Model,MSO54\nFirmware Version,1.2\n,\nHorizontal Units,s\nSample Interval,0.01\nVertical Units,V,V\n,\n,\n"
        "Label,,\nTIME,CH1,CH2\n" + join(",", point(T), point(FORCE), point(PLACE)),
        "CH1", "CH2", "V",
    ),
    "Keysight Infiniium": (KEYSIGHT + join(",", point(T - 1.0), point(FORCE)), "reading", "", "V"),
    "Keysight InfiniiVision": (
        "x-axis,1,2\nsecond,Volt,Volt\n" + join(",", point(T), point(FORCE), point(PLACE)), "1", "2", "V",
    ),
    "Keysight BenchVue": (
        "Data Log\nInstrument,34465A\n\nScan,Time,101 (V),102 (V)\n"
        + join(",", [str(k + 1) for k in range(N)], stamps("%m/%d/%Y %H:%M:%S:@"), point(FORCE), point(PLACE)),
        "101", "102", "V",
    ),
    "LeCroy": (
        "LECROYWS,1,Waveform\nSegments,1,SegmentSize,300\nSegment,TrigTime,TimeSinceSegment1\n"
        "#1,04-Mar-2025 09:58:50,0\nTime,Ampl\n" + join(",", point(T), point(FORCE)),
        "Ampl", "", "",
    ),
    "HOBO": (
        '"Plot Title: rig 2"\n"#","Date Time, GMT+01:00","Force, N (LGR S/N: 10, SEN S/N: 1)",'
        '"Position, mm (LGR S/N: 10)","Host Connected","End Of File"\n'
        + join(",", [str(k + 1) for k in range(N)], stamps("%m/%d/%y %I:%M:%S.@ %p"), point(FORCE), point(PLACE),
               [""] * N, [""] * (N - 1) + ["Logged"]),
        "Force", "Position", "N",
    ),
    "Rigol": (
        "X,CH1,CH2,Start,Increment,\nSequence,VOLT,VOLT,-1.000000e+00,1.000000e-02,\n"
        + join(",", [str(k) for k in range(N)], point(FORCE), point(PLACE), [""] * N),
        "CH1", "CH2", "V",
    ),
    "Rigol, one channel, start beside the names": (
        "X,CH1,Start,Increment\nSequence,V,0.5,0.01\n" + join(",", [str(k) for k in range(N)], point(FORCE)),
        "CH1", "", "V",
    ),
    "Siglent": (
        "Record Length,Analog:300\nSample Interval,0.01\nVertical Units,Volt\nHorizontal Units,Second\n\n"
        "Source,CH1,CH2\nSecond,Volt,Volt\n" + join(",", point(T), point(FORCE), point(PLACE)),
        "CH1", "CH2", "V",
    ),
    "Picoscope": (
        "Time,Channel A,Channel B\n(ms),(V),(V)\n\n" + join(",", point(1e3 * T), point(FORCE), point(PLACE)),
        "Channel A", "Channel B", "V",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("text", "force", "place", "unit"), INSTRUMENTS.values(), ids=INSTRUMENTS)
def test_files_of_instruments_have_time_readings_and_units(
    tmp_path: Path, text: str, force: str, place: str, unit: str
) -> None:
    table = write(tmp_path, text)
    check(table, force, place)
    assert table.units.get(force, "") == unit
    assert outline_table(tmp_path / "run.csv", GivenRoles()).dt == pytest.approx(0.01)


# -- rows without their last cells, lines below the rows


def test_rows_without_their_last_cells_have_no_reading_there(tmp_path: Path) -> None:
    """A second sensor that is read in every fourth row; a spreadsheet leaves the separators of empty cells out."""
    rows = [f"{t};{f}" + (f";{x}" if k % 4 == 0 else "") for k, (t, f, x) in enumerate(
        zip(point(T), point(FORCE), point(PLACE), strict=True))]  # fmt: skip
    table = write(tmp_path, "time;force;position\n" + "\n".join(rows) + "\n")
    check(table, "force")
    seen = table.columns["position"]
    np.testing.assert_allclose(seen[::4], PLACE[::4], atol=1e-9)
    assert np.count_nonzero(np.isfinite(seen)) == np.count_nonzero(np.arange(N) % 4 == 0)


@pytest.mark.parametrize("end", ["2.99;1", "2.99"])
def test_a_last_row_that_was_cut_is_refused_with_its_line(tmp_path: Path, end: str) -> None:
    text = "time;force;position\n" + join(";", point(T), point(FORCE), point(PLACE))
    with pytest.raises(DataError, match=rf"line 302: {end.count(';') + 1} cells where the header names 3 columns"):
        write(tmp_path, text + end)


def test_a_row_with_more_cells_is_refused_with_its_line(tmp_path: Path) -> None:
    text = "time;force;position\n" + join(";", point(T), point(FORCE), point(PLACE))
    lines = text.splitlines()
    lines[40] += ";7"
    with pytest.raises(DataError, match="line 41: 4 cells where the header names 3 columns"):
        write(tmp_path, "\n".join(lines) + "\n")


@pytest.mark.parametrize(
    "footer",
    [
        "Mean;0.5;0.1\nMax;40;30\n",
        "Mittelwert;0.5;0.1\n",
        "\nStatistics\nchannel;mean;sd\nforce;0.1;28\nposition;0.2;21\n",
        "Std. Dev.:;28.2;21.1\n",
        "最大値;40;30\n",
        "*** End of data ***\n",
        ";Summe;12.5\n",
        "Aborted by user\n",
        "\x1a",
        "\n(300 rows affected)\n",
        ";;\n;;\nMean;0.5;0.1\n",
        ";;\n;;\n",
    ],
)
def test_statistics_below_the_rows_are_no_rows(tmp_path: Path, footer: str) -> None:
    body = join(";", point(T), point(FORCE), point(PLACE)) + footer
    check(write(tmp_path, "time;force;position\n" + body), "force", "position")


@pytest.mark.parametrize("row", ["stop", "Stopped;1;2", "Mean;0.5;0.1"])
def test_no_row_below_a_footer_is_lost(tmp_path: Path, row: str) -> None:
    """A word near the end of the rows, as of an event: the rows below it are rows of the table."""
    lines = ("time;force;position\n" + join(";", point(T), point(FORCE), point(PLACE))).splitlines()
    text = "\n".join([*lines[:280], row, *lines[280:]]) + "\n"
    (tmp_path / "run.csv").write_text(text)
    with pytest.raises(DataError, match="line 281"):
        find_time(read_table(tmp_path / "run.csv"), "run.csv")


SPLIT = '"Time\n[s]";"Force\n[N]";"Position\n[mm]"'
SUMMARY = "Results;;\n;Force max;Position max\n;N;mm\n1;40;30\n\nTime;Force;Position\n[s];[N];[mm]"


@pytest.mark.parametrize("head", [SPLIT, SUMMARY, "---\nrig: 3\n---\nTime [s];Force [N];Position [mm]"])
def test_lines_above_the_table_are_no_part_of_it(tmp_path: Path, head: str) -> None:
    table = write(tmp_path, f"{head}\n" + join(";", point(T), point(FORCE), point(PLACE)))
    names = ("Force [N]", "Position [mm]") if head != SUMMARY else ("Force", "Position")
    check(table, *names)
    assert (table.units[names[0]], table.units[names[1]]) == ("N", "mm")


def test_a_word_in_place_of_a_time_within_the_rows_is_no_footer(tmp_path: Path) -> None:
    lines = ("time;force;position\n" + join(";", point(T), point(FORCE), point(PLACE))).splitlines()
    lines[100] = "max;" + lines[100].partition(";")[2]
    table = write(tmp_path, "\n".join(lines) + "\n")
    assert "line 101" in table.refused["time"]


# -- LabVIEW


def lvm(columns: str = "One", mark: str = ".", clock: str = "09:58:50.1234567890123") -> str:
    return (
        f"LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\nDecimal_Separator\t{mark}\n"
        f"Multi_Headings\tNo\nX_Columns\t{columns}\nTime_Pref\tAbsolute\nOperator\tme\nDate\t2025/03/04\n"
        f"Time\t{clock}\n***End_of_Header***\t\n\t\n"
    )


def segment(names: str, body: str, *, units: str = "N\tmm", clock: str = "09:58:50.1234567", mark: str = ".") -> str:
    return (
        f"Channels\t2\t\t\nSamples\t300\t300\t\nDate\t2025/03/04\t2025/03/04\t\nTime\t{clock}\t{clock}\t\n"
        f"Y_Unit_Label\t{units}\t\nX_Dimension\tTime\tTime\t\nX0\t0{mark}0E+0\t0{mark}0E+0\t\n"
        f"Delta_X\t0{mark}010000\t0{mark}010000\t\n***End_of_Header***\t\t\t\n{names}\n{body}"
    )


NAMES = "X_Value\tForce\tPosition\tComment"
LVM: dict[str, Callable[[], str]] = {
    "one column of time": lambda: lvm() + segment(NAMES, join("\t", point(T), point(FORCE), point(PLACE))),
    "no column of time": lambda: lvm("No") + segment(NAMES, join("\t", [""] * N, point(FORCE), point(PLACE))),
    "decimal commas": lambda: (
        lvm(mark=",") + segment(NAMES, join("\t", comma(T), comma(FORCE), comma(PLACE)), mark=",")
    ),
    "a time for each channel": lambda: (
        lvm("Multi")
        + segment(
            "X_Value\tForce\tX_Value\tPosition\tComment",
            join("\t", point(T), point(FORCE), point(T), point(PLACE)),
            units="N\t\tmm",
        )
    ),
    "two segments": lambda: (
        lvm()
        + segment(NAMES, join("\t", point(T[:100]), point(FORCE[:100]), point(PLACE[:100])), clock="09:58:50.5")
        + "\n"
        + segment(NAMES, join("\t", point(T[:200]), point(FORCE[100:]), point(PLACE[100:])), clock="09:58:51.5")
    ),
}


@pytest.mark.parametrize("ending", ["lvm", "txt"])
@pytest.mark.parametrize("make", LVM.values(), ids=LVM)
def test_files_of_labview_are_read(tmp_path: Path, make: Callable[[], str], ending: str) -> None:
    table = write(tmp_path, make(), ending)
    check(table, "Force", "Position")
    assert (table.units["Force"], table.units["Position"]) == ("N", "mm")
    assert set(table.full_names) == {"time", "Force", "Position"}


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (lvm(), "holds no rows"),
        (lvm()[:200], "ends within a header"),
        (lvm() + segment(NAMES, "0.0\t1.0\tjam\n"), r"line 24, column 'Position': 'jam' is not a number"),
        (
            lvm() + segment(NAMES, "0.0\t1.0\t2.0\n") + "\n" + segment("X_Value\tOther", "0.0\t1.0\n"),
            "segments with different columns",
        ),
        (
            lvm() + "\n".join(segment(NAMES, "0.0\t1.0\t2.0\n") for _ in range(2)),
            "times do not follow each other",
        ),
    ],
)
def test_a_damaged_file_of_labview_is_refused_with_its_line(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(DataError, match=says):
        write(tmp_path, text, "lvm")


# -- encodings


@pytest.mark.parametrize(
    ("head", "encoding"),
    [
        ("時刻,荷重[N],変位[mm]", "cp932"),
        ("時間(秒),荷重(N),変位(mm)", "euc_jp"),
        ("時間,力[N],位置[mm]", "utf-16"),
        ("Время (с),Сила (Н),Перемещение (мм)", "cp1251"),
        ("Время (с),Усилие (Н),Положение (мм)", "koi8-r"),
        ("Время (с),Сила (Н),Перемещение (мм)", "cp866"),
        ("时间(s),力(N),位移(mm)", "gbk"),
        ("Zeit [s],Kraft [N],Länge [mm]", "latin-1"),
        ("Temps [s],Force [N],Déplacement [mm]", "cp1252"),
    ],
)
def test_headers_of_other_languages_are_read(tmp_path: Path, head: str, encoding: str) -> None:
    table = write(tmp_path, head + "\n" + join(",", point(T), point(FORCE), point(PLACE)), encoding=encoding)
    names = head.split(",")
    assert list(table.full_names) == names
    check(table, names[1], names[2])
    assert (table.units[names[1]], table.units[names[2]]) == ("N", "mm")


# -- what nobody asked for


@pytest.mark.parametrize(
    "odd",
    ["04.03.2025", "1.2.3", "0xAF", "TRUE", "9" * 400, "1e999", "E01", "", "12:30", "1,5,7", "€", "1_000"],
)
def test_a_column_that_nobody_asked_for_refuses_no_file(tmp_path: Path, odd: str) -> None:
    for cells in ([odd] * N, [odd if k % 9 else "7" for k in range(N)]):
        table = write(tmp_path, "time;force;odd\n" + join(";", point(T), point(FORCE), cells))
        check(table, "force")


ROWS = [f"{t:.4f},{np.sin(7 * t):.5f},{np.cos(7 * t):.5f}" for t in np.arange(300) / 100.0]


@pytest.mark.parametrize(
    ("head", "names"),
    [
        ('"TOA5","CR1000","12345"\n"TIMESTAMP","Force","Pos"\n"s","N","mm"\n"","Smp","Smp"', ("Force", "Pos")),
        ("Zeit,Kraft,Weg\n[s],[N],[mm]\nKanal 1,Kanal 2,Kanal 3", ("Kraft", "Weg")),
        ("Kanal 1,Kanal 2,Kanal 3\nZeit,Kraft,Weg\n[s],[N],[mm]", ("Kraft", "Weg")),
        ("Vertical Units,N,mm\nHorizontal Units,s,\nSource,CH1,CH2\nSecond,Value,Value", ("Value 1", "Value 2")),
        ("Time,Value,Value\ns,N,mm", ("Value 1", "Value 2")),
        ("Sekunden,하중(N),변위(mm)", ("하중(N)", "변위(mm)")),
    ],
)  # fmt: skip
@pytest.mark.parametrize("encoding", ["utf-8", "cp949", "utf-16-le"])
def test_names_and_units_in_several_lines(tmp_path: Path, head: str, names: tuple[str, str], encoding: str) -> None:
    if not head.isascii() or encoding != "cp949":
        (tmp_path / "run.csv").write_bytes("\n".join([head, *ROWS, ""]).encode(encoding))
        found = outline_table(tmp_path / "run.csv", GivenRoles())
        assert found.drive is not None
        assert (found.drive.name, found.response.name) == names
        assert (found.drive.unit, found.response.unit, found.dt) == ("N", "mm", pytest.approx(0.01))


def test_a_control_character_is_named_with_its_line(tmp_path: Path) -> None:
    rows = [*ROWS[:10], "0.1\x037,1.2", *ROWS[11:]]
    (tmp_path / "run.csv").write_text("\n".join(["time,force,pos", *rows]))
    with pytest.raises(DataError, match=r"run\.csv, line 12: there is the control character .*remove the line"):
        read_table(tmp_path / "run.csv")


def test_a_rigol_with_a_separator_behind_its_names(tmp_path: Path) -> None:
    rows = [f"{k},{np.sin(0.07 * k):.5f},{np.cos(0.07 * k):.5f},," for k in range(300)]
    head = "X,CH1,CH2,Start,Increment,\nSequence,VOLT,VOLT,-1.0,1.0e-02"
    (tmp_path / "run.csv").write_text("\n".join([head, *rows, ""]))
    table = read_table(tmp_path / "run.csv")
    assert table.columns["time"][:2].tolist() == [-1.0, -0.99]
    assert table.units["CH1"] == "V"
