"""AR(1) measurement noise: tried where something seems to be missing, since it can look like a force.

A sensor behind a filter, or one that drifts, has correlated noise. White noise and a random force together imitate it,
so it would be attributed to the machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.inference.candidates import Shapes
from lostmotion.inference.fit import Fit, maximise, use_cores
from lostmotion.inference.random_force import compute_random_force_gain
from lostmotion.inference.selection import Progress, Promise, Selector
from lostmotion.inference.term_sets import Selection
from lostmotion.kernels.threads import each
from lostmotion.likelihood.levels import make_ar1_levels
from lostmotion.likelihood.problem import Problem
from lostmotion.likelihood.space import AR1_LEVEL, AR1_MEMORY, NOISE, RANDOM

STARTS = (1.5, 5.0)


def select_with_noise_memory(
    nominal: Fit, candidates: Iterable[str], say: Progress, shapes: Shapes | None = None, promise: Promise | None = None
) -> Selection:
    """Return the selection among `candidates`, repeated with AR(1) noise of the sensors where that is supported.

    `shapes` are tried in addition to the usual ones; `promise` returns the gain that a learned curve predicts.
    """
    keys = tuple(candidates)
    course = Selector(nominal, keys, say, shapes, promise).run()
    chosen = course.chosen
    least = chosen.problem.settings.select.noise_memory_tried
    if not chosen.problem.active and compute_random_force_gain(chosen) < least:
        return course
    say("AR(1) measurement noise")
    coloured = fit_noise_memory(chosen)
    if coloured is None or not is_memory_supported(chosen, coloured):
        return course
    while (more := fit_noise_memory(coloured)) is not None and is_memory_supported(coloured, more):
        coloured = more
    bare = coloured if chosen is nominal else _add_same_memory(nominal, coloured)
    if bare is None or bare.status == "diverged":
        return course
    again = Selector(bare, keys, say, shapes, promise)
    return again.resume(coloured) if chosen.problem.active else again.run()


def _add_same_memory(nominal: Fit, coloured: Fit) -> Fit | None:
    """Return the nominal fit with AR(1) noise of those sensors that have it in another fit."""
    first, found = nominal.problem.observations[0], nominal
    for i in range(len(first.sensors)):
        if first.level(AR1_LEVEL, i) in coloured.problem.keys and first.level(AR1_LEVEL, i) not in nominal.problem.keys:
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
    problem, first = fit.problem, fit.problem.observations[0]
    numbers = range(len(first.sensors)) if sensors is None else sensors
    white = [i for i in numbers if first.level(AR1_LEVEL, i) not in problem.keys]
    asked = []
    for sensor in white:
        key = first.level(NOISE, sensor)
        noise = float(np.mean([c for f, c in zip(problem.free, fit.theta, strict=True) if f.parameter == key]))
        wider = replace(problem, free=(*problem.free, *make_ar1_levels(first, sensor, noise, problem.scales)))
        asked += [(replace(wider, jobs=1), _choose_start(wider, fit, samples)) for samples in STARTS]
    if not asked:
        return None
    fits = each(lambda one: maximise(*one), asked, problem.jobs)
    return use_cores(max(fits, key=lambda f: f.log_evidence), problem.jobs)


def is_memory_supported(plain: Fit, coloured: Fit | None) -> bool:
    """Return whether the evidence supports AR(1) noise with its two parameters."""
    if coloured is None or coloured.status == "diverged":
        return False
    limits = coloured.problem.settings.select
    higher = coloured.log_likelihood - plain.log_likelihood > limits.noise_memory
    return higher and coloured.log_evidence > plain.log_evidence + limits.decisive + 2.0 * limits.further


def _choose_start(wider: Problem, fit: Fit, samples: float) -> np.ndarray:
    theta = np.concatenate([fit.theta, wider.start[len(fit.theta) :]])
    for i, f in enumerate(wider.free):
        if f.level == RANDOM:
            theta[i] = min(theta[i], f.mean)
        if f.level == NOISE:
            theta[i] -= 0.35
        if f.level == AR1_MEMORY and i >= len(fit.theta):
            theta[i] = math.log(samples * wider.observations[0].dt)
    return wider.clip(theta)
