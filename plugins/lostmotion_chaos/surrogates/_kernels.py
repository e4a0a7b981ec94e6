"""Compiled loops of the surrogates: impose a spectrum, replace values by rank, walk among neighbours."""

from __future__ import annotations

import numpy as np

from lostmotion.kernels.stored import stored

BITS = 11
"""Bits of one pass of the sort; two passes resolve one part in 4e6 of the range, as fine as single precision."""


@stored(nogil=True, error_model="numpy")
def impose(spectrum, wanted):  # type: ignore[no-untyped-def]
    """Give `spectrum` (k,) the amplitudes `wanted` (k,) and keep its phases; return sum((|S| - wanted)^2) of before."""
    off = 0.0
    for k in range(len(spectrum)):
        re, im = spectrum[k].real, spectrum[k].imag
        size = np.sqrt(re * re + im * im)
        gap = size - wanted[k]
        off += gap * gap
        if size > 0.0:
            spectrum[k] *= wanted[k] / size
        else:
            spectrum[k] = wanted[k]
    return off


@stored(nogil=True)
def arrange(like, values, places, out):  # type: ignore[no-untyped-def]
    """Write the ascending `values` (n,) into `out` (n,) by the ranks of `like` (n,); return how many entries changed.

    A radix sort of `like` on a grid of 4^BITS steps over its range: values in the same step keep the order of time.
    `places` (2, n) is work space.
    """
    n, size = len(like), 1 << BITS
    low, high = like.min(), like.max()
    scale = np.float32((size * size - 1) / (high - low)) if high > low else np.float32(0.0)
    first = np.zeros(size, np.int64)
    second = np.zeros(size, np.int64)
    for i in range(n):
        key = int((like[i] - low) * scale)
        key = min(key, size * size - 1)
        places[0, i] = key
        first[key & (size - 1)] += 1
        second[key >> BITS] += 1
    a = b = 0
    for k in range(size):
        first[k], a = a, a + first[k]
        second[k], b = b, b + second[k]
    for i in range(n):
        key = places[0, i]
        places[1, first[key & (size - 1)]] = ((key >> BITS) << 32) | i
        first[key & (size - 1)] += 1
    moved = 0
    for k in range(n):
        top, i = places[1, k] >> 32, places[1, k] & 0xFFFFFFFF
        value = values[second[top]]
        second[top] += 1
        moved += value != out[i]
        out[i] = value
    return moved


@stored(nogil=True)
def walk(start, chances, following, weights, visited):  # type: ignore[no-untyped-def]
    """Write into `visited` (n,) the points of a walk that starts at `start`.

    From point i it goes to the successor of a neighbour `following[i, a]`, with the cumulative probability
    `weights[i, a]`; `chances` (n,) are uniform random numbers.
    """
    at = start
    for t in range(len(visited)):
        visited[t] = at
        a = 0
        while a < weights.shape[1] - 1 and chances[t] >= weights[at, a]:
            a += 1
        at = following[at, a] + 1
