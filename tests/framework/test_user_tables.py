"""Tables that users bring: numbers, time, units and roles are read as they are meant, or asked about.

The cases of `../shared/cases` are examples of kinds; the tables in this file are others of the same kinds.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion.errors import DataError
from lostmotion.notebook.doors import make_case
from lostmotion.preparation.beginning import write_first_case
from lostmotion.recording import Recording, Table, read_table
from lostmotion.recording.clock import find_time
from lostmotion.recording.outline import GivenRoles, Outline, outline_table
from lostmotion.registry import Registry, default
from lostmotion_chaos.analysis.source import WantedChannel, load_source

CASES = Path(__file__).resolve().parents[2].parent / "shared" / "cases"
N = 300
T = np.arange(N) / 100.0
FORCE = 40.0 * np.sin(7.0 * T)
PLACE = 30.0 * np.cos(7.0 * T)


def case(name: str) -> Path:
    """Return the recording of a case of the project's customers; they are no part of it."""
    if not (CASES / name).is_dir():
        pytest.skip(f"no cases of users: {CASES / name} is absent")
    return CASES / name / "run.csv"


def write(folder: Path, text: str, encoding: str = "utf-8", name: str = "run.csv") -> Path:
    (folder / name).write_bytes(text.encode(encoding))
    return folder / name


def outline(path: Path) -> Outline:
    return outline_table(path, GivenRoles())


def peaks(found: Outline) -> dict[str, tuple[float, str]]:
    """Return the greatest value of each column, as written, and its unit."""
    return {column.name: (float(np.nanmax(column.values)), column.unit) for column in found.columns}


# -- numbers


def test_a_point_before_three_digits_separates_thousands_beside_decimal_commas() -> None:
    found = outline(case("r02_dot_thousands"))
    assert found.dt == pytest.approx(0.01)
    assert found.drive is not None
    assert (np.ptp(found.drive.values), found.drive.unit) == (pytest.approx(31140, rel=0.01), "mN")
    assert (np.nanmin(found.response.values), found.response.unit) == (pytest.approx(-37180, rel=0.01), "um")


@pytest.mark.parametrize(
    ("rows", "wanted"),
    [
        (["0,5;1.530", "1,0;13.840", "1,5;-999"], [1530.0, 13840.0, -999.0]),
        (["0.5;1,530", "1.0;13,840.25", "1.5;-999"], [1530.0, 13840.25, -999.0]),
        (["0,5;1.234.567", "1,0;12", "1,5;1.000.000,5"], [1234567.0, 12.0, 1000000.5]),
        (["0.5;1'530.5", "1.0;13'840", "1.5;0.25"], [1530.5, 13840.0, 0.25]),
        (["0,5;1 530,5", "1,0;13 840", "1,5;\u22120,25"], [1530.5, 13840.0, -0.25]),
        (["0,25;1,530", "1,0;13,840", "1,5;2,000"], [1.53, 13.84, 2.0]),
        (["1;1.530", "2;13.840", "3;2.0001"], [1.53, 13.84, 2.0001]),
    ],
)
def test_all_cells_of_a_file_decide_how_a_number_is_read(tmp_path: Path, rows: list[str], wanted: list[float]) -> None:
    got = read_table(write(tmp_path, "a;x\n" + "\n".join(rows) + "\n"))
    assert got.column("x", "run.csv").tolist() == wanted


@pytest.mark.parametrize(
    ("rows", "says"),
    [
        (["1;1.530", "2;13.840"], "'1.530' is 1.53 with a decimal point and 1530 with a decimal comma"),
        (["1;1,530", "2;13,840"], "'1,530' is 1530 with a decimal point and 1.53 with a decimal comma"),
        (["1;0,5", "2;0.5"], r"'0.5' \(line 3\) has a decimal point and '0,5' \(line 2\) a decimal comma"),
    ],
)
def test_two_ways_to_read_a_number_are_asked_about(tmp_path: Path, rows: list[str], says: str) -> None:
    got = read_table(write(tmp_path, "a;x\n" + "\n".join(rows) + "\n"))
    assert "a" in got.columns
    with pytest.raises(DataError, match=says):
        got.column("x", "run.csv")


