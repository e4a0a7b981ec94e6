"""Draws from the posterior of a hypothesis, with size and length of its smooth forces averaged.

The fit has the smooth forces of the largest evidence. The data seldom tell one size or length from its neighbours, or a
small force along a parameter from none: with one choice the intervals of parameters are too narrow.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.special import softmax

from lostmotion.contracts import Array
from lostmotion.evidence.discrepancy import Choice, Quadratic
from lostmotion.evidence.hypothesis import Hypothesis, compute_step
from lostmotion.inference.mixture import compute_root


def draw_own(found: Hypothesis, count: int, rng: np.random.Generator) -> Array:
    """Return draws (count, own) of the own coordinates of a hypothesis, each with smooth forces of its own.

    Given the smooth forces they are normal: one-step errors are nearly linear near the maximum.
    """
    choices = sample_choices(found, count, rng)
    made = rng.standard_normal((count, found.frame.own))
    for choice in dict.fromkeys(choices):
        rows = [i for i, one in enumerate(choices) if one == choice]
        step, _ = compute_step(found.frame, found.expansion, choice)
        root = compute_root(found.scatter * replace(found, choice=choice).covariance)
        made[rows] = found.theta + step[: found.frame.own] + made[rows] @ root.T
    low, high = (bound[: found.frame.own] for bound in found.frame.bounds)
    return np.clip(made, low, high)


def sample_choices(found: Hypothesis, count: int, rng: np.random.Generator) -> list[Choice]:
    """Return draws of the options of all smooth forces from their posterior, begun at the choice of the fit.

    In each draw each smooth force in turn gets one of its options, or none, in proportion to the evidence beside the
    others (Gibbs sampling: Geman, Geman, IEEE Trans. Pattern Anal. Mach. Intell. 6 (1984) 721-741).
    """
    quadratic = Quadratic.of(found.frame, found.expansion.curvature)
    known: dict[Choice, float] = {}
    choice, made = found.choice, []
    for _ in range(count):
        for k, force in enumerate(found.frame.forces):
            options = [(*choice[:k], option, *choice[k + 1 :]) for option in range(-1, len(force.options))]
            known |= {one: quadratic.evaluate(one) for one in options if one not in known}
            shares = softmax([known[one] / found.scatter for one in options])
            choice = options[int(rng.choice(len(options), p=shares))]
        made.append(choice)
    return made
