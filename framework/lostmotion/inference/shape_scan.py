"""Shapes such as a pitch, a stop or a time: looked for along the recording over their whole range at once.

A score test costs filter runs, and a wave over position is seen only by who tries its pitch to a few per cent. A law
without states can be held against the gradient of the log-likelihood itself, at a hundred shapes in a moment; one
that goes with it is then tried by the filter like any other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, SensorTerm, place_of
from lostmotion.inference.candidates import compute_slopes, run_score_test
from lostmotion.inference.fit import Fit
from lostmotion.inference.natural import compute_size, find_term, list_tried_values, sort_slots
from lostmotion.inference.setup import choose_steps
from lostmotion.likelihood.latent import smooth_expected_force
from lostmotion.likelihood.motion import compute_derivatives
from lostmotion.likelihood.problem import Problem
from lostmotion.likelihood.system import Slot

REACH = 3.9
"""Shapes without a scan are looked at up to this logarithm from the typical value, as far as a prior reaches."""
APART, FEWEST = 0.033, 30
"""How far shapes are apart, in logarithms, and how many there are at least: a wave with fifteen periods over the travel
is told by this."""
MOST_SAMPLES = 3000
BLOCKS = 40
"""Parts of a recording over which the correlation of a law with the gradient is averaged for its standard error."""


@dataclass(frozen=True)
class SmoothedMotion:
    """A recorded motion: `states` (samples, n) as the filter sees them, and the gradient `lean` (samples,) there.

    `lean` is that of the log-likelihood by a force on the first body.
    """

    problem: Problem
    theta: Array
    states: Array
    lean: Array

    def law(self, key: str, values: Mapping[str, float]) -> Array:
        """Return the acceleration (samples,) that a term with these parameters gives the body at its place."""
        problem, observation = self.problem, self.problem.observations[0]
        system, row = problem.system, place_of(problem.system.model, find_term(problem, key)[0]).row
        full = problem.full(self.theta)
        full[[system.index[name] for name in values]] = list(values.values())
        packed = system.pack(full[None], observation.dt / problem.nsub, observation.harmonic)
        return np.asarray(self._rates(packed, frozenset({key}))[:, row] - self._bare[:, row])

    def columns(self, key: str, shape: Mapping[str, float]) -> Array:
        """Return what each amplitude of a term does alone at its typical size, (samples, amplitudes)."""
        amplitudes, _ = sort_slots(self.problem, key)
        still = {s.key: float(s.param.null or 0.0) for s in amplitudes}
        laws = [
            self.law(key, {**shape, **still, one.key: compute_size(one.param, self.problem.scales)})
            for one in amplitudes
        ]
        return np.stack(laws, axis=1)

    def _rates(self, packed: Array, active: frozenset[str]) -> Array:
        observation = self.problem.observations[0]
        told = (packed, self.states, observation.inputs, observation.time)
        return compute_derivatives(self.problem.system, active, *told)[0]

    @cached_property
    def _bare(self) -> Array:
        """The derivatives (samples, n) of the states without any term."""
        problem, observation = self.problem, self.problem.observations[0]
        full = problem.full(self.theta)[None]
        packed = problem.system.pack(full, observation.dt / problem.nsub, observation.harmonic)
        return self._rates(packed, frozenset())

    def steady(self, key: str, shape: Mapping[str, float]) -> float:
        """Return by how many standard errors a law of a shape goes with the gradient, all amplitudes together."""
        return _combine_steadiness(self.columns(key, shape), self.lean)


@dataclass(frozen=True)
class SensorErrors:
    """What a sensor showed: readings that were foretold (samples,), and errors over their variances (samples,)."""

    problem: Problem
    foretold: Array
    lean: Array

    def steady(self, key: str, shape: Mapping[str, float]) -> float:
        """Return by how many standard errors a bend of a shape goes with the errors, all amplitudes together."""
        term, slots = find_term(self.problem, key)
        bends = []
        for one in (s for s in slots if s.param.null is not None):
            p = tuple(shape.get(s.key, compute_size(s.param, self.problem.scales) * (s is one)) for s in slots)
            assert isinstance(term, SensorTerm)  # noqa: S101
            bends.append(term.bent(self.foretold, p) - self.foretold)
        return _combine_steadiness(np.stack(bends, axis=1), self.lean)


def _make_sensor_errors(problem: Problem, theta: Array, key: str) -> SensorErrors:
    """Return what the sensor of a term showed."""
    observation, seen = problem.observations[0], problem.innovations(theta)
    width = len(observation.sensors)
    sensor = next(i for i, s in enumerate(observation.sensors) if s.place == find_term(problem, key)[0].at)
    errors, variances = (row.reshape(-1, width)[:, sensor] for row in (seen.errors, seen.variances))
    readings = observation.readings[:, sensor]
    kept = np.isfinite(readings)
    return SensorErrors(problem, (readings - errors)[kept], (errors / variances)[kept])


def _combine_steadiness(laws: Array, lean: Array) -> float:
    """Return by how many standard errors laws (samples, amplitudes) go with a gradient, all of them together."""
    edges = np.linspace(0, len(lean), BLOCKS + 1).astype(int)[:-1]
    return math.sqrt(sum(_compute_steadiness(law, lean, edges) ** 2 for law in laws.T))


def _compute_steadiness(law: Array, lean: Array, edges: NDArray[np.intp]) -> float:
    """Return by how many standard errors a law goes with a gradient, from its mean over parts of the recording."""
    if not np.all(np.isfinite(law)):
        return 0.0
    parts = np.add.reduceat((law - law.mean()) * lean, edges)
    error = float(parts.std(ddof=1)) / math.sqrt(BLOCKS)
    return float(parts.mean()) / error if error > 0.0 else 0.0


def scan_shapes(fit: Fit, *, forces: bool = True) -> dict[str, list[dict[str, float]]]:
    """Return for each law without states the shape to which the recording leans, where there is one that is clear.

    Without `forces` only sensors are looked at: what bends them passes for noise, and leaves no random force.
    """
    keys, whole = list_scannable(fit.problem), fit.problem.observations[0]
    keys = [key for key in keys if forces or key in fit.problem.system.bending_terms]
    if not keys:
        return {}
    problem = choose_steps(fit.problem, fit.theta).on((whole.part(0, min(whole.samples, MOST_SAMPLES)),))
    states, lean = smooth_expected_force(problem, fit.theta)
    track = SmoothedMotion(
        problem, fit.theta, np.ascontiguousarray(states[:, : len(problem.system.model.states)]), lean
    )
    slopes, found = None, {}
    for key in keys:
        of_sensor = find_term(problem, key)[0].acts == "sensor"
        if best := _select_best_shape(_make_sensor_errors(problem, fit.theta, key) if of_sensor else track, key):
            slopes = slopes or compute_slopes(fit)
            hint = run_score_test(fit, slopes, key, [best])
            if hint.gain > fit.problem.settings.select.shape_gain and best.items() <= hint.start.items():
                found[key] = [best]
    return found


def list_scannable(problem: Problem) -> list[str]:
    """Return the keys of forces without states, and of bends of sensors, that have a free shape and are not at work."""
    idle = [(key, find_term(problem, key)[0]) for key in problem.system.keys if key not in problem.active]
    plain = [key for key, term in idle if term.acts == "motion" and not term.states]
    return [key for key in (*plain, *problem.system.bending_terms) if _list_free_shapes(problem, key)]


def _list_free_shapes(problem: Problem, key: str) -> list[Slot]:
    return [s for s in sort_slots(problem, key)[1] if s.param.scale == "log" and not s.param.choices]


def _select_best_shape(track: SmoothedMotion | SensorErrors, key: str) -> dict[str, float] | None:
    """Return the shape that goes with the gradient best, and better than the usual ones, or None."""
    problem = track.problem
    usual = {s.key: list_tried_values(s.param, problem.scales) for s in sort_slots(problem, key)[1]}

    def steadiest(tried: list[dict[str, float]]) -> tuple[float, dict[str, float]]:
        return max(((track.steady(key, shape), shape) for shape in tried), key=lambda pair: pair[0])

    top, best = steadiest(list_shapes(problem, key))
    return (
        best
        if top > max(problem.settings.select.shape_steady, steadiest(_list_star_shapes(problem, key, usual))[0])
        else None
    )


def list_shapes(problem: Problem, key: str) -> list[dict[str, float]]:
    """Return the shapes of a law that are looked at: each free one over its range, the others in the middle."""
    return _list_star_shapes(problem, key, {s.key: _make_grid(s, problem) for s in _list_free_shapes(problem, key)})


def _list_star_shapes(
    problem: Problem, key: str, grids: Mapping[str, Array | tuple[float, ...]]
) -> list[dict[str, float]]:
    """Return shapes with one of them over its grid while the others stay in the middle, each choice with each."""
    shapes = sort_slots(problem, key)[1]
    usual = {s.key: list_tried_values(s.param, problem.scales) for s in shapes}
    middle = {name: grid[len(grid) // 2] for name, grid in usual.items()}
    tried = [{**middle, name: float(value)} for name, grid in grids.items() for value in grid]
    for s in shapes:
        if s.param.choices:
            tried += [{**shape, s.key: value} for shape in tried for value in s.param.choices]
    return tried


def _make_grid(slot: Slot, problem: Problem) -> Array:
    """Return the values of a shape that are looked at."""
    low, high = slot.param.scan or (math.exp(-REACH), math.exp(REACH))
    count = max(round(math.log(high / low) / APART), FEWEST)
    return np.asarray(compute_size(slot.param, problem.scales) * np.geomspace(low, high, count))
