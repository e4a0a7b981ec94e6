"""Files of scopes and controllers whose settings stand in a block above the rows: Yokogawa, TwinCAT, Rigol."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.recording import Table, read_table
from lostmotion.recording.clock import find_time

N = 300
T = np.arange(N) / 100.0
FORCE = np.round(40.0 * np.sin(7.0 * T), 4)
PLACE = np.round(30.0 * np.cos(7.0 * T), 4)
MS = [f"{10 * k}" for k in range(N)]


def write(folder: Path, text: str) -> Table:
    (folder / "run.csv").write_text(text, encoding="utf-8")
    return read_table(folder / "run.csv")


def join(separator: str, *columns: list[str]) -> str:
    return "".join(separator.join(cells) + "\n" for cells in zip(*columns, strict=True))


def shown(values: np.ndarray, mark: str = ".") -> list[str]:
    return [f"{value:.4f}".replace(".", mark) for value in values]


def check(table: Table, start: float = 0.0) -> None:
    found = find_time(table, "run.csv")
    assert (found.column, found.clock.dt, found.clock.start) == ("time", pytest.approx(0.01), pytest.approx(start))
    for name, values, unit in (("Force", FORCE, "N"), ("Pos", PLACE, "mm")):
        np.testing.assert_allclose(table.column(name, "run.csv"), values, atol=1e-9)
        assert table.units[name] == unit


def yokogawa(steps: str = "1.0E-02,1.0E-02", size: int = N) -> str:
    return (
        '"Model Name","DL850"\n"BlockNumber",1\n"TraceName","Force","Pos"\n'
        f'"BlockSize",{size},{size}\n"Date","2025/03/04","2025/03/04"\n"Time","09:58:50.00","09:58:50.00"\n'
        f'"VUnit","N","mm"\n"HResolution",{steps}\n"HOffset",-1.0E+00,-1.0E+00\n"HUnit","s","s"\n\n'
    )


@pytest.mark.parametrize("columns", [[[""] * N], [], [['""'] * N]])
def test_a_file_of_yokogawa_has_start_and_step_of_its_header(tmp_path: Path, columns: list[list[str]]) -> None:
    check(write(tmp_path, yokogawa() + join(",", *columns, shown(FORCE), shown(PLACE))), start=-1.0)


def test_a_channel_of_another_rate_is_refused_where_it_is_asked_for(tmp_path: Path) -> None:
    table = write(tmp_path, yokogawa("1.0E-02,2.0E-02") + join(",", shown(FORCE), shown(PLACE)))
    np.testing.assert_allclose(table.column("Force", "run.csv"), FORCE)
    with pytest.raises(DataError, match=r"'Pos' has samples every 0.02 s .* 'Force' every 0.01 s.* of one rate"):
        table.column("Pos", "run.csv")


def test_several_blocks_are_asked_about(tmp_path: Path) -> None:
    with pytest.raises(DataError, match="300 rows and its BlockSize is 100, so there are several blocks: export one"):
        write(tmp_path, yokogawa(size=100) + join(",", shown(FORCE), shown(PLACE)))


TOP = (
    "Name\tScope Project\nFile\trun.svdx\nStarttime of export\t133964386997165000\tTuesday\t10:00:00.000\n"
    "Endtime of export\t133964388292505000\tTuesday\t10:30:00.000\n\n"
)
SETTINGS = {
    "Name": ("Force", "Pos"), "SymbolComment": ("", ""), "Data-Type": ("REAL64", "REAL64"),
    "SampleTime[ms]": ("10", "10"), "VariableSize": ("8", "8"), "SymbolName": ("MAIN.f", "MAIN.x"),
    "Port": ("851", "851"), "Offset": ("0", "0"), "ScaleFactor": ("1", "1"), "BitMask": ("0xff", "0xff"),
    "Unit": ("N", "mm"),
}  # fmt: skip


def twincat(*, one_time: bool, **changed: tuple[str, str]) -> str:
    lines = (
        "\t".join((key, first, second) if one_time else (key, first, key, second))
        for key, (first, second) in (SETTINGS | changed).items()
    )
    return TOP + "\n".join(lines) + "\n\n"


@pytest.mark.parametrize("mark", [".", ","])
@pytest.mark.parametrize("end", ["", "EOF\n"])
def test_an_export_of_twincat_has_a_time_for_each_channel(tmp_path: Path, mark: str, end: str) -> None:
    body = join("\t", MS, shown(FORCE, mark), MS, shown(PLACE, mark))
    check(write(tmp_path, twincat(one_time=False) + body + end))


def test_an_export_of_twincat_has_one_time(tmp_path: Path) -> None:
    check(write(tmp_path, twincat(one_time=True) + join("\t", MS, shown(FORCE), shown(PLACE))))


def test_an_export_of_twincat_has_file_times(tmp_path: Path) -> None:
    times = [f"{133964386997165000 + 100_000 * k}" for k in range(N)]
    check(write(tmp_path, twincat(one_time=True) + join("\t", times, shown(FORCE), shown(PLACE))))


def test_channels_of_other_times_are_refused_where_they_are_asked_for(tmp_path: Path) -> None:
    late = [f"{10 * k + 5}" for k in range(N)]
    table = write(tmp_path, twincat(one_time=False) + join("\t", MS, shown(FORCE), late, shown(PLACE)))
    np.testing.assert_allclose(table.column("Force", "run.csv"), FORCE)
    with pytest.raises(DataError, match="'Pos' has other times than 'Force': export both with one time line"):
        table.column("Pos", "run.csv")


@pytest.mark.parametrize(("key", "cells"), [("ScaleFactor", ("1", "2")), ("Offset", ("0", "0,5"))])
def test_a_scaled_channel_is_asked_about(tmp_path: Path, key: str, cells: tuple[str, str]) -> None:
    body = join("\t", MS, shown(FORCE), MS, shown(PLACE))
    table = write(tmp_path, twincat(one_time=False, **{key: cells}) + body)
    with pytest.raises(DataError, match=rf"'Pos' has the setting {key} {cells[1]}, and whether its numbers contain it"):
        table.column("Pos", "run.csv")


def test_a_rigol_without_a_column_of_the_time(tmp_path: Path) -> None:
    table = write(tmp_path, "CH1V,CH2V,t0 = -1.0, tInc = 1.0e-02\n" + join(",", shown(FORCE), shown(PLACE)))
    np.testing.assert_allclose(table.column("CH1", "run.csv"), FORCE)
    assert (table.units["CH2"], table.columns["time"][:2].tolist()) == ("V", [-1.0, -0.99])
