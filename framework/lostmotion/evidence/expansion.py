"""The linearised model: one-step errors and their derivatives with respect to named blocks of coordinates.

Around a point the log-likelihood of a filter is quadratic in everything that a model may lack, because one-step errors
are nearly linear in it. Each block of coordinates has a Gaussian prior. What a block adds to the evidence, how much two
blocks resemble each other on this recording, and how far scores scatter beyond their information then have closed forms
(Kennedy, O'Hagan, J. R. Stat. Soc. B 63 (2001) 425-464; Rasmussen, Williams, Gaussian Processes (2006), eq. 2.43).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dpotrf, dtrtrs

from lostmotion.contracts import Array
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.likelihood.innovations import Innovations

BLOCKS = 40
"""Parts of the recordings over which scores are summed."""


@dataclass(frozen=True)
class Curvature:
    """The quadratic log-likelihood around the coordinates `at` (n,), and mean and inverse variance of their priors.

    `gradient` has shape (n,) and `information` (n, n).
    """

    at: Array
    gradient: Array
    information: Array
    middle: Array
    precision: Array

    def profile(self, own: NDArray[np.intp], more: NDArray[np.intp]) -> tuple[Array, Array]:
        """Return gradient and information of the coordinates `more` at zero, with the `own` ones re-optimised.

        The prior of the own coordinates counts; that of the others does not. Shapes (count,) and (count, count).
        """
        gradient = self.gradient + self.information[:, more] @ self.at[more]
        gradient[own] -= self.precision[own] * (self.at[own] - self.middle[own])
        inner = self.information[np.ix_(own, own)] + np.diag(self.precision[own])
        cross = self.information[np.ix_(own, more)]
        pulled = solve_scaled(inner, np.column_stack([cross, gradient[own]]))
        left = self.information[np.ix_(more, more)] - cross.T @ pulled[:, :-1]
        return gradient[more] - cross.T @ pulled[:, -1], 0.5 * (left + left.T)


@dataclass(frozen=True)
class Expansion:
    """One-step errors at a point and their derivatives with respect to n coordinates, which stand in named blocks.

    `at` (n,) are the coordinates; `errors` and `variances` (n, readings) the derivatives of one-step errors and of
    their variances; `middle` and `precision` (n,) are mean and inverse variance of the Gaussian prior of each
    coordinate.
    """

    here: Innovations
    at: Array
    errors: Array
    variances: Array
    middle: Array
    precision: Array
    blocks: Mapping[str, slice]

    @cached_property
    def gradient(self) -> Array:
        """The gradient (n,) of the log-likelihood."""
        return self.score(self.here)

    def score(self, there: Innovations) -> Array:
        """Return the gradient (n,) at one-step errors of another point, where the derivatives are the same.

        It is not finite where the filter has nearly diverged.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            over_errors, over_variances = differentiate_density(there)
            return np.asarray(self.errors @ over_errors + self.variances @ over_variances)

    @cached_property
    def information(self) -> Array:
        """The expected information (n, n) of the log-likelihood; not finite where the filter has nearly diverged."""
        v = self.here.variances
        moved = np.flatnonzero(self.variances.any(axis=1))
        with np.errstate(over="ignore", invalid="ignore"):
            scaled = self.errors / np.sqrt(v)
            found = scaled @ scaled.T
            spread = self.variances[moved] / (math.sqrt(2.0) * v)
            found[np.ix_(moved, moved)] += spread @ spread.T
        return np.asarray(found)

    def list_indices(self, *names: str) -> NDArray[np.intp]:
        """Return the indices of the coordinates of some blocks."""
        parts = [np.arange(self.blocks[name].start, self.blocks[name].stop) for name in names]
        return np.concatenate(parts) if parts else np.zeros(0, dtype=np.intp)

    @cached_property
    def curvature(self) -> Curvature:
        """The quadratic log-likelihood around the point."""
        return Curvature(self.at, self.gradient, self.information, self.middle, self.precision)

    def measure_scatter(self, names: tuple[str, ...]) -> float:
        """Return the factor by which scores of some blocks, summed over time, scatter beyond their information.

        It is the median over the coordinates of the blocks, at least 1: 1 for independent one-step errors (Huber 1967;
        White, Econometrica 50 (1982) 1-25).
        """
        return self.measure_scatter_of(self.list_indices(*names))

    def measure_scatter_of(self, rows: NDArray[np.intp]) -> float:
        """Return the same for the coordinates with some indices."""
        over_errors, over_variances = differentiate_density(self.here)
        scores = self.errors[rows] * over_errors + self.variances[rows] * over_variances
        sums = np.array([part.sum(axis=1) for part in np.array_split(scores, BLOCKS, axis=1)])
        stated = np.diag(self.information)[rows]
        told = stated > 0.0
        if not told.any():
            return 1.0
        return max(1.0, float(np.median(sums.var(axis=0)[told] * BLOCKS / stated[told])))


def differentiate_density(here: Innovations) -> tuple[Array, Array]:
    """Return the derivatives (readings,) of the log-likelihood over one-step errors and over their variances."""
    e, v = here.errors.ravel(), here.variances.ravel()
    return -e / v, 0.5 * (e * e / v - 1.0) / v


def compute_cross_information(
    here: Innovations, errors: Array, variances: Array, other_errors: Array, other_variances: Array
) -> Array:
    """Return the expected information (m, n) between m and n coordinates, from derivatives (m or n, readings)."""
    v = here.variances
    found = np.asarray((errors / v) @ other_errors.T)
    if variances.any():
        found += 0.5 * (variances / v**2) @ other_variances.T
    return found


def compute_log_evidence(gradient: Array, information: Array, widths: Array) -> float:
    """Return the log evidence that normal coefficients add, from gradient (n,) and information (n, n) at zero.

    With D the prior `widths` (n,): (g'D (I + D H D)^-1 D g - log det(I + D H D)) / 2. A width of zero leaves the
    coefficient out.
    """
    used = widths > 0.0
    if not used.any():
        return 0.0
    d = widths[used]
    inner = information[np.ix_(used, used)] * d * d[:, None]
    inner.flat[:: len(d) + 1] += 1.0
    lower, failed = dpotrf(inner, lower=1)
    if failed:
        return -math.inf
    pulled = dtrtrs(lower, d * gradient[used], lower=1)[0]
    return 0.5 * float(pulled @ pulled) - float(np.sum(np.log(np.diag(lower))))
