"""Usual errors of channels and known values that a hypothesis found: recordings are corrected for them.

They are no missing physics, but fits and predictions without them would show a force that is none.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.evidence.channels import ChannelError, DriveError
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.inference.fit import Fit, maximise
from lostmotion.likelihood.observation import Observation

CLEAR = 4.0
"""Errors are corrected where one of them is so many standard deviations from zero."""


@dataclass(frozen=True)
class Corrections:
    """Errors of channels with their sizes, and factors of known values by name; both are empty without a clear one."""

    errors: tuple[tuple[ChannelError, float], ...] = ()
    factors: tuple[tuple[str, float], ...] = ()

    def __bool__(self) -> bool:
        """Whether anything is corrected."""
        return bool(self.errors or self.factors)

    def correct(self, observation: Observation) -> Observation:
        """Return a recording without the errors of its channels."""
        for error, size in self.errors:
            observation = error.correct(observation, size)
        return observation

    def refit(self, fit: Fit) -> Fit:
        """Return a fit on corrected recordings with corrected known values; unchanged without corrections."""
        if not self:
            return fit
        problem = fit.problem.on(tuple(map(self.correct, fit.problem.observations)))
        known = problem.known.copy()
        for name, factor in self.factors:
            known[problem.system.index[name]] *= factor
        found = maximise(replace(problem, known=known), fit.theta)
        return fit if found.status == "diverged" else found

    def describe(self) -> Iterator[str]:
        """Yield a clause for each correction, largest first in the order of the channels."""
        for error, size in self.errors:
            if isinstance(error, DriveError) and error.late:
                yield f"input {error.column + 1} is {'late' if size < 0.0 else 'early'} by {abs(size):.2g} samples"
            elif isinstance(error, DriveError):
                yield f"the scale of input {error.column + 1} is wrong by {100.0 * size:.2g} %"
            else:
                yield f"sensor {error.sensor + 1} has an error of {100.0 * size:.2g} % of its range"
        for name, factor in self.factors:
            yield f"{name} is {factor:.4g} times its known value"


def find_corrections(found: Hypothesis) -> Corrections:
    """Return the corrections of a hypothesis: those of the channels, of the known values, each if one is clear."""
    frame, sds = found.frame, np.sqrt(np.diag(np.linalg.inv(found.precision)))
    spread = dict(zip(found.used.tolist(), sds.tolist(), strict=True))
    middle = np.concatenate([np.zeros(frame.own), frame.middle])

    def is_clear(i: int) -> bool:
        return bool(abs(found.at[i] - middle[i]) > CLEAR * spread.get(i, math.inf))

    channels, known = range(frame.channels.start, frame.count), range(frame.known.start, frame.known.stop)
    errors: tuple[tuple[ChannelError, float], ...] = ()
    factors: tuple[tuple[str, float], ...] = ()
    if any(map(is_clear, channels)):
        errors = tuple((error, float(found.at[i])) for i, error in zip(channels, frame.errors, strict=True))
    if any(map(is_clear, known)):
        factors = tuple((frame.problem.keys[i], math.exp(float(found.at[i] - middle[i]))) for i in known)
    return Corrections(errors, factors)
