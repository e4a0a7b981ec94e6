"""Compiled loops of local projections: neighbourhoods, their covariances, and the part outside of the widest axes."""

from __future__ import annotations

import numpy as np

from lostmotion.kernels.stored import stored

SQUARINGS = 7
"""Number of times a matrix is squared: two eigenvalues that differ by 5 % then have a ratio of 500."""


@stored(nogil=True)
def find_neighbours(points, i, radius, offsets, shape, home, found):  # type: ignore[no-untyped-def]
    """Write into `found` which points (n, dim), sorted by box, lie within `radius` of point i; return their number."""
    dim, count = points.shape[1], 0
    a, b = home // shape[1], home % shape[1]
    left, right = max(b - 1, 0), min(b + 1, shape[1] - 1)
    for c in range(max(a - 1, 0), min(a + 1, shape[0] - 1) + 1):
        for j in range(offsets[c * shape[1] + left], offsets[c * shape[1] + right + 1]):
            k = 0
            while k < dim and abs(points[j, k] - points[i, k]) <= radius:
                k += 1
            if k == dim:
                found[count] = j
                count += 1
    return count


@stored(nogil=True)
def fill_neighbourhoods(points, order, radius, offsets, shape, rows, least, members, sizes):  # type: ignore[no-untyped-def]
    """Write into `members` (n, most) the neighbours of points that have none yet and at least `least` within `radius`.

    `points` (n, dim) are in the order of their boxes; all other arrays are in the order of the series. `sizes` (n,)
    counts the members. Where there are too many, every second, third, ... is taken, so that they still cover the whole
    neighbourhood.
    """
    most = members.shape[1]
    found = np.empty(len(points), np.int64)
    for home in range(rows[0] * shape[1], rows[1] * shape[1]):
        for i in range(offsets[home], offsets[home + 1]):
            own = order[i]
            if sizes[own] > 0:
                continue
            count = find_neighbours(points, i, radius, offsets, shape, home, found)
            if count < least:
                continue
            step = (count + most - 1) // most
            used = 0
            for a in range(0, count, step):
                members[own, used] = order[found[a]]
                used += 1
            sizes[own] = used


@stored(nogil=True, error_model="numpy")
def project(x, dim, keep, members, sizes, span, correction):  # type: ignore[no-untyped-def]
    """Write into `correction` (n, dim - 2) the part of each window outside of the subspace of its neighbours.

    The first and the last sample of a window are held fixed, which is the limit of a metric that weights them
    heavily: the inner samples are regressed on them, and the `keep` widest axes of the residuals are retained.
    """
    inner = dim - 2
    mean, rest = np.empty(dim), np.empty(inner)
    matrix, slopes = np.empty((dim, dim)), np.empty((inner, 2))
    inside, power, room = np.empty((inner, inner)), np.empty((inner, inner)), np.empty((inner, inner))
    for i in range(span[0], span[1]):
        compute_covariance(x, members[i, : sizes[i]], mean, matrix)
        regress_on_ends(matrix, slopes, inside)
        first, last = x[i] - mean[0], x[i + dim - 1] - mean[dim - 1]
        for k in range(inner):
            rest[k] = x[i + k + 1] - mean[k + 1] - slopes[k, 0] * first - slopes[k, 1] * last
        for _ in range(keep):
            remove_widest_axis(inside, power, room, rest)
        correction[i] = rest


@stored(nogil=True, error_model="numpy")
def remove_means(members, sizes, correction, span, out):  # type: ignore[no-untyped-def]
    """Write into `out` (n, k) the corrections minus their mean over the neighbourhood, which is due to curvature."""
    for i in range(span[0], span[1]):
        for k in range(correction.shape[1]):
            total = 0.0
            for a in range(sizes[i]):
                total += correction[members[i, a], k]
            out[i, k] = correction[i, k] - total / sizes[i]


@stored(nogil=True, error_model="numpy")
def compute_covariance(x, members, mean, matrix):  # type: ignore[no-untyped-def]
    """Write mean (dim,) and covariance (dim, dim) of the windows of `x` that begin at `members`."""
    dim, many = len(mean), len(members)
    mean[:] = 0.0
    matrix[:] = 0.0
    for j in members:
        for k in range(dim):
            mean[k] += x[j + k] - x[members[0] + k]
    for k in range(dim):
        mean[k] = x[members[0] + k] + mean[k] / many
    for j in members:
        for k in range(dim):
            off = x[j + k] - mean[k]
            for m in range(k + 1):
                matrix[k, m] += off * (x[j + m] - mean[m]) / many
    for k in range(dim):
        for m in range(k):
            matrix[m, k] = matrix[k, m]


@stored(nogil=True, error_model="numpy")
def regress_on_ends(matrix, slopes, inside):  # type: ignore[no-untyped-def]
    """Write the regression of the inner samples on the ends, `slopes` (dim - 2, 2), and the residual covariance."""
    end = len(matrix) - 1
    ridge = 1e-10 * (matrix[0, 0] + matrix[end, end]) + 1e-300
    a, b, c = matrix[0, 0] + ridge, matrix[0, end], matrix[end, end] + ridge
    area = a * c - b * b
    for k in range(len(inside)):
        p, q = matrix[k + 1, 0], matrix[k + 1, end]
        slopes[k, 0] = (c * p - b * q) / area if area > 0.0 else 0.0
        slopes[k, 1] = (a * q - b * p) / area if area > 0.0 else 0.0
    for k in range(len(inside)):
        for m in range(len(inside)):
            ends = slopes[k, 0] * matrix[m + 1, 0] + slopes[k, 1] * matrix[m + 1, end]
            inside[k, m] = matrix[k + 1, m + 1] - ends


@stored(nogil=True, error_model="numpy")
def remove_widest_axis(inside, power, room, rest):  # type: ignore[no-untyped-def]
    """Remove the widest axis of the covariance `inside` (k, k) from it and from the vector `rest` (k,)."""
    k = len(rest)
    power[:] = inside
    for _ in range(SQUARINGS):
        scale = 0.0
        for a in range(k):
            scale = max(scale, abs(power[a, a]))
        if not scale > 0.0:
            return
        power /= scale
        square_matrix(power, room)
        power, room = room, power
    widest = 0
    for a in range(k):
        widest = a if power[a, a] > power[widest, widest] else widest
    axis = power[widest]
    size = np.sqrt((axis * axis).sum())
    if not size > 0.0:
        return
    along = (axis * rest).sum() / size
    width = 0.0
    for a in range(k):
        for b in range(k):
            width += axis[a] * axis[b] * inside[a, b]
    width /= size * size
    for a in range(k):
        rest[a] -= along * axis[a] / size
        for b in range(k):
            inside[a, b] -= width * axis[a] * axis[b] / (size * size)


@stored(nogil=True)
def square_matrix(matrix, out):  # type: ignore[no-untyped-def]
    """Write the product of a symmetric matrix (k, k) with itself into `out`."""
    k = len(matrix)
    for a in range(k):
        for b in range(a + 1):
            total = 0.0
            for c in range(k):
                total += matrix[a, c] * matrix[b, c]
            out[a, b] = total
            out[b, a] = total
