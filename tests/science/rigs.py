"""Cases of real rigs: a motor drive, a bistable beam, a beam with a bolted joint, a geared wheel that coasts.

Used by tests and by `benchmarks/gallery.py`, so that a page of the gallery and a test speak of the same case. Each
function writes what is read of a recording into `folder` and returns the text of the case; `data` is where the
recordings lie.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid
from scipy.io import loadmat
from scipy.signal import butter, decimate, detrend, filtfilt, firwin, hilbert

Array = NDArray[np.float64]

RUNS = ("pos_0.06_1", "neg_0.04_1", "pos_0.065_1", "neg_0.045_1")
"""Two runs in each direction, named by the torque (N m) of their second step; the last one is held out."""
MOTOR = """
[[recordings]]
file = "{name}.csv"
name = "{name}"
time = "t"
hold = "step"
excitation = {{ column = "torque", quantity = "torque", unit = "N m" }}
response = {{ column = "velocity", quantity = "velocity", unit = "rad/s" }}
"""
SHAFT = """
[model]
name = "rigid_drive"
motion = "rotation"

[model.estimate]
m = { median = 1.2e-4, sd_log = 0.5 }
c = { median = 7e-5, sd_log = 1.0 }
"""
"""Priors about the catalogue: 1.2e-4 kg m^2 and 7.03e-5 N m s/rad."""

BLOCKS = (0, 10, 20, 30)
"""Blocks of four seconds that are read of a case of the bistable beam; the last one is held out."""
THIN = 8
COLUMNS = ("base_acc_g", "tip_velocity", "piezo_V")
TABLE = """
[[recordings]]
file = "block{block}.csv"
name = "block {block}"
time = "t"
excitation = {{ column = "base", quantity = "base_acceleration", unit = "g" }}
response = {{ column = "velocity", quantity = "velocity", unit = "m/s" }}
"""
BUCKLED = """
[model]
name = "duffing"

[model.known]
m = 1.0

[model.estimate]
c = { median = 2.0, sd_log = 1.0 }
k = { mean = -1000.0, sd = 500.0 }
k3 = { mean = 2e6, sd = 1e6 }
"""
"""Priors by order of magnitude: two wells some 2 cm from the middle, small motion in them at 5 to 7 Hz."""

BEAM = """
[[recordings]]
file = "beam.csv"
time = "t"
t_start = 0.3
t_end = 2.0
inputs = []
sensors = [ { channel = "acceleration", column = "a", unit = "m/s^2", name = "acc1" } ]

[model]
name = "linear_oscillator"

[model.known]
m = 1.0

[model.estimate]
c = { median = 2.0, sd_log = 1.0 }
k = { median = 2.5e5, sd_log = 0.3 }
"""
WHEEL = """
[[recordings]]
file = "wheel.csv"
name = "{name}"
time = "t"
t_start = {start}
t_end = {end}
inputs = [ {{ input = "torque", column = "current", unit = "N m" }} ]
sensors = [ {{ channel = "position", column = "angle", unit = "deg", name = "encoder", noise = "quantised" }} ]
"""
DRIVE = """
[model]
name = "rigid_drive"
motion = "rotation"

