"""From five files of five instruments to a named cause, as a new user goes: `init` or one command, then the report.

The machines are integrated without the framework. Nothing but the file, an equation and the options that the messages
of the program name is given.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from datetime import datetime, timedelta
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from click.testing import CliRunner
from independent import FINE, leapfrog

from lostmotion.cli import main

SPRING = "m*x'' + c*x' + k*x = force"
TONES = ((1.0, 2.1), (0.8, 4.7), (0.6, 7.3), (0.5, 11.2))


class Run(NamedTuple):
    """A simulated recording in SI units: time, force, position, velocity and acceleration (samples,)."""

    time: np.ndarray
    force: np.ndarray
    place: np.ndarray
    speed: np.ndarray
    thrust: np.ndarray


def simulate(
    rate: float, samples: int, size: float, *, m: float, c: float, k: float, seed: int, **hidden: float
) -> Run:
    """Return the motion under a multisine, with 0.2 % of noise of the force."""
    step, rng = 1.0 / rate / FINE, np.random.default_rng(seed)
    middles = (np.arange(samples * FINE) + 0.5) * step

    def push(t: np.ndarray) -> np.ndarray:
        return size * sum(a * np.cos(2.0 * np.pi * f * t + 0.7 * i * i) for i, (a, f) in enumerate(TONES))

    coulomb, quadratic, cubic = (hidden.get(name, 0.0) for name in ("coulomb", "quadratic", "cubic"))
    x, v = leapfrog(push(middles), (m, c, k, 0.0, 1.0, coulomb, quadratic, cubic), (1e-3, 0.0), step, FINE).T
    t = np.arange(samples) / rate
    own = push(t)
    loss = c * v + k * x + coulomb * np.sign(v) + quadratic * v * np.abs(v) + cubic * x**3
    return Run(t, own + 0.002 * own.std() * rng.standard_normal(samples), x, v, (own - loss) / m)


def noisy(values: np.ndarray, share: float, seed: int) -> np.ndarray:
    return values + share * values.std() * np.random.default_rng(seed).standard_normal(values.size)


def write_logger(folder: Path) -> Path:
    """A German logger: comments, stamps, decimal commas, units in brackets, a line of mean values at the end."""
    run = simulate(200.0, 3000, 8.0, m=1.0, c=4.0, k=900.0, seed=1, coulomb=1.5)
    place = 1e3 * noisy(run.place, 0.005, 11)
    begun, step = datetime(2025, 3, 4, 9, 58, 50), timedelta(milliseconds=5)
    rows = "".join(
        f"{begun + k * step:%d.%m.%Y %H:%M:%S},{5 * k % 1000:03d};" + f"{f:.4f};{x:.5f}\n".replace(".", ",")
        for k, (f, x) in enumerate(zip(run.force, place, strict=True))
    )
    (folder / "messung.csv").write_text(f"# Messplatz 3\nZeit;Kraft [N];Weg [mm]\n{rows}Mittelwert;0,01;0,02\n")
    return folder / "messung.csv"


def write_scope(folder: Path) -> Path:
    """A scope of Rigol: the force cell gives 20 N a volt, the displacement sensor 4 mm a volt."""
    run = simulate(500.0, 6000, 60.0, m=2.0, c=6.0, k=3000.0, seed=2, cubic=3e6)
    volts = np.c_[run.force / 20.0, 1e3 * noisy(run.place, 0.005, 12) / 4.0]
    rows = "".join(f"{k},{a:.5f},{b:.6f},,\n" for k, (a, b) in enumerate(volts))
    (folder / "NewFile1.csv").write_text(f"X,CH1,CH2,Start,Increment\nSequence,VOLT,VOLT,-1.2,2.0e-03\n{rows}")
    return folder / "NewFile1.csv"


def write_labview(folder: Path) -> Path:
    """LabVIEW: a torque and an angle in degrees."""
    run = simulate(250.0, 4000, 0.5, m=0.02, c=0.05, k=12.0, seed=3, coulomb=0.06)
    head = (
        "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\nMulti_Headings\tNo\nX_Columns\tOne\n"
        "Date\t2025/03/04\nTime\t09:58:50.123\n***End_of_Header***\t\n\t\nChannels\t2\t\t\nSamples\t4000\t4000\t\n"
        "Y_Unit_Label\tNm\tdeg\t\nX0\t0.0\t0.0\t\nDelta_X\t0.004\t0.004\t\n***End_of_Header***\t\t\t\n"
        "X_Value\tTorque\tAngle\tComment\n"
    )
    angle = np.degrees(noisy(run.place, 0.004, 13))
    rows = "".join(f"{t:.4f}\t{f:.6f}\t{x:.5f}\t\n" for t, f, x in zip(run.time, run.force, angle, strict=True))
    (folder / "joint.lvm").write_text(head + rows)
    return folder / "joint.lvm"


def write_counter(folder: Path) -> Path:
    """A microcontroller: microseconds, and the counts of an encoder (20000 a turn) since the row before."""
    run = simulate(400.0, 5000, 0.4, m=0.01, c=0.03, k=4.0, seed=4, coulomb=0.05)
    total = np.floor(run.place / (2.0 * np.pi) * 20000 + 0.3)
    rows = np.c_[2500 * np.arange(5000), run.force, np.diff(total, prepend=total[0])]
    np.savetxt(folder / "log.csv", rows, fmt=("%d", "%.5f", "%d"), delimiter=",", comments="",
               header="time_us,torque_Nm,ticks")  # fmt: skip
    return folder / "log.csv"


def write_sheet(folder: Path) -> Path:
    """A spreadsheet of a vibrometer: speed in mm/s, a title and a row of units."""
    pytest.importorskip("python_calamine", reason="the extra xlsx is not installed")
    import importlib.util

    place = Path(__file__).parents[1] / "framework" / "test_further_formats.py"
    spec = importlib.util.spec_from_file_location("further_formats", place)
    formats = importlib.util.module_from_spec(spec)  # type: ignore[arg-type]
    spec.loader.exec_module(formats)  # type: ignore[union-attr]
    run = simulate(250.0, 4000, 30.0, m=1.5, c=3.0, k=1200.0, seed=5, quadratic=9.0)
    rows = np.c_[run.time, run.force, 1e3 * noisy(run.speed, 0.005, 15)].round(6).tolist()
    head = [["Pump 2, run 7"], ["Time", "Force", "Velocity"], ["s", "N", "mm/s"]]
    formats.pack_sheets(folder / "pump.xlsx", {"Data": [*head, *rows]})
    return folder / "pump.xlsx"


class Instrument(NamedTuple):
    """How a file is written, what the user says to `init`, and the hidden law with its parameter and true size (SI)."""

    write: Callable[[Path], Path]
    said: tuple[str, ...]
    law: str
    parameter: str
    size: float


TICKS = ("--response", "ticks", "--unit", "ticks=turn", "--factor", "ticks=5e-5", "--differences", "ticks")
VOLTS = ("--drive", "CH1", "--response", "CH2", "--unit", "CH1=N", "--factor", "CH1=20", "--unit", "CH2=mm",
         "--factor", "CH2=4")  # fmt: skip
INSTRUMENTS = {
    "logger": Instrument(write_logger, (), "coulomb_friction", "force", 1.5),
    "scope": Instrument(write_scope, VOLTS, "cubic_stiffness", "coefficient", 3e6),
    "labview": Instrument(write_labview, (), "coulomb_friction", "force", 0.06),
    "counter": Instrument(write_counter, TICKS, "coulomb_friction", "force", 0.05),
    "sheet": Instrument(write_sheet, (), "quadratic_damping", "coefficient", 9.0),
}


def call(*words: str | Path) -> str:
    done = CliRunner().invoke(main, [str(word) for word in words])
    assert done.exit_code == 0, done.output
    return done.output


@pytest.mark.slow
@pytest.mark.parametrize("name", INSTRUMENTS)
def test_a_file_of_an_instrument_leads_to_the_hidden_law(name: str, tmp_path: Path) -> None:
    """`init`, `diagnose`: the hidden law is named, the true size lies in its interval, and nothing else is named."""
    one = INSTRUMENTS[name]
    file, case = one.write(tmp_path), tmp_path / "case.toml"
    call("init", file, "--out", case, "--model", SPRING, *one.said)
    call("diagnose", case, "--out", tmp_path / "result", "--quiet")
    found = json.loads((tmp_path / "result" / "diagnosis.json").read_text())["found"]
    named = {entry["mechanism"]: entry for entry in found if entry["state"] == "named"}
    assert list(named) == [one.law]
    size = named[one.law]["parameters"][one.parameter]
    assert size["low"] <= one.size <= size["high"]


@pytest.mark.parametrize("name", INSTRUMENTS)
def test_a_file_of_an_instrument_becomes_a_case(name: str, tmp_path: Path) -> None:
    one = INSTRUMENTS[name]
    text = call("init", one.write(tmp_path), "--out", tmp_path / "case.toml", "--model", SPRING, *one.said)
    assert "please check" not in text


@pytest.mark.parametrize(("name", "says"), [("scope", "V"), ("counter", "holds counts, whose size is unknown")])
def test_what_a_file_does_not_say_is_asked(name: str, says: str, tmp_path: Path) -> None:
    file = INSTRUMENTS[name].write(tmp_path)
    done = CliRunner().invoke(main, ["init", str(file), "--out", str(tmp_path / "case.toml"), "--model", SPRING])
    assert done.exit_code == 2
    assert says in done.output
