"""Usual errors of channels: scale, bend and hum of each sensor, scale and delay of each drive.

They belong to the recording, not to the model: a recording is corrected for errors of given sizes. The error of a
sensor depends on the true value, which one-step predictions of the nominal model show without the noise of the moment;
a correction at the reading itself would change the scale of the noise, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.evidence.sensor_hum import SensorHum, list_hums
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.observation import Observation
from lostmotion.settings import RivalSettings


@dataclass(frozen=True, eq=False)
class SensorError:
    """A bend of a sensor of unit size: `shapes` has its first sample and its values (samples,) in each recording.

    It grows with a `power` of the reading; `width` is the prior standard deviation of its size.
    """

    sensor: int
    power: int
    shapes: Mapping[str, tuple[int, Array]]
    width: float

    def correct(self, observation: Observation, size: float) -> Observation:
        """Return the recording with the readings corrected for an error of this size."""
        first, shape = self.shapes[observation.name]
        begin = observation.begin - first
        readings = observation.readings.copy()
        readings[:, self.sensor] += size * shape[begin : begin + observation.samples]
        return observation.read_again(readings=readings)


@dataclass(frozen=True)
class ScaleError:
    """An error of the scale of a sensor; `width` is its prior standard deviation.

    The filter takes the gain: a scaled reading would have scaled noise, and one scaled by its prediction only has other
    correlations of its errors, so that the scale would seem to be known.
    """

    sensor: int
    width: float

    def correct(self, observation: Observation, size: float) -> Observation:
        """Return the recording of a sensor whose true values are larger than its readings by the fraction `size`."""
        gains = list(observation.gains or (1.0,) * len(observation.sensors))
        gains[self.sensor] /= 1.0 + size
        return observation.read_again(gains=tuple(gains))


@dataclass(frozen=True)
class DriveError:
    """An error of the scale of an input, or with `late` a delay of it, in samples; `width` is its prior deviation."""

    column: int
    late: bool
    width: float

    def correct(self, observation: Observation, size: float) -> Observation:
        """Return the recording with the input corrected for an error of this size."""
        inputs, shown = observation.inputs.copy(), observation.inputs[:, self.column]
        inputs[:, self.column] = shown + size * (np.gradient(shown) if self.late else shown)
        return replace(observation, inputs=inputs)


ChannelError = SensorError | ScaleError | SensorHum | DriveError


def list_channel_errors(nominal: Fit, recordings: Sequence[Observation]) -> tuple[ChannelError, ...]:
    """Return the usual errors of the channels of some whole recordings, with the predictions of a nominal fit."""
    usual, first = nominal.posterior.settings.rival, recordings[0]
    shown = {o.name: (o.begin, _predict_readings(nominal, o)) for o in recordings}
    errors: list[ChannelError] = []
    for sensor in range(len(first.sensors)):
        errors += _list_sensor_errors(sensor, shown, usual)
    errors += list_hums(nominal)
    for column in range(first.inputs.shape[1]):
        if any(np.any(o.inputs[:, column]) for o in recordings):
            errors += [DriveError(column, False, usual.scale), DriveError(column, True, usual.late)]
    return tuple(errors)


def _list_sensor_errors(
    sensor: int, shown: Mapping[str, tuple[int, Array]], usual: RivalSettings
) -> Iterator[SensorError | ScaleError]:
    """Yield the errors of one sensor: of its scale, and a quadratic and a cubic bend about the middle of its range."""
    values = np.concatenate([z[:, sensor] for _, z in shown.values()])
    middle = float(np.mean(values))
    half = float(np.max(np.abs(values - middle)))
    if not half > 0.0:
        return
    yield ScaleError(sensor, usual.scale)
    for power in (2, 3):
        shapes = {name: (first, half * ((z[:, sensor] - middle) / half) ** power) for name, (first, z) in shown.items()}
        yield SensorError(sensor, power, shapes, usual.bent)


def _predict_readings(nominal: Fit, observation: Observation) -> Array:
    """Return the one-step predictions (samples, sensors) of a recording; the last one where nothing was read."""
    errors = nominal.posterior.on((observation,)).innovations(nominal.theta).errors
    predicted = observation.readings - errors.reshape(observation.readings.shape)
    for column in predicted.T:
        lost = ~np.isfinite(column)
        if lost.any():
            places = np.arange(len(column))
            column[lost] = np.interp(places[lost], places[~lost], column[~lost])
    return predicted