# -- time


@pytest.mark.parametrize("name", ["r05_us_name", "r14_datetime_two_cols", "r15_german", "r16_hobo", "r16_keysight"])
def test_the_time_of_a_case_is_found(name: str) -> None:
    assert outline(case(name)).dt == pytest.approx(0.01)


def rows_of(stamps: list[str], *, count: bool = True, separator: str = ",") -> str:
    lines = (
        separator.join(([str(k + 1)] if count else []) + [stamp, f"{FORCE[k]:.5f}", f"{PLACE[k]:.5f}"])
        for k, stamp in enumerate(stamps)
    )
    return "\n".join(lines) + "\n"


def clocks(form: str) -> list[str]:
    moments = np.datetime64("2025-03-04T09:58:50", "ms") + (1000 * T).astype("timedelta64[ms]")
    return [moment.astype(object).strftime(form)[: len(form) + 20] for moment in moments]


@pytest.mark.parametrize("counter", ["#", "No.", "index", "Sample", "pulses", "Zeile"])
def test_a_counter_is_no_time_beside_stamps(tmp_path: Path, counter: str) -> None:
    path = write(tmp_path, f"{counter},Date Time,force,position\n" + rows_of(clocks("%m/%d/%y %H:%M:%S.%f")))
    found = outline(path)
    assert (found.time, found.dt) == ("Date Time", pytest.approx(0.01))
    assert "it holds time stamps, the first one 2025-03-04T09:58:50" in found.clock.says


@pytest.mark.parametrize("counter", ["sample", "pulses", "n", "weird"])
def test_a_counter_alone_is_asked_about(tmp_path: Path, counter: str) -> None:
    path = write(tmp_path, f"{counter},force\n" + "".join(f"{3 * k},{FORCE[k]:.5f}\n" for k in range(N)))
    with pytest.raises(DataError, match=f"'{counter}' counts rows, and not seconds.*--rate HZ"):
        outline(path)


@pytest.mark.parametrize("scale", [1.0, 2e4, 1e-9])
def test_a_rate_that_few_recorders_have_is_asked_about_where_no_unit_is_stated(tmp_path: Path, scale: float) -> None:
    body = "".join(f"{scale * (k + 7)!r},{FORCE[k]:.5f},{PLACE[k]:.5f}\n" for k in range(N))
    with pytest.raises(DataError, match=r"--unit t=m?s"):
        outline(write(tmp_path, "t,force,position\n" + body))
    assert outline_table(write(tmp_path, "t [s],force,position\n" + body), GivenRoles()).dt == pytest.approx(scale)
    assert outline_table(tmp_path / "run.csv", GivenRoles(units={"t": "s"})).dt == pytest.approx(scale)


def test_milliseconds_since_1970_are_known_by_their_size(tmp_path: Path) -> None:
    body = "".join(f"{1741082330000 + 10 * k},{FORCE[k]:.5f},{PLACE[k]:.5f}\n" for k in range(N))
    found = outline(write(tmp_path, "timestamp,force,position\n" + body))
    assert (found.time_unit, found.dt) == ("ms", pytest.approx(0.01))
    assert "ms since 1970 by their size" in found.clock.notes[0]


def test_two_times_that_contradict_each_other_are_asked_about(tmp_path: Path) -> None:
    stamps = [f"{9.0 + k:.1f},{0.01 * k:.2f}" for k in range(N)]
    with pytest.raises(DataError, match="'date_s' gives 1 Hz and 'time_s' 100 Hz"):
        outline(write(tmp_path, "date_s,time_s,force,position\n" + rows_of(stamps, count=False)))


