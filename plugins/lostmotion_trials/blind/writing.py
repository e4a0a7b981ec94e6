"""The files of a machine that the diagnosis reads: a case file with the nominal model, and a recording."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from lostmotion.case import dump_case
from lostmotion.codec import to_plain
from lostmotion.contracts import Array
from lostmotion.storage import save_table, whole
from lostmotion_trials.blind.simulator import BlindMachine


def write_case(
    rig: BlindMachine, signals: tuple[Array, Array], folder: Path, *, title: str, stated: Mapping[str, float]
) -> Path:
    """Return the path of the case of a machine, written into a folder with its recording.

    `signals` are excitation and response (samples,) in SI units. Nothing of the case is hidden, but known values may be
    slightly wrong: `stated` has what the case says of them over the truth, where that is not one.
    """
    excitation, response = signals
    save_table(folder / "recording.csv", {"time": rig.time, "excitation": excitation, "response": response}, {}, {})
    quantity, units = ("base_position", ("rad", "rad")) if rig.based else ("force", ("N", "m"))
    recording = {
        "file": "recording.csv",
        "time": "time",
        "excitation": {"column": "excitation", "quantity": quantity, "unit": units[0]},
        "response": {"column": "response", "quantity": "position", "unit": units[1]},
    }
    known = {name: value * stated.get(name, 1.0) for name, value in rig.values.items() if name not in rig.estimated}
    model = {"name": rig.model, "known": known, "estimate": to_plain(rig.priors)}
    path = folder / "case.toml"
    with whole(path) as spare:
        dump_case({"title": title, "recordings": [recording], "model": model}, spare)
    return path
