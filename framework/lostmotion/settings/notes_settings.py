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
    coloured: float = threshold(
        0.3,
        "Autocorrelated noise above this share of the held-out readings of a sensor may be motion.",
        most=1.0,
    )
    noise: float = threshold(
        0.8, "Noise above this share of the held-out readings of a sensor may be motion.", most=1.0
    )
    cycles: float = threshold(
        4.0, "A note on equal cycles is written when a recording has at least this number of cycles.", least=1.0
    )
    distinct: float = threshold(1.5, "Cycles are equal when fewer than this number are distinct.", least=1.0)
    gaps: float = threshold(
        0.1, "Cycles are not compared when more than this share of the readings is missing.", most=1.0
    )
    draws: float = threshold(
        15.0, "Importance sampling checks the evidence when it has at least this number of effective draws."
    )
    evidence: float = threshold(
        3.0,
        "Two log evidences agree when they differ by at most this (a factor of twenty), plus three standard errors.",
    )
    distance: float = threshold(
        0.01, "A distance between attractors is significant when its p-value is below this.", most=1.0
    )
    distance_open: float = threshold(
        0.05, "A distance between attractors may be significant when its p-value is below this.", most=1.0
    )
    decay_known: float = threshold(
        0.02,
        "A part of a decay is compared when its decrement or frequency has a smaller relative standard error.",
        most=1.0,
    )
    decay_certain: float = threshold(
        3.0, "A part of a decay is also compared when the model differs by this many standard errors."
    )
    decay_change: float = threshold(
        0.05, "A decrement that changes by less than this share is constant; a frequency with a tenth of it.", most=1.0
    )
    decrement: float = threshold(
        0.15, "A model has the recorded decrement when its relative error is below this.", most=1.0
    )
    frequency: float = threshold(
        0.02, "A model has the recorded frequency when its relative error is below this.", most=1.0
    )


@dataclass(frozen=True)
class ExperimentSettings:
    """Which alternatives an experiment can distinguish; chosen by experience."""

    least: float = threshold(
        3.0, "An experiment with a smaller expected log Bayes factor (odds of twenty) does not decide."
    )
    plain: float = threshold(
        5.0, "One model can imitate the other when the log Bayes factor in favour of the other is never above this."
    )
    imitated: float = threshold(
        0.2,
        "One model can also imitate the other when that log Bayes factor is never above this share of the opposite"
        " one.",
        most=1.0,
    )
    certain: float = threshold(
        12.0, "A model whose log Bayes factor is above this in one excitation is not imitated by the other."
    )
