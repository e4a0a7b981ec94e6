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
"""A reading is put right to this share of its range; slopes are taken over this share of it."""


class Bend(NamedTuple):
    """A nonlinear sensor: its number, the term that makes it so, and the parameters of that."""

    sensor: int
    term: SensorTerm
    values: Values


class Corrections(NamedTuple):
    """What has to be undone in the readings of a recording: nonlinear sensors, and the changes of each sensor."""

    bends: tuple[Bend, ...] = ()
    changes: tuple[tuple[SensorChange, ...], ...] = ()


def corrections_of(system: System, active: frozenset[str], full: Array, sensors: Sequence[Sensor]) -> Corrections:
    """Return the corrections that the active terms of a system ask for at a full vector (parameters,)."""
    if not active & {*system.bending, *system.rescaling}:
        return Corrections()
    bends = tuple(
        Bend(s, term, p)
        for s, sensor in enumerate(sensors)
        for term, p in system.at_sensor(full, active, sensor.place)
        if type(term).bent is not SensorTerm.bent
    )
    changes = tuple(system.changes_at_sensor(full, active, sensor.place) for sensor in sensors)
    return Corrections(bends, changes if any(changes) else ())


def correct(seen: Observation, corrections: Corrections) -> tuple[Observation, Array | None]:
    """Return an observation with its readings corrected, and the slopes (samples, sensors) of that; None without."""
    if not any(corrections):
        return seen, None
    seen, slopes = unbent(seen, corrections.bends)
    readings, time = seen.readings.copy(), seen.time
    for sensor, changes in enumerate(corrections.changes):
        for change in reversed(changes):
            readings[:, sensor], slope = change.undo(readings[:, sensor], time)
            slopes[:, sensor] *= slope
    return replace(seen, readings=readings), slopes


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
