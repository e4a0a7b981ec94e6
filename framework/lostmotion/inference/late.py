"""Since when a term acts: how a recording tells it at first sight, and how it is estimated."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit, Sensitivity, maximise, restarted
from lostmotion.inference.natural import term_of
from lostmotion.inference.standing import standing
from lostmotion.likelihood.problem import FreeParameter, Problem
from lostmotion.likelihood.system import ALWAYS, since_of
from lostmotion.quantities import TIME
from lostmotion.results import Interval

TIMES = 24
"""So many onsets are tried, evenly over a recording."""
FIRST, LAST = 0.04, 0.9
"""Shares of a recording between which an onset is told: before, a term was there from the beginning."""
AROUND, GRID, DEPTH = 0.1, 96, 12.0
"""An interval of an onset is sought over this share of a recording to either side, at so many places at once, and among
those whose log-likelihood is this much lower at the most."""
PRICE = math.log(TIMES)
"""The log price of an onset that was chosen."""


def can_be_late(problem: Problem, key: str) -> bool:
    """Return whether an onset of a term can be estimated: from one recording.

    A term whose own parameters say when it acts (a change at a time, a warming up) has no second time beside that.
    """
    if len(problem.observations) > 1 or since_of(key) not in problem.system.index:
        return False
    term, _ = term_of(problem, key)
    return not any(param.lasting and param.dimension == TIME for param in term.params)


def onset(problem: Problem, key: str) -> float:
    """Return since when (s) a term acts by what is known, `ALWAYS` if from the beginning."""
    return problem.system.onset(problem.known, key)


def times_of(problem: Problem) -> Array:
    """Return the onsets (TIMES,) that are tried, in s."""
    observation = problem.observations[0]
    duration = observation.samples * observation.dt
    return np.asarray(observation.time[0] + duration * np.linspace(FIRST, LAST, TIMES), dtype=float)


def cut(problem: Problem, joint: Sensitivity, k: int) -> Iterator[tuple[float, Array, Array]]:
    """Yield each onset (s) with gradient and information where the last `k` coordinates act from it on alone.

    What came before is forgotten by a filter within a few cycles, so that the sensitivity behind an onset is that of a
    term which was always there: sums over its part of the samples.
    """
    observation, times = problem.observations[0], times_of(problem)
    width = len(observation.sensors)
    edges = np.searchsorted(observation.time, times) * width
    gradient, information, scores = joint.gradient(), joint.information(), joint.scores()[-k:]
    v = joint.here.variances
    for time, edge in zip(times.tolist(), edges.tolist(), strict=True):
        g, h, behind = gradient.copy(), information.copy(), slice(edge, None)
        own = (joint.errors[-k:, behind] / v[behind]) @ joint.errors[:, behind].T
        own += 0.5 * (joint.variances[-k:, behind] / v[behind] ** 2) @ joint.variances[:, behind].T
        g[-k:] = scores[:, behind].sum(axis=1)
        h[-k:, :], h[:, -k:] = own, own.T
        yield time, g, h


def at_any_time(problem: Problem, key: str, start: float) -> FreeParameter:
    """Return the onset of a term as a free parameter, uniform over the recording."""
    observation = problem.observations[0]
    begin = float(observation.time[0])
    return FreeParameter(since_of(key), "s", start, begin, begin + observation.samples * observation.dt)


def refined(fit: Fit, key: str) -> Fit:
    """Return the fit with the onset of a term held where the likelihood is highest nearby; as it is without one."""
    if not onset(fit.problem, key) > ALWAYS:
        return fit
    wider = restarted(fit).extended((at_any_time(fit.problem, key, onset(fit.problem, key)),), ())
    found = maximise(wider, np.append(fit.theta, onset(fit.problem, key)))
    held = restarted(fit).knowing({since_of(key): float(found.theta[-1])})
    late = maximise(held, found.theta[:-1])
    return late if late.local.log_posterior > fit.local.log_posterior else fit


def believed(fit: Fit) -> Fit:
    """Return a fit in which only those onsets are left that are believed; all other terms act from the beginning.

    Few machines change while they are recorded; and where what is left over has a memory, a change wins more than
    independent samples would let it, by the square of how much wider errors are than usual.
    """
    for key in sorted(fit.problem.active):
        if onset(fit.problem, key) > ALWAYS and fit.status != "diverged":
            ever = maximise(restarted(fit).knowing({since_of(key): ALWAYS}), fit.theta)
            needed = (PRICE + fit.problem.settings.select.onset) * standing(fit)[1] ** 2
            if ever.status != "diverged" and not fit.log_evidence - ever.log_evidence > needed:
                fit = ever
    return fit


def since(fit: Fit, key: str) -> Interval | None:
    """Return median and central 95 % interval of the onset of a term, all else as it is; None where it has none.

    A likelihood over onsets has kinks, and is flat where the term does nothing, so it is summed over a grid: first over
    a part of the recording about the onset, then over where it is high.
    """
    problem, at = fit.problem, onset(fit.problem, key)
    if not at > ALWAYS:
        return None
    free = at_any_time(problem, key, at)
    wider, reach = problem.extended((free,), ()), AROUND * (free.high - free.low)
    low, high = max(at - reach, free.low), min(at + reach, free.high)
    grid, heights = np.zeros(0), np.zeros(0)
    for _ in range(2):
        grid = np.linspace(low, high, GRID)
        heights = wider.log_likelihoods(np.array([np.append(fit.theta, t) for t in grid]))
        near = grid[heights > heights.max() - DEPTH]
        low, high = near[0] - (grid[1] - grid[0]), near[-1] + (grid[1] - grid[0])
    weights = np.exp(heights - heights.max())
    below = np.cumsum(weights) / weights.sum()
    cell = grid[1] - grid[0]
    median, low, high = (float(np.interp(share, below, grid + 0.5 * cell)) for share in (0.5, 0.025, 0.975))
    return Interval(median, low, high, "s")


def price_of_onsets(problem: Problem) -> float:
    """Return the log price of the onsets of the terms at work."""
    return PRICE * sum(onset(problem, key) > ALWAYS for key in problem.active)
