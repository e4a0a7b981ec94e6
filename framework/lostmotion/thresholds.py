"""Thresholds of recordings, shared parameters, chains and motions; `lostmotion.settings` collects all thresholds."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any


def threshold(value: float, why: str, source: str = "", least: float = 0.0, most: float = math.inf) -> Any:
    """Return a dataclass field with its default, its reason, its source and its allowed range."""
    metadata = {"default": value, "why": why, "source": source, "least": least, "most": most}
    return field(default=value, metadata=metadata)


@dataclass(frozen=True)
class RecordingSettings:
    """Warnings about a recording, and its decimation."""

    turns: float = threshold(10.0, "An angle in rad that exceeds this many turns may be in degrees.")
    swings: float = threshold(
        20.0, "An angle that crosses its median this often oscillates: beyond half a turn it may be in degrees."
    )
    same_size: float = threshold(
        5.0,
        "The numbers of two angles have the same size when their ratio is below this: then both may be in one unit.",
        least=1.0,
    )
    frozen: float = threshold(20.0, "A sensor may have been stuck when this many steps in a row are exactly zero.")
    repeats: float = threshold(
        0.01, "A sensor that repeats more than this share of its values elsewhere is not called stuck.", most=1.0
    )
    stuck: float = threshold(
        0.01,
        "A sensor at its extreme value in more than this share of the samples is called stuck or at rest, with fewer"
        " overloaded.",
        most=1.0,
    )
    far: float = threshold(20.0, "A value this many times the range of all others away is called a glitch.")
    returned: float = threshold(
        0.1,
        "Power flows from the machine to its drive when it exceeds this share of force times speed (rms).",
        "The share of power that the machine takes is at least 0.17 in 29 real recordings",
        most=1.0,
    )
    returned_errors: float = threshold(4.0, "That power must also exceed this many of its standard errors.")
    drift: float = threshold(
        10.0,
        "A drift between two clocks is reported when it exceeds this many standard errors: for independent delays the"
        " probability of a false alarm is below 1e-7, and the rest allows for correlated delays.",
    )
    drift_samples: float = threshold(0.2, "The drift must also exceed this many samples over the recording.")
    oversampled: float = threshold(
        5.0,
        "A recording is decimated while more than this many times the 20 samples remain that the shortest period above"
        " the noise needs.",
        least=1.0,
    )


@dataclass(frozen=True)
class SharedSettings:
    """Comparing a parameter between several recordings."""

    level: float = threshold(0.01, "The significance level for calling parameters different.", most=1.0)
    alike: float = threshold(
        0.01, "Values that differ by less than this share count as equal in engineering terms.", most=1.0
    )


@dataclass(frozen=True)
class ChainSettings:
    """Convergence of a Markov chain."""

    long: float = threshold(
        50.0,
        "The least length of a chain in autocorrelation times: from shorter chains that time cannot be estimated.",
        "Foreman-Mackey et al., PASP 125 (2013) 306",
    )
    steady: float = threshold(
        0.02,
        "The longest autocorrelation time has converged when it grows by less than this share between checks.",
        most=1.0,
    )
    agreed: float = threshold(
        1.01, "The largest accepted R-hat.", "Vehtari et al., Bayesian Analysis 16 (2021) 667-718", least=1.0
    )


@dataclass(frozen=True)
class MotionSettings:
    """Classifying a recorded motion as periodic, quasiperiodic, chaotic or noise."""

    level: float = threshold(
        0.05, "The significance level of each surrogate test.", "Theiler et al., Physica D 58 (1992) 77-94", most=1.0
    )
    efolds: float = threshold(
        0.8,
        (
            "Growth over fewer e-foldings is no evidence: noise with a long memory shows up to 0.65 "
            "(`benchmarks/verdicts.py`)."
        ),
    )
    turns: float = threshold(
        1.0, "Growth over fewer cycles of the motion is no evidence: distances rise and fall within a cycle."
    )
    flat: float = threshold(
        1.5, "A dimension whose interval ends below this belongs to a closed curve: a chaotic flow has more than 2."
    )
    still: float = threshold(0.05, "An entropy of fewer e-foldings per cycle cannot be distinguished from zero.")
    left: float = threshold(
        0.5,
        "The greatest share of the variance that does not repeat in a motion called periodic with fluctuations.",
        most=1.0,
    )
    uneven: float = threshold(
        2.0,
        "From this ratio of the standard deviations of its two halves on, a recording is not stationary.",
        least=1.0,
    )
    measured: float = threshold(
        2.0, "How many of exponent, dimension and entropy must indicate chaos.", least=1.0, most=3.0
    )
