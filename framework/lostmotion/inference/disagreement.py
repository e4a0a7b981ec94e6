"""Where a model disagrees with a recording: its innovations over windows of time, hits, or recordings.

The squared innovation over its variance has the mean one where the model holds. Its mean over a window is the ratio of
the observed to the expected variation there.

The largest window is tested by permutation. Under the null hypothesis that the disagreement is the same everywhere,
blocks of errors are exchangeable. Blocks are longer than the memory of the squared errors, so that neighbouring errors
stay together (Carlstein, Annals of Statistics 14 (1986) 1171-1179). The p-value of each window is that of the largest
excess over all windows (Westfall, Young 1993).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit
from lostmotion.inference.shares import adjust_p_values
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import filter_recording

WINDOWS = 30
"""The greatest number of windows of a recording: more are too narrow to be read in a figure of a page."""
SHORTEST, PERIODS = 40, 1
"""The least number of samples and of periods of the drive in a window, so that it contains all phases of the motion."""
FEWEST = 4
"""With fewer windows, or blocks to a window, nothing is tested."""
MEMORIES = 3
"""The length of a block, in lags at which squared errors become uncorrelated."""
DRAWS = 999
LARGEST = 1e12
"""The largest squared error: after a divergence, squares of squares must be finite."""
MOST_BLOCKS = 3000
"""More blocks make the test slower, and not sharper."""

Numbers = NDArray[np.int64]


@dataclass(frozen=True)
class Windows:
    """Windows of a series: `edges` (windows + 1,) in samples; `aligned` says that each begins with an event (a hit).

    After an event a motion decays, so errors are compared at the same time after each event.
    """

    edges: Numbers
    aligned: bool = False

    def __len__(self) -> int:
        return len(self.edges) - 1


def compute_squares(fit: Fit, observation: Observation) -> Array:
    """Return the squared standardised innovation (samples,), mean over the sensors; NaN where none was read."""
    seen = filter_recording(fit.posterior.on((observation,)), fit.theta)
    read = seen.taken & np.isfinite(seen.errors) & np.isfinite(seen.variances)
    with np.errstate(over="ignore", invalid="ignore"):
        squares = np.where(read, np.minimum(seen.errors**2 / seen.variances, LARGEST), np.nan)
    counts = np.sum(read, axis=1)
    return np.asarray(np.where(counts > 0, np.nansum(squares, axis=1) / np.maximum(counts, 1), np.nan))


def make_even_windows(samples: int, period: float | None = None, *, shortest: int = SHORTEST) -> Windows:
    """Return windows of equal length; `period` is that of the drive in samples."""
    long = max(shortest, math.ceil(PERIODS * (period or 0.0)))
    count = max(1, min(WINDOWS, samples // long))
    return Windows(np.round(np.linspace(0, samples, count + 1)).astype(np.int64))


def make_hit_windows(samples: int, starts: Sequence[int]) -> Windows:
    """Return one window for each hit, from the sample where it begins to the next one."""
    return Windows(np.array([*starts, samples], dtype=np.int64), aligned=True)


def average_windows(squares: Array, windows: Windows) -> Array:
    """Return the mean (windows,) of squared errors; NaN for a window without any."""
    parts = [squares[a:b] for a, b in zip(windows.edges[:-1], windows.edges[1:], strict=True)]
    return np.array([np.nanmean(part) if np.isfinite(part).any() else math.nan for part in parts])


def find_memory(squares: Array, windows: Windows) -> int:
    """Return the lag (samples) at which squared errors of one window become uncorrelated.

    The mean of each window is subtracted first: differences between windows are no memory. For windows that begin with
    an event the mean course after it is subtracted as well.
    """
    left = np.zeros(len(squares))
    for a, b in zip(windows.edges[:-1], windows.edges[1:], strict=True):
        part = squares[a:b]
        left[a:b] = np.nan_to_num(part - np.nanmean(part)) if np.isfinite(part).any() else 0.0
    if windows.aligned:
        whole, long = _select_comparable(windows)
        rows = windows.edges[whole][:, None] + np.arange(long)[None, :]
        course = left[rows] - np.mean(left[rows], axis=0)
        left = np.zeros(len(squares))
        left[rows] = course
    power = np.abs(np.fft.rfft(left, 2 * len(left))) ** 2
    correlation = np.fft.irfft(power)[: len(left)]
    if not correlation[0] > 0.0:
        return 1
    below = np.flatnonzero(correlation / correlation[0] < 2.0 / math.sqrt(len(left)))
    return int(below[0]) if below.size else len(left)


def compute_window_p(squares: Array, windows: Windows, rng: np.random.Generator) -> Array | None:
    """Return the p-value (windows,) of each window, adjusted for all of them; None where there are too few data."""
    block = choose_block(squares, windows)
    if windows.aligned:
        return _compare_after_events(squares, windows, block, rng)
    starts = np.arange(0, len(squares) - block + 1, block)
    which = np.searchsorted(windows.edges, starts + block // 2, side="right") - 1
    return _permute(_average_blocks(squares, starts, block), which, np.zeros_like(which), rng)


def compute_recording_p(parts: Sequence[Array], rng: np.random.Generator) -> Array | None:
    """Return the p-value (recordings,) of the disagreement in each of several recordings, adjusted for all of them."""
    values, which = _join_blocks(parts)
    return _permute(values, which, np.zeros_like(which), rng)


def compute_trend(parts: Sequence[Array], levels: Array, rng: np.random.Generator) -> tuple[float, float] | None:
    """Return the correlation of the disagreement in recordings with their log level, and its two-sided p-value.

    None for fewer than three levels.
    """
    if len(np.unique(levels)) < FEWEST - 1 or not np.all(levels > 0.0):
        return None
    values, which = _join_blocks(parts)
    at = np.log(levels)[which]
    if len(values) < FEWEST * len(parts) or not np.std(values) > 0.0:
        return None
    drawn = rng.permuted(np.tile(values, (DRAWS, 1)), axis=1)
    at = at - np.mean(at)
    slopes, slope = np.abs(drawn @ at), float(values @ at)
    p = (1.0 + float(np.sum(slopes >= abs(slope)))) / (1.0 + DRAWS)
    return float(np.corrcoef(values, at)[0, 1]), p


def _join_blocks(parts: Sequence[Array]) -> tuple[Array, Numbers]:
    """Return the blocks of all recordings, and the recording of each."""
    whole = [Windows(np.array([0, len(part)])) for part in parts]
    block = max(MEMORIES * find_memory(part, one) for part, one in zip(parts, whole, strict=True))
    block = max(block, sum(map(len, parts)) // MOST_BLOCKS, 1)
    cut = [_average_blocks(part, np.arange(0, len(part) - block + 1, block), block) for part in parts]
    return np.concatenate(cut), np.repeat(np.arange(len(cut)), [len(c) for c in cut])


def choose_block(squares: Array, windows: Windows) -> int:
    """Return the length (samples) of the blocks that are permuted."""
    return max(1, MEMORIES * find_memory(squares, windows), len(squares) // MOST_BLOCKS)


def _select_comparable(windows: Windows) -> tuple[Numbers, int]:
    """Return the windows of at least half of the usual length, and the length of the shortest of them.

    A hit just before the end of a recording, or before the next one, leaves too few data.
    """
    lengths = np.diff(windows.edges)
    whole = np.flatnonzero(lengths >= 0.5 * np.median(lengths))
    return whole, int(lengths[whole].min())


def _compare_after_events(squares: Array, windows: Windows, block: int, rng: np.random.Generator) -> Array | None:
    """Return the p-value (windows,) of each window; blocks at the same time after an event are permuted."""
    whole, long = _select_comparable(windows)
    count = long // block
    after = np.tile(np.arange(count), len(whole))
    which = np.repeat(np.arange(len(whole)), count)
    told = _permute(_average_blocks(squares, windows.edges[whole][which] + after * block, block), which, after, rng)
    if told is None:
        return None
    p = np.ones(len(windows))
    p[whole] = told
    return p


def _average_blocks(squares: Array, starts: Numbers, block: int) -> Array:
    """Return the mean (starts,) of each block; where nothing was read, the mean of all."""
    if not len(starts):
        return np.zeros(0)
    rows = squares[starts[:, None] + np.arange(block)[None, :]]
    read = np.isfinite(rows)
    told = np.sum(np.where(read, rows, 0.0), axis=1) / np.maximum(read.sum(axis=1), 1)
    return np.asarray(np.where(read.any(axis=1), told, np.nanmean(squares)))


def _permute(values: Array, which: Numbers, strata: Numbers, rng: np.random.Generator) -> Array | None:
    """Return the p-value of the mean (windows,) of blocks, which are permuted within each stratum."""
    count = int(which.max()) + 1 if len(which) else 0
    sizes = np.bincount(which, minlength=count)
    if count < 2 or len(values) < FEWEST * count or sizes.min() < 1 or not np.std(values) > 0.0:
        return None
    drawn = np.tile(values, (1 + DRAWS, 1))
    for stratum in np.unique(strata):
        columns = np.flatnonzero(strata == stratum)
        drawn[1:, columns] = rng.permuted(drawn[1:, columns], axis=1)
    member = np.zeros((len(values), count))
    member[np.arange(len(values)), which] = 1.0 / sizes[which]
    return adjust_p_values((drawn @ member).T)[1]
