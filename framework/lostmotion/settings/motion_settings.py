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
        unit="e-foldings",
    )
    turns: float = threshold(
        1.0,
        "Growth over fewer cycles of the motion is no evidence: distances rise and fall within a cycle.",
        unit="cycles",
    )
    flat: float = threshold(
        1.5, "A dimension whose interval ends below this belongs to a closed curve: a chaotic flow has more than 2."
    )
    measured: float = threshold(
        2.0, "How many of exponent, dimension and entropy must indicate chaos.", least=1.0, most=3.0
    )
    loudest: float = threshold(
        0.2, "A measured noise level above this share of the standard deviation is not accepted as noise.", most=1.0
    )
    fewest_samples: float = threshold(
        1000.0,
        "With fewer samples, the rank among surrogates and the slopes depend on single stretches of the orbit.",
        least=1.0,
        unit="samples",
    )
    fewest_periods: float = threshold(
        20.0,
        "With fewer periods, neither a return nor a second frequency can be recognised, and a surrogate test that is"
        " passed is silent.",
        least=1.0,
        unit="periods",
    )
