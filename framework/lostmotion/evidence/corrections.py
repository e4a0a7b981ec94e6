"""Usual errors of channels and known values that a hypothesis found: recordings are corrected for them.

They are no missing physics, but fits and predictions without them would show a force that is none.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import chi2, norm

from lostmotion.evidence.channel_errors import ChannelError, DriveError, ScaleError
from lostmotion.evidence.hypothesis import Hypothesis
from lostmotion.evidence.sensor_hum import SensorHum
from lostmotion.inference.fit import Fit, maximise
from lostmotion.inference.scaled_equations import solve_scaled
from lostmotion.likelihood.observation import Observation

CLEAR = 4.0
"""Errors are corrected where one of them is so many standard deviations from zero, or all together are so clear."""


@dataclass(frozen=True)
class Corrections:
    """Errors of channels with their sizes, and factors of known values by name; both are empty without a clear one.

    `clear` tells for each error of a channel whether it is one of the clear ones; `together` that none is clear alone.
    """

    errors: tuple[tuple[ChannelError, float], ...] = ()
    factors: tuple[tuple[str, float], ...] = ()
    clear: tuple[bool, ...] = ()
    together: bool = False

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
        posterior = fit.posterior.on(tuple(map(self.correct, fit.posterior.observations)))
        known = posterior.known.copy()
        for name, factor in self.factors:
            known[posterior.system.index[name]] *= factor
        found = maximise(replace(posterior, known=known), fit.theta)
        return fit if found.status == "diverged" else found

    def describe(self, first: Observation) -> Iterator[str]:
        """Yield a clause for each clear correction; `first` is a recording with the names of the channels."""
        clear = [pair for pair, told in zip(self.errors, self.clear, strict=True) if told]
        yield from dict.fromkeys(_describe_error(error, size, first) for error, size in clear)
        for name, factor in self.factors:
            yield f"{name} is {factor:.4g} times its known value"
        if self.together:
            yield "or one of these errors is larger and others are absent, since they have nearly the same effect"


def _describe_error(error: ChannelError, size: float, first: Observation) -> str:
    """Return a clause on the error of a channel."""
    share = f"{100.0 * abs(size):.2g} %"
    if isinstance(error, DriveError):
        driven = first.driven or ()
        name = driven[error.column] if error.column < len(driven) else f"input {error.column + 1}"
        if error.late:
            return f"{name} is {'late' if size < 0.0 else 'early'} by {abs(size):.2g} samples"
        return f"the scale of {name} is wrong by {share}"
    name = first.sensors[error.sensor].label
    if isinstance(error, SensorHum):
        return f"{name} picks up a wave of {error.pace / (2.0 * math.pi):.4g} Hz"
    if isinstance(error, ScaleError):
        return f"the scale of {name} is wrong by {share}"
    return f"{name} has a {'quadratic' if error.power == 2 else 'cubic'} error of {share} of its range"


def find_corrections(found: Hypothesis) -> Corrections:
    """Return the corrections of a hypothesis: those of the channels, of the known values, each if one is clear.

    Where errors have the same effect, such as the scales of two channels, none may be clear alone. Then all are
    corrected if they are clear together, and those beyond their usual size are told.
    """
    frame = found.frame
    channels, known = range(frame.channels.start, frame.count), range(frame.known.start, frame.known.stop)
    clear = {i for i in (*channels, *known) if _is_clear(found, [i])}
    if together := not clear and _is_clear(found, [*channels, *known]):
        widths = frame.widths(frame.none)
        clear = {i for i in (*channels, *known) if abs(_find_size(found, i)) > widths[i - frame.own]}
    errors: tuple[tuple[ChannelError, float], ...] = ()
    factors: tuple[tuple[str, float], ...] = ()
    if together or clear.intersection(channels):
        errors = tuple((error, float(found.at[i])) for i, error in zip(channels, frame.errors, strict=True))
    if together or clear.intersection(known):
        factors = tuple((frame.posterior.space.keys[i], math.exp(_find_size(found, i))) for i in known)
    return Corrections(errors, factors, tuple(i in clear for i in channels) if errors else (), together)


def _find_size(found: Hypothesis, at: int) -> float:
    """Return how far an error of a channel or the logarithm of a known value is from its expectation."""
    return float(found.at[at] - found.frame.middle[at - found.frame.own])


def _is_clear(found: Hypothesis, places: Sequence[int]) -> bool:
    """Return whether errors together are as far from zero as one that is `CLEAR` standard deviations away."""
    rows = [row for row, at in enumerate(found.used.tolist()) if at in places]
    if not rows:
        return False
    apart = np.array([_find_size(found, int(found.used[row])) for row in rows])
    square = float(apart @ solve_scaled(found.joint_covariance[np.ix_(rows, rows)], apart))
    return square > float(chi2.isf(2.0 * norm.sf(CLEAR), len(rows)))
