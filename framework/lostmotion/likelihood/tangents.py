"""Derivatives of one-step errors with respect to small forces and small changes of the channels, all in one pass.

A filter along a recording is linear in a small additional force: its errors respond through the transition matrices and
the gains that the filter computed at the point. One run of the filter for a smoother gives both. The response to a
hundred forces then costs as much as one further run, where differences would take a hundred (the slow twin, which the
tests compare).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lostmotion.contracts import Array, Place
from lostmotion.kernels.linear_response import respond
from lostmotion.likelihood.bends import (
    NUDGE,
    Bend,
    compute_sensor_errors,
    correct_bends,
    correct_by_predictions,
    list_corrections,
    rescale_innovations,
)
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points, join_points
from lostmotion.likelihood.posterior import Posterior

UNIT = 1e-4
"""The inputs are changed by this share for their derivatives."""


@dataclass(frozen=True)
class BentSensors:
    """Nonlinear sensors, whose errors are those at the values that a `first` pass of the filter predicts.

    `rise` (samples, sensors) is the derivative of the error over the predicted value, zero where a reading is corrected
    by the error at itself, and `slopes` (samples, sensors) those of the correction.
    """

    first: Tangents
    rise: Array
    slopes: Array


@dataclass(frozen=True)
class Tangents:
    """The filter of one recording at one point: filtered `states` (samples, n), transitions, gains and variances.

    `posterior` has this recording alone; `full` is its parameter vector. `slopes` (samples, sensors, states + noise
    states) are the derivatives of the readings, `spread` (samples, sensors) the variances of the errors. `noise` are
    transition, driving noise and first covariance of the noise states, (states, states) each.
    """

    posterior: Posterior
    full: Array
    states: Array
    steps: Array
    ahead: Array
    slopes: Array
    spread: Array
    noise: tuple[Array, Array, Array]
    gain: Array
    bent: BentSensors | None = None

    @property
    def observation(self) -> Observation:
        """The recording."""
        return self.posterior.observations[0]

    def respond_to_forces(self, rates: Array, channels: Array) -> Array:
        """Return the derivatives (count, samples * sensors) of errors over forces.

        `rates` (count, samples, model and term states) are the accelerations that each force of unit size gives, and
        `channels` (count, samples, channels) what it adds to the channels at once.
        """
        columns = [self.posterior.system.channel(s.channel)[0] for s in self.observation.sensors]
        wide = np.zeros((len(rates), *self.steps.shape[:2]))
        wide[:, :, : rates.shape[2]] = rates
        seen = np.ascontiguousarray(-channels[:, :, columns] * self.gain)
        if self.bent is not None:
            seen += self.bent.rise * self.bent.first.respond_to_forces(rates, channels).reshape(seen.shape)
        told = (self.steps, self.ahead, self.slopes, self.spread, *self.noise, self.observation.dt)
        found = respond(*told, wide, seen)
        return np.asarray((found if self.bent is None else found / self.bent.slopes).reshape(len(rates), -1))

    def respond_to_laws(self, fulls: Array, active: frozenset[str], sizes: Array) -> Array:
        """Return the derivatives (sets, samples * sensors) of errors over amplitudes of laws.

        Each of the parameter vectors `fulls` (sets, parameters) has one amplitude at a distance `sizes` (sets,) from
        where its law does nothing; `active` are the terms with these laws.
        """
        rates, channels = self.compute_effects(fulls, active)
        scale = sizes[:, None, None]
        return self.respond_to_forces((rates - self.here[0]) / scale, (channels - self.here[1]) / scale)

    def compute_effects(self, fulls: Array, active: frozenset[str]) -> tuple[Array, Array]:
        """Return derivatives of states (sets, samples, n) and channels along the states, for some parameter vectors."""
        system, observation = self.posterior.system, self.observation
        packed = self.posterior.dynamics.pack(fulls, observation)
        return system.compute_each(active, packed, self.states, self.inputs, observation.time)

    @cached_property
    def inputs(self) -> Array:
        """The inputs (samples, inputs) that act, with the terms of the drive."""
        return self.posterior.recordings[0].drive(self.full).inputs[: len(self.states)]

    @cached_property
    def here(self) -> tuple[Array, Array]:
        """Derivatives of states (samples, n) and channels (samples, channels) along the states, with all terms."""
        rates, seen = self.compute_effects(self.full[None], self.posterior.active)
        return rates[0], seen[0]

    def respond_to_input(self, change: Array) -> Array:
        """Return the derivative (1, samples * sensors) of errors over a `change` (samples, inputs) of the inputs."""
        system, observation = self.posterior.system, self.observation
        packed = self.posterior.dynamics.pack(self.full[None], observation)
        moved = self.inputs + UNIT * change
        rates, seen = system.compute_each(self.posterior.active, packed, self.states, moved, observation.time)
        return self.respond_to_forces((rates - self.here[0]) / UNIT, (seen - self.here[1]) / UNIT)

    def move(self, place: Place) -> Array:
        """Return relative position and velocity (2, samples) at a place."""
        n = len(self.posterior.system.model.states)
        lever = self.posterior.system.lever(self.full, place)
        return place.move(self.states[:, :n], self.observation.inputs, lever)


def linearise_recordings(posterior: Posterior, theta: Array) -> list[Tangents]:
    """Return the linearised filter of each recording; none where that of one recording does not exist."""
    made = [linearise_filter(posterior, theta[None], i) for i in range(len(posterior.observations))]
    filtered = [one[0] for one in made if one is not None]
    return filtered if len(filtered) == len(made) else []


def linearise_filter(
    posterior: Posterior, thetas: Array, index: int = 0, changed: Sequence[Observation] = ()
) -> tuple[Tangents, Innovations] | None:
    """Return the linearised filter of a recording at the first of some coordinates, and the innovations at all.

    `thetas` are (points, n). The innovations of `changed` recordings, with other inputs or readings, at the first point
    come last. None where a sensor is late or changes, or where the filter diverged.
    """
    single = replace(posterior.on((posterior.observations[index],)), jobs=1)
    if single.active & {*single.system.rescaling, *single.system.lagging_terms}:
        return None
    if any(map(any, single.recordings[0].count_delays(thetas))):
        return None
    points, others = single.recordings[0].points(thetas), [single.on((other,)).filters[0] for other in changed]
    if np.any(points.lag != 0.0):
        return None
    views = [single.filters[0].view(), *(other.view() for other in others)]
    parts = [points, *(other.recording.points(thetas[:1]) for other in others)]
    seen = np.stack([view.readings for view, part in zip(views, parts, strict=True) for _ in range(len(part))])
    every, single = join_points(parts, views), single.on((views[0],))
    bends = [list_corrections(single.system, single.active, full, views[0].sensors).bends for full in every.params]
    return _run_twice(single, every, seen, bends) if any(bends) else _run(single, every)


def _run_twice(
    posterior: Posterior, points: Points, seen: Array, bends: Sequence[tuple[Bend, ...]]
) -> tuple[Tangents, Innovations] | None:
    """Return the same as `_run` for readings `seen` (points, samples, sensors) of nonlinear sensors: see `bends.py`."""
    view = posterior.observations[0]
    pairs = [correct_bends(replace(view, readings=own), bent) for own, bent in zip(seen, bends, strict=True)]
    readings, slopes = np.stack([one.readings for one, _ in pairs]), np.stack([slope for _, slope in pairs])
    if (begun := _run(posterior, replace(points, readings=readings))) is None:
        return None
    first, found = begun
    predicted, noise = readings[0] - found.errors[0], points.noise.variances(view.sensors)
    readings, slopes, known = correct_by_predictions(seen, bends, readings, slopes, found, noise)
    if (ended := _run(posterior, replace(points, readings=readings))) is None:
        return None
    reach = NUDGE * np.nanmax(np.abs(predicted), axis=0, initial=1e-300)
    sides = [compute_sensor_errors(bends[0], predicted + side * reach) for side in (1.0, -1.0)]
    rise = np.where(known[0] & np.isfinite(predicted), (sides[0] - sides[1]) / (2.0 * reach), 0.0)
    bent = BentSensors(first, rise, np.where(np.isfinite(slopes[0]), slopes[0], 1.0))
    return replace(ended[0], bent=bent), rescale_innovations(ended[1], slopes)


def _run(posterior: Posterior, points: Points) -> tuple[Tangents, Innovations] | None:
    """Return the linearised filter at the first of some points, and the innovations at all; None after a divergence.

    The posterior has one recording, as a filter sees it.
    """
    view, full, gain = posterior.observations[0], points.params[0], points.gain[0]
    kept = posterior.dynamics.make_kept(view.samples)
    innovations = posterior.dynamics.filter_and_keep(view, points, kept)
    if not innovations.finite[0]:
        return None
    seen, _, before, ahead, steps = kept
    n, states, shown = posterior.dynamics.states, seen.shape[1], points.noise.shown[0]
    slopes = np.zeros((*innovations.errors.shape[1:], states + len(shown)))
    slopes[:, :, :states] = _compute_slopes(posterior, full, before, ahead)
    slopes *= gain[:, None]
    ends = np.cumsum([sensor.noise_states for sensor in view.sensors])
    for s, (sensor, end) in enumerate(zip(view.sensors, ends, strict=True)):
        own = slice(end - sensor.noise_states, end)
        slopes[:, s, states:][:, own] = shown[own]
    read = np.isfinite(view.readings if points.readings is None else points.readings[0])
    spread = np.where(read, innovations.variances[0], math.inf)
    noise = (points.noise.transition[0], points.noise.driving[0], points.noise.first[0])
    return Tangents(posterior, full, seen[:, :n], steps, ahead, slopes, spread, noise, gain), innovations


def _compute_slopes(posterior: Posterior, full: Array, states: Array, covariance: Array) -> Array:
    """Return the derivatives (samples, sensors, n) of the channels of the sensors over the states of the filter."""
    running, observation = posterior.dynamics, posterior.observations[0]
    found = np.zeros((len(states), len(observation.sensors), states.shape[1]))
    shown = [running.system.shown(sensor, running.active) for sensor in observation.sensors]
    for s, (_, direct) in enumerate(shown):
        if direct >= 0:
            found[:, s, direct] = 1.0
    others = [(s, channel) for s, (channel, direct) in enumerate(shown) if direct < 0]
    if not others:
        return found
    packed = posterior.dynamics.pack(full[None], observation)
    inputs = posterior.recordings[0].drive(full).inputs[: len(states)]
    forces = tuple(running.states + i for i in range(running.forces))
    for c in range(states.shape[1]):
        reach = np.sqrt(np.maximum(covariance[:, c, c], 0.0)) + 1e-9 * (1e-300 + np.max(np.abs(states[:, c])))
        ends = []
        for side in (1.0, -1.0):
            moved = states.copy()
            moved[:, c] += side * reach
            run = (running.active, packed, moved, inputs, observation.time)
            ends.append(running.system.compute_each(*run, latent=forces)[1][0])
        for s, channel in others:
            found[:, s, c] = (ends[0][:, channel] - ends[1][:, channel]) / np.where(reach > 0.0, 2.0 * reach, 1.0)
    return found
