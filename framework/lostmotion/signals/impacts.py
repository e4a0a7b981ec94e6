"""Hammer tests: hits in a measured force, onsets of decays in a response, and overload of sensors."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import maximum_filter1d

from lostmotion.errors import DataError

Array = NDArray[np.float64]
LOUD = 10.0
"""A pulse counts above this many standard deviations of the noise."""
WEAKEST = 0.05
"""A pulse is a hit from this share of the largest pulse on; a second pulse counts from this share of the first on."""
TWICE, AT_ONCE = 20.0, 0.1
"""A second pulse within this many durations or this time (s) belongs to the same hit: no hand strikes so fast."""
FLANK = 0.01
"""A pulse begins and ends at this share of its peak."""
RISE, PAST, AHEAD = 2.5, 8.0, 2.0
"""The rise of the envelope at an onset, and the number of compared periods before and after it."""
LEAST_PAST = 64
FLAT, FLATTER, EQUAL = 0.01, 3.0, 3
"""A flat top: its height over the range, its length over that of an equally steep round top, and equal samples."""
STUCK = 0.01
"""The default of the setting `recording.stuck`, for callers without settings."""


@dataclass(frozen=True)
class Hit:
    """A hit of a hammer from sample `start` up to but excluding `stop`, including a second contact.

    `peak` (N) has the sign of the force, `impulse` (N s) is that of all contacts, `duration` (s) that of the first
    contact. `second` is the peak of a second contact over that of the first one, 0 without one, and `after` (s) its
    delay.
    """

    start: int
    stop: int
    peak: float
    impulse: float
    duration: float
    second: float = 0.0
    after: float = 0.0

    @property
    def double(self) -> bool:
        """Whether the hammer had a second contact."""
        return self.second > 0.0


@dataclass(frozen=True)
class Overload:
    """Flat tops of a signal at its extreme `value`: number of samples, number of runs, and the first sample.

    `exact` tells that the samples are equal; otherwise they are equal within the noise.
    """

    value: float
    samples: int
    stretches: int
    first: int
    exact: bool


def hits_of(force: ArrayLike, dt: float) -> tuple[Hit, ...]:
    """Return the hits in a measured force (n,), sampled every `dt` s, in their order.

    A hit begins with a pulse of ten standard deviations of the noise (from the median deviation) and 5 % of the
    largest pulse. A second pulse of 5 % of the first one or more, within twenty durations of the first or 0.1 s, makes
    it a double hit. The second pulse is searched in the force averaged over about the duration of the first, so that
    noise and vibrations of the hammer that are faster than its contact do not count.
    """
    readings = _check_readings(force, dt)
    if not np.ptp(readings):
        return ()
    noise = 1.4826 * float(np.median(np.abs(readings)))
    sign = 1.0 if readings.max() >= -readings.min() else -1.0
    pulses = sign * readings
    threshold = max(LOUD * noise, WEAKEST * float(pulses.max()))
    found: list[Hit] = []
    over = np.flatnonzero(pulses > threshold)
    place = 0
    while over.size and (over := over[over >= place]).size:
        hit = _make_hit(pulses, dt, int(over[0]), noise)
        found.append(Hit(hit.start, hit.stop, sign * hit.peak, sign * hit.impulse, *_contact_fields(hit)))
        place = max(hit.stop, hit.start + math.ceil(_second_pulse_time(hit.duration) / dt))
    return tuple(found)


def _contact_fields(hit: Hit) -> tuple[float, float, float]:
    return hit.duration, hit.second, hit.after


def _second_pulse_time(duration: float) -> float:
    """Return the time (s) from its start within which a second pulse belongs to a hit."""
    return max(TWICE * duration, AT_ONCE)


def _check_readings(values: ArrayLike, dt: float) -> Array:
    """Return the readings (n,) without their median; lost samples are 0."""
    readings = np.array(values, dtype=np.float64)
    if readings.ndim != 1 or not readings.size:
        raise DataError(f"the readings have the shape {readings.shape}: give one channel, shape (n,)")
    if not (math.isfinite(dt) and dt > 0.0):
        raise DataError(f"the sampling step is {dt:g} s: give a positive one")
    there = np.isfinite(readings)
    if not there.any():
        raise DataError("all readings are NaN or infinite: check the sensor and the column")
    return np.asarray(np.where(there, readings - np.median(readings[there]), 0.0))


def _make_hit(pulses: Array, dt: float, first: int, noise: float) -> Hit:
    """Return the hit whose pulse exceeds the threshold at a sample."""
    start, top, stop = _find_pulse(pulses, first, noise)
    duration = (stop - start) * dt
    second = _find_second(pulses, (top, stop), start + math.ceil(_second_pulse_time(duration) / dt), noise)
    if second is None:
        return Hit(start, stop, float(pulses[top]), float(pulses[start:stop].sum()) * dt, duration)
    _, later, end = _find_pulse(pulses, second, noise)
    impulse = float(pulses[start:end].sum()) * dt
    share = float(pulses[later] / pulses[top])
    return Hit(start, end, float(pulses[top]), impulse, duration, share, (later - top) * dt)


def _find_pulse(pulses: Array, inside: int, noise: float) -> tuple[int, int, int]:
    """Return start, top and stop of the pulse around a sample; it ends where it falls to its flank or to the noise."""
    floor = 2.0 * noise
    top = inside
    for _ in range(2):
        below = np.flatnonzero(pulses[top:] <= max(floor, FLANK * pulses[top]))
        stop = top + int(below[0]) if below.size else pulses.size
        top = top + int(np.argmax(pulses[top:stop]))
    before = np.flatnonzero(pulses[:top] <= max(floor, FLANK * pulses[top]))
    return int(before[-1]) + 1 if before.size else 0, top, stop


def _find_second(pulses: Array, pulse: tuple[int, int], end: int, noise: float) -> int | None:
    """Return the sample at the top of a second pulse after a first one (top, stop) and before `end`, or None."""
    top, stop = pulse
    width = max(1, (stop - top) | 1)
    low = max(0, top - 2 * width)
    smooth = np.convolve(pulses[low : min(end, pulses.size) + width], np.ones(width) / width, mode="same")
    after = smooth[stop + width // 2 - low : end - low]
    if not after.size:
        return None
    place = int(np.argmax(after))
    threshold = max(WEAKEST * float(smooth[top - low]), 6.0 * noise / math.sqrt(width))
    # At its first sample the mean may contain the end of the first pulse: a second pulse rises before it falls.
    if place == 0 or after[place] < threshold:
        return None
    around = stop + width // 2 + place
    return around - width // 2 + int(np.argmax(pulses[around - width // 2 : around + width // 2 + 1]))


def onsets_of(values: ArrayLike, dt: float) -> tuple[int, ...]:
    """Return the sample numbers at which a vibration starts again in a response (n,), sampled every `dt` s.

    There the largest deviation from the median within half a period of the strongest frequency is 2.5 times that of the
    eight periods before, and still 1.5 times half a period to two periods later, which excludes single outliers. Where
    the first eight periods are 2.5 times as large as the quiet tenth of all, they contain an onset, at the first sample
    if the vibration is large there. A hit during a vibration that is still large is not detected.
    """
    size = np.abs(_check_readings(values, dt))
    period = _strongest_period(_check_readings(values, dt))
    past, ahead = max(LEAST_PAST, round(PAST * period)), max(2, round(AHEAD * period))
    if size.size < 2 * past or not size.any():
        return ()
    blocks = size[: size.size // past * past].reshape(-1, past).max(axis=1)
    quiet = float(np.quantile(blocks, 0.1))
    at_once = max(2, ahead // 4)
    before, soon = _rolling_maximum(size, past), _rolling_maximum(size, at_once)
    found = [_find_first(size[:past], period)] if blocks[0] > RISE * quiet else []
    rising = past + np.flatnonzero(soon[past:] > RISE * np.maximum(before[:-past], quiet))
    for place in rising.tolist():
        level = float(before[place - past])
        loud = place + int(np.argmax(size[place : place + at_once] > RISE * max(level, quiet)))
        onset = loud - int(np.argmax(size[max(0, loud - ahead) : loud + 1][::-1] <= level)) + 1
        later = size[loud + at_once : loud + ahead].max(initial=0.0)
        if later > 1.5 * level and (not found or onset >= found[-1] + past):
            found.append(onset)
    return tuple(found)


def _rolling_maximum(size: Array, width: int) -> Array:
    """Return the maximum of `width` samples from each sample on, (n,)."""
    return np.asarray(maximum_filter1d(size, width, mode="constant", cval=0.0, origin=-(width // 2)))


def _find_first(size: Array, period: float) -> int:
    """Return the sample at which the vibration in the first periods begins; 0 where it is large from the beginning."""
    place = int(np.argmax(size > WEAKEST * size.max()))
    return place if place > 0.5 * period else 0


def _strongest_period(x: Array) -> float:
    """Return the period (samples) of the strongest frequency."""
    height = np.abs(np.fft.rfft(x))
    strongest = 2 + int(np.argmax(height[2:])) if height.size > 2 else 1
    return x.size / strongest


def overloaded(values: ArrayLike) -> tuple[Overload, ...]:
    """Return the flat tops of a signal (n,) at its largest and at its smallest value, at most one entry for each.

    A top is flat where three samples or more are equal to the extreme value of the signal; or, with noise behind the
    limit, where four samples or more in a row lie within 1 % of its range from the extreme; and where a parabola with
    the same slope at its flanks would have stayed in this range, or within the least step between samples, less than a
    third as long. So reversals and rests of a machine with an encoder are no overload.
    """
    readings = np.array(values, dtype=np.float64)
    if readings.ndim != 1 or np.count_nonzero(np.isfinite(readings)) < 2:
        return ()
    span = float(np.nanmax(readings) - np.nanmin(readings))
    if not (math.isfinite(span) and span > 0.0):
        return ()
    ends = [_find_flat_tops(sign * readings, span) for sign in (1.0, -1.0)]
    return tuple(
        Overload(sign * found.value, found.samples, found.stretches, found.first, found.exact)
        for sign, found in zip((1.0, -1.0), ends, strict=True)
        if found is not None
    )


def _find_flat_tops(x: Array, span: float) -> Overload | None:
    """Return the flat tops at the largest value, equal ones if there are any, or None without any."""
    largest = float(np.nanmax(x))
    changes = np.abs(np.diff(x))
    grain = float(np.min(changes, where=changes > 0.0, initial=span))
    tops = [run for run in _find_runs(x == largest) if run[1] - run[0] >= EQUAL and _is_flat(x, run, grain)]
    broad = [
        run for run in _find_runs(x >= largest - FLAT * span) if _is_inside(x, run) and _is_flat(x, run, FLAT * span)
    ]
    # A motion that stops or reverses at an encoder moves by at most a step of the encoder per sample.
    equal, near = ([run for run in runs if _flank_fall(x, run) > 2.5 * grain] for runs in (tops, broad))
    runs = equal or near
    if not runs:
        return None
    value = largest if equal else float(np.mean(np.concatenate([x[low:high] for low, high in near])))
    return Overload(value, sum(high - low for low, high in runs), len(runs), runs[0][0], bool(equal))


def _is_inside(x: Array, run: tuple[int, int]) -> bool:
    """Return whether a top (first sample, stop) has both flanks in the record, and enough samples despite noise."""
    return run[1] - run[0] > EQUAL and run[0] >= 2 and run[1] + 2 <= x.size


def _is_flat(x: Array, run: tuple[int, int], height: float) -> bool:
    """Return whether a top (first sample, stop) of a height is much longer than a parabola with its flanks."""
    # A parabola of height h with the slope s at its flanks is 4 h / s long.
    return (run[1] - run[0]) * _flank_fall(x, run) / 2.0 > FLATTER * 4.0 * height


def _flank_fall(x: Array, run: tuple[int, int]) -> float:
    """Return the fall of a signal over two samples beside a top, at its flatter flank; 0 where both are unknown.

    For a top at an end of the record, or beside lost samples, the other flank is used.
    """
    low, high = run
    pairs = [(low, low - 2), (high - 1, high + 1)]
    return min((float(x[t] - x[f]) for t, f in pairs if 0 <= f < x.size and np.isfinite(x[f])), default=0.0)


def _find_runs(flags: NDArray[np.bool_]) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8)))
    return [(int(low), int(high)) for low, high in zip(edges[::2], edges[1::2], strict=True)]


def note_hits(force: ArrayLike, dt: float) -> Iterator[str]:
    """Yield a note for each double hit in a measured force (n,), taken every `dt` s."""
    for number, hit in enumerate(hits_of(force, dt), 1):
        if hit.double:
            yield (
                f"hit {number} at {hit.start * dt:.4g} s is a double hit: a second contact of"
                f" {100.0 * hit.second:.0f} % of its "
                f"peak follows after {1e3 * hit.after:.3g} ms; both are inputs that were measured, so the model is "
                "driven by both; a free decay begins after the second one only"
            )


def note_overload(values: ArrayLike, what: str, unit: str = "", *, stuck: float = STUCK) -> Iterator[str]:
    """Yield a note for each end at which the samples (n,) of a sensor have flat tops.

    More than a share `stuck` of equal samples gives no note: that is a stuck channel, or a machine at rest.
    """
    readings = np.asarray(values, dtype=np.float64)
    for found in overloaded(readings):
        if found.exact and found.samples > stuck * readings.size:
            continue
        word = "largest" if found.value > np.nanmedian(readings) else "smallest"
        at = f"{found.value:.4g} {unit}".rstrip()
        stretches = "1 stretch" if found.stretches == 1 else f"{found.stretches} stretches"
        yield (
            f"{what} stays at its {word} value {at} for {found.samples} samples in {stretches}, the first at sample "
            f"{found.first}: it was overloaded, and its readings there are not the motion; empty these cells, and take "
            "a larger range or strike less hard next time"
        )
