"""What a diagnosis measures of attractors: energy distances between sections, and correlation dimensions."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array, Series
from lostmotion.diagnosis.compared_motions import take_section
from lostmotion.errors import LostMotionError
from lostmotion.registry import Registry
from lostmotion.results import Estimate
from lostmotion.results.behaviour import DimensionInterval, Distance
from lostmotion.subjects import Attractors, Motions
from lostmotion_chaos.analysis.embed import embed
from lostmotion_chaos.analysis.period import find_return
from lostmotion_chaos.analysis.quantify import quantify
from lostmotion_chaos.defaults import DIMENSION, EMBEDDER
from lostmotion_chaos.signals.distances import distances, energy_distance, same_chance
from lostmotion_chaos.signals.series import checked

PHASES = 4
"""Phases of the drive at which sections are taken."""
MOST, FEWEST = 400, 16
"""The largest number of points of a section that are compared, and the smallest that is sufficient."""


PAIRS = 250_000
"""Pairs of points for a dimension; 20,000 samples take a few tenths of a second."""
LONGEST = 50_000
"""A dimension is estimated from at most this number of samples, those at the beginning."""
FEWEST_PERIODS = 50
PERIODIC = "The motion is periodic: its orbit is a closed curve, and no dimension is estimated."


def measure_attractors(motions: Motions, registry: Registry, rng: np.random.Generator) -> Attractors:
    """Return distances and dimensions of the motions of a diagnosis; methods are plugins of `registry`."""
    distances, stroboscopic = measure_distances(motions, rng)
    return Attractors(distances, _estimate_dimensions(motions, DimensionEstimator(registry, rng)), stroboscopic)


def measure_distances(motions: Motions, rng: np.random.Generator) -> tuple[dict[str, Distance], bool]:
    """Return the distance of the section of each model from the recorded one, and whether sections are stroboscopic.

    "noise_floor" is the distance between the halves of the recorded section. Without a periodic drive, the points are
    samples of the whole orbit.
    """
    recorded = motions.states["recorded"]
    spacing = motions.period or max(len(recorded) / MOST, 1.0)
    scale = recorded[:, :2].std(axis=0)
    clouds = {name: _take_sections(states, spacing) / scale for name, states in motions.states.items()}
    table = distances(clouds["recorded"])
    both = _split_halves(table.shape[0], 0)
    enough = table.shape[0] >= FEWEST
    floor = Distance(energy_distance(table, *both), same_chance(table, len(both[0]), rng)) if enough else _TOO_SHORT
    found = {name: _measure_distance(clouds["recorded"], c, rng) for name, c in clouds.items() if name != "recorded"}
    return {**found, "noise_floor": floor}, motions.period is not None


_TOO_SHORT = Distance(math.nan, math.nan, "too_short")


def _take_sections(states: Array, spacing: float) -> Array:
    """Return position and velocity (looks, points, 2) at several phases, thinned evenly."""
    looks = [take_section(states, spacing, k / PHASES) for k in range(PHASES)]
    shortest = min(len(look) for look in looks)
    kept = slice(0, shortest, max(1, math.ceil(shortest / MOST)))
    return np.stack([look[:shortest][kept] for look in looks])


def _split_halves(n: int, begin: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the indices of the two halves of `n` points that begin at an index."""
    return np.arange(begin, begin + n // 2), np.arange(begin + n // 2, begin + n)


def _measure_distance(recorded: Array, model: Array, rng: np.random.Generator) -> Distance:
    """Return the distance between two clouds (looks, points, 2); halves are compared with halves, as in the floor."""
    if not np.all(np.isfinite(model)):
        return Distance(math.nan, math.nan, "diverged")
    n = recorded.shape[1]
    if n < FEWEST:
        return _TOO_SHORT
    table = distances(np.concatenate([recorded, model], axis=1))
    pairs = [(a, b) for a in _split_halves(n, 0) for b in _split_halves(model.shape[1], n)]
    value = float(np.mean([energy_distance(table, a, b) for a, b in pairs]))
    return Distance(value, same_chance(table, n, rng))


def _estimate_dimensions(motions: Motions, meter: DimensionEstimator) -> dict[str, DimensionInterval]:
    """Return the correlation dimensions of the recording and of free runs of the models, with the same embedding."""
    seconds = motions.period * motions.dt if motions.period else None
    shown = motions.responses["recorded"][:LONGEST]
    finite = shown[np.isfinite(shown)]
    try:
        recorded = embed(finite, meter.registry.make("embedder", EMBEDDER), dt=motions.dt, period=seconds)
    except LostMotionError as err:
        return dict.fromkeys(motions.responses, _make_dimension(Estimate.refused("failed", str(err))))
    noise = motions.noise / max(float(np.std(finite)), 1e-300)
    found = {"recorded": meter.estimate(recorded, noise)}
    for name, exponent in motions.exponents.items():
        if not exponent > 0.0:
            found[name] = Estimate.refused("regular", "The model is not chaotic: no dimension is estimated.")
            continue
        found[name] = meter.estimate_run(motions.responses[name][:LONGEST], recorded)
    return {name: _make_dimension(estimate) for name, estimate in found.items()}


def _make_dimension(estimate: Estimate) -> DimensionInterval:
    return DimensionInterval(estimate.value, estimate.low, estimate.high, estimate.status, estimate.says)


@dataclass(frozen=True)
class DimensionEstimator:
    """Estimates correlation dimensions, with the plugins of `registry`, unless a motion repeats."""

    registry: Registry
    rng: np.random.Generator

    def estimate(self, series: Series, noise: float) -> Estimate:
        """Return the dimension of a series with noise (share of its deviation); a refusal if the series is periodic."""
        if series.period and series.n * series.dt < FEWEST_PERIODS * series.period:
            return Estimate.refused(
                "too_short", f"Fewer than {FEWEST_PERIODS} drive periods are too few for a dimension."
            )
        if series.period and find_return(series, series.period, noise)[0]:
            return Estimate.refused("regular", PERIODIC)
        return quantify(series, self.registry.make("quantifier", DIMENSION, pairs=PAIRS), rng=self.rng)

    def estimate_run(self, x: Array, recorded: Series) -> Estimate:
        """Return the dimension of a free run (samples,), embedded like the `recorded` series."""
        if not np.isfinite(x).all():
            return Estimate.refused("diverged", "The free run diverges.")
        try:
            return self.estimate(replace(recorded, x=checked(x)), 0.0)
        except LostMotionError as err:
            return Estimate.refused("failed", str(err))
