"""The channel that `analyse` looks at: of a case, or of a bare file."""

import numpy as np
import pytest

from lostmotion.errors import CaseError, DataError
from lostmotion.registry import Registry
from lostmotion_chaos.analysis.source import WantedChannel, load_source

ROWS = 400
CASE = """
title = "Two levels"
[[recordings]]
file = "low.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "kN" }
response = { column = "position", quantity = "position", unit = "mm" }
[[recordings]]
file = "high.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "kN" }
response = { column = "position", quantity = "position", unit = "mm" }
[model]
name = "lin_backlash"
"""


@pytest.fixture
def folder(tmp_path):
    t = 0.1 * np.arange(ROWS)
    for name, level in (("low", 1.0), ("high", 2.0)):
        table = np.column_stack([t, np.cos(t), level * np.sin(t)])
        table[7, 2] = np.nan
        np.savetxt(tmp_path / f"{name}.csv", table, delimiter=",", header="time,force,position", comments="")
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    return tmp_path


def test_a_case_gives_its_first_recording_in_si_units_and_says_so(folder):
    source = load_source(folder / "case.toml", WantedChannel(), Registry())
    assert source.unit == "m"
    assert np.ptp(source.x) == pytest.approx(2e-3, rel=0.01)
    assert source.excitation is not None
    assert any("first of 2 recordings" in note for note in source.notes)


def test_another_recording_is_had_by_its_name(folder):
    source = load_source(folder / "case.toml", WantedChannel(columns=("high",)), Registry())
    assert np.ptp(source.x) == pytest.approx(4e-3, rel=0.01)
    with pytest.raises(CaseError, match="did you mean 'high'"):
        load_source(folder / "case.toml", WantedChannel(columns=("hihg",)), Registry())


@pytest.mark.parametrize("name", ["case.toml", "low.csv"])
def test_the_longest_stretch_without_a_gap_is_taken(folder, name):
    source = load_source(folder / name, WantedChannel(columns=() if name == "case.toml" else ("position",)), Registry())
    assert len(source.x) == ROWS - 8
    assert any(f"{ROWS - 8} of {ROWS} samples" in note for note in source.notes)


@pytest.mark.parametrize("name", ["case.toml", "low.csv"])
def test_many_short_gaps_are_refused_with_their_number(folder, name):
    t = 0.1 * np.arange(ROWS)
    table = np.column_stack([t, np.cos(t), np.sin(t)])
    table[50::50, 2] = np.nan
    np.savetxt(folder / "low.csv", table, delimiter=",", header="time,force,position", comments="")
    wanted = WantedChannel(columns=() if name == "case.toml" else ("position",))
    with pytest.raises(DataError, match=f"7 of {ROWS} samples are missing, and the longest section .* has 50 samples"):
        load_source(folder / name, wanted, Registry())


def test_the_longest_stretch_between_gaps_in_the_time_is_taken(folder):
    table = np.loadtxt(folder / "low.csv", delimiter=",", skiprows=1)
    rows = np.delete(table, [*range(100, 130), 131], axis=0)
    np.savetxt(folder / "low.csv", rows, delimiter=",", header="time,force,position", comments="")
    source = load_source(folder / "low.csv", WantedChannel(columns=("position",)), Registry())
    np.testing.assert_allclose(source.x, table[132:, 2])
    assert any(f"The time has gaps: the longest section without gaps is analysed, {ROWS - 132} of" in note
               for note in source.notes)  # fmt: skip


def test_a_rate_stands_in_for_time(folder):
    np.savetxt(folder / "bare.csv", np.sin(np.arange(300)), header="angle", comments="")
    assert load_source(folder / "bare.csv", WantedChannel(rate=250.0), Registry()).dt == pytest.approx(0.004)
    with pytest.raises(DataError, match="--rate HZ"):
        load_source(folder / "bare.csv", WantedChannel(), Registry())


def test_pieces_are_joined_in_order_and_thinned(folder):
    np.savez(folder / "blocks.npz", angle=np.arange(900.0).reshape(3, 300))
    source = load_source(folder / "blocks.npz", WantedChannel(columns=("angle[*]",), rate=100.0, every=3), Registry())
    assert source.x.tolist() == list(np.arange(0.0, 900.0, 3.0))
    assert source.dt == pytest.approx(0.03)
    assert any("3 pieces are joined" in note for note in source.notes)
    with pytest.raises(DataError, match="did you mean"):
        load_source(folder / "blocks.npz", WantedChannel(columns=("angel[*]",), rate=100.0), Registry())
