"""Whether a time column is an even grid, as far as its own precision lets one see."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError

Array = NDArray[np.float64]
JITTER = 0.01
"""Share of the sampling step by which a step may differ from it."""

SHORTEST, LONGEST = 1e-12, 1e6
"""Sampling steps (s) outside of which no recorder works."""


def check_time(time: Array, source: str) -> tuple[float, tuple[str, ...]]:
    """Return the sampling step (s) of the time column (n,), and notes; a column that is no even grid is refused.

    Time columns are often rounded, by single precision or by few printed digits. What rounding can explain is
    accepted, so the step is the mean over the whole column: the median would be a multiple of the rounding.
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
    # Rounding moves a step by less than the resolution: a step that is off by a whole unit was not rounded there.
    bad = np.flatnonzero(np.abs(steps - dt) > max(JITTER * dt, 0.999 * rounding))
    if bad.size:
        _refuse_steps(time, dt, bad, source)
    dt = float((time[-1] - time[0]) / (time.size - 1))
    away = _drift(time, dt, rounding, source)
    if rounding <= JITTER * dt or away <= JITTER * dt:
        return dt, ()
    return dt, (f"the time column is rounded to {rounding:.3g} s; an even step of {dt:.6g} s was put in its place",)


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


def _refuse_steps(time: Array, dt: float, bad: NDArray[np.intp], source: str) -> None:
    steps = np.diff(time)
    if bad.size > max(3, time.size // 100):
        raise DataError(
            f"{source}: the time steps run from {steps.min():.4g} s to {steps.max():.4g} s, {bad.size} of {steps.size} "
            f"more than {JITTER:.0%} from {dt:.4g} s: resample to an even step; if only the time stamps jitter, "
            f"give rate = {1 / dt:.6g} in place of time"
        )
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


def _drift(time: Array, dt: float, rounding: float, source: str) -> float:
    """Return how far (s) the time column lies from the even grid; more than its rounding can explain is refused."""
    away = float(np.abs(time - time[0] - dt * np.arange(time.size)).max())
    if rounding > JITTER * dt and away > max(rounding, dt):
        raise DataError(
            f"{source}: the time column strays by {away:.3g} s from an even step of {dt:.4g} s: resample to an "
            f"even step; if only the time stamps jitter, give rate = {1 / dt:.6g} in place of time"
        )
    return away
