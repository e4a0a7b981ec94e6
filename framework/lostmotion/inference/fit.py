"""Fits by Fisher scoring on the innovations, and their evidence by Laplace's method.

The expected information of a prediction-error likelihood needs first derivatives only (Schweppe 1965; Gupta, Mehra,
IEEE Trans. Automatic Control 19 (1974) 774-783), so it is positive and robust against the roughness of a filter through
a kink, unlike a finite-difference Hessian.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.inference.sensitivity import (
    MANY,
    Sensitivity,
    compute_differences,
    compute_sensitivity,
    list_stencil_points,
    make_stencil,
)
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM
from lostmotion.likelihood.tangents import Tangents, linearise_recordings

BLOCKS = 40
STRIDE = 0.3
"""Finite-difference step in conditional standard deviations: small against the posterior, large against roughness."""
REUSES = 8
STEEPEST = 4.0
"""The largest correction of the expected curvature along a step that gained less than half of the prediction."""
STEP_FACTOR = 3.0
"""Derivatives are computed again where the first finite-difference steps were wrong by more than this factor."""
DAMPINGS = (1.0, 8.0, 64.0, 512.0)
"""Steps with these multiples of the damping are tried at once."""
ROUGHLY = 0.1
"""A fit that is to be compared with others has converged when a step predicts less gain in log posterior than this."""
HOPELESS = 30.0
"""Such a fit is abandoned if it will not come closer than this to the best one in log posterior."""


@dataclass(frozen=True)
class LocalExpansion:
    """Value, gradient and expected information of the log posterior at a point, with the steps that were used."""

    theta: Array
    log_likelihood: float
    log_posterior: float
    gradient: Array
    information: Array
    steps: Array

    @property
    def covariance(self) -> Array:
        """The covariance of the normal approximation to the posterior, in coordinates."""
        return solve_scaled(self.information, np.eye(len(self.theta)))


@dataclass(frozen=True)
class Fit:
    """The maximum of a posterior: coordinates, local expansion, log evidence by Laplace's method, and a status."""

    posterior: Posterior
    local: LocalExpansion
    status: str
    rounds: int

    @property
    def theta(self) -> Array:
        """The coordinates of the maximum."""
        return self.local.theta

    @property
    def log_likelihood(self) -> float:
        """The log-likelihood at the maximum."""
        return self.local.log_likelihood

    @cached_property
    def filtered(self) -> list[Tangents]:
        """The linearised filter of each recording at the maximum; none where that of one does not exist."""
        return linearise_recordings(self.posterior, self.theta)

    @cached_property
    def slopes(self) -> Sensitivity:
        """The derivatives of the one-step errors at the maximum."""
        return compute_sensitivity(self.posterior, self.theta, self.local.steps)

    @property
    def values(self) -> dict[str, float]:
        """The free parameters by key."""
        return {key: float(value) for key, value in self.posterior.space.values(self.theta).items()}

    @property
    def log_evidence(self) -> float:
        """The log marginal likelihood by Laplace's method."""
        sign, logdet = np.linalg.slogdet(self.local.information)
        if sign <= 0:
            return -math.inf
        return self.local.log_posterior + 0.5 * len(self.theta) * math.log(2.0 * math.pi) - 0.5 * float(logdet)

    @property
    def sd(self) -> dict[str, float]:
        """The standard deviation of each coordinate by key."""
        return dict(
            zip(self.posterior.space.keys, np.sqrt(np.maximum(np.diag(self.local.covariance), 0.0)), strict=True)
        )


def choose_first_steps(posterior: Posterior) -> Array:
    """Return the first finite-difference steps: a thousandth of a logarithm, or of the prior width."""
    return np.array(
        [1e-3 if f.log or f.key.startswith("log_") else 1e-3 * min(f.sd, f.high - f.low) for f in posterior.space.free]
    )


def expand(posterior: Posterior, theta: Array, steps: Array) -> LocalExpansion:
    """Return the log posterior at `theta` with its gradient and its expected information.

    A uniform prior contributes the information of its variance: where the recording does not inform a parameter, its
    posterior is as wide as its prior, and it does not change the evidence by Laplace's method.
    """
    return _expand_from(posterior, compute_sensitivity(posterior, theta, steps))


def _expand_from(posterior: Posterior, slopes: Sensitivity) -> LocalExpansion:
    theta = slopes.theta
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):  # where the filter does not get through
        gradient, information = slopes.gradient(), slopes.information()
    for i, f in enumerate(posterior.space.free):
        gradient[i] -= f.prior_information(theta[i]) * (theta[i] - f.mean)
        information[i, i] += f.evidence_information(theta[i])
    log_likelihood = slopes.here.log_likelihood
    return LocalExpansion(
        theta, log_likelihood, log_likelihood + posterior.space.log_prior(theta), gradient, information, slopes.steps
    )


