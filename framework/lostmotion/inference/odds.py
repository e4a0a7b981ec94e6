"""The likelihood ratio of a curve over each covariate, inside the filter: where a missing force lives.

A smooth curve with normal coefficients acts in the model, all free parameters of the fit moving along. Its marginal
likelihood over that of the model without it, averaged over sizes and correlation lengths, comes in closed form from one
score test of its coefficients (`curves.py`). When nothing is missing such a ratio has the mean one, so by Markov's
inequality it exceeds 1 / a with a probability of a at most: its inverse is a p-value, without any surrogates (Vovk,
Wang, Annals of Statistics 49 (2021) 1736-1754).
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from lostmotion.inference.candidates import slopes_of
from lostmotion.inference.curves import shapes_of, transplanted
from lostmotion.inference.fit import Fit
from lostmotion.inference.learned import (
    DragOverPosition,
    FrictionOverPosition,
    Learned,
    OverPhase,
    OverPosition,
    OverTime,
    OverVelocity,
)

NAMES: Mapping[type[Learned], str] = {
    OverPosition: "position",
    OverVelocity: "velocity",
    FrictionOverPosition: "sign of velocity",
    DragOverPosition: "drag over position",
    OverTime: "time",
    OverPhase: "phase",
}
"""The covariate that a curve runs over; friction of any size over the position goes with the sign of the velocity."""


def log_odds(fit: Fit) -> dict[str, float]:
    """Return the log marginal likelihood that a curve over each covariate adds to a fit, at each place of the model.

    Names are those of `locate.covariates`: "position", "velocity at base".
    """
    wider = transplanted(fit, fit.problem.active)
    slopes = slopes_of(wider)
    found = {}
    for key, term in zip(wider.problem.system.keys, wider.problem.system.terms, strict=True):
        if isinstance(term, Learned):
            gains = np.array([shape.gain for shape in shapes_of(wider, slopes, key)])
            found[named(term)] = _averaged(gains)
    return found


def named(term: Learned) -> str:
    """Return the covariate of a curve with its place."""
    name = NAMES[type(term)]
    return name if term.at == "ground" or name in ("time", "phase") else f"{name} at {term.at}"


def _averaged(gains: np.ndarray) -> float:
    """Return the log of the mean ratio; minus infinity where none is a number."""
    kept = np.where(np.isfinite(gains), gains, -math.inf)
    top = float(kept.max())
    return top + math.log(float(np.mean(np.exp(kept - top)))) if math.isfinite(top) else -math.inf


def p_values(odds: Mapping[str, float]) -> dict[str, float]:
    """Return the p-value of each covariate, adjusted for all of them (Bonferroni)."""
    return {name: min(1.0, len(odds) * math.exp(min(-value, 0.0))) for name, value in odds.items()}
