"""The share of a force that a covariate explains: cross-validated smooth fits, compared with surrogates of the force.

A latent force that was smoothed out of noise is smooth itself, and some curve always fits it a little. So each share is
compared with noise of the same spectrum, which depends on nothing (Theiler et al., Physica D 58 (1992) 77-94). Lines
are first smoothed out of that spectrum: what repeats with the drive is structure, and random phases alone would not
remove it.

Many covariates are tested at once. The p-value of each is adjusted for all of them by the maximum statistic (Westfall,
Young, Resampling-based multiple testing (1993)): the share of surrogates whose largest standardised share, over all
covariates, is at least as large. So the level can be attained with any number of covariates, and correlated covariates
cost less than independent ones.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse
from scipy.ndimage import median_filter

from lostmotion.contracts import Array
from lostmotion.settings import DEFAULT

FOLDS = 5
BLOCKS = 20
SURROGATES = 199
ENOUGH = 5000
"""Longer series are thinned: every second sample is fitted, or every third, and so on."""
PIECES = (6, 12, 24, 48)
"""The numbers of pieces of a smooth fit; the one that predicts best is taken, for surrogates as well."""
RIDGE = 1.0
WINDOW = 31

Basis = Any
"""Functions (samples, functions) as a sparse matrix: most of them are zero at any sample."""


@dataclass(frozen=True)
class Share:
    """The share of the variance that a covariate predicts, and its standard error over the folds.

    `excess` is its distance from the mean of the surrogates in their standard deviations; `p` is its p-value, adjusted
    for all covariates that were tested.
    """

    value: float
    error: float
    p: float
    excess: float = 0.0


@dataclass(frozen=True)
class Covariate:
    """A covariate of a force: `columns` (k, samples) enter a smooth fit as a sum, or as classes.

    Only the contribution of the last column beyond the others counts.
    """

    columns: tuple[Array, ...]
    classes: bool = False


def randomise_phases(force: Array, draws: int, rng: np.random.Generator) -> Array:
    """Return noise (draws, samples) with the spectrum of a force (samples,), with lines smoothed out of it."""
    n = len(force)
    power = np.abs(np.fft.rfft(force - np.mean(force))) ** 2
    window = min(WINDOW, max(3, len(power) // 8))
    level = median_filter(power[1:], window, mode="reflect") / math.log(2.0)
    shape = (draws, len(power))
    coefficients = rng.standard_normal(shape) + 1j * rng.standard_normal(shape)
    coefficients *= np.sqrt(0.5 * np.concatenate([[0.0], level]))
    return np.asarray(np.fft.irfft(coefficients, n, axis=1))


def compute_shares(
    table: Mapping[str, Covariate], force: Array, rng: np.random.Generator | None, *, draws: int = SURROGATES
) -> dict[str, Share]:
    """Return the share of a force (samples,) that each covariate predicts; p is NaN without an `rng`."""
    if not np.any(force - np.mean(force)):
        return {name: Share(0.0, 0.0, 1.0) for name in table}
    surrogates = np.empty((0, len(force))) if rng is None else randomise_phases(force, draws, rng)
    step = -(-len(force) // ENOUGH)
    folded = _Folded.of(np.vstack([force, surrogates])[:, ::step].T)
    told = [_predict_share(covariate, folded, step) for covariate in table.values()]
    values = np.array([value for value, _ in told])
    excess, p = adjust_p_values(values) if rng is not None else (np.full(len(told), math.nan),) * 2
    shares = zip(values[:, 0], [error for _, error in told], p, excess, strict=True)
    rows = [Share(round(max(float(v), 0.0), 4), round(e, 4), float(one), round(float(z), 3)) for v, e, one, z in shares]
    return dict(zip(table, rows, strict=True))


def adjust_p_values(values: Array) -> tuple[Array, Array]:
    """Return the excess (tests,) of a statistic over its surrogates, in their standard deviations, and its p-value.

    `values` (tests, 1 + surrogates) begin with the observed value. Mean and standard deviation are those of all
    columns, so that under the null hypothesis each column is as likely to be the observed one. The p-values (tests,)
    are those of the largest excess over all tests (Westfall and Young 1993, single step): 5 % of them are below 0.05
    when all null hypotheses are true, for any number of tests and any correlation between them.
    """
    spread = np.std(values, axis=1, keepdims=True)
    excess = (values - np.mean(values, axis=1, keepdims=True)) / np.where(spread > 0.0, spread, math.inf)
    largest = np.max(excess[:, 1:], axis=0, initial=-math.inf)
    p = (1.0 + np.sum(largest[None, :] >= excess[:, :1], axis=1)) / (1.0 + len(largest))
    return excess[:, 0], p


def list_significant(found: Mapping[str, Share], level: float = DEFAULT.locate.level) -> list[str]:
    """Return the covariates with significant shares, largest first; p is adjusted for all of them."""
    names = [name for name, share in found.items() if share.p <= level and share.value > 0.0]
    return sorted(names, key=lambda name: -found[name].value)


@dataclass(frozen=True)
class _Folded:
    """Forces (samples, forces) cut into folds: which samples each fold has, the forces there, and their squares.

    The folds are made of contiguous blocks of time, so that a slow force does not explain itself.
    """

    rows: tuple[Any, ...]
    forces: tuple[Array, ...]
    squares: Array

    @staticmethod
    def of(forces: Array) -> _Folded:
        """Return forces (samples, forces) in folds."""
        fold = (np.arange(len(forces)) * BLOCKS // len(forces)) % FOLDS
        rows = tuple(np.flatnonzero(fold == f) for f in range(FOLDS))
        parts = tuple(forces[r] for r in rows)
        return _Folded(rows, parts, np.array([np.sum(part**2, axis=0) for part in parts]))

    @cached_property
    def total(self) -> Array:
        """The squared error (folds, forces) of a constant."""
        return self.errors(sparse.csr_array(np.ones((sum(map(len, self.rows)), 1))))

    def errors(self, basis: Basis) -> Array:
        """Return the squared error (folds, forces) of each hidden fold by a fit of `basis` on the others."""
        parts = [basis[rows] for rows in self.rows]
        inner = np.array([(b.T @ b).toarray() for b in parts])
        products = np.array([b.T @ y for b, y in zip(parts, self.forces, strict=True)])
        errors = np.empty_like(self.squares)
        for f in range(FOLDS):
            left = inner.sum(axis=0) - inner[f] + RIDGE * np.eye(basis.shape[1])
            weights = np.linalg.solve(left, products.sum(axis=0) - products[f])
            errors[f] = self.squares[f] + np.sum(weights * (inner[f] @ weights - 2.0 * products[f]), axis=0)
        return errors


def _predict_share(covariate: Covariate, folded: _Folded, step: int) -> tuple[Array, float]:
    """Return the cross-validated share (forces,) of each force, and the standard error of the first."""
    columns = [c[::step] for c in covariate.columns]
    if covariate.classes:
        options = [folded.errors(_make_classes(columns[-1]))]
    else:
        options = [folded.errors(_stack_bases(columns, k)) for k in PIECES]
    without = total = folded.total
    if len(columns) > 1:
        without = np.min([folded.errors(_stack_bases(columns[:-1], k)) for k in PIECES], axis=0)
    gained = np.array([(without - option).sum(axis=0) / total.sum(axis=0) for option in options])
    best = int(np.argmax(gained[:, 0]))
    folds = (without - options[best])[:, 0] / np.maximum(total[:, 0], 1e-300)
    return gained.max(axis=0), float(np.std(folds, ddof=1) / math.sqrt(FOLDS))


def _stack_bases(columns: Sequence[Array], pieces: int) -> Basis:
    return sparse.csr_array(sparse.hstack([_make_hats(c, pieces) for c in columns]))


def _make_hats(values: Array, pieces: int) -> Basis:
    """Return hat functions (samples, pieces + 1) of even spacing over the middle 99 % of the values."""
    low, high = np.quantile(values, [0.005, 0.995])
    at = np.clip((values - low) / max(high - low, 1e-300), 0.0, 1.0) * pieces
    left = np.minimum(at.astype(int), pieces - 1)
    rows = np.arange(len(values))
    heights = np.concatenate([1.0 - (at - left), at - left])
    places = (np.concatenate([rows, rows]), np.concatenate([left, left + 1]))
    return sparse.csr_array((heights, places), shape=(len(values), pieces + 1))


def _make_classes(values: Array) -> Basis:
    """Return one column (samples, classes) for each value that occurs."""
    return sparse.csr_array(np.asarray(values[:, None] == np.unique(values)[None, :], dtype=float))
