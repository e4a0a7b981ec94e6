"""Compiled loops behind the correlation sums: distances as codes of eighth octaves, counted without a logarithm.

The series comes as integers on a grid of 2^-30 of its range, so that differences are exact and sixteen go into one
register. A distance becomes a byte: exponent and three leading digits of its single-precision form, which rises with
the distance, so that the maximum of codes is the code of the maximum. Code 0 is a tie.
"""

from __future__ import annotations

import numba
import numpy as np

from lostmotion.kernels.stored import stored

CODES = 256
"""The number of codes; those in use end at 241, which stands for the whole range."""


@stored(nogil=True)
def encode(grid, begin, lag, count, out):  # type: ignore[no-untyped-def]
    """Write the codes of |grid[i + lag] - grid[i]| for `count` values of i from `begin` into `out`."""
    for i in range(count):
        apart = np.float32(abs(np.int32(grid[begin + i + lag] - grid[begin + i])))
        code = np.int32(apart.view(np.int32) >> np.int32(20)) - np.int32(1015)
        out[i] = np.uint8(code if code > 0 else 0)


@numba.njit(inline="always")
def _widen(joint, single, shift, count):  # type: ignore[no-untyped-def]
    """Raise the codes in `joint` to those of one more coordinate."""
    for i in range(count):
        code = single[i + shift]
        joint[i] = code if code > joint[i] else joint[i]


@numba.njit(inline="always")
def _tally(joint, count, part, m):  # type: ignore[no-untyped-def]
    """Count the codes in four histograms by turns: neighbours share a code, and one histogram would wait for itself.

    The loops are written into their caller: handing over `part[m]` by a call costs half as much again as all else.
    """
    quarter = count // 4
    for i in range(quarter):
        part[m, 0, joint[4 * i]] += 1
        part[m, 1, joint[4 * i + 1]] += 1
        part[m, 2, joint[4 * i + 2]] += 1
        part[m, 3, joint[4 * i + 3]] += 1
    for i in range(4 * quarter, count):
        part[m, 0, joint[i]] += 1


@stored(nogil=True)
def count_tile(grid, lag, span, lags, wanted, counts):  # type: ignore[no-untyped-def]
    """Add the pairs (i, i + k) of one tile, k in `lags`, to `counts` (dims, CODES): all dimensions in one pass.

    `span` is (first, last, left, right): first <= i < last, and left <= i + k < right. Only the dimensions with
    `wanted[m - 1]` are counted.
    """
    first, last, left, right = span
    dims = len(wanted)
    reach = (dims - 1) * lag
    single = np.empty(last - first + reach, np.uint8)
    joint = np.empty(last - first, np.uint8)
    part = np.zeros((dims, 4, CODES), np.uint32)
    for at in range(np.searchsorted(lags, left - last + 1), len(lags)):
        k = lags[at]
        if k >= right - first:
            break
        low = max(first, left - k)
        count = min(last, right - k) - low
        encode(grid, low, k, count + reach, single)
        joint[:count] = single[:count]
        for m in range(dims):
            if m > 0:
                _widen(joint, single, m * lag, count)
            if wanted[m]:
                _tally(joint, count, part, m)
    for m in range(dims):
        for four in range(4):
            for code in range(CODES):
                counts[m, code] += np.int64(part[m, four, code])


@stored(nogil=True)
def sort_cells(grid, lag, n, side, cells):  # type: ignore[no-untyped-def]
    """Return the points in the order of their cells (n,), and where each cell begins (cells^2 + 1,).

    A cell is `side` grid steps wide in the first two coordinates of a delay vector; there are `cells` along each.
    """
    begins = np.zeros(cells * cells + 1, np.int64)
    for i in range(n):
        begins[(grid[i] // side) * cells + grid[i + lag] // side + 1] += 1
    for c in range(cells * cells):
        begins[c + 1] += begins[c]
    order = np.empty(n, np.int32)
    filled = begins.copy()
    for i in range(n):
        cell = (grid[i] // side) * cells + grid[i + lag] // side
        order[filled[cell]] = i
        filled[cell] += 1
    return order, begins


@stored(nogil=True)
def count_near(grid, lag, span, cells, order, begins, theiler, block, counts):  # type: ignore[no-untyped-def]
    """Add all pairs closer than the side of a cell, to `counts` (blocks, dims, CODES) by the block of the later point.

    `span` is (first, last, side): first <= i < last. Dimension 1 is left alone: the cells are made of two coordinates.
    """
    first, last, side = span
    dims = counts.shape[1]
    for i in range(first, last):
        across, along = grid[i] // side, grid[i + lag] // side
        for row in range(max(0, across - 1), min(cells, across + 2)):
            begin = begins[row * cells + max(0, along - 1)]
            end = begins[row * cells + min(cells - 1, along + 1) + 1]
            for at in range(begin, end):
                j = np.int64(order[at])
                if j - i <= theiler:
                    continue
                apart = max(abs(grid[j] - grid[i]), abs(grid[j + lag] - grid[i + lag]))
                m = 1
                while apart < side:
                    step = np.float32(np.int32(apart))
                    code = np.int32(step.view(np.int32) >> np.int32(20)) - np.int32(1015)
                    counts[block[j], m, code if code > 0 else 0] += 1
                    m += 1
                    if m == dims:
                        break
                    apart = max(apart, abs(grid[j + m * lag] - grid[i + m * lag]))