[model.estimate]
m = { median = 0.05, sd_log = 1.0 }
c = { half_sd = 0.5 }
"""


def written(path: Path, columns: dict[str, Array]) -> None:
    """Write columns by name as a table, with fewer digits than would matter."""
    np.savetxt(path, np.stack([*columns.values()], axis=1), delimiter=",", header=",".join(columns), comments="",
               fmt="%.9g")  # fmt: skip


def motor_signal(data: Path, run: str) -> tuple[Array, Array, Array]:
    """Return time (s), torque that was asked for (N m) and velocity (rad/s) of a run of the motor drive, at 1 kHz."""
    seen = loadmat(data / "hsm150_motors" / f"idf_{run}.mat", simplify_cells=True)["data"]
    return seen[:, 0], seen[:, 4], seen[:, 3]


def motors(data: Path, folder: Path, runs: Sequence[str] = RUNS) -> str:
    """Return the case of the two-motor drive: torque steps in, velocity out, at 50 Hz in place of 1 kHz."""
    for run in runs:
        time, torque, velocity = motor_signal(data, run)
        slow = decimate(decimate(velocity, 4, zero_phase=True), 5, zero_phase=True)
        written(folder / f"{run}.csv", {"t": time[::20], "torque": torque[::20], "velocity": slow})
    return "".join(MOTOR.format(name=run) for run in runs) + SHAFT


def motor(data: Path, folder: Path) -> str:
    """Return the case of one run of the two-motor drive: its end is held out."""
    return motors(data, folder, RUNS[:1])


def bistable_signal(data: Path, which: str, block: int) -> tuple[Array, Array, Array, Array]:
    """Return time (s), acceleration of the base (g), velocity over it (m/s) and piezo (V) of a block, at 256 Hz.

    The vibrometer stands on the ground, so the velocity of the base is taken off: only so the acceleration of the base
    has a factor of one in the balance of forces (`by_hand.bistable`).
    """
    with np.load(data / "bistablex_chaos" / f"chaos_{which}_40x8192.npz") as seen:
        dt, base, tip, piezo = float(seen["dt"]), *(seen[k][block].astype(float) for k in COLUMNS)
    moved = cumulative_trapezoid(detrend(9.80665 * base), dx=dt, initial=0.0)
    relative = 0.1 * tip - filtfilt(*butter(2, 2.0 * dt, "high"), moved)
    thin = [decimate(row, THIN, zero_phase=True)[64:-64] for row in (base, relative, piezo)]
    return np.arange(len(thin[0])) * THIN * dt, thin[0], thin[1], thin[2]


def bistable(data: Path, folder: Path, which: str = "asymmetric") -> str:
    """Return the case of the bistable beam on a shaking table: base acceleration in, velocity over the table out.

    Known of the model is two wells alike, which is `duffing` with a stiffness below zero; its mass is one, since a
    shaken machine has no other.
    """
    for block in BLOCKS:
        t, base, velocity, _ = bistable_signal(data, which, block)
        written(folder / f"block{block}.csv", {"t": t, "base": base, "velocity": velocity})
    return "".join(TABLE.format(block=block) for block in BLOCKS) + BUCKLED


def beam_signal(data: Path) -> tuple[Array, NDArray[np.complex128]]:
    """Return the time (s) and the analytic signal (m/s^2) of the first mode of the beam with a bolted joint.

    Other modes (222 Hz and above) are taken off by a filter of zero phase, as one would before a fit of one mode.
    """
    seen = loadmat(data / "brake_reuss_beam" / "HammerImpact.mat", simplify_cells=True)["HIdata"]
    low = filtfilt(firwin(801, 150.0, fs=12800.0, window=("kaiser", 8.0)), [1.0], seen["acc1"])
    return seen["time"][::16], hilbert(low)[::16]


def beam(data: Path, folder: Path) -> str:
    """Return the case of the beam with a bolted joint: one accelerometer, first mode only, ringing down."""
    t, wave = beam_signal(data)
    written(folder / "beam.csv", {"t": t, "a": wave.real})
    return BEAM


def wheel_signal(data: Path) -> tuple[Array, Array, Array]:
    """Return time (s), angle (degree) and current (A) of the geared wheel, at 50 kHz."""
    with np.load(data / "gear_pair" / "gear.npz") as seen:
        t, angle, shunt = seen["t"], -seen["y1"], seen["shunt"].astype(float)
    zero = shunt[t < 0.8].mean()
    return t, angle, filtfilt(firwin(501, 200.0, fs=50000.0), [1.0], shunt - zero) / 0.1


def wheel(data: Path, folder: Path) -> str:
    """Return the case of the motor's wheel: coasting is fitted, speeding up is held out.

    Nobody knows the torque constant: with 1 N m/A, torques are currents.
    """
    t, angle, current = wheel_signal(data)
    written(folder / "wheel.csv", {"t": t[::100], "current": current[::100], "angle": angle[::100]})
    pieces = [WHEEL.format(name="coasting", start=2.4, end=3.75), WHEEL.format(name="speeding", start=0.85, end=2.4)]
    return "".join(pieces) + DRIVE
