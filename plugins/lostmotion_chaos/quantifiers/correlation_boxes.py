"""All close pairs of a long recording, found by a grid of cells, for small radii where lags were left out.

Neighbours of a flow stay neighbours for a while at the same lag. A sum over some of the lags therefore sees few
encounters, each of them many times, and is noisy at small radii. Schreiber, Int. J. Bifurcation Chaos 5 (1995) 349-358.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lostmotion.kernels.threads import spread
from lostmotion_chaos.quantifiers._kernels_correlation import CODES, count_near, sort_cells

Counts = NDArray[np.int64]
MOST_CELLS = 1024
"""At most so many cells along each of two coordinates."""
EIGHTHS = 8
"""Codes in an octave."""


def choose_widest_code(total: Counts, share: float, near: int) -> int:
    """Return the code below which there are about `near` pairs, where `total` counts the share `share` of all pairs."""
    code: int = int(np.searchsorted(total, near * share)) - 1
    lowest = EIGHTHS * (31 - MOST_CELLS.bit_length()) + 1
    return min(max(code, lowest), EIGHTHS * 28)


def find_side(code: int) -> int:
    """Return the smallest distance (grid steps) with this code or a larger one."""
    octave, eighth = divmod(code - 1, EIGHTHS)
    return int((EIGHTHS + eighth) << octave) // EIGHTHS


def count_boxes(
    grid: NDArray[np.int32], lag: int, theiler: int, ends: list[int], *, shape: tuple[int, int], code: int
) -> Counts:
    """Return the pairs (blocks, blocks, dims, CODES) with codes below `code`, in dimensions 2 and more."""
    blocks, dims = shape
    side = find_side(code)
    cells = (2**30) // side + 1
    order, begins = sort_cells(grid, lag, ends[-1], side, cells)
    block = np.searchsorted(np.array(ends[1:]), np.arange(ends[-1]), side="right")
    counts = np.zeros((blocks, blocks, dims, CODES), np.int64)

    def some(begin: int, end: int) -> None:
        for a in range(begin, end):
            span = ends[a], ends[a + 1], side
            count_near(grid, lag, span, cells, order, begins, theiler, block, counts[a])

    spread(some, blocks, slices=blocks)
    return counts


def join_counts(near: Counts, sampled: Counts, code: int, share: float) -> Counts:
    """Return the counts of `near` below `code`, and those of `sampled` over its `share` from `code` on.

    The count of `code` itself takes the difference between the two, so that both cumulative sums are kept.
    """
    whole = np.rint(np.cumsum(sampled, axis=-1) / share).astype(np.int64)
    below = np.cumsum(near, axis=-1)
    whole[:, :, 1:, :code] = below[:, :, 1:, :code]
    whole = np.maximum.accumulate(whole, axis=-1)
    return np.diff(whole, axis=-1, prepend=0)
