"""Compiled loops of the denoisers: points sorted into boxes, means over neighbours, local projections."""

from __future__ import annotations

import numba
import numpy as np


@numba.njit(cache=True, nogil=True)
def boxed(first, second, size, low, shape):  # type: ignore[no-untyped-def]
    """Return the order (n,) of points by box, and offsets (boxes + 1,) of the boxes, row by row.

    Boxes of the side `size` lie over the coordinates `first`, `second` (n,), from `low` (2,) on, `shape` (2,) of them.
    """
    n, boxes = len(first), shape[0] * shape[1]
    where = np.empty(n, np.int64)
    offsets = np.zeros(boxes + 1, np.int64)
    for i in range(n):
        a = min(int((first[i] - low[0]) / size), shape[0] - 1)
        b = min(int((second[i] - low[1]) / size), shape[1] - 1)
        where[i] = a * shape[1] + b
        offsets[where[i] + 1] += 1
    for k in range(boxes):
        offsets[k + 1] += offsets[k]
    place = offsets[:-1].copy()
    order = np.empty(n, np.int64)
    for i in range(n):
        order[place[where[i]]] = i
        place[where[i]] += 1
    return order, offsets


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc", "nsz", "contract"})
def averaged(points, values, radius, offsets, shape, rows, out):  # type: ignore[no-untyped-def]
    """Write into `out` (n,) the mean of `values` over neighbours within `radius` (maximum norm), the point among them.

    `points` (dim, n) and `values` (n,) stand in the order of their boxes; boxes of the rows `rows` (2,) are done.
    """
    dim = points.shape[0]
    for a in range(rows[0], rows[1]):
        for b in range(shape[1]):
            home = a * shape[1] + b
            left, right = max(b - 1, 0), min(b + 1, shape[1] - 1)
            for i in range(offsets[home], offsets[home + 1]):
                total, count = 0.0, 0
                for c in range(max(a - 1, 0), min(a + 1, shape[0] - 1) + 1):
                    begin, end = offsets[c * shape[1] + left], offsets[c * shape[1] + right + 1]
                    part, many = _gathered(points, values, i, begin, end, radius, dim)
                    total += part
                    count += many
                out[i] = values[i] + total / count


@numba.njit(cache=True, nogil=True, fastmath={"reassoc", "nsz", "contract"})
def _gathered(points, values, i, begin, end, radius, dim):  # type: ignore[no-untyped-def]
    """Return the sum of values, that of point i taken off, and number of the points begin..end within `radius` of i.

    No branch and no early way out: the loop over points runs in vector registers, which is worth more than the
    coordinates that are looked at in vain.
    """
    total, count = 0.0, 0
    own = values[i]
    for j in range(begin, end):
        far = abs(points[0, j] - points[0, i])
        for k in range(1, dim):
            far = max(far, abs(points[k, j] - points[k, i]))
        near = far <= radius
        total += (values[j] - own) if near else 0.0
        count += 1 if near else 0
    return total, count
