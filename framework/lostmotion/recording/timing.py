"""Whether a time column is an even grid, as far as its own precision lets one see, and what to do where it nearly is.

A recorder samples evenly and its stamps are rounded, or late by a little and at random. Both leave the mean rate as it
is: the line through all stamps by least squares finds it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.spec import Hold
from lostmotion.results import percent

Array = NDArray[np.float64]
JITTER = 0.01
"""Jitter (rms) that is accepted, as a share of the sampling step."""
SINGLE = 5.0 * math.sqrt(2.0) * JITTER
"""Share of the sampling step by which one step may differ from it: five deviations of two stamps."""
SEEN = 0.001
"""Jitter (rms) from which on channels are resampled, as a share of the step.

At a tenth of the Nyquist frequency such a jitter moves a value by 0.03 % of the amplitude."""
CLOSE = 0.1
"""Share of a step within which a sample stands for a point of the grid though its neighbour was lost."""

SHORTEST, LONGEST = 1e-12, 1e6
"""Sampling steps (s) outside of which no recorder works."""


@dataclass(frozen=True)
class EvenClock:
    """The even grid of a time column: `start + dt * k` (s); `uneven` where channels must be resampled to it."""

    dt: float
    uneven: bool
    notes: tuple[str, ...]
    start: float


def check_time(time: Array, source: str) -> tuple[float, tuple[str, ...]]:
    """Return the sampling step (s) of the time column (n,), and notes, as `even_clock` finds them."""
    clock = even_clock(time, source)
    return clock.dt, clock.notes


def even_clock(time: Array, source: str) -> EvenClock:
    """Return the even grid (s) that a time column (n,) stands for; a column that is none is refused.

    Time columns are often rounded, by single precision or by few printed digits. What rounding can explain is
    accepted, so the step is the mean over the whole column: the median would be a multiple of the rounding.
    Stamps that jitter by up to `JITTER` of the step (rms), or true steps that do, are accepted as well; the grid is
    then the line through the stamps by least squares. `DataError` for gaps, repeated stamps, time that runs backwards,
    more jitter, and a rate that changes so that stamps stray from the grid by more than a step.
    """
    _check_order(time, source)
    with np.errstate(over="ignore"):
        steps = np.diff(time)
    check_step(max(float(np.median(steps)), SHORTEST), source)
    rounding = resolution(time)
    dt = check_step(_typical(steps, rounding), source)
    if rounding > 2 * dt:
        raise DataError(
            f"{source}: the time column is rounded to {rounding:.3g} s, coarser than the step of {dt:.3g} s: "
            f"write it with more digits, or give rate in place of time"
        )
    bad = np.flatnonzero(np.abs(steps - dt) > _most(dt, rounding))
    if bad.size:
        _refuse_steps(time, dt, bad, source)
    return _fitted(time, rounding, source)


def _most(dt: float, rounding: float) -> float:
    """Return by how much (s) one step may differ from the others.

    Rounding moves a step by less than the resolution: a step that is off by a whole unit was not rounded there.
    """
    single = SINGLE * dt
    return 0.999 * rounding + single if single < rounding < 0.5 * dt else max(single, 0.999 * rounding)


def _fitted(time: Array, rounding: float, source: str) -> EvenClock:
    """Return the grid of stamps without gaps, unless they jitter or stray from it too much."""
    start, dt = mean_line(time)
    rest = time - start - dt * np.arange(time.size)
    steps = np.diff(rest)
    if _rms(steps) / math.sqrt(2.0) > 1.05 * JITTER * dt + 0.6 * rounding:
        _refuse_jitter(time, source)
    # Steps that are each a little off add up to a random walk, which strays by the root of their number.
    walk = _rms(np.diff(steps)) * math.sqrt(0.5 * time.size) if rounding <= JITTER * dt else 0.0
    away = float(np.abs(rest).max())
    if away > max(rounding, dt, walk):
        raise DataError(
            f"{source}: the time column strays by {away:.3g} s from an even step of {dt:.4g} s: resample to an "
            f"even step; if only the time stamps jitter, give rate = {1 / dt:.6g} in place of time"
        )
    jitter = _rms(rest)
    if jitter > max(SEEN * dt, 0.6 * rounding):
        note = (
            f"time stamps jitter by {100 * jitter / dt:.2g} % of the step (rms); the channels were resampled to an "
            f"even step of {dt:.9g} s"
        )
        return EvenClock(dt, True, (note,), start)
    dt = float((time[-1] - time[0]) / (time.size - 1))
    notes: tuple[str, ...] = ()
    if rounding > JITTER * dt and away > JITTER * dt:
        notes = (f"the time column is rounded to {rounding:.3g} s; an even step of {dt:.6g} s was put in its place",)
    return EvenClock(dt, False, notes, float(time[0]))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def mean_line(time: Array) -> tuple[float, float]:
    """Return the first stamp and the step (s) of the line through all stamps (n,) by least squares."""
    index = np.arange(time.size) - 0.5 * (time.size - 1)
    since = time - time[0]
    dt = float(index @ since / (index @ index))
    return float(time[0] + since.mean() + dt * index[0]), dt


def resampled(time: Array, values: Array, clock: EvenClock, *, hold: Hold = "smooth") -> Array:
    """Return a channel (n,), read at `time` (s), on the even grid of `clock`, by cubic splines (de Boor 1978).

    A value that is held as a step is that of the nearest sample. NaN stays where the nearest sample was lost, and where
    a neighbour was and no sample lies within a tenth of a step. The error of the spline falls with the fourth power of
    the step: it is below 0.1 % of the jitter's own effect for signals of ten samples a period and more.
    """
    from scipy.interpolate import CubicSpline

    grid = clock.start + clock.dt * np.arange(time.size)
    right = np.clip(np.searchsorted(time, grid), 1, time.size - 1)
    nearest = np.where(grid - time[right - 1] <= time[right] - grid, right - 1, right)
    if hold == "step":
        return np.asarray(values[nearest], dtype=float)
    seen = np.isfinite(values)
    if np.count_nonzero(seen) < 2:
        return np.full(time.size, np.nan)
    even = np.asarray(CubicSpline(time[seen], values[seen])(grid), dtype=float)
    alone = ~(seen[right - 1] & seen[right]) & (np.abs(grid - time[nearest]) > CLOSE * clock.dt)
    even[~seen[nearest] | alone] = np.nan
    return even


def check_step(dt: float, source: str) -> float:
    """Return the sampling step (s), unless no recorder has such a one."""
    if not SHORTEST <= dt <= LONGEST:
        raise DataError(
            f"{source}: the sampling step comes to {dt:.3g} s, wanted {SHORTEST:g} to {LONGEST:g} s: give time in "
            "seconds, or the rate in Hz"
        )
    return dt


def resolution(time: Array) -> float:
    """Return the unit (s) to which the time column (n,) was rounded when it was written."""
    size = float(np.max(np.abs(time)))
    return max(float(np.spacing(size)), _single(time, size), _decimals(time), _digits(time, size))


def _single(time: Array, size: float) -> float:
    exact = np.array_equal(time.astype(np.float32).astype(np.float64), time)
    return float(np.spacing(np.float32(size))) if exact else 0.0


def _decimals(time: Array) -> float:
    slack = 4 * np.spacing(np.abs(time))
    return next((10.0**-d for d in range(10) if np.all(np.abs(np.round(time, d) - time) <= slack)), 0.0)


def _digits(time: Array, size: float) -> float:
    """Return the unit of the last significant digit at `size` s, when all times have that many digits."""
    t = np.abs(time[time != 0])
    first = np.floor(np.log10(t))
    for digits in range(4, 10):
        places = 10.0 ** (digits - 1 - first)
        if np.all(np.abs(np.rint(t * places) / places - t) <= 4 * np.spacing(t)):
            return float(10.0 ** (np.floor(np.log10(size)) - digits + 1)) if size else 0.0
    return 0.0


def _typical(steps: Array, rounding: float) -> float:
    return float(np.mean(steps[steps <= 1.5 * np.median(steps) + rounding]))


def _check_order(time: Array, source: str) -> None:
    if time.size < 2:
        raise DataError(f"{source}: the time column holds {time.size} values: record longer")
    if not np.all(np.isfinite(time)):
        where = int(np.argmin(np.isfinite(time)))
        raise DataError(f"{source}: sample {where} of the time column is {time[where]}: fill it, or give rate instead")
    back = np.flatnonzero(np.diff(time) < 0)
    if back.size:
        k = int(back[0])
        raise DataError(
            f"{source}: time runs backwards from {time[k]:.9g} s to {time[k + 1]:.9g} s (sample {k + 1}), {back.size} "
            "times in all: sort the samples, or cut out one run with t_start and t_end"
        )
    if time[-1] == time[0]:
        raise DataError(f"{source}: the time column stays at {time[0]:.6g} s: name the column that holds seconds")


def _refuse_jitter(time: Array, source: str) -> None:
    """Refuse steps that differ too much; the rate that is advised is the mean one over the whole column."""
    steps, (_, dt) = np.diff(time), mean_line(time)
    off = int(np.count_nonzero(np.abs(steps - dt) > JITTER * dt))
    raise DataError(
        f"{source}: the time steps run from {steps.min():.4g} s to {steps.max():.4g} s, {off} of {steps.size} "
        f"more than {percent(JITTER)} from {dt:.4g} s: resample to an even step; if only the time stamps jitter, "
        f"give rate = {1 / dt:.6g} in place of time"
    )


def _refuse_steps(time: Array, dt: float, bad: NDArray[np.intp], source: str) -> None:
    steps = np.diff(time)
    if bad.size > max(3, time.size // 100) or np.abs(steps[bad] - dt).max() < 0.4 * dt:
        _refuse_jitter(time, source)
    k = int(bad[0])
    here, there = f"{time[k]:.9g}", f"{time[k + 1]:.9g}"
    if steps[k] > dt:
        more = f" (and at {bad.size - 1} more places)" if bad.size > 1 else ""
        raise DataError(
            f"{source}: a gap of {steps[k]:.4g} s in time between {here} s and {there} s{more}, where steps of "
            f"{dt:.4g} s were wanted: cut it into two recordings, one with t_end = {here}, one with t_start = {there}"
        )
    raise DataError(
        f"{source}: time moves by only {steps[k]:.4g} s from {here} s to {there} s (sample {k + 1}), where {dt:.4g} s "
        "was wanted: remove the repeated sample, or resample to an even step"
    )
