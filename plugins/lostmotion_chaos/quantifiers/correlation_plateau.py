"""The scaling region of a correlation sum: a weighted mean of the slopes of all windows of radii.

No window is chosen by eye. Each window of radii and each dimension has a slope with its jackknife error, a bend (upper
minus lower half), and a rise from the dimension before. Long, straight windows have the largest weights, and the
scatter of the slopes is the systematic error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion_chaos.quantifiers.correlation import Sums, jackknife
from lostmotion_chaos.quantifiers.correlation_boxes import EIGHTHS

Windows = NDArray[np.int64]
CODE_STEP = 2
"""Codes from one radius to the next: quarters of an octave."""
LEAST_STEPS = 6
"""The least length of a window in such steps: one and a half octaves. Chosen by experience; no measurement recorded."""
LARGEST_SHARE = 0.1
"""Radii are at most this share of the range: beyond it the finite size of the attractor has an effect. Chosen by
experience; no measurement recorded."""
LEAST_PAIRS = 200
"""Pairs within the smallest radius of a window. Chosen by experience; no measurement recorded."""
SOFTENING = 0.05
"""Bends and errors well below this do not change the weight of a window. Chosen by experience; no measurement
recorded."""
LEAST_SLOPE = 0.25
"""A smaller slope is not the dimension of a motion: at those radii the recording repeats itself. Chosen by experience;
no measurement recorded."""
AGREEING_DIMS = 3
"""The number of successive dimensions that must agree. Chosen by experience; no measurement recorded."""


@dataclass(frozen=True, eq=False)
class Plateau:
    """Slope of the scaling region by dimension (dims,), with its errors and its position.

    `left` (blocks, dims) are the slopes with each block left out, `scatter` (dims,) is the scatter over the windows.
    `weight` (dims, windows) are the weights of `windows` (windows, 2), `first` is the smallest of the three dimensions
    that agree best, `rise` the increase with each further dimension there, `bend` the change of slope across windows.
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
        return slice(self.first - 1, self.first - 1 + AGREEING_DIMS)

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
        """The increase of the slope with each further dimension, where the dimensions agree best."""
        found = self.value[self.dims]
        return float(found[-1] - found[0]) / (AGREEING_DIMS - 1)

    @property
    def ends(self) -> tuple[float, float]:
        """The smallest and the largest radius, each a weighted mean over the windows."""
        weight = self.weight[self.dims].sum(axis=0)
        ends = np.exp(np.average(np.log(self.radii[self.windows]), axis=0, weights=weight))
        return float(ends[0]), float(ends[1])

    def change(self, sums: Sums, other: Sums) -> float:
        """Return how much larger the slope of `other` sums is, in the same windows where these have enough pairs."""
        log_radius = np.log(self.radii)
        ours, theirs = (select_quarters(each, each.total)[1][self.dims] for each in (sums, other))
        apart = fit_slopes(theirs, log_radius, self.windows) - fit_slopes(ours, log_radius, self.windows)
        weight = np.where(theirs[:, self.windows[:, 0]] >= LEAST_PAIRS, self.weight[self.dims], 0.0)
        return float(np.average(apart, weights=weight)) if weight.sum() > 0.0 else 0.0


def select_quarters(sums: Sums, total: Array) -> tuple[Array, Array]:
    """Return radii (radii,) and sums (..., radii) at quarters of an octave."""
    return sums.radii[::CODE_STEP], total[..., ::CODE_STEP]


def fit_slopes(total: Array, log_radius: Array, windows: Windows) -> Array:
    """Return least-squares slopes (..., windows) of the logarithm of `total` (..., radii)."""
    y = np.log(np.maximum(total, 0.5))
    sums = [_sum_running(v) for v in (np.ones_like(log_radius), log_radius, log_radius**2, y, y * log_radius)]
    n, x, xx, y, xy = (v[..., windows[:, 1] + 1] - v[..., windows[:, 0]] for v in sums)
    return np.asarray((n * xy - x * y) / (n * xx - x**2))


def _sum_running(values: Array) -> Array:
    return np.concatenate([np.zeros((*values.shape[:-1], 1)), np.cumsum(values, axis=-1)], axis=-1)


def _list_windows(radii: Array, smallest: float, largest: float) -> Windows:
    """Return the first and last index (windows, 2) of all windows that are long enough."""
    inside = np.flatnonzero((radii >= smallest) & (radii <= largest))
    pairs = [(a, b) for a in inside for b in inside if b - a >= LEAST_STEPS]
    return np.array(pairs, dtype=np.int64).reshape(-1, 2)


def find_plateau(sums: Sums, *, smallest: float, largest: float = LARGEST_SHARE) -> Plateau | None:
    """Return the scaling region of the sums at radii from `smallest` to a share `largest` of the range.

    The result is None where there are too few pairs.
    """
    radii, total = select_quarters(sums, sums.total)
    seen = radii[int(np.argmax(total[min(AGREEING_DIMS, sums.dims) - 1] >= LEAST_PAIRS))]
    windows = _list_windows(radii, max(smallest, float(seen)), largest * sums.extent)
    if not len(windows):
        return None
    log_radius = np.log(radii)
    found = fit_slopes(total, log_radius, windows)
    left = fit_slopes(select_quarters(sums, sums.without_one())[1], log_radius, windows)
    middle = windows.sum(axis=1) // 2
    bend = fit_slopes(total, log_radius, np.stack([middle, windows[:, 1]], axis=1))
    bend -= fit_slopes(total, log_radius, np.stack([windows[:, 0], middle], axis=1))
    rise = np.diff(found, axis=0, prepend=0.0)
    octaves = (log_radius[windows[:, 1]] - log_radius[windows[:, 0]]) / math.log(2.0)
    doubt = jackknife(left) ** 2 + (0.5 * bend) ** 2 + rise**2 + SOFTENING**2
    lone = 10.0 * total[:, :1]
    usable = (total[:, windows[:, 0]] >= np.maximum(LEAST_PAIRS, lone)) & (found > LEAST_SLOPE)
    weight = np.where(usable, octaves**2 / doubt, 0.0)
    sized = weight.sum(axis=1)
    dims = int(np.argmin(sized > 0.0)) if (sized == 0.0).any() else len(sized)
    if dims < AGREEING_DIMS:
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
        _find_agreement(value),
    )


def _find_agreement(value: Array) -> int:
    """Return the first of the dimensions that agree best; if possible, they are larger than the slope itself."""
    starts = np.arange(len(value) - AGREEING_DIMS + 1)
    spread = np.array([np.ptp(value[s : s + AGREEING_DIMS]) for s in starts])
    room = np.array([s + 1 >= value[s : s + AGREEING_DIMS].mean() + 0.7 for s in starts])
    spread = np.where(room, spread, spread + 1.0 + starts[::-1])
    close = np.flatnonzero(spread <= spread.min() + 0.01)
    return int(close[-1]) + 1


def measure_rise(sums: Sums, largest: float) -> float:
    """Return the increase of the slope with each dimension, in the octave below a share `largest` of the range."""
    radii, total = select_quarters(sums, sums.total)
    last = int(np.searchsorted(radii, largest * sums.extent))
    found = fit_slopes(total, np.log(radii), np.array([[max(0, last - EIGHTHS // CODE_STEP), last]]))[:, 0]
    half = found[len(found) // 2 :]
    return float(half[-1] - half[0]) / max(1, len(half) - 1)
