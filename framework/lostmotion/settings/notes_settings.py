"""The thresholds of the sentences of a diagnosis: notes, checks of evidence, decays, attractors and experiments."""

from __future__ import annotations

from dataclasses import dataclass

from lostmotion.settings.threshold import threshold


@dataclass(frozen=True)
class NoteSettings:
    """When a result has a note, and when a sentence calls two values equal; chosen by experience."""

    error: float = threshold(
        5.0, "A note is written when free runs over held-out data have an error of this many times the noise."
    )
    position: float = threshold(
        0.01,
        "A note is written when no sensor measures the position and it is uncertain by more than this share of its"
        " amplitude (two standard deviations).",
        most=1.0,
    )
    noise: float = threshold(
        0.8, "Noise above this share of the held-out readings of a sensor may be motion.", most=1.0
    )


@dataclass(frozen=True)
class ExperimentSettings:
    """Which alternatives an experiment can distinguish; chosen by experience."""

    least: float = threshold(
        3.0, "An experiment with a smaller expected log Bayes factor (odds of twenty) does not decide.", unit="nat"
    )
