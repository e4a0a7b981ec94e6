"""Fits where no sensor shows the position: initial states by smoothing, and a random force that is too large."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, LocalExpansion, maximise
from lostmotion.inference.mixture import compute_nodes, compute_root
from lostmotion.likelihood.initial import shows_place
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import RANDOM

WIDER = 3.0
"""A motion begins within this many standard deviations of its smoothed initial state: the recording is used twice then,
and the first use counts for a ninth of its information. With a wider one, a filter through a gap is wrong for long."""
AGAIN = 3
MOVED = 1.0
COOLER = (0.0, 2.0, 4.0, 6.0)
"""Random forces, in log intensity above the usual, from which a fit is started again."""
GAINED = 1.0
OPENING = 150
"""Samples from the first by which initial states are compared."""
PLACES, SPEEDS, NARROW = np.linspace(-1.5, 1.5, 25), np.linspace(-1.5, 1.5, 7), 0.1
"""Initial positions and velocities that are tried for a machine with play, and the standard deviation of each, in
natural lengths and velocities."""
SHIFTS = np.array([-1.5, -0.75, 0.75, 1.5])
"""Shifts of an initial state that are tried, in its standard deviations."""


@dataclass(frozen=True)
class BodyPosition:
    """The position of the first body over a recording: mean and standard deviation (samples,), in m or rad."""

    mean: Array
    sd: Array


def smooth_body_position(fit: Fit, observation: Observation) -> BodyPosition:
    """Return the position of the body during a recording, by smoothing over the posterior about a fit.

    The level of the random force, which lets a position drift, is integrated on a grid; the position is linearised in
    the other parameters within their deviations. Infinite deviations where every smoother diverges.
    """
    posterior = fit.posterior.on((observation,))
    first = posterior.system.model.first_body[0]
    nodes = compute_nodes(fit)
    means, variances, weights = [], [], []
    for node in nodes:
        seen = posterior.filters[0].smooth(node.local.theta)
        if seen.innovations.finite.all():
            means.append(seen.states[:, first])
            variances.append(np.maximum(seen.covariance[:, first, first], 0.0))
            weights.append(math.exp(node.weight - max(n.weight for n in nodes)))
    if not means:
        return BodyPosition(np.zeros(observation.samples), np.full(observation.samples, np.inf))
    share = np.array(weights) / np.sum(weights)
    mean = share @ np.array(means)
    variance = share @ (np.array(variances) + (np.array(means) - mean) ** 2)
    return BodyPosition(
        mean,
        np.sqrt(
            variance + _compute_parameter_variance(posterior, nodes[int(np.argmax([n.weight for n in nodes]))].local)
        ),
    )


def _compute_parameter_variance(posterior: Posterior, local: LocalExpansion) -> Array:
    """Return the variance (samples,) that unknown parameters add to the position at one level of the random force."""
    first = posterior.system.model.first_body[0]
    at = posterior.filters[0].smooth(local.theta).states[:, first]
    total = np.zeros_like(at)
    held = np.array([key == RANDOM for key in posterior.space.keys])
    for way in compute_root(local.covariance).T:
        seen = posterior.filters[0].smooth(posterior.space.clip(local.theta + np.where(held, 0.0, way)))
        if seen.innovations.finite.all():
            total += (seen.states[:, first] - at) ** 2
    return total


def lacks_position(posterior: Posterior) -> bool:
    """Return whether there is a recording in which no sensor shows a position."""
    return not all(shows_place(observation) for observation in posterior.observations)


def refit_without_position(fit: Fit) -> Fit:
    """Return the fit where no sensor shows the position: with smoothed initial states, and with less random force.

    Other fits are returned unchanged.
    """
    if not lacks_position(fit.posterior) or fit.status == "diverged":
        return fit
    return reduce_random_force(refit_start(reduce_random_force(refit_start_in_play(fit))))


def refit_start(fit: Fit) -> Fit:
    """Return the fit with the initial state from smoothing, repeated until it converges.

    Position and velocity at the first sample may be anywhere in the motion. With such a wide prior, a filter through a
    gap or a cubic spring linearises a force that bends, and is wrong for long after. So the recording is smoothed back
    to its first sample, and the filter begins there (an iterated smoother: Bell, SIAM J. Optimization 4 (1994)
    626-636).
    """
    if not lacks_position(fit.posterior):
        return fit
    for _ in range(AGAIN):
        observations, far = [], 0.0
        for i, observation in enumerate(fit.posterior.observations):
            found, moved = _smooth_start(fit, observation, i)
            observations.append(found)
            far = max(far, moved)
        posterior = fit.posterior.on(tuple(observations))
        better = maximise(posterior, fit.theta)
        if better.status == "diverged" or better.local.log_posterior < fit.local.log_posterior - GAINED:
            return fit
        fit = better
        if far < MOVED:
            break
    return fit


def refit_start_in_play(fit: Fit) -> Fit:
    """Return the fit of a machine with play where no sensor shows the position, with the best of many initial states.

    An iterated smoother does not find the side of a gap on which a motion begins: from the wrong side it converges to a
    local maximum. Other fits are only smoothed back (`refit_start`).
    """
    near = refit_start(fit)
    if near.status == "diverged" or not lacks_position(fit.posterior):
        return near
    if not any(place.play for place in fit.posterior.system.model.places):
        return near
    found = _find_start(near, _list_starts_in_play)
    far = refit_start(maximise(found, near.theta)) if found else near
    gained = far.status != "diverged" and far.local.log_posterior > near.local.log_posterior + GAINED
    return refit_shifted_start(far if gained else near)


def refit_shifted_start(fit: Fit) -> Fit:
    """Return the fit from the best of initial states that are shifted by 0.75 or 1.5 standard deviations, repeated.

    With play, smoothing back may stop beside the best initial state. A shift of the gap, which the velocity does not
    show, then explains the first samples better, and seems to be a property of the machine.
    """
    for _ in range(AGAIN):
        found = _find_start(fit, _list_shifted_starts)
        better = maximise(found, fit.theta) if found else fit
        if better.status == "diverged" or not better.local.log_posterior > fit.local.log_posterior + GAINED:
            return fit
        fit = better
    return fit


def _list_shifted_starts(fit: Fit, index: int) -> list[tuple[Array, Array]]:
    """Return mean and covariance of initial states, one of them shifted by some standard deviations."""
    begun = fit.posterior.observations[index].begun
    if begun is None:
        return []
    mean, covariance = begun
    ways = np.diag(np.sqrt(np.diag(covariance)))
    return [(mean + shift * way, covariance) for way in ways for shift in SHIFTS]


def _list_starts_in_play(fit: Fit, index: int) -> list[tuple[Array, Array]]:
    """Return mean and covariance of initial states all over the motion."""
    posterior, n = fit.posterior, len(fit.posterior.system.model.states)
    unit, now = (
        (posterior.scales.length, posterior.scales.velocity),
        posterior.recordings[index].points(fit.theta[None]),
    )
    mean, covariance = now.mean[0, :n], now.covariance[0, :n, :n].copy()
    body = list(posterior.system.model.first_body)
    covariance[body], covariance[:, body] = 0.0, 0.0
    covariance[body, body] = [(NARROW * size) ** 2 for size in unit]
    seen = any(sensor.channel == "velocity" for sensor in posterior.observations[index].sensors)
    speeds = [mean[body[1]]] if seen else unit[1] * SPEEDS
    pairs = list(itertools.product(unit[0] * PLACES, speeds))
    starts = [mean.copy() for _ in pairs]
    for start, pair in zip(starts, pairs, strict=True):
        start[body] = pair
    return [(start, covariance) for start in starts]


def _find_start(fit: Fit, starts: Callable[[Fit, int], list[tuple[Array, Array]]]) -> Posterior | None:
    """Return the posterior with other initial states that explain the first samples better; None if there are none.

    `starts` returns those that are tried for a recording in which no sensor shows the position.
    """
    whole = list(fit.posterior.observations)
    openings = [o.part(0, min(OPENING, o.samples)) for o in whole]
    for i, observation in enumerate(fit.posterior.observations):
        if shows_place(observation):
            continue
        trials = [openings[i], *(replace(openings[i], begun=begun) for begun in starts(fit, i))]
        scores = [_score_openings(fit, [*openings[:i], trial, *openings[i + 1 :]]) for trial in trials]
        best = int(np.argmax(scores))
        if scores[best] > scores[0] + GAINED:
            openings[i], whole[i] = trials[best], replace(observation, begun=trials[best].begun)
    changed = any(a is not b for a, b in zip(whole, fit.posterior.observations, strict=True))
    return fit.posterior.on(tuple(whole)) if changed else None


def _score_openings(fit: Fit, openings: Sequence[Observation]) -> float:
    """Return the log-likelihood of the first samples of all recordings; minus infinity where it diverges."""
    score = float(fit.posterior.on(tuple(openings)).log_likelihood(fit.theta))
    return score if math.isfinite(score) else -math.inf


def _smooth_start(fit: Fit, observation: Observation, index: int) -> tuple[Observation, float]:
    """Return an observation with its smoothed initial states, and their change in standard deviations."""
    if shows_place(observation):
        return observation, 0.0
    posterior, n = fit.posterior, len(fit.posterior.system.model.states)
    wide = (
        posterior.on(tuple(replace(o, begun=None) for o in posterior.observations))
        .recordings[index]
        .points(fit.theta[None])
    )
    before = posterior.recordings[index].points(fit.theta[None]).mean[0, :n]
    seen = posterior.filters[index].smooth(fit.theta)
    mean, covariance = seen.states[0, :n], seen.covariance[0, :n, :n]
    if not (np.isfinite(mean).all() and np.isfinite(covariance).all()):
        return observation, 0.0
    sd = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    prior = wide.covariance[0, :n, :n]
    unit = np.sqrt(np.diag(prior))
    shared = np.linalg.inv(
        np.eye(n) + np.linalg.inv(_scale_covariance(covariance, unit) * WIDER**2 + 1e-12 * np.eye(n))
    )
    return replace(observation, begun=(mean, shared * np.outer(unit, unit))), float(np.max(np.abs(mean - before) / sd))


def _scale_covariance(covariance: Array, unit: Array) -> Array:
    return covariance / np.outer(unit, unit)


def reduce_random_force(fit: Fit) -> Fit:
    """Return the best of fits that begin at this one with less random force, repeated as long as that gains.

    An accelerometer sees the random force of the moment. So a large one explains any readings, at any parameters, and a
    search stops at one of many maxima there.
    """
    if fit.posterior.dynamics.random != "held":
        return fit
    at = [i for i, f in enumerate(fit.posterior.space.free) if f.parameter == RANDOM]
    usual = fit.posterior.scales.usual
    for _ in range(AGAIN):
        levels = [usual + more for more in COOLER if usual + more < min(fit.theta[at]) - 1.0]
        if not levels:
            return fit
        starts = [fit.theta.copy() for _ in levels]
        for start, level in zip(starts, levels, strict=True):
            start[at] = level
        best = max((maximise(fit.posterior, s) for s in starts), key=lambda f: f.local.log_posterior)
        if not best.local.log_posterior > fit.local.log_posterior + GAINED:
            return fit
        fit = best
    return fit
