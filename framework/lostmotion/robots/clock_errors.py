"""Errors of time stamps, found from readings: a late stamp shifts the readings of all joints, each by its speed.

A computer that stamps what it receives is late by a varying time. What the readings deviate from smooth motions is then
the same time in all joints, by which the stamps can be corrected. Errors that vary more slowly than the windows of the
smooth motions cannot be told from another motion. They are seen where the corrected steps are whole multiples of one
step: the robot has read its joints by an even clock, and some readings have been lost.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.parts import Array
from lostmotion.robots.log import JITTER, fill_missing

HALF, ORDER = 0.05, 4
"""Half of the length (s) of the windows over which motions are smoothed, and the order of the polynomials."""
FEWEST = 8
"""The smallest number of samples in half a window."""
ROUNDS = 2
"""The number of times that motions are smoothed, each time with the stamps as corrected so far."""
WHOLE, MOST = 0.1, 0.95
"""Steps are multiples of one step if they are within this share of it, for so many of them."""
SLIP = 0.1
"""The largest error (steps) of the mean stamp of a tenth of a log. A reading that is miscounted by one leaves 0.2."""
AGREE = 0.9
"""The correlation of the deviations of a joint with those that the other joints predict, above which they agree."""


@dataclass(frozen=True, eq=False)
class ClockErrors:
    """The time by which each stamp is late (samples,) in s, and how the deviations of each joint agree with the others.

    `agreement` (joints,) are correlations over samples in which both move faster than in half of the log; NaN for a
    joint that is too slow for its noise to show the errors.
    """

    late: Array
    agreement: Array

    @property
    def clear(self) -> bool:
        """Whether all joints that move, two at least, show the same errors."""
        told = self.agreement[np.isfinite(self.agreement)]
        return len(told) > 1 and bool(np.min(told) > AGREE)


def correct_stamps(time: Array, positions: Array) -> tuple[Array, tuple[str, ...]]:
    """Return increasing stamps (samples,) in s without the errors that positions (samples, joints) show, and a note.

    Stamps that are even, and those on whose errors the joints do not agree, are returned as they are.
    """
    steps = np.diff(time)
    if not len(steps) or np.min(steps) <= 0.0 or np.std(steps) <= JITTER * np.median(steps):
        return time, ()
    found = find_clock_errors(time, np.stack([fill_missing(column) for column in positions.T], axis=1))
    if found is None or not found.clear:
        return time, ()
    corrected = np.maximum.accumulate(time - found.late)
    even = _count_steps(corrected, time)
    error = float(np.std(time - (corrected if even is None else even)))
    note = (
        f"The readings of all joints show the same errors of the time stamps, {1e3 * error:.3g} ms (sd): the stamps are"
        " corrected by them."
    )
    if even is None:
        return corrected, (note,)
    return even, (note, f"The joints were read by an even clock, every {1e3 * np.min(np.diff(even)):.4g} ms.")


def _count_steps(corrected: Array, time: Array) -> Array | None:
    """Return the times (samples,) of an even clock from nearly correct ones; None where these are not even.

    Its step and its beginning are those that fit the stamps best.
    """
    steps = np.diff(corrected)
    counts = np.round(steps / np.median(steps))
    if np.min(counts) < 1.0 or np.mean(np.abs(steps / np.median(steps) - counts) < WHOLE) < MOST:
        return None
    number = np.concatenate([[0.0], np.cumsum(counts)])
    step, begin = np.polyfit(number, time, 1)
    even = begin + step * number
    slips = [abs(float(np.mean(part))) for part in np.array_split(time - even, 10)]
    return np.asarray(even) if max(slips) < SLIP * step else None


def find_clock_errors(time: Array, positions: Array) -> ClockErrors | None:
    """Return the errors of increasing stamps (samples,) in s, from positions (samples, joints) of any unit.

    None for a single joint, and for fewer samples than a few windows have.
    """
    half = max(FEWEST, round(HALF / float(np.median(np.diff(time)))))
    if positions.shape[1] < 2 or len(time) < 4 * half:
        return None
    away, speed = _find_deviations(time, positions, half)
    agreement, late = _compare_joints(away, speed), np.zeros(len(time))
    for _ in range(ROUNDS - 1):
        late = late + _find_lateness(away, speed)[0]
        away, speed = _find_deviations(time - late, positions, half)
    return ClockErrors(late + _find_lateness(away, speed)[0], agreement)


def _find_deviations(time: Array, positions: Array, half: int) -> tuple[Array, Array]:
    """Return by how much smooth motions exceed positions (samples, joints), and their speeds.

    Around each sample a polynomial is fitted to `half` samples on either side, with weights that fall to the ends.
    """
    samples = len(time)
    moments, products = np.zeros((samples, 2 * ORDER + 1)), np.zeros((samples, ORDER + 1, positions.shape[1]))
    unit = half * float(np.median(np.diff(time)))
    for shift in range(-half, half + 1):
        at = np.clip(np.arange(samples) + shift, 0, samples - 1)
        inside = at == np.arange(samples) + shift
        x = (time[at] - time) / unit
        weight = inside * (1.0 - (shift / (half + 1)) ** 2)
        powers = x[:, None] ** np.arange(2 * ORDER + 1)
        moments += weight[:, None] * powers
        products += (weight[:, None] * powers[:, : ORDER + 1])[:, :, None] * (positions[at] - positions)[:, None, :]
    normal = moments[:, np.add.outer(np.arange(ORDER + 1), np.arange(ORDER + 1))]
    found = np.linalg.solve(normal, products)
    return np.asarray(found[:, 0]), np.asarray(found[:, 1] / unit)


def _find_lateness(away: Array, speed: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Return the time (samples,) that deviations and speeds (samples, joints) tell, and where it is known better.

    Joints count by their noise. Samples in which all are slow tell little, and their time is drawn to zero.
    """
    weights = 1.0 / np.maximum(_measure_noise(away, speed) ** 2, 1e-30)
    told, known = (away * speed) @ weights, speed**2 @ weights
    sure = known >= np.median(known)
    spread = max(float(np.mean((told[sure] / known[sure]) ** 2)), 1e-30)
    return told / (known + 1.0 / spread), sure


def _measure_noise(away: Array, speed: Array) -> Array:
    """Return the deviations (rms, joints) of each joint in the fifth of the log in which it is slowest."""
    slow = np.abs(speed) <= np.quantile(np.abs(speed), 0.2, axis=0)
    return np.sqrt([np.mean(column[rest] ** 2) for column, rest in zip(away.T, slow.T, strict=True)])


def _compare_joints(away: Array, speed: Array) -> Array:
    """Return the correlation (joints,) of the deviations of each joint with those that the others predict."""
    found, noise = [], _measure_noise(away, speed)
    for j in range(speed.shape[1]):
        rest = np.arange(speed.shape[1]) != j
        late, sure = _find_lateness(away[:, rest], speed[:, rest])
        fast = sure & (np.abs(speed[:, j]) > np.median(np.abs(speed[:, j])))
        told = late[fast] * speed[fast, j]
        seen = len(told) > 1 and np.std(told) > noise[j]
        found.append(np.corrcoef(told, away[fast, j])[0, 1] if seen else np.nan)
    return np.array(found)
