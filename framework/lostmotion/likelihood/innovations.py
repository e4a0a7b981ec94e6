"""The one-step errors of a filter at many points, and the states that it smooths at one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array

RUNAWAY = 1e12
"""A filter has diverged where the rms of its standardised innovations exceeds this. Its errors and their differences
are then meaningless, and the squares of their derivatives overflow."""


@dataclass(frozen=True)
class Innovations:
    """One-step errors and their variances, and which points were filtered over all samples without divergence.

    From a filter both are (points, samples, sensors) and `finite` is (points,); where nothing was read the error is 0
    and the variance 1 / (2 pi), which adds nothing. `reached` counts the samples that were computed.
    """

    errors: Array
    variances: Array
    finite: NDArray[np.bool_]
    reached: NDArray[np.int64] | None = None

    @classmethod
    def of(cls, errors: Array, variances: Array, reached: NDArray[np.int64]) -> Innovations:
        """Return the innovations of a filter that computed `reached` samples at each point."""
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            kept = np.sum(errors * errors / variances, axis=(1, 2)) <= RUNAWAY**2 * errors.shape[1]
        return cls(errors, variances, (reached == errors.shape[1]) & kept, reached)

    @property
    def log_likelihood(self) -> Any:
        """The log-likelihood from the innovations, (points,) or one number; minus infinity after a divergence."""
        axes = tuple(range(np.ndim(self.finite), self.errors.ndim))
        with np.errstate(all="ignore"):
            told = -0.5 * np.sum(self.errors**2 / self.variances + np.log(2.0 * np.pi * self.variances), axis=axes)
        found = np.where(self.finite & np.isfinite(told), told, -math.inf)
        return found if found.ndim else float(found)

    def realign(self, late: Sequence[int]) -> Innovations:
        """Return the innovations in the order of the readings, where those of sensor i came `late[i]` samples early."""
        errors, variances = self.errors.copy(), self.variances.copy()
        for sensor, lag in enumerate(late):
            errors[..., sensor] = np.roll(errors[..., sensor], lag, axis=1)
            variances[..., sensor] = np.roll(variances[..., sensor], lag, axis=1)
        return replace(self, errors=errors, variances=variances)

    def __getitem__(self, point: Any) -> Innovations:
        return Innovations(self.errors[point], self.variances[point], self.finite[point])

    def __len__(self) -> int:
        return len(self.errors)


@dataclass(frozen=True)
class Smoothed:
    """The filtered and smoothed states (samples, n) of one point, with their covariances (samples, n, n).

    The random forces that are states come after the states of model and terms.
    """

    filtered: Array
    filtered_covariance: Array
    states: Array
    covariance: Array
    innovations: Innovations


def join_innovations(parts: Sequence[Innovations]) -> Innovations:
    """Return the innovations of all parts, one after the other."""
    errors, variances, finite = (
        np.concatenate([getattr(p, name) for p in parts]) for name in ("errors", "variances", "finite")
    )
    return Innovations(errors, variances, finite)


def join_recordings(parts: Sequence[Innovations]) -> Innovations:
    """Return the innovations (points, readings) of several recordings in a row."""
    errors, variances = (
        [getattr(part, name).reshape(len(part), -1) for part in parts] for name in ("errors", "variances")
    )
    finite = np.all([part.finite for part in parts], axis=0)
    if len(parts) == 1:
        return Innovations(errors[0], variances[0], finite)
    return Innovations(np.concatenate(errors, axis=1), np.concatenate(variances, axis=1), finite)
