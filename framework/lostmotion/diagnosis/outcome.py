"""The outcome of a diagnosis in numbers: its search, the predictions of both models, and draws of their parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.compare import Prediction
from lostmotion.diagnosis.stages import SearchResult, list_physical_keys
from lostmotion.inference.fit import Fit
from lostmotion.inference.mixture import draw_posterior
from lostmotion.inference.profile import stretch_draws
from lostmotion.likelihood.predict import Horizon
from lostmotion.results import Interval

DRAWS = 2000


@dataclass(frozen=True)
class Outcome:
    """A diagnosis, the predictions of both models, their horizon, and draws (draws, keys) of both posteriors.

    Draws are empty until the terms are final.
    """

    diagnosis: SearchResult
    before: Prediction
    after: Prediction
    horizon: Horizon
    draws_before: Array = field(default_factory=lambda: np.zeros((0, 0)))
    draws_after: Array = field(default_factory=lambda: np.zeros((0, 0)))


def draw_parameters(
    fit: Fit, rng: np.random.Generator, stretches: Array | None = None, about: Mapping[str, float] | None = None
) -> Array:
    """Return draws (DRAWS, keys) of the physical parameters from the posterior about a fit.

    Their deviations are multiplied by `stretches`, as `measure_stretches` returns them. Draws of coordinates in `about`
    are moved from the maximum of the fit to the values there.
    """
    free, about = fit.posterior.space.free, about or {}
    theta = draw_posterior(fit, rng, DRAWS)
    if stretches is not None:
        theta = stretch_draws(fit, theta, stretches)
    moved = np.array([about.get(f.key, at) - at for f, at in zip(free, fit.theta, strict=True)])
    theta = fit.posterior.space.clip(theta + moved)
    physical = set(list_physical_keys(fit))
    kept = [i for i, f in enumerate(free) if f.key in physical]
    return np.array([[free[i].value(row[i]) for i in kept] for row in theta])


def compute_intervals(fit: Fit, draws: Array) -> dict[str, Interval]:
    """Return median and central 95 % interval of each physical parameter."""
    units = {f.key: f.unit for f in fit.posterior.space.free}
    low, median, high = np.quantile(draws, [0.025, 0.5, 0.975], axis=0)
    keys = list_physical_keys(fit)
    return {k: Interval(float(median[i]), float(low[i]), float(high[i]), units[k]) for i, k in enumerate(keys)}
