"""Checks whether a time column is an even grid within its own precision, and resampling where it nearly is.

A recorder samples evenly, while its stamps are rounded or delayed a little at random. Neither changes the mean rate,
which is found as the least-squares line through all stamps.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.errors import DataError
from lostmotion.recording.spec import Hold
from lostmotion.results import percent

Array = NDArray[np.float64]
JITTER = 0.01
"""The greatest jitter (rms) that is accepted, as a share of the sampling step."""
SINGLE = 5.0 * math.sqrt(2.0) * JITTER
"""The share of the sampling step by which a single step may differ: five standard deviations of two stamps."""
SEEN = 0.001
"""The jitter (rms) above which channels are resampled, as a share of the step.

At a tenth of the Nyquist frequency such a jitter moves a value by 0.03 % of the amplitude."""
CLOSE = 0.1
"""A sample within this share of a step is used for a grid point even if its neighbour was lost."""

SHORTEST, LONGEST = 1e-12, 1e6
"""The range of sampling steps (s) that is accepted."""


class GapError(DataError):
    """A time with gaps: times (n,) of the rows in s, their column, and (first row, row after the last) between gaps."""

    def __init__(self, says: str, time: Array, stretches: tuple[tuple[int, int], ...], column: str = "") -> None:
        super().__init__(says)
        self.time, self.stretches, self.column = time, stretches, column


@dataclass(frozen=True)
class EvenClock:
    """The even grid `start + dt * k` (s) of a time column; `uneven` tells that channels must be resampled to it."""

    dt: float
    uneven: bool
    notes: tuple[str, ...]
    start: float


def even_clock(time: Array, source: str, line: int = 0) -> EvenClock:
    """Return the even grid (s) of a time column (n,); raise `DataError` where there is none.

    `line` is the line of the first sample in its file, 0 where that is unknown.

    Time columns are often rounded, by single precision or by few printed digits. Deviations that rounding explains are
    accepted, so the step is the mean over the whole column: the median would be a multiple of the rounding. Jitter of
    the stamps, or of the true steps, up to `JITTER` of the step (rms) is accepted too; the grid is then the
    least-squares line through the stamps. `GapError` is raised for gaps, `DataError` for repeated stamps, decreasing
    time, more jitter, and a changing rate with which stamps deviate from the grid by more than a step.
    """
    _check_order(time, source, line)
    with np.errstate(over="ignore"):
        steps = np.diff(time)
    check_step(max(float(np.median(steps)), SHORTEST), source)
    rounding = resolution(time)
    if not _mean_step(steps, rounding) > 0.0:
        _refuse_repeats(time, source, line)
    dt = check_step(_mean_step(steps, rounding), source)
    if rounding > 2 * dt:
        _refuse_rounding(time, rounding, source, line)
    bad = np.flatnonzero(np.abs(steps - dt) > _largest_deviation(dt, rounding))
    if not bad.size and rounding > 0.5 * dt:
        bad = _find_alone(steps)
    if bad.size:
        _refuse_steps(time, dt, bad, source, line)
    return _fit_grid(time, rounding, source)


def _find_alone(steps: Array) -> NDArray[np.intp]:
    """Return the steps (n,) that are zero or twice as long as nearly all others, if they are one or two.

    Stamps as coarse as the step repeat now and then, again and again; one or two that do are repeated or lost rows.
    """
    usual = float(np.median(steps))
    odd = np.flatnonzero(np.abs(steps - usual) > 0.5 * usual)
    return odd if 0 < odd.size < 3 and steps.size > 100 else np.empty(0, dtype=np.intp)


def _refuse_repeats(time: Array, source: str, line: int) -> None:
    """Raise `DataError` for stamps of which most repeat the one before, each as often as the others."""
    repeated = np.flatnonzero(np.diff(time) == 0.0)
    raise DataError(
        f"{source}: {repeated.size} of {time.size} stamps repeat the one before (the first is"
        f" {name_sample(int(repeated[0]) + 1, line)}): remove these rows where the readings repeat too, or give rate ="
        f" {(time.size - 1) / float(np.ptp(time)):.4g} in place of time"
    )


def _refuse_rounding(time: Array, rounding: float, source: str, line: int) -> None:
    """Raise `DataError` for stamps that are coarser than the step; the rate is that between their first changes."""
    moved = np.flatnonzero(np.diff(time) > 0.0) + 1
    first, last = int(moved[0]), int(moved[-1])
    dt = float(np.ptp(time)) / (time.size - 1) if first == last else (time[last] - time[first]) / (last - first)
    raise DataError(
        f"{source}: the time column is rounded to {rounding:.3g} s, coarser than the step of {dt:.3g} s (it first "
        f"changes at {name_sample(first, line)}): write it with more digits, or give rate = {1.0 / dt:.4g} in place of "
        "time"
    )


def name_sample(k: int, line: int) -> str:
    """Return the words for a sample by its number from 0, with its line where that of the first one is known."""
    return f"sample {k}, line {line + k}" if line else f"sample {k}"


def _largest_deviation(dt: float, rounding: float) -> float:
    """Return the greatest deviation (s) of a single step that is accepted.

    Rounding changes a step by less than the resolution: a deviation of a whole unit has another cause.
    """
    single = SINGLE * dt
    return 0.999 * rounding + single if single < rounding < 0.5 * dt else max(single, 0.999 * rounding)


def _fit_grid(time: Array, rounding: float, source: str) -> EvenClock:
    """Return the grid of stamps without gaps; raise `DataError` where they deviate from it too much."""
    start, dt = mean_line(time)
    rest = time - start - dt * np.arange(time.size)
    steps = np.diff(rest)
    if _rms(steps) / math.sqrt(2.0) > 1.05 * JITTER * dt + 0.6 * rounding:
        _refuse_jitter(time, source)
    # Small errors of the steps add up to a random walk, which grows with the root of their number.
    walk = _rms(np.diff(steps)) * math.sqrt(0.5 * time.size) if rounding <= JITTER * dt else 0.0
    away = float(np.abs(rest).max())
    if away > max(rounding, dt, walk):
        raise DataError(
            f"{source}: the time column deviates by {away:.3g} s from an even step of {dt:.4g} s: resample to an "
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
        notes = (f"the time column is rounded to {rounding:.3g} s; an even step of {dt:.6g} s is used instead",)
    return EvenClock(dt, False, notes, float(time[0]))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def mean_line(time: Array) -> tuple[float, float]:
    """Return the first stamp and the step (s) of the line through all stamps (n,) by least squares."""
    index = np.arange(time.size) - 0.5 * (time.size - 1)
    since = time - time[0]
    dt = float(index @ since / (index @ index))
    return float(time[0] + since.mean() + dt * index[0]), dt


def resample_channel(time: Array, values: Array, clock: EvenClock, *, hold: Hold = "smooth") -> Array:
    """Return a channel (n,), read at `time` (s), on the even grid of `clock`, by cubic splines (de Boor 1978).

    For `hold="step"` the value of the nearest sample is used. The result is NaN where the nearest sample was lost, or
    where a neighbour was lost and no sample lies within a tenth of a step. The error of the spline falls with the
    fourth power of the step: with ten samples per period it is below 0.1 % of the effect of the jitter.
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
    """Return the sampling step (s); raise `DataError` outside of the accepted range."""
    if not SHORTEST <= dt <= LONGEST:
        raise DataError(
            f"{source}: the sampling step comes to {dt:.3g} s, expected {SHORTEST:g} to {LONGEST:g} s: give time in "
            "seconds, or the rate in Hz"
        )
    return dt


