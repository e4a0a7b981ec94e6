"""Data frames and arrays that users bring: masks, missing readings, indices and calendar times."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pandas as pd
import pytest
import xarray as xr

from lostmotion.errors import DataError
from lostmotion.recording import Recording

N = 400
T = np.arange(N) / 100.0
FORCE = 5.0 * np.sin(7.0 * T)
PLACE = np.cos(7.0 * T)
GONE = np.arange(N) % 40 == 3
MARK = 9999.0
MARKED = np.where(GONE, MARK, PLACE)
WHICH: dict[str, Any] = {"inputs": {"force": "force_N"}, "sensors": {"position": "position_mm"}}
UNITS = {"force": "N", "position": "mm"}


def check(made: Recording, *, lost: bool = True) -> None:
    """The rate is 100 Hz, lost readings are NaN, and no other number has changed."""
    assert made.rate == pytest.approx(100.0)
    wanted = np.where(GONE & lost, np.nan, 1e-3 * PLACE)
    np.testing.assert_allclose(np.asarray(made.sensors[0]), wanted, atol=1e-12)
    np.testing.assert_allclose(np.asarray(made.inputs[0]), FORCE, atol=1e-12)


def frame(place: Any, **more: Any) -> pd.DataFrame:
    return pd.DataFrame({"time_s": T, "force_N": FORCE, "position_mm": place, **more})


MASKS: dict[str, Callable[[], Any]] = {
    "numpy.ma": lambda: np.ma.masked_array(MARKED, mask=GONE),
    "numpy.ma of objects": lambda: np.ma.masked_array(MARKED.astype(object), mask=GONE),
    "pandas Float64": lambda: pd.array(np.where(GONE, None, PLACE), dtype="Float64"),
    "pandas objects": lambda: pd.Series([pd.NA if gone else x for gone, x in zip(GONE, PLACE, strict=True)]),
    "list with None": lambda: [None if gone else x for gone, x in zip(GONE, PLACE, strict=True)],
    "xarray": lambda: xr.DataArray(PLACE, dims="time").where(~GONE),
}


@pytest.mark.parametrize("make", MASKS.values(), ids=MASKS)
def test_what_lies_under_a_mask_is_no_reading(make: Callable[[], Any]) -> None:
    check(Recording.from_arrays(T, sensors={"position": make()}, inputs={"force": FORCE}, units=UNITS))


@pytest.mark.parametrize("name", ["pandas Float64", "pandas objects", "list with None"])
def test_missing_readings_of_a_frame_stay_missing(name: str) -> None:
    check(Recording.from_pandas(frame(MASKS[name]()), **WHICH))


def test_missing_whole_numbers_stay_missing() -> None:
    counts = pd.array([None if gone else round(1e6 * x) for gone, x in zip(GONE, PLACE, strict=True)], dtype="Int64")
    made = Recording.from_pandas(frame(counts), units={"position_mm": "nm"}, **WHICH)
    assert np.flatnonzero(np.isnan(made.sensors[0])).tolist() == np.flatnonzero(GONE).tolist()


@pytest.mark.parametrize("null", ["null", "masked"])
def test_a_frame_of_polars_is_read(null: str) -> None:
    polars = pytest.importorskip("polars", reason="polars is not installed")
    place = MASKS["list with None"]() if null == "null" else polars.Series(PLACE).set(polars.Series(GONE), None)
    check(Recording.from_pandas(polars.DataFrame({"t_ms": 1e3 * T, "force_N": FORCE, "position_mm": place}), **WHICH))


@pytest.mark.parametrize("attribute", ["_FillValue", "missing_value"])
def test_fill_values_of_a_dataset_become_nan(attribute: str) -> None:
    place = ("time", MARKED, {"units": "mm", attribute: MARK})
    data = xr.Dataset({"force_N": ("time", FORCE), "position_mm": place}, {"time": ("time", 1e3 * T, {"units": "ms"})})
    check(Recording.from_xarray(data, **WHICH))


def test_packed_numbers_of_a_dataset_are_unpacked() -> None:
    packed = np.where(GONE, -1, np.rint(PLACE * 1000 + 2000)).astype(np.int32)
    attrs = {"units": "mm", "scale_factor": 1e-3, "add_offset": -2.0, "_FillValue": np.int32(-1)}
    data = xr.Dataset({"force_N": ("time", FORCE), "position_mm": ("time", packed, attrs)}, {"time": ("time", T)})
    made = Recording.from_xarray(data, **WHICH)
    np.testing.assert_allclose(np.asarray(made.sensors[0]), np.where(GONE, np.nan, 1e-3 * PLACE), atol=6e-7)


@pytest.mark.parametrize("named", [None, "time"])
def test_an_index_that_counts_rows_is_no_time(named: str | None) -> None:
    bare = pd.DataFrame({"force_N": FORCE, "position_mm": PLACE}).rename_axis(named)
    with pytest.raises(DataError, match="--rate HZ"):
        Recording.from_pandas(bare, **WHICH)
    check(Recording.from_pandas(bare, rate=100.0, **WHICH), lost=False)


INDICES = {
    "dates": pd.date_range("2025-03-04", periods=N, freq="10ms"),
    "dates of a zone": pd.date_range("2025-03-30 01:59:58", periods=N, freq="10ms", tz="Europe/Berlin"),
    "durations": pd.timedelta_range("0s", periods=N, freq="10ms"),
    "seconds": pd.Index(T),
}


@pytest.mark.parametrize("index", INDICES.values(), ids=INDICES)
def test_an_index_of_time_is_time(index: pd.Index) -> None:
    check(Recording.from_pandas(pd.DataFrame({"force_N": FORCE, "position_mm": PLACE}, index), **WHICH), lost=False)


CALENDARS: dict[str, Any] = {
    "datetime64[ns]": np.datetime64("2025-03-04", "ns") + (10**7 * np.arange(N)).astype("timedelta64[ns]"),
    "datetime64[ms]": np.datetime64("2025-03-04", "ms") + (10 * np.arange(N)).astype("timedelta64[ms]"),
    "datetime": [datetime(2025, 3, 4) + timedelta(milliseconds=10 * k) for k in range(N)],
    "datetime of a zone": [datetime(2025, 3, 4, tzinfo=UTC) + timedelta(milliseconds=10 * k) for k in range(N)],
    "words": [f"09:58:{t:06.3f}" for t in T],
}


@pytest.mark.parametrize("unit", [None, "ms"])
@pytest.mark.parametrize("time", CALENDARS.values(), ids=CALENDARS)
def test_calendar_times_have_no_unit(time: Any, unit: str | None) -> None:
    units = UNITS | ({"time": unit} if unit else {})
    made = Recording.from_arrays(time, sensors={"position": PLACE}, inputs={"force": FORCE}, units=units)
    check(made, lost=False)
    assert any("need no unit: 'ms' is not used" in note for note in made.notes) == (unit is not None)


def test_units_of_a_frame_are_those_of_its_attributes_and_names() -> None:
    data = pd.DataFrame({"t": 1e3 * T, "force_N": FORCE, "position_mm": PLACE})
    data.attrs["units"] = {"t": "ms", "force_N": "N"}
    check(Recording.from_pandas(data, **WHICH), lost=False)


def test_attributes_and_names_that_contradict_each_other_are_asked_about() -> None:
    data = pd.DataFrame({"t": 1e3 * T, "force_N": 1e-3 * FORCE, "position_mm": PLACE})
    data.attrs["units"] = {"t": "ms", "force_N": "kN"}
    with pytest.raises(DataError, match="the unit of 'force_N' is N by its name and kN beside it"):
        Recording.from_pandas(data, **WHICH)
    check(Recording.from_pandas(data, units={"force_N": "kN"}, **WHICH), lost=False)
    check(Recording.from_pandas(data, units={"force": "kN"}, **WHICH), lost=False)


def test_a_column_that_nobody_asked_for_refuses_no_frame() -> None:
    check(Recording.from_pandas(frame(PLACE, state=["idle"] * N, odd=[{}] * N), **WHICH), lost=False)
    with pytest.raises(DataError, match="'state' holds the word 'idle' instead of numbers"):
        Recording.from_pandas(
            frame(PLACE, state=["idle"] * N), inputs={"force": "state"}, sensors={"position": "force_N"}
        )


def test_what_was_taken_for_time_stands_in_the_notes() -> None:
    made = Recording.from_pandas(frame(PLACE), **WHICH)
    assert made.notes[0] == "time in the column 'time_s' (s): its name and its unit are those of time"


STAMPS = pd.date_range("2025-03-04 09:58:50", periods=N, freq="10ms")


@pytest.mark.parametrize(
    "index",
    [STAMPS, STAMPS.astype(str), STAMPS.to_period("ms"), STAMPS.tz_localize("Europe/Berlin"), STAMPS - STAMPS[0],
     pd.Index(STAMPS.as_unit("ns").astype("int64")), pd.Index(STAMPS.as_unit("ms").astype("int64"), name="stamp"),
     pd.Index(10 * np.arange(N), name="time_ms"), pd.Index(T)],
)  # fmt: skip
def test_an_index_that_is_time(index: pd.Index) -> None:
    data = pd.DataFrame({"force_N": FORCE, "position_mm": PLACE}).set_index(index)
    check(Recording.from_pandas(data, **WHICH), lost=False)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"time": 10 * np.arange(N)}, r"'time' holds whole numbers \(0, 10, 20, ...\) and no unit"),
        ({"force": [f"{f:.4f}".replace(".", ",") for f in FORCE]}, "instead of numbers.*decimal=','"),
        ({"force": np.zeros((N, 2))}, r"'force' has the shape \(\d+, 2\)"),
    ],
)
def test_columns_that_are_asked_about_at_each_door(changes: dict[str, object], says: str) -> None:
    columns = {"time": T, "force": FORCE, "position": PLACE} | changes
    given = {"units": {"force": "N", "position": "mm"}}
    roles = {"inputs": {"force": "force"}, "sensors": {"position": "position"}}
    data = {key: columns[key] for key in ("force", "position")}
    with pytest.raises(DataError, match=says):
        Recording.from_arrays(
            columns["time"], inputs={"force": data["force"]}, sensors={"position": data["position"]}, **given
        )
    if np.ndim(columns["force"]) == 1:
        with pytest.raises(DataError, match=says):
            Recording.from_pandas(pd.DataFrame(columns), **roles, **given)
    dims = {key: (("time", "k")[: np.ndim(value)], value) for key, value in columns.items()}
    with pytest.raises(DataError, match=says):
        Recording.from_xarray(xr.Dataset(dims), **roles, **given)


def test_a_column_of_matlab_and_a_dataset_with_another_name_of_time() -> None:
    made = Recording.from_arrays(
        T[:, None], inputs={"force": FORCE[:, None]}, sensors={"position": PLACE[None]},
        units={"force": "N", "position": "mm"},
    )  # fmt: skip
    assert made.rate == pytest.approx(100.0)
    data = xr.Dataset({"force": ("t", FORCE, {"units": "N"}), "pos": ("t", PLACE, {"units": "mm"})}, {"t": 1.0 * T})
    found = Recording.from_xarray(data, inputs={"force": "force"}, sensors={"position": "pos"})
    assert (found.rate, found.notes[0][:23]) == (pytest.approx(100.0), "time in the column 't' ")


def test_a_rate_that_contradicts_the_stamps_is_noted() -> None:
    data = pd.DataFrame({"force_N": FORCE, "position_mm": PLACE}, index=STAMPS)
    made = Recording.from_pandas(data, rate=1000.0, **WHICH)
    assert "the rate that is given is 1000 Hz, and 'index' has 100 Hz: one of them is wrong" in made.notes


def test_columns_of_one_name() -> None:
    data = pd.DataFrame(np.column_stack([T, FORCE, PLACE, PLACE]), columns=["time_s", "force_N", "p", "p"])
    with pytest.raises(DataError, match="frame has several columns named 'p': rename all but one"):
        Recording.from_pandas(data, inputs={"force": "force_N"}, sensors={"position": "p"}, units={"p": "mm"})


TABLE = np.rec.fromarrays([T, FORCE, PLACE], names=["time", "force_N", "position_mm"])


@pytest.mark.parametrize(
    ("values", "attributes"),
    [
        (PLACE, {"Unit": "mm"}), (PLACE, {"units": np.array([b"mm"])}), (1e-3 * PLACE, {"UNITS": "m"}),
        (np.where(np.arange(N) % 50 == 7, -9999.0, PLACE), {"units": "mm", "_FillValue": -9999.0}),
        (np.rint(1e4 * PLACE).astype(np.int32), {"units": "mm", "scale_factor": 1e-4}),
        (np.rint(1e4 * PLACE).astype(np.int32) + 5, {"units": "mm", "scale_factor": 1e-4, "add_offset": -5e-4}),
    ],
)  # fmt: skip
def test_attributes_of_hdf5_say_unit_fill_value_and_packing(
    tmp_path: Path, values: np.ndarray, attributes: dict[str, Any]
) -> None:
    with h5py.File(tmp_path / "run.h5", "w") as file:
        file["time"], file["force_N"] = T, FORCE
        file["position"] = values
        file["position"].attrs.update(attributes)
    which = {"inputs": {"force": "force_N"}, "sensors": {"position": "position"}}
    made = Recording.read(tmp_path / "run.h5", **which)
    lost = np.arange(N) % 50 == 7 if "_FillValue" in attributes else np.zeros(N, dtype=bool)
    np.testing.assert_allclose(made.sensors[0], np.where(lost, np.nan, 1e-3 * PLACE), atol=1e-7)


@pytest.mark.parametrize("ending", ["npz", "h5"])
def test_a_table_in_one_array(tmp_path: Path, ending: str) -> None:
    if ending == "npz":
        np.savez(tmp_path / "run.npz", table=TABLE)
    else:
        with h5py.File(tmp_path / "run.h5", "w") as file:
            file["table"] = TABLE
    which = {"inputs": {"force": "table.force_N"}, "sensors": {"position": "table.position_mm"}}
    check(Recording.read(tmp_path / f"run.{ending}", **which), lost=False)


def test_dates_in_an_archive_of_arrays(tmp_path: Path) -> None:
    dates = np.datetime64("2025-03-04T09:00:00") + (10 * np.arange(N)).astype("m8[ms]")
    np.savez(tmp_path / "run.npz", t=dates, force_N=FORCE, position_mm=PLACE, odd=1j * FORCE)
    check(Recording.read(tmp_path / "run.npz", **WHICH), lost=False)
    with pytest.raises(DataError, match="'odd' holds complex128 instead of numbers"):
        Recording.read(tmp_path / "run.npz", inputs={"force": "odd"}, sensors={"position": "position_mm"})


def test_a_matrix_of_which_one_column_is_the_time(tmp_path: Path) -> None:
    np.savez(tmp_path / "run.npz", X=np.column_stack([T, FORCE, PLACE]))
    made = Recording.read(
        tmp_path / "run.npz", inputs={"force": "X[1]"}, sensors={"position": "X[2]"}, units={"X[1]": "N", "X[2]": "mm"}
    )
    assert made.notes[0].startswith("time in the column 'X[0]' (s): it alone grows evenly")