def _tune_steps(local: LocalExpansion, posterior: Posterior) -> Array:
    """Return steps of `STRIDE` conditional standard deviations, within bounds."""
    widths = np.array([min(f.sd, f.high - f.low) for f in posterior.space.free])
    curvature = np.maximum(np.diag(local.information), 1e-300)
    return np.clip(STRIDE / np.sqrt(curvature), 1e-9 * widths, 0.05 * widths)


def maximise(
    posterior: Posterior,
    theta: Array | None = None,
    *,
    rounds: int = 40,
    tolerance: float = 0.02,
    hopeless: float = -math.inf,
    patience: int = 3,
) -> Fit:
    """Return the maximum of the log posterior near `theta`, by damped Fisher scoring within the bounds.

    It has converged when a full step predicts a gain of less than `tolerance` in log posterior. It is abandoned when
    after `patience` rounds five times the predicted gain would not reach `hopeless`.
    """
    point = posterior.space.clip(posterior.space.start if theta is None else theta)
    local = expand(posterior, point, choose_first_steps(posterior))
    if not math.isfinite(local.log_posterior):
        return Fit(posterior, local, "diverged", 0)
    if len(point) > MANY:
        return _maximise_many(posterior, local, rounds, tolerance)
    steps = _tune_steps(local, posterior)
    if np.any((steps > STEP_FACTOR * local.steps) | (local.steps > STEP_FACTOR * steps)):
        local = expand(posterior, point, steps)
    damping, curved = 1e-3, local
    for turn in range(rounds):
        promise = _compute_step(posterior, curved, damping)[1]
        if promise < tolerance:
            return Fit(posterior, local, "converged", turn)
        if turn >= patience and local.log_posterior + 5.0 * promise < hopeless:
            return Fit(posterior, local, "abandoned", turn)
        better = _climb(posterior, curved, damping)
        if better is not None:
            good = better.log_posterior - local.log_posterior > 0.5 * promise
            damping = max(damping * (0.2 if good else 1.0), 1e-6)
            local, curved = better, better if good else _correct_curvature(better, local)
        else:
            damping *= DAMPINGS[-1] * 8.0
            if damping > 1e6:
                return Fit(posterior, local, "rough", turn)
    return Fit(posterior, local, "not converged", rounds)


def _correct_curvature(local: LocalExpansion, before: LocalExpansion) -> LocalExpansion:
    """Return the expansion with the curvature found along the last step, where the expected one is too small.

    Where the model does not explain the data, the expected information of the noise levels is too small: steps
    overshoot repeatedly by nearly their own length.
    """
    step = local.theta - before.theta
    pulled = local.information @ step
    expected, met = float(step @ pulled), float(step @ (before.gradient - local.gradient))
    more = min(max(met / expected, 1.0), STEEPEST) - 1.0 if expected > 0.0 else 0.0
    return replace(local, information=local.information + more / max(expected, 1e-300) * np.outer(pulled, pulled))


def _climb(posterior: Posterior, local: LocalExpansion, damping: float) -> LocalExpansion | None:
    """Return the expansion at the best of several steps with different damping, or None where none gains.

    They are computed together with the stencil of the longest step, which is usually accepted.
    """
    trials = [
        posterior.space.clip(local.theta + _compute_step(posterior, local, factor * damping)[0]) for factor in DAMPINGS
    ]
    steps = _tune_steps(local, posterior)
    ends = make_stencil(posterior, trials[0], steps)
    points = list_stencil_points(trials[0], *ends)
    seen = posterior.innovations(np.vstack([points, *(t[None] for t in trials[1:])]))
    log_densities = [
        seen[k].log_likelihood + posterior.space.log_prior(t)
        for k, t in zip((0, *range(len(points), len(seen))), trials, strict=True)
    ]
    best = int(np.argmax(np.where(np.isnan(log_densities), -np.inf, log_densities)))
    if not log_densities[best] > local.log_posterior:
        return None
    if best == 0:
        return _expand_from(posterior, compute_differences(trials[0], ends, seen[: len(points)], steps))
    return expand(posterior, trials[best], steps)


def _maximise_many(posterior: Posterior, local: LocalExpansion, rounds: int, tolerance: float) -> Fit:
    """Return the maximum near a point in many coordinates: several steps with each set of derivatives."""
    for turn in range(rounds):
        slopes = compute_sensitivity(posterior, local.theta, _tune_steps(local, posterior))
        local = _expand_from(posterior, slopes)
        if _compute_step(posterior, local, 1e-3)[1] < tolerance:
            return Fit(posterior, local, "converged", turn)
        point = _reuse_derivatives(posterior, slopes, local)
        if np.array_equal(point, local.theta):
            return Fit(posterior, local, "rough", turn)
        local = replace(local, theta=point)
    return Fit(posterior, expand(posterior, local.theta, local.steps), "not converged", rounds)


