"""Single readings that are wrong: a filter tells them from sudden forces by the readings that follow.

An additive outlier changes one reading, an innovation outlier changes the motion from there on (Fox, J. R. Statist.
Soc. B 34 (1972) 350-363; Chang, Tiao, Chen, Technometrics 30 (1988) 193-204). Both begin with a one-step error that is
too large. Without the reading, the next ones are predicted as usual if it was wrong, and worse if the machine was hit.
A normal likelihood takes outliers for a random force or for more noise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, maximise
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior

FAR = 5.0
"""A one-step error of so many standard deviations begins an outlier: one of 2 million normal errors is as large."""
AFTER = 5
"""The number of samples that must be predicted as usual without the reading."""
USUAL, CHANCE = 0.99, 1.0
"""The quantile up to which the sum of their squared errors is as usual, and by how much it may be larger by chance than
with the reading: after a hit it is much larger."""
ROUNDS = 6
"""The largest number of searches; each fit without outliers knows the noise better, and shows smaller ones."""
RARE = 0.03
"""With a larger share of such readings they are no outliers: the model is wrong for them."""


def leave_out_outliers(nominal: Fit, observations: Sequence[Observation]) -> tuple[Fit, tuple[Observation, ...]]:
    """Return fit and recordings without the readings that are outliers; unchanged where there are none or too many."""
    fit, kept = nominal, tuple(observations)
    for _ in range(ROUNDS):
        wrong = [find_outliers(fit.posterior.on((one,)), fit.theta) for one in kept]
        if not any(mask.any() for mask in wrong):
            break
        kept = tuple(drop_readings(one, mask) for one, mask in zip(kept, wrong, strict=True))
        whole = {one.name: one for one in kept}
        parts = tuple(whole[part.name].cut_again(part) for part in fit.posterior.observations)
        again = maximise(fit.posterior.on(parts), fit.theta)
        if again.status == "diverged":
            return nominal, tuple(observations)
        fit = again
    many = sum(one.outliers for one in kept) > RARE * sum(one.readings.size for one in kept)
    return (nominal, tuple(observations)) if many else (fit, kept)


def find_outliers(posterior: Posterior, theta: Array) -> NDArray[np.bool_]:
    """Return which readings (samples, sensors) of one recording are outliers at some coordinates (n,) of its model."""
    observation = posterior.observations[0]
    shape, none = observation.readings.shape, np.zeros(observation.readings.shape, dtype=bool)
    errors, finite = _standardise(posterior, theta, shape)
    first = (np.abs(errors) > FAR) & _is_calm_before(np.abs(errors) > FAR)
    if not finite or not first.any():
        return none
    without, finite = _standardise(posterior.on((drop_readings(observation, first),)), theta, shape)
    if not finite:
        return none
    before, after = _sum_after(errors**2), _sum_after(without**2)
    read = _sum_after((np.isfinite(observation.readings) & ~first).astype(float))
    usual = after < chi2.ppf(USUAL, np.maximum(read, 1.0))
    return np.asarray(first & (usual & (after < before + CHANCE) & (read >= AFTER))[:, None])


def drop_readings(observation: Observation, wrong: NDArray[np.bool_]) -> Observation:
    """Return a recording without some of its readings (samples, sensors), which count as outliers."""
    readings = np.where(wrong, np.nan, observation.readings)
    return replace(observation, readings=readings, outliers=observation.outliers + int(wrong.sum()))


def _standardise(posterior: Posterior, theta: Array, shape: tuple[int, ...]) -> tuple[Array, bool]:
    """Return one-step errors (samples, sensors) over their standard deviations, and whether the filter converged."""
    seen = posterior.innovations(theta)
    with np.errstate(invalid="ignore"):
        return np.asarray(seen.errors / np.sqrt(seen.variances)).reshape(shape), bool(seen.finite)


def _is_calm_before(far: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return where none of the `AFTER` samples before is far, (samples, 1), of marks (samples, sensors)."""
    any_far = far.any(axis=1).astype(float)
    count = np.append(0.0, np.convolve(any_far, np.ones(AFTER))[: len(any_far) - 1])
    return np.asarray(count == 0.0)[:, None]


def _sum_after(values: Array) -> Array:
    """Return the sums (samples,) of values (samples, sensors) over the `AFTER` samples after each one."""
    total = np.append(np.cumsum(values.sum(axis=1)), np.full(AFTER, np.nan))
    total[np.isnan(total)] = np.nansum(values)
    return np.asarray(total[AFTER:] - total[: len(values)])