# -- dates


@pytest.mark.parametrize(
    ("head", "stamps"),
    [
        ("Datum;Uhrzeit", [f"{c};{d}" for c, d in zip(clocks("%d.%m.%Y"), clocks("%H:%M:%S,%f"), strict=True)]),
        ("Date;Time", [f"{c};{d}" for c, d in zip(clocks("%m/%d/%y"), clocks("%I:%M:%S.%f %p"), strict=True)]),
        ("date;clock", [f"{c};{d}" for c, d in zip(clocks("%Y-%m-%d"), clocks("%H:%M:%S:%f"), strict=True)]),
        ("When", clocks("%d-%b-%Y %H:%M:%S.%f")),
        ("When", clocks("%b %d, %Y %H:%M:%S.%f")),
        ("日時", clocks("%Y年%m月%d日 %H時%M分%S.%f秒")),
        ("When", [c + " GMT-07:00" for c in clocks("%Y-%m-%d %H:%M:%S.%f")]),
        ("When", clocks("%d.%m.%y %H:%M:%S,%f")),
    ],
)  # fmt: skip
def test_a_date_and_a_time_of_day_are_one_time(tmp_path: Path, head: str, stamps: list[str]) -> None:
    stamps = [
        stamp.replace(":" + stamp[-6:], ":" + stamp[-6:-3]) if head == "date;clock" else stamp for stamp in stamps
    ]
    found = outline(write(tmp_path, f"{head};force;position\n" + rows_of(stamps, count=False, separator=";")))
    assert found.dt == pytest.approx(0.01)
    assert "2025-03-04T09:58:50" in found.clock.says
    assert [column.name for column in found.columns] == ["force", "position"]


# -- units


def test_a_unit_at_the_end_of_a_name_counts_for_every_column() -> None:
    found = outline(case("r05_us_name"))
    assert peaks(found)["position_mm"] == (pytest.approx(36.01, rel=0.01), "mm")
    assert found.response.stated_unit == "mm"


def test_units_of_a_hobo_logger_stand_behind_a_comma() -> None:
    found = outline(case("r16_hobo"))
    assert (found.drive is not None and found.drive.unit, found.response.unit) == ("N", "mm")


def test_units_of_an_oscilloscope_stand_below_its_channels() -> None:
    found = outline(case("r16_keysight"))
    assert {name: unit for name, (_, unit) in peaks(found).items()} == {"1": "V", "2": "V"}


@pytest.mark.parametrize(
    ("head", "below", "units"),
    [
        ("time_s,speed_rpm,acc_g", "", ("rpm", "g")),
        ("Time (s),Speed (U/min),Acc (mm/s²)", "", ("rpm", "mm/s^2")),
        ("time,omega,theta", "ms,rad/s,deg\n", ("rad/s", "deg")),
        ("time/ms,omega_deg_per_s,a_m_s2", "", ("deg/s", "m/s^2")),
        ("'Time, s','Torque, Nm','Angle, deg (SEN 1)'", "", ("N m", "deg")),
        ("время_с,Сила (кН),Перемещение (мм)", "", ("kN", "mm")),
        ("時間(秒),荷重(N),変位(㎜)", "", ("N", "mm")),
    ],
)
def test_one_rule_finds_the_units_of_all_columns(tmp_path: Path, head: str, below: str, units: tuple[str, str]) -> None:
    body = "".join(f"{10 * k if 'ms' in head + below else T[k]:.2f},{FORCE[k]:.5f},{PLACE[k]:.5f}\n" for k in range(N))
    found = outline(write(tmp_path, head.replace("'", '"') + "\n" + below + body))
    assert found.dt == pytest.approx(0.01)
    assert tuple(column.unit for column in found.columns) == units
    assert all(column.sure for column in found.columns)


