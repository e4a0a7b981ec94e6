"""Readings of nonlinear sensors: corrected before the filter, with the change of their probability density."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Array, SensorTerm, Values
from lostmotion.likelihood.engine import Innovations
from lostmotion.likelihood.observation import Observation

Bend = tuple[int, SensorTerm, Values]
"""The number of a sensor, the term that makes it nonlinear, and the parameters of that term."""
ROUNDS = 30
CLOSE, NUDGE = 1e-10, 1e-6
"""A reading is corrected to this share of its range; slopes are differences over this share of it."""
FLATTEST = 0.1
"""The least slope of a sensor: one that is not monotonic cannot be inverted."""


def correct_bends(seen: Observation, bends: Sequence[Bend]) -> tuple[Observation, Array]:
    """Return an observation with corrected readings, and the slopes (samples, sensors) of readings over true values.

    The true value x of a reading z is found by the iteration x = z - (bent(x) - x), damped by the slope.
    """
    slopes = np.ones(seen.readings.shape)
    if not bends:
        return seen, slopes
    readings = seen.readings.copy()
    for sensor, term, p in bends:
        z = readings[:, sensor]
        if np.array_equal(term.bent(z, p), z, equal_nan=True):
            continue
        size = float(np.nanmax(np.abs(z), initial=0.0)) or 1.0
        x = z.copy()
        for _ in range(ROUNDS):
            miss = term.bent(x, p) - z
            x = x - miss / _compute_slope(term, x, p, size)
            if not np.nanmax(np.abs(miss), initial=0.0) > CLOSE * size:
                break
        readings[:, sensor], slopes[:, sensor] = x, slopes[:, sensor] / _compute_slope(term, x, p, size)
    return replace(seen, readings=readings), slopes


def _compute_slope(term: SensorTerm, x: Array, p: Values, size: float) -> Array:
    """Return the slope (samples,) of the reading of a sensor over the true value."""
    step = NUDGE * size
    return np.maximum((term.bent(x + step, p) - term.bent(x - step, p)) / (2.0 * step), FLATTEST)


def rescale_innovations(found: Innovations, slopes: Array) -> Innovations:
    """Return the innovations of corrected readings in the scale of the readings themselves.

    The likelihood is then the density of the readings, for any nonlinearity of the sensors.
    """
    kept = np.where(np.isfinite(slopes), slopes, 1.0)
    read = found.errors != 0.0
    errors = np.where(read, found.errors / kept, found.errors)
    return replace(found, errors=errors, variances=np.where(read, found.variances / kept**2, found.variances))
