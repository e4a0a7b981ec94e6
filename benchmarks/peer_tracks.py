"""What `benchmarks/beside_peers.py` gives every tool: a recording, its fitted and held-out part, the error measure.

The error of free runs is that of a diagnosis (`heldout_nrmse`): runs of the same length from the same samples of the
held-out part, their rms error over the standard deviation of the held-out readings.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from lostmotion.diagnosis.compare import REACH, STARTS

WORST = 1e3
"""The largest error of a free run, in standard deviations."""
WILD = 10.0
"""A free run diverges where its error is more than this many standard deviations of the motion."""
TESTED, SLACK = 0.3, 1.05
"""Share of the fitted data on which settings are compared, and the rise of the error that a simpler model may have."""
NOMINAL = {
    "lin_backlash": ("u", "v", "d"),
    "linear_oscillator": ("u", "v", "x"),
    "rigid_drive": ("u", "v"),
    "pendulum": ("v", "d"),
}
"""The functions of each nominal model."""
Roll = Callable[[np.ndarray, np.ndarray], np.ndarray]
T = TypeVar("T")


@dataclass(frozen=True)
class Track:
    """Readings and drive (samples,), every `dt` s; `begin` is the first held-out sample.

    `nominal` has the names of the functions of the nominal model (`LAWS` in peers_sindy.py): drive, damping and spring,
    whose deflection "d" is the path beyond a gap, or for a `pendulum` the sine of the position. `horizon` is the length
    of free runs, as a number of units, and the unit in s.
    """

    position: np.ndarray
    drive: np.ndarray
    dt: float
    begin: int
    nominal: tuple[str, ...]
    pendulum: bool
    horizon: tuple[float, float]

    @property
    def free(self) -> bool:
        """Whether nothing drives the machine."""
        return "u" not in self.nominal

    @property
    def steps(self) -> int:
        """The number of steps over which the error counts."""
        return int(min(max(round(self.horizon[0] * self.horizon[1] / self.dt), 2), len(self.position) // 4))

    def hold_out_more(self) -> Track:
        """Return the fitted part, of which the last share `TESTED` is held out to compare settings."""
        cut = slice(None, self.begin)
        begin = round((1.0 - TESTED) * self.begin)
        return replace(self, position=self.position[cut], drive=self.drive[cut], begin=begin)


@dataclass(frozen=True)
class Model:
    """What a tool says: the names of its terms, its free runs, and the settings that were chosen."""

    terms: tuple[str, ...]
    roll: Roll
    setting: str


def load_track(folder: Path, horizon: tuple[float, float]) -> Track:
    """Return the recording of a machine as a diagnosis reads and divides it."""
    from lostmotion.diagnosis.moving import cut_rest
    from lostmotion.inference.setup import split_heldout
    from lostmotion.preparation.prepare import prepare
    from lostmotion.registry import Registry
    from lostmotion.settings import DEFAULT

    prepared = prepare(folder / "case.toml", Registry.discover(), DEFAULT)
    (seen,) = cut_rest(prepared.observations, DEFAULT.heldout)
    (fitted,), _ = split_heldout((seen,), DEFAULT.heldout)
    model = tomllib.loads((folder / "case.toml").read_text())["model"]
    pendulum = "sin(" in "".join(model.get("equations", ()))
    name = "pendulum" if pendulum else model.get("name")
    if name not in NOMINAL:
        raise SystemExit(f"{folder.name}: the functions of its model {name!r} are not known: add them to NOMINAL")
    nominal = NOMINAL[name]
    return Track(seen.response, seen.excitation, seen.dt, fitted.samples, nominal, pendulum, horizon)


def choose_starts(track: Track, most: int = STARTS) -> tuple[np.ndarray, int]:
    """Return the samples (runs,) at which free runs begin, and the number of samples of which the error counts."""
    left = len(track.position) - track.begin
    steps = int(min(max(REACH * track.horizon[1] / track.dt, track.steps + 1), left // 2))
    last = len(track.position) - steps
    starts = np.unique(np.linspace(track.begin, last, min(most, max(last - track.begin, 1))).astype(int))
    return starts, min(track.steps + 1, steps)


def measure_error(track: Track, roll: Roll, most: int = STARTS) -> tuple[float, float]:
    """Return the error of free runs `roll(starts, samples)`, and the share of those that diverge."""
    starts, samples = choose_starts(track, most)
    with np.errstate(all="ignore"):
        error = roll(starts, samples) - track.position[np.add.outer(starts, np.arange(samples))]
    size = float(np.std(track.position))
    error = np.clip(np.where(np.isfinite(error), error, np.inf), -WORST * size, WORST * size)
    wild = np.any(np.abs(error) > WILD * size, axis=1)
    return float(np.sqrt(np.mean(error**2)) / np.std(track.position[track.begin :])), float(np.mean(wild))


def choose_simplest(tried: Iterable[tuple[float, int, T]]) -> T:
    """Return the model with the fewest terms among those with nearly the smallest error: (error, terms, model)."""
    tried = list(tried)
    least = min(error for error, _, _ in tried)
    return min((one for one in tried if one[0] <= SLACK * least), key=lambda one: (one[1], one[0]))[2]
