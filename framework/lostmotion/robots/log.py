"""The log of a robot: time stamps, torques and encoder readings of its joints, on an even grid."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import DriveTerm
from lostmotion.errors import DataError
from lostmotion.parts import Array, Input

FINEST: Mapping[str, float] = {"motor": 0.0019, "link": 0.0099}
"""The shortest step (s) of a filter, by the side of the torque: faster logs are read at every second sample or fewer.

A sensor behind a strain-wave gear also reads the ripple of its flexible wheel, which moves nothing: above 10 Hz that of
a Panda shares less than a third with the motion. Read as a force, it turned dry friction into gains of 0.4."""
STALE = 0.3
"""The largest share of samples in which all joints repeat the reading before; with more, the arm rests."""
SHORTEST = 200
"""The smallest number of samples of a log."""
SLOWEST = 0.2
"""The longest step (s) of a log: with a longer one the motion between samples is not known."""
GAP = 20.0
"""A pause of more than so many steps is a gap, over which readings are missing."""
ROUNDING = 1e-3
"""The rounding of stamps, as a share of the step."""
JITTER = 0.02
"""The jitter of the stamps (sd, as a share of the step) above which a note is written."""


@dataclass(frozen=True, eq=False)
class RobotLog:
    """Torques (samples, n) and readings (samples, m) in SI units every `dt` s; a missing reading is NaN.

    `picks` tells for each reading its joint and whether it is a position (0) or a velocity (1). `hold` is "step" where
    a controller holds the torque between samples, else "smooth". `gains` (n, 2) are stiffness (N m/rad) and damping (N
    m s/rad) of the controller of joints whose set point is recorded: there `torque` is stiffness times set point.
    """

    name: str
    joints: tuple[str, ...]
    dt: float
    torque: Array
    readings: Array
    picks: tuple[tuple[int, int], ...]
    hold: str = "step"
    notes: tuple[str, ...] = ()
    gains: Array | None = None

    @property
    def controlled(self) -> tuple[str, ...]:
        """The joints whose set point is recorded in place of a torque."""
        gains = np.zeros((len(self.joints), 2)) if self.gains is None else self.gains
        return tuple(joint for joint, own in zip(self.joints, gains, strict=True) if np.any(own))

    @property
    def samples(self) -> int:
        """The number of samples."""
        return len(self.readings)

    @property
    def positions(self) -> Array:
        """The recorded positions (samples, n), with missing ones interpolated."""
        found = np.zeros((self.samples, len(self.joints)))
        for i, (j, order) in enumerate(self.picks):
            if order == 0:
                found[:, j] = fill_missing(self.readings[:, i])
        return found

    def measure_torque(self, q: Array, v: Array) -> Array:
        """Return the torque (samples, n) that acts at positions and velocities (samples, n)."""
        if self.gains is None:
            return self.torque
        return np.asarray(self.torque - self.gains[:, 0] * q - self.gains[:, 1] * v)

    def drive(self, terms: Sequence[DriveTerm], values: Mapping[str, float]) -> Array:
        """Return the torque (samples, n) that acts from each sample to the next, changed by the terms of the drive."""
        time = np.asarray(self.dt * np.arange(self.samples), dtype=float)
        found = np.array(self.torque) if self.hold == "step" else average_neighbours(self.torque)
        for j, joint in enumerate(self.joints):
            own = [term for term in terms if term.at == f"{joint}.torque"]
            if not own:
                continue

            def read(t: Array, order: int, column: Array = self.torque[:, j]) -> Array:
                return np.asarray(np.interp(t, time, column))

            source: Input = read
            for term in own:
                p = tuple(values[f"{term.name}@{term.at}.{q.name}"] for q in term.params)
                source = _chain(term, source, p)
            found[:, j] = source(time if self.hold == "step" else time + 0.5 * self.dt, 0)
        return found


def _chain(term: DriveTerm, source: Input, p: tuple[float, ...]) -> Input:
    """Return an input after one more term of the drive."""
    return lambda t, order: term.true(source, t, p, order)


def average_neighbours(x: Array) -> Array:
    """Return the values (samples, ...) in the middle of each interval; the last one is held."""
    return np.concatenate([0.5 * (x[:-1] + x[1:]), x[-1:]])


def fill_missing(x: Array) -> Array:
    """Return a column (samples,) in which missing values are interpolated."""
    good = np.isfinite(x)
    return x if good.all() else np.interp(np.arange(len(x)), np.flatnonzero(good), x[good])


@dataclass(frozen=True)
class LogClock:
    """The even grid of a log: its step (s), jitter and repeated stamps, and the largest gap (s)."""

    dt: float
    jitter: float
    repeated: int
    gap: float
    every: int = 1

    @property
    def step(self) -> float:
        """The step (s) at which the log is read: `every` steps of the log."""
        return self.every * self.dt

    def write_notes(self) -> tuple[str, ...]:
        """Return what is unusual about the clock, in sentences."""
        notes = []
        if self.repeated:
            notes.append(f"{self.repeated} samples have the time stamp of the one before and are left out.")
        if self.jitter > JITTER:
            notes.append(
                f"The time stamps jitter by {1e3 * self.jitter * self.dt:.3g} ms (sd); all columns are read at the"
                f" stamps and resampled every {1e3 * self.step:.4g} ms."
            )
        elif self.every > 1:
            notes.append(f"The log is read every {1e3 * self.step:.4g} ms.")
        if self.gap > GAP * self.dt:
            notes.append(f"The log pauses for up to {self.gap:.3g} s: readings there are taken as missing.")
        return tuple(notes)


def measure_clock(time: Array, source: str, side: str = "motor") -> LogClock:
    """Return the clock of time stamps (samples,) in s of a log with the torque of one `side` of the gear.

    Raise `DataError` where the stamps run backwards or are too few.
    """
    if len(time) < SHORTEST:
        raise DataError(f"{source} has {len(time)} samples: a diagnosis needs at least {SHORTEST}")
    steps = np.diff(time)
    backwards = int(np.sum(steps < 0.0))
    if backwards:
        raise DataError(
            f"{source}: the time runs backwards at {backwards} of {len(steps)} steps: sort the log by time, or split it"
        )
    moving = steps[steps > 0.0]
    if not len(moving):
        raise DataError(f"{source}: all time stamps are equal: give the column of the time of each sample")
    dt = float(np.median(moving))
    if dt > SLOWEST:
        raise DataError(
            f"{source} has a sample every {dt:g} s, a diagnosis needs one every {SLOWEST:g} s at least: if the stamps"
            ' are in ms, write time = { column = "...", unit = "ms" }'
        )
    even = moving[moving < GAP * dt]
    every = max(1, math.ceil(FINEST[side] / dt))
    return LogClock(dt, float(np.std(even) / dt), len(steps) - len(moving), float(moving.max()), every)


def resample(time: Array, columns: Array, clock: LogClock, *, step: bool) -> tuple[Array, NDArray[np.bool_]]:
    """Return columns (samples, k) on the even grid of a clock, and which of its points lie in a gap of the log.

    Torques that a controller holds (`step`) are not interpolated over a jump, but averaged over the step that follows.
    No point lies after the last stamp by more than rounding: there is no reading to interpolate.
    """
    kept = np.concatenate([[True], np.diff(time) > 0.0])
    time, columns = time[kept], columns[kept]
    grid = np.arange(time[0], time[-1] + ROUNDING * clock.step, clock.step)
    after = np.clip(np.searchsorted(time, grid), 1, len(time) - 1)
    gaps = (time[after] - time[after - 1]) > GAP * clock.dt
    if step:
        inner = np.add.outer(grid, clock.dt * np.arange(clock.every))
        nearest = np.clip(np.searchsorted(time, inner + 0.25 * clock.dt, side="right") - 1, 0, len(time) - 1)
        return columns[nearest].mean(axis=1), gaps
    return np.stack([np.interp(grid, time, column) for column in columns.T], axis=1), gaps


def find_stale(positions: Array) -> NDArray[np.bool_]:
    """Return the samples (samples,) in which all positions repeat those before: no new reading has arrived."""
    same = np.concatenate([[False], np.all(np.diff(positions, axis=0) == 0.0, axis=1)])
    return same if same.mean() < STALE else np.zeros(len(same), dtype=bool)