def resolution(time: Array) -> float:
    """Return the resolution (s) to which the time column (n,) was rounded when it was written."""
    size = float(np.max(np.abs(time)))
    return max(
        float(np.spacing(size)),
        _float32_resolution(time, size),
        _decimal_resolution(time),
        _digit_resolution(time, size),
    )


def _float32_resolution(time: Array, size: float) -> float:
    exact = np.array_equal(time.astype(np.float32).astype(np.float64), time)
    return float(np.spacing(np.float32(size))) if exact else 0.0


def _decimal_resolution(time: Array) -> float:
    slack = 4 * np.spacing(np.abs(time))
    return next((10.0**-d for d in range(10) if np.all(np.abs(np.round(time, d) - time) <= slack)), 0.0)


def _digit_resolution(time: Array, size: float) -> float:
    """Return the value (s) of the last significant digit at `size` s, if all times have equally many digits."""
    t = np.abs(time[time != 0])
    first = np.floor(np.log10(t))
    for digits in range(4, 10):
        places = 10.0 ** (digits - 1 - first)
        if np.all(np.abs(np.rint(t * places) / places - t) <= 4 * np.spacing(t)):
            return float(10.0 ** (np.floor(np.log10(size)) - digits + 1)) if size else 0.0
    return 0.0


def _mean_step(steps: Array, rounding: float) -> float:
    return float(np.mean(steps[steps <= 1.5 * np.median(steps) + rounding]))


