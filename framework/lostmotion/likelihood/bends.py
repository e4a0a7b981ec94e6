"""Readings of nonlinear sensors, and of sensors that change at a time, corrected before the filter sees them.

The density of the readings changes by the slope of the correction, so that likelihoods stay comparable.

A nonlinear sensor adds its error to the true value, and the noise comes on top. At a noisy reading the error is
therefore computed at a wrong value: a wave over position comes out too small. Readings are filtered twice: first
corrected by the error at the reading itself, then by the error at the value that the first pass predicts from the
readings before.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, SensorTerm, Values
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points
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


class SensorCorrections(NamedTuple):
    """The corrections of the readings of a recording: nonlinear sensors, and the changes of each sensor."""

    bends: tuple[Bend, ...] = ()
    changes: tuple[tuple[SensorChange, ...], ...] = ()


def list_corrections(
    system: System, active: frozenset[str], full: Array, sensors: Sequence[Sensor]
) -> SensorCorrections:
    """Return the corrections for the active terms of a system at a full vector (parameters,)."""
    if not active & {*system.bending_terms, *system.rescaling}:
        return SensorCorrections()
    bends = tuple(
        Bend(s, term, p)
        for s, sensor in enumerate(sensors)
        for term, p in system.at_sensor(full, active, sensor.place)
        if type(term).bent is not SensorTerm.bent
    )
    changes = tuple(system.changes_at_sensor(full, active, sensor.place) for sensor in sensors)
    return SensorCorrections(bends, changes if any(changes) else ())


Filter = Callable[[Observation, Points], Innovations]


def filter_corrected(
    filter_readings: Filter, seen: Observation, corrections: Sequence[SensorCorrections], points: Points
) -> Innovations:
    """Return the innovations of corrected readings, in the scale of the readings themselves.

    `corrections` are those of each point.
    """
    if not any(map(any, corrections)):
        return filter_readings(seen, points)
    readings, slopes = correct_twice(filter_readings, seen, corrections, points)
    return rescale_innovations(filter_readings(seen, replace(points, readings=readings)), slopes)


def correct_twice(
    filter_readings: Filter, seen: Observation, corrections: Sequence[SensorCorrections], points: Points
) -> tuple[Array, Array]:
    """Return for each point the readings corrected by the errors of its sensors at predicted values, and slopes.

    Both are (points, samples, sensors). The predictions are those of a first pass. Where a prediction is less certain
    than a reading, as at the beginning, and for a sensor that changes at a time, the reading is corrected by the error
    at itself.
    """
    pairs = [correct_readings(seen, one) for one in corrections]
    readings, slopes = (np.stack(arrays) for arrays in zip(*pairs, strict=True))
    twice = [i for i, one in enumerate(corrections) if one.bends and not one.changes]
    if not twice:
        return readings, slopes
    found = filter_readings(seen, replace(points.select(twice), readings=readings[twice]))
    bends, noise = [corrections[i].bends for i in twice], points.noise.variances(seen.sensors)[twice]
    again = correct_by_predictions(seen.readings, bends, readings[twice], slopes[twice], found, noise)
    readings[twice], slopes[twice], _ = again
    return readings, slopes


def correct_by_predictions(
    seen: Array, bends: Sequence[Sequence[Bend]], readings: Array, slopes: Array, found: Innovations, noise: Array
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Return readings corrected by the errors of sensors at predicted values, slopes, and where that was possible.

    These and `readings` and `slopes` of a first pass with innovations `found` are (points, samples, sensors), as `seen`
    or without points; `bends` are those of each point, and `noise` (points, sensors) is the variance of a reading.
    Where a prediction is less certain than a reading, the correction of the first pass stays.
    """
    known = found.variances < 2.0 * noise[:, None]
    wrong = [compute_sensor_errors(own, one) for own, one in zip(bends, readings - found.errors, strict=True)]
    return np.where(known, seen - np.stack(wrong), readings), np.where(known, 1.0, slopes), known


def compute_sensor_errors(bends: Sequence[Bend], values: Array) -> Array:
    """Return the errors (samples, sensors) of nonlinear sensors at true values of the same shape."""
    shown = values.copy()
    for sensor, term, p in reversed(bends):
        shown[:, sensor] = term.bent(shown[:, sensor], p)
    return np.asarray(shown - values)


def correct_readings(seen: Observation, corrections: SensorCorrections) -> tuple[Array, Array]:
    """Return the corrected readings (samples, sensors) of an observation, and the slopes of that, of the same shape."""
    seen, slopes = correct_bends(seen, corrections.bends)
    readings, time = seen.readings.copy(), seen.time
    for sensor, changes in enumerate(corrections.changes):
        for change in reversed(changes):
            readings[:, sensor], slope = change.undo(readings[:, sensor], time)
            slopes[:, sensor] *= slope
    return readings, slopes


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
