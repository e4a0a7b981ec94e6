"""The onset of a term: its first estimate from score tests, its fit, and its interval."""

from __future__ import annotations

import math

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import ROUGHLY, Fit, maximise, restart
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import ALWAYS, onset_key
from lostmotion.quantities import TIME
from lostmotion.results import Interval

TIMES = 24
"""The number of onsets that are tried, evenly over a recording."""
AROUND, GRID, DEPTH = 0.1, 96, 12.0
"""The interval of an onset is sought over this share of a recording to either side, on this many grid points, where the
log-likelihood is at most this much lower."""
PRICE = math.log(TIMES)
"""The log prior penalty of the choice of an onset."""


def can_have_onset(posterior: Posterior, key: str) -> bool:
    """Return whether an onset of a term can be estimated: from one recording, or stretches of one.

    A term whose own parameters say when it acts (a change at a time, a warming up) has no second time beside that.
    """
    if len({o.name for o in posterior.observations}) > 1 or onset_key(key) not in posterior.system.index:
        return False
    term, _ = find_term(posterior, key)
    return not any(param.prior.lasting and param.dimension == TIME for param in term.params)


def find_onset(posterior: Posterior, key: str) -> float:
    """Return the time (s) from which a term acts in a posterior, `ALWAYS` if from the beginning."""
    return posterior.system.onset(posterior.known, key)


def find_span(posterior: Posterior) -> tuple[float, float]:
    """Return begin and end (s) of the recording of a posterior, of which its observations may be stretches."""
    ends = [float(o.time[0]) + o.samples * o.dt for o in posterior.observations]
    return min(float(o.time[0]) for o in posterior.observations), max(ends)


def list_onsets(posterior: Posterior, count: int = TIMES) -> Array:
    """Return the onsets (count,) that are tried, in s."""
    (begin, end), limits = find_span(posterior), posterior.settings.select
    return begin + (end - begin) * np.linspace(limits.onset_first, limits.onset_last, count)


def make_onset_parameter(posterior: Posterior, key: str, start: float) -> FreeParameter:
    """Return the onset of a term as a free parameter, uniform over the recording."""
    return FreeParameter(onset_key(key), "s", start, *find_span(posterior))


def refine_onset(fit: Fit, key: str) -> Fit:
    """Return the fit with the onset of a term held at the highest maximum; unchanged for a term without one.

    If the term explains as much from the beginning on, apart from the price of an onset, it has none: where the drive
    reaches a resonance late, a term promises more from then on.
    """
    if fit.status == "diverged" or not find_onset(fit.posterior, key) > ALWAYS:
        return fit
    onset = find_onset(fit.posterior, key)
    wider = restart(fit).extend((make_onset_parameter(fit.posterior, key, onset),), ())
    found = maximise(wider, _scan_time(wider, np.append(fit.theta, onset), len(fit.theta)), tolerance=ROUGHLY)
    late, ever = (
        maximise(restart(fit).hold_values({onset_key(key): at}), found.theta[:-1], tolerance=ROUGHLY)
        for at in (found.theta[-1], ALWAYS)
    )
    if ever.log_evidence > max(late.log_evidence, fit.log_evidence) - price_onset(fit.posterior):
        return ever
    return late if late.local.log_posterior > fit.local.log_posterior else fit


def find_change_time(posterior: Posterior, key: str) -> int | None:
    """Return the index of the free time at which a term changes the machine; None for a term without one.

    It is a time in the recording with a scan, such as that of a change of inertia.
    """
    _, slots = find_term(posterior, key)
    times = [s.key for s in slots if s.param.prior.lasting and s.param.dimension == TIME and s.param.prior.scan]
    return next((i for i, name in enumerate(posterior.space.keys) if name in times), None)


def refine_change(fit: Fit, key: str) -> Fit:
    """Return the fit with the time of a change at the highest maximum; unchanged for a term without one."""
    if fit.status == "diverged" or (at := find_change_time(fit.posterior, key)) is None:
        return fit
    found = maximise(fit.posterior, _scan_time(fit.posterior, fit.theta, at), tolerance=ROUGHLY)
    return found if found.local.log_posterior > fit.local.log_posterior else fit


def _scan_time(posterior: Posterior, theta: Array, at: int) -> Array:
    """Return coordinates with a time in the recording, the one at index `at`, at the highest of many maxima.

    The likelihood of such a time has a maximum in nearly every cycle of the motion, so it is computed on a grid over
    the recording, then between the neighbours of the best time.
    """
    best, grid = theta.copy(), list_onsets(posterior, GRID)
    for _ in range(2):
        times = np.append(grid, math.exp(best[at]) if posterior.space.free[at].log else best[at])
        thetas = np.repeat(best[None], len(times), axis=0)
        thetas[:, at] = np.log(times) if posterior.space.free[at].log else times
        thetas = posterior.space.clip(thetas)
        chosen = int(np.nanargmax(posterior.log_density(thetas)))
        best = thetas[chosen]
        grid = times[chosen] + np.linspace(-1.0, 1.0, TIMES + 1) * (grid[1] - grid[0])
        grid = grid[grid > 0.0]
    return best


def estimate_onset(fit: Fit, key: str) -> Interval | None:
    """Return median and central 95 % interval of the onset of a term, other parameters held; None where it has none.

    A likelihood over onsets has kinks, and is flat where the term does nothing, so it is summed over a grid: first over
    a part of the recording about the onset, then over the region of high likelihood.
    """
    posterior, at = fit.posterior, find_onset(fit.posterior, key)
    if not at > ALWAYS:
        return None
    free = make_onset_parameter(posterior, key, at)
    wider, reach = posterior.extend((free,), ()), AROUND * (free.high - free.low)
    low, high = max(at - reach, free.low), min(at + reach, free.high)
    grid, heights = np.zeros(0), np.zeros(0)
    for _ in range(2):
        grid = np.linspace(low, high, GRID)
        heights = wider.log_likelihood(np.array([np.append(fit.theta, t) for t in grid]))
        near = grid[heights > heights.max() - DEPTH]
        low, high = near[0] - (grid[1] - grid[0]), near[-1] + (grid[1] - grid[0])
    weights = np.exp(heights - heights.max())
    below = np.cumsum(weights) / weights.sum()
    cell = grid[1] - grid[0]
    median, low, high = (float(np.interp(share, below, grid + 0.5 * cell)) for share in (0.5, 0.025, 0.975))
    return Interval(median, low, high, "s")


def compute_onset_price(posterior: Posterior) -> float:
    """Return the log prior penalty of the onsets of the active terms."""
    return price_onset(posterior) * sum(find_onset(posterior, key) > ALWAYS for key in posterior.active)


def price_onset(posterior: Posterior) -> float:
    """Return the log prior penalty of one onset, of its time and of a change at all: few machines change."""
    return PRICE + posterior.settings.select.onset
