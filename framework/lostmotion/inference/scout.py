"""Shapes far from the usual, such as a pitch that is a tenth of the travel: looked for along the recording at once.

A score test costs filter runs, and a wave over position is seen only by who tries its pitch to a few per cent. A law
without states can be held against the gradient of the log-likelihood itself, at hundreds of shapes in a moment; one
that goes with it is then tried by the filter like any other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from lostmotion.contracts import Array, place_of
from lostmotion.inference.candidates import screen, size_of, slopes_of, sorted_slots, term_of, tried_of
from lostmotion.inference.fit import Fit
from lostmotion.inference.setup import stepped
from lostmotion.likelihood.compose import handed
from lostmotion.likelihood.latent import expected_force
from lostmotion.likelihood.problem import Problem
from lostmotion.likelihood.system import Slot

REACH, COUNT = 3.9, 240
"""Shapes are looked at up to this logarithm from the typical value, as far as a prior reaches, and so many: 3 % apart,
which tells a wave with fifteen periods over the travel."""
MOST_SAMPLES = 6000
BLOCKS = 40
STEADY = 3.0
"""A law is looked at more closely when it goes with the gradient in all parts of the recording: its mean over `BLOCKS`
parts is so many standard errors from zero."""
CLEAR = 8.0
"""It is told of when a score test then promises this gain in log-likelihood, and more than at any usual shape."""


def scouted(fit: Fit) -> dict[str, list[dict[str, float]]]:
    """Return for each law without states the far shape to which the recording leans, where there is one."""
    keys, whole = scoutable(fit.problem), fit.problem.observations[0]
    if not keys:
        return {}
    problem = stepped(fit.problem, fit.theta).on((whole.part(0, min(whole.samples, MOST_SAMPLES)),))
    observation = problem.observations[0]
    states, lean = expected_force(problem, fit.theta)
    slopes, found = None, {}
    for key in keys:
        place = place_of(problem.system.model, term_of(problem, key)[0])
        x, v = observation.motion_at(place, states, problem.system.lever(problem.full(fit.theta), place))
        if best := _best(problem, key, np.stack([observation.time, x, v]), lean):
            slopes = slopes or slopes_of(fit)
            hint = screen(fit, slopes, key, [best])
            if hint.gain > CLEAR and best.items() <= hint.start.items():
                found[key] = [best]
    return found


def scoutable(problem: Problem) -> list[str]:
    """Return the keys of forces without states that need nothing but their own numbers, one of them a free shape."""
    idle = [(key, term_of(problem, key)[0]) for key in problem.system.keys if key not in problem.active]
    plain = [key for key, term in idle if term.acts == "motion" and not term.states and not term.needs]
    return [key for key in plain if _free_shapes(problem, key)]


def _free_shapes(problem: Problem, key: str) -> list[Slot]:
    return [s for s in sorted_slots(problem, key)[1] if s.param.scale == "log" and not s.param.choices]


def _best(problem: Problem, key: str, seen: Array, lean: Array) -> dict[str, float] | None:
    """Return the shape that goes with the gradient best, and better than the usual ones, or None."""
    _, shapes = sorted_slots(problem, key)
    usual = {s.key: tried_of(s.param, problem.scales) for s in shapes}
    middle = {name: grid[len(grid) // 2] for name, grid in usual.items()}
    spread = np.exp(np.linspace(-REACH, REACH, COUNT))
    far = {s.key: size_of(s.param, problem.scales) * spread for s in _free_shapes(problem, key)}

    def steadiest(grids: Mapping[str, Array | tuple[float, ...]]) -> tuple[float, dict[str, float]]:
        tried = [{**middle, name: float(value)} for name, grid in grids.items() for value in grid]
        return max(((_steady(problem, key, shape, seen, lean), shape) for shape in tried), key=lambda pair: pair[0])

    top, best = steadiest(far)
    return best if top > max(STEADY, steadiest(usual)[0]) else None


def _steady(problem: Problem, key: str, shape: Mapping[str, float], seen: Array, lean: Array) -> float:
    """Return by how many standard errors a law goes with the gradient, the best of its amplitudes alone."""
    term, slots = term_of(problem, key)
    amplitudes, _ = sorted_slots(problem, key)
    edges, u = np.linspace(0, len(lean), BLOCKS + 1).astype(int)[:-1], np.zeros(2)
    most = 0.0
    for one in amplitudes:
        p = handed(term, [shape.get(s.key, float(s.key == one.key)) for s in slots])
        law = np.array([term.force(t, x, v, u, p, ()) for t, x, v in seen.T.tolist()])
        if not np.all(np.isfinite(law)):
            return 0.0
        parts = np.add.reduceat((law - law.mean()) * lean, edges)
        error = float(parts.std(ddof=1)) / math.sqrt(BLOCKS)
        most = max(most, abs(float(parts.mean())) / error if error > 0.0 else 0.0)
    return most
