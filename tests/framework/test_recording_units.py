"""Units in headers, units of time, and what becomes of both when a recording is loaded."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.quantities import si_factor, spell_unit
from lostmotion.recording import Channel, RecordingSpec, load_recording
from lostmotion.recording.units import is_unit, note_unit, seconds, split_name, time_unit, unit_line
from lostmotion.registry import Registry
from lostmotion_chaos.analysis.source import WantedChannel, load_source

N = 2000
RATE = 997.0
EVEN = np.arange(N) / RATE


@pytest.mark.parametrize(
    "text",
    ["s", "ms", "µs", "N", "kN", "mm", "m/s", "m/s^2", "m/s²", "m/s2", "1/s", "rad/s", "°/s", "N m", "N*m", "Nm", "N·m",
     "deg", "°C", "%", "V", "mV", "kgf", "inch", "g", "rpm", "newton", "milliseconds", "kg*m/s**2", "N/(m/s)"],
)  # fmt: skip
def test_units_of_loggers_are_units(text: str) -> None:
    assert is_unit(text)


@pytest.mark.parametrize(
    "text", ["t", "a", "F", "x", "acc", "link", "left", "", "-", "1", "3", "u", "e", "raw", "s" * 50]
)
def test_names_and_numbers_are_no_units(text: str) -> None:
    assert not is_unit(text)


def test_a_name_is_parted_from_its_unit() -> None:
    assert split_name("Time [ms]") == ("Time", "ms")
    assert split_name("a(t) (m/s^2)") == ("a(t)", "m/s^2")
    assert split_name("F(N)") == ("F", "N")
    assert split_name("c (N/(m/s))") == ("c", "N/(m/s)")
    assert split_name("x(t)") == ("x(t)", "")
    assert split_name("[ms]") == ("[ms]", "")


def test_a_line_of_units() -> None:
    assert unit_line(["s", "", "-", "[mm]"]) == ["s", "", "", "mm"]
    assert unit_line(["s", "counts", "foo"]) == ["s", "counts", "foo"]
    assert unit_line(["foo", "low", "s"]) is None
    assert unit_line(["-", ""]) is None


@pytest.mark.parametrize(
    ("unit", "scale"), [("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("ns", 1e-9), ("min", 60), ("h", 3600)]
)
def test_time_becomes_seconds(unit: str, scale: float) -> None:
    np.testing.assert_allclose(seconds(np.arange(9.0), unit, "a.csv"), scale * np.arange(9), rtol=1e-15)
    with pytest.raises(DataError, match=r"a\.csv: time in 'mm'"):
        seconds(np.arange(9.0), "mm", "a.csv")


@pytest.mark.parametrize(
    ("name", "table", "given", "unit", "told"),
    [
        ("t", None, None, "", False), ("t", "ms", None, "ms", True), ("t", "seconds", None, "s", False),
        ("time_ms", None, None, "ms", True), ("t_us", None, None, "us", True), ("Time/ms", None, None, "ms", True),
        ("Time [ms]", None, None, "ms", True), ("Time [ms]", "s", None, "s", False), ("t", None, "µs", "us", False),
        ("t", "ms", "millisecond", "ms", False), ("time", "seconds since 1970-01-01", None, "s", False),
        ("start_time", None, None, "", False), ("t", "1", None, "", False),
    ],
)  # fmt: skip
def test_the_unit_of_time(name: str, table: str | None, given: str | None, unit: str, told: bool) -> None:
    found, notes = time_unit(name, table, given)
    assert found == unit
    assert notes == ((f"the time column {name!r} is read in {unit}",) if told else ())


@pytest.mark.parametrize(
    ("name", "table", "given", "words"),
    [("t", "ms", "s", "in ms by its header and in s by the case"), ("time_ms", None, "us", "in us by the case"),
     ("t", "mm", None, "in mm by its header, which is no time"), ("t", None, "mm", "not a time: expected s, ms")],
)  # fmt: skip
def test_units_that_cannot_be_meant(name: str, table: str | None, given: str | None, words: str) -> None:
    with pytest.raises(DataError, match=words):
        time_unit(name, table, given)


@pytest.mark.parametrize("unit", ["m/s2", "m/s²", "m/s^2", "m/s**2"])
def test_powers_are_understood(unit: str) -> None:
    assert si_factor(spell_unit(unit), "acceleration") == (pytest.approx(1.0), "m/s^2")
    assert si_factor(spell_unit("kNm"), "torque") == (pytest.approx(1000.0), "N m")


@pytest.mark.parametrize(
    ("channel", "header", "words"),
    [
        (Channel("F", "force", "N"), "kN", "the header says kN, the case N"),
        (Channel("F", "force", "N"), "N", ""),
        (Channel("F", "force", "N", -1000.0), "kN", ""),
        (Channel("F", "force", "N", 35.0), "V", ""),
        (Channel("F", "force", "N"), "V", "the header says V, which measures no force"),
        (Channel("F", "force", "N"), None, ""),
        (Channel("x", "position", "deg"), "mm", "the header says mm, the case deg"),
        (Channel("a", "acceleration", "m/s^2"), "m/s²", ""),
        (Channel("a", "acceleration", "m/s^2"), "g", "the header says g, the case m/s^2"),
    ],
)  # fmt: skip
def test_a_unit_that_differs_from_the_header_is_noted(channel: Channel, header: str | None, words: str) -> None:
    found = [*note_unit(channel, header, "the excitation")]
    assert (words in found[0]) if words else not found


def logged(folder: Path, jitter: float = 0.006, lost: tuple[int, ...] = ()) -> Path:
    """A file of a data logger: lines above, units below, decimal commas, stamps in ms that jitter."""
    stamps = EVEN + jitter / RATE * np.random.default_rng(3).normal(size=N)
    rows = [
        f"{1e3 * t:.6f};{'' if k in lost else f'{np.cos(40 * t):.6f}'};{1e3 * np.sin(40 * t):.6f};".replace(".", ",")
        for k, t in enumerate(stamps)
    ]
    text = "\r\n".join(["\ufeffDevice;logger 7", "Rate;1000", "Time;Force;x;", "ms;N;mm;", *rows, ""])
    (folder / "run.csv").write_bytes(text.encode())
    return folder


SPEC = RecordingSpec("run.csv", "Time", None, (Channel("Force", "force", "N"),), (Channel("x", "position", "mm"),))


def test_a_file_of_a_logger_is_loaded_at_its_true_rate(tmp_path: Path) -> None:
    got = load_recording(SPEC, logged(tmp_path))
    assert got.rate == pytest.approx(RATE, rel=5 * 0.006 * np.sqrt(12) / N**1.5)
    time = got.data.time.to_numpy()
    np.testing.assert_allclose(got.data.excitation[2:-2], np.cos(40 * time)[2:-2], atol=3e-6)
    np.testing.assert_allclose(got.data.response[2:-2], np.sin(40 * time)[2:-2], atol=3e-6)
    assert got.notes[0] == "the time column 'Time' is read in ms"
    assert "time stamps jitter by 0.6 % of the step" in got.notes[1]
    assert len(got.notes) == 2


def test_lost_samples_of_its_input_are_bridged(tmp_path: Path) -> None:
    got = load_recording(SPEC, logged(tmp_path, lost=(0, 7, 8, 900)))
    time = got.data.time.to_numpy()
    np.testing.assert_allclose(got.data.excitation[2:-2], np.cos(40 * time)[2:-2], atol=2e-3)
    assert "the excitation 'Force': 4 of 2000" in got.notes[2]


def test_a_case_that_contradicts_the_header_is_doubted(tmp_path: Path) -> None:
    spec = replace(SPEC, inputs=(Channel("Force", "force", "kN"),))
    notes = load_recording(spec, logged(tmp_path)).notes
    assert any("the excitation 'Force': the header says N, the case kN" in note for note in notes)


def test_a_bare_file_is_analysed_at_its_true_rate(tmp_path: Path) -> None:
    source = load_source(logged(tmp_path) / "run.csv", WantedChannel(columns=("x",)), Registry())
    assert 1 / source.dt == pytest.approx(RATE, rel=1e-6)
    np.testing.assert_allclose(source.x[2:-2], 1e3 * np.sin(40 * np.arange(N) / RATE)[2:-2], atol=3e-2)
    assert any("read in ms" in note for note in source.notes)


def test_a_second_name_is_no_second_column(tmp_path: Path) -> None:
    rows = "".join(f"{1e3 * t:.6f},{np.sin(40 * t):.6f}\n" for t in EVEN)
    (tmp_path / "run.csv").write_text("Time [ms],angle [rad]\n" + rows)
    source = load_source(tmp_path / "run.csv", WantedChannel(), Registry())
    assert source.label == "angle [rad]"
    assert 1 / source.dt == pytest.approx(RATE, rel=1e-6)
