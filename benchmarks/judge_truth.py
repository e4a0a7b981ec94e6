"""The truth of a machine of `benchmarks/judge.py`, and the files of its case.

A machine is a folder `SET/KEY` with `case.toml` and `recording.csv`, and beside it `SET/KEY.truth.json`. Both are
written once, so that every version of the code sees the same bytes.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

EXCITATION_NOISE = 1e-3
"""Noise of the recorded drive over its amplitude."""


@dataclass(frozen=True)
class Hiding:
    """One hidden effect: its name in the library (or of its law), place, parameters, and the names that are right."""

    mechanism: str
    at: str
    parameters: Mapping[str, float]
    accept: tuple[str, ...]


@dataclass(frozen=True)
class Truth:
    """What is hidden in a machine, its own parameters in SI units, and the kind of its drive."""

    key: str
    effects: Sequence[Hiding]
    values: Mapping[str, float]
    drive: str
    says: str
    dt: float = 0.0
    several: bool = False
    gain: float | None = None
    further: Mapping[str, object] = field(default_factory=dict)


def save_truth(folder: Path, truth: Truth) -> None:
    """Write the truth beside the folder of its machine; it is there only when the machine is complete."""
    (folder.parent / f"{folder.name}.truth.json").write_text(json.dumps(asdict(truth), indent=1))


def load_truth(folder: Path) -> dict[str, object]:
    """Return the truth of a machine as plain values."""
    return dict(json.loads((folder.parent / f"{folder.name}.truth.json").read_text()))


def is_complete(folder: Path) -> bool:
    """Return whether a machine was written completely."""
    return (folder.parent / f"{folder.name}.truth.json").exists()


def widen(value: float, rng: np.random.Generator) -> dict[str, object]:
    """Return a wide log-uniform prior of a case that contains a value, about a decade to each side."""
    below, above = 10.0 ** rng.uniform(0.6, 1.2, 2)
    return {"low": float(f"{value / below:.2g}"), "high": float(f"{value * above:.2g}"), "scale": "log"}


def write_table(path: Path, columns: Mapping[str, np.ndarray]) -> None:
    """Write columns (samples,) as CSV with nine significant digits."""
    table = np.column_stack(list(columns.values()))
    np.savetxt(path, table, fmt="%.9g", delimiter=",", header=",".join(columns), comments="")


def write_driven_case(folder: Path, title: str, columns: Mapping[str, np.ndarray], model: Mapping[str, object]) -> None:
    """Write a case with the columns `time`, `force` and `position` and a model with known and estimated parameters."""
    from lostmotion.case import dump_case

    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / "recording.csv", columns)
    recording = {
        "file": "recording.csv",
        "time": "time",
        "excitation": {"column": "force", "quantity": "force", "unit": "N"},
        "response": {"column": "position", "quantity": "position", "unit": "m"},
    }
    dump_case({"title": title, "recordings": [recording], "model": dict(model)}, folder / "case.toml")


def record(
    drive: np.ndarray, motion: np.ndarray, noise: float, rng: np.random.Generator, *, gauge: float = EXCITATION_NOISE
) -> tuple[np.ndarray, np.ndarray]:
    """Return drive and position (samples,) as recorded.

    `noise` is a share of the standard deviation of the motion, that of the `gauge` of the force of its amplitude.
    """
    size = math.sqrt(2.0) * float(np.std(drive))
    shown = motion + noise * float(np.std(motion)) * rng.standard_normal(len(motion))
    return drive + gauge * size * rng.standard_normal(len(drive)), shown
