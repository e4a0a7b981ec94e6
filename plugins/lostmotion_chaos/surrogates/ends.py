"""The piece of a series that can be continued periodically, as every Fourier transform assumes.

Schreiber, Schmitz, Physica D 142 (2000) 346-382, section 4: a jump between the ends appears as power at all
frequencies. Surrogates would then have this power at all times, and the recording only at the jump.
"""

from __future__ import annotations

import numpy as np

from lostmotion.contracts import Array, Series

LEAST_SHARE = 0.9
"""At least this share of the series is kept. Chosen by experience; no measurement recorded."""


def choose_piece(series: Series, *, match_ends: bool) -> slice:
    """Return the piece of the series that surrogates are drawn from: the whole series unless ends are matched."""
    return find_matching_piece(series.x) if match_ends else slice(0, series.n)


def find_matching_piece(x: Array, *, shortest: float = LEAST_SHARE) -> slice:
    """Return the piece of `x` (n,) after which the series continues most nearly as it began, in value and in slope.

    Only lengths without prime factors above 7 are tried: the transform of any other length costs several times more.
    """
    n = len(x)
    step = np.diff(x)
    best, kept = np.inf, slice(0, n)
    for m in _list_smooth_lengths(max(int(np.ceil(shortest * n)), 2), n - 2):
        first = np.arange(1, n - m)
        jump = x[first + m] - x[first]
        slip = step[first + m - 1] - step[first - 1]
        gaps = jump**2 + slip**2
        at = int(np.argmin(gaps))
        if gaps[at] < best:
            best, kept = float(gaps[at]), slice(int(first[at]), int(first[at]) + m)
    return kept


def _list_smooth_lengths(least: int, most: int) -> list[int]:
    """Return the whole numbers from `most` down to `least` that have no prime factor above 7."""
    found = [1]
    for prime in (2, 3, 5, 7):
        found = [v * prime**k for v in found for k in range(most.bit_length()) if v * prime**k <= most]
    return sorted((v for v in found if v >= least), reverse=True)
