"""Where to cut a series, so that it can be continued periodically as every Fourier transform does it.

Schreiber, Schmitz, Physica D 142 (2000) 346-382, section 4: a jump between the ends shows as power at all
frequencies, which the surrogates then have everywhere and the recording nowhere.
"""

from __future__ import annotations

import numpy as np

from lostmotion.contracts import Array

SHORTEST = 0.9
"""The share of the series that is kept at least."""


def piece(x: Array, *, shortest: float = SHORTEST) -> slice:
    """Return the piece of `x` (n,) behind which the series goes on most nearly as it began, in value and in slope.

    Only lengths without prime factors above 7 are looked at: the transform of another one costs several times more.
    """
    n = len(x)
    step = np.diff(x)
    best, kept = np.inf, slice(0, n)
    for m in _smooth(max(int(np.ceil(shortest * n)), 2), n - 2):
        first = np.arange(1, n - m)
        jump = x[first + m] - x[first]
        slip = step[first + m - 1] - step[first - 1]
        gaps = jump**2 + slip**2
        at = int(np.argmin(gaps))
        if gaps[at] < best:
            best, kept = float(gaps[at]), slice(int(first[at]), int(first[at]) + m)
    return kept


def _smooth(least: int, most: int) -> list[int]:
    """Return the whole numbers from `most` down to `least` that have no prime factor above 7."""
    found = [1]
    for prime in (2, 3, 5, 7):
        found = [v * prime**k for v in found for k in range(most.bit_length()) if v * prime**k <= most]
    return sorted((v for v in found if v >= least), reverse=True)