@pytest.mark.parametrize("name", ["sensor_A", "force_min", "left_in", "x_1", "axis_C", "motor_s"])
def test_the_end_of_a_name_is_no_unit_of_another_quantity(tmp_path: Path, name: str) -> None:
    body = "".join(f"{T[k]:.2f},{FORCE[k]:.5f},{PLACE[k]:.5f}\n" for k in range(N))
    assert peaks(outline(write(tmp_path, f"time_s,{name},position_mm\n" + body)))[name][1] == ""


@pytest.mark.parametrize(("cell", "unit"), [("{:.3f} N", "N"), ("{:.3f}kN", "kN"), ("{:.3f} rpm", "rpm")])
def test_units_in_the_cells_are_those_of_the_column(tmp_path: Path, cell: str, unit: str) -> None:
    body = "".join(f"{T[k]:.2f} s;{cell.format(FORCE[k])}\n" for k in range(N))
    got = read_table(write(tmp_path, "Time;reading\n" + body))
    assert (got.units["Time"], got.units["reading"]) == ("s", unit)
    np.testing.assert_allclose(got.columns["reading"], FORCE, atol=6e-4)


def test_two_units_in_the_cells_of_a_column_are_refused(tmp_path: Path) -> None:
    got = read_table(write(tmp_path, "t;x\n0.5;950 um\n1.5;1.02 mm\n2.5;1.1 mm\n"))
    with pytest.raises(DataError, match=r"the cells are in um \(line 2\) and in mm \(line 3\)"):
        got.column("x", "run.csv")


# -- what nobody asked for


@pytest.mark.parametrize(
    "odd",
    [lambda k: "1.2.3" if k % 2 else "4", lambda k: "0.5" if k % 2 else "0,5", lambda k: "Logged" if k % 7 else "9"],
)
def test_a_column_that_nobody_asked_for_refuses_no_file(tmp_path: Path, odd) -> None:
    body = "".join(f"{T[k]:.2f};{FORCE[k]:.5f};{PLACE[k]:.5f};{odd(k)}\n" for k in range(N))
    path = write(tmp_path, "time_s;force_N;position_mm;state\n" + body)
    assert [column.name for column in outline(path).columns] == ["force_N", "position_mm"]
    with pytest.raises(DataError, match="column 'state'"):
        outline_table(path, GivenRoles(drive="state"))


def test_a_header_in_the_middle_is_told_with_its_line() -> None:
    with pytest.raises(DataError, match=r"line 703, column 'time'"):
        outline(case("r15_header_twice"))


# -- instruments


def scope(number: int) -> str:
    return f"{FORCE[number]:.6e}"


TEKTRONIX_BESIDE = "".join(
    f"{left},,{T[k] - 1.0:.12f},{FORCE[k]:.5f},\n"
    for k, left in enumerate(
        ["Record Length,3.000000e+02", "Sample Interval,1.000000e-02", "Trigger Point,1.5e+02", "Source,CH1",
         "Vertical Units,V", "Vertical Scale,1.0e+00", "Horizontal Units,s"] + [","] * (N - 7)
    )
)  # fmt: skip
TEKTRONIX = (
    "Model,MSO24\nFirmware Version,1.28\n\nWaveform Type,ANALOG\nHorizontal Units,s\nSample Interval,0.01\n"
    "Record Length,300\nVertical Units,V,A\n,\nLabels,,\nTIME,CH1,CH2\n"
    + "".join(f"{T[k]:.6e},{FORCE[k]:.5f},{PLACE[k]:.5f}\n" for k in range(N))
)
LECROY = (
    "LECROYHDO4034,52731,Waveform\nSegments,1,SegmentSize,300\nSegment,TrigTime,TimeSinceSegment1\n"
    "#1,04-Mar-2025 09:58:50,0\nTime,Ampl\n" + "".join(f"{T[k]:.6e},{FORCE[k]:.5f}\n" for k in range(N))
)
KEYSIGHT = "x-axis,1\nsecond,Volt\n" + "".join(f"{T[k] - 1.0:.6E},{FORCE[k]:.5E}\n" for k in range(N))
COMSOL = "% Model: beam\n% Version: 6\n% Time (s)   Force (N)\n" + "".join(
    f"{T[k]:.4f}   {FORCE[k]:.5f}\n" for k in range(N)
)


