"""How much of a force goes with a covariate: cross-validated smooth fits, held against surrogates of the force.

A latent force that was smoothed out of noise is smooth itself, and some curve always fits it a little. So each share is
held against noise of the same spectrum, which depends on nothing (Theiler et al., Physica D 58 (1992) 77-94). Lines are
first smoothed out of that spectrum: what repeats with the drive is structure, and phases alone would not undo it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import median_filter

from lostmotion.contracts import Array

FOLDS = 5
BLOCKS = 20
SURROGATES = 199
ENOUGH = 5000
"""Of longer series every second sample is fitted, or every third, and so on."""
PIECES = (6, 12, 24, 48)
"""A smooth fit has so many pieces; the number that predicts best is taken, for surrogates as well."""
RIDGE = 1.0
WINDOW = 31
LEVEL = 0.05
"""The chance that any covariate of a force of pure noise is called significant."""


@dataclass(frozen=True)
class Share:
    """The share of the variance that a covariate predicts, its standard error over the folds, and its p-value."""

    value: float
    error: float
    p: float


@dataclass(frozen=True)
class Covariate:
    """What a force may depend on: `columns` (k, samples) enter a smooth fit side by side, or as classes.

    Only what the last column adds to the others counts.
    """

    columns: tuple[Array, ...]
    classes: bool = False


def phase_randomised(force: Array, draws: int, rng: np.random.Generator) -> Array:
    """Return noise (draws, samples) with the spectrum of a force (samples,), lines smoothed out of it."""
    n = len(force)
    power = np.abs(np.fft.rfft(force - np.mean(force))) ** 2
    window = min(WINDOW, max(3, len(power) // 8))
    level = median_filter(power[1:], window, mode="reflect") / math.log(2.0)
    shape = (draws, len(power))
    coefficients = rng.standard_normal(shape) + 1j * rng.standard_normal(shape)
    coefficients *= np.sqrt(0.5 * np.concatenate([[0.0], level]))
    return np.asarray(np.fft.irfft(coefficients, n, axis=1))


def shares_of(
    table: Mapping[str, Covariate], force: Array, rng: np.random.Generator | None, *, draws: int = SURROGATES
) -> dict[str, Share]:
    """Return what each covariate predicts of a force (samples,); p is NaN without an `rng` for the surrogates."""
    if not np.any(force - np.mean(force)):
        return {name: Share(0.0, 0.0, 1.0) for name in table}
    surrogates = np.empty((0, len(force))) if rng is None else phase_randomised(force, draws, rng)
    step = -(-len(force) // ENOUGH)
    forces = np.vstack([force, surrogates])[:, ::step].T
    found = {}
    for name, covariate in table.items():
        values, error = _predicted([c[::step] for c in covariate.columns], forces, classes=covariate.classes)
        p = float("nan") if rng is None else (1.0 + np.sum(values[1:] >= values[0])) / (1.0 + draws)
        found[name] = Share(round(max(float(values[0]), 0.0), 4), round(error, 4), float(p))
    return found


def significant(found: Mapping[str, Share]) -> list[str]:
    """Return the covariates whose shares noise would not reach, largest first (Bonferroni over all covariates)."""
    names = [name for name, share in found.items() if share.p <= LEVEL / len(found) and share.value > 0.0]
    return sorted(names, key=lambda name: -found[name].value)


def _predicted(columns: Sequence[Array], forces: Array, *, classes: bool) -> tuple[Array, float]:
    """Return the cross-validated share (forces,) of each force (samples, forces), and the standard error of the first.

    The folds are contiguous blocks of time, so that a slow force does not explain itself.
    """
    if classes:
        options = [_errors(_classes(columns[-1]), forces)]
    else:
        options = [_errors(np.hstack([_hats(c, k) for c in columns]), forces) for k in PIECES]
    without = _errors(np.ones((len(forces), 1)), forces)
    if len(columns) > 1:
        rest = [_errors(np.hstack([_hats(c, k) for c in columns[:-1]]), forces) for k in PIECES]
        without = np.min(rest, axis=0)
    total = _errors(np.ones((len(forces), 1)), forces)
    gained = np.array([(without - option).sum(axis=0) / total.sum(axis=0) for option in options])
    best = int(np.argmax(gained[:, 0]))
    folds = (without - options[best])[:, 0] / np.maximum(total[:, 0], 1e-300)
    return gained.max(axis=0), float(np.std(folds, ddof=1) / math.sqrt(FOLDS))


def _errors(basis: Array, forces: Array) -> Array:
    """Return the squared error (folds, forces) of each hidden fold by a fit on the others."""
    fold = (np.arange(len(forces)) * BLOCKS // len(forces)) % FOLDS
    parts = [(basis[fold == f], forces[fold == f]) for f in range(FOLDS)]
    squares = np.array([b.T @ b for b, _ in parts])
    products = np.array([b.T @ y for b, y in parts])
    errors = np.empty((FOLDS, forces.shape[1]))
    for f, (b, y) in enumerate(parts):
        left = squares.sum(axis=0) - squares[f] + RIDGE * np.eye(basis.shape[1])
        weights = np.linalg.solve(left, products.sum(axis=0) - products[f])
        errors[f] = np.sum((y - b @ weights) ** 2, axis=0)
    return errors


def _hats(values: Array, pieces: int) -> Array:
    """Return hat functions (samples, pieces + 1) of even spacing over the middle 99 % of the values."""
    low, high = np.quantile(values, [0.005, 0.995])
    at = np.clip((values - low) / max(high - low, 1e-300), 0.0, 1.0) * pieces
    left = np.minimum(at.astype(int), pieces - 1)
    basis = np.zeros((len(values), pieces + 1))
    rows = np.arange(len(values))
    basis[rows, left], basis[rows, left + 1] = 1.0 - (at - left), at - left
    return basis


def _classes(values: Array) -> Array:
    """Return one column (samples, classes) for each value that occurs."""
    return np.asarray(values[:, None] == np.unique(values)[None, :], dtype=float)
