"""Samples that were lost or never taken: bridged in an input, counted in a sensor, refused where nothing is left."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from lostmotion.errors import CaseError, DataError
from lostmotion.recording.load import Recording
from lostmotion.recording.value_checks import check_sensor, fill_input

N = 3000
TIME = np.arange(N) / 1000
VALUES = np.sin(2 * np.pi * 30 * TIME)


def without(*lost: int) -> np.ndarray:
    values = VALUES.copy()
    values[list(lost)] = np.nan
    return values


def test_an_input_without_losses_is_itself() -> None:
    filled, notes = fill_input(VALUES, "u", "a.csv", "smooth")
    assert filled is VALUES
    assert notes == ()


def test_a_smooth_input_is_interpolated() -> None:
    lost = (0, 50, 51, 52, 700, N - 1)
    filled, (note,) = fill_input(without(*lost), "u", "a.csv", "smooth")
    np.testing.assert_allclose(filled[1:-1], VALUES[1:-1], atol=2e-3)
    assert (filled[0], filled[-1]) == (VALUES[1], VALUES[-2])
    assert "6 of 3000 samples (0.002 of all) are NaN, at most 3 in a row; they are interpolated" in note


def test_a_held_input_keeps_its_value() -> None:
    held = np.repeat(np.arange(N // 10), 10).astype(float)
    held[[10, 55]] = np.nan
    filled, (note,) = fill_input(held, "u", "a.csv", "step")
    assert (filled[10], filled[55]) == (0.0, 5.0)
    assert "the previous value" in note


@pytest.mark.parametrize("lost", [range(70, 74), range(0, N, 100), range(N)])
def test_more_is_refused(lost: range) -> None:
    with pytest.raises(DataError, match=r"a\.csv: u: .* are NaN, the first at sample .* fill them, or cut them out"):
        fill_input(without(*lost), "u", "a.csv", "smooth")


def test_a_slower_sensor_is_called_so() -> None:
    slow = without(*(k for k in range(N) if k % 10 != 3))
    assert check_sensor(slow, "the sensor 'x'", "a.csv", dt=1e-3) == (
        "the sensor 'x' has a reading in every 10th row (100 Hz)",
    )
    slow[[13, 503]] = np.nan
    assert check_sensor(slow, "x", "a.csv") == ("x has a reading in every 10th row",)
    twice = without(*range(1, N, 2))
    assert check_sensor(twice, "x", "a.csv", dt=1e-3) == ("x has a reading in every 2nd row (500 Hz)",)


def test_losses_at_no_regular_distance_are_counted() -> None:
    rng = np.random.default_rng(1)
    (note,) = check_sensor(without(*np.flatnonzero(rng.random(N) < 0.6)), "x", "a.csv", dt=1e-3)
    assert "at irregular distances" in note
    (note,) = check_sensor(without(5, 6, 900), "x", "a.csv", dt=1e-3)
    assert "3 of 3000" in note
    assert "at most 2 in a row" in note
    assert check_sensor(VALUES, "x", "a.csv") == ()


def test_a_sensor_without_readings_is_refused() -> None:
    with pytest.raises(DataError, match=r"a\.csv: x has no reading at all: check the sensor"):
        check_sensor(without(*range(N)), "x", "a.csv")
    with pytest.raises(DataError, match="99 readings in 3000 rows, at least 100"):
        check_sensor(without(*range(99, N)), "x", "a.csv")
    with pytest.raises(DataError, match="infinite at sample 4"):
        check_sensor(np.where(np.arange(N) == 4, np.inf, VALUES), "x", "a.csv")
    with pytest.raises(DataError, match="constant"):
        check_sensor(np.ones(N), "x", "a.csv")


def test_huge_values_of_an_input_are_refused_before_lost_ones_are_filled() -> None:
    values = np.where(np.arange(N) == 7, -8.5e307, VALUES)
    values[3] = np.nan
    with pytest.raises(DataError, match=r"force.* is -8\.5e\+307 at sample 7, which no sensor can show"):
        Recording.from_arrays(
            rate=1e3, inputs={"force": values}, sensors={"position": VALUES}, units={"force": "N", "position": "m"}
        )


def test_arrays_need_units() -> None:
    with pytest.raises(CaseError, match="units is None"):
        Recording.from_arrays(rate=1e3, sensors={"position": VALUES}, units=None)  # type: ignore[arg-type]


def test_a_container_that_is_no_array_is_refused() -> None:
    with pytest.raises(DataError, match=r"'position' is .*Dataset.*: give an array of floats"):
        Recording.from_arrays(rate=1e3, sensors={"position": xr.Dataset()}, units={"position": "m"})
