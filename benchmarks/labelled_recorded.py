"""Recordings of real machines whose motion is known from who made them, for the verdict of `analyse`.

They are looked for in a folder `shared/data` beside the project, or in the one that `LOSTMOTION_DATA` names. They are
not part of the project: where one is absent it is left out, and that is said.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.io import loadmat
from scipy.signal import decimate

from labelled_series import LabelledSeries

Array = NDArray[np.float64]
ROOT = Path(__file__).resolve().parents[1]
BEAM_PERIOD = 1.0 / 6.5
"""The period (s) of the drive of the bistable beam."""


class Found(NamedTuple):
    """A recording by name, what it is, its samples, its step (s), and the period (s) of its drive if that is known."""

    name: str
    nature: str
    x: Array
    dt: float
    period: float | None = None


def data_folder() -> Path:
    """Return the folder of the recordings, whether it is there or not."""
    named = os.environ.get("LOSTMOTION_DATA")
    return Path(named) if named else ROOT.parent / "shared" / "data"


def _thin(x: Array, every: int) -> Array:
    return np.asarray(decimate(x, every, ftype="fir")) if every > 1 else x


def _beam_chaos(file: Path) -> list[Found]:
    """Return one block of four seconds as it is, and twenty blocks joined: each begins at the same drive phase."""
    name = file.name.split("_")[1]
    with np.load(file) as stored:
        rows, dt = stored["tip_velocity"].astype(float), float(stored["dt"])
    joined = np.concatenate([_thin(row, 8) for row in rows[:20]])
    other = np.concatenate([_thin(row, 8) for row in rows[20:]])
    return [
        Found(f"beam {name}, one block", "chaotic", _thin(rows[0], 2), 2 * dt, BEAM_PERIOD),
        Found(f"beam {name}, blocks 0-19", "chaotic", joined, 8 * dt, BEAM_PERIOD),
        Found(f"beam {name}, blocks 20-39", "chaotic", other, 8 * dt, BEAM_PERIOD),
    ]


def _beam_calm(file: Path) -> list[Found]:
    with np.load(file) as stored:
        rows, dt = stored["tip_velocity"].astype(float), float(stored["dt"])
    side = file.name.split("_")[1]
    return [
        Found(f"beam one well {side}, block {k}", "periodic", _thin(row, 4), 4 * dt, BEAM_PERIOD)
        for k, row in enumerate(rows)
    ]


def _hammer(file: Path) -> list[Found]:
    told: Any = loadmat(file, squeeze_me=True, struct_as_record=False)["HIdata"]
    dt = float(np.median(np.diff(told.time)))
    return [
        Found(f"bolted beam, {name}", "unsteady", np.asarray(getattr(told, name), float)[200:20200], dt)
        for name in ("acc1", "acc2", "acc3")
    ]


def _damper(file: Path) -> list[Found]:
    """Return force and displacement of one test, moved by a sine."""
    with np.load(file) as stored:
        data = stored["data"]
    hertz = float(file.stem.split("_")[1].removesuffix("Hz"))
    dt = float(np.median(np.diff(data[:, 0])))
    return [
        Found(f"{file.stem} {what}", "periodic", data[:, k], dt, 1.0 / hertz)
        for k, what in ((1, "displacement"), (2, "force"))
    ]


def _emps(file: Path) -> list[Found]:
    told = loadmat(file, squeeze_me=True)
    return [Found(f"{file.stem} {k}", "unsteady", _thin(told[k].astype(float), 2), 0.002) for k in ("qm", "vir")]


def _silverbox(file: Path) -> list[Found]:
    with np.load(file) as stored:
        x, dt = stored["V2"].astype(float), 1.0 / float(stored["fs"])
    if file.name.startswith("Schroeder"):
        return [Found("silverbox, one multisine again", "periodic", x[20_000:40_000], dt)]
    return [
        Found("silverbox, growing noise", "unsteady", x[100:40_575], dt),
        *(Found(f"silverbox, multisine {k}", "stochastic", x[a : a + 8000], dt)
          for k, a in enumerate((41_000, 67_000, 101_000))),
    ]  # fmt: skip


def _gears(file: Path) -> list[Found]:
    """Return transmission error and shunt voltage of a run-up, one sample in ten."""
    with np.load(file) as stored:
        error, shunt = stored["y1"] - 31.0 / 16.0 * stored["y2"], stored["shunt"].astype(float)
    return [
        Found("gears, transmission error", "unsteady", _thin(error, 10)[:20_000], 2e-4),
        Found("gears, shunt", "unsteady", _thin(shunt, 10)[:20_000], 2e-4),
    ]


def _motors(file: Path) -> list[Found]:
    data = loadmat(file, squeeze_me=True)["data"]
    return [
        Found(f"{file.stem} {what}", "unsteady", data[:, k].astype(float), 1e-3)
        for k, what in ((3, "velocity"), (6, "current"))
    ]


READERS: tuple[tuple[str, Callable[[Path], list[Found]]], ...] = (
    ("bistablex_chaos/chaos_*_40x8192.npz", _beam_chaos),
    ("bistablex_chaos/mono_*_3x8192.npz", _beam_calm),
    ("brake_reuss_beam/HammerImpact.mat", _hammer),
    ("brfd_friction_backlash/d[12]_*Hz_*.npz", _damper),
    ("emps/*.mat", _emps),
    ("silverbox/*.npz", _silverbox),
    ("gear_pair/gear.npz", _gears),
    ("hsm150_motors/*.mat", _motors),
)


def recorded(say: Callable[[str], None] = print) -> list[LabelledSeries]:
    """Return the recordings that are there; `say` is told which are not."""
    folder, animals = data_folder(), []
    for pattern, read in READERS:
        files = sorted(folder.glob(pattern))
        if not files:
            say(f"left out, not there: {folder / pattern}")
        animals += [_animal(found) for file in files for found in read(file)]
    return animals


def _animal(found: Found) -> LabelledSeries:
    return LabelledSeries(found.name, found.nature, lambda _rng: found.x, found.dt, found.period)
