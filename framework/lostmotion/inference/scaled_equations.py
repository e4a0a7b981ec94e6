"""Linear equations of coordinates that differ by many orders of magnitude."""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dpotrf, dpotrs

from lostmotion.contracts import Array

LEAST_PIVOT = 1e-5
"""With a smaller pivot a matrix of unit diagonal is nearly singular: its solution is that of least squares then."""


def solve_scaled(information: Array, right: Array) -> Array:
    """Return the solution of `information @ x = right`, with each coordinate scaled to unit information.

    Parameters differ by many orders of magnitude, and a cut at small eigenvalues would drop some of them.
    """
    unit = 1.0 / np.sqrt(np.maximum(np.diag(information), 1e-300))
    scaled = information * np.outer(unit, unit)
    tall = unit if right.ndim == 1 else unit[:, None]
    if not len(unit):
        return np.zeros_like(right)
    lower, failed = dpotrf(scaled, lower=1)
    if failed or not np.all(np.diag(lower) > LEAST_PIVOT):
        return np.asarray(tall * np.linalg.lstsq(scaled, tall * right, rcond=1e-12)[0], dtype=float)
    return np.asarray(tall * dpotrs(lower, tall * right, lower=1)[0], dtype=float)
