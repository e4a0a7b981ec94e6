"""The thresholds of recordings: warnings and decimation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from lostmotion.settings.threshold import threshold


@dataclass(frozen=True)
class RecordingSettings:
    """Warnings about a recording, and its decimation."""

    frozen: float = threshold(
        20.0, "A sensor may have been stuck when this many steps in a row are exactly zero.", unit="samples"
    )
    stuck: float = threshold(
        0.01,
        "A sensor at its extreme value in more than this share of the samples is called stuck or at rest, with fewer"
        " overloaded.",
        most=1.0,
    )
    far: float = threshold(20.0, "A value this many times the range of all others away is called a glitch.")
    returned_errors: float = threshold(4.0, "That power must also exceed this many of its standard errors.", unit="sd")
    drift: float = threshold(
        10.0,
        "A drift between two clocks is reported when it exceeds this many standard errors: for independent delays the"
        " probability of a false alarm is below 1e-7, and the rest allows for correlated delays.",
        unit="sd",
    )
    oversampled: float = threshold(
        5.0,
        "A recording is decimated while more than this many times the 20 samples remain that the shortest period above"
        " the noise needs.",
        least=1.0,
    )

    turns: ClassVar[float] = 10.0
    """An angle in rad that exceeds this many turns may be in degrees."""
    swings: ClassVar[float] = 20.0
    """An angle that crosses its median this often oscillates: beyond half a turn it may be in degrees."""
    same_size: ClassVar[float] = 5.0
    """The numbers of two angles have the same size when their ratio is below this: then both may be in one unit."""
    repeats: ClassVar[float] = 0.01
    """A sensor that repeats more than this share of its values elsewhere is not called stuck."""
    returned: ClassVar[float] = 0.1
    """Power flows from the machine to its drive when it exceeds this share of force times speed (rms). The share of
    power that the machine takes is at least 0.17 in 29 real recordings."""
    drift_samples: ClassVar[float] = 0.2
    """The drift must also exceed this many samples over the recording."""
