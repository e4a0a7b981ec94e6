"""Sections of the recorded motion and of free runs of both models, and the energy distances between them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.diagnosis.search import SearchResult
from lostmotion.inference.fit import Fit
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import filter_recording, simulate_run
from lostmotion.signals.distances import distances, energy_distance, same_chance

PHASES = 4
"""Phases of the drive at which sections are taken."""
MOST, FEWEST = 400, 16
"""The largest number of points of a section that are compared, and the smallest that is sufficient."""


@dataclass(frozen=True)
class SectionDistance:
    """Energy distance between two sections, in standard deviations of the motion, and its p-value.

    `status` is one of `results.STATUSES`; where it is not "ok" both numbers are NaN.
    """

    value: float
    chance: float
    status: str = "ok"


def list_motions(d: SearchResult) -> dict[str, Array]:
    """Return the states (samples, n) of the recording, smoothed, and of a free run of each model, by name."""
    runs = {"recorded": (d.left or d.located).missing.states, "before": _run_freely(d.before, d.shown)}
    if d.found:
        runs["after"] = _run_freely(d.after, d.shown)
    return runs


def _run_freely(fit: Fit, observation: Observation) -> Array:
    """Return the states (samples, n) of a free run over a whole recording, from its first filtered state."""
    problem = fit.problem.on((observation,))
    first = min(20, observation.samples - 1)
    states = filter_recording(problem, fit.theta).states
    run = simulate_run(problem, fit.theta, states[first], first, observation.samples - first)
    return np.vstack([states[:first], run])


def take_section(states: Array, period: float, phase: float = 0.0) -> Array:
    """Return position and velocity (points, 2) once each `period` (samples) at a `phase` of it, interpolated."""
    at = np.arange(phase * period, len(states) - 1, period)
    grid = np.arange(len(states))
    return np.stack([np.interp(at, grid, states[:, i]) for i in (0, 1)], axis=1)


def measure_distances(
    motions: Mapping[str, Array], observation: Observation, rng: np.random.Generator
) -> tuple[dict[str, SectionDistance], bool]:
    """Return the distance of the section of each model from the recorded one, and whether sections are stroboscopic.

    "noise_floor" is the distance between the halves of the recorded section. Without a periodic drive, the points are
    samples of the whole orbit.
    """
    period = observation.period
    spacing = period or max(observation.samples / MOST, 1.0)
    recorded = motions["recorded"]
    scale = recorded[:, :2].std(axis=0)
    clouds = {name: _take_sections(states, spacing) / scale for name, states in motions.items()}
    table = distances(clouds["recorded"])
    both = _split_halves(table.shape[0], 0)
    enough = table.shape[0] >= FEWEST
    floor = (
        SectionDistance(energy_distance(table, *both), same_chance(table, len(both[0]), rng)) if enough else _TOO_SHORT
    )
    found = {name: _measure_distance(clouds["recorded"], c, rng) for name, c in clouds.items() if name != "recorded"}
    return {**found, "noise_floor": floor}, period is not None


_TOO_SHORT = SectionDistance(math.nan, math.nan, "too_short")


def _take_sections(states: Array, spacing: float) -> Array:
    """Return position and velocity (looks, points, 2) at several phases, thinned evenly."""
    looks = [take_section(states, spacing, k / PHASES) for k in range(PHASES)]
    shortest = min(len(look) for look in looks)
    kept = slice(0, shortest, max(1, math.ceil(shortest / MOST)))
    return np.stack([look[:shortest][kept] for look in looks])


def _split_halves(n: int, begin: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the indices of the two halves of `n` points that begin at an index."""
    return np.arange(begin, begin + n // 2), np.arange(begin + n // 2, begin + n)


def _measure_distance(recorded: Array, model: Array, rng: np.random.Generator) -> SectionDistance:
    """Return the distance between two clouds (looks, points, 2); halves are compared with halves, as in the floor."""
    if not np.all(np.isfinite(model)):
        return SectionDistance(math.nan, math.nan, "diverged")
    n = recorded.shape[1]
    if n < FEWEST:
        return _TOO_SHORT
    table = distances(np.concatenate([recorded, model], axis=1))
    pairs = [(a, b) for a in _split_halves(n, 0) for b in _split_halves(model.shape[1], n)]
    value = float(np.mean([energy_distance(table, a, b) for a, b in pairs]))
    return SectionDistance(value, same_chance(table, n, rng))
