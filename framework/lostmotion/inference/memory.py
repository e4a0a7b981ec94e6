"""AR(1) measurement noise: tried where something seems to be missing, since it can look like a force.

A sensor behind a filter, or one that drifts, has correlated noise. White noise and a random force together imitate it,
so it would be attributed to the machine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.inference.fit import Fit, maximise, use_cores
from lostmotion.kernels.threads import each
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.sensor_noise import make_levels, make_sensor_scales
from lostmotion.likelihood.space import RANDOM
from lostmotion.noises import AR1, AR1_LEVEL, AR1_MEMORY, NOISE

STARTS = (1.5, 5.0)


def add_same_memory(nominal: Fit, coloured: Fit) -> Fit | None:
    """Return the nominal fit with AR(1) noise of those sensors that have it in another fit."""
    first, found = nominal.posterior.observations[0], nominal
    for i in range(len(first.sensors)):
        if (
            first.level(AR1_LEVEL, i) in coloured.posterior.space.keys
            and first.level(AR1_LEVEL, i) not in nominal.posterior.space.keys
        ):
            more = fit_noise_memory(found, (i,))
            if more is None or more.status == "diverged":
                return None
            found = more
    return found


def fit_noise_memory(fit: Fit, sensors: Sequence[int] | None = None) -> Fit | None:
    """Return the fit with AR(1) noise in addition to the white noise, or None where all sensors have it.

    Of several sensors (those numbered, or all) the one with the largest evidence. Started at a few correlation times,
    with the usual random force, which need not imitate the noise any more.
    """
    posterior, first = fit.posterior, fit.posterior.observations[0]
    numbers = range(len(first.sensors)) if sensors is None else sensors
    white = [i for i in numbers if first.level(AR1_LEVEL, i) not in posterior.space.keys]
    asked = []
    for sensor in white:
        key = first.level(NOISE, sensor)
        noise = float(np.mean([c for f, c in zip(posterior.space.free, fit.theta, strict=True) if f.parameter == key]))
        levels = make_levels(first, sensor, AR1(), make_sensor_scales(first, sensor, noise, posterior.scales))
        wider = posterior.over((*posterior.space.free, *levels))
        asked += [(replace(wider, jobs=1), _choose_start(wider, fit, samples)) for samples in STARTS]
    if not asked:
        return None
    fits = each(lambda one: maximise(*one), asked, posterior.jobs)
    return use_cores(max(fits, key=lambda f: f.log_evidence), posterior.jobs)


def is_memory_supported(plain: Fit, coloured: Fit | None) -> bool:
    """Return whether the evidence supports AR(1) noise with its two parameters."""
    if coloured is None or coloured.status == "diverged":
        return False
    limits = coloured.posterior.settings.select
    higher = coloured.log_likelihood - plain.log_likelihood > limits.noise_memory
    return higher and coloured.log_evidence > plain.log_evidence + limits.decisive + 2.0 * limits.further


def _choose_start(wider: Posterior, fit: Fit, samples: float) -> np.ndarray:
    theta = np.concatenate([fit.theta, wider.space.start[len(fit.theta) :]])
    for i, f in enumerate(wider.space.free):
        if f.level == RANDOM:
            theta[i] = min(theta[i], f.mean)
        if f.level == NOISE:
            theta[i] -= 0.35
        if f.level == AR1_MEMORY and i >= len(fit.theta):
            theta[i] = math.log(samples * wider.observations[0].dt)
    return wider.space.clip(theta)
