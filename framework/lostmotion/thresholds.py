"""How a threshold is declared, and those of learned curves, several recordings, modes, chains, levels and motions."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any


def make_field(value: float, why: str, source: str = "", least: float = 0.0, most: float = math.inf) -> Any:
    """Return a dataclass field with its default, its reason, its source and its allowed range."""
    metadata = {"default": value, "why": why, "source": source, "least": least, "most": most}
    return field(default=value, metadata=metadata)


@dataclass(frozen=True)
class UnknownSettings:
    """Learning an unexplained force as a curve, and describing it."""

    hope: float = make_field(
        0.3, "Curves are tried that predict at least this share of the gain of the best set of terms.", most=1.0
    )
    kept: float = make_field(
        0.2, "A curve that changes the size of a named law by more than this share belongs to that law.", most=1.0
    )
    alike: float = make_field(
        0.8, "A curve resembles a law that explains at least this share of its variance.", most=1.0
    )
    alike_two: float = make_field(
        0.9, "A curve resembles two laws that together explain at least this share of its variance.", most=1.0
    )
    formula: float = make_field(
        0.8, "A formula is proposed when it explains at least this share of the variance of a curve.", most=1.0
    )
    formula_gain: float = make_field(
        6.0,
        "A formula gets a further piece when Akaike's criterion improves by at least this much.",
        "Akaike, IEEE Trans. Automatic Control 19 (1974) 716-723",
    )
    formula_full: float = make_field(
        0.98, "A formula gets no further piece when it explains this share of the variance of a curve.", most=1.0
    )
    formula_pieces: float = make_field(3.0, "The greatest number of pieces of a formula.", least=1.0)
    most_curves: float = make_field(2.0, "The greatest number of learned curves in a diagnosis.", least=1.0)
    usual: float = make_field(
        3.0,
        (
            "Curves have to reduce the random force where that is more than this many times the usual noise of the "
            "drive."
        ),
    )


@dataclass(frozen=True)
class SharedSettings:
    """Comparing a parameter between several recordings."""

    level: float = make_field(0.01, "The significance level for calling parameters different.", most=1.0)
    alike: float = make_field(
        0.01, "Values that differ by less than this share count as equal in engineering terms.", most=1.0
    )
    most_own: float = make_field(
        3.0, "The greatest number of parameters that get a value for each recording: beyond it the model does not hold."
    )
    instead: float = make_field(
        3.0,
        "Another parameter is named as an alternative explanation when its log-likelihood is lower by less than this.",
    )
    fits: float = make_field(
        0.05,
        (
            "A power of the level describes the values, and all recordings but one agree, when the p-value of the "
            "residuals exceeds this."
        ),
        most=1.0,
    )
    exponent: float = make_field(
        3.0, "The exponent of a power of the level is at least this many standard errors from zero."
    )
    steepest: float = make_field(
        4.0, "The largest exponent of a power of the level: a steeper one describes a difference of another kind."
    )
    vague: float = make_field(
        0.05,
        "The relative error of the rms as a measure of the level: values may deviate from a power by this share.",
        most=1.0,
    )
    spread: float = make_field(
        1.1,
        "Levels of the drive within this factor count as one level; the levels of the response are used then.",
        least=1.0,
    )


@dataclass(frozen=True)
class ModeSettings:
    """Which maxima of a posterior are separate modes."""

    near: float = make_field(
        3.0, "Maxima that differ by less than this many standard deviations in each coordinate are one mode."
    )
    dip: float = make_field(
        3.0,
        (
            "Between two modes the log posterior density is lower by more than this: for two normal modes five standard"
            " deviations apart it is lower by 3.1."
        ),
    )
    within: float = make_field(
        20.0, "A mode is reported when its log evidence is lower than that of the best by no more than this."
    )


@dataclass(frozen=True)
class ChainSettings:
    """Convergence of a Markov chain."""

    long: float = make_field(
        50.0,
        "The least length of a chain in autocorrelation times: from shorter chains that time cannot be estimated.",
        "Foreman-Mackey et al., PASP 125 (2013) 306",
    )
    steady: float = make_field(
        0.02,
        "The longest autocorrelation time has converged when it grows by less than this share between checks.",
        most=1.0,
    )
    agreed: float = make_field(
        1.01, "The largest accepted R-hat.", "Vehtari et al., Bayesian Analysis 16 (2021) 667-718", least=1.0
    )


@dataclass(frozen=True)
class LevelSettings:
    """Which motions count as chaotic when parameters are identified from exponents and dimensions."""

    chaotic: float = make_field(
        2.0, "A motion is chaotic when its exponent exceeds zero by more than this many standard errors."
    )
    weak: float = make_field(
        0.5,
        "Chaos is weak when the exponent is below this, in nat per drive period: a recording may show nothing of it.",
        "`benchmarks/levels.py errors`: 6 of 10 recordings of weak chaos were classified correctly",
    )
    harmonic: float = make_field(
        0.1,
        "A drive is harmonic when this share of its standard deviation, or less, is not a sine of one frequency: its"
        " noise and small harmonics.",
        most=1.0,
    )


@dataclass(frozen=True)
class MotionSettings:
    """Classifying a recorded motion as periodic, quasiperiodic, chaotic or noise."""

    level: float = make_field(
        0.05, "The significance level of each surrogate test.", "Theiler et al., Physica D 58 (1992) 77-94", most=1.0
    )
    efolds: float = make_field(
        0.8,
        (
            "Growth over fewer e-foldings is no evidence: noise with a long memory shows up to 0.65 "
            "(`benchmarks/verdicts.py`)."
        ),
    )
    turns: float = make_field(
        1.0, "Growth over fewer cycles of the motion is no evidence: distances rise and fall within a cycle."
    )
    flat: float = make_field(
        1.5, "A dimension whose interval ends below this belongs to a closed curve: a chaotic flow has more than 2."
    )
    still: float = make_field(0.05, "An entropy of fewer e-foldings per cycle cannot be distinguished from zero.")
    left: float = make_field(
        0.5,
        "The greatest share of the variance that does not repeat in a motion called periodic with fluctuations.",
        most=1.0,
    )
    uneven: float = make_field(
        2.0,
        "From this ratio of the standard deviations of its two halves on, a recording is not stationary.",
        least=1.0,
    )
    measured: float = make_field(
        2.0, "How many of exponent, dimension and entropy must indicate chaos.", least=1.0, most=3.0
    )
