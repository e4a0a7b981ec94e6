"""Compiled pair counts behind the correlation dimension of a section: distances as codes of eighth octaves."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lostmotion.kernels.stored import stored

CODES = 256
"""Code c holds distances from `edges()[c]` up to the next edge; code 0 all that are smaller, code 249 begins at one."""
_OFFSET = (127 - 31) * 8 - 1


def compute_edges() -> NDArray[np.float64]:
    """Return the lower edge (CODES,) of each code, which is a single-precision number with three mantissa bits."""
    bits = (np.arange(CODES) + _OFFSET).astype(np.int32) << np.int32(20)
    return bits.view(np.float32).astype(float)


@stored(nogil=True)
def count_pairs(points, theiler, block, counts):  # type: ignore[no-untyped-def]
    """Add all pairs of points (n, dims) more than `theiler` apart in time to `counts` (blocks, blocks, CODES).

    The distance is the largest difference of a coordinate; `block` (n,) says to which block a point belongs.
    """
    n, dims = points.shape
    codes = counts.shape[2]
    for i in range(n):
        for j in range(i + theiler + 1, n):
            apart = np.float32(0.0)
            for d in range(dims):
                step = abs(points[j, d] - points[i, d])
                apart = step if step > apart else apart
            code = (np.float32(apart).view(np.int32) >> np.int32(20)) - np.int32(_OFFSET)
            at = np.int64(code)
            counts[block[i], block[j], min(max(at, 0), codes - 1)] += 1
