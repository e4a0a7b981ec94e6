"""Checks and centring of a series, and its delay vectors."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lostmotion.errors import DataError

Array = NDArray[np.float64]
LEAST = 200
"""The least number of samples: no method gives a result for fewer."""
LARGEST = 1e150
"""The largest value: sums of squares of larger ones are not finite."""


def checked(values: ArrayLike, *, least: int = LEAST) -> Array:
    """Return the series (n,) in double precision without its mean, or raise a `DataError`.

    The mean is subtracted first, so that a large offset (an encoder that counts from 1e9) causes no further loss of
    precision.
    """
    try:
        raw = np.asarray(values)
    except ValueError as err:  # rows of different lengths
        raise DataError("the series has entries of several lengths: give a list of numbers") from err
    if np.iscomplexobj(raw):
        raise DataError("the series is complex: give its real part, or one channel")
    try:
        x = raw.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as err:
        raise DataError(f"the series contains something that is not a number ({err}): give a list of numbers") from err
    if x.ndim != 1:
        raise DataError(f"the series has {x.ndim} dimensions {x.shape}: give one channel, with shape (n,)")
    if len(x) < least:
        raise DataError(f"the series has {len(x)} samples, and at least {least} are needed: record longer")
    if not np.isfinite(x).all():
        bad = int((~np.isfinite(x)).sum())
        first = int(np.argmin(np.isfinite(x)))
        raise DataError(
            f"{bad} samples are NaN or infinite, the first is number {first}: cut them off, or fill them in"
        )
    if (largest := float(np.abs(x).max())) > LARGEST:
        raise DataError(f"the series reaches {largest:.3g}, and squares of such numbers overflow: give another unit")
    centred: Array = x - x[0]
    centred -= centred.mean()
    if np.ptp(centred) == 0.0:
        raise DataError(f"the series is constant ({x[0]:g}): the sensor is stuck, or the machine stands still")
    return centred


def delay_vectors(x: Array, lag: int, dim: int) -> Array:
    """Return delay vectors (n - (dim - 1) lag, dim) of the series `x` (n,): x(t), x(t + lag), ... in each row."""
    rows = len(x) - (dim - 1) * lag
    if rows < 1:
        raise DataError(
            f"{len(x)} samples contain no delay vector of dimension {dim} and lag {lag}: record longer, or lower one"
        )
    return np.stack([x[k * lag : k * lag + rows] for k in range(dim)], axis=1)