def _check_order(time: Array, source: str, line: int) -> None:
    if time.size < 2:
        raise DataError(f"{source}: the time column holds {time.size} values: record longer")
    if not np.all(np.isfinite(time)):
        where = int(np.argmin(np.isfinite(time)))
        raise DataError(
            f"{source}: {name_sample(where, line)}: the time column is {time[where]}: fill it, or give rate instead"
        )
    back = np.flatnonzero(np.diff(time) < 0)
    if back.size:
        _refuse_order(time, back, source, line)
    if time[-1] == time[0]:
        raise DataError(f"{source}: the time column stays at {time[0]:.6g} s: name the column that holds seconds")


def _refuse_order(time: Array, back: NDArray[np.intp], source: str, line: int) -> None:
    """Raise `DataError` for time that decreases: two samples are exchanged, or the clock has started again."""
    k, middle = int(back[0]), float(np.median(np.diff(time)))
    found = f"{source}: time decreases from {time[k]:.9g} s to {time[k + 1]:.9g} s ({name_sample(k + 1, line)})"
    around = time[max(k - 1, 0) : k + 3].copy()
    place = min(k, 1)
    around[[place, place + 1]] = around[[place + 1, place]]
    if around.size > 2 and np.all(np.diff(around) > 0.0):
        raise DataError(
            f"{found}, {back.size} times in all: this sample and the one before it are exchanged: sort the samples by "
            "time"
        )
    if middle > 0.0 and time[k + 1] <= time[0] + 0.1 * (time[k] - time[0]):
        raise DataError(
            f"{found}, {back.size} times in all: the clock starts again there: cut out one run with t_start and t_end, "
            "or write each run into its own file"
        )
    raise DataError(f"{found}, {back.size} times in all: sort the samples, or cut out one run with t_start and t_end")


def _refuse_jitter(time: Array, source: str) -> None:
    """Raise `DataError` for uneven steps; the rate in the message is the mean over the whole column."""
    steps, (_, dt) = np.diff(time), mean_line(time)
    off = int(np.count_nonzero(np.abs(steps - dt) > JITTER * dt))
    raise DataError(
        f"{source}: the time steps run from {steps.min():.4g} s to {steps.max():.4g} s, {off} of {steps.size} "
        f"more than {percent(JITTER)} from {dt:.4g} s: resample to an even step; if only the time stamps jitter, "
        f"give rate = {1 / dt:.6g} in place of time"
    )


def _list_stretches(steps: Array, bad: NDArray[np.intp]) -> tuple[tuple[int, int], ...]:
    """Return (first row, row after the last) of each stretch between gaps; where stamps are coarse, lost rows are gaps.

    `steps` (n - 1,) are those of the time, and `bad` are those that are gaps.
    """
    edges = [0, *(int(one) + 1 for one in bad), steps.size + 1]
    long = [(first, last) for first, last in itertools.pairwise(edges) if last - first > 2]
    alone = [first + int(k) + 1 for first, last in long for k in _find_alone(steps[first : last - 1])]
    return tuple(itertools.pairwise(sorted({*edges, *alone})))


def _refuse_steps(time: Array, dt: float, bad: NDArray[np.intp], source: str, line: int) -> None:
    steps = np.diff(time)
    if bad.size > max(3, time.size // 100) or np.abs(steps[bad] - dt).max() < 0.4 * dt:
        _refuse_jitter(time, source)
    k = int(bad[0])
    here, there = f"{time[k]:.9g}", f"{time[k + 1]:.9g}"
    if steps[k] > dt:
        more = f" (and at {bad.size - 1} more places)" if bad.size > 1 else ""
        says = (
            f"{source}: a gap of {steps[k]:.4g} s in time between {here} s and {there} s{more} "
            f"({name_sample(k + 1, line)}), where steps of {dt:.4g} s were expected: cut it into two recordings, one "
            f"with t_end = {here}, one with t_start = {there}"
        )
        if np.any(steps[bad] <= dt):  # stamps that repeat too: parts between gaps are not even
            raise DataError(says)
        raise GapError(says, time, _list_stretches(steps, bad))
    count = f", {int(np.count_nonzero(steps <= 0.0))} such samples in all" if steps[k] <= 0.0 else ""
    raise DataError(
        f"{source}: time moves by only {steps[k]:.4g} s from {here} s to {there} s ({name_sample(k + 1, line)}), where "
        f"{dt:.4g} s was expected{count}: remove the repeated sample, or resample to an even step"
    )