def _reuse_derivatives(posterior: Posterior, slopes: Sensitivity, local: LocalExpansion) -> Array:
    """Return the end of steps with the same derivatives, as long as they gain; one filter run for each."""
    damping = 1e-3
    for _ in range(REUSES):
        step, promise = _compute_step(posterior, local, damping)
        trial = posterior.space.clip(local.theta + step)
        held = replace(slopes, theta=trial, here=posterior.innovations(trial))
        there = _expand_from(posterior, held)
        gain = there.log_posterior - local.log_posterior
        if gain > 0.0:
            local = there
        else:
            damping *= 30.0
        if 0.0 < gain < 0.05 * promise or promise < 1e-3:
            break
    return local.theta


def _compute_step(posterior: Posterior, local: LocalExpansion, damping: float) -> tuple[Array, float]:
    """Return the damped step and its predicted gain; coordinates at a bound with an outward gradient stay there."""
    low, high = posterior.space.low, posterior.space.high
    pressed = ((local.theta <= low) & (local.gradient < 0)) | ((local.theta >= high) & (local.gradient > 0))
    loose = np.flatnonzero(~pressed)
    step = np.zeros_like(local.theta)
    if not len(loose):
        return step, 0.0
    info = local.information[np.ix_(loose, loose)]
    step[loose] = solve_scaled(info + damping * np.diag(np.diag(info)), local.gradient[loose])
    limit = np.array([2.0 if f.log or f.key.startswith("log_") else math.inf for f in posterior.space.free])
    step = np.clip(step, -limit, limit)
    clipped = posterior.space.clip(local.theta + step) - local.theta
    return clipped, 0.5 * float(local.gradient @ clipped)


def use_one_core(fit: Fit) -> Fit:
    """Return the fit with its posterior on one core, for work that is divided over the cores already."""
    return replace(fit, posterior=replace(fit.posterior, jobs=1))


def use_cores(fit: Fit, jobs: int) -> Fit:
    """Return the fit with its posterior on this number of cores."""
    return replace(fit, posterior=replace(fit.posterior, jobs=jobs))


def restart(fit: Fit) -> Posterior:
    """Return the posterior of a fit with its maximum as the starting point."""
    return begin_at(fit.posterior, fit.theta)


def begin_at(posterior: Posterior, theta: Array) -> Posterior:
    """Return a posterior with the coordinates `theta` as the starting point."""
    frees = zip(posterior.space.free, theta, strict=True)
    return posterior.over(replace(f, start=float(c)) for f, c in frees)


def hold_free(posterior: Posterior, at: int, value: float) -> Posterior:
    """Return a posterior without its free parameter number `at`, which is held at a value (SI)."""
    held = posterior.hold_values({posterior.space.free[at].parameter: value})
    return held.over((*held.space.free[:at], *held.space.free[at + 1 :]))


def compute_covariance(fit: Fit, held: Sequence[int] = ()) -> Array:
    """Return the covariance of the estimate while some coordinates are `held`, of which it is zero."""
    if not held:
        return fit.local.covariance
    kept = np.delete(np.arange(len(fit.theta)), held)
    found = np.zeros_like(fit.local.information)
    found[np.ix_(kept, kept)] = solve_scaled(fit.local.information[np.ix_(kept, kept)], np.eye(len(kept)))
    return found


def compute_robust_covariance(fit: Fit, held: Sequence[int] = ()) -> Array:
    """Return the covariance of the estimate that is valid where the model leaves correlated residuals.

    The sandwich of Huber (1967) and White, Econometrica 50 (1982) 1-25, with scores summed over contiguous blocks, so
    that correlated residuals reduce the information. Never smaller than the usual covariance. It is zero for
    coordinates that are `held`.
    """
    scores = fit.slopes.scores()
    edges = np.linspace(0, scores.shape[1], BLOCKS + 1).astype(int)[:-1]
    sums = np.add.reduceat(scores, edges, axis=1)
    sums -= sums.mean(axis=1, keepdims=True)
    usual = compute_covariance(fit, held)
    sandwich = usual @ (sums @ sums.T * BLOCKS / (BLOCKS - 1.0)) @ usual
    factor = np.sqrt(np.maximum(np.diag(sandwich) / np.maximum(np.diag(usual), 1e-300), 1.0))
    return np.asarray(usual * np.outer(factor, factor))


def raise_random_force(posterior: Posterior, theta: Array, by: float) -> Array:
    """Return the coordinates with a larger random force, where the posterior is smoother."""
    warm = theta.copy()
    warm[[f.parameter == RANDOM for f in posterior.space.free]] += by
    return posterior.space.clip(warm)
