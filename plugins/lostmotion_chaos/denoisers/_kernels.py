"""Compiled loops of the denoisers: sort points into boxes, and average over neighbours."""

from __future__ import annotations

import numpy as np

from lostmotion.kernels.stored import stored


@stored(nogil=True)
def sort_points(first, second, size, low, shape):  # type: ignore[no-untyped-def]
    """Return the order (n,) of points by box, and offsets (boxes + 1,) of the boxes, row by row.

    Boxes with the side `size` divide the plane of the coordinates `first` and `second` (n,); they begin at `low` (2,),
    and there are `shape` (2,) of them.
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


@stored(nogil=True, error_model="numpy", fastmath={"reassoc", "nsz", "contract"})
def average_neighbours(points, values, radius, offsets, shape, rows, out):  # type: ignore[no-untyped-def]
    """Write into `out` (n,) the mean of `values` over the point and its neighbours within `radius` (maximum norm).

    `points` (dim, n) and `values` (n,) are in the order of their boxes; the boxes of the rows `rows` (2,) are treated.
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
                    part, many = _sum_neighbours(points, values, i, begin, end, radius, dim)
                    total += part
                    count += many
                out[i] = values[i] + total / count


@stored(nogil=True, fastmath={"reassoc", "nsz", "contract"})
def _sum_neighbours(points, values, i, begin, end, radius, dim):  # type: ignore[no-untyped-def]
    """Return the sum of values minus that of point i, and the number, of the points begin..end within `radius` of i.

    There is no branch and no early exit, so the loop over points runs in vector registers. This saves more time than
    the unneeded coordinates cost.
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
