"""A scan of shapes such as a pitch, a stop or a time over their whole range, along the recording.

A score test costs filter runs, and a wave over position is found only if its pitch is tried to a few per cent. A law
without states is correlated with the gradient of the log-likelihood itself, at a hundred shapes in a moment; one with a
clear correlation is then tested by the filter like any other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lostmotion.contracts import Array, SensorTerm, place_of
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import compute_size, find_term, list_tried_values, sort_slots
from lostmotion.inference.rounding import drop_rounding
from lostmotion.inference.setup import choose_steps
from lostmotion.likelihood.latent import smooth_expected_force
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import Slot
from lostmotion.quantities import LENGTH

REACH = 3.9
"""The range of shapes without a scan, as a logarithm from the typical value: that of their prior."""
APART, FEWEST = 0.033, 30
"""The spacing of shapes in logarithms, and their least number."""
TURN, MOST_SHAPES = 0.25, 300
"""Neighbouring lengths differ by this share of a period over the travel, so that no pitch between them is missed,
and their largest number."""
MOST_SAMPLES, TOGETHER = 3000, 100
"""The samples that are compared, and the number of shapes in one array."""
BLOCKS = 40
"""Parts of a recording over which the correlation of a law with the gradient is averaged for its standard error."""


@dataclass(frozen=True)
class SmoothedMotion:
    """A recorded motion: smoothed `states` (samples, n), and the gradient `gradient` (samples,) there.

    `gradient` is the gradient of the log-likelihood with respect to a force on the first body.
    """

    posterior: Posterior
    theta: Array
    states: Array
    gradient: Array

    @classmethod
    def of(cls, posterior: Posterior, theta: Array) -> SmoothedMotion:
        """Return the motion of the first recording of a posterior at coordinates `theta`."""
        states, gradient = smooth_expected_force(posterior, theta)
        return cls(posterior, theta, np.ascontiguousarray(states[:, : len(posterior.system.model.states)]), gradient)

    @property
    def travel(self) -> float:
        """The range of the first position (m or rad)."""
        return float(np.ptp(self.states[:, self.posterior.system.model.first_body[0]]))

    def compute_laws(self, key: str, tried: Sequence[Mapping[str, float]]) -> Array:
        """Return the accelerations (tried, samples) that a term with these parameters gives the body at its place.

        A term of the drive gives them to the first body.
        """
        posterior, observation = self.posterior, self.posterior.observations[0]
        system, term = posterior.system, find_term(posterior, key)[0]
        fulls = np.tile(self._full, (len(tried), 1))
        for full, values in zip(fulls, tried, strict=True):
            full[[system.index[name] for name in values]] = list(values.values())
        if term.acts == "drive":
            place, acting = system.model.first_place, posterior.acting(posterior.active | {key})
            changed = (acting.recordings[0].drive(full).inputs[: len(self.states)] for full in fulls)
            driven = [self._rates(self._packed, frozenset(), inputs)[0] for inputs in changed]
            return system.accelerate(np.array(driven), place) - system.accelerate(self._driven[0], place)
        place = place_of(system.model, term)
        packed = posterior.dynamics.pack(fulls, observation)
        forced = self._rates(packed, frozenset({key}), observation.inputs)
        return system.accelerate(forced, place) - system.accelerate(self._bare[0], place)

    def compute_columns(self, key: str, shapes: Sequence[Mapping[str, float]]) -> Array:
        """Return the effect of each amplitude of a term alone at its typical size, (shapes, samples, amplitudes)."""
        amplitudes, _ = sort_slots(self.posterior, key)
        still = {s.key: float(s.param.null or 0.0) for s in amplitudes}
        alone = [{**still, one.key: compute_size(one.param, self.posterior.scales)} for one in amplitudes]
        laws = self.compute_laws(key, [{**shape, **size} for shape in shapes for size in alone])
        return np.asarray(laws.reshape(len(shapes), len(alone), -1).transpose(0, 2, 1))

    def _rates(self, packed: Array, active: frozenset[str], inputs: Array) -> Array:
        times = self.posterior.observations[0].time
        return self.posterior.system.compute_each(active, packed, self.states, inputs, times)[0]

    @cached_property
    def _full(self) -> Array:
        """The full parameter vector of the fit."""
        return self.posterior.recordings[0].full(self.theta)

    @cached_property
    def _packed(self) -> Array:
        """The parameters of the fit without any term."""
        posterior, observation = self.posterior, self.posterior.observations[0]
        return posterior.dynamics.pack(self._full[None], observation)

    @cached_property
    def _bare(self) -> Array:
        """The derivatives (1, samples, n) of the states without any term."""
        return self._rates(self._packed, frozenset(), self.posterior.observations[0].inputs)

    @cached_property
    def _driven(self) -> Array:
        """The derivatives (1, samples, n) of the states with the input that acts in the fit, without other terms."""
        inputs = self.posterior.recordings[0].drive(self._full).inputs[: len(self.states)]
        return self._rates(self._packed, frozenset(), inputs)


@dataclass(frozen=True)
class SensorErrors:
    """The readings of a sensor: predictions (samples,), and errors over their variances (samples,)."""

    posterior: Posterior
    foretold: Array
    gradient: Array

    @property
    def travel(self) -> float:
        """The range of the predicted readings."""
        return float(np.ptp(self.foretold))

    def compute_columns(self, key: str, shapes: Sequence[Mapping[str, float]]) -> Array:
        """Return the error of the sensor by each amplitude alone at its typical size, (shapes, samples, amplitudes)."""
        return np.stack([self._bend(key, shape) for shape in shapes])

    def _bend(self, key: str, shape: Mapping[str, float]) -> Array:
        """Return the error of the sensor by each amplitude alone at its typical size, (samples, amplitudes)."""
        term, slots = find_term(self.posterior, key)
        bends = []
        for one in (s for s in slots if s.param.null is not None):
            p = tuple(shape.get(s.key, compute_size(s.param, self.posterior.scales) * (s is one)) for s in slots)
            assert isinstance(term, SensorTerm)  # noqa: S101
            bends.append(term.bent(self.foretold, p) - self.foretold)
        return np.stack(bends, axis=1)


def _make_sensor_errors(posterior: Posterior, theta: Array, key: str) -> SensorErrors:
    """Return the predictions and errors of the sensor of a term."""
    observation, seen = posterior.observations[0], posterior.innovations(theta)
    width = len(observation.sensors)
    sensor = next(i for i, s in enumerate(observation.sensors) if s.place == find_term(posterior, key)[0].at)
    errors, variances = (row.reshape(-1, width)[:, sensor] for row in (seen.errors, seen.variances))
    readings = observation.readings[:, sensor]
    kept = np.isfinite(readings)
    return SensorErrors(posterior, (readings - errors)[kept], (errors / variances)[kept])


def measure_steadiness(motion: SmoothedMotion | SensorErrors, key: str, shapes: Sequence[Mapping[str, float]]) -> Array:
    """Return the correlations (shapes,) of a term with the gradient in standard errors, all amplitudes together."""
    batches = [shapes[i : i + TOGETHER] for i in range(0, len(shapes), TOGETHER)]
    return np.concatenate([_combine_steadiness(motion.compute_columns(key, b), motion.gradient) for b in batches])


def _combine_steadiness(laws: Array, gradient: Array) -> Array:
    """Return correlations (shapes,) of laws (shapes, samples, amplitudes) with a gradient, all amplitudes together.

    The unit is a standard error of the mean, from its values over parts of the recording. It is zero for a law that is
    constant, or infinite somewhere.
    """
    edges = np.linspace(0, len(gradient), BLOCKS + 1).astype(int)[:-1]
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        parts = np.add.reduceat((laws - laws.mean(axis=1, keepdims=True)) * gradient[:, None], edges, axis=1)
        steady = parts.mean(axis=1) / (parts.std(axis=1, ddof=1) / math.sqrt(BLOCKS))
    return np.asarray(np.sqrt(np.sum(np.where(np.isfinite(steady), steady, 0.0) ** 2, axis=1)))


def scan_shapes(fit: Fit) -> dict[str, list[dict[str, float]]]:
    """Return for each law the shape that correlates clearly with the gradient, where there is one.

    A stop that is hit rarely leaves no random force, so all laws are scanned for any fit.
    """
    keys, whole = list_scannable(fit.posterior), fit.posterior.observations[0]
    if not keys:
        return {}
    posterior = choose_steps(fit.posterior, fit.theta).on((whole.part(0, min(whole.samples, MOST_SAMPLES)),))
    motion, found = SmoothedMotion.of(posterior, fit.theta), {}
    for key in keys:
        of_sensor = find_term(posterior, key)[0].acts == "sensor"
        if best := _select_best_shape(_make_sensor_errors(posterior, fit.theta, key) if of_sensor else motion, key):
            found[key] = [best]
    return found


def list_scannable(posterior: Posterior) -> list[str]:
    """Return the keys of the terms whose shapes are scanned: those with a free shape that are not active.

    They are forces without states, terms of the drive, and terms that make a sensor nonlinear.
    """
    idle = [(key, find_term(posterior, key)[0]) for key in posterior.system.keys if key not in posterior.active]
    plain = [key for key, term in idle if term.acts in ("motion", "drive") and not term.states]
    return [key for key in (*plain, *posterior.system.bending_terms) if _list_free_shapes(posterior, key)]


def _list_free_shapes(posterior: Posterior, key: str) -> list[Slot]:
    return [s for s in sort_slots(posterior, key)[1] if s.param.scale == "log" and not s.param.prior.choices]


def _select_best_shape(motion: SmoothedMotion | SensorErrors, key: str) -> dict[str, float] | None:
    """Return the shape with the highest correlation with the gradient, if higher than the usual shapes, or None."""
    posterior = motion.posterior
    usual = {s.key: list_tried_values(s.param, posterior.scales) for s in sort_slots(posterior, key)[1]}

    travel = 0.0 if find_term(posterior, key)[0].acts == "drive" else motion.travel
    shapes = list_shapes(posterior, key, travel)
    if isinstance(motion, SensorErrors):
        shapes = drop_rounding(posterior, key, shapes)
    if not shapes:
        return None
    steady = measure_steadiness(motion, key, shapes)
    least = max(measure_steadiness(motion, key, _list_star_shapes(posterior, key, usual)))
    top = int(np.argmax(steady))
    return shapes[top] if steady[top] > max(posterior.settings.select.shape_steady, least) else None


def list_shapes(posterior: Posterior, key: str, travel: float = 0.0) -> list[dict[str, float]]:
    """Return the shapes of a law that are scanned: each free one over its range, the others in the middle.

    Lengths are closer for a long `travel`, because a pitch has many periods within it.
    """
    free = _list_free_shapes(posterior, key)
    return _list_star_shapes(posterior, key, {s.key: _make_grid(s, posterior, travel) for s in free})


def _list_star_shapes(
    posterior: Posterior, key: str, grids: Mapping[str, Array | tuple[float, ...]]
) -> list[dict[str, float]]:
    """Return shapes with one of them over its grid while the others stay in the middle, each choice with each."""
    shapes = sort_slots(posterior, key)[1]
    usual = {s.key: list_tried_values(s.param, posterior.scales) for s in shapes}
    middle = {name: grid[len(grid) // 2] for name, grid in usual.items()}
    tried = [{**middle, name: float(value)} for name, grid in grids.items() for value in grid]
    for s in shapes:
        if s.param.prior.choices:
            tried += [{**shape, s.key: value} for shape in tried for value in s.param.prior.choices]
    return tried


def _make_grid(slot: Slot, posterior: Posterior, travel: float) -> Array:
    """Return the values of a shape that are scanned, over its range."""
    size = compute_size(slot.param, posterior.scales)
    low, high = (size * end for end in slot.param.prior.scan or (math.exp(-REACH), math.exp(REACH)))
    count = max(round(math.log(high / low) / APART), FEWEST)
    grid = np.geomspace(low, high, count)
    if slot.param.dimension != LENGTH or not travel > 0.0:
        return grid
    waves = min(math.ceil(travel * (1.0 / low - 1.0 / high) / TURN), MOST_SHAPES)
    return grid if waves < count else np.unique(np.concatenate([grid, 1.0 / np.linspace(1.0 / high, 1.0 / low, waves)]))
