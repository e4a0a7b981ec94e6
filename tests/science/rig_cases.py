"""The cases of the gallery by name: real recordings, cut so that a diagnosis takes about a minute.

`CASES` has a function for each: it writes what is read of a recording into a folder and returns the text of the case.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import numpy as np
import rigs
from machines import CARRIAGE, EMPS, EMPS_FILES, thinned

RATE = 1e7 / 2**14
"""Samples a second of the Silverbox."""
MULTISINE = slice(40650, 127400)
SILVERBOX = f"""
title = "Silverbox, from the linear oscillator"
[[recordings]]
file = "multisine.npz"
rate = {RATE}
excitation = {{ column = "u", quantity = "force", unit = "N" }}
response = {{ column = "y", quantity = "position", unit = "m" }}
[model]
name = "linear_oscillator"
[model.estimate]
m = {{ low = 1e-7, high = 1e-4, scale = "log" }}
c = {{ low = 1e-6, high = 1e-2, scale = "log" }}
k = {{ low = 0.1, high = 10.0, scale = "log" }}
"""
DAMPED = """
[model]
name = "backlash_slider"
[model.estimate]
m = { median = 150.0, sd_log = 1.0 }
c = { low = 1e3, high = 1e5, scale = "log" }
k0 = { median = 5e6, sd_log = 1.0 }
x0 = { median = 2e-3, sd_log = 0.7 }
"""


PIECE = "t_end = 6.0\n"
SAMPLES = 6_000
"""So much of the multisine is read."""


def emps_whole(data: Path, folder: Path) -> str:
    """Return the case of the EMPS carriage: one recording is fitted, the pulses are held out."""
    return "".join(_carriage(data)) + CARRIAGE


def emps(data: Path, folder: Path) -> str:
    """Return the case of the EMPS carriage, with six seconds of either recording."""
    return "".join(text + PIECE for text in _carriage(data)) + CARRIAGE


def _carriage(data: Path) -> list[str]:
    return [EMPS.format(file=(data / "emps" / f"{name}.mat").resolve()) for name in EMPS_FILES]


def silverbox(data: Path, folder: Path) -> str:
    """Return the case of the Silverbox, the beginning of its multisine written beside it."""
    table = np.load(data / "silverbox" / "SNLS80mV.npz")
    part = slice(MULTISINE.start, MULTISINE.start + SAMPLES)
    np.savez(folder / "multisine.npz", u=table["V1"].ravel()[part], y=table["V2"].ravel()[part])
    return SILVERBOX


def damper(data: Path, folder: Path, name: str = "d2_0.5Hz_30lb_1in") -> str:
    """Return the case of the friction damper with backlash at 0.5 Hz: its force under a prescribed motion."""
    return thinned(folder, data / "brfd_friction_backlash", name) + DAMPED


CASES: Mapping[str, Callable[[Path, Path], str]] = {
    "emps": emps,
    "emps_whole": emps_whole,
    "silverbox": silverbox,
    "damper": damper,
    "damper_36lb": partial(damper, name="d2_0.5Hz_36lb_1in"),
    "motor_run": rigs.motor,
    "motor_drive": rigs.motors,
    "reuss_beam": rigs.beam,
    "bistable_beam": rigs.bistable,
    "gear_wheel": rigs.wheel,
}
