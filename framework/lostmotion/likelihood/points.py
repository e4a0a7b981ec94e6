"""Parameter points of one recording, as a filter takes them: plain arrays, one row for each point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.sensors import Sensor
from lostmotion.noises import NoiseBlock


@dataclass(frozen=True)
class SensorNoises:
    """Noise of all sensors at some points: variances of white noise and of stamps (s^2), each (points, sensors).

    The m states of all noises follow each other in the order of the sensors: `shown` (points, m) is what each adds to
    the reading of its sensor; `transition`, `driving` and `first` are (points, m, m), blocks of zeros between sensors.
    """

    white: Array
    clock: Array
    shown: Array
    transition: Array
    driving: Array
    first: Array

    @classmethod
    def of(cls, blocks: Sequence[Sequence[NoiseBlock]]) -> SensorNoises:
        """Return the noise from the blocks of each point, one for each sensor."""
        whole = [NoiseBlock.join(row) for row in blocks]
        white, clock = (np.array([[getattr(b, name) for b in row] for row in blocks]) for name in ("white", "clock"))
        more = [np.stack([getattr(b, name) for b in whole]) for name in ("shown", "transition", "driving", "first")]
        return cls(white, clock, *more)

    def variances(self, sensors: Sequence[Sensor]) -> Array:
        """Return the variance (points, sensors) at the first sample, without that of the stamps."""
        found, end = self.white.copy(), 0
        for s, sensor in enumerate(sensors):
            own, end = slice(end, end + sensor.noise_states), end + sensor.noise_states
            found[:, s] += np.einsum("pa,pab,pb->p", self.shown[:, own], self.first[:, own, own], self.shown[:, own])
        return found

    @classmethod
    def join(cls, parts: Sequence[SensorNoises]) -> SensorNoises:
        """Return the noise at the points of all parts."""
        return cls(*(np.concatenate([getattr(p, f.name) for p in parts]) for f in fields(cls)))

    def select(self, rows: Any) -> SensorNoises:
        """Return some of the points."""
        return SensorNoises(*(getattr(self, f.name)[rows] for f in fields(self)))


@dataclass(frozen=True)
class Points:
    """Parameter points for one observation; the first axis of each array runs over them.

    `params` (points, parameters) are in the order of `System.slots`. `process` is the intensity (N^2 s, N^2 m^2 s)
    of the random force and `pace` (1/s) the decay rate of a latent one. `noise` is that of the sensors. For each
    sensor, (points, sensors): `gain` and `offset` relate the reading to the channel, and `lag` (s) is its delay
    within half a sample either way. The states of model and terms begin at `mean` (points, n) with `covariance`
    (points, n, n). `drives` are the inputs, `which` (points,) the one of each point, and `first` (points,) the
    sample of its drive at which a simulation begins. `readings` (points, samples, sensors) take the place of those
    of the observation, where each point corrects them.
    """

    params: Array
    process: Array
    pace: Array
    noise: SensorNoises
    gain: Array
    offset: Array
    lag: Array
    mean: Array
    covariance: Array
    drives: tuple[Drive, ...]
    which: NDArray[np.int64]
    first: NDArray[np.int64]
    readings: Array | None = None

    def __len__(self) -> int:
        return len(self.params)

    def select(self, rows: Any) -> Points:
        """Return some of the points: a slice, or an array of their numbers."""
        arrays = {f.name: getattr(self, f.name) for f in fields(self) if f.name not in ("drives", "noise")}
        kept = {name: array[rows] for name, array in arrays.items() if array is not None}
        return replace(self, noise=self.noise.select(rows), **kept)


def join_points(parts: Sequence[Points], views: Sequence[Observation]) -> Points:
    """Return the points of recordings that differ in inputs or readings only; `views` has that of each part."""
    if len(parts) == 1:
        return parts[0]
    names = [f.name for f in fields(Points) if f.name not in ("drives", "which", "noise", "readings")]
    arrays = {name: np.concatenate([getattr(p, name) for p in parts]) for name in names}
    before = np.cumsum([0, *(len(p.drives) for p in parts)])
    return Points(
        **arrays,
        noise=SensorNoises.join([p.noise for p in parts]),
        drives=tuple(drive for p in parts for drive in p.drives),
        which=np.concatenate([p.which + first for p, first in zip(parts, before, strict=False)]),
        readings=np.stack([view.readings for p, view in zip(parts, views, strict=True) for _ in range(len(p))]),
    )
