"""Thresholds for chains, levels, motions and recordings, and the function that declares a threshold as a field.

The other stages are in `settings.py`, which holds all of them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any


def number(value: float, why: str, source: str = "", least: float = 0.0, most: float = math.inf) -> Any:
    """Return a dataclass field with its default, its reason, its source and its allowed range."""
    metadata = {"default": value, "why": why, "source": source, "least": least, "most": most}
    return field(default=value, metadata=metadata)


@dataclass(frozen=True)
class ChainSettings:
    """Convergence of a Markov chain."""

    long: float = number(
        50.0,
        "The least length of a chain in autocorrelation times: from shorter chains that time cannot be estimated.",
        "Foreman-Mackey et al., PASP 125 (2013) 306",
    )
    steady: float = number(
        0.02,
        "The longest autocorrelation time has converged when it grows by less than this share between checks.",
        most=1.0,
    )
    agreed: float = number(
        1.01, "The largest accepted R-hat.", "Vehtari et al., Bayesian Analysis 16 (2021) 667-718", least=1.0
    )


@dataclass(frozen=True)
class LevelSettings:
    """Which motions count as chaotic when parameters are identified from exponents and dimensions."""

    chaotic: float = number(
        2.0, "A motion is chaotic when its exponent exceeds zero by more than this many standard errors."
    )
    weak: float = number(
        0.5,
        "Chaos is weak when the exponent is below this, in nat per drive period: a recording may show nothing of it.",
        "`benchmarks/levels.py errors`: 6 of 10 recordings of weak chaos were classified correctly",
    )
    harmonic: float = number(
        0.1,
        "A drive is harmonic when this share of its standard deviation, or less, is not a sine of one frequency: its"
        " noise and small harmonics.",
        most=1.0,
    )


@dataclass(frozen=True)
class MotionSettings:
    """Classifying a recorded motion as periodic, quasiperiodic, chaotic or noise."""

    level: float = number(
        0.05, "The significance level of each surrogate test.", "Theiler et al., Physica D 58 (1992) 77-94", most=1.0
    )
    efolds: float = number(
        0.8,
        (
            "Growth over fewer e-foldings is no evidence: noise with a long memory shows up to 0.65 "
            "(`benchmarks/verdicts.py`)."
        ),
    )
    turns: float = number(
        1.0, "Growth over fewer cycles of the motion is no evidence: distances rise and fall within a cycle."
    )
    flat: float = number(
        1.5, "A dimension whose interval ends below this belongs to a closed curve: a chaotic flow has more than 2."
    )
    still: float = number(0.05, "An entropy of fewer e-foldings per cycle cannot be distinguished from zero.")
    left: float = number(
        0.5,
        "The greatest share of the variance that does not repeat in a motion called periodic with fluctuations.",
        most=1.0,
    )
    uneven: float = number(
        2.0,
        "From this ratio of the standard deviations of its two halves on, a recording is not stationary.",
        least=1.0,
    )
    measured: float = number(
        2.0, "How many of exponent, dimension and entropy must indicate chaos.", least=1.0, most=3.0
    )
    slack: float = number(
        1.4, "A motion returns when it misses itself by at most this many times its noise, plus `floor`.", least=1.0
    )
    floor: float = number(
        0.01, "The allowed miss of a returning motion beside its noise, as a share of its deviation.", most=1.0
    )
    tones_floor: float = number(
        0.02, "The allowed rest of a motion of two frequencies, beside `motion.slack` times its noise.", most=1.0
    )
    loudest: float = number(
        0.2, "A measured noise level above this share of the standard deviation is not accepted as noise.", most=1.0
    )
    drift: float = number(
        1.15,
        "A motion does not return when twice as many periods miss by more than this factor, plus `motion.drift_floor`:"
        " two frequencies nearly return, and miss by twice as much after twice as many periods.",
        least=1.0,
    )
    drift_floor: float = number(
        0.002, "The allowed rise of the miss beside `motion.drift`, as a share of the standard deviation.", most=1.0
    )
    resolution: float = number(
        0.25,
        "Frequencies closer than this share of a line of the spectrum cannot be distinguished.",
        least=0.01,
        most=1.0,
    )
    quiet: float = number(
        0.003, "Noise below this share of the standard deviation is not reduced: no method here sees it.", most=1.0
    )
    loud: float = number(
        0.3,
        "Noise above this share of the standard deviation is not reduced: it cannot be separated from the motion.",
        most=1.0,
    )
    together: float = number(
        0.7,
        "Surrogates keep k cycles together when the motion misses itself after k periods by less than this share of"
        " the miss after one period.",
        most=1.0,
    )
    fewest_values: float = number(
        16.0, "With fewer different values in a recording, neighbouring states cannot be distinguished.", least=2.0
    )
    fewest_samples: float = number(
        1000.0,
        "With fewer samples, the rank among surrogates and the slopes depend on single stretches of the orbit.",
        least=1.0,
    )
    fewest_periods: float = number(
        20.0,
        "With fewer periods, neither a return nor a second frequency can be recognised, and a surrogate test that is"
        " passed is silent.",
        least=1.0,
    )
    enough_periods: float = number(
        100.0, "With fewer periods, a missing exponent or dimension is no evidence about the motion.", least=1.0
    )
    note_periods: float = number(
        50.0, "With fewer periods, a note says that exponents and dimensions need a longer recording."
    )


@dataclass(frozen=True)
class RecordingSettings:
    """Warnings about a recording, and its decimation."""

    turns: float = number(10.0, "An angle in rad that exceeds this many turns may be in degrees.")
    swings: float = number(
        20.0, "An angle that crosses its median this often oscillates: beyond half a turn it may be in degrees."
    )
    same_size: float = number(
        5.0,
        "The numbers of two angles have the same size when their ratio is below this: then both may be in one unit.",
        least=1.0,
    )
    frozen: float = number(20.0, "A sensor may have been stuck when this many steps in a row are exactly zero.")
    repeats: float = number(
        0.01, "A sensor that repeats more than this share of its values elsewhere is not called stuck.", most=1.0
    )
    stuck: float = number(
        0.01,
        "A sensor at its extreme value in more than this share of the samples is called stuck or at rest, with fewer"
        " overloaded.",
        most=1.0,
    )
    far: float = number(20.0, "A value this many times the range of all others away is called a glitch.")
    returned: float = number(
        0.1,
        "Power flows from the machine to its drive when it exceeds this share of force times speed (rms).",
        "The share of power that the machine takes is at least 0.17 in 29 real recordings",
        most=1.0,
    )
    returned_errors: float = number(4.0, "That power must also exceed this many of its standard errors.")
    drift: float = number(
        10.0,
        "A drift between two clocks is reported when it exceeds this many standard errors: for independent delays the"
        " probability of a false alarm is below 1e-7, and the rest allows for correlated delays.",
    )
    drift_samples: float = number(0.2, "The drift must also exceed this many samples over the recording.")
    oversampled: float = number(
        5.0,
        "A recording is decimated while more than this many times the 20 samples remain that the shortest period above"
        " the noise needs.",
        least=1.0,
    )
