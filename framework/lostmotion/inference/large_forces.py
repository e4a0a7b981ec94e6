"""Fits of a force that is the main part of the readings of a load cell."""

from __future__ import annotations

import math

from lostmotion.contracts import Array
from lostmotion.inference.candidates import ScoreTest, add_term
from lostmotion.inference.fit import Fit, maximise, restart
from lostmotion.inference.natural import compute_size, sort_slots
from lostmotion.likelihood.problem import RANDOM, Problem
from lostmotion.quantities import FORCE

LARGE = 0.7
"""A large force, in amplitudes of the measured one."""
LEVELS = (2.0, 6.0, 9.0)
"""Random forces, in log intensity above the usual, from which a fit starts at the prior of the model."""


def guess_large_force(problem: Problem, key: str) -> ScoreTest | None:
    """Return a start at which a term is most of the measured force; None for one that is no force of one amplitude."""
    amplitudes, shapes = sort_slots(problem, key)
    if len(amplitudes) != 1 or amplitudes[0].param.dimension != FORCE or amplitudes[0].param.low < 0.0:
        return None
    usual = {s.key: compute_size(s.param, problem.scales) for s in shapes}
    return ScoreTest(key, 0.0, {amplitudes[0].key: LARGE * problem.scales.force, **usual}, 1.0)


def fit_large_force(nominal: Fit, calm: Fit, hint: ScoreTest) -> Fit:
    """Return the best fit with a large force, from two nominal fits and from the centre of the prior of the model.

    Without the force, the nominal model may explain the readings with values far from its prior: a sliding band was
    taken for a mass that is eighty times too heavy. From there, a fit with the force stops at a local maximum.
    """
    problems = [add_term(restart(start), hint, hint.start) for start in (calm, nominal)]
    fits = [maximise(problem) for problem in problems]
    fits += [maximise(problems[-1], _begin_at_prior(problems[-1], level)) for level in LEVELS]
    return max(fits, key=lambda found: found.local.log_posterior)


def _begin_at_prior(problem: Problem, level: float) -> Array:
    """Return the start of a problem with each parameter of the model at the centre of its prior."""
    theta, model = problem.start.copy(), {param.name for param in problem.system.model.params}
    for i, free in enumerate(problem.free):
        if free.parameter == RANDOM:
            theta[i] = problem.scales.usual + level
        elif free.parameter in model:
            theta[i] = free.mean if math.isfinite(free.sd) else 0.5 * (free.low + free.high)
    return problem.clip(theta)