@pytest.mark.parametrize(
    ("text", "reading", "unit"),
    [(TEKTRONIX_BESIDE, "CH1", "V"), (TEKTRONIX, "CH1", "V"), (LECROY, "Ampl", ""), (KEYSIGHT, "1", "V"),
     (COMSOL, "Force", "N")],
    ids=["tektronix beside", "tektronix above", "lecroy", "keysight", "comments"],
)  # fmt: skip
def test_files_of_instruments_are_read(tmp_path: Path, text: str, reading: str, unit: str) -> None:
    got = read_table(write(tmp_path, text))
    np.testing.assert_allclose(got.column(reading, "run.csv"), FORCE, atol=6e-5)
    assert got.units.get(reading, "") == unit
    assert find_time(got, "run.csv").clock.dt == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("head", "encoding"),
    [
        ("時間(秒),荷重(N),変位(mm)", "cp932"), ("Время (с),Сила (Н),Перемещение (мм)", "cp1251"),
        ("Zeit (s),Kraft (N),Größe (µm)", "latin-1"), ("時間(秒),荷重(N),変位(mm)", "utf-16"),
    ],
)  # fmt: skip
def test_headers_in_other_encodings_are_read(tmp_path: Path, head: str, encoding: str) -> None:
    body = "".join(f"{T[k]:.2f},{FORCE[k]:.5f},{PLACE[k]:.5f}\n" for k in range(N))
    found = outline(write(tmp_path, head + "\n" + body, encoding))
    assert [found.time, *(c.name for c in found.columns)] == head.split(",")
    assert found.drive is not None
    assert found.drive.unit == "N"


def test_comments_between_rows_are_left_out(tmp_path: Path) -> None:
    lines = [f"{T[k]:.2f},{FORCE[k]:.5f}" for k in range(N)]
    got = read_table(write(tmp_path, "time,force\n" + "\n".join([*lines[:50], "# the door opened", *lines[50:]])))
    assert got.columns["force"].size == N


# -- the true reason


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("r05_dup_rows", r"line 303\).*2 such samples in all: remove the repeated sample"),
        ("r05_swapped_rows", r"line 504\).*exchanged: sort the samples by time"),
        ("r04_whole_seconds", r"rounded to 1 s.*line 103\).*give rate = 100 in place"),
    ],
)
def test_the_reason_for_an_uneven_time_is_told(name: str, says: str) -> None:
    with pytest.raises(DataError, match=says):
        outline(case(name))


