"""Times that a table holds in several columns: seconds and nanoseconds of ROS, or hours, minutes and seconds."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_SECONDS = re.compile(r"(.*?)(s|secs?|seconds?)", re.IGNORECASE)
PARTS = {
    1e-9: re.compile(r"(.*?)(ns|nsecs?|nanosecs?|nanoseconds?)", re.IGNORECASE),
    1e-6: re.compile(r"(.*?)(us|µs|usecs?|micros|microsecs?|microseconds?)", re.IGNORECASE),
    1e-3: re.compile(r"(.*?)(ms|msecs?|millis|milli ?secs?|milli ?seconds?|millisekunden?|ミリ秒|мс)", re.IGNORECASE),
}
"""Names of the seconds of a stamp, and of the rest of it, with the size of one count in s."""
_CLOCK = tuple(
    re.compile(names, re.IGNORECASE)
    for names in ("h|hours?|stunden?|hh", "m|mins?|minutes?|minuten?|mm", "s|secs?|seconds?|sekunden?|ss")
)
_DAY = 86400.0


def join_times(columns: Mapping[str, Array]) -> dict[str, Array]:
    """Return the times (n,) in s that are spread over columns, by a name made of theirs; empty where there are none."""
    return {**_join_stamps(columns), **_join_clock(columns)}


def _join_stamps(columns: Mapping[str, Array]) -> dict[str, Array]:
    """Return the sums of a column of whole seconds and one of the nanoseconds or microseconds that belong to it."""
    found: dict[str, Array] = {}
    for size, pattern in PARTS.items():
        for name, rest in columns.items():
            stem = pattern.fullmatch(name.strip())
            for other, whole in columns.items():
                same = _SECONDS.fullmatch(other.strip())
                if stem and same and same[1] == stem[1] and _are_parts(whole, rest, 1.0 / size):
                    found[f"{other} and {name}"] = (whole - whole[0]) + size * rest
    return found


def _are_parts(whole: Array, rest: Array, most: float) -> bool:
    """Return whether a column holds whole numbers, and another one whole numbers below `most`."""
    if whole.size != rest.size or not whole.size or not (np.isfinite(whole).all() and np.isfinite(rest).all()):
        return False
    whole_numbers = np.array_equal(whole, np.rint(whole)) and np.array_equal(rest, np.rint(rest))
    return bool(whole_numbers and rest.min() >= 0.0 and rest.max() < most)


def _join_clock(columns: Mapping[str, Array]) -> dict[str, Array]:
    """Return the time of day from columns of hours, minutes and seconds, which goes on over midnight."""
    names = [[name for name in columns if pattern.fullmatch(name.strip())] for pattern in _CLOCK]
    if any(len(found) != 1 for found in names):
        return {}
    hour, minute, second = (columns[found[0]] for found in names)
    if len({hour.size, minute.size, second.size}) > 1 or not hour.size:
        return {}
    limits = ((hour, 24.0), (minute, 60.0), (second, 60.0))
    if not all(np.isfinite(part).all() and part.min() >= 0.0 and part.max() < most for part, most in limits):
        return {}
    if not (np.array_equal(hour, np.rint(hour)) and np.array_equal(minute, np.rint(minute))):
        return {}
    total = 3600.0 * hour + 60.0 * minute + second
    passed = np.concatenate(([0], np.cumsum(np.diff(total) < -0.5 * _DAY)))
    return {f"{names[0][0]}, {names[1][0]} and {names[2][0]}": total + _DAY * passed}
