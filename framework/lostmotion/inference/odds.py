"""The likelihood ratio of a curve over each covariate, computed in the filter: the location of a missing force.

A curve with normal coefficients acts in the model, and all free parameters of the fit are adjusted with it. Its
marginal likelihood ratio to the model without it, averaged over sizes and correlation lengths, has a closed form from
one score test of its coefficients (`curves.py`). If nothing is missing such a ratio has mean one, so by Markov's
inequality it exceeds 1 / a with a probability of at most a: its inverse is a p-value, without surrogates (Vovk, Wang,
Annals of Statistics 49 (2021) 1736-1754). An average of such ratios has mean one too, so a covariate may have several
curves.

This holds if the noise is as modelled. With autocorrelated errors or outliers, scores scatter more than their
information states, and the ratio is too large. A robust ratio is therefore computed as well, with log-likelihoods
divided by this excess; it decides on significance.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.curves import (
    LENGTHS,
    SIZES,
    add_all_curves,
    compute_coefficient_size,
    join_curve,
    project_from,
)
from lostmotion.inference.fit import BLOCKS, Fit
from lostmotion.inference.learned import (
    DragOverPosition,
    FrictionOverPosition,
    LearnedTerm,
    OverPhase,
    OverPosition,
    OverTime,
    OverVelocity,
    compute_spread,
)
from lostmotion.inference.sensitivity import Sensitivity
from lostmotion.inference.setup import choose_steps
from lostmotion.inference.stretches import list_stretches
from lostmotion.likelihood.posterior import Posterior
from lostmotion.settings import DEFAULT

LEAST = 1e-6
"""The smallest p-value that is reported: the noise is not known well enough for smaller ones."""
MOST_SAMPLES = 8000
"""Longer recordings are represented by evenly spread stretches, because a curve has dozens of coefficients."""

NAMES: Mapping[type[LearnedTerm], str] = {
    OverPosition: "position",
    OverVelocity: "velocity",
    FrictionOverPosition: "sign of velocity",
    DragOverPosition: "velocity",
    OverTime: "time",
    OverPhase: "phase",
}
"""The covariate of each curve: friction with a level over position counts as the sign of the velocity, and damping with
a coefficient over position as the velocity."""
SIMPLEST: Mapping[type[LearnedTerm], int] = {
    OverPosition: 1,
    OverVelocity: 1,
    OverTime: 1,
    FrictionOverPosition: 0,
    DragOverPosition: 0,
}
"""The power of the simplest curve: linear spring, linear damping, linear drift, constant friction, constant damping.
Sines need many coefficients for these, and a curve over the phase of a periodic drive would then be more likely."""


class LikelihoodRatio(NamedTuple):
    """The log likelihood ratio of curves over a covariate: for the modelled noise, and a robust one."""

    log: float
    robust: float


def compute_log_ratios(fit: Fit) -> dict[str, LikelihoodRatio]:
    """Return the log likelihood ratio of a curve over each covariate beside a fit, at each place of the model.

    Names are those of `locate.list_covariates`, such as "position" or "velocity at base". Curves that are active in the
    fit are left out. The time steps are those of a search: finer steps cost four times as much and do not change it.
    """
    wider = _prepare_fit(fit)
    slopes = wider.slopes
    found: dict[str, list[LikelihoodRatio]] = {}
    for key, term in zip(wider.posterior.system.keys, wider.posterior.system.terms, strict=True):
        if isinstance(term, LearnedTerm) and type(term) in NAMES and key not in wider.posterior.active:
            found.setdefault(name_covariate(term), []).append(_compute_ratio(wider, slopes, key, term))
    return {name: LikelihoodRatio(*map(compute_log_mean, zip(*values, strict=True))) for name, values in found.items()}


def _prepare_fit(fit: Fit) -> Fit:
    """Return the fit in a system with every curve, with the time steps of a search and at most `MOST_SAMPLES`."""
    fit = add_all_curves(fit)
    short = choose_steps(_shorten_recordings(fit.posterior), fit.theta)
    return replace(fit, posterior=short)


def _shorten_recordings(posterior: Posterior) -> Posterior:
    share = MOST_SAMPLES / posterior.samples
    if share >= 1.0:
        return posterior
    return posterior.on(tuple(part for one in posterior.observations for part in list_stretches(one, share)))


def _compute_ratio(fit: Fit, slopes: Sensitivity, key: str, term: LearnedTerm) -> LikelihoodRatio:
    """Return the log likelihood ratio of one curve, averaged over its priors."""
    joint, k = join_curve(fit, slopes, key), len(slopes.theta)
    try:
        gradient, information, pulled = project_from(fit, joint, k)
    except np.linalg.LinAlgError:  # the filter diverged
        return LikelihoodRatio(-math.inf, -math.inf)
    scores = joint.scores()
    sums = _sum_blocks(scores[k:] - pulled.T @ scores[:k])
    size = compute_coefficient_size(term, fit.posterior)
    plain, robust = [], []
    for roots in _list_prior_roots(term):
        wider = [size * root for root in roots]
        plain.append(compute_log_mean([compute_gain(gradient, information, root) for root in wider]))
        over = [compute_inflation(sums, information, root) for root in wider]
        robust_gains = [compute_gain(gradient / f, information / f, root) for f, root in zip(over, wider, strict=True)]
        robust.append(compute_log_mean(robust_gains))
    return LikelihoodRatio(compute_log_mean(plain), compute_log_mean(robust))


def _sum_blocks(scores: Array) -> Array:
    """Return the scores (count, samples) summed over blocks of time, (count, blocks), less their mean."""
    edges = np.linspace(0, scores.shape[1], BLOCKS + 1).astype(int)[:-1]
    sums = np.add.reduceat(scores, edges, axis=1)
    return np.asarray(sums - sums.mean(axis=1, keepdims=True))


def compute_inflation(sums: Array, information: Array, root: Array) -> float:
    """Return the factor by which the variance of scores (count, blocks) exceeds their information; at least 1.

    It is the ratio of variances in the directions of a prior `root`. With autocorrelated errors or outliers scores
    scatter more, and log-likelihoods are divided by this factor (Huber 1967; White, Econometrica 50 (1982) 1-25).
    """
    scatter = float(np.sum((root.T @ sums) ** 2)) * BLOCKS / (BLOCKS - 1.0)
    stated = float(np.sum(root * (information @ root)))
    return max(1.0, scatter / stated) if stated > 0.0 else 1.0


def name_covariate(term: LearnedTerm) -> str:
    """Return the covariate of a curve with its place."""
    name = NAMES[type(term)]
    return name if term.at == "ground" or name in ("time", "phase") else f"{name} at {term.at}"


def _list_prior_roots(term: LearnedTerm) -> Iterator[list[Array]]:
    """Yield square roots (count, rank) of prior covariances for a unit drive: smooth curves, then the simplest one."""
    yield [_make_diagonal(size * compute_spread(term, length)) for size, length in itertools.product(SIZES, LENGTHS)]
    if type(term) in SIMPLEST:
        z = np.linspace(-1.0, 1.0, 201)
        weights = np.linalg.lstsq(term.basis(z), z ** SIMPLEST[type(term)], rcond=1e-6)[0]
        column = np.asarray(weights[:, None], dtype=float)
        yield [size * column for size in SIZES]


def _make_diagonal(widths: Array) -> Array:
    return np.asarray(np.diag(widths), dtype=float)


def compute_gain(gradient: Array, information: Array, root: Array) -> float:
    """Return the log marginal likelihood ratio of coefficients with the square root `root` (count, rank) of the prior.

    With gradient g and information H at zero, root R: (g'R (I + R'HR)^-1 R'g - log det(I + R'HR)) / 2.
    """
    inner = np.eye(root.shape[1]) + root.T @ information @ root
    pull = root.T @ gradient
    return 0.5 * float(pull @ np.linalg.solve(inner, pull)) - 0.5 * float(np.linalg.slogdet(inner)[1])


def compute_log_mean(gains: Sequence[float]) -> float:
    """Return the log of the mean of ratios from their logs; minus infinity if none is finite."""
    kept = np.array([gain if math.isfinite(gain) else -math.inf for gain in gains])
    top = float(kept.max())
    return top + math.log(float(np.mean(np.exp(kept - top)))) if math.isfinite(top) else -math.inf


def list_likely(odds: Mapping[str, LikelihoodRatio], level: float = DEFAULT.locate.level) -> list[str]:
    """Return the covariates that are significant at a level over all of them, most likely first."""
    p = compute_p_values(odds)
    return sorted((name for name in odds if p[name] <= level), key=lambda name: -odds[name].log)


def compute_p_values(odds: Mapping[str, LikelihoodRatio]) -> dict[str, float]:
    """Return the p-value of each covariate by its robust ratio, adjusted for all of them (Bonferroni)."""
    adjusted = {name: len(odds) * math.exp(min(-ratio.robust, 0.0)) for name, ratio in odds.items()}
    return {name: min(max(p, LEAST), 1.0) for name, p in adjusted.items()}
