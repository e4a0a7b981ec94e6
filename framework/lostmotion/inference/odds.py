"""The likelihood ratio of a curve over each covariate, inside the filter: where a missing force lives.

A curve with normal coefficients acts in the model, all free parameters of the fit moving along. Its marginal likelihood
over that of the model without it, averaged over sizes and correlation lengths, comes in closed form from one score test
of its coefficients (`curves.py`). When nothing is missing such a ratio has the mean one, so by Markov's inequality it
exceeds 1 / a with a probability of a at most: its inverse is a p-value, without any surrogates (Vovk, Wang, Annals of
Statistics 49 (2021) 1736-1754). An average of such ratios is one as well, so several curves may stand for a covariate.

That holds where the noise is as the model says. Where errors have a memory or outliers, scores scatter more than their
information says, and the ratio overstates: so it is told a second time with its log divided by that excess, and the
robust one decides what is beyond chance.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.candidates import compute_slopes
from lostmotion.inference.curves import (
    LENGTHS,
    SIZES,
    add_all_curves,
    compute_coefficient_size,
    join_curve,
    project_from,
)
from lostmotion.inference.fit import BLOCKS, Fit, Sensitivity
from lostmotion.inference.learned import (
    DragOverPosition,
    FrictionOverPosition,
    LearnedCurve,
    OverPhase,
    OverPosition,
    OverTime,
    OverVelocity,
    compute_spread,
)
from lostmotion.inference.setup import choose_steps
from lostmotion.inference.stretches import list_stretches
from lostmotion.likelihood.problem import Problem
from lostmotion.settings import DEFAULT

LEAST = 1e-6
"""A smaller p-value is told as this one: no model of the noise is known that far out."""
MOST_SAMPLES = 8000
"""Of longer recordings stretches are asked, evenly spread over them: a curve has dozens of coefficients."""

NAMES: Mapping[type[LearnedCurve], str] = {
    OverPosition: "position",
    OverVelocity: "velocity",
    FrictionOverPosition: "sign of velocity",
    DragOverPosition: "velocity",
    OverTime: "time",
    OverPhase: "phase",
}
"""The covariate of a curve: friction of any size over the position goes with the sign of the velocity, and drag of any
size with the velocity."""
SIMPLEST: Mapping[type[LearnedCurve], int] = {
    OverPosition: 1,
    OverVelocity: 1,
    OverTime: 1,
    FrictionOverPosition: 0,
    DragOverPosition: 0,
}
"""The power of the simplest curve: a linear spring, linear drag, linear drift, constant friction, constant drag. Sines
need many coefficients for these, and a curve over the phase of a periodic drive then seems more likely."""


class LikelihoodRatio(NamedTuple):
    """The log likelihood ratio of curves over a covariate: as the model states its noise, and as the errors scatter."""

    log: float
    robust: float


def compute_log_ratios(fit: Fit) -> dict[str, LikelihoodRatio]:
    """Return the log likelihood ratio of a curve over each covariate beside a fit, at each place of the model.

    Names are those of `locate.covariates`, such as "position" or "velocity at base". Curves that a fit has already are
    not asked. Steps are those of a search: a fit with finer ones costs four times as much and says the same.
    """
    wider = _prepare_fit(fit)
    slopes = compute_slopes(wider)
    found: dict[str, list[LikelihoodRatio]] = {}
    for key, term in zip(wider.problem.system.keys, wider.problem.system.terms, strict=True):
        if isinstance(term, LearnedCurve) and type(term) in NAMES and key not in wider.problem.active:
            found.setdefault(name_covariate(term), []).append(_compute_ratio(wider, slopes, key, term))
    return {name: LikelihoodRatio(*map(compute_log_mean, zip(*values, strict=True))) for name, values in found.items()}


def _prepare_fit(fit: Fit) -> Fit:
    """Return a fit in a system with every curve, with the steps of a search, on as many samples as are asked."""
    fit = add_all_curves(fit)
    short = choose_steps(_shorten_recordings(fit.problem), fit.theta)
    return replace(fit, problem=short)


def _shorten_recordings(problem: Problem) -> Problem:
    share = MOST_SAMPLES / problem.samples
    if share >= 1.0:
        return problem
    return problem.on(tuple(part for one in problem.observations for part in list_stretches(one, share)))


def _compute_ratio(fit: Fit, slopes: Sensitivity, key: str, term: LearnedCurve) -> LikelihoodRatio:
    """Return the log likelihood ratio of one curve, averaged over all that it may look like."""
    joint, k = join_curve(fit, slopes, key), len(slopes.theta)
    try:
        gradient, information, pulled = project_from(fit, joint, k)
    except np.linalg.LinAlgError:  # the filter ran away
        return LikelihoodRatio(-math.inf, -math.inf)
    scores = joint.scores()
    sums = _sum_blocks(scores[k:] - pulled.T @ scores[:k])
    size = compute_coefficient_size(term, fit.problem)
    plain, robust = [], []
    for roots in _list_prior_roots(term):
        wider = [size * root for root in roots]
        plain.append(compute_log_mean([compute_gain(gradient, information, root) for root in wider]))
        over = [compute_inflation(sums, information, root) for root in wider]
        told = [compute_gain(gradient / f, information / f, root) for f, root in zip(over, wider, strict=True)]
        robust.append(compute_log_mean(told))
    return LikelihoodRatio(compute_log_mean(plain), compute_log_mean(robust))


def _sum_blocks(scores: Array) -> Array:
    """Return the scores (count, samples) added up over blocks of time, (count, blocks), less their mean."""
    edges = np.linspace(0, scores.shape[1], BLOCKS + 1).astype(int)[:-1]
    sums = np.add.reduceat(scores, edges, axis=1)
    return np.asarray(sums - sums.mean(axis=1, keepdims=True))


def compute_inflation(sums: Array, information: Array, root: Array) -> float:
    """Return by how much the scores (count, blocks) of a curve scatter more than their information says; 1 at least.

    It is the ratio of variances over all that a prior `root` allows. Where errors have a memory, or outliers, scores
    scatter more, and a likelihood counts for less by that factor (Huber 1967; White, Econometrica 50 (1982) 1-25).
    """
    scatter = float(np.sum((root.T @ sums) ** 2)) * BLOCKS / (BLOCKS - 1.0)
    stated = float(np.sum(root * (information @ root)))
    return max(1.0, scatter / stated) if stated > 0.0 else 1.0


def name_covariate(term: LearnedCurve) -> str:
    """Return the covariate of a curve with its place."""
    name = NAMES[type(term)]
    return name if term.at == "ground" or name in ("time", "phase") else f"{name} at {term.at}"


def _list_prior_roots(term: LearnedCurve) -> Iterator[list[Array]]:
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
    """Return the log marginal likelihood that coefficients add of which `root` (count, rank) is the prior's root.

    With gradient g and information H at zero, root R: (g'R (I + R'HR)^-1 R'g - log det(I + R'HR)) / 2.
    """
    inner = np.eye(root.shape[1]) + root.T @ information @ root
    pull = root.T @ gradient
    return 0.5 * float(pull @ np.linalg.solve(inner, pull)) - 0.5 * float(np.linalg.slogdet(inner)[1])


def compute_log_mean(gains: Sequence[float]) -> float:
    """Return the log of the mean of ratios of which the logs are given; minus infinity where none is a number."""
    kept = np.array([gain if math.isfinite(gain) else -math.inf for gain in gains])
    top = float(kept.max())
    return top + math.log(float(np.mean(np.exp(kept - top)))) if math.isfinite(top) else -math.inf


def list_likely(odds: Mapping[str, LikelihoodRatio], level: float = DEFAULT.locate.level) -> list[str]:
    """Return the covariates that are beyond chance at a level over all of them, the likeliest first."""
    p = compute_p_values(odds)
    return sorted((name for name in odds if p[name] <= level), key=lambda name: -odds[name].log)


def compute_p_values(odds: Mapping[str, LikelihoodRatio]) -> dict[str, float]:
    """Return the p-value of each covariate by its robust ratio, adjusted for all of them (Bonferroni)."""
    told = {name: len(odds) * math.exp(min(-ratio.robust, 0.0)) for name, ratio in odds.items()}
    return {name: min(max(p, LEAST), 1.0) for name, p in told.items()}
