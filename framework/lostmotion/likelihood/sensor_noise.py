"""The parameters of the noise of a sensor, and its blocks at values of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import lru_cache

import numpy as np

from lostmotion.contracts import Array
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.space import FreeParameter, Scales
from lostmotion.noises import Noise, NoiseBlock, NoiseParameter, SensorScales

_ANY = SensorScales(0.0, 1.0, 1.0, 1.0, 1.0, 1.0)


def make_sensor_scales(observation: Observation, sensor: int, log_noise: float, scales: Scales) -> SensorScales:
    """Return what a sensor shows; `log_noise` is the logarithm of its white noise."""
    z, dt = observation.readings[:, sensor], observation.dt
    size, span = float(np.nanstd(z)), observation.samples * dt
    return SensorScales(log_noise, size, compute_speed(z, dt), dt, scales.time, span)


def compute_speed(readings: Array, dt: float) -> float:
    """Return the rms speed that readings (samples,) show, from differences over so many samples that noise is small."""
    kept = readings[np.isfinite(readings)]
    fourth = np.diff(kept, 4)
    noise = float(np.mean(fourth**2)) / 70.0 if len(fourth) else 0.0
    for step in (1, 2, 4, 8, 16, 32):
        apart = kept[step:] - kept[:-step]
        square = float(np.mean(apart**2)) - 2.0 * noise if len(apart) else 0.0
        if square > 20.0 * noise:
            break
    return math.sqrt(max(square, 0.0)) / (step * dt)


def make_levels(observation: Observation, sensor: int, noise: Noise, scales: SensorScales) -> list[FreeParameter]:
    """Return the parameters of a noise of a sensor as free parameters, in logarithms."""
    return [
        FreeParameter(observation.level(name, sensor), "1", start, low, high, mean=mean, sd=sd)
        for name, start, low, high, mean, sd, _ in noise.parameters(scales)
    ]


@lru_cache(maxsize=64)
def list_levels(noise: Noise) -> tuple[NoiseParameter, ...]:
    """Return the parameters of a noise; their numbers are those of any sensor."""
    return noise.parameters(_ANY)


def read_values(sensor: Sensor, read: Callable[[str], Array]) -> list[Array]:
    """Return for each noise of a sensor its parameters (points, parameters); `read` returns a logarithm by its name."""
    rows = [[np.exp(read(level.name)) for level in list_levels(noise)] for noise in sensor.noises]
    return [np.stack(np.broadcast_arrays(*row), axis=-1) if row else np.zeros((1, 0)) for row in rows]


def has_clock_noise(noise: Noise) -> bool:
    """Return whether a noise is one of the stamps, whose size depends on the speed of the channel."""
    start = tuple(math.exp(level.start) for level in list_levels(noise))
    return noise.covariance(start, 1.0).clock > 0.0


def compute_blocks(sensor: Sensor, values: Iterable[Array], dt: float, points: int) -> list[NoiseBlock]:
    """Return the noise of a sensor at each of some points, equal ones once; `values` are what `read_values` returns."""
    columns = [np.broadcast_to(array, (points, array.shape[-1])).tolist() for array in values]
    rows = [tuple(map(tuple, row)) for row in zip(*columns, strict=True)]
    made = {
        row: NoiseBlock.join([noise.covariance(p, dt) for noise, p in zip(sensor.noises, row, strict=True)])
        for row in dict.fromkeys(rows)
    }
    return [made[row] for row in rows]


def compute_variance(block: NoiseBlock, observation: Observation, sensor: int) -> float:
    """Return the variance of noise of a sensor, in the middle of the recording and at the rms speed of its readings."""
    speed = compute_speed(observation.readings[:, sensor], observation.dt) if block.clock else 0.0
    return block.white + block.clock * speed**2 + block.variance_after(observation.samples // 2)
