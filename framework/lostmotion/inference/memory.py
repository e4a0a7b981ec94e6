"""Measurement noise with a memory: tried where something seems to be missing, since it can pose as a force.

A sensor behind a filter, or one that wanders, leaves noise whose samples depend on one another. White noise and a
random force together imitate that, and so the machine gets the blame.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from lostmotion.inference.candidates import Shapes
from lostmotion.inference.fit import Fit, maximise, together
from lostmotion.inference.selection import Progress, Promise, Selection, Selector, significant_random_force
from lostmotion.kernels.threads import each
from lostmotion.likelihood.problem import Problem
from lostmotion.likelihood.space import FADE, NOISE, RANDOM, SLOW, Free

SHORTEST, LONGEST = 0.7, 0.5
"""The memory lasts at least so many samples, and at most this share of the natural time of the motion: what is slower
is a motion of the machine, or a zero that drifts."""
LEAST = 3.0
"""However coarsely it is sampled, a memory of so many samples is allowed."""
WORTH = math.log(20.0) + 3.0
"""It is believed when it raises the log evidence by this: odds of twenty, and the price of two parameters."""
GAIN = 8.0
"""And the log-likelihood by this: where the noise is white the two are flat, and Laplace's method overrates them."""
STARTS = (1.5, 5.0)
NOTICED = 4.0
"""A random force that gains this much is reason enough to look for a memory."""


def selected(
    nominal: Fit, candidates: Iterable[str], say: Progress, shapes: Shapes | None = None, promise: Promise | None = None
) -> Selection:
    """Return the selection among `candidates`, gone over with a memory of the measurement noise where it has one.

    `shapes` are tried beyond the usual; `promise` tells what a learned curve would win.
    """
    keys = tuple(candidates)
    course = Selector(nominal, keys, say, shapes, promise).run()
    chosen = course.chosen
    if not chosen.problem.active and significant_random_force(chosen) < NOTICED:
        return course
    say("measurement noise with a memory")
    hung = remembering(chosen)
    if not believed(chosen, hung):
        return course
    bare = hung if chosen is nominal else remembering(nominal)
    if hung is None or bare is None or bare.status == "diverged":
        return course
    again = Selector(bare, keys, say, shapes, promise)
    return again.resumed(hung) if chosen.problem.active else again.run()


def remembering(fit: Fit) -> Fit | None:
    """Return the fit with measurement noise that has a memory beside the white one, or None where it has one already.

    Begun at a few lengths of the memory, with the random force at what is usual, since it need not imitate any more.
    """
    problem = fit.problem
    if SLOW in problem.keys:
        return None
    wider = replace(problem, free=(*problem.free, *_frees(problem, fit)))
    single = replace(wider, jobs=1)
    fits = each(lambda samples: maximise(single, _start(wider, fit, samples)), STARTS, wider.jobs)
    return together(max(fits, key=lambda f: f.log_evidence), wider.jobs)


def believed(plain: Fit, hung: Fit | None) -> bool:
    """Return whether a memory of the noise is worth its two parameters."""
    if hung is None or hung.status == "diverged":
        return False
    higher = hung.log_likelihood - plain.log_likelihood > GAIN
    return higher and hung.log_evidence > plain.log_evidence + WORTH


def _frees(problem: Problem, fit: Fit) -> tuple[Free, Free]:
    dt = problem.observations[0].dt
    low, high = math.log(SHORTEST * dt), math.log(max(LONGEST * problem.scales.time, LEAST * dt))
    noise = float(np.mean([c for f, c in zip(problem.free, fit.theta, strict=True) if f.parameter == NOISE]))
    middle = min(math.log(3.0 * dt), high)
    return (
        Free(SLOW, "1", noise - 0.5, noise - 5.0, noise + 3.0),
        Free(FADE, "1", middle, low, high, mean=middle, sd=1.0),
    )


def _start(wider: Problem, fit: Fit, samples: float) -> np.ndarray:
    theta = np.concatenate([fit.theta, wider.start[len(fit.theta) :]])
    for i, f in enumerate(wider.free):
        if f.parameter == RANDOM:
            theta[i] = min(theta[i], f.mean)
        if f.parameter == NOISE:
            theta[i] -= 0.35
        if f.parameter == FADE:
            theta[i] = math.log(samples * wider.observations[0].dt)
    return wider.clip(theta)
