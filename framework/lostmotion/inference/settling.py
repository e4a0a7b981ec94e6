"""Integration steps that are short enough for the noise of a recording."""

from __future__ import annotations

from lostmotion.inference.fit import ROUGHLY, Fit, maximise

SETTLED, MOST_STEPS = 3.0, 48
"""The largest change of the log-likelihood by half as long steps, and the largest number of steps in a sample."""


def settle_steps(fit: Fit) -> Fit:
    """Return a fit with so many integration steps that twice as many change its log-likelihood by less than `SETTLED`.

    An integration error is a random force to the filter: with little noise, a law with a kink loses hundreds by it, and
    a smooth force that imitates the law does not.
    """
    while 2 * fit.posterior.dynamics.nsub <= MOST_STEPS:
        finer = fit.posterior.stepped(2 * fit.posterior.dynamics.nsub)
        if abs(finer.log_density(fit.theta) - fit.posterior.log_density(fit.theta)) < SETTLED:
            return fit
        better = maximise(finer, fit.theta, tolerance=ROUGHLY)
        if better.status == "diverged":
            return fit
        fit = better
    return fit
