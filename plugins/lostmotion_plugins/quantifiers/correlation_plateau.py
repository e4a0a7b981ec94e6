"""Where the logarithm of a correlation sum is straight: slopes of all windows, weighed against one another.

No window is chosen by eye. Each window of radii and each dimension has a slope with its jackknife error, a bend (upper
minus lower half), and a rise from the dimension before. Long, straight windows that agree count most, and what
they disagree about is the systematic error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion_plugins.quantifiers.correlation import EIGHTHS, Sums, jackknife

Windows = NDArray[np.int64]
EVERY = 2
"""Codes from one radius to the next: quarters of an octave."""
SHORTEST = 6
"""The least length of a window in such steps: one octave and a half."""
LARGEST = 0.1
"""Radii are at most this share of the range: beyond it the ends of the attractor are felt."""
ENOUGH = 200
"""Pairs in the smallest radius of a window."""
SOFT = 0.05
"""Bends and errors below this make no difference."""
REPEATS = 0.25
"""A smaller slope is no dimension of a motion: below those radii the recording repeats itself."""
KEPT = 3
"""Successive dimensions that must agree."""


@dataclass(frozen=True, eq=False)
class Plateau:
    """Slope of the straight piece by dimension (dims,), what is found without each block, and where it lies.

    `left` (blocks, dims) are the slopes with a block left out, `scatter` (dims,) what the windows disagree about.
    `weight` (dims, windows) are those of `windows` (windows, 2), `first` is the smallest of the three dimensions that
    agree best, `rise` what a further dimension adds there, `bend` the change of slope across the windows.
    """

    value: Array
    left: Array
    scatter: Array
    weight: Array
    windows: Windows
    radii: Array
    bend: Array
    first: int

    @property
    def dims(self) -> slice:
        """The dimensions that agree, as indices."""
        return slice(self.first - 1, self.first - 1 + KEPT)

    @property
    def mean(self) -> float:
        """The mean slope of the dimensions that agree."""
        return float(self.value[self.dims].mean())

    @property
    def error(self) -> float:
        """The standard error: of the jackknife, of the choice of window, and of the choice of dimension."""
        chance = float(jackknife(self.left[:, self.dims].mean(axis=1)))
        window = float(self.scatter[self.dims].mean())
        return math.sqrt(chance**2 + window**2 + float(self.value[self.dims].var()))

    @property
    def rise(self) -> float:
        """What each further dimension adds where the dimensions agree best."""
        found = self.value[self.dims]
        return float(found[-1] - found[0]) / (KEPT - 1)

    @property
    def ends(self) -> tuple[float, float]:
        """The smallest and the largest radius, each a weighted mean over the windows."""
        weight = self.weight[self.dims].sum(axis=0)
        ends = np.exp(np.average(np.log(self.radii[self.windows]), axis=0, weights=weight))
        return float(ends[0]), float(ends[1])

    def change(self, sums: Sums, other: Sums) -> float:
        """Return by how much the slope of `other` sums is larger, in the same windows as far as these have pairs."""
        log_radius = np.log(self.radii)
        ours, theirs = (quarters(each, each.total)[1][self.dims] for each in (sums, other))
        apart = slopes(theirs, log_radius, self.windows) - slopes(ours, log_radius, self.windows)
        weight = np.where(theirs[:, self.windows[:, 0]] >= ENOUGH, self.weight[self.dims], 0.0)
        return float(np.average(apart, weights=weight)) if weight.sum() > 0.0 else 0.0


def quarters(sums: Sums, total: Array) -> tuple[Array, Array]:
    """Return radii (radii,) and sums (..., radii) at quarters of an octave."""
    return sums.radii[::EVERY], total[..., ::EVERY]


def slopes(total: Array, log_radius: Array, windows: Windows) -> Array:
    """Return least-squares slopes (..., windows) of the logarithm of `total` (..., radii)."""
    y = np.log(np.maximum(total, 0.5))
    sums = [_running(v) for v in (np.ones_like(log_radius), log_radius, log_radius**2, y, y * log_radius)]
    n, x, xx, y, xy = (v[..., windows[:, 1] + 1] - v[..., windows[:, 0]] for v in sums)
    return np.asarray((n * xy - x * y) / (n * xx - x**2))


def _running(values: Array) -> Array:
    return np.concatenate([np.zeros((*values.shape[:-1], 1)), np.cumsum(values, axis=-1)], axis=-1)


def _windows(radii: Array, smallest: float, largest: float) -> Windows:
    """Return the first and last index (windows, 2) of all windows that are long enough."""
    inside = np.flatnonzero((radii >= smallest) & (radii <= largest))
    pairs = [(a, b) for a in inside for b in inside if b - a >= SHORTEST]
    return np.array(pairs, dtype=np.int64).reshape(-1, 2)


def plateau(sums: Sums, *, smallest: float, largest: float = LARGEST) -> Plateau | None:
    """Return the straight piece of the sums at radii from `smallest` to a share `largest` of the range.

    None where there are too few pairs for one.
    """
    radii, total = quarters(sums, sums.total)
    seen = radii[int(np.argmax(total[min(KEPT, sums.dims) - 1] >= ENOUGH))]
    windows = _windows(radii, max(smallest, float(seen)), largest * sums.extent)
    if not len(windows):
        return None
    log_radius = np.log(radii)
    found = slopes(total, log_radius, windows)
    left = slopes(quarters(sums, sums.without_one())[1], log_radius, windows)
    middle = windows.sum(axis=1) // 2
    bend = slopes(total, log_radius, np.stack([middle, windows[:, 1]], axis=1))
    bend -= slopes(total, log_radius, np.stack([windows[:, 0], middle], axis=1))
    rise = np.diff(found, axis=0, prepend=0.0)
    octaves = (log_radius[windows[:, 1]] - log_radius[windows[:, 0]]) / math.log(2.0)
    doubt = jackknife(left) ** 2 + (0.5 * bend) ** 2 + rise**2 + SOFT**2
    lone = 10.0 * total[:, :1]
    usable = (total[:, windows[:, 0]] >= np.maximum(ENOUGH, lone)) & (found > REPEATS)
    weight = np.where(usable, octaves**2 / doubt, 0.0)
    sized = weight.sum(axis=1)
    dims = int(np.argmin(sized > 0.0)) if (sized == 0.0).any() else len(sized)
    if dims < KEPT:
        return None
    found, left, weight, bend = found[:dims], left[:, :dims], weight[:dims], bend[:dims]
    weight = weight / sized[:dims, None]
    value = (weight * found).sum(axis=-1)
    scatter = np.sqrt((weight * (found - value[:, None]) ** 2).sum(axis=-1))
    return Plateau(
        value,
        (weight * left).sum(axis=-1),
        scatter,
        weight,
        windows,
        radii,
        (weight * np.abs(bend)).sum(axis=-1),
        _agreeing(value),
    )


def _agreeing(value: Array) -> int:
    """Return the first of the dimensions that agree best, above the dimension that they find where that is possible."""
    starts = np.arange(len(value) - KEPT + 1)
    spread = np.array([np.ptp(value[s : s + KEPT]) for s in starts])
    room = np.array([s + 1 >= value[s : s + KEPT].mean() + 0.7 for s in starts])
    spread = np.where(room, spread, spread + 1.0 + starts[::-1])
    close = np.flatnonzero(spread <= spread.min() + 0.01)
    return int(close[-1]) + 1


def rise_at(sums: Sums, largest: float) -> float:
    """Return what each further dimension adds to the slope in the octave below a share `largest` of the range."""
    radii, total = quarters(sums, sums.total)
    last = int(np.searchsorted(radii, largest * sums.extent))
    found = slopes(total, np.log(radii), np.array([[max(0, last - EIGHTHS // EVERY), last]]))[:, 0]
    half = found[len(found) // 2 :]
    return float(half[-1] - half[0]) / max(1, len(half) - 1)
