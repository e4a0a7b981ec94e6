"""Measurement noise with a memory: tried where something seems to be missing, since it can pose as a force.

A sensor behind a filter, or one that wanders, leaves noise whose samples depend on one another. White noise and a
random force together imitate that, and so the machine gets the blame.
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
    """Return the selection among `candidates`, gone over with a memory of the measurement noise where it has one.

    `shapes` are tried beyond the usual; `promise` tells what a learned curve would win.
    """
    keys = tuple(candidates)
    course = Selector(nominal, keys, say, shapes, promise).run()
    chosen = course.chosen
    least = chosen.problem.settings.select.noise_memory_tried
    if not chosen.problem.active and compute_random_force_gain(chosen) < least:
        return course
    say("measurement noise with a memory")
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
    """Return the nominal fit with a memory of the noise of those sensors that have one in another fit."""
    first, found = nominal.problem.observations[0], nominal
    for i in range(len(first.sensors)):
        if first.level(AR1_LEVEL, i) in coloured.problem.keys and first.level(AR1_LEVEL, i) not in nominal.problem.keys:
            more = fit_noise_memory(found, (i,))
            if more is None or more.status == "diverged":
                return None
            found = more
    return found


def fit_noise_memory(fit: Fit, sensors: Sequence[int] | None = None) -> Fit | None:
    """Return the fit with measurement noise that has a memory beside the white one, or None where all sensors have it.

    Of several sensors (those numbered so, or all) it is the one whose memory is worth most. Begun at a few lengths of
    the memory, with the random force at what is usual, since it need not imitate any more.
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
    """Return whether a memory of the noise is worth its two parameters."""
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
