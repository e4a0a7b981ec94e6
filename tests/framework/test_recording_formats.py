"""Each format, there and back; and what a damaged file is told."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import h5py
import numpy as np
import pytest
import scipy.io
import xarray as xr

from lostmotion.errors import DataError
from lostmotion.recording.formats import table_of

N = 150
TIME = np.arange(N) / 1000
COLUMNS = {"time": TIME, "force": np.sin(40 * TIME), "x": np.cos(40 * TIME)}
TABLE = np.column_stack(list(COLUMNS.values()))


def to_csv(path: Path) -> None:
    np.savetxt(path, TABLE, fmt="%.17g", delimiter=",", header="time,force,x", comments="")


def to_hash_csv(path: Path) -> None:
    np.savetxt(path, TABLE, fmt="%.17g", delimiter=",", header="made by hand\ntime,force,x")


def to_excel_csv(path: Path) -> None:
    rows = "\r\n".join(";".join(f"{v:.17g}" for v in row) for row in TABLE).replace(".", ",")
    path.write_bytes(("\ufefftime; force;x\r\n" + rows + "\r\n\r\n").encode())


def to_utf16(path: Path) -> None:
    to_csv(path)
    path.write_bytes(path.read_text().encode("utf-16"))


def to_blanks(path: Path) -> None:
    np.savetxt(path, TABLE, fmt="%.17g", header="time force x", comments="")


def to_words(path: Path) -> None:
    rows = "\n".join(",".join(f'"{v:.17g}"' for v in row) + ",ok," for row in TABLE)
    path.write_text("# log 7\ntime,force,x,state,\n" + rows)


def to_npz(path: Path) -> None:
    np.savez(path, **COLUMNS, fs=1000.0, label=np.array("run"))


def to_mat5(path: Path) -> None:
    scipy.io.savemat(path, {k: v[:, None] for k, v in COLUMNS.items()} | {"gtau": 3.0, "note": "words"})


def to_mat73(path: Path) -> None:
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, column in COLUMNS.items():
            file.create_dataset(name, data=column[None, :]).attrs["MATLAB_class"] = np.bytes_("double")
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: test".ljust(124) + b"\x00\x02IM")


def to_nc(path: Path) -> None:
    dataset().to_netcdf(path, engine="h5netcdf")


def to_nc3(path: Path) -> None:
    dataset().to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")


def dataset() -> xr.Dataset:
    names = {k: ("time", v) for k, v in COLUMNS.items() if k != "time"}
    return xr.Dataset(names, {"time": ("time", TIME, {"units": "seconds"})})


def to_h5(path: Path) -> None:
    with h5py.File(path, "w") as file:
        for name, column in COLUMNS.items():
            file[name] = column


def to_uff(path: Path) -> None:
    pyuff = pytest.importorskip("pyuff", reason="the extra uff is not installed")
    for name in ("force", "x"):
        pyuff.UFF(str(path)).write_sets([function(pyuff, name)], "add")


def function(pyuff: ModuleType, name: str) -> dict[str, object]:
    head = pyuff.prepare_58(
        binary=0, id1=name, func_type=1, rsp_node=1, rsp_dir=1, ref_node=1, ref_dir=1, data=COLUMNS[name], x=TIME,
        abscissa_spacing=1, abscissa_min=0.0, abscissa_inc=0.001, num_pts=N, ord_data_type=4,
    )  # fmt: skip
    return {"orddenom_spec_data_type": 0, "z_axis_spec_data_type": 0} | head


WAYS: list[tuple[str, Callable[[Path], None]]] = [
    ("csv", to_csv), ("csv", to_hash_csv), ("csv", to_excel_csv), ("csv", to_utf16), ("txt", to_blanks),
    ("csv", to_words), ("npz", to_npz), ("mat", to_mat5), ("mat", to_mat73), ("nc", to_nc), ("nc", to_nc3),
    ("h5", to_h5), ("mat", to_h5), ("h5", to_nc), ("uff", to_uff),
]  # fmt: skip


@pytest.mark.parametrize(("ending", "write"), WAYS, ids=lambda v: getattr(v, "__name__", v))
def test_round_trip(tmp_path: Path, ending: str, write: Callable[[Path], None]) -> None:
    path = tmp_path / f"run.{ending}"
    write(path)
    columns = table_of(path).columns
    assert {k for k in columns if not k.startswith("58[")} == {"time", "force", "x"}
    for name, column in COLUMNS.items():
        assert columns[name].dtype == np.float64
        np.testing.assert_allclose(columns[name], column, rtol=0, atol=1e-11 if ending == "uff" else 0)


@pytest.mark.parametrize("write", [to_npz, to_mat5, to_mat73, to_nc, to_h5, to_uff], ids=lambda w: w.__name__)
@pytest.mark.parametrize("keep", [0, 0.3, 0.9])
def test_a_file_cut_short_is_told_so(tmp_path: Path, write: Callable[[Path], None], keep: float) -> None:
    path = tmp_path / f"run.{write.__name__.removeprefix('to_').rstrip('573')}"
    path = path.with_suffix(".h5") if write is to_h5 else path
    write(path)
    raw = path.read_bytes()
    path.write_bytes(raw[: int(keep * len(raw))])
    with pytest.raises(DataError) as caught:
        table_of(path)
    assert path.name in str(caught.value)


@pytest.mark.parametrize("ending", ["csv", "npz", "mat", "nc", "h5", "uff"])
def test_garbage_is_told_so(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"run.{ending}"
    path.write_bytes(np.random.default_rng(1).bytes(5000))
    with pytest.raises(DataError, match=rf"run\.{ending}"):
        table_of(path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0.0,1.0\n0.1,2.0\n", ["header line"]),
        ("time,x\n", ["no numbers below"]),
        (" \n\n", ["blank"]),
        ("time,x\n0,1\n1,2,3\n", ["line 3", "3 cells", "2 columns"]),
        ("time,x\n0,001,1,5\n0,002,1,6\n", ["line 2", "decimal commas", "';'"]),
        ("time,x\n0,1\n\n1,oops\n", ["line 4", "'x'", "'oops'", "not a number"]),
        ("time,x\nlow,1\n0,1\n", ["line 2", "'time'", "'low'"]),
        ("time;x\n0,5;1.000.5\n", ["line 2", "'x'"]),
        ("time,x,x\n0,1,2\n", ["two columns named 'x'"]),
        ("one,two\na,b\n", ["line 2", "'one'", "'a' is not a number"]),
    ],
)
def test_bad_csv(tmp_path: Path, text: str, words: list[str]) -> None:
    path = tmp_path / "run.csv"
    path.write_text(text)
    with pytest.raises(DataError) as caught:
        [table_of(path).column(name, path.name) for name in ("time", "x")]
    message = str(caught.value)
    assert [w for w in ["run.csv", *words] if w not in message] == [], message


def test_empty_cells_are_lost_samples(tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_text("time,x\n0,1\n1,\n2,NaN\n")
    np.testing.assert_array_equal(table_of(tmp_path / "run.csv").columns["x"], [1, np.nan, np.nan])


def test_object_arrays_are_refused(tmp_path: Path) -> None:
    np.savez(tmp_path / "run.npz", x=np.array([{}, {}], dtype=object))
    with pytest.raises(DataError, match="could run code"):
        table_of(tmp_path / "run.npz")


def test_structures_and_groups_give_dotted_names(tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "run.mat", {"log": {"x": TIME, "deep": {"y": TIME}}})
    assert set(table_of(tmp_path / "run.mat").columns) == {"log.x", "log.deep.y"}
    with h5py.File(tmp_path / "run.h5", "w") as file:
        file["log/x"] = TIME
        file["log/blocks"] = np.zeros((3, N))
    assert set(table_of(tmp_path / "run.h5").columns) == {"log/x", *(f"log/blocks[{i}]" for i in range(3))}


def test_packed_netcdf_is_unpacked(tmp_path: Path) -> None:
    dataset().to_netcdf(tmp_path / "run.nc", engine="h5netcdf", encoding={
        "x": {"dtype": "int16", "scale_factor": 1e-3, "_FillValue": -32768}})  # fmt: skip
    np.testing.assert_allclose(table_of(tmp_path / "run.nc").columns["x"], COLUMNS["x"], atol=6e-4)


def test_wrong_places(tmp_path: Path) -> None:
    (tmp_path / "dir.csv").mkdir()
    with pytest.raises(DataError, match="is a folder"):
        table_of(tmp_path / "dir.csv")
    with pytest.raises(DataError, match="too long"):
        table_of(tmp_path / ("x" * 300 + ".csv"))
    with (tmp_path / "one.npz").open("wb") as file:
        np.save(file, TIME)
    with pytest.raises(DataError, match="single array"):
        table_of(tmp_path / "one.npz")
    with pytest.raises(DataError, match="expected one of csv"):
        table_of(tmp_path / "run.doc")
