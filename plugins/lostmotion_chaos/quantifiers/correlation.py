"""Correlation sums of a series: all embedding dimensions, all radii and all pairs of blocks in one pass.

Grassberger, Procaccia, Physica D 9 (1983) 189-208; Theiler, Phys. Rev. A 34 (1986) 2427-2432 (pairs close in time).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.kernels.threads import spread
from lostmotion_chaos.quantifiers._kernels_correlation import CODES, count_tile
from lostmotion_chaos.quantifiers.correlation_boxes import EIGHTHS, choose_widest_code, count_boxes, join_counts

Counts = NDArray[np.int64]
GRID = 2**30
"""Steps of the integer grid over the range of the series."""


def compute_edges() -> Array:
    """Return the largest distance (CODES,) of each code, as a share of the range of the series."""
    code = np.arange(CODES)
    octave, eighth = np.divmod(code, EIGHTHS)
    return np.asarray(np.ldexp(1.0 + eighth / EIGHTHS, octave - 30))


@dataclass(frozen=True)
class Effort:
    """How much is counted: about `pairs` pairs, in `blocks` blocks of the orbit, by `jobs` threads (0: all cores).

    Where pairs are left out, about the `near` closest ones (in dimension 2) are nevertheless counted completely. `only`
    has the dimensions that are counted; None stands for all of them.
    """

    pairs: int = 200_000_000
    near: int = 30_000_000
    blocks: int = 25
    only: tuple[int, ...] | None = None
    jobs: int = 0


THOROUGH = Effort()


@dataclass(frozen=True, eq=False)
class Sums:
    """Pairs counted by blocks of the orbit, dimension 1..dims and code: counts (blocks, blocks, dims, CODES).

    `radii` (CODES,) are the largest distances of the codes in the unit of the series; `pairs` (blocks, blocks) is the
    number of pairs that were examined for each pair of blocks.
    """

    counts: Counts
    pairs: Counts
    radii: Array
    lag: int
    theiler: int

    @cached_property
    def total(self) -> Array:
        """The number of pairs closer than each radius (dims, CODES), summed as integers."""
        return np.cumsum(self.counts.sum(axis=(0, 1)), axis=-1).astype(np.float64)

    @property
    def dims(self) -> int:
        """The largest embedding dimension."""
        return int(self.counts.shape[2])

    @property
    def blocks(self) -> int:
        """The number of blocks of the orbit."""
        return len(self.counts)

    @property
    def log_correlation(self) -> Array:
        """The logarithm of the correlation sum (dims, CODES), minus infinity where no pair is so close."""
        with np.errstate(divide="ignore"):
            return np.asarray(np.log(self.total / self.pairs.sum()))

    @property
    def extent(self) -> float:
        """The range of the series."""
        return float(self.radii[30 * EIGHTHS])

    def ties(self, dim: int) -> float:
        """Return the share of pairs that agree in all of `dim` coordinates to the last digit."""
        return float(self.total[dim - 1, 0] / self.pairs.sum())

    def without_one(self) -> Array:
        """Return the pairs closer than each radius (blocks, dims, CODES), with each block of the orbit left out."""
        own = np.einsum("aamc->amc", self.counts)
        taken = self.counts.sum(axis=0) + self.counts.sum(axis=1) - own
        return np.asarray(np.cumsum(self.counts.sum(axis=(0, 1)) - taken, axis=-1), dtype=np.float64)


def jackknife(values: Array) -> Array:
    """Return the standard error from `values` (blocks, ...) that were computed with each block left out in turn.

    Pairs of two blocks are left out with either block, which the jackknife of such a sum allows: Arvesen, Ann. Math.
    Stat. 40 (1969) 2076-2100; blocks for correlated series: Kuensch, Ann. Stat. 17 (1989) 1217-1241.
    """
    blocks = len(values)
    return np.asarray(np.sqrt((blocks - 1.0) * values.var(axis=0)))


def put_on_grid(x: Array) -> tuple[NDArray[np.int32], float]:
    """Return the series as integers on the grid (n,), and its range."""
    low, wide = float(x.min()), float(np.ptp(x))
    if not wide > 0.0:
        raise DataError("the series is constant, so it has no distances: give one with a motion")
    return np.round((x - low) * (GRID / wide)).astype(np.int32), wide


def choose_lags(n: int, theiler: int, pairs: int) -> NDArray[np.int64]:
    """Return the time differences of the pairs to count, rising: all, or as many as give about `pairs` pairs.

    They are spread by the golden ratio, so that they are not in step with a drive.
    """
    first, count = theiler + 1, n - theiler - 1
    every = (count + 1) * count / 2 / pairs
    if every <= 1.0:
        return np.arange(first, n, dtype=np.int64)
    turns = np.arange(int(count / every))
    jitter = np.modf(turns * (np.sqrt(5.0) - 1.0) / 2.0)[0]
    return np.asarray(first + np.floor((turns + jitter) * every), dtype=np.int64)


def compute_correlation_sums(x: Array, lag: int, dims: int, *, theiler: int, effort: Effort = THOROUGH) -> Sums:
    """Return the pairs of delay vectors of `x` (n,) by distance (maximum norm), for dimensions 1..dims at once."""
    n = len(x) - (dims - 1) * lag
    if n - theiler < 2:
        raise DataError(
            f"{len(x)} samples hold no two delay vectors of dimension {dims} and lag {lag} more than {theiler} samples "
            "apart: record longer, or lower one of these"
        )
    grid, wide = put_on_grid(x)
    blocks = min(effort.blocks, n)
    lags = choose_lags(n, theiler, effort.pairs)
    ends = [n * k // blocks for k in range(blocks + 1)]
    tiles = [(a, b) for a in range(blocks) for b in range(a, blocks)]
    counts = np.zeros((blocks, blocks, dims, CODES), np.int64)
    wanted = np.array([effort.only is None or m in effort.only for m in range(1, dims + 1)])

    def some(begin: int, end: int) -> None:
        for a, b in tiles[begin:end]:
            count_tile(grid, lag, (ends[a], ends[a + 1], ends[b], ends[b + 1]), lags, wanted, counts[a, b])

    spread(some, len(tiles), jobs=effort.jobs, slices=32)
    share = float(counts[:, :, int(np.argmax(wanted))].sum() / ((n - theiler - 1) * (n - theiler) / 2))
    if share < 1.0 and effort.near and dims > 1 and wanted[1]:
        code = choose_widest_code(np.cumsum(counts[:, :, 1].sum(axis=(0, 1))), share, effort.near)
        near = count_boxes(grid, lag, theiler, ends, shape=(blocks, dims), code=code)
        counts = join_counts(near * wanted[:, None], counts, code, share)
    pairs = np.asarray(counts[:, :, int(np.argmax(wanted))].sum(axis=-1))
    return Sums(counts, pairs, wide * compute_edges(), lag, theiler)
