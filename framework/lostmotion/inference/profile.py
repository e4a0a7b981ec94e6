"""The profile of the posterior over each parameter, where the normal approximation is too narrow.

At a maximum on a flat ridge, as with a gap that the motion never crosses, the curvature says little about how far the
ridge goes. The parameter is therefore held at two standard deviations to either side, and all others are adjusted. If
the posterior falls by much less than a normal one, the end of the interval is sought farther out (Venzon, Moolgavkar,
Applied Statistics 37 (1988) 87-94).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, hold_free, maximise, use_one_core
from lostmotion.kernels.threads import each

FIRST, NARROW, STEEP = 2.0, 1.0, 4.0
"""Standard deviations at which a profile is checked, and the fall of the log posterior there (2 for a normal one) below
which it is followed. With the others at their expectation it is near 2 for a normal posterior: between NARROW and STEEP
they are not adjusted."""
WIDTH = 1.96
END = 0.5 * WIDTH**2
"""The fall of the log posterior at the end of a central interval of 95 %."""
DOUBLINGS, REFINEMENTS = 6, 3
"""How often the distance is doubled, and the end then interpolated."""
ROUNDS = 6
MOST_WORK = 2e8
"""The steps of filters that one refit at each end may take, about 20 s: three laws that the recording hardly shows, on
stiff machines, took four minutes for profiles that made no interval wider."""


def measure_stretches(fit: Fit) -> Array:
    """Return by what factor the lower and the upper half of each interval is wider than a normal one, (n, 2).

    It is 1 for noise levels, for coefficients of curves, in which the errors are linear, for parameters of one of
    several recordings, and where refits take more than `MOST_WORK`.
    """
    factors, single = np.ones((len(fit.theta), 2)), use_one_core(fit)
    shared = [i for i, f in enumerate(fit.posterior.space.free) if f.physical and not f.linear and f.recording is None]
    asked = [one for one in ((i, side) for i in shared for side in (0, 1)) if _has_room(fit, *one)]
    asked = [one for one, fall in zip(asked, _predict_falls(fit, asked), strict=True) if not NARROW < fall < STEEP]
    if len(asked) * _count_refit(fit) > MOST_WORK:
        return factors
    found = each(lambda one: _measure_half(single, *one), asked, fit.posterior.jobs)
    for (i, side), factor in zip(asked, found, strict=True):
        factors[i, side] = factor
    return factors


def _count_refit(fit: Fit) -> int:
    """Return the steps of filters of one refit, as `count_work` counts them."""
    running = fit.posterior.dynamics
    return ROUNDS * (2 * len(fit.theta) + 1) * fit.posterior.samples * running.nsub * running.states


def stretch_draws(fit: Fit, draws: Array, stretches: Array) -> Array:
    """Return draws (draws, n) of the coordinates with their deviations from the maximum multiplied by `stretches`."""
    away = draws - fit.theta
    return fit.posterior.space.clip(fit.theta + away * np.where(away < 0.0, stretches[:, 0], stretches[:, 1]))


def _has_room(fit: Fit, at: int, side: int) -> bool:
    """Return whether the standard deviation of a parameter is known, and its bound is farther away."""
    sd, free = math.sqrt(max(float(fit.local.covariance[at, at]), 0.0)), fit.posterior.space.free[at]
    return 0.0 < sd < math.inf and abs((free.low, free.high)[side] - float(fit.theta[at])) > FIRST * sd


def _predict_falls(fit: Fit, asked: Sequence[tuple[int, int]]) -> Array:
    """Return the fall of the log posterior at each end, the other coordinates at their expectation there."""
    if not asked:
        return np.zeros(0)
    cross = np.array([(-1.0, 1.0)[side] * fit.local.covariance[:, i] for i, side in asked])
    sds = np.sqrt([fit.local.covariance[i, i] for i, _ in asked])
    points = fit.posterior.space.clip(fit.theta + FIRST * cross / sds[:, None])
    falls = fit.log_likelihood + float(fit.posterior.space.log_prior(fit.theta)) - fit.posterior.log_density(points)
    return np.where(np.isfinite(falls), falls, math.inf)


def _measure_half(fit: Fit, at: int, side: int) -> float:
    """Return the factor for one half of the interval of one parameter."""
    sd, sign = math.sqrt(max(float(fit.local.covariance[at, at]), 0.0)), (-1.0, 1.0)[side]
    free = fit.posterior.space.free[at]
    most = abs((free.low, free.high)[side] - float(fit.theta[at]))
    near, far = (0.0, 0.0), FIRST * sd
    fall, begin = _fall_at(fit, at, sign * far, fit.theta)
    if not fall < NARROW:
        return 1.0
    for _ in range(DOUBLINGS):
        if not fall < END or far >= most:
            break
        near, far = (far, fall), min(2.0 * far, most)
        fall, begin = _fall_at(fit, at, sign * far, begin)
    if fall < END:
        return far / (WIDTH * sd)
    for _ in range(REFINEMENTS):
        end = near[0] + (far - near[0]) * (math.sqrt(END) - math.sqrt(near[1])) / (math.sqrt(fall) - math.sqrt(near[1]))
        there, begin = _fall_at(fit, at, sign * end, begin)
        if there < END:
            near = (end, there)
        else:
            far, fall = end, there
    return max(end / (WIDTH * sd), 1.0)


def _fall_at(fit: Fit, at: int, shift: float, begin: Array) -> tuple[float, Array]:
    """Return the fall of the log posterior where one parameter is shifted and held, and all coordinates there.

    The others begin at `begin`, or at their expectation under the normal approximation.
    """
    value = float(fit.theta[at]) + shift
    held = hold_free(fit.posterior, at, fit.posterior.space.free[at].value(value))
    cross = fit.local.covariance[:, at]
    starts = held.space.clip(np.delete(np.array([begin, fit.theta + shift * cross / cross[at]]), at, axis=1))
    found = maximise(held, starts[int(np.argmax(held.log_likelihood(starts)))], rounds=ROUNDS, tolerance=0.1)
    theta = np.insert(found.theta, at, value)
    height = found.log_likelihood + float(fit.posterior.space.log_prior(theta))
    best = fit.log_likelihood + float(fit.posterior.space.log_prior(fit.theta))
    return max(best - height, 0.0) if math.isfinite(height) else math.inf, theta
