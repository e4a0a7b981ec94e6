"""Values of an amplitude that are too far from its null for a score test, tried by refits on part of a recording.

A score test is a linear prediction at the nominal fit. A delay of a tenth of a cycle, or a gap as wide as the motion,
is out of its reach: the nominal parameters are then far from the true ones, too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Array, Param
from lostmotion.inference.fit import HOPELESS, Fit, maximise, raise_random_force, restart
from lostmotion.inference.natural import compute_size, find_term, list_tried_values
from lostmotion.inference.random_force import compute_random_force_gain
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.space import FreeParameter
from lostmotion.likelihood.system import Slot
from lostmotion.quantities import NUMBER, TIME

DELAYS = (-2.0, -1.0, -0.5, -0.2, 0.2, 0.5, 1.0, 1.5, 2.0, 2.8, 4.0, 5.5)
"""Times of a channel that are tried, in their typical size, the time in which the motion turns by one radian: the
response grows linearly with a delay only up to a few tenths of it."""
OFFSETS = (-4.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0, 4.0)
"""Shifts of a channel that are tried, in their typical size: where the model has a gap, a large one resembles a force.
"""
SHORT = 1500
"""Samples on which values are tried."""
MOST_TRIED = 4
"""The number of values that are refitted: those at which the likelihood is highest to begin with."""
RAISED, RAISED_MOST = 2.0, 6.0
"""The increase of the log random force from the nominal fit, and from the middle of the priors."""
ROUNDS, MORE_ROUNDS = 3, 12
"""The most steps of a refit from the nominal fit, and from the middle of the priors."""


@dataclass(frozen=True)
class FarValue:
    """A value of an amplitude, its gain in log-likelihood, and the coordinates (n,) of the other parameters there.

    `base` is None where a fit is to begin from the nominal fit.
    """

    value: float
    gain: float
    base: Array | None


def try_far_values(fit: Fit, slot: Slot, key: str) -> FarValue | None:
    """Return the best of the values of an amplitude that are far from the null, or None where none is better.

    The other parameters are refitted roughly, on the beginning of the recording. It is done for the nominal model
    alone: a missing term of this size is evident there. An amplitude with a scan is tried where a random force beyond
    the usual gains more than a far value must gain, also from the middle of the priors, because a gap makes a spring
    seem far too soft. The response to other forces is nearly linear in their size; that to a delay or a shift of a
    channel is not.
    """
    least = fit.posterior.settings.select.far
    far = () if find_term(fit.posterior, key)[0].acts == "motion" else _list_far(slot.param)
    values = [factor * compute_size(slot.param, fit.posterior.scales) for factor in far]
    scanned = bool(slot.param.prior.scan) and compute_random_force_gain(fit) > least
    if scanned:
        values += list_tried_values(slot.param, fit.posterior.scales)
    if not values:
        return None
    bottom = _shorten(fit)
    short, nominal = bottom.posterior, bottom.local.log_posterior
    wider = short.extend((hold_shape(slot),), {key})
    theta = raise_random_force(short, bottom.theta, RAISED)
    log_densities = wider.log_likelihood(np.array([np.append(theta, value) for value in values]))
    best: FarValue | None = None
    for i in np.argsort(-log_densities)[:MOST_TRIED]:
        trial = _hold_value(short, slot, key, values[i])
        near = maximise(trial, bottom.theta, rounds=ROUNDS, tolerance=1.0, hopeless=nominal, patience=1)
        refits: list[tuple[Fit, Array | None]] = [(near, None)]
        if scanned:
            begin = raise_random_force(short, short.space.start, RAISED_MOST)
            other = maximise(trial, begin, rounds=MORE_ROUNDS, tolerance=1.0, hopeless=nominal - HOPELESS)
            refits.append((other, other.theta))
        for found, base in refits:
            gain = found.log_likelihood - bottom.log_likelihood
            if gain > (best.gain if best else least):
                best = FarValue(values[i], gain, base)
    return best


def _list_far(param: Param) -> tuple[float, ...]:
    """Return the far values of an amplitude of a channel in its typical size; none for a gain or a range to scan."""
    if param.prior.scan or param.dimension == NUMBER:
        return ()
    return DELAYS if param.dimension == TIME else OFFSETS


def _shorten(fit: Fit) -> Fit:
    """Return the fit to the beginning of the recordings; it is the fit itself where they are short."""
    observations = fit.posterior.observations
    if all(t.samples <= SHORT for t in observations):
        return fit
    short = fit.posterior.on(tuple(t.part(0, min(t.samples, SHORT)) for t in observations))
    return maximise(restart(replace(fit, posterior=short)), fit.theta, rounds=2)


def _hold_value(posterior: Posterior, slot: Slot, key: str, value: float) -> Posterior:
    """Return a posterior with a term active, and its amplitude held at a value."""
    trial = posterior.hold_values({slot.key: value})
    return trial.acting(trial.active | {key})


def hold_shape(slot: Slot) -> FreeParameter:
    """Return a shape parameter as a coordinate without bounds."""
    return FreeParameter(slot.key, slot.unit, 0.0, -math.inf, math.inf)
