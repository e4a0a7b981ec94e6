"""Linear prediction of a series beyond its first sample."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ORDER = 32
"""The order of the prediction: a sine needs two, each further one as many."""
LONGEST = 1000
"""The coefficients are found from at most so many samples."""
PREDICTABLE = 1e-20
"""The share of the power at which a series counts as predicted without an error."""


def find_prediction(x: Array, order: int = ORDER) -> Array:
    """Return the coefficients (up to `order`,) that predict a sample of the series `x` (n,) from the ones next to it.

    x[k] is about the sum of c[i] x[k + 1 + i], and also that of c[i] x[k - 1 - i]. The mean of the series should be
    zero. The prediction does not grow: Burg, Maximum entropy spectral analysis (1975), Ph.D. thesis, Stanford.
    """
    ahead, behind, error_filter = x[1:], x[:-1], np.ones(1)
    least = PREDICTABLE * float(x @ x)
    for _ in range(min(order, len(x) // 3)):
        power = float(ahead @ ahead + behind @ behind)
        if power <= least:
            break
        reflection = -2.0 * float(ahead @ behind) / power
        padded = np.append(error_filter, 0.0)
        error_filter = padded + reflection * padded[::-1]
        ahead, behind = (ahead + reflection * behind)[1:], (behind + reflection * ahead)[:-1]
    return np.asarray(-error_filter[1:])


def predict_before(x: Array, count: int) -> Array:
    """Return `count` samples that precede the series `x` (n,), by linear prediction about its mean.

    A sum of few sines is continued; noise decays to the mean.
    """
    near = x[:LONGEST] - x[:LONGEST].mean()
    weights = find_prediction(near)
    order = len(weights)
    series = np.concatenate([np.zeros(count), near[:order]])
    for k in range(count - 1, -1, -1):
        series[k] = weights @ series[k + 1 : k + 1 + order]
    return np.asarray(series[:count] + x[:LONGEST].mean())
