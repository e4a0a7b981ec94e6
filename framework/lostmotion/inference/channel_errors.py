"""Usual errors of sensors and drives (scale, nonlinearity, delay), and their effect on the one-step errors of a fit."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.observation import Observation
from lostmotion.settings import RivalSettings

Change = Callable[[Observation, float], Observation]
STEP = 1e-4
"""The finite-difference step of each error."""


@dataclass(frozen=True)
class ChannelError:
    """An error of a channel: the derivatives of one-step errors and variances (readings,), and its prior `width`.

    It is applied to the recording, not to the model: `change` returns a recording with an error of given size, and
    `log_jacobian` is the derivative of the log density of the readings, whose scale the error changes.
    """

    errors: Array
    variances: Array
    width: float
    log_jacobian: float
    change: Change


def list_channel_errors(fit: Fit) -> list[ChannelError]:
    """Return the channel errors: scale, quadratic and cubic error of each sensor, scale and delay of each drive."""
    problem, here = fit.problem, fit.problem.innovations(fit.theta)
    found = []
    for change, width, log_jacobian in _list_changes(problem.observations, problem.settings.rival):
        seen = problem.on(tuple(change(o, STEP) for o in problem.observations)).innovations(fit.theta)
        slopes = (seen.errors - here.errors) / STEP, (seen.variances - here.variances) / STEP
        found.append(ChannelError(*slopes, width, log_jacobian, change))
    return found


def _list_changes(observations: tuple[Observation, ...], usual: RivalSettings) -> Iterator[tuple[Change, float, float]]:
    """Yield each channel error as a change of a recording, with its prior width and its log Jacobian per unit size."""
    first = observations[0]
    for sensor in range(len(first.sensors)):
        shown = np.concatenate([o.readings[:, sensor] for o in observations])
        middle = float(np.nanmean(shown))
        amplitude = float(np.nanmax(np.abs(shown - middle)))
        if not amplitude > 0.0:
            continue
        z = (shown[np.isfinite(shown)] - middle) / amplitude
        for power, width in ((1, usual.scale), (2, usual.bent), (3, usual.bent)):
            log_jacobian = float(np.sum(power * z ** (power - 1)))
            yield _distort_sensor(sensor, power, (middle, amplitude)), width, log_jacobian
    for column in range(first.inputs.shape[1]):
        if any(np.any(o.inputs[:, column]) for o in observations):
            yield _scale_drive(column), usual.scale, 0.0
            yield _shift_drive(column), usual.late, 0.0


def _distort_sensor(sensor: int, power: int, scale: tuple[float, float]) -> Change:
    middle, amplitude = scale

    def change(o: Observation, size: float) -> Observation:
        readings = o.readings.copy()
        shown = o.readings[:, sensor]
        more = shown if power == 1 else amplitude * ((shown - middle) / amplitude) ** power
        readings[:, sensor] = shown + size * more
        return replace(o, readings=readings)

    return change


def _scale_drive(column: int) -> Change:
    def change(o: Observation, size: float) -> Observation:
        inputs = o.inputs.copy()
        inputs[:, column] *= 1.0 + size
        return replace(o, inputs=inputs)

    return change


def _shift_drive(column: int) -> Change:
    def change(o: Observation, size: float) -> Observation:
        inputs = o.inputs.copy()
        inputs[:, column] += size * np.gradient(o.inputs[:, column])
        return replace(o, inputs=inputs)

    return change
