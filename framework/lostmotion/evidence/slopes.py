"""Derivatives of the one-step errors of a recording over smooth forces."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lostmotion.contracts import Array, place_of
from lostmotion.inference.curves import compute_coefficient_size
from lostmotion.inference.learned import LearnedTerm, OverPhase, OverPosition, OverTime
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.system import key_of
from lostmotion.likelihood.tangents import Tangents

PROBE = 1e-3
"""The force, in units of the drive, with which the effect of a unit force is measured."""


def list_force_slopes(filtered: Tangents, forces: Sequence[tuple[str, int]]) -> list[Array]:
    """Return the derivatives (count, readings) of errors over the coefficients of curves, given by key and count."""
    found, directions = [], dict[str, tuple[Array, Array]]()
    posterior = filtered.posterior
    for key, count in forces:
        term = find_term(posterior, key)[0]
        if not isinstance(term, LearnedTerm):
            raise TypeError(f"{key} is no learned curve")
        if term.at not in directions:
            directions[term.at] = _measure_direction(filtered, term.at)
        rates, channels = directions[term.at]
        waves = term.basis(_find_places(filtered, key, term))[:, :count].T
        found.append(filtered.respond_to_forces(waves[:, :, None] * rates, waves[:, :, None] * channels))
    return found


def _measure_direction(filtered: Tangents, at: str) -> tuple[Array, Array]:
    """Return what a unit force at a place changes: derivatives of states (samples, n) and channels (samples, channels).

    The probe is the first wave of a curve over position there, which is nowhere zero.
    """
    posterior = filtered.posterior
    key = key_of(OverPosition(at=at))
    term = find_term(posterior, key)[0]
    index, full = posterior.system.index[f"{key}.v0"], filtered.full.copy()
    if key not in posterior.active:
        for i in range(term.count):  # type: ignore[attr-defined]
            full[posterior.system.index[f"{key}.v{i}"]] = 0.0
    base = filtered.compute_effects(full[None], posterior.active | {key})
    size = PROBE * compute_coefficient_size(term, posterior)  # type: ignore[arg-type]
    full[index] += size
    rates, channels = filtered.compute_effects(full[None], posterior.active | {key})
    wave = term.basis(_find_places(filtered, key, term))[:, 0]  # type: ignore[attr-defined,arg-type]
    force = size * wave[:, None]
    return (rates[0] - base[0][0]) / force, (channels[0] - base[1][0]) / force


def _find_places(filtered: Tangents, key: str, term: LearnedTerm) -> Array:
    """Return where a recording is in the range of a curve (samples,), in half widths from its middle."""
    observation, posterior = filtered.observation, filtered.posterior
    if isinstance(term, OverPhase):
        return np.asarray(np.mod(observation.time * observation.harmonic.omega / math.pi, 2.0))
    middle, half = (float(filtered.full[posterior.system.index[f"{key}.{name}"]]) for name in ("middle", "half"))
    if isinstance(term, OverTime):
        return np.clip((observation.time - middle) / half, -1.0, 1.0)
    motion = filtered.move(place_of(posterior.system.model, term))
    return np.asarray((motion[int(term.over == "velocity")] - middle) / half)
