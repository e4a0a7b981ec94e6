"""The thresholds of an analysis: classifying a recorded motion."""

from __future__ import annotations

from dataclasses import dataclass

from lostmotion.settings.threshold import threshold


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
    slack: float = threshold(
        1.4, "A motion returns when it misses itself by at most this many times its noise, plus `floor`.", least=1.0
    )
    floor: float = threshold(
        0.01, "The allowed miss of a returning motion beside its noise, as a share of its deviation.", most=1.0
    )
    tones_floor: float = threshold(
        0.02, "The allowed rest of a motion of two frequencies, beside `motion.slack` times its noise.", most=1.0
    )
    loudest: float = threshold(
        0.2, "A measured noise level above this share of the standard deviation is not accepted as noise.", most=1.0
    )
    drift: float = threshold(
        1.15,
        "A motion does not return when twice as many periods miss by more than this factor, plus `motion.drift_floor`:"
        " two frequencies nearly return, and miss by twice as much after twice as many periods.",
        least=1.0,
    )
    drift_floor: float = threshold(
        0.002, "The allowed rise of the miss beside `motion.drift`, as a share of the standard deviation.", most=1.0
    )
    resolution: float = threshold(
        0.25,
        "Frequencies closer than this share of a line of the spectrum cannot be distinguished.",
        least=0.01,
        most=1.0,
    )
    quiet: float = threshold(
        0.003, "Noise below this share of the standard deviation is not reduced: no method here sees it.", most=1.0
    )
    loud: float = threshold(
        0.3,
        "Noise above this share of the standard deviation is not reduced: it cannot be separated from the motion.",
        most=1.0,
    )
    together: float = threshold(
        0.7,
        "Surrogates keep k cycles together when the motion misses itself after k periods by less than this share of"
        " the miss after one period.",
        most=1.0,
    )
    fewest_values: float = threshold(
        16.0, "With fewer different values in a recording, neighbouring states cannot be distinguished.", least=2.0
    )
    fewest_samples: float = threshold(
        1000.0,
        "With fewer samples, the rank among surrogates and the slopes depend on single stretches of the orbit.",
        least=1.0,
    )
    fewest_periods: float = threshold(
        20.0,
        "With fewer periods, neither a return nor a second frequency can be recognised, and a surrogate test that is"
        " passed is silent.",
        least=1.0,
    )
    enough_periods: float = threshold(
        100.0, "With fewer periods, a missing exponent or dimension is no evidence about the motion.", least=1.0
    )
    note_periods: float = threshold(
        50.0, "With fewer periods, a note says that exponents and dimensions need a longer recording."
    )
