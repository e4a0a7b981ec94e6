"""The initial states of a recording: mean and covariance at the first sample, from what its sensors show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lostmotion.contracts import Array, SensorTerm
from lostmotion.likelihood.observation import Observation, find_static_equilibrium
from lostmotion.likelihood.running import RunningSystem
from lostmotion.likelihood.space import Scales
from lostmotion.quantities import quantity_of


def compute_initial(
    running: RunningSystem, observation: Observation, scales: Scales, fulls: Array, *, gain: Array, offset: Array
) -> tuple[Array, Array]:
    """Return mean (points, n) and covariance (points, n, n) of the states of model and terms at the first sample.

    `fulls` (points, parameters), `gain` and `offset` (points, sensors). Where a force was measured, the position
    depends on the parameters: it is the one at which the model shows this force.
    """
    model, n = running.system.model, running.states
    mean, cov = np.zeros((len(fulls), n)), np.zeros((len(fulls), n, n))
    for i, name in enumerate(model.states):
        cov[:, i, i] = (scales.velocity if i == model.first_body[1] or "velocity" in name else scales.length) ** 2
    _begin_terms(running, observation, scales, fulls, (mean, cov), gain=gain, offset=offset)
    if observation.begun is not None:
        known = slice(0, len(model.states))
        mean[:, known], cov[:, known, known] = observation.begun
        return mean, cov
    if all(sensor.channel.endswith("force") for sensor in observation.sensors):
        return _begin_by_force(running, observation, scales, fulls, (mean, cov), offset=offset[:, 0])
    for number, sensor in enumerate(observation.sensors):
        state = model.states.index(sensor.channel) if sensor.channel in model.states else -1
        if quantity_of(sensor.channel) == "position" and state >= 0 and not np.isnan(observation.first[number][0]):
            own = (state, model.find_rate(state), scales.length)
            _begin_at_reading(observation, number, own, (mean, cov), gain[:, number], offset[:, number])
    return mean, cov


def _begin_terms(
    running: RunningSystem,
    observation: Observation,
    scales: Scales,
    fulls: Array,
    begun: tuple[Array, Array],
    *,
    gain: Array,
    offset: Array,
) -> None:
    """Initialise the states of terms: a free one with its natural size, that of a sensor at its first reading.

    A recording begins within the motion, where the force of a hysteresis is anything up to its yield force.
    """
    (mean, cov), system = begun, running.system
    places = {sensor.place: i for i, sensor in enumerate(observation.sensors)}
    for (key, term), first in zip(system.forces, system.wiring(running.active)[1], strict=True):
        if key not in running.active:
            continue
        for i, size in enumerate(term.sizes):
            if size is None:
                continue
            cov[:, first + i, first + i] = (
                fulls[:, system.index[f"{key}.{size}"]]
                if isinstance(size, str)
                else size.scale(scales.force, scales.length, scales.time)
            ) ** 2
        if isinstance(term, SensorTerm) and (number := places.get(term.at)) is not None:
            seen = observation.first[number][0]
            amplitude = observation.amplitude_of(observation.sensors[number].label)
            mean[:, first] = 0.0 if np.isnan(seen) else (seen - offset[:, number]) / gain[:, number]
            cov[:, first, first] = (10.0 * observation.noises[number]) ** 2 + (1e-2 * amplitude) ** 2


def shows_place(observation: Observation) -> bool:
    """Return whether a sensor shows where the body is at the first sample."""
    return any(sensor.channel == "force" or quantity_of(sensor.channel) == "position" for sensor in observation.sensors)


def _begin_at_reading(
    observation: Observation,
    number: int,
    state: tuple[int, int | None, float],
    begun: tuple[Array, Array],
    gain: Array,
    offset: Array,
) -> None:
    """Initialise a position and its velocity from the first readings of a sensor."""
    (mean, cov), (at, rate, length) = begun, state
    place, speed = observation.first[number]
    mean[:, at] = (place - offset) / gain
    cov[:, at, at] = min((10.0 * observation.noises[number]) ** 2 + (1e-3 * length) ** 2, length**2)
    if rate is not None:
        mean[:, rate] = speed / gain
        cov[:, rate, rate] *= 0.25


def _begin_by_force(
    running: RunningSystem,
    observation: Observation,
    scales: Scales,
    fulls: Array,
    begun: tuple[Array, Array],
    *,
    offset: Array,
) -> tuple[Array, Array]:
    """Return mean and covariance where the first sensor shows a force: the body is where the model gives this force."""
    model, (mean, cov) = running.system.equations, begun
    mean[:, :2] = observation.inputs[0, :2]
    cov[:, 1, 1] *= 0.25
    for point, full in enumerate(fulls):
        shown = replace(observation, readings=observation.readings - offset[point])
        mean[point, 0], spread = find_static_equilibrium(shown, model, full[: len(model.params)])
        cov[point, 0, 0] = spread**2 + (1e-3 * scales.length) ** 2
    return mean, cov
