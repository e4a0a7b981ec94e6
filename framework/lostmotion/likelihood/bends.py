"""Readings of nonlinear sensors, and of sensors that change at a time, corrected before the filter sees them.

The density of the readings changes by the slope of the correction, so that likelihoods stay comparable.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from lostmotion.contracts import Array, SensorTerm, Values
from lostmotion.likelihood.engine import Innovations
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.sensors import FLATTEST, Sensor, SensorChange

if TYPE_CHECKING:
    from lostmotion.likelihood.system import System

ROUNDS = 30
CLOSE, NUDGE = 1e-10, 1e-6
"""A reading is corrected to this share of its range; slopes are differences over this share of it."""


class Bend(NamedTuple):
    """A nonlinear sensor: its number, the term that makes it so, and the parameters of that."""

    sensor: int
    term: SensorTerm
    values: Values


class Corrections(NamedTuple):
    """The corrections of the readings of a recording: nonlinear sensors, and the changes of each sensor."""

    bends: tuple[Bend, ...] = ()
    changes: tuple[tuple[SensorChange, ...], ...] = ()


def list_corrections(system: System, active: frozenset[str], full: Array, sensors: Sequence[Sensor]) -> Corrections:
    """Return the corrections for the active terms of a system at a full vector (parameters,)."""
    if not active & {*system.bending_terms, *system.rescaling}:
        return Corrections()
    bends = tuple(
        Bend(s, term, p)
        for s, sensor in enumerate(sensors)
        for term, p in system.at_sensor(full, active, sensor.place)
        if type(term).bent is not SensorTerm.bent
    )
    changes = tuple(system.changes_at_sensor(full, active, sensor.place) for sensor in sensors)
    return Corrections(bends, changes if any(changes) else ())


def correct_readings(seen: Observation, corrections: Corrections) -> tuple[Observation, Array | None]:
    """Return an observation with its readings corrected, and the slopes (samples, sensors) of that; None without."""
    if not any(corrections):
        return seen, None
    seen, slopes = correct_bends(seen, corrections.bends)
    readings, time = seen.readings.copy(), seen.time
    for sensor, changes in enumerate(corrections.changes):
        for change in reversed(changes):
            readings[:, sensor], slope = change.undo(readings[:, sensor], time)
            slopes[:, sensor] *= slope
    return replace(seen, readings=readings), slopes


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