def uneven(kind: str) -> np.ndarray:
    time = T.copy()
    if kind == "swapped":
        time[[40, 41]] = time[[41, 40]]
    elif kind == "repeated":
        time = np.insert(time, 40, time[39])[:N]
    elif kind == "restarted":
        time = np.concatenate([time[: N // 2], time[: N - N // 2]])
    else:
        time = np.floor(time)
    return time


@pytest.mark.parametrize(
    ("kind", "says"),
    [
        ("swapped", r"\(sample 41, line 43\).*exchanged"),
        ("repeated", r"\(sample 40, line 42\).*remove the repeated sample"),
        ("restarted", r"\(sample 150, line 152\).*the clock starts again there"),
        ("rounded", r"rounded to 1 s.*\(it first changes at sample 100, line 102\).*give rate = 100 "),
    ],
)
def test_uneven_times_say_what_is_wrong_with_them(tmp_path: Path, kind: str, says: str) -> None:
    body = "".join(f"{t:.2f},{FORCE[k]:.5f},{PLACE[k]:.5f}\n" for k, t in enumerate(uneven(kind)))
    with pytest.raises(DataError, match=says):
        outline(write(tmp_path, "time [s],force,position\n" + body))


def test_a_rate_warns_of_repeated_rows() -> None:
    path = case("r05_dup_rows")
    notes = outline_table(path, GivenRoles(rate=100.0)).clock.notes
    assert any("2 rows repeat the row before them (the first is sample 300, line 303)" in note for note in notes)


def test_a_machine_at_rest_repeats_no_rows(tmp_path: Path) -> None:
    body = "".join(f"{round(FORCE[k] / 20)},{round(PLACE[k] / 20)}\n" for k in range(N))
    assert outline_table(write(tmp_path, "force,position\n" + body), GivenRoles(rate=100.0)).clock.notes == ()


def test_what_was_found_is_in_the_first_line(tmp_path: Path) -> None:
    draft = write_first_case(case("r16_hobo"), tmp_path / "case.toml", GivenRoles(), Registry.discover())
    assert draft.found[0].startswith("run.csv: 1500 rows at 100 Hz, time in the column 'Date Time, GMT-07:00'")
    assert 'unit = "mm"' in draft.text


def test_full_names_are_kept(tmp_path: Path) -> None:
    got: Table = read_table(write(tmp_path, "time_s,force_N\n" + "".join(f"{t:.2f},{t}\n" for t in T)))
    assert got.full_names == ("time_s", "force_N")
    assert got.columns["force"] is got.columns["force_N"]


# -- one door


def test_analyse_finds_the_time_and_the_unit_that_init_finds(tmp_path: Path) -> None:
    source = load_source(case("r15_german"), WantedChannel(columns=("Weg",)), Registry())
    assert (source.dt, source.unit) == (pytest.approx(0.01), "mm")
    draft = write_first_case(case("r15_german"), tmp_path / "case.toml", GivenRoles(), Registry.discover())
    assert source.notes[0] == draft.found[0]


@pytest.mark.parametrize("name", ["r05_dup_rows", "r05_swapped_rows", "r04_whole_seconds"])
def test_every_door_gives_the_same_reason(tmp_path: Path, name: str) -> None:
    path, said = case(name), set()
    which = {"inputs": {"force": "force"}, "sensors": {"position": "position"}}
    for door in (
        lambda: outline(path),
        lambda: load_source(path, WantedChannel(columns=("position",)), Registry()),
        lambda: Recording.read(path, **which),
        lambda: Recording.read(path, time=outline_time(path), **which),
    ):
        with pytest.raises(DataError) as caught:
            door()
        said.add(str(caught.value))
    assert len(said) == 1, said


def outline_time(path: Path) -> str:
    return next(name for name in read_table(path).full_names if name.startswith("time"))


def test_a_recording_in_a_file_is_a_case_for_the_notebook(tmp_path: Path) -> None:
    rows = "".join(f"{10 * k},{FORCE[k]:.5f},{PLACE[k]:.5f}\n" for k in range(N))
    path = write(tmp_path, "t_ms,force_N,position_mm\n" + rows)
    made = make_case(path, "linear_oscillator", {"m": 2.0}, None, default())
    assert made.known == {"m": 2.0}
    assert "m" not in made.estimate
    assert made.recordings[0].rate == pytest.approx(100.0)
    assert made.recordings[0].notes[0].startswith("run.csv: 300 rows at 100 Hz, time in the column 't_ms' (ms)")


def test_identify_and_diagnose_take_a_recording(tmp_path: Path) -> None:
    path = write(tmp_path, "n,force\n" + "".join(f"{k},{FORCE[k]:.5f}\n" for k in range(N)))
    said = {
        CliRunner().invoke(main, [command, str(path), "--out", str(tmp_path / command)]).stderr.strip()
        for command in ("diagnose", "identify", "analyse")
    }
    assert len(said) == 1
    assert "'n' counts rows, and not seconds" in said.pop()
