"""Draws from a posterior with the level of the random force integrated on a grid.

At the maximum the random force is often at its lower bound, where a normal approximation is too narrow for all other
parameters: more random force means a shorter memory and wider intervals. Conditional on it the posterior is close to
normal, so a mixture over a grid of it is accurate (Rue, Martino, Chopin, J. R. Statist. Soc. B 71 (2009) 319-392).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, LocalExpansion, compute_robust_covariance, maximise
from lostmotion.likelihood.space import RANDOM

STRIDE = 0.8
MOST = 7
FAINT = 5.0
"""Spacing of the nodes in log intensity, greatest number to each side, and range of log weights below the best."""
MANY = 24
"""With more free parameters, as with learned curves, a grid takes minutes: draws are then from the maximum alone."""


@dataclass(frozen=True)
class MixtureNode:
    """The posterior at one level of the random force: its expansion there and its log weight."""

    local: LocalExpansion
    weight: float


def draw_posterior(fit: Fit, rng: np.random.Generator, count: int) -> Array:
    """Return draws (count, free parameters) of the coordinates from the posterior about a fit.

    Standard deviations are those of the robust covariance where that is wider, because of correlated residuals. Where
    each recording has a random force of its own, all are drawn from the normal approximation at the maximum.
    """
    nodes = compute_nodes(fit)
    weights = np.exp([n.weight - max(m.weight for m in nodes) for n in nodes])
    which = rng.choice(len(nodes), size=count, p=weights / weights.sum())
    wider = np.sqrt(np.diag(compute_robust_covariance(fit)) / np.maximum(np.diag(fit.local.covariance), 1e-300))
    noise = rng.standard_normal((count, len(fit.theta)))
    roots = [compute_root(node.local.covariance) for node in nodes]
    theta = np.array([nodes[k].local.theta + wider * (roots[k] @ z) for k, z in zip(which, noise, strict=True)])
    if len(nodes) > 1:
        at = fit.posterior.space.keys.index(RANDOM)
        theta[:, at] = [nodes[k].local.theta[at] for k in which] + STRIDE * (rng.random(count) - 0.5)
    return fit.posterior.space.clip(theta)


def compute_root(covariance: Array) -> Array:
    """Return a square root (n, n) of a covariance, with each coordinate scaled to unit deviation first."""
    sd = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    values, vectors = np.linalg.eigh(covariance / np.outer(sd, sd))
    return np.asarray(sd[:, None] * vectors * np.sqrt(np.maximum(values, 0.0)))


def compute_nodes(fit: Fit) -> list[MixtureNode]:
    """Return the nodes from the maximum outwards, each started from its neighbour."""
    if RANDOM not in fit.posterior.space.keys or len(fit.theta) > MANY:
        return [MixtureNode(fit.local, 0.0)]
    at = fit.posterior.space.keys.index(RANDOM)
    free = fit.posterior.space.free[at]
    centre = _compute_node(fit, fit.theta, at)
    nodes = [centre]
    for direction in (1.0, -1.0):
        near = centre
        for _ in range(MOST):
            theta = near.local.theta.copy()
            theta[at] += direction * STRIDE
            if not free.low <= theta[at] <= free.high:
                break
            near = _compute_node(fit, theta, at)
            if not near.weight > max(n.weight for n in nodes) - FAINT:
                break
            nodes.append(near)
    heavy = [node for node in nodes if math.isfinite(node.weight)]
    return heavy or [MixtureNode(fit.local, 0.0)]


def _compute_node(fit: Fit, theta: Array, at: int) -> MixtureNode:
    """Return the node at the random force of `theta`, with all other parameters at their conditional maximum."""
    frees = list(fit.posterior.space.free)
    frees[at] = replace(frees[at], start=theta[at], low=theta[at], high=theta[at])
    local = maximise(fit.posterior.over(frees), theta, rounds=4, tolerance=0.1).local
    kept = [i for i in range(len(theta)) if i != at]
    sign, logdet = np.linalg.slogdet(local.information[np.ix_(kept, kept)])
    height = local.log_likelihood + fit.posterior.space.log_prior(local.theta)
    return MixtureNode(local, height - 0.5 * float(logdet) if sign > 0 else -math.inf)
