"""The thresholds of an identification: convergence of chains, and which motions count as chaotic."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from lostmotion.settings.threshold import threshold


@dataclass(frozen=True)
class ModeSettings:
    """Which maxima of a posterior are separate modes."""

    near: float = threshold(
        3.0, "Maxima that differ by less than this many standard deviations in each coordinate are one mode.", unit="sd"
    )
    within: float = threshold(
        20.0,
        "A mode is reported when its log evidence is lower than that of the best by no more than this.",
        unit="nat",
    )

    dip: ClassVar[float] = 3.0
    """Between two modes the log posterior density is lower by more than this: for two normal modes five standard
    deviations apart it is lower by 3.1."""


@dataclass(frozen=True)
class ChainSettings:
    """Convergence of a Markov chain."""

    long: float = threshold(
        50.0,
        "The least length of a chain in autocorrelation times: from shorter chains that time cannot be estimated.",
        "Foreman-Mackey et al., PASP 125 (2013) 306",
        unit="autocorrelation times",
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
class LevelSettings:
    """Which motions count as chaotic when parameters are identified from exponents and dimensions."""

    chaotic: float = threshold(
        2.0, "A motion is chaotic when its exponent exceeds zero by more than this many standard errors.", unit="sd"
    )
    weak: float = threshold(
        0.5,
        "Chaos is weak when the exponent is below this, in nat per drive period: a recording may show nothing of it.",
        "`benchmarks/levels.py errors`: 6 of 10 recordings of weak chaos were classified correctly",
        unit="nat per period",
    )
