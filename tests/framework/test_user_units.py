"""Units and names of columns as instruments and spreadsheets write them, and columns that cannot be read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion.errors import CaseError, DataError
from lostmotion.preparation.beginning import write_first_case
from lostmotion.quantities import si_factor
from lostmotion.recording import Recording
from lostmotion.recording.formats import read_table
from lostmotion.recording.outline import GivenRoles, outline_table
from lostmotion.recording.units import name_and_unit, strange_unit
from lostmotion.registry import default

N = 300
T = np.arange(N) / 100.0
FORCE = 40.0 * np.sin(7.0 * T)
PLACE = 3.0 * np.cos(7.0 * T)


def write(folder: Path, head: str, separator: str = ",", place: list[str] | None = None) -> Path:
    """Write a table of time, a force and a position in the units of its header."""
    shown = place or [f"{value:.4f}" for value in PLACE]
    rows = [separator.join((f"{t:.2f}", f"{f:.4f}", x)) for t, f, x in zip(T, FORCE, shown, strict=True)]
    (folder / "run.csv").write_text(f"{head}\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return folder / "run.csv"


@pytest.mark.parametrize(
    ("head", "force", "place"),
    [
        ("Zeit in s,Kraft in kN,Weg in mm", 1e3, 1e-3), ("t / s,F / kN,x / mm", 1e3, 1e-3),
        ("timeS,forceN,positionMm", 1.0, 1e-3), ("TIME (SEC),LOAD (KN),STROKE (IN)", 1e3, 0.0254),
        ("TIME_S,FORCE_N,POSITION_MM", 1.0, 1e-3), ("Time (s),Force (N),Pos (MM)", 1.0, 1e-3),
        ("Time {s},Force {daN},Position {um}", 10.0, 1e-6), ("Time <s>,Force <N>,Position <mm>", 1.0, 1e-3),
        ("Time [s],Force [N] Ch1,Position [mm] (LVDT)", 1.0, 1e-3), ("[s] Time,[kN] Force,[mm] Position", 1e3, 1e-3),
        ("Time:s,Force:N,Position:mm", 1.0, 1e-3), ("time@s,force@N,pos@mm", 1.0, 1e-3),
        ("t_s,load_lbf,pos_in", 4.4482216, 0.0254), ("Time (s),Load (lbs),Position (mils)", 4.4482216, 2.54e-5),
        ("Time (s),Torque (lb-ft),Angle (rev)", 1.3558179, 2 * np.pi), ("时间(秒),力(牛),位移(毫米)", 1.0, 1e-3),
        ("Time (s),Torque (oz-in),Angle (gon)", 0.0070615518, np.pi / 200), ("t_s,torque_mnm,angle_rad", 1e-3, 1.0),
        ("Время, с;Сила, кН;Перемещение, мкм", 1e3, 1e-6), ("Time (s),Force (kp),x (microns)", 9.80665, 1e-6),
        ("# units: s, kN, mm\nTime,Force,Position", 1e3, 1e-3), ("s,N,mm\nTime,Force,Position", 1.0, 1e-3),
        ("Time,Force,Position\nUnit: s,Unit: N,Unit: mm", 1.0, 1e-3), ("Time,Force,Position\nS,N,MM", 1.0, 1e-3),
        ("Time [s],Force [N],Pos [mm]\nfloat64,float64,float64", 1.0, 1e-3),
    ],
)  # fmt: skip
def test_units_are_read_as_they_are_written(tmp_path: Path, head: str, force: float, place: float) -> None:
    found = outline_table(write(tmp_path, head, ";" if ";" in head else ","), GivenRoles())
    assert found.dt == pytest.approx(0.01)
    assert found.drive is not None
    for column, values, factor in ((found.drive, FORCE, force), (found.response, PLACE, place)):
        si = column.values * si_factor(column.stated_unit, column.kind)[0]
        np.testing.assert_allclose(si, values * factor, rtol=1e-6, atol=1e-4 * factor)
        assert column.sure


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("acc_mps2", "m/s^2"), ("ax_ms2", "m/s^2"), ("vel_mmps", "mm/s"), ("w_radps", "rad/s"), ("omega_rads", "rad/s"),
        ("speed_deg_per_sec", "deg/s"), ("dq_rad_per_s", "rad/s"), ("Acceleration [G]", "g"), ("Field [G]", ""),
        ("gyro2 (dps)", "dps"), ("v3 (ips)", "ips"), ("Drehzahl in 1/min", "1/min"), ("TimeUS", "us"), ("timeMs", "ms"),
        ("millis", "ms"), ("sensor_A", ""), ("Position (raw)", ""), ("force_min", ""), ("lap_time_s", "s"),
        ("flag_IN", ""), ("encoderA", ""), ("load_position_mm", "mm"), ("x'", ""), ("Kraft", ""),
        ("pos_mm_raw", "mm"), ("mm_pos", "mm"), ("angle_deg_filtered", "deg"), ("v(mm/s)", "mm/s"), ("acc in g", "g"),
        ("Speed[rpm]", "rpm"), ("rpm_motor", "rpm"), ("RPM", "RPM"), ("deg", "deg"), ("acc_g_x", "g"), ("N_force", "N"),
        ("force_kn", "kN"), ("kN_load", "kN"), ("posMmFilt", "mm"), ("angleDeg1", "deg"), ("position mm (raw)", "mm"),
        ("pos_mm(filtered)", "mm"), ("Position-mm", "mm"), ("angle°", "°"), ("force_N_ch2", "N"), ("pos_mm.1", "mm"),
        ("vel_m_s_2", "m/s"), ("torque_Nm_cmd", "Nm"), ("time_ms_rel", "ms"), ("ms_time", "ms"), ("hub_cm", "cm"),
        ("Position [Millimeter]", "millimeter"), ("Time [sec.]", "sec"), ("theta_m", ""), ("q_m", ""), ("rad_pos", ""),
        ("in_pos", ""), ("min_time", ""), ("g_force", ""), ("Kp_pos", ""), ("pos_kp", ""), ("m1", ""), ("r_theta", ""),
        ("pos_x2", ""), ("pos_mm_x10", ""), ("a." * 60 + "mm", ""),
    ],
)  # fmt: skip
def test_a_unit_in_a_name(name: str, unit: str) -> None:
    assert name_and_unit(name)[1] == unit


@pytest.mark.parametrize(
    ("name", "word"),
    [
        ("Pos [mm pk-pk]", "mm pk-pk"), ("Pos [x 0.001 m]", "x 0.001 m"), ("Pos [mm]", ""), ("q[0]", ""),
        ("Pos (raw)", ""), ("Pos [-]", ""), ("pos_mm_x10", "x10"), ("Pos (mm x 1000)", "mm x 1000"),
        ("Pos (mm*100)", "mm*100"), ("Pos [1e-3 m]", "1e-3 m"), ("Pos [0.1mm]", "0.1mm"), ("Pos in 0.1 mm", "in 0.1"),
        ("pos_x2", ""), ("v2 (m/s^2)", ""), ("Pos (ch 1)", ""),
    ],
)  # fmt: skip
def test_a_word_in_brackets_that_is_no_unit(name: str, word: str) -> None:
    assert strange_unit(name) == word


@pytest.mark.parametrize("head", ["Time [s],Force [N],Pos [mm pk-pk]", "Time [s],Force [N],Pos [kg]"])
def test_a_unit_that_is_not_known_is_asked_about(tmp_path: Path, head: str) -> None:
    path = write(tmp_path, head)
    with pytest.raises(CaseError, match="which is unknown or measures no position of a machine"):
        write_first_case(path, tmp_path / "case.toml", GivenRoles(), default())
    name = head.rpartition(",")[2]
    draft = write_first_case(path, tmp_path / "case.toml", GivenRoles(units={name: "mm"}), default())
    assert 'unit = "mm"' in draft.text


@pytest.mark.parametrize(
    ("cells", "says"),
    [
        ([f"{x:.3f} mm" for x in PLACE[:-1]] + ["1.5 um"], "write one unit"),
        ([f"{x:.3f} mm" for x in PLACE], "the cell is in mm and the header says m: write one unit"),
        ([f"{1e3 * x:.2f}m" for x in PLACE], "may be in metres or in thousandths"),
        ([f"({-x:.3f})" if x < 0 else f"{x:.3f}" for x in PLACE], "is not a number: correct or empty it"),
        ([f"{x:.3f}" for x in PLACE[:-1]] + ["oops"], "line 301, column 'Pos [m]': 'oops' is not a number"),
    ],
)
def test_the_reason_of_a_column_that_cannot_be_read(tmp_path: Path, cells: list[str], says: str) -> None:
    path = write(tmp_path, "Time [s],Force [N],Pos [m]", place=cells)
    with pytest.raises(DataError, match="no column that may be a response") as caught:
        outline_table(path, GivenRoles())
    assert says in str(caught.value)
    with pytest.raises(DataError) as caught:
        Recording.read(path, inputs={"force": "Force"}, sensors={"position": "Pos"})
    assert says in str(caught.value)
    done = CliRunner().invoke(main, ["analyse", str(path), "--column", "Pos [m]"])
    assert (done.exit_code, says in done.stderr) == (2, True)


def test_a_force_that_cannot_be_read_is_not_left_out_in_silence(tmp_path: Path) -> None:
    head, decaying = "Time [s],Pos [mm],Force [N]", 3.0 * np.exp(-T) * np.cos(20.0 * T)
    rows = [f"{t:.2f},{x:.4f},{abs(f):.3f}{'-' if f < 0 else ''}" for t, x, f in zip(T, decaying, FORCE, strict=True)]
    (tmp_path / "run.csv").write_text(f"{head}\n" + "\n".join(rows) + "\n")
    with pytest.raises(DataError, match=r"'Force \[N\]'.* is not a number.*--drive none"):
        outline_table(tmp_path / "run.csv", GivenRoles())
    assert outline_table(tmp_path / "run.csv", GivenRoles(drive="none")).drive is None


def test_a_column_of_words_is_named_by_init(tmp_path: Path) -> None:
    rows = [f"{t:.2f},{f:.4f},{x:.4f},ok" for t, f, x in zip(T, FORCE, PLACE, strict=True)]
    (tmp_path / "run.csv").write_text("Time [s],Force [N],Pos [mm],State\n" + "\n".join(rows) + "\n")
    done = CliRunner().invoke(main, ["init", str(tmp_path / "run.csv"), "--out", str(tmp_path / "case.toml")])
    assert done.exit_code == 0, done.output
    assert "not read: run.csv, line 2, column 'State': 'ok' is not a number" in done.output


@pytest.mark.parametrize("word", ["OVLD", "#DIV/0!", "<NA>", "*******", "#WERT!", "Overload", "NaT", "欠測", "No Data",
                                  "BURN OUT", "n.a.", "--.--", "+OVER", "#####", "1.#IND", "Sensor Error"])  # fmt: skip
def test_words_of_missing_readings(tmp_path: Path, word: str) -> None:
    path = write(tmp_path, "Time [s],Force [N],Pos [mm]", place=["0.1", word, *(f"{x:.4f}" for x in PLACE[2:])])
    column = read_table(path).columns["Pos"]
    assert np.flatnonzero(np.isnan(column)).tolist() == [1]


@pytest.mark.parametrize(
    ("cell", "number"),
    [('="1.25"', 1.25), ("１．２５", 1.25), ("\u22121.25", -1.25), ("1.25D+00", 1.25), ("+1.25", 1.25)],
)
def test_cells_of_spreadsheets(tmp_path: Path, cell: str, number: float) -> None:
    path = write(tmp_path, "Time [s];Force [N];Pos [mm]", ";", [cell, *(f"{x:.4f}" for x in PLACE[1:])])
    assert read_table(path).columns["Pos"][0] == number


def test_bars_separate_cells(tmp_path: Path) -> None:
    found = outline_table(write(tmp_path, "Time [s] | Force [N] | Pos [mm]", " | "), GivenRoles())
    assert (found.dt, found.response.unit) == (pytest.approx(0.01), "mm")


@pytest.mark.parametrize("name", ["encoder", "left_ticks", "delta_counts", "adc", "enc_cnt"])
def test_counts_of_unknown_size_are_asked_about(tmp_path: Path, name: str) -> None:
    path = write(tmp_path, f"Time [s],Force [N],{name}", place=[f"{7.0 * x:.0f}" for x in PLACE])
    with pytest.raises(DataError, match=f"{name!r} holds counts, whose size is unknown"):
        outline_table(path, GivenRoles())


@pytest.mark.parametrize(("bits", "noted"), [(16, True), (17, False)])
def test_a_counter_that_overflows_is_noted(tmp_path: Path, bits: int, noted: bool) -> None:
    counts = [f"{int(9000.0 * x) % 2**bits}" for x in PLACE]
    read = Recording.read(
        write(tmp_path, "Time [s],Force [N],Pos [um]", place=counts),
        inputs={"force": "Force"}, sensors={"position": "Pos"},
    )  # fmt: skip
    assert any("a counter of 16 bits that overflows?" in note for note in read.notes) == noted


def test_a_square_wave_of_whole_numbers_overflows_not(tmp_path: Path) -> None:
    square = [f"{200 * (x > 0)}" for x in PLACE]
    read = Recording.read(
        write(tmp_path, "Time [s],Force [N],Pos [um]", place=square), inputs={"force": "Force"},
        sensors={"position": "Pos"},
    )  # fmt: skip
    assert not any("overflows" in note for note in read.notes)


@pytest.mark.parametrize(
    ("head", "force", "place"),
    [
        ("t_s,force_kn,pos_mm_raw", 1e3, 1e-3), ("t_s,torque_Nm,RPM", 1.0, np.pi / 30),
        ("t_s,torque_Nm,deg", 1.0, np.pi / 180),
        ("Time (Seconds),Load (Kilonewtons),Position (Millimetres)", 1e3, 1e-3), ("t_s,N_force,acc_g_x", 1.0, 9.80665),
        ("t_s,force_N,accel (milli-g)", 1.0, 9.80665e-3),
    ],
)  # fmt: skip
def test_every_door_reads_the_unit_of_a_name(tmp_path: Path, head: str, force: float, place: float) -> None:
    path = write(tmp_path, head)
    found = outline_table(path, GivenRoles())
    assert found.drive is not None
    drive, seen = found.drive, found.response
    frame = pd.read_csv(path)
    which = {"inputs": {"torque" if "torque" in head else "force": drive.name}, "sensors": {seen.kind: seen.name}}
    for read in (Recording.read(path, **which), Recording.from_pandas(frame, **which)):
        np.testing.assert_allclose(read.inputs[0], FORCE * force, atol=1e-4 * force)
        np.testing.assert_allclose(read.sensors[0], PLACE * place, atol=1e-4 * place)


@pytest.mark.parametrize("encoding", ["cp437", "cp850", "utf-16-be", "utf-32", "cp1252", "mac_roman"])
def test_a_micro_sign_in_old_encodings(tmp_path: Path, encoding: str) -> None:
    path = write(tmp_path, "Zeit [s],Kraft [N],Weg [µm]")
    path.write_bytes(path.read_text(encoding="utf-8").encode(encoding))
    assert outline_table(path, GivenRoles()).response.unit == "µm"
