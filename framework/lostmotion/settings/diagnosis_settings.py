"""The thresholds of a diagnosis: locating, selecting, comparing, learning and reporting what a model leaves out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from lostmotion.settings.threshold import threshold


@dataclass(frozen=True)
class LocateSettings:
    """Locating the missing force."""

    significant: float = threshold(
        8.0,
        "A random force beyond the usual noise of the drive counts when it gains this much in log-likelihood.",
        unit="nat",
    )
    structured: float = threshold(
        0.1, "A covariate counts as structure when it explains more than this share of the missing force.", most=1.0
    )
    level: float = threshold(
        0.05,
        "The probability of a false positive over all covariates together.",
        "Vovk, Wang, Annals of Statistics 49 (2021) 1736-1754",
        most=1.0,
    )
    quiet: float = threshold(
        3.0, "A random force of up to this many times the usual noise of the drive needs no further terms.", least=1.0
    )
    quantisation: float = threshold(
        0.05,
        "Quantisation of the stored values counts when its variance exceeds this share of the noise variance.",
        most=1.0,
    )

    told: ClassVar[float] = 0.05
    """A covariate that explains less than this share of the variance is not reported."""
    tied: ClassVar[float] = 3.0
    """Covariates whose log likelihood ratios differ by less than this (a factor of twenty) are reported together."""
    signed: ClassVar[float] = 0.97
    """The sign of the velocity is reported in place of the velocity when it explains at least this share of what the
    velocity explains."""
    parity: ClassVar[float] = 0.8
    """A missing force is called odd or even in a covariate when that part has more than this share of the mean square
    of both."""


@dataclass(frozen=True)
class SelectSettings:
    """Selecting terms."""

    decisive: float = threshold(
        math.log(20.0),
        "A term is selected when its log odds exceed this value (odds of twenty).",
        "Kass, Raftery, J. Am. Stat. Assoc. 90 (1995) 773-795",
        unit="nat",
    )
    further: float = threshold(1.5, "The log prior penalty of each further parameter of a term.", unit="nat")
    onset: float = threshold(
        math.log(100.0),
        "The log prior penalty of a term that begins during the recording: one in a hundred.",
        unit="nat",
    )
    share: float = threshold(
        0.2, "A learned curve has to reduce a random force beyond the usual one by this share.", most=1.0
    )
    budget: float = threshold(
        0.0, "The processor time of the search, in s; 0: work in proportion to the readings and the states.", unit="s"
    )
    noise_memory: float = threshold(
        8.0,
        (
            "Noise of a sensor is modelled as AR(1) when this raises the log-likelihood by at least this much: for "
            "white noise the two parameters of AR(1) have no effect."
        ),
        unit="nat",
    )

    onset_first: ClassVar[float] = 0.04
    """An onset before this share of a recording is not considered: the term acts from the beginning."""
    onset_last: ClassVar[float] = 0.9
    """An onset after this share of a recording is not considered."""
    shape_steady: ClassVar[float] = 2.0
    """A shape of a law is tested when its correlation with the gradient is this many standard errors from zero. A stop
    that is hit in a few places of a sweep has 2.3."""


@dataclass(frozen=True)
class RivalSettings:
    """Usual imperfections of real machines, which are a part of every explanation."""

    known: float = threshold(
        0.01,
        "The relative standard deviation of a known value: drawings and data sheets are not more accurate.",
        most=1.0,
    )
    scale: float = threshold(0.01, "The relative standard deviation of the gain of a sensor and of a drive.", most=1.0)
    bent: float = threshold(
        0.005,
        "The standard deviation of the quadratic and of the cubic error of a sensor, relative to its range.",
        most=1.0,
    )
    late: float = threshold(
        0.1,
        "The standard deviation of the delay between channels, in samples, of a system that samples them together.",
        unit="samples",
    )
    much: float = threshold(
        20.0,
        (
            "A term is listed as open when it adds more than this log evidence to the nominal model, and is improbable "
            "beside the usual errors of a model."
        ),
        unit="nat",
    )


@dataclass(frozen=True)
class UnknownSettings:
    """Learning an unexplained force as a curve, and describing it."""

    hope: float = threshold(
        0.3, "Curves are tried that predict at least this share of the gain of the best set of terms.", most=1.0
    )
    most_curves: float = threshold(
        2.0, "The greatest number of learned curves in a diagnosis.", least=1.0, unit="curves"
    )

    kept: ClassVar[float] = 0.2
    """A curve that changes the size of a named law by more than this share belongs to that law."""
    alike: ClassVar[float] = 0.8
    """A curve resembles a law that explains at least this share of its variance."""
    alike_two: ClassVar[float] = 0.9
    """A curve resembles two laws that together explain at least this share of its variance."""
    formula: ClassVar[float] = 0.8
    """A formula is proposed when it explains at least this share of the variance of a curve."""
    formula_gain: ClassVar[float] = 6.0
    """A formula gets a further piece when Akaike's criterion improves by at least this much (Akaike, IEEE Trans.
    Automatic Control 19 (1974) 716-723)."""
    formula_full: ClassVar[float] = 0.98
    """A formula gets no further piece when it explains this share of the variance of a curve."""
    formula_pieces: ClassVar[float] = 3.0
    """The greatest number of pieces of a formula."""
    usual: ClassVar[float] = 3.0
    """Curves have to reduce the random force where it is more than this many times the usual noise of the drive."""


@dataclass(frozen=True)
class HeldOutSettings:
    """Comparing models on held-out data."""

    share: float = threshold(
        0.3, "The share of a recording, or of the recordings, that is held out.", least=0.05, most=0.7
    )
    valid: float = threshold(
        0.4,
        "A free prediction is valid until its error exceeds this share of the standard deviation of the response.",
    )
    rise: float = threshold(0.01, "An error of free runs that rises by a smaller share than this counts as unchanged.")
    fall: float = threshold(
        0.01,
        (
            "A log score that falls by more than this per sample is evidence against a model, unless the error of its"
            " free runs is much smaller."
        ),
    )
    chance: float = threshold(
        0.05,
        "The significance level for calling a model better or worse: Student's test over parts of held-out data.",
        most=1.0,
    )

    alive: ClassVar[float] = 4.0
    """A motion has decayed when its standard deviation is less than this many times the noise of the sensor."""

    def count_fitted(self, recordings: int) -> int:
        """Return how many of several recordings are fitted; the last ones are held out."""
        return max(1, recordings - max(1, round(self.share * recordings)))


@dataclass(frozen=True)
class NameSettings:
    """Reporting a finding as named, likely or open."""

    sure: float = threshold(
        0.95,
        "A named finding has a probability above this; a finding with a doubt is reported with at most this.",
        most=1.0,
    )
    simplest: float = threshold(
        0.5,
        "An open finding has at most this probability: in a model that does not predict held-out data it may stand for"
        " something else.",
        most=1.0,
    )
    rival: float = threshold(
        0.05,
        "A set of terms with a larger share of the posterior is reported as a rival; a term with less is no finding.",
        most=1.0,
    )
    worth: float = threshold(0.01, "A term that was not found is listed when its probability is above this.", most=1.0)
    moved: float = threshold(
        5.0,
        "An amplitude that moves by this many standard deviations when a further term is added was not identified.",
        unit="sd",
    )
    remains: float = threshold(
        0.5,
        (
            "A finding with doubts is open where the model does not predict held-out data and the random force that"
            " remains exceeds this share of the missing force."
        ),
        most=1.0,
    )
    early: float = threshold(
        0.04,
        "A change that is complete within this share of the recording is at most likely: a known value that is wrong"
        " from the beginning looks the same.",
        most=1.0,
    )
    error: float = threshold(
        0.3,
        "A model is rejected when the error of free runs exceeds this share of the response (see `name.error_noise`).",
    )
    white: float = threshold(
        0.01,
        "A p-value of whiteness below this is reported as a finding, and below five times this as a doubt.",
        most=1.0,
    )


@dataclass(frozen=True)
class SharedSettings:
    """Comparing a parameter between several recordings."""

    level: float = threshold(0.01, "The significance level for calling parameters different.", most=1.0)
    alike: float = threshold(
        0.01, "Values that differ by less than this share count as equal in engineering terms.", most=1.0
    )
    most_own: float = threshold(
        3.0,
        "The greatest number of parameters that get a value for each recording: beyond it the model does not hold.",
        unit="parameters",
    )

    instead: ClassVar[float] = 3.0
    """Another parameter is named as an alternative explanation when its log-likelihood is lower by less than this."""
    fits: ClassVar[float] = 0.05
    """A power of the level describes the values, and all recordings but one agree, when the p-value of the residuals
    exceeds this."""
    exponent: ClassVar[float] = 3.0
    """The exponent of a power of the level is at least this many standard errors from zero."""
    steepest: ClassVar[float] = 4.0
    """The largest exponent of a power of the level: a steeper one describes a difference of another kind."""
    vague: ClassVar[float] = 0.05
    """The relative error of the rms as a measure of the level: values may deviate from a power by this share."""
    spread: ClassVar[float] = 1.1
    """Levels of the drive within this factor count as one level; the levels of the response are used then."""
