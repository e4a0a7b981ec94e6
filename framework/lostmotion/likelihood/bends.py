"""Readings of sensors that are bent: put right before the filter sees them, with what that does to their density."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Array, SensorTerm, Values
from lostmotion.likelihood.engine import Innovations
from lostmotion.likelihood.observation import Observation

Bend = tuple[int, SensorTerm, Values]
"""The number of a sensor, the term that bends it, and what that is handed."""
ROUNDS = 30
CLOSE, NUDGE = 1e-10, 1e-6
"""A reading is put right to this share of its range; slopes are taken over this share of it."""
FLATTEST = 0.1
"""A sensor shows at least this share of a change of what it should show: one that folds back is not undone."""


def unbent(seen: Observation, bends: Sequence[Bend]) -> tuple[Observation, Array]:
    """Return an observation with its readings put right, and by how much they grow (samples, sensors) as they change.

    What is right is looked for by x = z - (bent(x) - x), again and again, damped by the slope.
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
            x = x - miss / _slope(term, x, p, size)
            if not np.nanmax(np.abs(miss), initial=0.0) > CLOSE * size:
                break
        readings[:, sensor], slopes[:, sensor] = x, slopes[:, sensor] / _slope(term, x, p, size)
    return replace(seen, readings=readings), slopes


def _slope(term: SensorTerm, x: Array, p: Values, size: float) -> Array:
    """Return by how much more a sensor shows (samples,) where it should show a little more."""
    step = NUDGE * size
    return np.maximum((term.bent(x + step, p) - term.bent(x - step, p)) / (2.0 * step), FLATTEST)


def stretched(found: Innovations, slopes: Array) -> Innovations:
    """Return innovations of readings that were put right as those of the readings themselves, which are wider.

    The likelihood is then the density of what the sensors have shown, whatever bends them.
    """
    kept = np.where(np.isfinite(slopes), slopes, 1.0)
    read = found.errors != 0.0
    errors = np.where(read, found.errors / kept, found.errors)
    return replace(found, errors=errors, variances=np.where(read, found.variances / kept**2, found.variances))
