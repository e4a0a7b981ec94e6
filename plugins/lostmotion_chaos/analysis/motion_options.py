"""The numerical options of classifying a motion; the thresholds that decide are `MotionSettings`."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class MotionOptions:
    """Numbers of the recognition of periods, tones and noise; shares are of the standard deviation of the recording."""

    still: float = 0.05
    """An entropy of fewer e-foldings per cycle cannot be distinguished from zero."""
    left: float = 0.5
    """The greatest share of the variance that does not repeat in a motion called periodic with fluctuations."""
    uneven: float = 2.0
    """From this ratio of the standard deviations of its two halves on, a recording is not stationary."""
    slack: float = 1.4
    """A motion returns when it misses itself by at most this many times its noise, plus `floor`."""
    floor: float = 0.01
    """The allowed miss of a returning motion beside its noise, as a share."""
    tones_floor: float = 0.02
    """The allowed rest of a motion of two frequencies, as a share, beside `slack` times its noise."""
    drift: float = 1.15
    """A motion does not return when twice as many periods miss by more than this factor, plus `drift_floor`: two
    frequencies nearly return, and miss by twice as much after twice as many periods."""
    drift_floor: float = 0.002
    """The allowed rise of the miss beside `drift`, as a share."""
    resolution: float = 0.25
    """Frequencies closer than this share of a line of the spectrum cannot be distinguished."""
    quiet: float = 0.003
    """Noise below this share is not reduced: no method here sees it."""
    loud: float = 0.3
    """Noise above this share is not reduced: it cannot be separated from the motion."""
    together: float = 0.7
    """Surrogates keep k cycles together when the motion misses itself after k periods by less than this share of the
    miss after one period."""
    fewest_values: float = 16.0
    """With fewer different values in a recording, neighbouring states cannot be distinguished."""
    enough_periods: float = 100.0
    """With fewer periods, a missing exponent or dimension is no evidence about the motion."""
    note_periods: float = 50.0
    """With fewer periods, a note says that exponents and dimensions need a longer recording."""


OPTIONS = MotionOptions()
