"""Derivatives of the one-step errors over the free parameters: by differences, and by the linearised filter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.tangents import Tangents, linearise_recordings

MANY = 20
"""Beyond this number of parameters derivatives dominate the cost: they are reused while steps along them gain."""


@dataclass(frozen=True)
class Sensitivity:
    """The innovations at a point, and the derivatives (parameters, samples) of errors and variances there."""

    theta: Array
    here: Innovations
    errors: Array
    variances: Array
    steps: Array

    def gradient(self) -> Array:
        """Return the gradient of the log-likelihood."""
        e, v = self.here.errors, self.here.variances
        return np.asarray(self.errors @ (-e / v) + self.variances @ (0.5 * (e * e / v - 1.0) / v))

    def scores(self) -> Array:
        """Return the score of each sample: its contribution to the gradient, (parameters, samples)."""
        e, v = self.here.errors, self.here.variances
        return np.asarray(self.errors * (-e / v) + self.variances * (0.5 * (e * e / v - 1.0) / v))

    def information(self) -> Array:
        """Return the expected information of the log-likelihood."""
        v = self.here.variances
        return np.asarray((self.errors / v) @ self.errors.T + 0.5 * (self.variances / v**2) @ self.variances.T)


def make_stencil(posterior: Posterior, theta: Array, steps: Array) -> tuple[Array, Array]:
    """Return coordinates above and below `theta`, (n,) each: equal to it where one side is enough or a bound is met.

    Differences are central, except for coordinates in which the innovations are linear.
    """
    space = posterior.space
    straight = np.array([f.linear for f in posterior.space.free], dtype=bool)
    return np.minimum(theta + steps, space.high), np.where(straight, theta, np.maximum(theta - steps, space.low))


def list_stencil_points(theta: Array, up: Array, down: Array) -> Array:
    """Return the points (count, n) of a stencil: the centre, and those above and below that differ from it."""
    above, below = (theta + np.diag(side - theta) for side in (up, down))
    return np.vstack([theta[None], above[up != theta], below[down != theta]])


def compute_sensitivity(posterior: Posterior, theta: Array, steps: Array) -> Sensitivity:
    """Return innovations and their derivatives at `theta`, by differences within the bounds.

    With many coordinates, those over the coefficients of curves come from the linearised filter, where it exists.
    """
    up, down = make_stencil(posterior, theta, steps)
    straight = [i for i, f in enumerate(posterior.space.free) if f.linear and f.recording is None]
    filtered = linearise_recordings(posterior, theta) if straight and len(theta) > MANY else []
    if filtered:
        up[straight] = down[straight] = theta[straight]
    seen = posterior.innovations(list_stencil_points(theta, up, down))
    found = compute_differences(theta, (up, down), seen, steps)
    if filtered:
        found.errors[straight] = np.concatenate([_respond(one, straight, steps) for one in filtered], axis=1)
    return found


def _respond(filtered: Tangents, rows: Sequence[int], steps: Array) -> Array:
    """Return the derivatives (rows, readings) of the errors of one recording over some coefficients of active laws."""
    posterior, fulls = filtered.posterior, np.tile(filtered.full, (len(rows), 1))
    places = [posterior.system.index[posterior.space.free[i].parameter] for i in rows]
    fulls[np.arange(len(rows)), places] += steps[rows]
    return filtered.respond_to_laws(fulls, posterior.active, steps[rows])


def compute_differences(theta: Array, ends: tuple[Array, Array], seen: Innovations, steps: Array) -> Sensitivity:
    """Return the derivatives from the innovations `seen` at the points of a stencil.

    Where the filter diverges on one side, the difference is one-sided.
    """
    up, down = ends
    above, below, count = (*np.zeros((2, len(theta)), dtype=np.intp), 1 + np.count_nonzero(up != theta))
    above[up != theta], below[down != theta] = np.arange(1, count), np.arange(count, len(seen))
    above, below = (np.where(seen.finite[rows], rows, 0) for rows in (above, below))
    widths = np.where(above > 0, up, theta) - np.where(below > 0, down, theta)
    safe = np.where(widths > 0, widths, 1.0)[:, None]
    de = (seen.errors[above] - seen.errors[below]) / safe
    dv = (seen.variances[above] - seen.variances[below]) / safe
    return Sensitivity(theta, seen[0], de, dv, steps)
